"""Commands of the workbench."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

from . import resources, shapes
from .errors import InvalidInput


class MeshFromShape:
    """Opens the task panel for the selected part; the document does not change before there is a mesh."""

    Name = "Polycube_MeshFromShape"

    def GetResources(self):
        return {
            "Pixmap": resources.icon("Polycube_MeshFromShape"),
            "MenuText": "Hexahedral mesh from shape",
            "ToolTip": "Creates a FEM mesh of hexahedra from the selected solid",
        }

    def IsActive(self):
        return self._selected() is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self):
        from .task_panel import MeshPanel

        part = self._selected()
        try:
            shapes.check_solid(shapes.shape_of(part))
        except InvalidInput as error:
            QtGui.QMessageBox.critical(FreeCADGui.getMainWindow(), "Hexahedral mesh", "{}: {}".format(part.Label, error))
            return
        FreeCADGui.Control.showDialog(MeshPanel(part, analysis=_active_analysis(part.Document)))

    @staticmethod
    def _selected():
        """The one selected object that may have a solid, or None."""
        if not FreeCAD.ActiveDocument:
            return None
        chosen = FreeCADGui.Selection.getSelection()
        return chosen[0] if len(chosen) == 1 and shapes.has_shape(chosen[0]) and not chosen[0].isDerivedFrom("Fem::FemMeshObject") else None


def _active_analysis(document):
    import FemGui

    analysis = FemGui.getActiveAnalysis()
    return analysis if analysis and analysis.Document == document else None


NAMES = [MeshFromShape.Name]


def register():
    """Adds the commands that FreeCAD does not know yet."""
    known = FreeCADGui.listCommands()
    for command in (MeshFromShape,):
        if command.Name not in known:
            FreeCADGui.addCommand(command.Name, command())
