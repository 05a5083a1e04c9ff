"""What the window shows of a solved analysis, in colours on the mesh of the result, by itself: the stresses, and how far they can be trusted."""

from . import analyses, objects, shapes
from .compat import part_of
from .words import noop, tr

#: Result object's property, its name and unit, in the order in which one is looked for that says something.
_FIELDS = [("vonMises", noop("Von Mises stress"), "MPa"), ("Temperature", noop("Temperature"), "K"), ("DisplacementLengths", noop("Displacement"), "mm")]
#: The same of the estimates of the error (estimate.py). What stresses are recovered from tells more than how much they differ at a node.
ERRORS = [("EnergyError", noop("Error of the stresses, of the part's mean"), "%"), ("StressError", noop("Difference of the stress from cell to cell"), "%")]


def field_of(result, fields=_FIELDS):
    """(name, unit, values of result.NodeNumbers) of what is shown of a result object; None where nothing of it is more than zero."""
    for name, title, unit in fields:
        values = list(getattr(result, name, ()))
        if len(values) == len(result.NodeNumbers) and any(values):
            return title, unit, values
    return None


def with_errors(analysis):
    """The last result object of the analysis that has an estimate of the error of its stresses, or None."""
    found = [obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemResultObject") and obj.Mesh and field_of(obj, ERRORS)]
    return found[-1] if found else None


def show(analysis, result, fields=_FIELDS):
    """Paints the result's mesh, and hides what stands in the same place. Returns a line that says what is shown; empty if nothing is."""
    found = field_of(result, fields)
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
