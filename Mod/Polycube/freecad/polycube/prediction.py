"""How many cells a mesh will have, told before it is made: an estimate from the shape alone, for the labels are not known yet."""

import math

from . import option_table

#: The size that the engine takes where none is given: a share of the bounding box's diagonal. Round circles and in walls it takes smaller ones.
DIAGONALS = 20
#: A count is worth a question where local sizes make it so many times that without them, and so large; guesses of what surprises.
_TIMES, _MANY = 10, 20000
#: Elements through walls where nothing is said, by element order, as the engine has it.
_LAYERS = {1: 3, 2: 2}
#: Half the side of the square that a circle becomes in the blocks, in radii.
_SQUARE = math.sqrt(0.5)
#: Share of the part's size below which two places are one.
_SAME = 1e-6


class Prediction:
    """`plain`: cells without local sizes; `cells`: with them, at most."""

    def __init__(self, plain, cells):
        self.plain, self.cells = plain, max(plain, cells)

    def is_startling(self):
        """Whether local sizes make so many cells that the user may not have thought of it."""
        return self.cells > _TIMES * self.plain and self.cells > _MANY


def size_of(shape, options):
    """The edge length that the options give cells where nothing asks for smaller ones, mm."""
    if options.get("hexes"):
        return (shape.Volume / options["hexes"]) ** (1 / 3)
    longest = shape.BoundBox.DiagonalLength / DIAGONALS
    return options.get("size") or min(options.get("max_size") or longest, longest)


def predict(shape, options):
    """A Prediction, or None where there is none: of the coarsest mesh, of what cannot be read.

    A grid goes through the whole part: what asks for smaller cells at a place makes them smaller in all layers of the grid through it. Per axis there are
    stretches with a size each, of circles, of walls and of local sizes at faces; how deep the blocks at a face are is not known, so those of local sizes
    are taken for blocks through the whole part.
    """
    if options.get("coarsest") or not shape.Volume > 0:
        return None
    try:
        faces, axes = _local(options.get("sizes") or "")
    except ValueError:
        return None
    if not all(1 <= number <= len(shape.Faces) for number in faces):
        return None
    defaults = {option["name"]: option["default"] for option in option_table.table()}
    asked = {**defaults, **options}
    boxes = [_box(face) for face in shape.Faces]
    whole, size = _box(shape), size_of(shape, options)
    stretches = [[], [], []]
    layers = asked["min_layers"] or _LAYERS[asked["order"]]
    barrels = list(_barrels(shape, boxes))
    _add_walls(shape, boxes, layers, stretches)
    _add_round_walls(barrels, layers, stretches)
    if asked.get("per_circle"):
        _add_circles(barrels, asked["per_circle"], stretches)
    plain = _cells(shape, whole, stretches, [size] * 3)
    for number, local in faces.items():
        for axis, (low, high) in enumerate(boxes[number - 1]):
            flat = high - low < _SAME * (whole[axis][1] - whole[axis][0])
            stretches[axis].append((*(whole[axis] if flat else (low, high)), local))
    refined = _cells(shape, whole, stretches, [axes.get(name, size) for name in "XYZ"])
    if options.get("hexes"):  # the engine meets it, whatever asks for smaller cells
        return Prediction(options["hexes"], options["hexes"] * refined / plain)
    return Prediction(plain, refined)


def predict_again(shape, options, meshed_options, cells):
    """As predict(), by what a mesh of the shape with other options has come to: what the shape alone does not tell, as the layers that round faces get, is in it."""
    expected = predict(shape, options)
    before = predict(shape, meshed_options)
    if not expected or not before:
        return expected
    if options.get("hexes"):
        return expected  # the engine meets it
    factor = cells / before.cells
    return Prediction(factor * expected.plain, factor * expected.cells)


def _box(shape):
    box = shape.BoundBox
    return (box.XMin, box.XMax), (box.YMin, box.YMax), (box.ZMin, box.ZMax)


