"""An analysis on meshes finer and finer: how far a result is from the one that endless fine cells would give.

The limit is Richardson's extrapolation of the three finest, its band Roache's grid convergence index: 1.25 times the distance from the finest to the limit.
"""

import math
import textwrap

import FreeCAD

from . import api, objects, option_table, refinements, shapes, solver
from .errors import InvalidInput
from .words import tr

#: from one size to the next: twice as many cells and a half, and three sizes span nearly a factor of two
_STEP = 2**0.5
#: Roache's factor of safety where the order was observed on three meshes
_SAFETY = 1.25
#: Below the first there is no convergence that an estimate can be built on. Above the second, which is what energies have with elements of second order, the
#: last two meshes are alike by chance: the estimate is made with the order below, which gives a wider band.
_ORDERS, _CAUTIOUS = (0.3, 4.0), 2.0


class Convergence:
    """rows: dicts of size, cells, nodes, value, seconds; order observed; limit and band, value in limit - band to limit + band.

    Where they do not come nearer to each other from mesh to mesh, the limit is None and the band how far the last three are apart: meshes of parts that are
    no single block are of different structure at different sizes, and small differences have no order.
    """

    def __init__(self, quantity, rows):
        self.quantity, self.rows = quantity, rows
        widths = [row["cells"] ** (-1 / 3) for row in rows]
        self.order, self.limit, self.band = extrapolated(widths, [row["value"] for row in rows])

    @property
    def value(self):
        """On the finest mesh."""
        return self.rows[-1]["value"]

    def line(self):
        if self.limit is None:
            share = " ({:.2g} %)".format(100 * self.band / abs(self.value)) if self.value else ""
            line = tr("{}: {:.6g} on the finest mesh; no order is to be seen, the last three differ by {:.2g}{}")
            return line.format(self.quantity, self.value, self.band, share)
        line = tr("{}: {:.6g} on the finest mesh, {:.6g} +- {:.2g} in the limit, order {:.1f}")
        return line.format(self.quantity, self.value, self.limit, self.band, self.order)

    def plot(self, path):
        """Values over cells with the limit and its band, to a file .png or .svg."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        figure = Figure(figsize=(6, 4))
        FigureCanvasAgg(figure)
        axes = figure.subplots()
        axes.semilogx([row["cells"] for row in self.rows], [row["value"] for row in self.rows], "o-")
        if self.limit is not None:
            axes.axhline(self.limit, color="grey", linestyle="--")
            axes.axhspan(self.limit - self.band, self.limit + self.band, color="grey", alpha=0.2)
        axes.set(xlabel="cells", ylabel=self.quantity, title=textwrap.fill(self.line(), 80))
        axes.title.set_fontsize(8)
        figure.tight_layout()
        figure.savefig(path, dpi=100)


def extrapolated(widths, values):
    """(order, limit, band) from the last three of values on cells of these widths; order and limit None where there is no order."""
    (h1, h2, h3), (v1, v2, v3) = widths[-3:], values[-3:]
    coarse, fine = v2 - v1, v3 - v2
    if fine == 0:
        return None, v3, 0.0
    band = max(v1, v2, v3) - min(v1, v2, v3)
    if coarse * fine <= 0:
        return None, None, band

    def excess(order):
        """Above nought where the order is too high for what was seen."""
        return (h1**order - h2**order) / (h2**order - h3**order) - coarse / fine

    low, high = _ORDERS
    if excess(low) > 0:
        return None, None, band
    if excess(high) < 0:
        low = high = _CAUTIOUS
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if excess(middle) > 0 else (middle, high)
    limit = v3 + fine * h3**low / (h2**low - h3**low)
    return low, limit, _SAFETY * abs(limit - v3)


def converge(analysis, sizes=3, quantity="max displacement", element=None, solver_object=None, folder=None, plot=None, log=None, cancel=None):
    """Meshes and solves at every size, coarse to fine; leaves the finest mesh, its results and a table in the analysis, in one undo step.

    sizes: how many, 3 or more, round the size that the mesh has, or a list of them. quantity: "max displacement", "max stress" (von Mises),
    a point (x, y, z) with "displacement" or "stress" there: ((x, y, z), "stress"), or the mean over a face: ("Face3", "displacement").
    plot: path of a picture. Others as for solve(). Returns a Convergence. Raises like update_fem_mesh() and solve(); a document that
    keeps undo steps is then as it was.
    """
    meshes = [member for member in getattr(analysis, "Group", []) if objects.is_polycube(member)]
    if len(meshes) != 1:
        raise InvalidInput(tr("an analysis with a mesh of Polycube is needed"))
    (mesh,) = meshes
    measure, name = _measure(quantity, mesh)
    series, rows = list(_options(mesh, sizes)), []
    local = refinements.local_sizes(mesh)
    folder = solver.prepared(analysis, solver_object, folder).working_dir  # one for all sizes
    with api.transaction(analysis.Document, tr("Convergence series")):
        for options, finer in series:
            option_table.write(mesh, options)
            for refinement, size in local.items():
                refinement.Size = size * finer
            api.update_fem_mesh(mesh, cancel=cancel)
            solution = solver.solve(analysis, element, solver_object, folder, log, cancel)
            row = {"size": options["size"], "cells": mesh.Hexahedra, "nodes": mesh.NodeCount, "value": measure(solution.result), "seconds": solution.seconds}
            rows.append(row)
            if log:
                log("size {size:.4g}: {cells} cells, {nodes} nodes, {value:.6g}".format(**row))
        found = Convergence(name, rows)
        _table(analysis, found)
    FreeCAD.Console.PrintMessage("{}: {}\n".format(analysis.Label, found.line()))
    if plot:
        found.plot(plot)
    return found


def _options(mesh, sizes):
    """The mesh's options with each size, coarse to fine, and what share of the present size that is; sizes on faces and elements round circles and through
    walls go with it.
    """
    options = option_table.read(mesh)
    hexes = options.pop("hexes", None)
    shape = shapes.shape_of(objects.part_of(mesh), beside=mesh)
    automatic = shape.BoundBox.DiagonalLength / 20
    now = (shape.Volume / hexes) ** (1 / 3) if hexes else options.get("size") or min(0.75 * (options.get("max_size") or automatic / 0.75), automatic)
    defaults = {option["name"]: option["default"] for option in option_table.table()}
    round_circles = options.get("per_circle", defaults["per_circle"])
    through_walls = options.get("min_layers") or (2 if options.get("order", defaults["order"]) == 2 else 3)
    if isinstance(sizes, int):
        sizes = [now * _STEP ** ((sizes - 1) / 2 - i) for i in range(sizes)]
    try:
        sizes = sorted((float(size) for size in sizes), reverse=True)
    except (TypeError, ValueError):
        raise InvalidInput(tr("sizes: neither their number nor a list of sizes but {!r}").format(sizes)) from None
    if len(sizes) < 3 or len(set(sizes)) < len(sizes) or sizes[-1] <= 0:
        raise InvalidInput(tr("three different sizes are needed, or more"))
    for size in sizes:
        found = dict(options, size=size, per_circle=round(round_circles * now / size), min_layers=max(1, round(through_walls * now / size)))
        if options.get("max_size"):
            found["max_size"] = options["max_size"] * size / now
        if options.get("sizes"):
            pairs = (pair.split("=") for pair in options["sizes"].split(","))
            found["sizes"] = {what: float(amount) * size / now for what, amount in pairs}
        yield found, size / now


def _measure(quantity, mesh):
    """(function of a result object, name) of a quantity."""
    if quantity == "max displacement":
        return lambda result: max(result.DisplacementLengths), quantity + " / mm"
    if quantity == "max stress":
        return lambda result: max(result.vonMises), quantity + " / MPa"
    try:
        where, what = quantity
        values = {"displacement": lambda result: result.DisplacementLengths, "stress": lambda result: result.vonMises}[what]
        unit = {"displacement": "mm", "stress": "MPa"}[what]
        if isinstance(where, str):
            if where not in ("Face{}".format(i + 1) for i in range(len(shapes.numbered_shape(objects.part_of(mesh)).Faces))):
                raise LookupError(tr("there is no {}").format(where))
            return lambda result: _mean(mesh, where, result, values(result)), "mean {} on {} / {}".format(what, where, unit)
        place = FreeCAD.Vector(*where)
    except (TypeError, ValueError, KeyError):
        raise InvalidInput(tr('a quantity is "max displacement", "max stress", ((x, y, z), "stress") or ("Face3", "displacement")')) from None
    except LookupError as error:
        raise InvalidInput(str(error)) from None
    return lambda result: _at(mesh, place, result, values(result)), "{} at {} / {}".format(what, tuple(place), unit)


def _at(mesh, place, result, values):
    """At the node next to a place: on vertices and edges of the part there is one on every mesh."""
    points = mesh.FemMesh.Nodes
    return min(zip(result.NodeNumbers, values), key=lambda pair: points[pair[0]].distanceToPoint(place))[1]


def _mean(mesh, face, result, values):
    from .load_sets import GroupedMesh

    shape = shapes.numbered_shape(objects.part_of(mesh))
    grouped = GroupedMesh(mesh, shape)
    weights = grouped.weights(grouped.elements(shape.getElement(face), "Face"))
    return sum(weights.get(node, 0.0) * value for node, value in zip(result.NodeNumbers, values)) / sum(weights.values())


def _table(analysis, found):
    """A spreadsheet in the analysis, in place of the one of an earlier series."""
    document = analysis.Document
    sheet = next((member for member in analysis.Group if member.Name.startswith("Convergence")), None)
    if sheet is None:
        sheet = document.addObject("Spreadsheet::Sheet", "Convergence")
        analysis.addObject(sheet)
    sheet.clearAll()
    for column, key in zip("ABCDE", ("size", "cells", "nodes", "value", "seconds")):
        sheet.set(column + "1", key)
        for number, row in enumerate(found.rows, 2):
            sheet.set("{}{}".format(column, number), repr(float(row[key])) if not math.isnan(row[key]) else "")
    sheet.set("A{}".format(len(found.rows) + 3), found.line())
    sheet.recompute()
