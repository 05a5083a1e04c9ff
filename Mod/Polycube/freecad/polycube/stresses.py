"""The stresses that a run of CalculiX gives its user: those of its result file are replaced by recovered ones (recovery.py) before FreeCAD reads it.

Stresses at integration points are printed for it to the .dat file, and taken out of it again: FreeCAD puts the whole of it into the document.
"""

import os
import re

from . import recovery, symmetry
from .words import tr

RECOVERED, CALCULIX = "recovered", "calculix"
#: what can be asked for
KINDS = (RECOVERED, CALCULIX)
#: property of result objects that says which they have
_PROPERTY = "Stresses"
#: cards that print stresses at integration points
CARDS = ("*EL PRINT, ELSET=Eall", "S")
#: FreeCAD's input files have the corners and middles of SMESH's cell with 20 nodes in this order
_ORDER = (5, 6, 7, 4, 1, 2, 3, 0, 13, 14, 15, 12, 9, 10, 11, 8, 17, 18, 19, 16)
#: from xx yy zz xy xz yz as printed to xx yy zz xy yz zx as in result files
_AS_IN_RESULTS = (0, 1, 2, 3, 5, 4)
_PRINTED = re.compile(r"^ stresses \(elem[^\n]*\n", re.MULTILINE)
#: smallest size that twelve characters of a result file hold with an exponent of two digits
_SMALLEST = 1e-99


class Recovered:
    """nodes: numbers; points (n, 3); cells (m, 20) rows of points; samples (m, 8, 6) of the last stresses; values (n, 6), those at nodes; trust (n,): 1 where
    they are recovered ones, 0 where they are CalculiX's, between where they are both mixed; of_cells (m, 20, 6): recovered ones at the nodes of each cell.
    """

    def __init__(self, nodes, points, cells, samples, values, trust, of_cells):
        self.nodes, self.points, self.cells, self.samples, self.values, self.trust = nodes, points, cells, samples, values, trust
        self.of_cells = of_cells

    def line(self):
        """One line for the log."""
        own = 1 - self.trust.mean()
        if own < 0.005:
            return tr("stresses are recovered from the integration points")
        return tr("stresses are recovered from the integration points; {:.0f} % are CalculiX's, where the cells are too few or too large for that").format(100 * own)


def recover(path, mesh, materials):
    """The Recovered of a run, from the files beside the input file, which are changed; None where they have no stresses, or not those at integration points.

    mesh: a GroupedMesh of cells with 20 nodes. materials: lists of cells, one for each.
    """
    import numpy

    base = os.path.splitext(path)[0]
    with open(base + ".dat", encoding="utf-8") as file:
        printed, rest = _printed(file.read())
    if not printed:
        return None
    with open(base + ".dat", "w", encoding="utf-8") as file:
        file.write(rest)
    places = mesh.Nodes
    nodes = numpy.array(sorted(places))
    points = numpy.array([places[node][:] for node in nodes.tolist()])
    volumes = numpy.array(mesh.Volumes)
    cells = numpy.searchsorted(nodes, numpy.array([mesh.getElementNodes(volume) for volume in mesh.Volumes])[:, _ORDER])
    regions = _regions(mesh, volumes, materials)
    mirrors = symmetry.planes(path, nodes.tolist(), points, recovery.boundary(cells, len(points)))
    found = []
    for rows in printed:
        samples = _by_cell(rows, volumes)
        if samples is None:
            return None
        *at_nodes, of_cells = recovery.recovered(points, cells, samples, regions, mirrors)
        found.append(at_nodes)
    with open(base + ".frd", encoding="latin-1") as file:
        lines = file.readlines()
    values = _mixed(lines, nodes, found)
    if values is None:
        return None
    with open(base + ".frd", "w", encoding="latin-1") as file:
        file.writelines(lines)
    return Recovered(nodes, points, cells, samples, values, found[-1][1], of_cells)


def mark(results, recovered):
    """Has result objects say what their stresses are."""
    for result in results:
        if not hasattr(result, _PROPERTY):
            meaning = "Whether stresses are recovered from the integration points, or extrapolated by CalculiX"
            result.addProperty("App::PropertyString", _PROPERTY, "NodeData", meaning)
        setattr(result, _PROPERTY, RECOVERED if recovered else CALCULIX)


def _printed(text):
    """([rows of a print: cell, integration point, six stresses], the text without them)"""
    import numpy

    found, rest, at = [], [], 0
    for head in _PRINTED.finditer(text):
        first = head.end() + 1  # a line is empty
        last = text.find("\n\n", first)
        last = len(text) if last < 0 else last + 1
        rest.append(text[at : head.start()])
        found.append(numpy.array(text[first:last].split(), float).reshape(-1, 8))
        at = last
    return found, "".join(rest) + text[at:]


def _by_cell(rows, volumes):
    """(m, 8, 6) stresses at 2 x 2 x 2 points of the volumes; None where those of one are not there, or not those of a cell with 20 nodes."""
    import numpy

    rows = rows[numpy.lexsort((rows[:, 1], rows[:, 0]))]
    numbers, first, count = numpy.unique(rows[:, 0].astype(int), return_index=True, return_counts=True)
    at = numpy.searchsorted(numbers, volumes)
    if len(numbers) != len(volumes) or not (numbers[at] == volumes).all():
        return None
    first, count = first[at], count[at]
    found = numpy.zeros((len(volumes), 8, 6))
    for points in numpy.unique(count):
        if points not in (8, 27):
            return None
        these = numpy.flatnonzero(count == points)
        samples = rows[first[these][:, None] + numpy.arange(points)][:, :, 2:][:, :, _AS_IN_RESULTS]
        found[these] = recovery.at_superconvergent(samples)
    return found


def _regions(mesh, volumes, materials):
    """A number for each volume, another for each solid and for each material."""
    import numpy

    found, row = numpy.zeros(len(volumes), int), {volume: row for row, volume in enumerate(volumes.tolist())}
    for lists in (mesh.solids(), materials):
        found *= len(lists) + 1
        for number, elements in enumerate(lists, 1):
            found[[row[element] for element in elements if element in row]] += number
    return found


def _mixed(lines, nodes, found):
    """Mixes recovered stresses into the lines of a result file, in place, as far as they are to be trusted; returns the last, None where there are not as many.

    found: [(stresses at nodes, trust)].
    """
    import numpy

    starts = [number for number, line in enumerate(lines) if line.startswith(" -4  STRESS ")]
    if not starts or len(starts) != len(found):
        return None
    for start, (values, trust) in zip(starts, found):
        last = next(number for number in range(start, len(lines)) if lines[number].startswith(" -3"))
        of_line = {number: int(lines[number][3:13]) for number in range(start, last) if lines[number].startswith(" -1")}
        numbers = [number for number, node in of_line.items() if node <= nodes[-1]]  # those beyond are the ground of springs and the like
        at = numpy.searchsorted(nodes, [of_line[number] for number in numbers])
        own = numpy.array([[float(lines[number][i : i + 12]) for i in range(13, 85, 12)] for number in numbers])
        mixed = values.copy()
        mixed[at] = own + trust[at, None] * (values[at] - own)
        mixed[numpy.abs(mixed) < _SMALLEST] = 0
        for number, row in zip(numbers, mixed[at].tolist()):
            lines[number] = lines[number][:13] + ("{:12.5E}" * 6).format(*row) + "\n"
    return mixed
