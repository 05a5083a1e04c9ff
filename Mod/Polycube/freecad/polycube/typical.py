"""How long a mesh takes, as far as it is known: from the mesh that there is of the part, else from those that were made on this computer before."""

import json

import FreeCAD

from . import preferences

#: Seconds for every CAD face of a part, as a mean in which the last mesh weighs this share (a guess: the computer and what else it does change, parts do more).
_ENTRY, _WEIGHT = "SecondsPerFace", 0.25


def seconds(obj, shape):
    """Of the next mesh of the shape; `obj`: its mesh object or None. None where nothing is known."""
    report = json.loads(obj.Report) if obj is not None and obj.Report else {}
    if report.get("stages"):
        return sum(stage["seconds"] for stage in report["stages"])
    return FreeCAD.ParamGet(preferences.GROUP).GetFloat(_ENTRY, 0.0) * len(shape.Faces) or None


def learn(shape, taken):
    """A mesh of the shape has taken so many seconds."""
    group, of_this = FreeCAD.ParamGet(preferences.GROUP), taken / max(len(shape.Faces), 1)
    before = group.GetFloat(_ENTRY, 0.0) or of_this
    group.SetFloat(_ENTRY, before + _WEIGHT * (of_this - before))
