"""What the tree and the mouse do with a refinement."""

from PySide import QtCore

from . import objects, refinements, resources, shapes


class RefinementView(objects.Stateless):
    """View provider of a refinement."""

    def __init__(self, view):
        view.Proxy = self

    def attach(self, view):
        self.Object = view.Object
        if view.Object.Document.Importing:  # a copy; the mesh that has it may be copied after it
            QtCore.QTimer.singleShot(0, self._adopt)

    def _adopt(self):
        if shapes.exists(self.Object):
            refinements.adopt(self.Object)

    def getIcon(self):
        obj = self.Object
        if getattr(obj, "Fault", ""):
            return resources.icon("Polycube_RefinementFaulty")
        return resources.icon("Polycube_RefinementOff" if getattr(obj, "Suppressed", False) else "Polycube_Refinement")

    def updateData(self, obj, name):
        if name in ("Fault", "Suppressed"):
            obj.ViewObject.signalChangeIcon()

    def doubleClicked(self, view):
        """Opens the panel of the mesh with the refinement chosen."""
        mesh = refinements.mesh_of(view.Object)
        if mesh is None:
            return False
        from .task_panel import MeshPanel

        MeshPanel.shown_refinement = view.Object.Name
        return mesh.ViewObject.Proxy.doubleClicked(mesh.ViewObject)
