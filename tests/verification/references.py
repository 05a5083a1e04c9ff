"""Reference values of cases without a closed form, on one block of C3D20R (with temperatures C3D20) mapped by hand, finer and finer; inside FreeCAD.

See `run` in this folder, --references. For each mesh the value by CalculiX's own stresses and by the recovered ones, and what each tends to by
Richardson's extrapolation with the rate that the three values show.
POLYCUBE_REFERENCES names the cases, a JSON list; all if it is empty.
"""

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from typing import Callable

import numpy as np
import scipy.optimize

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import frd  # noqa: E402

from freecad.polycube import ccx, recovery, serendipity, symmetry  # noqa: E402

YOUNG, POISSON, EXPANSION = 210000.0, 0.3, 2.3e-4


@dataclass
class Block:
    """A quarter, mapped from u, v, w from 0 to 1: out, round the z axis, up. place(u, v, w): its points. still: w of the ends that do not move along z.
    pulled: how far round it is pulled outside, by 10 MPa. at(x, y, z): distance from where the stress component is looked at. warm: as LE11. One cell stays one when it is refined.
    """

    place: Callable
    cells: tuple
    refinements: tuple
    still: tuple
    pulled: float
    at: Callable
    component: int
    warm: bool = False


def graded(t, power):
    """From 0 to 1, finer at 0: the last cell is exp(power) times the first."""
    return np.expm1(power * t) / np.expm1(power)


def between_ellipses(u, v, w):
    """NAFEMS LE1."""
    share, angle = graded(u, 1.5), graded(v, 1.0) * np.pi / 2
    return (2000 + 1250 * share) * np.cos(angle), (1000 + 1750 * share) * np.sin(angle), 100 * w


def around_hole(u, v, w):
    """From the hole to the edges of the plate; the ray to its corner leaves the hole at 36 degrees."""
    share, corner = graded(u, 2.0), 0.2 * np.pi
    angle = np.interp(v, (0, 0.5, 1), (0, corner, np.pi / 2))
    x, y = np.interp(v, (0.5, 1), (100, 0)), np.interp(v, (0, 0.5), (0, 50))
    return 10 * np.cos(angle) * (1 - share) + x * share, 10 * np.sin(angle) * (1 - share) + y * share, 5 * w


def around_axis(u, v, w):
    """NAFEMS LE11: sphere, taper and cylinder are a third each."""
    sphere, taper, top, waist = np.minimum(3 * w, 1), np.clip(3 * w - 1, 0, 1), np.maximum(3 * w - 2, 0) * 400, 1000 * np.sqrt(0.5)
    inside = np.where(sphere < 1, 1000 * np.cos(sphere * np.pi / 4), waist)
    low = np.where(sphere < 1, 1000 * np.sin(sphere * np.pi / 4), waist + (1390 - waist) * taper) + top
    outside = 1400 * np.cos(sphere * np.pi / 6) * (1 - taper) + 1000 * taper
    radius, height = inside + (outside - inside) * u, low + (1400 * np.sin(sphere * np.pi / 6) + 690 * taper + top - low) * u
    return radius * np.cos(v * np.pi / 2), radius * np.sin(v * np.pi / 2), height


BLOCKS = {
    "hole": Block(around_hole, (12, 16, 1), (2, 3, 4), (0, 1), 0.5, lambda x, y, z: np.hypot(x, y - 10), 0),
    "LE1": Block(between_ellipses, (8, 12, 2), (1, 2, 3), (0,), 1, lambda x, y, z: np.hypot(x - 2000, y), 1),
    "LE11": Block(around_axis, (4, 5, 12), (3, 4, 5), (0, 1), 0, lambda x, y, z: np.hypot(np.hypot(x, y) - 1000, z), 2, True),
}


def grid(counts):
    """(u, v, w of the nodes (n, 3); nodes of the cells (m, 20), in CalculiX's order)."""
    shape = tuple(2 * count + 1 for count in counts)
    steps = np.indices(shape)
    kept = (steps % 2).sum(axis=0) <= 1
    numbers = np.full(shape, -1)
    numbers[kept] = np.arange(kept.sum())
    first = 2 * np.indices(counts).reshape(3, -1, 1)
    corners = np.array(serendipity.CORNERS + serendipity.MIDDLES).T[:, None] + 1
    return (steps[:, kept] / (2 * np.array(counts))[:, None]).T, numbers[tuple(first + corners)]


