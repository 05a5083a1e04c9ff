"""The labels of a part in the 3D view, in six colours, and the clicks that change them."""

import FreeCADGui
from pivy import coin
from PySide import QtCore

from . import engine
from .overlay import Overlay, depth, plain

#: In front of the part's own faces, and the borders of the charts in front of the labels: shares of the depth at which they are. FreeCAD draws a round face
#: within 0.5 % of the part's size, so the triangles of the labels are up to twice that behind it, and a corner near the eye has half of the view's depth.
_FACES_FORWARD, _LINES_FORWARD = 2e-2, 2.01e-2
#: Between the part and the polycube beside it, in widths of the part.
_GAP = 0.3


def key():
    """The six colours with their names, as rich text that is broken between them only."""
    pairs = zip(engine.description()["label_names"], engine.description()["label_colours"])
    return "&nbsp; ".join('<span style="color:rgb{}">&#9632;</span>&nbsp;{}'.format(tuple(colour), name.replace("-", "&#8209;")) for name, colour in pairs)


class LabelOverlay(Overlay):
    """Coloured triangles over the part in the active 3D view."""

    def show(self, labels):
        """Draws a LabelResult: charts in their labels' colours, borders of charts black, turning points red; beside it the polycube, where there is one."""
        drawn = [self._at(labels, labels.points)]
        if labels.image is not None:
            drawn.append(self._at(labels, beside(labels)))
        self.draw(*drawn)

    def _at(self, labels, places):
        points = coin.SoCoordinate3()
        points.point.setValues(0, len(places), places.tolist())
        drawn = coin.SoSeparator()
        for node in (points, depth(_FACES_FORWARD), *self._faces(labels), depth(_LINES_FORWARD), *self._borders(labels)):
            drawn.addChild(node)
        return drawn

    @staticmethod
    def _faces(labels):
        paint = coin.SoMaterial()
        paint.diffuseColor.setValues(0, 6, [tuple(channel / 255 for channel in colour) for colour in engine.description()["label_colours"]])
        binding = coin.SoMaterialBinding()
        binding.value = coin.SoMaterialBinding.PER_FACE_INDEXED
        hints = coin.SoShapeHints()
        hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
        hints.shapeType = coin.SoShapeHints.SOLID  # what faces away is behind the part
        hints.creaseAngle = 0.4
        faces = coin.SoIndexedFaceSet()
        indices = [index for triangle in labels.triangles.tolist() for index in (*triangle, -1)]
        faces.coordIndex.setValues(0, len(indices), indices)
        faces.materialIndex.setValues(0, len(labels.label), labels.label.tolist())
        return hints, paint, binding, faces

    @staticmethod
    def _borders(labels):
        style = coin.SoDrawStyle()
        style.lineWidth, style.pointSize = 2.5, 9
        beside, indices = {}, []
        for triangle, chart in zip(labels.triangles.tolist(), labels.chart.tolist()):
            for a, b in zip(triangle, triangle[1:] + triangle[:1]):
                if beside.setdefault((min(a, b), max(a, b)), chart) != chart:
                    indices += [a, b, -1]
        lines = coin.SoIndexedLineSet()
        lines.coordIndex.setValues(0, len(indices), indices)
        red = coin.SoBaseColor()
        red.rgb = (0.86, 0.08, 0.12)
        turning = coin.SoIndexedPointSet()
        turning.coordIndex.deleteValues(0)  # the default is one point
        turning.coordIndex.setValues(0, len(labels.turning_points), labels.turning_points.tolist())
        return (*plain((0.05, 0.05, 0.05)), style, lines, red, turning)


def beside(labels):
    """Places of the points in the polycube, turned as the part is and moved to its side along x. The engine's scale is the part's own."""
    image = labels.image @ labels.frame
    least, most = labels.points.min(axis=0), labels.points.max(axis=0)
    middle = (image.min(axis=0) + image.max(axis=0)) / 2
    moved = (least + most) / 2 - middle
    moved[0] = most[0] + _GAP * (most[0] - least[0]) - image[:, 0].min()
    return image + moved


class FaceClicks:
    """Calls `clicked(number)` for every face of the part that is clicked in the 3D view, and takes the selection back."""

    def __init__(self, part, clicked):
        self._names = (part.Document.Name, part.Name)
        self._clicked = clicked
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addObserver(self)

    def addSelection(self, document, name, element, position):
        if (document, name) != self._names or not element.startswith("Face"):
            return
        face = int(element[len("Face"):])
        # FreeCAD is in the middle of selecting.
        QtCore.QTimer.singleShot(0, lambda: self._take(face))

    def _take(self, face):
        FreeCADGui.Selection.clearSelection()
        self._clicked(face)

    def remove(self):
        FreeCADGui.Selection.removeObserver(self)


def next_label(given, automatic, possible):
    """What the next click on a face makes of it: None (automatic), then the possible labels, those first that change something.

    `given`: the label set by hand or None; `automatic`: the one the face has by itself, as far as is known.
    """
    order = [None] + [label for label in possible if label != automatic] + [label for label in possible if label == automatic]
    return order[(order.index(given) + 1) % len(order)] if given in order else None
