"""What the window shows once an analysis is solved: the stresses in colours on the mesh of the result, by themselves."""

from . import analyses, objects, shapes
from .compat import part_of
from .words import noop, tr

#: Result object's property, its name and unit, in the order in which one is looked for that says something.
_FIELDS = [("vonMises", noop("Von Mises stress"), "MPa"), ("Temperature", noop("Temperature"), "K"), ("DisplacementLengths", noop("Displacement"), "mm")]


def field_of(result):
    """(name, unit, values of result.NodeNumbers) of what is shown of a result object; None where nothing of it is more than zero."""
    for name, title, unit in _FIELDS:
        values = list(getattr(result, name, ()))
        if len(values) == len(result.NodeNumbers) and any(values):
            return title, unit, values
    return None


def show(analysis, result):
    """Paints the result's mesh, and hides what stands in the same place. Returns a line that says what is shown; empty if nothing is."""
    found = field_of(result)
    if not found or result.Mesh is None:
        return ""
    title, unit, values = found
    for mesh in filter(objects.is_polycube, analysis.Group):
        mesh.ViewObject.hide()
        for part in shapes.solid_objects(part_of(mesh)) if part_of(mesh) else ():
            part.ViewObject.hide()
    for other in analyses.shown_results(analysis):
        other.ViewObject.hide()
    view = result.Mesh.ViewObject
    view.show()
    least, most = min(values), max(values)
    # FreeCAD's scale has blue at -1 and red at 1
    view.setNodeColorByScalars(list(result.NodeNumbers), [2 * (value - least) / (most - least) - 1 if most > least else 0.0 for value in values])
    return tr("{}: {:.4g} (blue) to {:.4g} {} (red). A double click on {} shows more.").format(tr(title), least, most, unit, result.Label)
