"""The panel by keys, and on a small screen: what tells of a run is in sight, wherever its other parts are; run by gui.sh."""

from unittest import mock

import FreeCAD
import FreeCADGui
import gui_panel
from gui_support import picture, process_events, set_panel_width, wait_until
from PySide import QtCore, QtGui

from freecad.polycube import objects


def press(key, text=""):
    """A key, to what has the focus, as the window hands it on."""
    for kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.KeyRelease):
        widget = QtGui.QApplication.focusWidget()
        if widget is not None:
            QtGui.QApplication.sendEvent(widget, QtGui.QKeyEvent(kind, key, QtCore.Qt.NoModifier, text))
    process_events(0.05)


class KeysTest(gui_panel.PanelTest):
    def setUp(self):
        super().setUp()
        window = FreeCADGui.getMainWindow()
        window.showNormal()
        window.resize(1366, 768)
        self.addCleanup(window.showMaximized)
        set_panel_width(280)
        QtGui.QApplication.setActiveWindow(window)

    def focus(self, panel, name):
        widget = panel.field(name).widget
        widget.setFocus()
        process_events(0.1)
        return widget

    @staticmethod
    def area_of(widget):
        """What the widget is scrolled in, None of the buttons of FreeCAD 1.x."""
        return next((area for area in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea) if area.isAncestorOf(widget)), None)

    def is_in_sight(self, widget):
        area = self.area_of(widget)
        if area is None:
            return widget.isVisible()
        top = area.viewport().mapToGlobal(QtCore.QPoint(0, 0)).y()
        place = widget.mapToGlobal(QtCore.QPoint(0, 0)).y()
        return widget.isVisible() and top <= place and place + widget.height() <= top + area.viewport().height()


class Keys(KeysTest):
    def test_tab_goes_from_top_to_bottom(self):
        panel = self.open_panel(self.box)
        first = self.focus(panel, "size")
        seen = []
        for _ in range(60):
            widget = QtGui.QApplication.focusWidget()
            if widget is None or not panel.form.isAncestorOf(widget) or (seen and widget is first):
                break
            seen.append(widget.mapTo(panel.form, QtCore.QPoint(0, 0)).y())
            press(QtCore.Qt.Key_Tab)
        self.assertGreater(len(seen), 12)
        self.assertEqual(seen, sorted(seen))
        self.press("Cancel")

    def test_enter_meshes_with_the_size_that_was_typed(self):
        panel = self.open_panel(self.box)
        size = self.focus(panel, "size")
        size.selectAll()
        press(0, "8")
        press(QtCore.Qt.Key_Return)
        self.assertIsNotNone(panel.process, "Enter must not close the panel over what was typed")
        self.assertTrue(wait_until(lambda: not panel.process and not panel._taking))
        self.assertEqual(panel.obj.CharacteristicLengthMax.Value, 8)
        self.assertEqual(panel.field("size").value, 8)
        self.press("Ok")

    def test_escape_stops_the_mesher_and_then_closes(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 0.4
        self.press("Apply")
        area = self.area_of(panel.form)
        area.setFocus()
        press(QtCore.Qt.Key_Escape)
        self.assertTrue(wait_until(lambda: not panel.process, 10))
        self.assertTrue(FreeCADGui.Control.activeDialog())
        area.setFocus()
        press(QtCore.Qt.Key_Escape)
        process_events(0.3)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(self.document.Objects, [self.box])


class InSight(KeysTest):
    def test_a_run_on_a_small_screen(self):
        """How far it is, how to end it, what came out, with OK, Cancel and Apply; also of one that began where the panel was scrolled to."""
        panel = self.open_panel(self.box)
        self.assertFalse(panel.form.progress.isVisible(), "there is nothing to tell yet")
        panel.field("size").value = 0.4
        for section in (panel.axes, panel.refine, panel.advanced):
            section.set_open(True)
        process_events()
        area = self.area_of(panel.form)
        area.verticalScrollBar().setValue(area.verticalScrollBar().maximum())
        process_events()
        panel.apply()
        process_events(0.3)
        panel._heard("log", "plan 2, 'finer', 3 fits done, best: 'first', 2 CAD edges lost, min SJ 0.31")
        process_events(0.1)
        picture("small-running")
        for widget in (panel.form.progress, panel.form.time, panel.form.status, panel.form.run.best):
            self.assertTrue(self.is_in_sight(widget), widget)
        for name in ("Ok", "Cancel", "Apply"):
            self.assertTrue(self.is_in_sight(gui_panel.button_of(name)), name)
        self.press("Cancel")
        self.assertTrue(wait_until(lambda: not panel.process, 10))
        panel.field("size").value = 10.0
        self.apply(panel)
        picture("small-meshed")
        self.assertTrue(self.is_in_sight(panel.form.status))
        self.assertIn("Meshed", panel.form.status.text())
        self.press("Ok")

    def test_what_a_section_says_is_in_the_section(self):
        panel = self.open_panel(self.box)
        panel.refine.add_button.menu().aboutToShow.emit()
        self.assertIn("Select faces", panel.refine.told.text())
        panel.axes.preview.setChecked(True)
        self.assertTrue(wait_until(lambda: panel.axes.shown))
        self.assertIn("valid", panel.axes.told.text())
        panel.axes.preview.setChecked(False)
        self.assertFalse(panel.axes.told.isVisible())
        self.press("Cancel")


class ReportView(gui_panel.PanelTest):
    def test_a_mesh_is_one_line(self):
        """Whatever it is warned of: FreeCAD 1.x opens a balloon for each."""
        panel = self.open_panel(self.box)
        panel.field("size").value = 10.0
        told = []
        with mock.patch.object(objects, "set_mesh", self.with_warnings(objects.set_mesh)):
            patches = [mock.patch.object(FreeCAD.Console, kind, told.append, create=True) for kind in ("PrintMessage", "PrintWarning", "PrintError", "PrintDeveloperError")]
            for patch in patches:
                patch.start()
            try:
                self.apply(panel)
            finally:
                for patch in patches:
                    patch.stop()
        self.assertEqual(len(told), 1, told)
        self.assertRegex(told[0], r"^Polycube: Meshed: [\d,]+ cells, .* 2 warnings")
        self.assertEqual(panel.form.log.toPlainText().count("Warning: "), 2)
        self.press("Ok")

    @staticmethod
    def with_warnings(set_mesh):
        return lambda *arguments, **named: set_mesh(*arguments, **named) + ["a wall is thin", "an edge is lost"]
