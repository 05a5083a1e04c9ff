"""Mesh and undo again and again in one document: nothing is left behind; run by gui.sh. POLYCUBE_ROUNDS sets how often, 5 unless told."""

import gc
import os
import tempfile
from unittest import mock

import FreeCADGui
import gui_panel
from gui_support import process_events

from freecad.polycube import objects

ROUNDS = int(os.environ.get("POLYCUBE_ROUNDS", "5"))
#: More memory than this after all rounds but the first two, in which libraries are loaded, is a leak. FreeCAD itself loses 0.7 MB with every FemMesh of 1,800
#: cells that it destroys, one made by hand too; so the mesh is a small one.
MOST = 50e6
#: Of each there is none when the panel is closed.
OURS = ("AxesSection", "Cells", "CellOverlay", "Job", "LabelResult", "MeshPanel", "MeshResult", "ResultSection", "Run")


def memory():
    """Bytes of this process that are in memory."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def children():
    """Processes that this one has started and that are still there, ended or not."""
    with open("/proc/self/task/{}/children".format(os.getpid()), encoding="ascii") as file:
        return file.read().split()


class Rounds(gui_panel.PanelTest):
    def test_mesh_and_undo(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.enterContext(mock.patch("tempfile.tempdir", folder))
        self.document.UndoMode = 1
        before, started = None, set(children())
        for number in range(ROUNDS):
            panel = self.open_panel(self.box)
            panel.field("size").value = 10.0
            self.assertIsNotNone(self.apply(panel), panel.form.log.toPlainText())
            panel.result.colours.setChecked(True)
            panel.result.cut.setCurrentIndex(1)
            panel.axes.preview.setChecked(number % 2 == 0)
            self.assertTrue(gui_panel.wait_until(lambda panel=panel: not panel.process))
            self.press("Ok")
            self.document.undo()
            process_events(0.05)
            self.assertEqual([obj for obj in self.document.Objects if objects.is_polycube(obj)], [])
            self.assertEqual(os.listdir(folder), [])
            self.assertEqual(set(children()) - started, set())
            self.assertFalse(FreeCADGui.Control.activeDialog())
            self.document.clearUndos()
            del panel
            gc.collect()
            self.assertEqual([type(thing).__name__ for thing in gc.get_objects() if type(thing).__name__ in OURS], [])
            if number == 1:
                before = memory()
        grown = memory() - before
        print("{} rounds, {:.1f} MB more".format(ROUNDS, grown / 1e6))
        self.assertLess(grown, MOST)