def _cells(shape, whole, stretches, sizes):
    """Of the grid over the part's box, the share that is in the part."""
    cells = shape.Volume
    for axis, (low, high) in enumerate(whole):
        cells *= _cells_along(low, high, stretches[axis], sizes[axis]) / (high - low)
    return cells


def _cells_along(low, high, stretches, size):
    """Cells from low to high: in every piece the least size that is asked for there."""
    ends = sorted({low, high, *(end for start, stop, _ in stretches for end in (start, stop) if low < end < high)})
    cells = 0.0
    for start, stop in zip(ends, ends[1:]):
        cells += (stop - start) / min([size] + [local for first, last, local in stretches if first <= start and stop <= last])
    return max(cells, 1)


def _barrels(shape, boxes):
    """(radius, axes that it is round in, box) of the cylinders along an axis that go all the way round."""
    for face, box in zip(shape.Faces, boxes):
        if face.Surface.TypeId == "Part::GeomCylinder":
            radius = face.Surface.Radius
            along = max(range(3), key=lambda axis: abs(face.Surface.Axis[axis]))
            round_axes = [axis for axis in range(3) if axis != along]
            if all(abs(box[axis][1] - box[axis][0] - 2 * radius) < 0.01 * radius for axis in round_axes):
                yield radius, round_axes, box


def _add_circles(barrels, per_circle, stretches):
    """A quarter of a full circle's elements is on each side of the square that it becomes."""
    for radius, axes, box in barrels:
        for axis in axes:
            middle, half = sum(box[axis]) / 2, _SQUARE * radius
            stretches[axis].append((middle - half, middle + half, 2 * half / (per_circle / 4)))


def _add_round_walls(barrels, layers, stretches):
    """Between a cylinder and the next larger one about the same line."""
    for inner, axes, box in barrels:
        about = [radius for radius, others, other in barrels if radius > inner and others == axes and _same_middle(box, other, axes, inner)]
        if not about:
            continue
        for axis in axes:
            middle, start, stop = sum(box[axis]) / 2, _SQUARE * inner, _SQUARE * min(about)
            for low, high in ((middle + start, middle + stop), (middle - stop, middle - start)):
                stretches[axis].append((low, high, (stop - start) / layers))


def _same_middle(a, b, axes, radius):
    return all(abs(sum(a[axis]) - sum(b[axis])) < 0.01 * radius for axis in axes)


def _add_walls(shape, boxes, layers, stretches):
    """Between plane faces across an axis that look away from each other, where nothing of the part's faces is between them: the nearest of each."""
    plane = [face.Surface.TypeId == "Part::GeomPlane" for face in shape.Faces]
    for axis in range(3):
        scale = _SAME * max(shape.BoundBox.DiagonalLength, 1e-30)
        up, down = [], []
        for number, box in enumerate(boxes):
            if plane[number] and box[axis][1] - box[axis][0] < scale:
                normal = shape.Faces[number].normalAt(0, 0)
                (up if normal[axis] > 0 else down).append(number)
        for top in up:
            below = [(boxes[top][axis][0], boxes[bottom][axis][0]) for bottom in down if _overlap(boxes[top], boxes[bottom], axis, scale)]
            gaps = [(high - low, low, high) for high, low in below if high - low > scale]
            if gaps:
                thickness, low, high = min(gaps)
                stretches[axis].append((low, high, thickness / layers))


def _overlap(a, b, axis, scale):
    return all(min(a[other][1], b[other][1]) - max(a[other][0], b[other][0]) > scale for other in range(3) if other != axis)


def _local(sizes):
    """({face number: size}, {axis: size}) of the option "sizes", as text or as a dict."""
    if isinstance(sizes, str):
        sizes = dict(item.split("=") for item in sizes.replace(" ", "").split(",") if item)
    faces, axes = {}, {}
    for name, size in sizes.items():
        size = float(size)
        if not (size > 0 and math.isfinite(size)):
            raise ValueError
        if name.startswith("Face"):
            faces[int(name[4:])] = size
        else:
            axes[name] = size
    return faces, axes
