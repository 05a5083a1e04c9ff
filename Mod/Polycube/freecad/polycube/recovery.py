"""Stresses at nodes, recovered from those at integration points: Zienkiewicz and Zhu's superconvergent patch recovery (1992) for hexahedra with 20 nodes.

The stresses of such cells are most exact at 2 x 2 x 2 points inside them; CalculiX extrapolates them from there to the nodes cell by cell, linearly. Here a
polynomial of third degree is fitted to the points of all cells round a corner inside the part, by least squares, and nodes get its values: a corner inside
those of its own, the middle of an edge the mean of those of its ends, a node on the boundary the mean of those of the corners inside, in the cells that it is
part of (measured: better than more of what is near). Cells of different regions, which are solids and materials, have patches of their own, so the jump of stresses between two materials stays.

Where the polynomials miss the points, as at edges where stresses have no limit, and in cells without a corner inside, as in a plate with one layer of them,
they are not to be trusted: there CalculiX's stresses are better. Theory: the sample points, the degree (one above the displacements').
"""

import itertools

from . import serendipity

#: Guess: weight against quadratic and cubic terms, a share of a sample's: what samples do not tell apart is left out. Linear stresses are reproduced in any case.
_RIDGE = {2: 1e-10, 3: 1e-6}
#: Measured: share of the samples' size by which they miss the polynomials, where these are right and where they are not to be used. On the demo's bracket (9,795
#: nodes, against 64,856) recovered stresses have half the error of CalculiX's below the first, the same between, and none less above the second. A tube with
#: four cells through its wall has 0.009; clamped edges and corners that point inwards of an L 0.06 to 0.09, a step in a shaft 0.15, the bracket 0.13 to 0.23.
_MISFIT = (0.02, 0.04)
#: exponents of the terms of a polynomial in three directions, of third degree
_POWERS = sorted((powers for powers in itertools.product(range(4), repeat=3) if sum(powers) <= 3), key=sum)
#: directions of the components of a stress, in CalculiX's order in result files
_COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
#: corners and middles of edges of the sides of a cell
_SIDES = (
    (0, 1, 2, 3, 8, 9, 10, 11),
    (4, 5, 6, 7, 12, 13, 14, 15),
    (0, 1, 5, 4, 8, 17, 12, 16),
    (1, 2, 6, 5, 9, 18, 13, 17),
    (2, 3, 7, 6, 10, 19, 14, 18),
    (3, 0, 4, 7, 11, 16, 15, 19),
)
#: corners at the ends of the edges whose middles are nodes 8 to 19
_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
#: numbers in an array of those that are made at once
_AT_ONCE = 4_000_000


def recovered(points, cells, samples, regions=None, mirrors=()):
    """(stresses xx yy zz xy yz zx at nodes (n, 6); how far they can be trusted (n,), 1 wholly, 0 not at all; stresses at the nodes of each cell (m, 20, 6)).

    points: (n, 3). cells: (m, 20), rows of points, in CalculiX's order. samples: (m, 8, 6), stresses at 2 x 2 x 2 points, see at_superconvergent.
    regions: (m,) numbers. mirrors: (axis, nodes on a plane across it) of planes of symmetry. A node between regions gets the mean of theirs, and the
    least trust; in each cell it has that of the cell's own.
    """
    import numpy

    regions = numpy.zeros(len(cells), int) if regions is None else numpy.asarray(regions)
    # A node has a twin in each of its regions.
    keys, split = numpy.unique(regions[:, None] * len(points) + cells, return_inverse=True)
    split, node = split.reshape(cells.shape), keys % len(points)
    whole = points[node], split, samples, sample_places(points, cells)
    on = [(axis, numpy.isin(node, nodes)) for axis, nodes in mirrors]
    values, misfit = (array[: len(node)] for array in _of_one(*_with_images(*whole, on)))
    count, trust = numpy.bincount(node, minlength=len(points)), numpy.ones(len(points))
    total = numpy.stack([numpy.bincount(node, values[:, k], len(points)) for k in range(6)], axis=1)
    least, most = _MISFIT
    numpy.minimum.at(trust, node, numpy.clip((most - misfit) / (most - least), 0, 1))
    return total / numpy.maximum(count, 1)[:, None], numpy.where(count, trust, 0), values[split]


