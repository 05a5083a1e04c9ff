"""How many cells a mesh will have, told before it is made."""

import math

#: The largest size that the engine takes where none is given: a share of the bounding box's diagonal. Round circles and in walls it takes smaller ones.
DIAGONALS = 15
#: A count is worth a question where local sizes make it so many times that without them, and so large; guesses of what surprises.
_TIMES, _MANY = 10, 20000


class Prediction:
    """`plain`: cells without local sizes; `cells`: with them, at most."""

    def __init__(self, plain, cells):
        self.plain, self.cells = plain, max(plain, cells)

    def is_startling(self):
        return self.cells > _TIMES * self.plain and self.cells > _MANY


def size_of(shape, options):
    """The edge length that the options give cells away from local sizes, mm."""
    if options.get("hexes"):
        return (shape.Volume / options["hexes"]) ** (1 / 3)
    return options.get("size") or shape.BoundBox.DiagonalLength / DIAGONALS


def predict(shape, options):
    """A Prediction, or None where there is none: of the coarsest mesh, of what cannot be read.

    A grid goes through the whole part: a local size at a face makes all cells smaller that are in a layer with those at the face, along each axis over
    the extent of the face; how deep the blocks at the face are is not known before the labels are, so the count is one for blocks through the part.
    """
    if options.get("coarsest") or not shape.Volume > 0:
        return None
    size = size_of(shape, options)
    plain = shape.Volume / size**3
    try:
        faces, axes = _local(options.get("sizes") or "")
    except ValueError:
        return None
    box, factor = shape.BoundBox, 1.0
    for axis, name in enumerate("XYZ"):
        whole = (box.XLength, box.YLength, box.ZLength)[axis]
        base = axes.get(name, size)
        finest = {}
        for number, local in faces.items():
            if not 1 <= number <= len(shape.Faces):
                return None
            face = shape.Faces[number - 1].BoundBox
            least, most = ((face.XMin, face.XMax), (face.YMin, face.YMax), (face.ZMin, face.ZMax))[axis]
            finest[(least, most) if most - least > 1e-6 * whole else ((box.XMin, box.XMax), (box.YMin, box.YMax), (box.ZMin, box.ZMax))[axis]] = local
        factor *= _cells_along(whole, finest, base) * size / whole if whole > 0 else 1
    return Prediction(plain, plain * factor)


def _cells_along(whole, finest, base):
    """Cells along an axis: of intervals with a size each the least counts, elsewhere the base size."""
    ends = sorted({end for interval in finest for end in interval})
    covered = cells = 0.0
    for low, high in zip(ends, ends[1:]):
        sizes = [size for (least, most), size in finest.items() if least <= low and high <= most]
        if sizes:
            covered += high - low
            cells += (high - low) / min([base, *sizes])
    return cells + max(whole - covered, 0) / base


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
