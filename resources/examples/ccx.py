"""The workbench's ccx.py, for the demo and the tests: those that start no FreeCAD have no workbench to import it from."""

import os
import runpy

_REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
_MODULE = runpy.run_path(os.path.join(_REPO, "Mod", "Polycube", "freecad", "polycube", "ccx.py"))
find, MISSING = _MODULE["find"], _MODULE["MISSING"]
