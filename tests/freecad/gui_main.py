"""Runs gui_tests.py in a FreeCAD window and leaves the status in POLYCUBE_GUI_OUT/status."""

import os
import sys
import unittest

import FreeCADGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
FreeCADGui.showMainWindow()

import gui_tests  # noqa: E402  (needs the window)

outcome = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(unittest.defaultTestLoader.loadTestsFromModule(gui_tests))
with open(os.path.join(os.environ["POLYCUBE_GUI_OUT"], "status"), "w", encoding="ascii") as file:
    file.write("0" if outcome.wasSuccessful() and outcome.testsRun else "1")
sys.stderr.flush()
os._exit(0)
