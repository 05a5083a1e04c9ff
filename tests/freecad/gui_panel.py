"""The panel as its users meet it: a narrow dock, undo, macros, analyses, questions, marks; run by gui.sh."""

import contextlib
import json
import os
import tempfile
from unittest import mock

import FemGui
import FreeCAD
import FreeCADGui
import ObjectsFem
import Part
from gui_support import GuiTest, mouse, picture, process_events, set_panel_width, wait_until
from PySide import QtCore, QtGui

from freecad import polycube
from freecad.polycube import commands, fields, init_gui, macro, measures, objects, option_table, preferences, task_panel, words
from freecad.polycube.histogram import Histogram
from freecad.polycube.run_section import RunSection


class PanelTest(GuiTest):
    def tearDown(self):
        FemGui.setActiveAnalysis()
        super().tearDown()

    def apply(self, panel):
        """Apply, until the mesh is there."""
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process and not panel._taking))
        return panel.obj

    def meshed(self, size=10.0):
        """A panel with a mesh that it has made."""
        panel = self.open_panel(self.box)
        panel.field("size").value = size
        self.assertIsNotNone(self.apply(panel), panel.form.log.toPlainText())
        return panel

    def double_click_in_tree(self, obj):
        """As the user does, so that FreeCAD does what it does then."""
        for tree in FreeCADGui.getMainWindow().findChildren(QtGui.QTreeWidget):
            items = tree.findItems(obj.Label, QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive)
            if items and tree.isVisible():
                tree.scrollToItem(items[0])
                process_events()
                centre = tree.visualItemRect(items[0]).center()
                mouse(tree.viewport(), centre, double=True)
                process_events(0.3)
                return
        self.fail("no item for " + obj.Label)

    @contextlib.contextmanager
    def answer(self, button):
        """Questions get this answer; yields their texts."""
        asked = []

        def answer(parent, title, text, *_):
            asked.append(text)
            return button

        with mock.patch.object(QtGui.QMessageBox, "question", answer):
            yield asked


class Narrow(PanelTest):
    """The dock as FreeCAD opens it: 280 pixels."""

    def test_nothing_is_cut_off(self):
        self.check("English")

    def test_nothing_is_cut_off_in_german(self):
        speak_german(self)
        self.check("German")
        self.assertEqual(fields.title({"name": "size"}), "Elementgröße")

    def check(self, language):
        """All sections open, with a mesh."""
        panel = self.meshed(5.0)
        dock = set_panel_width(280)
        process_events(0.3)
        # Of the task view FreeCAD 1.x has a least width of its own; what the panel itself needs is asked below.
        self.assertLessEqual(dock.width(), max(290, dock.minimumWidth()))
        for section in (panel.axes, panel.refine, panel.advanced, panel.form.run.log_fold, panel.result):
            section.set_open(True)
        panel.axes.labels = {"Face1": "-X"}
        panel.axes._list()
        process_events(0.3)
        picture("narrow-top-" + language)
        area = self.area(panel)
        self.assertLessEqual(panel.form.minimumSizeHint().width(), 250)
        self.assertEqual(area.horizontalScrollBar().maximum(), 0, "wider than the dock")
        right = area.viewport().mapToGlobal(QtCore.QPoint(area.viewport().width(), 0)).x()
        seen = 0
        for widget in panel.form.findChildren(QtGui.QWidget):
            if widget.isVisibleTo(panel.form) and widget.parentWidget().isVisibleTo(panel.form) and isinstance(widget, (QtGui.QAbstractSpinBox, QtGui.QAbstractButton, QtGui.QLabel, QtGui.QComboBox, Histogram)):
                seen += 1
                edge = widget.mapToGlobal(QtCore.QPoint(widget.width(), 0)).x()
                self.assertLessEqual(edge, right + 1, widget.objectName() or type(widget).__name__)
        self.assertGreater(seen, 30)
        for name in ("Ok", "Cancel", "Apply"):
            button = button_of(name)
            self.assertLessEqual(button.mapToGlobal(QtCore.QPoint(button.width(), 0)).x(), right + 12, name)
            self.assertGreaterEqual(button.width(), QtGui.QFontMetrics(button.font()).boundingRect(button.text()).width(), name)
        area.verticalScrollBar().setValue(area.verticalScrollBar().maximum())
        picture("narrow-bottom-" + language)
        self.press("Ok")

    def area(self, panel):
        return next(widget for widget in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea) if widget.isAncestorOf(panel.form))


