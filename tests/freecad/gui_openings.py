"""The panel opened and closed again and again, in every way that a panel opens and closes; run by gui.sh.

POLYCUBE_OPENINGS sets how often, 24 unless told: 300 take two to five minutes.
"""

import gc
import os
import signal
import sys
from unittest import mock

import FreeCAD
import FreeCADGui
from gui_support import GuiTest, process_events, wait_until
from PySide import QtGui

from freecad import polycube
from freecad.polycube import shapes, task_panel

OPENINGS = int(os.environ.get("POLYCUBE_OPENINGS", "24"))


class Openings(GuiTest):
    def setUp(self):
        super().setUp()
        self.obj = polycube.create_fem_mesh(self.box, size=20)

    def open_anew(self):
        return self.open_panel(self.box)

    def open_the_mesh(self):
        return self.caught(lambda: self.obj.ViewObject.Proxy.doubleClicked(self.obj.ViewObject))

    def close_by_cancel(self):
        self.press("Cancel")

    def close_by_ok(self):
        self.press("Ok")

    def close_without_a_word(self):
        FreeCADGui.Control.closeDialog()
        FreeCADGui.activeDocument().resetEdit()
        process_events(0.02)

    def check(self, panel):
        """All that the panel shows is there, is of its own kind and works."""
        form, axes, result = panel.form, panel.axes, panel.result
        self.assertTrue(FreeCADGui.Control.activeDialog())
        for widget, kind in (
            (form.parameters, QtGui.QWidget), (form.part, QtGui.QLabel), (form.progress, QtGui.QProgressBar), (form.log, QtGui.QPlainTextEdit),
            (form.time, QtGui.QLabel), (axes.preview, QtGui.QCheckBox), (axes.given, QtGui.QListWidget), (axes.automatic, QtGui.QPushButton),
            (result.summary, QtGui.QLabel), (result.colours, QtGui.QCheckBox), (result.worst, QtGui.QTableWidget),
            (panel.field("hexes").widget, QtGui.QSpinBox), (panel.field("order").widget, QtGui.QComboBox), (panel.field("sizes").widget, QtGui.QLineEdit),
        ):
            self.assertIsInstance(widget, kind)
        self.assertEqual(form.part.text(), self.box.Label)
        self.assertEqual(panel.field("size").value, 20 if panel.obj else 0)
        self.assertEqual("cells" in result.summary.text(), panel.obj is not None)
        self.assertEqual(result.worst.rowCount() > 0, panel.obj is not None)
        form.log.clear()
        panel.log("opened")
        self.assertIn("opened", form.log.toPlainText())
        self.assertIs(form.isVisible(), True)

    def test_every_opening_works(self):
        ways_in = [self.open_anew, self.open_the_mesh]
        ways_out = [self.close_by_cancel, self.close_without_a_word, self.close_by_ok]
        failures = []
        for number in range(OPENINGS):
            way_in, way_out = ways_in[number % 2], ways_out[number % 3]
            try:
                panel = way_in()
                self.check(panel)
                if number % 5 == 0:
                    panel.result.worst.selectRow(0)
                    panel.result.colours.setChecked(panel.obj is not None)
                way_out()
                self.assertFalse(FreeCADGui.Control.activeDialog())
                # Some panels live on a while, as those do that Python has not collected yet.
                if number % 4 == 0:
                    del panel
                    gc.collect()
            except Exception as error:
                failures.append("{}: {} {}: {}".format(number, way_in.__name__, way_out.__name__, error))
                FreeCADGui.Control.closeDialog()
                FreeCADGui.activeDocument().resetEdit()
        print("{} openings, {} failures".format(OPENINGS, len(failures)))
        self.assertEqual(failures, [])
        self.assertIs(self.document.getObject(self.obj.Name), self.obj)
        self.assertEqual(self.obj.Hexahedra, self.obj.FemMesh.HexaCount)


