"""What is done in the window, as lines of Python in FreeCAD's console and in the macro that is recorded."""

import FreeCAD
import FreeCADGui

from . import api, option_table, refinements
from .compat import part_of


def record(line, obj):
    """Echoes a line of Python that has been done already, to `obj`."""
    with api.echo(obj):
        FreeCADGui.doCommand(line)


def begin():
    """The line that all others need. FreeCAD records a command that echoes nothing as a call of the command, which would open its panel on replay."""
    record("from freecad import polycube", None)


def name(obj):
    """A document object as a macro names it, in whatever document is active when the macro runs; of another document by that one's name."""
    if obj is None:
        return "None"
    return "{}.getObject({!r})".format(document(obj.Document), obj.Name)


def document(one):
    """A document likewise."""
    active = FreeCAD.ActiveDocument
    return "App.ActiveDocument" if active and active.Name == one.Name else "App.getDocument({!r})".format(one.Name)


def created(obj, options):
    """A mesh object was made of its part."""
    _call("create_fem_mesh", part_of(obj), options, obj)


def put_together(compound, parts):
    """A compound of parts was made, to be meshed."""
    record("polycube.compound_of([{}])".format(", ".join(map(name, parts))), compound)


def updated(obj, before, now):
    """A mesh object was meshed anew; `before` and `now`: its options, without defaults."""
    _call("update_fem_mesh", obj, changed(before, now), obj)


def set_options(obj, before, now):
    """Options of a mesh object were changed, without a mesh."""
    if before != now:
        _call("set_options", obj, changed(before, now), obj)


def set_analysis(obj, analysis):
    """A mesh object is that of another analysis now, or of none."""
    record("polycube.set_analysis({}, {})".format(name(obj), name(analysis)), obj)


def set_solving(obj, changed):
    """A mesh object is solved in another way now; changed: properties."""
    for one, value in changed.items():
        record("{}.{} = {!r}".format(name(obj), one, value), obj)


def made_empty(obj):
    """A mesh object without cells was made of its part."""
    record("polycube.create_fem_mesh({}, only_object=True)".format(name(part_of(obj))), obj)


def refined(obj, mesh):
    """A refinement of a mesh object was made."""
    value = refinements.value_of(obj)
    arguments = [name(mesh), repr(obj.Kind), repr(refinements.places_of(obj))] + ([repr(value)] if value else [])
    record("polycube.refine({})".format(", ".join(arguments)), obj)


def set_refinement(obj, **changes):
    """A refinement was changed."""
    record("polycube.set_refinement({}, {})".format(name(obj), ", ".join("{}={!r}".format(*change) for change in changes.items())), obj)


def _call(function, first, options, obj):
    arguments = [name(first)] + ["{}={!r}".format(*item) for item in options.items()]
    record("polycube.{}({})".format(function, ", ".join(arguments)), obj)


def changed(before, now):
    """The options that differ, those that are at their default again with it."""
    defaults = {option["name"]: option["default"] for option in option_table.table()}
    both = {**{key: defaults[key] for key in before}, **now}
    return {key: value for key, value in both.items() if value != before.get(key, defaults[key])}