def speak_german(test):
    """Until the end of the test."""
    general = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/General")
    before = general.GetString("Language", "")

    def english_again():
        # FreeCAD keeps the language for the next start; of a user without a choice it makes none.
        FreeCADGui.setLocale("English")
        if before:
            general.SetString("Language", before)
        else:
            general.RemString("Language")

    test.addCleanup(english_again)
    FreeCADGui.setLocale("German")


def button_of(name):
    """A button of the task panel."""
    wanted = getattr(QtGui.QDialogButtonBox, name)
    buttons = [box.button(wanted) for box in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox)]
    return next(button for button in buttons if button and button.isVisible())


class Wide(PanelTest):
    def test_buttons_have_their_width(self):
        self.open_panel(self.box)
        for name in ("Ok", "Cancel", "Apply"):
            button = button_of(name)
            self.assertGreaterEqual(button.width(), button.sizeHint().width(), name)
        self.press("Cancel")


class Bars(PanelTest):
    def test_counts_fit_over_their_bars(self):
        histogram = Histogram()
        histogram.resize(230, 90)
        for counts in ([0, 1, 12, 123, 1234, 12345, 123456, 201000, 9957, 1234567], [0] * 9 + [200000], [1] * 10):
            histogram.set_counts(counts)
            font = histogram.count_font(histogram.font(), histogram.width() / measures.BARS)
            for number in counts:
                self.assertLessEqual(histogram.text_width(font, words.short_count(number)), histogram.width() / measures.BARS, number)
        texts = [words.short_count(number) for number in (0, 999, 9957, 10000, 201000, 999499, 999500, 1234567, 123456789)]
        self.assertEqual(texts, ["0", "999", "9957", "10k", "201k", "999k", "1.0M", "1.2M", "123M"])

    def test_a_bar_tells_its_count_and_can_be_chosen(self):
        chosen = []
        histogram = Histogram(chosen.append)
        histogram.resize(200, 90)
        histogram.set_counts([0, 0, 5, 0, 0, 0, 0, 0, 0, 7])
        histogram.show()
        for x, expected in ((50, 2), (50, None), (199, 9)):
            mouse(histogram, QtCore.QPoint(x, 40))
            self.assertEqual(chosen[-1], expected)
        histogram.set_counts([0] * 10, measures.MEASURES[1])
        self.assertEqual([histogram.label(edge) for edge in (0, 2, 10)], ["\u221e", "5.0", "1.0"])


class Undo(PanelTest):
    def test_each_apply_is_a_step_with_a_name(self):
        panel = self.meshed()
        panel.field("size").value = 8.0
        self.apply(panel)
        self.press("Ok")
        self.assertEqual(list(self.document.UndoNames), ["Hexahedral mesh", "Hexahedral mesh from shape"])

    def test_a_double_click_leaves_no_step(self):
        panel = self.meshed()
        self.press("Ok")
        obj = panel.obj
        obj.ViewObject.hide()
        for ending in ("Cancel", "Ok"):
            self.document.clearUndos()
            with self.subTest(ending=ending):
                self.double_click_in_tree(obj)
                self.assertTrue(FreeCADGui.Control.activeDialog())
                self.assertTrue(obj.ViewObject.isVisible())
                self.press(ending)
                self.assertEqual(list(self.document.UndoNames), [])
                self.assertIsNone(FreeCAD.getActiveTransaction())

    def test_two_applies_after_a_double_click_are_two_steps(self):
        panel = self.meshed()
        self.press("Ok")
        self.document.clearUndos()
        again = self.caught(lambda: self.double_click_in_tree(panel.obj))
        for size in (12.0, 15.0):
            again.field("size").value = size
            self.apply(again)
        again.field("size").value = 9.0
        self.press("Ok")
        self.assertEqual(list(self.document.UndoNames), ["Mesh parameters", "Hexahedral mesh", "Hexahedral mesh"])
        for size in (15, 12, 10):
            self.document.undo()
            self.assertEqual(panel.obj.CharacteristicLengthMax.Value, size)

    def test_a_mesh_that_ends_while_another_document_is_active(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 10.0
        other = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(other.Name))
        FreeCAD.setActiveDocument(self.name)
        self.press("Apply")
        FreeCAD.setActiveDocument(other.Name)
        self.assertTrue(wait_until(lambda: not panel.process and not panel._taking))
        self.assertEqual(FreeCAD.ActiveDocument.Name, other.Name)
        self.assertEqual(list(other.UndoNames), [])
        self.assertEqual(list(self.document.UndoNames), ["Hexahedral mesh from shape"])
        FreeCAD.setActiveDocument(self.name)