def gauss(count):
    """(places, weights) of count^3 Gauss points of a cell, in CalculiX's order: the first direction changes first."""
    import numpy

    at, weight = numpy.polynomial.legendre.leggauss(count)
    places = numpy.array([(a, b, c) for c in at for b in at for a in at])
    return places, numpy.array([a * b * c for c in weight for b in weight for a in weight])


def sample_places(points, cells):
    """(m, 8, 3), places of the samples."""
    import numpy

    shapes = numpy.array([serendipity.shape_functions(20, place)[0] for place in gauss(2)[0]])
    return numpy.einsum("pn,mnd->mpd", shapes, points[cells])


def at_superconvergent(samples):
    """(m, 8, 6): those of 3 x 3 x 3 points by the trilinear function next to them, which is as exact there as theirs of 2 x 2 x 2."""
    import numpy

    if samples.shape[1] == 8:
        return samples
    many, weights = gauss(3)
    terms, few = (numpy.stack([at[:, 0] ** a * at[:, 1] ** b * at[:, 2] ** c for a, b, c in itertools.product(range(2), repeat=3)], 1) for at in (many, gauss(2)[0]))
    fit = numpy.linalg.solve((terms * weights[:, None]).T @ terms, (terms * weights[:, None]).T)
    return numpy.einsum("pq,mqs->mps", few @ fit, samples)


