"""What *Edit > Preferences > Polycube* holds; resources/ui/Preferences.ui names the same entries."""

import os

import FreeCAD

from . import option_table
from .errors import InvalidInput
from .words import tr

#: Where the entries are kept; that of the mesher is read by engine.py.
GROUP = "User parameter:BaseApp/Preferences/Mod/Polycube"
#: Options of which the page has a default for new meshes, in the panel only: scripts mean what they say. The index of the choice is kept.
_DEFAULTS = {"order": "ElementOrder", "effort": "Effort"}


def _group():
    return FreeCAD.ParamGet(GROUP)


def threads():
    """For meshes that do not say how many; 0 is all cores."""
    return max(_group().GetInt("Threads", 0), 0)


def folder():
    """Where jobs are, None for the system's place for temporary files. InvalidInput where it is none."""
    given = os.path.expanduser(_group().GetString("TemporaryFolder", ""))
    if given and not os.path.isdir(given):
        raise InvalidInput(tr("the preference for temporary files names no folder: {}").format(given))
    return given or None


def panel_defaults():
    """Options that a new mesh in the panel begins with, those that are not the mesher's defaults."""
    found = {}
    for option in option_table.table():
        entry = _DEFAULTS.get(option["name"])
        if entry:
            choices = [int(choice) if option["type"] == "int" else choice for choice in option["choices"]]
            chosen = choices[min(max(_group().GetInt(entry, choices.index(option["default"])), 0), len(choices) - 1)]
            if chosen != option["default"]:
                found[option["name"]] = chosen
    return found