class Macros(PanelTest):
    """What the panel did, done again by the lines that it left."""

    def setUp(self):
        super().setUp()
        self.lines = []
        patch = mock.patch.object(macro, "record", lambda line, _: self.lines.append(line))
        patch.start()
        self.addCleanup(patch.stop)

    def replay(self):
        """The lines in a document with the same part; returns the meshes."""
        document = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(document.Name))
        box = document.addObject("Part::Box", "Block")
        box.Length, box.Width, box.Height = 60, 40, 20
        ObjectsFem.makeAnalysis(document, "Analysis")
        document.recompute()
        FreeCAD.setActiveDocument(document.Name)
        exec("\n".join(self.lines), {"App": FreeCAD, "Gui": FreeCADGui})
        FreeCAD.setActiveDocument(self.name)
        return document, [obj for obj in document.Objects if objects.is_polycube(obj)]

    @staticmethod
    def same(a, b):
        points = [{number: tuple(point) for number, point in obj.FemMesh.Nodes.items()} for obj in (a, b)]
        cells = [[obj.FemMesh.getElementNodes(cell) for cell in obj.FemMesh.Volumes] for obj in (a, b)]
        return points[0] == points[1] and cells[0] == cells[1]

    def test_a_session_replays_to_the_same_meshes(self):
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        panel = self.open_panel(self.box)
        panel.field("size").value = 7.3
        panel.field("order").value = 1
        panel.field("sizes").value = "Face1=5"
        self.apply(panel)
        document, (made,) = self.replay()
        self.assertTrue(self.same(panel.obj, made), self.lines)
        self.assertIn(made, document.Analysis.Group)
        self.assertEqual(option_table.read(made), option_table.read(panel.obj))
        panel.field("size").value = 0
        panel.field("hexes").value = 300
        panel.field("sizes").value = ""
        panel.field("min_layers").value = 3
        self.apply(panel)
        panel.field("hexes").value = 400
        panel.field("effort").value = "quick"
        panel.analysis_box.setCurrentIndex(0)
        self.press("Ok")
        document, (made,) = self.replay()
        self.assertTrue(self.same(panel.obj, made), self.lines)
        self.assertEqual(option_table.read(made), option_table.read(panel.obj))
        self.assertEqual(made.MeshState, objects.OUTDATED)
        self.assertNotIn(made, document.Analysis.Group)
        self.assertEqual(self.lines[0], "from freecad import polycube")


class RecordedMacro(PanelTest):
    def test_freecad_records_the_lines_and_not_the_opening(self):
        """By FreeCAD's own macro recorder, as the user starts and stops it."""
        folder = self.enterContext(tempfile.TemporaryDirectory())
        path = os.path.join(folder, "recorded.FCMacro")

        def record():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is None:
                QtCore.QTimer.singleShot(50, record)
                return
            edits = dialog.findChildren(QtGui.QLineEdit)
            name = next(edit for edit in edits if edit.objectName() == "lineEditPath")
            place = next((edit for edit in edits if edit.objectName() == "lineEditMacroPath"), None)
            name.setText("recorded")
            if place:
                place.setText(folder + "/")
            dialog.findChild(QtGui.QPushButton, "buttonStart").click()

        QtCore.QTimer.singleShot(50, record)
        FreeCADGui.runCommand("Std_DlgMacroRecord")
        process_events()
        self.meshed()
        self.press("Ok")
        FreeCADGui.runCommand("Std_MacroStopRecord" if "Std_MacroStopRecord" in FreeCADGui.listCommands() else "Std_DlgMacroRecord")
        process_events()
        with open(path, encoding="utf-8") as file:
            lines = file.read()
        self.assertIn("polycube.create_fem_mesh(App.ActiveDocument.getObject('Block'), size=10.0)", lines)
        self.assertNotIn("Gui.runCommand('Polycube", lines)
        (recorded,) = [obj for obj in self.document.Objects if objects.is_polycube(obj)]
        document = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(document.Name))
        box = document.addObject("Part::Box", "Block")
        box.Length, box.Width, box.Height = 60, 40, 20
        document.recompute()
        exec(compile(lines, path, "exec"), {"App": FreeCAD, "Gui": FreeCADGui})
        (made,) = [obj for obj in document.Objects if objects.is_polycube(obj)]
        self.assertTrue(Macros.same(recorded, made), "bit for bit")


