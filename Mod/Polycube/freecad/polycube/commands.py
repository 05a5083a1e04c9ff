"""Commands of the workbench."""

import FreeCAD
import FreeCADGui
import polycube_commands
from PySide import QtCore, QtGui

from . import analyses, api, macro, objects, resources, shapes
from .errors import Cancelled, InvalidInput, PolycubeError
from .put_together import PutTogether
from .words import tr


class MeshFromShape:
    """Opens the task panel for the selected part; the document does not change before there is a mesh."""

    Name = "Polycube_MeshFromShape"

    def GetResources(self):
        return {
            "Pixmap": resources.icon("Polycube_MeshFromShape"),
            "MenuText": tr("Hexahedral mesh from shape"),
            "ToolTip": tr("Creates a FEM mesh of hexahedra from the selected solid, or from several"),
        }

    def IsActive(self):
        return self._selected() is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self):
        from .task_panel import MeshPanel

        chosen = shapes.distinct(self._selected())
        together = None
        try:
            shapes.check_solid(shapes.shape_of(chosen))
            part = chosen[0]
            if len(chosen) > 1:
                part = _compound_with(chosen)
                if not part:
                    together = PutTogether(chosen, analyses.active(chosen[0].Document))
                    part = together.compound
        except InvalidInput as error:
            QtGui.QMessageBox.critical(FreeCADGui.getMainWindow(), tr("Hexahedral mesh"), "{}: {}".format(chosen[0].Label, error))
            return
        macro.begin()
        analysis = analyses.active(part.Document)
        # A second mesh of the part would stand in the first one.
        meshes = [mesh for mesh in objects.meshes_of(part) if objects.analysis_of(mesh) in (analysis, None)]
        if meshes:
            meshes[-1].ViewObject.Proxy.doubleClicked(meshes[-1].ViewObject)
        else:
            FreeCADGui.Control.showDialog(MeshPanel(part, analysis=analysis, together=together))

    @staticmethod
    def _selected():
        """The selected objects, where all of them may have solids, or None."""
        if not FreeCAD.ActiveDocument:
            return None
        chosen = FreeCADGui.Selection.getSelection()
        fit = all(shapes.has_shape(obj) and not obj.isDerivedFrom("Fem::FemMeshObject") for obj in chosen)
        return chosen if chosen and fit else None


def _compound_with(parts):
    """A compound of just these parts that there is, as one that was meshed before, or None."""
    for compound in parts[0].Document.findObjects("Part::Compound"):
        links = compound.Links
        if len(links) == len(parts) and all(any(api.stands_for(link, part) for link in links) for part in parts):
            return compound
    return None


class Solve:
    """Solves the active analysis by CalculiX, with all its loads, and loads the results into it."""

    Name = "Polycube_Solve"

    def GetResources(self):
        return {
            "Pixmap": resources.icon("Polycube_Solve"),
            "MenuText": tr("Solve with CalculiX"),
            "ToolTip": tr("Solves the active analysis with every load on its hexahedra, by elements C3D20R (first order: C3D8I), and loads the results"),
        }

    def IsActive(self):
        return bool(FreeCAD.ActiveDocument) and analyses.active(FreeCAD.ActiveDocument) is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self):
        from . import result_view, solver

        analysis = analyses.active(FreeCAD.ActiveDocument)
        macro.begin()
        _give_mesh(analysis)
        title = tr("Solve with CalculiX")
        progress = QtGui.QProgressDialog(title, tr("Cancel"), 0, 0, FreeCADGui.getMainWindow())
        progress.setWindowModality(QtCore.Qt.WindowModal)
        progress.setMinimumDuration(0)
        progress.setValue(0)

        def stop():
            QtGui.QApplication.processEvents()
            return progress.wasCanceled()

        try:
            solution = solver.solve(analysis, log=lambda line: progress.setLabelText(line.strip()[:80] or title), cancel=stop)
        except Cancelled:
            return
        except PolycubeError as error:
            QtGui.QMessageBox.critical(FreeCADGui.getMainWindow(), title, "{}: {}".format(analysis.Label, error))
            return
        finally:
            progress.close()
        line = result_view.show(analysis, solution.result)
        FreeCADGui.getMainWindow().statusBar().showMessage(line)
        FreeCAD.Console.PrintMessage(line + "\n")
        if solution.notes:
            QtGui.QMessageBox.information(FreeCADGui.getMainWindow(), title, "\n".join(solution.notes))


class ShowErrors:
    """Shows how far the stresses of the active analysis can be trusted, in colours."""

    Name = "Polycube_ShowErrors"

    def GetResources(self):
        return {
            "Pixmap": resources.icon("Polycube_ShowErrors"),
            "MenuText": tr("Error of the stresses"),
            "ToolTip": tr("Shows in colours how far the stresses of the solved analysis are off, by an estimate: make the mesh finer where it is red"),
        }

    def IsActive(self):
        return self._result() is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self):
        from . import result_view

        line = result_view.show(analyses.active(FreeCAD.ActiveDocument), self._result(), result_view.ERRORS)
        FreeCADGui.getMainWindow().statusBar().showMessage(line)
        FreeCAD.Console.PrintMessage(line + "\n")

    @staticmethod
    def _result():
        from . import result_view

        analysis = FreeCAD.ActiveDocument and analyses.active(FreeCAD.ActiveDocument)
        return result_view.with_errors(analysis) if analysis else None


class Help:
    """Opens the user guide."""

    Name = "Polycube_Help"

    def GetResources(self):
        return {
            "Pixmap": resources.icon("Polycube_Help"),
            "MenuText": tr("Guide to hexahedral meshes"),
            "ToolTip": tr("From a first mesh to stresses, with pictures: refinement, what to do when a part is refused, limits"),
        }

    def IsActive(self):
        return True

    def Activated(self):
        from .help_page import HelpPage

        HelpPage(FreeCADGui.getMainWindow()).show()


def _give_mesh(analysis):
    """An analysis that was made after the mesh, and has none, gets it: the one mesh of ours that is in no analysis."""
    free = [obj for obj in analysis.Document.Objects if objects.is_polycube(obj) and objects.analysis_of(obj) is None]
    if not analyses.other_meshes(analysis) and len(free) == 1:
        api.set_analysis(free[0], analysis)
        macro.set_analysis(free[0], analysis)


def register():
    """Adds the commands that FreeCAD does not know yet."""
    polycube_commands.register((MeshFromShape, Solve, ShowErrors, Help))
