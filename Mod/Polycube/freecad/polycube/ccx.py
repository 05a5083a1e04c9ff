"""Where the solver CalculiX is. Debian 13 has no package of it."""

import os
import shutil

import FreeCAD


def noop(text):
    """As words.noop(), which cannot be had where this file is run by its path."""
    return text


MISSING = noop("CalculiX is not there; POLYCUBE_CCX=/path/to/ccx names it, or FreeCAD's preferences (FEM, CalculiX)")
NAMES_NONE = noop("POLYCUBE_CCX names no program: {}")


def find():
    """Path of the program: POLYCUBE_CCX, else the one in FreeCAD's preferences, else ccx on PATH; None if there is none."""
    named = os.environ.get("POLYCUBE_CCX")
    if named:
        found = shutil.which(named)
        if not found:
            raise RuntimeError(NAMES_NONE.format(named))
        return found
    preferences = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Fem/Ccx")
    preferred = None if preferences.GetBool("UseStandardCcxLocation", True) else preferences.GetString("ccxBinaryPath", "")
    return shutil.which(preferred or "ccx")