class Analyses(PanelTest):
    def test_three_clicks_from_a_solid_to_a_mesh_in_the_analysis(self):
        """The part is selected; command, Apply, OK."""
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        panel = self.open_panel(self.box)
        self.assertEqual(panel.analysis_box.currentText(), analysis.Label)
        self.apply(panel)
        self.press("Ok")
        self.assertIn(panel.obj, analysis.Group)
        self.assertNotIn("Touched", panel.obj.State)
        self.assertEqual(panel.obj.MeshState, objects.CURRENT)

    def test_a_mesh_joins_an_analysis_that_was_made_later(self):
        panel = self.meshed()
        self.press("Ok")
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        self.document.clearUndos()
        again = self.caught(lambda: panel.obj.ViewObject.Proxy.doubleClicked(panel.obj.ViewObject))
        self.assertEqual(again.analysis_box.currentText(), analysis.Label)
        self.press("Ok")
        self.assertIn(panel.obj, analysis.Group)
        self.assertEqual(list(self.document.UndoNames), ["Mesh parameters"])

    def test_what_the_mesh_will_not_have_is_listed_before_it_is_made(self):
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        other = self.document.addObject("Part::Box", "Other")
        fixed = ObjectsFem.makeConstraintFixed(self.document, "Support")
        analysis.addObject(fixed)
        other.Placement.Base.x = 100
        self.document.recompute()
        fixed.References = [(other, "Face1")]
        panel = self.open_panel(self.box)
        listed = panel.form.uncaptured
        self.assertFalse(listed.isVisible(), "no analysis is chosen")
        panel.analysis_box.setCurrentIndex(1)
        picture("uncaptured")
        self.assertTrue(listed.isVisible())
        self.assertEqual(listed.text(), "The mesh will not have:\n\u2022 Support: Face1 of Other is not of Block")
        fixed.References = [(self.box, "Face1")]
        self.press("Apply")
        self.assertFalse(listed.isVisible())
        self.press("Cancel")
        self.assertTrue(wait_until(lambda: not panel.process, 20))
        panel.analysis_box.setCurrentIndex(0)
        fixed.References = [(self.box, "Edge{}".format(number)) for number in range(1, 13)] + [(other, "Edge{}".format(number)) for number in range(1, 9)]
        panel.analysis_box.setCurrentIndex(1)
        self.assertEqual(len(listed.text().split("\n")), 8)
        self.assertIn("2 more", listed.text())
        self.press("Cancel")

    def test_the_command_twice_is_one_mesh(self):
        first = self.meshed()
        self.press("Ok")
        second = self.open_panel(self.box)
        self.assertIs(second.obj, first.obj)
        self.apply(second)
        self.press("Ok")
        self.assertEqual([obj for obj in self.document.Objects if objects.is_polycube(obj)], [first.obj])

    def test_an_analysis_with_another_mesh_gets_a_question(self):
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        old = self.document.addObject("Fem::FemMeshObject", "Tetrahedra")
        analysis.addObject(old)
        FemGui.setActiveAnalysis(analysis)
        panel = self.open_panel(self.box)
        with self.answer(QtGui.QMessageBox.No) as asked:
            self.press("Apply")
        self.assertEqual(len(asked), 1)
        self.assertIn("Tetrahedra", asked[0])
        self.assertIsNone(panel.process)
        self.assertIsNone(panel.obj)
        self.assertEqual(analysis.Group, [old])
        with self.answer(QtGui.QMessageBox.Yes) as asked:
            self.apply(panel)
        self.assertEqual(len(asked), 1)
        self.assertEqual(analysis.Group, [panel.obj])
        self.assertIs(self.document.getObject("Tetrahedra"), old)
        self.assertFalse(old.ViewObject.isVisible())
        with self.answer(QtGui.QMessageBox.No) as asked:
            self.apply(panel)
        self.assertEqual(asked, [], "its own mesh is no other")
        self.assertEqual(panel.form.status.text(), "Nothing has changed since this mesh was made.")
        self.press("Ok")


