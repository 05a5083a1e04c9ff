"""The hexahedron with 20 nodes, of the serendipity family, and the one with its 8 corners alone: places of the nodes, shape functions.

In coordinates from -1 to 1 (Zienkiewicz, Taylor: The Finite Element Method, chapter on shape functions).
"""

import numpy

#: places of the 20 nodes of a cell in SMESH's order: corners, then the middles of edges below, above, upright
CORNERS = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))
MIDDLES = ((0, -1, -1), (1, 0, -1), (0, 1, -1), (-1, 0, -1), (0, -1, 1), (1, 0, 1), (0, 1, 1), (-1, 0, 1), (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0))


def shape_functions(count, at):
    """(values, slopes along three directions) of the shape functions of a cell with 8 or 20 nodes."""
    corner, middle = numpy.array(CORNERS, float), numpy.array(MIDDLES, float)
    terms = 1 + corner * at
    value = terms.prod(axis=1) / 8
    slope = numpy.stack([corner[:, k] * numpy.delete(terms, k, 1).prod(axis=1) / 8 for k in range(3)], axis=1)
    if count == 8:
        return value, slope
    bend = (corner * at).sum(axis=1) - 2
    slope = slope * bend[:, None] + value[:, None] * corner
    # along the edge of a middle 1 - x^2, across it 1 + its place times x
    ends = numpy.where(middle == 0, 1 - at**2, 1 + middle * at)
    turns = numpy.where(middle == 0, -2 * at, middle)
    middles = ends.prod(axis=1) / 4
    slopes = numpy.stack([turns[:, k] * numpy.delete(ends, k, 1).prod(axis=1) / 4 for k in range(3)], axis=1)
    return numpy.concatenate([value * bend, middles]), numpy.concatenate([slope, slopes])