def _of_one(points, cells, samples, places):
    """(stresses, misfit of the patches that they are from) of nodes, none of which is shared by two regions; the misfit of one without a patch is endless."""
    import numpy

    corners = cells[:, :8]
    inside = numpy.zeros(len(points), bool)
    inside[corners] = True
    inside[boundary(cells, len(points))] = False
    centres, turns, terms, misfits = _fits(inside, corners, samples, places)
    patches, nodes = _pairs(inside, cells)
    total, count = numpy.zeros((len(points), 6)), numpy.bincount(nodes, minlength=len(points))
    for part in numpy.array_split(numpy.arange(len(patches)), 1 + len(patches) * len(_POWERS) * 6 // _AT_ONCE):
        patch, node = patches[part], nodes[part]
        local = numpy.einsum("pd,pde->pe", points[node] - centres[patch], turns[patch])
        numpy.add.at(total, node, numpy.einsum("pk,pks->ps", _polynomials(local), terms[patch]))
    misfit = numpy.where(count, numpy.bincount(nodes, misfits[patches], len(points)), numpy.inf)
    return total / numpy.maximum(count, 1)[:, None], misfit / numpy.maximum(count, 1)


def _with_images(points, cells, samples, places, mirrors):
    """The same with the images of the cells that touch planes of symmetry: nodes on these are inside then. mirrors: (axis, whether each node is on it)."""
    import numpy

    mirrors = list(mirrors)
    for number, (axis, on) in enumerate(mirrors):
        touching = on[cells[:, :8]].any(axis=1)
        old = numpy.setdiff1d(cells[touching], numpy.flatnonzero(on))
        image = numpy.arange(len(points))
        image[old] = len(points) + numpy.arange(len(old))
        plane = points[on, axis].mean()
        signs = numpy.array([-1.0 if axis in pair and pair[0] != pair[1] else 1.0 for pair in _COMPONENTS])
        flip = numpy.where(numpy.arange(3) == axis, -1.0, 1.0)
        shift = numpy.where(numpy.arange(3) == axis, 2 * plane, 0.0)
        points = numpy.concatenate([points, points[old] * flip + shift])
        places = numpy.concatenate([places, places[touching] * flip + shift])
        cells = numpy.concatenate([cells, image[cells[touching]]])
        samples = numpy.concatenate([samples, samples[touching] * signs])
        mirrors[number + 1 :] = [(later, numpy.concatenate([those, those[old]])) for later, those in mirrors[number + 1 :]]
    return points, cells, samples, places


def boundary(cells, count):
    """(q, 8) nodes of the sides that only one cell has; count: of all nodes. A side is known by three of its corners, the lowest."""
    import numpy

    sides = numpy.concatenate([cells[:, list(side)] for side in _SIDES])
    low = numpy.sort(sides[:, :4], axis=1).astype(numpy.int64)
    _, index, times = numpy.unique((low[:, 0] * count + low[:, 1]) * count + low[:, 2], return_inverse=True, return_counts=True)
    return sides[times[index] == 1]


def _fits(inside, corners, samples, places):
    """Of each corner inside: centre and axes of its patch, in which its samples are as wide as from -1 to 1, the terms of its polynomials, and by what share
    of their size the samples miss these.
    """
    import numpy

    count, powers = len(inside), len(_POWERS)
    centres, turns, terms = numpy.zeros((count, 3)), numpy.zeros((count, 3, 3)), numpy.zeros((count, powers, 6))
    misfits = numpy.zeros(count)
    around = numpy.argsort(corners.ravel(), kind="stable") // 8
    cells_of = numpy.bincount(corners.ravel(), minlength=count)
    first = numpy.cumsum(cells_of) - cells_of
    ridge = numpy.array([_RIDGE.get(sum(power), 0.0) for power in _POWERS])
    for number in numpy.unique(cells_of[inside]):
        all_nodes = numpy.flatnonzero(inside & (cells_of == number))
        for nodes in numpy.array_split(all_nodes, 1 + len(all_nodes) * number * 8 * powers // _AT_ONCE):
            cells = around[first[nodes][:, None] + numpy.arange(number)]
            x, s = places[cells].reshape(len(nodes), -1, 3), samples[cells].reshape(len(nodes), -1, 6)
            centre = x.mean(axis=1)
            x = x - centre[:, None]
            spread, axes = numpy.linalg.eigh(x.transpose(0, 2, 1) @ x / x.shape[1])
            turn = axes / numpy.sqrt(3 * spread)[:, None, :]  # equal samples from -1 to 1 have a third
            rows = _polynomials(x @ turn)
            matrix = rows.transpose(0, 2, 1) @ rows / x.shape[1] + numpy.diag(ridge)
            terms[nodes] = numpy.linalg.solve(matrix, rows.transpose(0, 2, 1) @ s / x.shape[1])
            centres[nodes], turns[nodes] = centre, turn
            size = numpy.sqrt((s**2).sum(axis=(1, 2)))
            misfits[nodes] = numpy.sqrt(((rows @ terms[nodes] - s) ** 2).sum(axis=(1, 2))) / numpy.where(size, size, 1)
    return centres, turns, terms, misfits


def _polynomials(at):
    """(..., 20) values of the terms, products of Legendre's polynomials, at places (..., 3)."""
    import numpy

    of = [numpy.ones_like(at), at, (3 * at * at - 1) / 2, (5 * at * at - 3) * at / 2]
    return numpy.stack([of[a][..., 0] * of[b][..., 1] * of[c][..., 2] for a, b, c in _POWERS], axis=-1)


def _pairs(inside, cells):
    """(patches, nodes): which patch, called by its corner, gives a value to which node."""
    import numpy

    count = len(inside)
    own = numpy.flatnonzero(inside)
    ends = cells[:, list(_EDGES)].reshape(-1, 2)
    middles = numpy.repeat(cells[:, 8:].reshape(-1, 1), 2, axis=1)
    of_ends = ends[inside[ends]] * count + middles[inside[ends]]
    pairs = numpy.unique(numpy.concatenate([own * count + own, of_ends]))
    reached = numpy.zeros(count, bool)
    reached[pairs % count] = True
    rest = []
    for corner in range(8):
        wanted = ~reached[cells] & inside[cells[:, corner]][:, None]
        rest.append((cells[:, corner, None] * count + cells)[wanted])
    pairs = numpy.unique(numpy.concatenate([pairs, *rest]))
    return pairs // count, pairs % count