def deck(block, uvw, points, cells):
    """Lines of the input file."""
    lines = ["*NODE, NSET=Nall", *("{},{:.15g},{:.15g},{:.15g}".format(number, *point) for number, point in enumerate(points, 1))]
    lines += ["*ELEMENT, ELSET=Eall, TYPE=" + ("C3D20" if block.warm else "C3D20R")]
    for number, nodes in enumerate((cells + 1).tolist(), 1):
        lines += [",".join(map(str, [number, *nodes[:10]])) + ",", ",".join(map(str, nodes[10:]))]
    lines += ["*MATERIAL, NAME=Steel", "*ELASTIC", "{},{}".format(YOUNG, POISSON), "*EXPANSION, ZERO=0.", str(EXPANSION)]
    lines += ["*SOLID SECTION, ELSET=Eall, MATERIAL=Steel", "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "Nall,0.", "*STEP", "*STATIC", "*BOUNDARY"]
    u, v, w = uvw.T
    for held, axis in ((v == 1, 1), (v == 0, 2), (np.isin(w, block.still), 3)):
        lines += ["{0},{1},{1}".format(node, axis) for node in np.flatnonzero(held) + 1]
    if block.pulled:
        outside = (u[cells] == 1).any(axis=1) & (v[cells].max(axis=1) <= block.pulled)
        lines += ["*DLOAD", *("{},P4,-10".format(cell) for cell in np.flatnonzero(outside) + 1)]  # P4: the side where u ends
    if block.warm:
        lines += ["*TEMPERATURE", *("{},{:.12g}".format(n, (np.hypot(x, y) + z) / 1000) for n, (x, y, z) in enumerate(points, 1))]
    return [*lines, "*NODE FILE", "U", "*EL FILE", "S", "*EL PRINT, ELSET=Eall", "S", "*END STEP", ""]


def values(block, refinement):
    """(number of nodes, {"CalculiX" or "recovered": value})."""
    uvw, cells = grid([count if count == 1 else round(count * refinement) for count in block.cells])
    points = np.stack(block.place(*uvw.T), axis=1)
    with tempfile.TemporaryDirectory(prefix="polycube-references-") as folder:
        path = os.path.join(folder, "block")
        with open(path + ".inp", "w", encoding="ascii") as file:
            file.write("\n".join(deck(block, uvw, points, cells)))
        subprocess.run([ccx.find(), "-i", "block"], cwd=folder, stdout=subprocess.DEVNULL, check=True)
        own = frd.read(path + ".frd")["stress"]
        with open(path + ".dat", encoding="ascii") as file:
            rows = np.array(file.read().split("\n\n", 2)[-1].split(), float).reshape(-1, 8)
        mirrors = symmetry.planes(path + ".inp", range(1, len(points) + 1), points, recovery.boundary(cells, len(points)))
    rows = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
    samples = recovery.at_superconvergent(rows[:, [2, 3, 4, 5, 7, 6]].reshape(len(cells), -1, 6))
    better = recovery.recovered(points, cells, samples, mirrors=mirrors)[0]
    there = block.at(*points.T) < 1e-4
    return len(points), {name: stress[there, block.component].mean() for name, stress in (("CalculiX", own), ("recovered", better))}


def limit(refinements, found):
    """(observed rate, Richardson's extrapolation by it) of three values; None where they do not settle."""
    ratio = (found[1] - found[0]) / (found[2] - found[1])

    def miss(rate):
        first, second, third = (refinement**-rate for refinement in refinements)
        return (first - second) / (second - third) - ratio

    slowest, fastest = 0.5, 8.0
    if miss(slowest) * miss(fastest) >= 0:
        return None
    rate = scipy.optimize.brentq(miss, slowest, fastest)
    return rate, found[2] + (found[2] - found[1]) / ((refinements[2] / refinements[1]) ** rate - 1)


def table(names):
    yield "| case | nodes | stresses | values, MPa | rate | tends to |"
    yield "|---|---|---|---|---|---|"
    for case in names or BLOCKS:
        runs = [values(BLOCKS[case], refinement) for refinement in BLOCKS[case].refinements]
        for name in runs[0][1]:
            end = limit(BLOCKS[case].refinements, [found[name] for _, found in runs])
            nodes, found = (" ".join(texts) for texts in ((str(count) for count, _ in runs), ("{:.4f}".format(value[name]) for _, value in runs)))
            yield "| {} | {} | {} | {} | {} |".format(case, nodes, name, found, "{:.1f} | {:.3f}".format(*end) if end else " | ")


if "POLYCUBE_REFERENCES" in os.environ:
    for _line in table(json.loads(os.environ["POLYCUBE_REFERENCES"])):
        print(_line, flush=True)
