"""Runs one module of tests, POLYCUBE_GUI_MODULE, or what else unittest finds by that name, in a FreeCAD window and leaves the status in POLYCUBE_GUI_OUT/status."""

import importlib
import os
import sys
import unittest

import FreeCAD
import FreeCADGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
# FreeCAD 1.x has its start page before the document where this is not set.
FreeCAD.ParamGet("User parameter:BaseApp/Preferences/General").SetString("AutoloadModule", "NoneWorkbench")
FreeCADGui.showMainWindow()

name = os.environ["POLYCUBE_GUI_MODULE"]
importlib.import_module(name.split(".")[0])  # needs the window
outcome = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(unittest.defaultTestLoader.loadTestsFromName(name))
with open(os.path.join(os.environ["POLYCUBE_GUI_OUT"], "status"), "w", encoding="ascii") as file:
    file.write("0" if outcome.wasSuccessful() and outcome.testsRun else "1")
sys.stderr.flush()
os._exit(0)
