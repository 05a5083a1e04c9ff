"""The panel by keys, and on a small screen: what tells of a run is in sight, wherever its other parts are; run by gui.sh."""

import glob
import os
import re
from unittest import mock

import FreeCAD
import FreeCADGui
import gui_panel
import ObjectsFem
import TestPolycubeSolver
from gui_support import picture, process_events, set_panel_width, wait_until
from PySide import QtCore, QtGui

from freecad import polycube
from freecad.polycube import deck, objects, uncaptured, words

calculix = TestPolycubeSolver.calculix


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

    def test_a_comma_that_is_no_decimal_one(self):
        """What FreeCAD makes of it is shown, and not what was typed."""
        panel = self.open_panel(self.box)
        widget = self.focus(panel, "size")
        widget.selectAll()
        for sign in "5,5":
            press(0, sign)
        self.focus(panel, "order")
        line = widget.findChild(QtGui.QLineEdit)
        if QtCore.QLocale().groupSeparator() == ",":
            self.assertEqual((panel.field("size").value, line.text()), (55.0, "55.00 mm"))
        else:
            self.assertEqual(panel.field("size").value, 5.5)
        self.press("Cancel")


class Themes(KeysTest):
    """FreeCAD's own themes, whose paddings are wide, in the dock as FreeCAD opens it, and in German, whose words are long."""

    def setUp(self):
        super().setUp()
        application = QtGui.QApplication.instance()
        self.addCleanup(application.setStyleSheet, application.styleSheet())
        gui_panel.speak_german(self)

    def test_numbers_and_buttons_are_not_cut_off(self):
        themes = sorted(glob.glob(os.path.join(FreeCAD.getResourceDir(), "Gui", "Stylesheets", "*.qss")))
        themes = [path for path in themes if os.path.basename(path) in ("Dark-blue.qss", "ProDark.qss", "FreeCAD Dark.qss")]
        self.assertTrue(themes)
        for theme in themes:
            with self.subTest(theme=os.path.basename(theme)), open(theme, encoding="utf-8") as file:
                # FreeCAD 1.x fills in the colours that the user has chosen.
                QtGui.QApplication.instance().setStyleSheet(re.sub(r"@ThemeAccentColor\d", "#557bb6", file.read()))
                panel = self.open_panel(self.box)
                panel.field("size").value = 8.0
                panel.advanced.set_open(True)
                process_events(0.4)
                set_panel_width(280)
                process_events(0.4)
                self.check(panel)
                picture("theme-" + os.path.basename(theme)[:-4])
                self.press("Cancel")

    def check(self, panel):
        for name in ("Ok", "Cancel", "Apply"):
            button = gui_panel.button_of(name)
            option = QtGui.QStyleOptionButton()
            button.initStyleOption(option)
            option.rect = button.rect()
            room = button.style().subElementRect(QtGui.QStyle.SE_PushButtonContents, option, button).width()
            self.assertGreaterEqual(room, QtGui.QFontMetrics(button.font()).boundingRect(button.text()).width(), button.text())
        for spin in panel.form.findChildren(QtGui.QAbstractSpinBox):
            line = spin.findChild(QtGui.QLineEdit)
            if line is not None and spin.isVisible():
                option = QtGui.QStyleOptionFrame()
                line.initStyleOption(option)
                room = line.style().subElementRect(QtGui.QStyle.SE_LineEditContents, option, line).width()
                self.assertGreaterEqual(room, QtGui.QFontMetrics(line.font()).boundingRect(line.text()).width(), (spin.objectName(), line.text()))


class German(KeysTest):
    def setUp(self):
        super().setUp()
        gui_panel.speak_german(self)
        self.addCleanup(QtCore.QLocale.setDefault, QtCore.QLocale())
        QtCore.QLocale.setDefault(QtCore.QLocale(QtCore.QLocale.German))

    def test_numbers_are_as_in_the_fields_beside_them(self):
        self.assertEqual((words.count(53773), words.decimal(0.5, 2), words.short_count(1200000)), ("53.773", "0,50", "1,2M"))
        panel = self.open_panel(self.box)
        panel.field("size").value = 3.0
        self.apply(panel)
        self.assertIn("{} Zellen".format(words.count(panel.obj.Hexahedra)), panel.form.status.text())
        self.assertIn("1.820 Zellen", panel.form.status.text())
        self.assertIn("1,00", panel.form.status.text())
        self.assertEqual(panel.result.worst.item(0, 1).text()[:2], "1,")
        panel.result._zoom(0)
        self.assertIn("1 von 1.820", panel.result.told.text())
        self.assertEqual([panel.field("effort").widget.itemText(index) for index in range(3)], ["schnell", "normal", "gründlich"])
        panel.field("effort").widget.setCurrentIndex(2)
        self.assertEqual(panel.field("effort").value, "thorough")
        self.press("Ok")
        self.assertEqual(list(self.document.UndoNames), ["Parameter des Netzes", "Hexaedernetz aus Form"])

    def test_questions_and_refusals(self):
        panel = self.meshed()
        self.press("Ok")
        analysis = ObjectsFem.makeAnalysis(self.document, "Analyse")
        analysis.addObject(panel.obj)
        told = []
        with mock.patch.object(QtGui.QMessageBox, "warning", lambda *words: told.append(words[2]) or QtGui.QMessageBox.No):
            self.assertFalse(panel.obj.ViewObject.Proxy.onDelete(panel.obj.ViewObject, ()))
        self.assertEqual(told, ["PolycubeMesh ist das Netz von Analyse. Löschen?"])

    def test_what_the_mesher_says(self):
        """An option that it does not take, a stage that fails with its faces, a warning, a line on the analysis: none has a word of English."""
        panel = self.open_panel(self.box)
        for name, text, told in (
            ("sizes", "Face3=0,5", r"sizes: '0,5' hat ein Komma, wo ein Punkt stehen muss, wie in 0.5$"),
            ("divisions", "Face1-Face3=3", r"Abgelehnt: Zahlen der Zellen wählen: die Flächen der Teilung Face1-Face3=3 liegen sich nirgends gegenüber \(Face1, Face3\)\. Versuchen"),
        ):
            panel.field(name).value = text
            self.apply(panel)
            self.assertRegex(panel.form.status.text(), told)
            panel.field(name).value = ""
        picture("german-refusal")
        panel.field("hexes").value = 5
        self.apply(panel)
        self.assertRegex(panel.form.status.text(), r"^Vernetzt: .* Hexaeder, wo 5 verlangt waren$")
        self.press("Ok")
        with self.assertRaisesRegex(polycube.InvalidInput, "^size muss größer als 0 sein, nicht -1$"):
            polycube.mesh(self.box, size=-1)
        analysis = ObjectsFem.makeAnalysis(self.document, "Analyse")
        other = self.document.addObject("Part::Box", "Anderes")
        other.Placement.Base.x = 100
        self.document.recompute()
        calculix.add_constraint(analysis, "Fixed", other, ["Face1"]).Label = "Halt"
        self.assertEqual(uncaptured.lines(self.box, analysis), ["Halt: Face1 von Anderes ist nicht von Block"])
        line = deck.choose(None, 2, fem_mesh_of_a_bar(), set())[2]
        self.assertEqual(line, "C3D20 statt C3D20R in 2 von 2 Zellen, gegen Hourglassing: 2, die der ganze Querschnitt eines Stabs sind")


def fem_mesh_of_a_bar():
    """What deck.choose() asks a mesh of two cells one behind the other."""
    return mock.Mock(Volumes=[1, 2], VolumeCount=2, sides=lambda: {number: (1 + number // 5, 1 + number % 5) for number in range(10)})


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
