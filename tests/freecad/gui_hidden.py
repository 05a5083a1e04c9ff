"""The panel in a FreeCAD from which the compiled module is hidden; run by TestPolycubeMesher through gui.sh."""

import os
from unittest import mock

import FreeCAD
import FreeCADGui
import hidden
from gui_support import GuiTest, picture, process_events, wait_until
from PySide import QtCore, QtGui

from freecad.polycube import engine


class HiddenPanel(GuiTest):
    def setUp(self):
        hidden.check(self)
        super().setUp()

    def test_apply_and_axes_of_faces(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 10.0
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertIsNotNone(panel.obj, panel.form.log.toPlainText())
        self.assertEqual(panel.obj.FemMesh.HexaCount, panel.obj.Hexahedra)
        panel.axes.preview.setChecked(True)
        self.assertTrue(wait_until(lambda: panel.axes.shown))
        picture("panel-without-the-module")
        self.press("Ok")

    def test_without_any_mesher(self):
        """The panel opens and says in one line what is missing; nothing changes."""
        with mock.patch.dict(os.environ, PATH="/nowhere"):
            panel = self.open_panel(self.box)
            self.press("Apply")
            self.assertIsNone(panel.process)
            (line,) = panel.form.log.toPlainText().splitlines()
            self.assertIn("no mesher is at hand", line)
            self.assertEqual(self.document.Objects, [self.box])
            self.press("Cancel")

    def test_the_preference_has_a_page(self):
        seen = []

        def look():
            dialog = QtGui.QApplication.activeModalWidget()
            chooser = dialog.findChild(QtGui.QWidget, "Mesher")
            seen.append(chooser is not None and chooser.isVisible())
            chooser.findChild(QtGui.QLineEdit).setText("/nowhere/polycube")
            picture("preferences")
            dialog.accept()

        self.addCleanup(FreeCAD.ParamGet(engine.PREFERENCES).RemString, "Mesher")
        QtCore.QTimer.singleShot(1000, look)
        FreeCADGui.showPreferences("Polycube", 0)
        process_events()
        self.assertEqual(seen, [True])
        self.assertEqual(FreeCAD.ParamGet(engine.PREFERENCES).GetString("Mesher"), "/nowhere/polycube")
