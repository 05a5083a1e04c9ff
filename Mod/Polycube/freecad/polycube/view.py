"""What the tree and the mouse do with a mesh object."""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import macro, objects, refinements, resources
from .words import tr

_ICONS = {objects.EMPTY: "Polycube_MeshEmpty", objects.CURRENT: "Polycube_MeshFromShape", objects.OUTDATED: "Polycube_MeshOutOfDate"}


class PolycubeMeshView(objects.Stateless):
    """View provider of the mesh object."""

    def __init__(self, view):
        view.Proxy = self

    def attach(self, view):
        self.Object = view.Object

    def getIcon(self):
        return resources.icon(_ICONS.get(getattr(self.Object, "MeshState", None), "Polycube_MeshFromShape"))

    def updateData(self, obj, name):
        if name == "MeshState":
            obj.ViewObject.signalChangeIcon()

    def claimChildren(self):
        return list(getattr(self.Object, "Refinements", ()))

    # Refinements can be dragged in the tree from one mesh to another.

    def canDragObjects(self):
        return True

    canDropObjects = canDragObjects

    def canDragObject(self, obj):
        return refinements.is_refinement(obj)

    def canDropObject(self, obj):
        return refinements.is_refinement(obj) and obj.Document == self.Object.Document

    def dragObject(self, view, obj):
        del view
        refinements.move(obj, None)

    def dropObject(self, view, obj):
        refinements.move(obj, view.Object)

    def doubleClicked(self, view):
        import FemGui

        document = FreeCADGui.getDocument(view.Object.Document)
        if document.getInEdit() or FreeCADGui.Control.activeDialog():
            QtGui.QMessageBox.critical(FreeCADGui.getMainWindow(), tr("Task panel"), tr("Close the open task panel first."))
            return True
        analysis = objects.analysis_of(view.Object)
        if analysis:
            FemGui.setActiveAnalysis(analysis)
        macro.begin()
        document.setEdit(view.Object.Name)
        return True

    def setEdit(self, view, mode=0):
        from .task_panel import MeshPanel

        if mode != 0:
            return False
        panel = MeshPanel(objects.part_of(view.Object), view.Object)
        FreeCADGui.Control.showDialog(panel)
        QtCore.QTimer.singleShot(0, lambda: _after_double_click(panel))
        return True

    def unsetEdit(self, view, mode=0):
        FreeCADGui.Control.closeDialog()
        return True

    def onDelete(self, view, names):
        """Refuses while the mesher runs; warns where an analysis would lose its only mesh."""
        from .task_panel import MeshPanel

        window = FreeCADGui.getMainWindow()
        if MeshPanel.is_meshing(view.Object):
            QtGui.QMessageBox.critical(window, tr("Hexahedral mesh"), tr("The mesher is running for this object. Cancel it first."))
            return False
        analysis = objects.analysis_of(view.Object)
        if not analysis or not view.Object.FemMesh.VolumeCount:
            return True
        question = tr("{} is the mesh of {}. Delete it?").format(view.Object.Label, analysis.Label)
        buttons = QtGui.QMessageBox.Yes | QtGui.QMessageBox.No
        return QtGui.QMessageBox.warning(window, tr("Hexahedral mesh"), question, buttons, QtGui.QMessageBox.No) == QtGui.QMessageBox.Yes


def _after_double_click(panel):
    """Shows the mesh by itself, in no undo step. FreeCAD leaves a transaction "Edit" open as long as something is edited, which all that the panel does would be part of."""
    if FreeCAD.getActiveTransaction():
        # One that has changed something is another's, which was open before: taken back it would take that with it.
        FreeCAD.closeActiveTransaction(not any(document.HasPendingTransaction for document in FreeCAD.listDocuments().values()))
    panel.show_mesh_alone()
