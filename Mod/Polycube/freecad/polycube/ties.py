"""Ties in an input file of CalculiX: how far from the other face nodes may be that are tied to it, and which of them were not.

FreeCAD's constraint has a tolerance of 0 until the user sets another, and CalculiX then ties only nodes that are on the other face: hardly any where two meshes
meet on a bore. It leaves out the others with a warning that nobody sees.
"""

import os
import re

from .words import tr

#: ending of the file in which CalculiX lists the nodes that it did not tie
MISSED = "_WarnNodeMissTiedContact.nam"
#: Theory: eight cells of first order round a circle leave a tenth of their edges between their middles and the circle. On plane faces there is nothing between.
_REACH = 0.1
#: Guess: share of an edge up to which a node that is not tied belongs to the other face; a face that is meant is nearer than half a cell
_FAR = 0.5
#: samples along an edge of a side; Guess: eight intervals, a sixteenth of an edge off at most
_PLACES = 9
_CARD = re.compile(r"^(\*TIE\s*,.*POSITION TOLERANCE=)([^,\s]+)(.*NAME=TIE(\w+).*)$", re.MULTILINE)


def with_reaches(text, ties, mesh):
    """(the text, lines on it): nodes may be as far from the other face as those of two meshes on one surface are, where the constraint says 0.

    ties: FreeCAD's entries of the constraints. mesh: a GroupedMesh.
    """
    notes, by_name = [], {entry["Object"].Name: entry for entry in ties}

    def card(found):
        entry = by_name.get(found.group(4))
        if not entry or float(found.group(2)) != 0:
            return found.group(0)
        reach = _REACH * _edge(_points(mesh, _numbers(mesh, entry["TieMasterFaces"])))
        notes.append(tr("{}: its tolerance is 0; nodes within {:.3g} mm of the other face are tied").format(entry["Object"].Label, reach))
        return "{}{:.4G}{}".format(found.group(1), reach, found.group(3))

    return _CARD.sub(card, text), notes


def not_tied(path, ties, mesh):
    """Lines on constraints with nodes at the other face that CalculiX did not tie. path: the input file that was run. Nodes beside the other face are not meant."""
    import numpy

    try:
        with open(os.path.splitext(path)[0] + MISSED, encoding="utf-8") as file:
            missed = {int(line) for line in file if line.strip().isdigit()}
    except FileNotFoundError:
        return []
    notes = []
    for entry in ties:
        slaves = set(_numbers(mesh, entry["TieSlaveFaces"]).ravel().tolist())
        mine = sorted(slaves & missed)
        if not mine:
            continue
        numbers = _numbers(mesh, entry["TieMasterFaces"])
        master = _points(mesh, numbers)
        gaps, beside = _nearest(_points(mesh, numpy.array(mine)), _samples(master), _on_outline(numbers))
        near = int((~beside & (gaps < _FAR * _edge(master))).sum())
        if near:
            line = tr("{}: {} of {} nodes are at the other face and not tied to it; its tolerance may be too small")
            notes.append(line.format(entry["Object"].Label, near, len(slaves)))
    return notes


def _numbers(mesh, sides):
    """(q, 4 or 8) nodes of the mesh faces that are the sides [cell, number of a side]."""
    import numpy

    wanted = {tuple(side) for side in sides}
    return numpy.array([mesh.getElementNodes(quad) for quad, side in mesh.sides().items() if side in wanted])


def _points(mesh, numbers):
    """(..., 3) places of nodes."""
    import numpy

    places = mesh.Nodes
    return numpy.array([places[node][:] for node in numbers.ravel().tolist()]).reshape(*numbers.shape, 3)


def _edge(points):
    """Mean length of the edges of sides."""
    import numpy

    corners = points[:, :4]
    return float(numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2).mean())


def _grid():
    """(places (p, 1) along both directions of a side)"""
    import numpy

    at = numpy.linspace(-1, 1, _PLACES)
    return [grid.ravel()[:, None] for grid in numpy.meshgrid(at, at)]


def _samples(points):
    """(n, 3) places on sides."""
    import numpy

    r, s = _grid()
    corner_r, corner_s = numpy.array([-1, 1, 1, -1]), numpy.array([-1, -1, 1, 1])
    shapes = (1 + corner_r * r) * (1 + corner_s * s) / 4
    if points.shape[1] == 8:
        shapes = shapes * (corner_r * r + corner_s * s - 1)
        middles = [(1 - r**2) * (1 - s) / 2, (1 + r) * (1 - s**2) / 2, (1 - r**2) * (1 + s) / 2, (1 - r) * (1 - s**2) / 2]
        shapes = numpy.concatenate([shapes, *middles], axis=1)
    return numpy.einsum("pn,qnd->qpd", shapes, points).reshape(-1, 3)


def _on_outline(numbers):
    """(n,) whether each of the samples is where all the sides together end: on an edge that only one of them has."""
    import numpy

    ends = numpy.sort(numpy.stack([numbers[:, :4], numpy.roll(numbers[:, :4], -1, axis=1)], axis=2), axis=2)
    _, which, times = numpy.unique(ends.reshape(-1, 2), axis=0, return_inverse=True, return_counts=True)
    alone = (times[which.ravel()] == 1).reshape(-1, 4)
    r, s = _grid()
    on_edge = numpy.concatenate([s == -1, r == 1, s == 1, r == -1], axis=1)
    return (alone[:, None, :] & on_edge[None]).any(axis=2).ravel()


def _nearest(places, samples, outline):
    """(distance to the nearest sample, whether that is on the outline) of each place."""
    import numpy

    squares, found = numpy.zeros(len(places)), numpy.zeros(len(places), int)
    for number, place in enumerate(places):
        row = ((samples - place) ** 2).sum(axis=1)
        found[number] = row.argmin()
        squares[number] = row[found[number]]
    return numpy.sqrt(squares), outline[found]