class Sizes(PanelTest):
    def test_a_local_size_that_makes_very_many_cells_is_asked_about(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 2.0
        self.assertRegex(panel.form.size_hint.text(), "about 6,000 cells")
        panel.field("sizes").value = "Face1=0.2"
        panel.changed()
        self.assertRegex(panel.form.size_hint.text(), r"up to about [\d,]{7,} cells, 6,000 without")
        with self.answer(QtGui.QMessageBox.No) as asked:
            self.press("Apply")
        self.assertIn("cells", asked[0])
        self.assertIsNone(panel.process)
        panel.field("sizes").value = ""
        with self.answer(QtGui.QMessageBox.No) as asked:
            self.press("Apply")
        self.assertEqual(asked, [])
        self.press("Cancel")
        self.assertTrue(wait_until(lambda: not panel.process, 10))
        self.press("Cancel")

    def test_one_way_to_say_how_fine(self):
        panel = self.open_panel(self.box)
        ways = {name: panel.field(name) for name in fields.FINENESS}
        for name, value in (("size", 3.0), ("hexes", 500), ("coarsest", True)):
            before = ways[name].value
            ways[name].value = value
            process_events(0.05)
            self.assertEqual({other for other, way in ways.items() if way.widget.isEnabled()}, {name})
            ways[name].value = before
            process_events(0.05)
            self.assertTrue(all(way.widget.isEnabled() for way in ways.values()))
        self.press("Cancel")


class EveryOption(PanelTest):
    def test_the_table_is_in_the_panel(self):
        panel = self.open_panel(self.box)
        for option in option_table.document_options():
            with self.subTest(option=option["name"]):
                if option["type"] == "labels":
                    self.assertIsNotNone(panel.axes.given)
                    continue
                widget = panel.field(option["name"]).widget
                self.assertIn(option["meaning"].split(".")[0][:30], widget.toolTip())
                if isinstance(widget, QtGui.QSpinBox):
                    self.assertEqual((widget.minimum(), widget.maximum()), (option["min"], option["max"]))
        self.press("Cancel")

    def test_a_new_option_needs_no_code(self):
        table = option_table.table()
        new = [
            {"name": "per_circle", "unit": "", "meaning": "Elements round circles.", "type": "int", "default": 8, "min": 4, "max": 99, "choices": [], "advanced": False},
            {"name": "haste", "unit": "s", "meaning": "Haste.", "type": "double", "default": 1.5, "min": 0, "max": 9, "choices": [], "advanced": True},
        ]
        known = {option["name"] for option in table}
        table += [option for option in new if option["name"] not in known]
        with mock.patch.object(option_table, "table", return_value=table):
            panel = self.open_panel(self.box)
            for name in ("per_circle", "haste"):
                one = panel.field(name)
                self.assertEqual(one.value, one.option["default"])
                one.value = 5
                self.assertEqual(panel._parameters()[name], 5)
            self.press("Cancel")

    def test_what_is_set_reaches_the_object_and_comes_back(self):
        panel = self.meshed()
        values = {"effort": "thorough", "min_layers": 2, "divisions": "Edge1=4", "refine": "Face2=1", "keep_faces": "Face1", "feature_angle": 5.0, "threads": 1, "sew": False}
        values.update(frame="0,1,0/-1,0,0", time_limit=90.0)
        for name, value in values.items():
            panel.field(name).value = value
        self.press("Ok")
        self.assertEqual(option_table.read(panel.obj), {"size": 10.0, **values})
        again = self.caught(lambda: panel.obj.ViewObject.Proxy.doubleClicked(panel.obj.ViewObject))
        self.assertEqual({name: again.field(name).value for name in values}, values)
        self.press("Cancel")


class Result(PanelTest):
    def test_the_list_is_by_the_chosen_measure(self):
        cylinder = self.document.addObject("Part::Feature", "Cylinder")
        cylinder.Shape = Part.makeCylinder(20, 30)
        panel = self.open_panel(cylinder)
        panel.field("size").value = 6.0
        self.apply(panel)
        cells = measures.Cells(panel.obj.FemMesh)
        for number, measure in enumerate(measures.MEASURES):
            with self.subTest(measure=measure.name):
                panel.result.measure_box.setCurrentIndex(number)
                values = cells.values(measure)
                worst = values[values.argsort()[0 if measure.name == "scaled_jacobian" else -1]]
                self.assertAlmostEqual(float(panel.result.worst.item(0, 1).text()), worst, delta=1e-3)
                self.assertEqual(sum(panel.result.histogram.counts), len(values))
                listed = int(panel.result.worst.item(0, 0).text())
                self.assertAlmostEqual(values[listed - 1], worst, delta=1e-3)
                self.assertIn("{:.2f}".format(worst), panel.result.summary.text() if number else "{:.2f}".format(worst))
        self.press("Ok")

    def test_cells_by_themselves(self):
        panel = self.meshed(5.0)
        scene = FreeCADGui.activeDocument().activeView().getSceneGraph()
        before, switch = scene.getNumChildren(), panel.obj.ViewObject.SwitchNode
        bar = max(range(measures.BARS), key=lambda bar: panel.result.histogram.counts[bar])
        width = panel.result.histogram.width() / measures.BARS
        place = QtCore.QPoint(round((bar + 0.5) * width), 40)
        panel.result.cut.setCurrentIndex(1)
        picture("cut")
        self.assertEqual(scene.getNumChildren(), before + 1)
        self.assertEqual(switch.whichChild.getValue(), -1, "the whole mesh is not drawn")
        panel.result.cut.setCurrentIndex(0)
        self.assertEqual(scene.getNumChildren(), before)
        self.assertNotEqual(switch.whichChild.getValue(), -1)
        mouse(panel.result.histogram, place)
        self.assertEqual(panel.result.histogram.chosen, bar)
        self.assertEqual(scene.getNumChildren(), before + 1)
        self.press("Ok")
        self.assertEqual(scene.getNumChildren(), before)
        self.assertNotEqual(switch.whichChild.getValue(), -1)

    def test_the_mesh_comes_back_after_the_preview(self):
        panel = self.meshed()
        panel.axes.preview.setChecked(True)
        self.assertTrue(wait_until(lambda: panel.axes.shown))
        self.assertFalse(panel.obj.ViewObject.isVisible())
        self.press("Ok")
        self.assertTrue(panel.obj.ViewObject.isVisible())
        self.assertFalse(self.box.ViewObject.isVisible())


class Preferences(PanelTest):
    """The page writes what the panel begins with and what jobs are run by."""

    def setUp(self):
        super().setUp()
        self.group = FreeCAD.ParamGet(preferences.GROUP)
        self.addCleanup(self.forget)

    def forget(self):
        """Nothing stays for other tests, nor in the file to which the page has written it."""
        for name in ("Threads", "ElementOrder", "Effort"):
            self.group.RemInt(name)
        self.group.RemString("TemporaryFolder")
        FreeCAD.saveParameter()

    def test_the_page(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())

        def fill():
            dialog = QtGui.QApplication.activeModalWidget()
            dialog.findChild(QtGui.QSpinBox, "Threads").setValue(1)
            dialog.findChild(QtGui.QComboBox, "ElementOrder").setCurrentIndex(0)
            dialog.findChild(QtGui.QComboBox, "Effort").setCurrentIndex(2)
            dialog.findChild(QtGui.QWidget, "TemporaryFolder").findChild(QtGui.QLineEdit).setText(folder)
            picture("preferences-all")
            dialog.accept()

        QtCore.QTimer.singleShot(1000, fill)
        FreeCADGui.showPreferences("Polycube", 0)
        process_events()
        self.assertEqual((preferences.threads(), preferences.folder()), (1, folder))
        panel = self.open_panel(self.box)
        self.assertEqual((panel.field("order").value, panel.field("effort").value), (1, "thorough"))
        panel.field("size").value = 0.5
        self.press("Apply")
        self.assertEqual(os.path.dirname(panel.job.folder), folder)
        with open(os.path.join(panel.job.folder, "options.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file)["threads"], 1)
        self.press("Cancel")
        self.assertTrue(wait_until(lambda: not panel.process, 20))
        self.assertEqual(os.listdir(folder), [])
        self.press("Cancel")

    def test_the_page_in_german(self):
        speak_german(self)
        process_events()  # FreeCAD 1.0 ends where its dialog hears of the language before it is shown
        texts = []

        def look():
            dialog = QtGui.QApplication.activeModalWidget()
            spin = dialog.findChild(QtGui.QSpinBox, "Threads")
            page = spin.parentWidget().parentWidget()
            texts.extend(widget.title() for widget in page.findChildren(QtGui.QGroupBox))
            texts.extend([spin.specialValueText(), dialog.findChild(QtGui.QComboBox, "Effort").itemText(2)])
            picture("preferences-german")
            dialog.reject()

        QtCore.QTimer.singleShot(1000, look)
        FreeCADGui.showPreferences("Polycube", 0)
        process_events()
        self.assertEqual(texts, ["Vernetzer", "Arbeit", "Neue Netze im Aufgabenbereich", "alle Kerne", "gründlich"])

    def test_a_folder_that_is_none(self):
        self.group.SetString("TemporaryFolder", "/nowhere/at/all")
        panel = self.open_panel(self.box)
        self.press("Apply")
        self.assertIsNone(panel.process)
        self.assertIn("names no folder", panel.form.status.text())
        with self.assertRaises(polycube.InvalidInput):
            polycube.mesh(self.box.Shape)
        self.press("Cancel")


class Best(PanelTest):
    def test_the_button_ends_the_search(self):
        """Shown from the first mesh on; here there is none yet, so nothing is handed out."""
        panel = self.open_panel(self.box)
        panel.field("size").value = 0.4
        self.press("Apply")
        self.assertFalse(panel.form.run.best.isVisible())
        panel._heard("log", "plan 2, 'finer', 3 fits done, best: 'first', 2 CAD edges lost, min SJ 0.31")
        self.assertTrue(panel.form.run.best.isVisible())
        mouse(panel.form.run.best, panel.form.run.best.rect().center())
        self.assertFalse(panel.form.run.best.isEnabled())
        self.assertTrue(wait_until(lambda: not panel.process, 60))
        self.assertEqual(panel.form.status.text(), "Stopped by the user.")
        self.assertFalse(panel.form.run.best.isVisible())
        self.press("Cancel")


class Words(PanelTest):
    def test_progress(self):
        run = RunSection()
        run.begin("Meshing Block ...")
        run.show_progress("tet", 0.5)
        self.assertEqual(run.status.text(), "Filling the part with tetrahedra ...")
        run.hear("plan 2, 'finer', 3 fits done, best: 'first', 2 CAD edges lost, min SJ 0.31")
        run.show_progress("fit", 0.5)
        self.assertEqual(run.status.text(), "Layout 2: Moving nodes onto the CAD ...\nBest so far: valid, all but 2 CAD edges, worst cell 0.31")
        run.hear("plan 3, 'else', 3 fits done, no mesh yet")
        run.show_progress("new stage", 0.1)
        self.assertTrue(run.best.isVisibleTo(run))
        run.end()
        self.assertFalse(run.best.isVisibleTo(run))

    def test_one_line_and_a_folded_log(self):
        panel = self.meshed()
        self.assertRegex(panel.form.status.text(), r"^Meshed: [\d,]+ cells, [\d,]+ nodes, worst cell [\d.]+\.")
        self.assertFalse(panel.form.run.log_fold.is_open())
        self.assertGreater(len(panel.form.log.toPlainText().splitlines()), 3)
        self.press("Ok")

    def test_colours_can_be_read_on_both_grounds(self):
        panel = self.open_panel(self.box)
        for ground, letters in (("#202020", "#f0f0f0"), ("#ffffff", "#000000")):
            palette = panel.form.log.palette()
            palette.setColor(QtGui.QPalette.Base, QtGui.QColor(ground))
            palette.setColor(QtGui.QPalette.Text, QtGui.QColor(letters))
            panel.form.log.setPalette(palette)
            panel.tell("Something is wrong", error=True)
            colour = panel.form.status.styleSheet().split("color:")[1].strip(" ;")
            self.assertGreater(contrast(colour, ground), 4.5, "as WCAG asks of text")
            self.assertIn(colour, panel.form.log.document().toHtml())
        self.press("Cancel")


def contrast(a, b):
    """WCAG's ratio of relative luminances."""

    def luminance(colour):
        channels = [channel / 12.92 if channel <= 0.03928 else ((channel + 0.055) / 1.055) ** 2.4 for channel in QtGui.QColor(colour).getRgbF()[:3]]
        return sum(weight * channel for weight, channel in zip((0.2126, 0.7152, 0.0722), channels))

    dark, light = sorted((luminance(a), luminance(b)))
    return (light + 0.05) / (dark + 0.05)


class Menu(PanelTest):
    def test_the_fem_menus_entry_is_enabled_with_a_selection_only(self):
        if hasattr(FreeCADGui, "addWorkbenchManipulator"):
            self.skipTest("FreeCAD fills the menu itself")
        menu = QtGui.QMenu()
        menu.addAction(init_gui._action(menu))
        (action,) = menu.actions()
        self.assertTrue(action.toolTip())
        self.assertTrue(action.statusTip())
        for selected in (False, True):
            FreeCADGui.Selection.clearSelection()
            if selected:
                FreeCADGui.Selection.addSelection(self.box)
            menu.aboutToShow.emit()
            self.assertEqual(action.isEnabled(), selected)


class Large(PanelTest):
    def test_the_window_goes_on_while_a_mesh_is_taken(self):
        """Between two breaths a fixed number of nodes or cells is added, whatever the size of the mesh."""
        panel = self.open_panel(self.box)
        panel.field("size").value = 2.5
        beats = []
        with mock.patch.object(task_panel.MeshPanel, "_breathe", lambda panel, fraction: beats.append(fraction)):
            with mock.patch("freecad.polycube.fem_mesh._SLICE", 500):
                obj = self.apply(panel)
        self.assertEqual(beats, sorted(beats))
        self.assertAlmostEqual(beats[-1], 1)
        self.assertGreater(len(beats), obj.NodeCount // 500 + obj.Hexahedra // 500)
        self.press("Ok")

    def test_a_document_that_is_closed_while_its_mesh_is_taken(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 5.0
        with mock.patch.object(task_panel.MeshPanel, "_breathe", lambda panel, fraction: self.is_open() and FreeCAD.closeDocument(self.name)):
            self.press("Apply")
            self.assertTrue(wait_until(lambda: not self.is_open()))
            process_events(0.5)
        self.assertIsNone(panel.form)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertIsNone(QtGui.QApplication.overrideCursor())

    def opened(self):
        """A panel of a mesh that it has not made: the cells are read from the document."""
        panel = self.meshed(4.0)
        self.press("Ok")
        return self.caught(lambda: panel.obj.ViewObject.Proxy.doubleClicked(panel.obj.ViewObject))

    def test_the_window_goes_on_while_cells_are_looked_at(self):
        """Of a large mesh, which 20,000 cells make one: between two breaths a fixed number of nodes or cells is read or measured."""
        panel = self.opened()
        result, beats, breathe = panel.result, [], panel.result._breathe
        self.enterContext(mock.patch.object(result, "_breathe", lambda: (beats.append(True), breathe())))
        self.enterContext(mock.patch.object(measures, "SLICE", 100))
        result.measure_box.setCurrentIndex(2)
        self.assertTrue(wait_until(lambda: "Skew" in result.measure_box.currentText() and result.worst.item(0, 2).text()))
        process_events()
        self.assertGreater(len(beats), panel.obj.NodeCount // 100 + 2 * panel.obj.Hexahedra // 100)
        beats.clear()
        scene = FreeCADGui.activeDocument().activeView().getSceneGraph()
        before = scene.getNumChildren()
        for place in (20, 40, 60):
            result.cut.setCurrentIndex(1)
            result.cut_place.setValue(place)
        process_events()
        self.assertEqual(len(beats), 3, "once for all")
        self.assertEqual(scene.getNumChildren(), before + 1)
        result.cut.setCurrentIndex(0)
        process_events()
        self.assertEqual(scene.getNumChildren(), before)
        self.press("Ok")

    def test_a_document_that_is_closed_while_cells_are_looked_at(self):
        for look in (
            lambda result: result.cut.setCurrentIndex(1),
            lambda result: result.measure_box.setCurrentIndex(1),
            lambda result: result.colours.setChecked(True),
            lambda result: result.worst.itemDoubleClicked.emit(result.worst.item(0, 0)),
        ):
            if not self.is_open():
                self.setUp()
            panel = self.opened()
            result, beats, breathe = panel.result, [], panel.result._breathe

            def close():
                beats.append(True)
                if self.is_open():
                    QtCore.QTimer.singleShot(0, lambda: self.is_open() and FreeCAD.closeDocument(self.name))
                breathe()

            with mock.patch.object(measures, "SLICE", 100), mock.patch.object(result, "_breathe", close):
                with mock.patch.object(FreeCAD.Console, "PrintError", create=True) as error:
                    look(result)
                    self.assertTrue(wait_until(lambda: not self.is_open(), 10))
                    process_events()
            self.assertEqual(error.call_args_list, [])
            self.assertLess(len(beats), 4, "it ends there")
            self.assertIsNone(panel.form)
            self.assertIsNone(result._cell_overlay)
            self.assertIsNone(QtGui.QApplication.overrideCursor())


class FromPython(PanelTest):
    def test_a_call_in_the_window_lets_it_go_on_and_can_be_cancelled(self):
        beats = []
        timer = QtCore.QTimer()
        timer.timeout.connect(lambda: beats.append(True))
        timer.start(20)
        polycube.mesh(self.box.Shape, size=5)
        self.assertGreater(len(beats), 3)

        def cancel():
            for bar in QtGui.QApplication.topLevelWidgets():
                if isinstance(bar, QtGui.QProgressDialog) and bar.isVisible():
                    bar.cancel()
                    return
            QtCore.QTimer.singleShot(50, cancel)

        QtCore.QTimer.singleShot(50, cancel)
        with self.assertRaises(polycube.Cancelled):
            polycube.create_fem_mesh(self.box, size=0.4)
        self.assertEqual(self.document.Objects, [self.box])
        self.assertFalse(commands.MeshFromShape().IsActive() and FreeCADGui.Control.activeDialog())
