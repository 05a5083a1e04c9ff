"""The command that solves the active analysis: results in the document, cancelling, an error in words."""

import os
import stat
import tempfile
from unittest import mock

import FemGui
import FreeCAD
import FreeCADGui
import gui_panel
import ObjectsFem
import TestPolycubeSolver
from gui_support import GuiTest, picture, process_events
from PySide import QtCore, QtGui

from freecad import polycube
from freecad.polycube import ccx, commands, macro, objects

calculix = TestPolycubeSolver.calculix


class Solve(GuiTest):
    def setUp(self):
        super().setUp()
        document = self.box.Document
        self.analysis = ObjectsFem.makeAnalysis(document, "Analysis")
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        self.analysis.addObject(make_solver(document, "Solver"))
        steel = self.analysis.addObject(ObjectsFem.makeMaterialSolid(document, "Steel"))[0]
        steel.Material = dict(steel.Material, Name="Steel", YoungsModulus="210000 MPa", PoissonRatio="0.3")
        calculix.add_constraint(self.analysis, "Fixed", self.box, ["Face1"])
        calculix.add_constraint(self.analysis, "Pressure", self.box, ["Face2"], Pressure=1.0)
        polycube.create_fem_mesh(self.box, size=5, analysis=self.analysis)
        document.recompute()
        FemGui.setActiveAnalysis(self.analysis)
        process_events()

    def tearDown(self):
        FemGui.setActiveAnalysis()
        super().tearDown()

    def results(self):
        return [member for member in self.analysis.Group if member.isDerivedFrom("Fem::FemResultObject")]

    def pipelines(self):
        return [obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemPostObject")]

    def run_and_answer(self, answer):
        """Runs the command; `answer` is asked for what to do with the modal window that is open, until it says that it is done."""

        def look():
            window = QtGui.QApplication.activeModalWidget()
            if window is None or not answer(window):
                QtCore.QTimer.singleShot(50, look)

        QtCore.QTimer.singleShot(50, look)
        FreeCADGui.runCommand(commands.Solve.Name)

    def test_results(self):
        if not ccx.find():
            self.skipTest(ccx.MISSING)
        self.assertTrue(commands.Solve().IsActive())
        self.document.clearUndos()
        with mock.patch.object(QtGui.QMessageBox, "information") as told:
            FreeCADGui.runCommand(commands.Solve.Name)
        (result,) = self.results()
        process_events()
        picture("stresses")
        self.assertRegex(FreeCADGui.getMainWindow().statusBar().currentMessage(), r"^Von Mises stress: [\d.]+ \(blue\) to [\d.]+ MPa \(red\)")
        self.assertTrue(result.Mesh.ViewObject.isVisible())
        self.assertFalse(self.box.ViewObject.isVisible(), "it would hide the stresses")
        self.assertFalse(self.document.PolycubeMesh.ViewObject.isVisible())
        self.assertEqual([obj.Name for obj in self.pipelines() if obj.ViewObject.isVisible()], [], "FreeCAD 1.x makes one, in the same place")
        self.assertEqual(len(self.document.UndoNames), 1, self.document.UndoNames)
        self.assertFalse(told.call_args and "NOT IN BALANCE" in told.call_args[0][2])

    def test_errors_in_colours(self):
        """The estimate of Zienkiewicz and Zhu, and where stresses are CalculiX's the difference from cell to cell; nothing before there are results."""
        if not ccx.find():
            self.skipTest(ccx.MISSING)
        for kind, words in (("recovered", "Error of the stresses, of the part's mean"), ("calculix", "Difference of the stress from cell to cell")):
            self.assertFalse(commands.ShowErrors().IsActive())
            self.document.PolycubeMesh.SolverStresses = kind
            with mock.patch.object(QtGui.QMessageBox, "information"):
                FreeCADGui.runCommand(commands.Solve.Name)
            self.assertTrue(commands.ShowErrors().IsActive())
            FreeCADGui.runCommand(commands.ShowErrors.Name)
            process_events()
            picture("errors-" + kind)
            (result,) = self.results()
            line = FreeCADGui.getMainWindow().statusBar().currentMessage()
            self.assertTrue(line.startswith(words + ": "), line)
            most = max(result.EnergyError if kind == "recovered" else result.StressError)
            self.assertIn(" to {:.4g} % (red)".format(most), line)
            self.assertTrue(result.Mesh.ViewObject.isVisible())
            self.document.removeObject(result.Name)

    def test_beside_the_result_display_of_freecad(self):
        """FreeCAD's own panel of results opens and paints after the panel of the mesh was open with colours and a cut, and the other way round."""
        if not ccx.find():
            self.skipTest(ccx.MISSING)
        with mock.patch.object(QtGui.QMessageBox, "information"):
            FreeCADGui.runCommand(commands.Solve.Name)
        (result,) = self.results()
        mesh = self.document.PolycubeMesh
        if not self.pipelines():
            self.analysis.addObject(ObjectsFem.makePostVtkResult(self.document, result))
        for _ in range(2):
            for obj in self.pipelines():
                obj.ViewObject.show()
            shown = result.Mesh.ViewObject.isVisible()  # FreeCAD hides it when its panel is closed
            panel = self.caught(lambda: mesh.ViewObject.Proxy.doubleClicked(mesh.ViewObject))
            self.assertEqual((mesh.ViewObject.isVisible(), result.Mesh.ViewObject.isVisible()), (True, False), "they stand in the same place")
            self.assertFalse(any(obj.ViewObject.isVisible() for obj in self.pipelines()), "they stand there too")
            panel.result.colours.setChecked(True)
            panel.result.cut.setCurrentIndex(1)
            self.press("Ok")
            for obj in self.pipelines():
                self.assertTrue(obj.ViewObject.isVisible())
                obj.ViewObject.hide()
            self.assertEqual((mesh.ViewObject.isVisible(), result.Mesh.ViewObject.isVisible()), (False, shown))
            result.ViewObject.Proxy.doubleClicked(result.ViewObject)
            process_events(0.3)
            (radio,) = [radio for radio in FreeCADGui.getMainWindow().findChildren(QtGui.QRadioButton) if radio.objectName() == "rb_vm_stress"]
            radio.click()
            process_events(0.2)
            picture("result-display")
            self.assertTrue(FreeCADGui.Control.activeDialog())
            self.assertTrue(result.Mesh.ViewObject.isVisible())
            FreeCADGui.Control.closeDialog()
            FreeCADGui.activeDocument().resetEdit()
            process_events(0.2)
        self.assertGreater(max(result.vonMises), 0)

    def test_an_analysis_that_was_made_after_the_mesh(self):
        mesh = self.box.Document.PolycubeMesh
        polycube.set_analysis(mesh, None)
        self.assertNotIn(mesh, self.analysis.Group)
        with mock.patch.object(QtGui.QMessageBox, "critical") as told, mock.patch.object(QtGui.QMessageBox, "information"):
            FreeCADGui.runCommand(commands.Solve.Name)
        self.assertIn(mesh, self.analysis.Group)
        if ccx.find():
            told.assert_not_called()
            self.assertEqual(len(self.results()), 1)

    def test_cancel(self):
        program = os.path.join(tempfile.gettempdir(), "polycube-sleeper-{}".format(os.getpid()))
        with open(program, "w", encoding="ascii") as file:
            file.write("#!/bin/sh\nexec sleep 600\n")
        os.chmod(program, os.stat(program).st_mode | stat.S_IXUSR)
        self.addCleanup(os.remove, program)

        def cancel(window):
            if isinstance(window, QtGui.QProgressDialog):
                window.cancel()
                return True

        with mock.patch.object(ccx, "find", return_value=program):
            self.run_and_answer(cancel)
        self.assertEqual(self.results(), [])

    def test_an_error_in_words(self):
        FreeCAD.ActiveDocument.removeObject("Fixed")
        with mock.patch.object(QtGui.QMessageBox, "critical") as told:
            FreeCADGui.runCommand(commands.Solve.Name)
        if ccx.find():
            self.assertRegex(told.call_args[0][2], "Neither constraint fixed|No mechanical boundary conditions")  # FreeCAD 0.20; 1.x
        self.assertEqual(self.results(), [])


class InThePanel(gui_panel.PanelTest):
    def test_how_the_mesh_is_solved(self):
        """Chosen before the mesh, changed after it without a new one, undone while the panel is open; each is in the macro."""
        lines = []
        self.enterContext(mock.patch.object(macro, "record", lambda line, _: lines.append(line)))
        panel = self.open_panel(self.box)
        self.assertEqual(panel.solving.values(), {"SolverElement": "Default", "SolverStresses": "recovered"})
        element, stresses = (panel.solving.boxes[name] for name in ("SolverElement", "SolverStresses"))
        element.setCurrentIndex(element.findText("C3D20"))
        panel.solving.set_open(True)
        process_events(0.1)
        for area in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea):
            if area.isAncestorOf(panel.solving):
                area.ensureWidgetVisible(panel.solving)
        picture("solving")
        self.apply(panel)
        self.assertEqual(objects.solving_of(panel.obj), {"SolverElement": "C3D20", "SolverStresses": "recovered"})
        self.assertEqual(len(self.document.UndoNames), 1)
        stresses.setCurrentIndex(stresses.findText("CalculiX's own"))
        self.press("Apply")
        self.assertFalse(panel.process, "the mesh is the same")
        chosen = {"SolverElement": "C3D20", "SolverStresses": "calculix"}
        self.assertEqual((objects.solving_of(panel.obj), panel.obj.MeshState), (chosen, objects.CURRENT))
        self.document.undo()
        process_events(0.1)
        self.assertEqual(stresses.currentText(), "Recovered from the integration points")
        element.setCurrentIndex(0)
        self.press("Ok")
        mesh = self.document.PolycubeMesh
        self.assertEqual(objects.solving_of(mesh), {"SolverElement": "Default", "SolverStresses": "recovered"})
        said = [line for line in lines if ".Solver" in line]
        self.assertEqual(len(said), 3, lines)
        exec("\n".join(said[:2]), {"App": FreeCAD})
        self.assertEqual(objects.solving_of(mesh), chosen)
