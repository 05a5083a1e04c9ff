"""What the window's tests share: a window with a block in it, the panel opened by the command, buttons, pictures."""

import os
import time
import unittest

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from freecad.polycube import commands, task_panel

OUT = os.environ["POLYCUBE_GUI_OUT"]


def process_events(seconds=0.2):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QtGui.QApplication.processEvents(QtCore.QEventLoop.AllEvents, 20)


def wait_until(condition, seconds=240):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        process_events(0.05)
    return condition()


def mouse(widget, point, double=False):
    """A click of the left button at a point of the widget, or two; as QTest does it, which FreeCAD's PySide does not have."""
    at, there = QtCore.QPointF(point), QtCore.QPointF(widget.mapToGlobal(point))
    kinds = [QtCore.QEvent.MouseButtonPress, QtCore.QEvent.MouseButtonRelease]
    if double:
        kinds += [QtCore.QEvent.MouseButtonDblClick, QtCore.QEvent.MouseButtonRelease]
    for kind in kinds:
        held = QtCore.Qt.NoButton if kind == QtCore.QEvent.MouseButtonRelease else QtCore.Qt.LeftButton
        QtGui.QApplication.sendEvent(widget, QtGui.QMouseEvent(kind, at, there, QtCore.Qt.LeftButton, held, QtCore.Qt.NoModifier))


def picture(name):
    process_events(0.2)
    QtGui.QApplication.primaryScreen().grabWindow(0).save(os.path.join(OUT, name + ".png"))


def set_panel_width(width):
    """Returns the dock of the task panel: in FreeCAD 0.20 it has the tree too, in 1.x it is for the panel alone."""
    window = FreeCADGui.getMainWindow()
    docks = {dock.objectName(): dock for dock in window.findChildren(QtGui.QDockWidget)}
    dock = docks.get("Combo View") or docks["Tasks"]
    window.resizeDocks([dock], [width], QtCore.Qt.Horizontal)
    return dock


class GuiTest(unittest.TestCase):
    def setUp(self):
        FreeCADGui.activateWorkbench("PolycubeWorkbench")
        window = FreeCADGui.getMainWindow()
        window.showMaximized()
        for dock in window.findChildren(QtGui.QDockWidget):
            if dock.objectName() in ("Report view", "Python console"):
                dock.hide()
        set_panel_width(460)
        self.document = FreeCAD.newDocument()
        self.name = self.document.Name
        self.document.UndoMode = 1
        self.box = self.document.addObject("Part::Box", "Block")
        self.box.Length, self.box.Width, self.box.Height = 60, 40, 20
        self.document.recompute()
        self.document.clearUndos()
        FreeCADGui.activeDocument().activeView().viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")

    def tearDown(self):
        panel = task_panel.MeshPanel._running
        if panel:
            panel.cancel()
            wait_until(lambda: not panel.process, 10)
        FreeCADGui.Control.closeDialog()
        FreeCADGui.Selection.clearSelection()
        if self.is_open():
            FreeCAD.closeDocument(self.name)
        process_events()

    def is_open(self):
        return self.name in FreeCAD.listDocuments()

    def open_panel(self, part):
        """Runs the command on the part; returns the panel."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(part)
        return self.caught(lambda: FreeCADGui.runCommand(commands.MeshFromShape.Name))

    def caught(self, opens):
        """The panel that `opens` opens: FreeCAD does not hand it out, so it is caught on its way."""
        panels = []
        original = task_panel.MeshPanel.__init__

        def catch(panel, *arguments, **named):
            panels.append(panel)
            original(panel, *arguments, **named)

        task_panel.MeshPanel.__init__ = catch
        try:
            opens()
        finally:
            task_panel.MeshPanel.__init__ = original
        process_events()
        self.assertEqual(len(panels), 1)
        return panels[0]

    def press(self, name):
        """Presses a button of the task panel."""
        wanted = getattr(QtGui.QDialogButtonBox, name)
        for box in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox):
            button = box.button(wanted)
            if button and button.isVisible():
                button.click()
                process_events(0.1)
                return
        self.fail("no button " + name)
