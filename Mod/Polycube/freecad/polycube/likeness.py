"""Objects that show another one, which stands in containers, where it stands: members of the compound that such objects are meshed as.

A link of FreeCAD's would do as much. But undoing the making of a link ends FreeCAD 1.0 (its issue 18326), and documents of older versions have such links.
"""

import FreeCAD

from . import shapes
from .stateless import Stateless
from .words import tr


def make(obj):
    """A new hidden likeness of a document object. Call inside a transaction."""
    made = obj.Document.addObject("Part::FeaturePython", obj.Name)
    Likeness(made)
    made.Label = obj.Label
    made.Source = obj
    if FreeCAD.GuiUp:
        made.ViewObject.Proxy = 0  # FreeCAD's own way to show it
    made.Visibility = False
    made.recompute()
    made.purgeTouched()
    return made


class Likeness(Stateless):
    """Proxy of a likeness."""

    Type = shapes.LIKENESS

    def __init__(self, obj):
        obj.Proxy = self
        obj.addProperty("App::PropertyLinkGlobal", "Source", "Polycube", "Object that is shown where it stands")
        obj.addProperty("App::PropertyLinkListGlobal", "Containers", "Polycube", "What that is in; where it is moved, this is")
        for name in ("Source", "Containers"):
            obj.setEditorMode(name, 1)

    def execute(self, obj):
        if obj.Source is None:
            raise RuntimeError(tr("what {} shows is gone").format(obj.Label))
        around = shapes.containers_of(obj.Source)
        if obj.Containers != around:
            obj.Containers = around
        shape = shapes.shape_of(obj.Source)
        obj.Placement, obj.Shape = shape.Placement, shape  # a recompute gives the shape the placement of the object
