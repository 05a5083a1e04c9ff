"""What is drawn in the 3D view over the document's objects, in no document: no undo step, nothing to save, gone with the panel."""

import FreeCADGui
import numpy
from pivy import coin

#: How far lines stand in front of faces: a share of the view's depth.
_LINES_FORWARD = 1e-4


def view_of(document):
    """The 3D view of a document to draw in: the active one, else another, which comes to the front, for a page or a table may be there; None if there is none."""
    gui = FreeCADGui.getDocument(document.Name)
    active = gui.activeView()
    if hasattr(active, "getSceneGraph"):
        return active
    views = gui.mdiViewsOfType("Gui::View3DInventor")
    if not views:
        return None
    FreeCADGui.getMainWindow().setActiveWindow(views[-1])
    return views[-1]


class Overlay:
    """A node in a 3D view of a document, in no view where there is none. Clicks go through to what is behind. `standing`: placement of the coordinates that are drawn in."""

    def __init__(self, document, standing):
        view = view_of(document)
        self._root = view.getSceneGraph() if view else coin.SoSeparator()
        self._standing = coin.SoTransform()
        self._standing.translation = tuple(standing.Base)
        self._standing.rotation = standing.Rotation.Q
        self._node = coin.SoSeparator()
        self._root.addChild(self._node)

    def draw(self, *children):
        """Draws these nodes in place of those before."""
        self._node.removeAllChildren()
        unpickable = coin.SoPickStyle()
        unpickable.style = coin.SoPickStyle.UNPICKABLE
        for child in (unpickable, self._standing, *children):
            self._node.addChild(child)

    def remove(self):
        self._root.removeChild(self._node)


def depth(forward):
    """What follows is drawn in front of what is there, by a share of the view's depth."""
    buffer = coin.SoDepthBuffer()
    buffer.range.setValue(coin.SbVec2f(0.0, 1.0 - forward))
    return buffer


def plain(colour):
    """A colour that no light changes."""
    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    ink = coin.SoBaseColor()
    ink.rgb = colour
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.OVERALL
    return light, ink, binding


def lines(chains, colour, width):
    """Nodes for chains of points."""
    points = coin.SoCoordinate3()
    flat = [tuple(point) for chain in chains for point in chain]
    points.point.setValues(0, len(flat), flat)
    style = coin.SoDrawStyle()
    style.lineWidth = width
    drawn = coin.SoLineSet()
    drawn.numVertices.setValues(0, len(chains), [len(chain) for chain in chains])
    return (*plain(colour), style, depth(_LINES_FORWARD), points, drawn)


def quads(points, corners, colours):
    """Nodes for quadrilaterals with their edges. corners: (n, 4) indices into points; colours: (n, 3), 0 to 1."""
    used, corners = numpy.unique(corners, return_inverse=True)
    corners = corners.reshape(-1, 4)
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(used), points[used].tolist())
    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    palette, paint_of = numpy.unique(colours, axis=0, return_inverse=True)
    paint = coin.SoMaterial()
    paint.diffuseColor.setValues(0, len(palette), palette.tolist())
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_FACE_INDEXED
    faces = coin.SoIndexedFaceSet()
    indices = numpy.column_stack([corners, numpy.full(len(corners), -1)]).ravel().tolist()
    faces.coordIndex.setValues(0, len(indices), indices)
    faces.materialIndex.setValues(0, len(paint_of), paint_of.ravel().tolist())
    ends = numpy.unique(numpy.sort(numpy.concatenate([corners[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1), axis=0)
    edges = coin.SoIndexedLineSet()
    indices = numpy.column_stack([ends, numpy.full(len(ends), -1)]).ravel().tolist()
    edges.coordIndex.setValues(0, len(indices), indices)
    behind = coin.SoPolygonOffset()
    return coordinates, hints, paint, binding, behind, faces, depth(_LINES_FORWARD), *plain((0.05, 0.05, 0.05)), edges
