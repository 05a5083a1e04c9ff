"""Measures of hexahedra, as the mesher has them (backend/core/quality.h): by the corners alone, each with a share of goodness from 0 to 1."""

from dataclasses import dataclass

import numpy

from . import engine
from .words import noop

#: A bar of a histogram is a tenth of goodness.
BARS = 10

# Corners in VTK's order: the neighbours of each along x, y, z as a right-handed triple, and the sides.
_NEIGHBOURS = [[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]]
_EDGES = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
SIDES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
_SIGNS = numpy.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])


def _unit(vectors):
    """Along the last axis; zero where a vector has no length."""
    lengths = numpy.linalg.norm(vectors, axis=-1, keepdims=True)
    return numpy.divide(vectors, lengths, out=numpy.zeros_like(vectors), where=lengths > 0)


def scaled_jacobian(corners):
    """Of every cell, from an array (cells, 8, 3): the least of the eight corners' determinants of unit edges; 1 is a cube, 0 and below inverted."""
    least = numpy.ones(len(corners))
    for corner, neighbours in enumerate(_NEIGHBOURS):
        edges = corners[:, neighbours] - corners[:, corner, None]
        lengths = numpy.linalg.norm(edges, axis=2).prod(axis=1)
        determinant = numpy.divide(numpy.linalg.det(edges), lengths, out=numpy.full(len(corners), -1.0), where=lengths > 0)
        least = numpy.minimum(least, determinant)
    return least


def edge_ratio(corners):
    """The longest edge over the shortest: 1 is best."""
    ends = corners[:, _EDGES]
    lengths = numpy.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2)
    least = lengths.min(axis=1)
    return numpy.divide(lengths.max(axis=1), least, out=numpy.full(len(corners), numpy.inf), where=least > 0)


def skew(corners):
    """The largest cosine between the three principal axes: 0 is best, 1 worst."""
    axes = _unit(numpy.einsum("cd,ncx->ndx", _SIGNS, corners))
    flat = (numpy.linalg.norm(axes, axis=2) == 0).any(axis=1)
    cosines = [numpy.abs(numpy.einsum("nx,nx->n", axes[:, a], axes[:, b])) for a, b in ((0, 1), (1, 2), (2, 0))]
    return numpy.where(flat, 1.0, numpy.minimum(numpy.max(cosines, axis=0), 1.0))


def warpage(corners):
    """Of the most warped side, 1 less the smaller cube of the cosines between opposite corners' normals: 0 is plane, 2 worst."""
    worst = numpy.zeros(len(corners))
    for side in SIDES:
        at = corners[:, side]
        normals = _unit(numpy.cross(numpy.roll(at, -1, axis=1) - at, numpy.roll(at, 1, axis=1) - at))
        across = numpy.minimum(*(numpy.einsum("nx,nx->n", normals[:, k], normals[:, k + 2]) for k in (0, 1)))
        worst = numpy.maximum(worst, 1 - across**3)
    return worst


def bar_of(goodness):
    """The bar, 0 to BARS - 1 from bad to good, in which a goodness counts; of an array those of its numbers."""
    return numpy.clip(numpy.ceil(BARS * numpy.asarray(goodness)) - 1, 0, BARS - 1).astype(int)


@dataclass(frozen=True)
class Measure:
    """One way to judge a cell. `goodness` of a value is 1 for a cube and 0 for the worst there is; `value` is its inverse."""

    name: str
    title: str
    of: object
    goodness: object
    value: object

    def bars(self, values):
        """Of an array of values."""
        return bar_of(self.goodness(values))

    def histogram(self, values):
        """Cells in each bar, from bad to good."""
        return numpy.bincount(self.bars(values), minlength=BARS).tolist()


MEASURES = [
    Measure("scaled_jacobian", noop("Scaled Jacobian"), scaled_jacobian, lambda value: value, lambda good: good),
    Measure("edge_ratio", noop("Edge ratio"), edge_ratio, lambda value: 1 / value, lambda good: 1 / good if good > 0 else float("inf")),
    Measure("skew", noop("Skew"), skew, lambda value: 1 - value, lambda good: 1 - good),
    Measure("warpage", noop("Warpage"), warpage, lambda value: 1 - value / 2, lambda good: 2 - 2 * good),
]


#: Cells or nodes that are worked on between two breaths: a few hundredths of a second. Meshes with more cells are large to the window.
SLICE = 20000


def _no_breath():
    """For callers without a window."""


class Cells:
    """The hexahedra of a Fem.FemMesh as arrays; measures are kept once computed.

    `breathe()` is called again and again in what takes long, for a window that is not to freeze; what it raises comes to the caller.
    """

    def __init__(self, mesh, breathe=_no_breath):
        self.numbers = numpy.array(mesh.Volumes, dtype=int)  #: of each cell in the mesh
        self.breathe = breathe
        nodes = self._in_slices(lambda some: [mesh.getElementNodes(number) for number in some], self.numbers.tolist(), int)
        used = numpy.zeros(nodes.max(initial=0) + 1, dtype=bool)
        used[nodes] = True
        self.node_numbers = numpy.flatnonzero(used).tolist()  #: those of cells
        #: Row i is node i; numbers that are not in use stay zero.
        self.points = numpy.zeros((len(used), 3))
        self.points[self.node_numbers] = self._in_slices(lambda some: [tuple(mesh.getNodeById(number)) for number in some], self.node_numbers, float, 3)
        #: node numbers of each cell, in VTK's order
        self.nodes = numpy.empty_like(nodes)
        order = engine.description()["smesh_hex20"][: nodes.shape[1]]
        self.nodes[:, order] = nodes
        self._values = {}

    @classmethod
    def of_result(cls, result, breathe=_no_breath):
        """The same from the arrays of a MeshResult, of which fem_mesh.build() makes the mesh; in no time, where reading the mesh takes some."""
        cells = cls.__new__(cls)
        cells.numbers = numpy.arange(1, len(result.hexes) + 1)
        cells.points = numpy.vstack([numpy.zeros((1, 3)), result.nodes])
        cells.node_numbers = list(range(1, len(cells.points)))
        cells.nodes = result.hexes + 1
        cells._values = {measure.name: getattr(result, measure.name) for measure in MEASURES}
        cells.breathe = breathe
        return cells

    def _in_slices(self, work, things, kind, width=8):
        """An array of what work() makes of all things, a slice at a time with a breath after each. `width`: of its rows if there are none."""
        found = []
        for start in range(0, len(things), SLICE):
            found.append(numpy.array(work(things[start : start + SLICE]), dtype=kind))
            self.breathe()
        return numpy.concatenate(found) if found else numpy.zeros((0, width), dtype=kind)

    def corners(self, chosen=slice(None)):
        """(cells, 8, 3)"""
        return self.points[self.nodes[chosen, :8]]

    def values(self, measure):
        """One number for every cell."""
        if measure.name not in self._values:
            self._values[measure.name] = self._in_slices(lambda some: measure.of(self.corners(some)), numpy.arange(len(self.numbers)), float).ravel()
        return self._values[measure.name]

    def worst(self, measure, count):
        """Indices of the worst cells by this measure, the worst first; equal ones in the order of the mesh."""
        return numpy.argsort(measure.goodness(self.values(measure)), kind="stable")[:count]

    def node_goodness(self, measure):
        """For each of node_numbers the goodness of the worst of its cells."""
        worst = numpy.ones(len(self.points))
        good = measure.goodness(self.values(measure))
        order = numpy.argsort(-good, kind="stable")
        worst[self.nodes[order]] = good[order, None]  # of several values for one node the last stays, which is the least
        return worst[self.node_numbers]
