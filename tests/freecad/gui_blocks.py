"""How long the window stands still: processor time of its thread between two beats of a timer, which other programs do not change; run by gui.sh.

POLYCUBE_PART names a file to mesh in place of the plate, POLYCUBE_CELLS a number of cells to take and to look at, 6000 unless told.
"""

import os
import time

import FreeCAD
import gui_panel
import Part
from gui_support import process_events, wait_until
from PySide import QtCore

PART = os.environ.get("POLYCUBE_PART")
CELLS = int(os.environ.get("POLYCUBE_CELLS", "6000"))
#: Seconds of the issue that asked for it: while the mesher runs; for what takes or shows cells; for all of taking up to so many cells.
MESHING, AT_ONCE, TAKING, TAKEN = 0.1, 0.3, 3.0, 50000


class Beats(QtCore.QTimer):
    """A timer that keeps the longest time between two of its beats while it is on."""

    def __init__(self):
        super().__init__()
        self.setInterval(5)
        self.timeout.connect(self.beat)
        self.again()
        self.start()

    def again(self):
        self.longest, self._began = 0.0, time.thread_time()
        self._last = self._began

    def beat(self):
        now = time.thread_time()
        self.longest, self._last = max(self.longest, now - self._last), now

    def taken(self):
        return self._last - self._began


class Blocks(gui_panel.PanelTest):
    def setUp(self):
        super().setUp()
        self.beats = Beats()
        self.addCleanup(self.beats.stop)

    def told(self, what):
        process_events(0.3)
        print("{}: {:.2f} s in one go, {:.2f} s in all".format(what, self.beats.longest, self.beats.taken()))
        return self.beats.longest

    def test_while_it_meshes(self):
        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = Part.read(PART) if PART else Part.makeBox(60, 40, 10).cut(Part.makeCylinder(8, 10, FreeCAD.Vector(20, 20, 0)))
        self.document.recompute()
        panel = self.open_panel(part)
        self.press("Apply")
        process_events(0.1)
        self.beats.again()
        longest = []
        finished = panel.process._done
        panel.process._done = lambda *made: (longest.append(self.beats.longest), finished(*made))
        self.assertTrue(wait_until(lambda: not panel.process and not panel._taking, 3600))
        print("meshing: {:.3f} s in one go".format(longest[0]))
        self.assertGreater(panel.obj.Hexahedra, 0)
        self.assertLess(longest[0], MESHING)
        self.press("Ok")

    def test_cells_that_are_taken_and_looked_at(self):
        panel = self.open_panel(self.box)
        panel.field("hexes").value = CELLS
        taking = []
        take = panel._take

        def taken(result):
            self.beats.again()
            take(result)
            self.beats.beat()
            taking.append(self.beats.taken())
            self.told("taking {} cells".format(panel.obj.Hexahedra))

        panel._take = taken
        self.apply(panel)
        if panel.obj.Hexahedra <= 1.2 * TAKEN:
            self.assertLess(self.beats.longest, AT_ONCE)
            self.assertLess(taking[0], TAKING)
        self.look(panel)
        self.press("Ok")
        again = self.caught(lambda: panel.obj.ViewObject.Proxy.doubleClicked(panel.obj.ViewObject))
        self.look(again, "opened again, ")
        self.press("Ok")

    def look(self, panel, when=""):
        result = panel.result
        for what, click in (
            ("a cut", lambda: result.cut.setCurrentIndex(1)),
            ("a cut moved", lambda: result.cut_place.setValue(30)),
            ("no cut", lambda: result.cut.setCurrentIndex(0)),
            ("colours", lambda: result.colours.setChecked(True)),
            ("another measure", lambda: result.measure_box.setCurrentIndex(2)),
            ("cells beyond", lambda: (result.threshold.setValue(0.001), result.below.setChecked(True))),
            ("blocks", lambda: result.blocks.setChecked(True)),
            ("a cell", lambda: result.worst.itemDoubleClicked.emit(result.worst.item(0, 0))),
        ):
            process_events(0.1)
            self.beats.again()
            click()
            self.assertLess(self.told(when + what), AT_ONCE, what)
