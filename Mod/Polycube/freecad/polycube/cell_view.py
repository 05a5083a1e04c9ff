"""Some cells of a mesh by themselves in the 3D view: those of a bar, those below a threshold, those on one side of a plane."""

import FreeCAD
import numpy
from pivy import coin

from . import measures, overlay

#: What cells have that are not painted by quality, as FreeCAD's meshes.
_PLAIN = (0.9, 0.65, 0.2)


class CellOverlay(overlay.Overlay):
    """Draws whole cells of a measures.Cells, which breathe meanwhile."""

    def __init__(self, document, standing, cells):
        self.cells = cells
        sides = cells.nodes[:, :8][:, measures.SIDES]  # (cells, 6, 4)
        self._sides = sides.reshape(-1, 4)
        # Three corners tell a side; as one number, they are sorted ten times as fast as rows.
        corners = numpy.sort(self._sides, axis=1).astype(numpy.int64)
        count = len(cells.points)
        keys = (corners[:, 0] * count + corners[:, 1]) * count + corners[:, 2]
        cells.breathe()
        _, first, twin = numpy.unique(keys, return_index=True, return_inverse=True)
        cells.breathe()
        twin = twin.ravel()
        # The cell behind each side, -1 at the boundary: of two equal sides each finds the other.
        other = numpy.full(len(self._sides), -1)
        second = numpy.full(len(first), -1)
        later = numpy.flatnonzero(first[twin] != numpy.arange(len(twin)))
        second[twin[later]] = later
        other[later] = first[twin[later]] // 6
        has_two = second >= 0
        other[first[has_two]] = second[has_two] // 6
        self._behind = other
        cells.breathe()
        super().__init__(document, standing)

    def show(self, chosen, colours=None):
        """chosen: a truth for every cell. colours: (cells, 3), or None for plain ones. Returns the number of sides drawn."""
        cell = numpy.arange(len(self._sides)) // 6
        seen = chosen[cell] & ~numpy.where(self._behind >= 0, chosen[self._behind], False)
        paint = numpy.tile(_PLAIN, (len(chosen), 1)) if colours is None else colours
        if seen.any():
            self.draw(*overlay.quads(self.cells.points, self._sides[seen], paint[cell[seen]]))
        else:
            self.draw()
        return int(seen.sum())


class Hidden:
    """A mesh that is not drawn while something else is, without a change of the document."""

    def __init__(self, view):
        self._view, self._switch = view, view.SwitchNode
        self._before = -1
        self.again()

    def again(self):
        """Hides it, where it was shown meanwhile."""
        shown = self._switch.whichChild.getValue()
        if shown != -1:
            self._before, self._switch.whichChild = shown, -1

    def end(self, is_there):
        """Draws it again, unless it was hidden in the document meanwhile. `is_there`: whether the mesh is still in its document."""
        if self._switch.whichChild.getValue() == -1 and (not is_there or self._view.Visibility):
            self._switch.whichChild = self._before


def zoom(document, standing, points, room=1.0):
    """Has the active view look at some points, with room around: so many times their extent."""
    view = overlay.view_of(document)
    if not view:
        return
    box = coin.SbBox3f()
    for point in points:
        box.extendBy(coin.SbVec3f(*standing.multVec(FreeCAD.Vector(*point))))
    centre = box.getCenter()
    reach = (0.5 + room) * max(box.getSize())
    for sign in (-1, 1):
        box.extendBy(centre + coin.SbVec3f(sign * reach, sign * reach, sign * reach))
    view.getCameraNode().viewBoundingBox(box, 1.0, 1.0)
