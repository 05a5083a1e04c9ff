"""What of an analysis a mesh of a part will not have, told before there is one: references to other parts, to what is gone, to seams and points."""

from . import fem_mesh, shapes
from .engine_words import told
from .words import tr

#: Constraints of FreeCAD's own types that act on all of the mesh.
_OF_ALL = ("Fem::ConstraintInitialTemperature", "Fem::ConstraintPython")


def lines(part, analysis, labels=None):
    """One line each for materials, constraints and loads of the analysis that the mesh of a part, or a list of these, will lack places for.

    labels: the LabelResult of the part, where it is known: edges that it gives up.
    """
    inside = shapes.solid_objects(part)
    if not analysis or not inside or not all(getattr(member, "Shape", None) for member in inside):
        return []
    part_of_mesh = _Part(part, labels)
    found, materials = [], []
    for member in analysis.Group:
        if member.isDerivedFrom("App::MaterialObject") and hasattr(member, "References"):
            materials.append(member)
        elif member.isDerivedFrom("Fem::Constraint"):
            found += ["{}: {}".format(member.Label, line) for line in part_of_mesh.lacks(member)]
    return list(dict.fromkeys(found + _materials(part_of_mesh, materials)))


def _materials(part, materials):
    """Materials of what is not in the part, and solids that have none though others have."""
    found, covered = [], set()
    for material in materials:
        if not material.References:
            covered.update(part.solids)
        for obj, names in material.References:
            numbers = fem_mesh.solids_of(part.part, obj, _listed(names))
            covered.update(numbers)
            if not numbers:
                found.append(tr("{}: {} is no solid of {}").format(material.Label, _what(obj, names), part.label))
    if materials:
        found += [tr("Solid{} of {} has no material").format(number, part.label) for number in part.solids if number not in covered]
    return found


def _listed(names):
    return [names] if isinstance(names, str) else list(names)


def _what(obj, names):
    names = ", ".join(filter(None, _listed(names)))
    return tr("{} of {}").format(names, obj.Label) if names else obj.Label


class _Part:
    """What is meshed, a document object or a list of these."""

    def __init__(self, part, labels):
        self.part = part
        self.shape = shapes.numbered_shape(part)
        self.solids = range(1, len(self.shape.Solids) + 1)
        self.label = ", ".join(one.Label for one in part) if isinstance(part, (list, tuple)) else part.Label
        self._lost = {"Edge{}".format(number): fate[1] for number, fate in labels.edges.items() if fate[0] == "lost"} if labels else {}

    def lacks(self, constraint):
        """Lines on what a constraint refers to."""
        references = getattr(constraint, "References", None)
        if references == [] and constraint.TypeId not in _OF_ALL:
            yield tr("refers to nothing")
        for obj, names in references or ():
            for name in filter(None, _listed(names)):  # no name is the whole object
                line = self._lack(obj, name)
                if line:
                    yield line

    def _lack(self, obj, name):
        shape = getattr(obj, "Shape", None)
        if not shape or shape.isNull():
            return tr("{} is a container, choose {} of the solid inside").format(obj.Label, name)
        if not fem_mesh.exists(shape, name):
            return tr("{} has no {} any more").format(obj.Label, name)
        kind = name.rstrip("0123456789")
        entity = shapes.entities(shape, kind)[int(name[len(kind) :]) - 1]
        own = shapes.names_in(self.part, obj, [name])
        if not own and not self._has_twin(entity):
            return tr("{} is not of {}").format(_what(obj, name), self.label)
        if entity.ShapeType == "Edge" and entity.Degenerated:
            return tr("{} is a point").format(_what(obj, name))
        if entity.ShapeType == "Edge" and shapes.is_seam(shape, entity):
            return tr("{} is {}").format(_what(obj, name), tr(shapes.SEAM))
        lost = next((self._lost[one] for one in own if one in self._lost), None)
        return tr("{} will have no mesh edges: {}").format(_what(obj, name), told(lost)) if lost else None

    def _has_twin(self, entity):
        """Whether the part has an entity where another object has this one: FreeCAD's search finds its nodes."""
        reach = shapes.RELATIVE_TOLERANCE * self.shape.BoundBox.DiagonalLength
        return any(shapes.coincide(own, entity, reach) for own in shapes.entities(self.shape, entity.ShapeType))