class ClosedWithoutAWord(GuiTest):
    """FreeCAD closes the panel by itself: for a script, for another command, or with the document."""

    def open(self, edit):
        if not edit:
            return self.open_panel(self.box)
        obj = polycube.create_fem_mesh(self.box, size=20)
        return self.caught(lambda: obj.ViewObject.Proxy.doubleClicked(obj.ViewObject))

    def close_document(self):
        FreeCAD.closeDocument(self.name)

    def each_way(self, work):
        """work(close, edit, panel) as a subtest for each way to open the panel and to close it."""
        for close in (FreeCADGui.Control.closeDialog, self.close_document):
            for edit in (False, True):
                with self.subTest(close=close.__name__, edit=edit):
                    if not self.is_open():
                        self.setUp()
                    work(close, edit, self.open(edit))

    def check(self, begin):
        """Whatever was begun ends, in each way of closing: the child process, its folder, the preview, the panel itself."""

        def work(close, edit, panel):
            scene = FreeCADGui.activeDocument().activeView().getSceneGraph()
            before = scene.getNumChildren()
            begin(panel)
            pid, folder = int(panel.process.processId()), panel.job.folder
            self.assertTrue(os.path.exists(folder))
            close()
            process_events()
            self.assertFalse(FreeCADGui.Control.activeDialog())
            self.assertIsNone(panel.form)
            self.assertIsNone(panel.process)
            self.assertIsNone(panel.axes.overlay)
            self.assertFalse(os.path.exists("/proc/{}".format(pid)))
            self.assertFalse(os.path.exists(folder))
            self.assertFalse(task_panel.MeshPanel.is_meshing(panel.obj))
            if self.is_open():
                FreeCADGui.activeDocument().resetEdit()
                self.assertEqual(scene.getNumChildren(), before)
                self.assertEqual(len(self.document.Objects), 2 if edit else 1)

        self.each_way(work)

    def test_with_all_marks_on(self):
        """What marks the mesh and what listens in the 3D view goes with the panel, without an error, after an Apply too."""

        def work(close, edit, panel):
            panel.field("size").value = 20.0
            self.press("Apply")
            self.assertTrue(wait_until(lambda: not panel.process))
            panel.axes.preview.setChecked(True)
            self.assertTrue(wait_until(lambda: not panel.process))
            panel.result.worst.selectRow(0)
            panel.result.colours.setChecked(True)
            view, clicks = panel.obj.ViewObject, panel.axes.clicks
            self.assertTrue(view.HighlightedNodes)
            with mock.patch.object(FreeCAD.Console, "PrintError", create=True) as error:
                with mock.patch.object(clicks, "remove", wraps=clicks.remove) as removed:
                    close()
                    process_events()
            self.assertEqual(error.call_args_list, [])
            removed.assert_called_once_with()
            self.assertIsNone(panel.form)
            self.assertIsNone(panel.axes.clicks)
            if self.is_open():
                self.assertEqual(list(view.HighlightedNodes), [])
                FreeCADGui.activeDocument().resetEdit()
                self.document.removeObject(panel.obj.Name)

        self.each_way(work)

    def test_while_it_meshes(self):
        def begin(panel):
            panel.field("size").value = 0.4
            self.press("Apply")
            process_events(0.3)

        self.check(begin)

    def test_while_it_labels(self):
        self.check(lambda panel: panel.axes.preview.setChecked(True))

    def test_with_a_preview(self):
        def begin(panel):
            panel.axes.preview.setChecked(True)
            self.assertTrue(wait_until(lambda: not panel.process))
            panel.axes.update()

        self.check(begin)


class Gone(GuiTest):
    def test_an_object_out_of_its_document_does_not_exist(self):
        class Document:
            """As in FreeCAD 1.0; 0.20 returns None."""

            @staticmethod
            def getObject(name):
                if not isinstance(name, str):
                    raise TypeError("must be str or int, not NoneType")

        class Undone:
            Name = None

        Undone.Document = Document
        self.assertFalse(shapes.exists(Undone))
        self.assertFalse(shapes.exists(None))
        self.assertTrue(shapes.exists(self.box))
        self.document.removeObject(self.box.Name)
        self.assertFalse(shapes.exists(self.box))

    def errors_of(self, deed):
        """What goes wrong in slots meanwhile: Qt leaves it to sys.excepthook."""
        errors = []
        with mock.patch.object(sys, "excepthook", lambda *error: errors.append(repr(error[1]))):
            deed()
            process_events(0.3)
        return errors

    def test_a_part_that_goes_while_it_is_meshed(self):
        for undo in (1, 0):
            for kill in (False, True):
                with self.subTest(undo=undo, kill=kill):
                    self.document.UndoMode = undo
                    part = self.document.addObject("Part::Box", "Going")
                    self.document.recompute()
                    panel = self.open_panel(part)

                    def mesh():
                        panel.apply()
                        process_events(0.1)
                        self.document.removeObject(part.Name)
                        if kill:
                            os.kill(int(panel.process.processId()), signal.SIGSEGV)
                        wait_until(lambda: not panel.process, 60)

                    self.assertEqual(self.errors_of(mesh), [])
                    self.assertRegex(panel.form.run.status.text(), "Refused.*SIGSEGV" if kill else "gone")
                    self.press("Cancel")

    def test_a_panel_whose_part_is_gone_is_used(self):
        panel = self.open_panel(self.box)
        self.document.removeObject(self.box.Name)
        for use in (
            lambda: panel.field("order").widget.setCurrentIndex(0),
            lambda: panel.axes.preview.setChecked(True),
            panel.hint.begin,
            panel.apply,
        ):
            with self.subTest(use):
                self.assertEqual(self.errors_of(use), [])
        self.assertIn("no part", panel.form.run.status.text())
