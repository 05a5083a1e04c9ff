"""Quality in colours: one scale for the bars of the histogram, the nodes of the mesh and the cells that are shown by themselves."""

from .measures import BARS, bar_of

#: What FreeCAD paints for the scalars -1, -0.5, 0, 0.5 and 1, with straight lines between, if those given reach from -1 to 1.
_SCALE = [(0, 0, 1), (0, 1, 1), (0, 1, 0), (1, 1, 0), (1, 0, 0)]
#: The golden section of a turn: however many hues are taken one after the other, they stay apart.
_TURN = (5**0.5 - 1) / 2
#: The scalar of the best bar: at -1, pure blue, mesh edges can hardly be seen.
_BEST = -0.7


def _scalar(bar):
    return 1 + (_BEST - 1) * bar / (BARS - 1)


def colour(bar):
    """(red, green, blue), 0 to 1 each, of a bar: red is bad, blue is good."""
    place = 2 * (_scalar(bar) + 1)
    below = min(int(place), len(_SCALE) - 2)
    return tuple(a + (place - below) * (b - a) for a, b in zip(_SCALE[below], _SCALE[below + 1]))


def block_colours(blocks):
    """(cells, 3), 0 to 1, of an array with the block of each cell: neighbours in number, as blocks beside each other often are, are far apart in hue."""
    import colorsys

    import numpy

    numbers, which = numpy.unique(blocks, return_inverse=True)
    palette = [colorsys.hsv_to_rgb(rank * _TURN % 1, (0.45, 0.7)[rank % 2], (0.95, 0.8)[rank // 2 % 2]) for rank in range(len(numbers))]
    return numpy.array(palette)[which.ravel()]


def paint(view, cells, measure):
    """Paints the nodes of a view object by the worst of their cells.

    FreeCAD's `NodeColor` would take any colour, in a time that grows with the square of the nodes: a minute for 100,000.
    """
    numbers = cells.node_numbers
    bars = bar_of(cells.node_goodness(measure))
    # FreeCAD's scale goes from the least to the greatest scalar: two nodes that the mesh does not have hold its ends.
    beyond = [max(numbers) + 1, max(numbers) + 2]
    view.setNodeColorByScalars(numbers + beyond, _scalar(bars).tolist() + [-1.0, 1.0])
