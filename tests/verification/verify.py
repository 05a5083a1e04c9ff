"""Runs the cases at three sizes, and tetrahedra of like count, and keeps the rows in a file; inside FreeCAD. See `run` in this folder.

The file names what is to be done in POLYCUBE_VERIFY, JSON: "out" for the rows, "cases" (all if empty). What is in `out` already is not done again.
"""

import json
import os
import sys
import tempfile
import traceback

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import cases  # noqa: E402

#: what a mesh is made of, and the elements that it is solved with; from them come the series "raw", with CalculiX's stresses, and "improved", with its ZZS
SERIES = {"hexes": (2, ("C3D20R", "C3D20")), "linear": (1, ("C3D8I",)), "mapped": (2, ("C3D20R",)), "tets": (None, (None,))}


def series_of(case):
    """Names of the meshes that are made of a case."""
    return ["hexes", "linear", *(["mapped"] if case.mapped else []), *(["tets"] if case.smooth else [])]


def measure(case, size, series, nodes=None):
    """Rows of one mesh, for each element, and for other stresses from the same mesh: nodes, cells, processor seconds and memory of CalculiX, errors of the quantities. nodes: of tetrahedra."""
    order, elements = SERIES[series]
    model = case.model()
    try:
        with tempfile.TemporaryDirectory(prefix="polycube-verify-") as folder:
            mesh = model.mesh(size, order, **(case.mapped if series == "mapped" else {})) if order else model.tets(nodes, folder)
            for element in elements:
                field = model.solve(folder, element)
                fields = {series: field}
                if cases.has_stresses(case) and series == "hexes" and field.raw:
                    fields["raw"] = field.raw
                if cases.has_stresses(case) and series == "tets":
                    fields["improved"] = model.solve(folder, improved=True)
                for name, found in fields.items():
                    yield {
                        "case": case.name,
                        "series": name,
                        "element": element or "C3D10",
                        "size": size,
                        "nodes": mesh.NodeCount,
                        "cells": mesh.VolumeCount,
                        **found.cost,
                        "errors": [quantity.error(found) for quantity in case.quantities],
                    }
    finally:
        model.close()


def main(out, names):
    rows = []
    if os.path.exists(out):
        with open(out, encoding="ascii") as file:
            rows = [json.loads(line) for line in file]
    for case in (case for case in cases.CASES if not names or case.name in names):
        for size in case.sizes:
            for series in series_of(case):
                if any((row["case"], row["size"], row["series"]) == (case.name, size, series) for row in rows):
                    continue
                hexes = next((row.get("nodes") for row in rows if (row["case"], row["size"], row["series"]) == (case.name, size, "hexes")), None)
                if series == "tets" and not hexes:
                    continue
                try:
                    new = list(measure(case, size, series, hexes))
                except Exception as error:  # a case that fails is a row of the table, not the end of it
                    traceback.print_exc()
                    new = [{"case": case.name, "series": series, "size": size, "failed": str(error)}]
                rows += new
                with open(out, "a", encoding="ascii") as file:
                    file.writelines(json.dumps(row) + "\n" for row in new)


if "POLYCUBE_VERIFY" in os.environ:
    _todo = json.loads(os.environ["POLYCUBE_VERIFY"])
    main(_todo["out"], _todo["cases"])
