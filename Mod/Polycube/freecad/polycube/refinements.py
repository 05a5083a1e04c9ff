"""Refinements: objects in the tree below a mesh, each of which asks something of the mesh at places of its part."""

import math

import FreeCAD

from . import compat, fem_mesh, option_table, shapes
from .errors import InvalidInput, did_you_mean
from .stateless import Stateless
from .words import noop, tr

_AXES = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"]


class Kind:
    """What a refinement asks for. `option`: the mesher's, which it adds to; `takes`: Face, Edge ...; `count`: how many places it needs, None for any."""

    def __init__(self, name, title, meaning, option, takes, value, count=None):
        self.name, self.title, self.meaning, self.option, self.takes, self.value, self.count = name, title, meaning, option, takes, value, count


#: value: type, name and default of the property that holds it, and what it means; None where there is none.
_ELEMENTS = ("App::PropertyString", "Elements", "4", "Number of elements: 6 exactly, 3.. at least, ..4 at most, 2..5")
_RATIO = ("App::PropertyFloat", "Ratio", 2.0, "From the start of the edge to its end")
#: Share of an edge's length below which no further element is asked for: lengths are rounded.
_SLACK = 1e-9
#: Times that elements are divided by three, at most, as the engine has it.
_MOST_LEVELS = 6
_SIZE = ("App::PropertyLength", "Size", 0.0, "Edge length")
_LEVELS = ("App::PropertyIntegerConstraint", "Levels", (1, 1, _MOST_LEVELS, 1), "Times that elements are divided into three along every edge")
_AXIS = ("App::PropertyEnumeration", "Axis", _AXES, "Axis")
_FACES, _EDGES, _ANY = ("Face",), ("Edge",), ("Face", "Edge", "Vertex", "Solid")
_TAKEN = {"Face": noop("face"), "Edge": noop("edge"), "Vertex": noop("vertex"), "Solid": noop("solid")}
KINDS = {
    kind.name: kind
    for kind in (
        Kind("size", noop("Local size"), noop("Another edge length at faces, at edges at most, or in solids"), "sizes", ("Face", "Edge", "Solid"), _SIZE),
        Kind("levels", noop("Local refinement"), noop("Elements at faces, edges or vertices, and no others, divided by three"), "refine", _ANY, _LEVELS),
        Kind("divisions", noop("Divisions"), noop("Number of elements along edges"), "divisions", _EDGES, _ELEMENTS),
        Kind("layers", noop("Layers"), noop("Number of elements between two opposite faces"), "divisions", _FACES, _ELEMENTS, 2),
        Kind("bore", noop("Elements round a bore"), noop("Number of elements round cylindrical faces"), "divisions", _FACES, _ELEMENTS),
        Kind("bias", noop("Bias"), noop("Length of the last element along edges over that of the first"), "bias", _EDGES, _RATIO),
        Kind("keep", noop("Faces to keep"), noop("Faces none of whose edges is ignored"), "keep_faces", _FACES, None),
        Kind("axis", noop("Axis of faces"), noop("The axis that faces take in the blocks"), "labels", _FACES, _AXIS),
    )
}


def make(mesh, kind, places, value=None):
    """A new refinement of a mesh object. places: names such as Face3 on the mesh's part. Call inside a transaction. Raises InvalidInput."""
    if kind not in KINDS:
        raise InvalidInput(tr("there is no refinement '{}'{}").format(kind, did_you_mean(kind, KINDS, tr("; there are "))))
    solid = shapes.solid_object(compat.part_of(mesh))
    check(solid, KINDS[kind], list(places), value)
    obj = mesh.Document.addObject("Fem::FeaturePython", "Refinement")
    Refinement(obj, kind)
    obj.Label = tr(KINDS[kind].title)
    obj.References = [(solid, list(places))]
    if value is not None:
        set_value(obj, value)
    if FreeCAD.GuiUp:
        from .refinement_view import RefinementView

        RefinementView(obj.ViewObject)
    mesh.Refinements = list(mesh.Refinements) + [obj]
    obj.Proxy.execute(obj)
    return obj


def is_refinement(obj):
    """Whether it is one of ours."""
    return getattr(getattr(obj, "Proxy", None), "Type", None) == Refinement.Type


def kind_of(obj):
    return KINDS[obj.Kind]


def mesh_of(obj):
    """The mesh object that a refinement belongs to, or None."""
    return next((mesh for mesh in obj.InList if obj in getattr(mesh, "Refinements", ())), None)


def move(obj, mesh):
    """Has a refinement ask of this mesh what it asked of another, or of none, at places of the same names; of none where `mesh` is None."""
    before = mesh_of(obj)
    if before is not None and before != mesh:
        before.Refinements = [one for one in before.Refinements if one != obj]
    if mesh is not None:
        places, part = places_of(obj), compat.part_of(mesh)
        solid = shapes.solid_object(part) if part else None
        if solid and any(owner != solid for owner, _ in obj.References):
            obj.References = [(solid, places)]
        if before != mesh:
            mesh.Refinements = list(mesh.Refinements) + [obj]
    obj.Proxy.execute(obj)


def adopt(obj):
    """A copy that belongs to no mesh becomes one of the mesh of the part that it refers to, where there is one such mesh."""
    if mesh_of(obj) is not None:
        return
    owners = {owner for owner, _ in obj.References}
    found = []
    for mesh in obj.Document.findObjects("Fem::FemMeshObject"):
        part = compat.part_of(mesh) if hasattr(mesh, "Refinements") else None
        if part and shapes.solid_object(part) in owners:
            found.append(mesh)
    move(obj, found[0] if len(found) == 1 else None)


def places_of(obj):
    """Names of the faces or edges."""
    return [name for _, names in obj.References for name in ([names] if isinstance(names, str) else names) if name]


def value_of(obj):
    """The value as text; empty where the kind has none."""
    value = kind_of(obj).value
    if not value:
        return ""
    held = getattr(obj, value[1])
    return held.UserString if hasattr(held, "UserString") else str(held)


def set_value(obj, value):
    """Sets what the refinement asks for: a length, a number of elements, an axis, as text or plain. Raises InvalidInput."""
    kind = kind_of(obj)
    checked = _checked(kind, value)
    if checked is not None:
        setattr(obj, kind.value[1], checked)


def _checked(kind, value):
    if not kind.value:
        return None
    if kind.option == "sizes":
        try:
            size = option_table.plain({"size": value})["size"]
        except InvalidInput:
            raise InvalidInput(tr("{}: '{}' is not a length").format(tr(kind.title), value)) from None
        if not size > 0:
            raise InvalidInput(tr("{}: the size must be greater than 0").format(tr(kind.title)))
        return size
    if kind.option == "labels":
        if value not in _AXES:
            raise InvalidInput(tr("{}: '{}' is not one of {}").format(tr(kind.title), value, ", ".join(_AXES)))
        return value
    if kind.option == "refine":
        try:
            levels = int(value)
        except (TypeError, ValueError):
            levels = 0
        if levels != float(value if levels else 0) or not 1 <= levels <= _MOST_LEVELS:
            raise InvalidInput(tr("{}: '{}' is not a whole number from 1 to {}").format(tr(kind.title), value, _MOST_LEVELS))
        return levels
    if kind.option == "bias":
        try:
            ratio = float(value)
        except (TypeError, ValueError):
            ratio = math.nan
        if not (ratio > 0 and math.isfinite(ratio)):
            raise InvalidInput(tr("{}: '{}' is not a ratio, a number greater than 0").format(tr(kind.title), value))
        return ratio
    text = str(value).replace(" ", "")
    low, dots, high = text.partition("..")
    if not all(part.isdigit() and int(part) > 0 for part in (low, high) if part) or not (low or high) or (not dots and not low):
        raise InvalidInput(tr("{}: '{}' is not a number of elements: 6, 3.., ..4 or 2..5").format(tr(kind.title), value))
    return text


def check(solid, kind, places, value=None):
    """Raises InvalidInput where the solid has not these places, or the kind cannot be there."""
    words = [tr(_TAKEN[one]) for one in kind.takes]
    wanted = tr(" or ").join(filter(None, [", ".join(words[:-1]), words[-1]]))
    if not places:
        raise InvalidInput(tr("{}: no {} is chosen").format(tr(kind.title), wanted))
    for name in places:
        if name.rstrip("0123456789") not in kind.takes:
            raise InvalidInput(tr("{}: {} is no {}").format(tr(kind.title), name, wanted))
        if not fem_mesh.exists(solid.Shape, name):
            raise InvalidInput(tr("{}: {} has no {} any more").format(tr(kind.title), solid.Label, name))
        if kind.name == "bore" and not _circle(solid.Shape, name):
            raise InvalidInput(tr("{}: {} has no full circle").format(tr(kind.title), name))
    if kind.count and len(places) != kind.count:
        raise InvalidInput(tr("{}: {} faces are needed, not {}").format(tr(kind.title), kind.count, len(places)))
    if value is not None:
        _checked(kind, value)


def _circle(shape, face):
    """The name of a closed circular edge of a face, or None."""
    for edge in shape.getElement(face).Edges:
        if len(edge.Vertexes) == 1 and edge.Curve.TypeId == "Part::GeomCircle":
            return next("Edge{}".format(number) for number, one in enumerate(shape.Edges, 1) if one.isSame(edge))
    return None


def fault(obj):
    """What is wrong with a refinement, in a line; empty if nothing is."""
    mesh = mesh_of(obj)
    if mesh is None:
        return tr("it belongs to no mesh: drop it onto one in the tree")
    part = compat.part_of(mesh)
    if part is None:
        return tr("the mesh has no part")
    try:
        solid = shapes.solid_object(part)
        if any(owner != solid for owner, _ in obj.References):
            return tr("it refers to another part than {}").format(solid.Label)
        kind = kind_of(obj)
        check(solid, kind, places_of(obj), getattr(obj, kind.value[1]) if kind.value else None)
    except InvalidInput as error:
        return str(error).split(": ", 1)[-1]
    return ""


def local_sizes(mesh):
    """{refinement: size in mm} of the local sizes that a mesh object obeys."""
    obeyed = [obj for obj in getattr(mesh, "Refinements", ()) if is_refinement(obj) and obj.Kind == "size" and not obj.Suppressed]
    return {obj: obj.Size.Value for obj in obeyed}


def with_refinements(options, mesh):
    """The options, with what the refinements of a mesh object ask for besides. InvalidInput names a faulty one."""
    asked = [obj for obj in getattr(mesh, "Refinements", ()) if obj is not None and is_refinement(obj) and not obj.Suppressed]
    if not asked:
        return options
    merged = dict(options)
    for obj in asked:
        wrong = fault(obj)
        if wrong:
            raise InvalidInput("{}: {}".format(obj.Label, wrong))
        for name, items in _items(obj, kind_of(obj)).items():
            option = next(one for one in option_table.table() if one["name"] == name)
            text = option_table.as_text(option, merged.get(name) or "")
            merged[name] = ",".join(filter(None, [text, *items]))
    labels = merged.get("labels")
    if isinstance(labels, str):
        merged["labels"] = option_table.from_text({"type": "labels"}, labels)
    return merged


def _items(obj, kind):
    """The refinement as {option: items of its text}."""
    places, value = places_of(obj), getattr(obj, kind.value[1]) if kind.value else None
    shape = obj.References[0][0].Shape
    if kind.name == "layers":
        return {kind.option: ["-".join(places) + "=" + value]}
    if kind.name == "bore":
        return {kind.option: sorted({"{}={}".format(_circle(shape, name), value) for name in places})}
    if kind.name == "keep":
        return {kind.option: places}
    if kind.name != "size":
        return {kind.option: ["{}={}".format(name, value) for name in places]}
    # Edges have no sizes of their own in the engine: as many elements at least.
    edges = ["{}={}..".format(name, math.ceil(shape.getElement(name).Length / value.Value * (1 - _SLACK))) for name in places if name.startswith("Edge")]
    others = ["{}={!r}".format(name, float(value.Value)) for name in places if not name.startswith("Edge")]
    return {option: items for option, items in (("sizes", others), ("divisions", edges)) if items}


#: Properties that hold what is asked for.
_VALUES = sorted({kind.value[1] for kind in KINDS.values() if kind.value})


class Refinement(Stateless):
    """Proxy of a refinement object."""

    Type = "Polycube::Refinement"

    def __init__(self, obj, kind):
        obj.Proxy = self
        obj.addProperty("App::PropertyString", "Kind", "Refinement", "What the refinement asks for")
        obj.Kind = kind
        obj.setEditorMode("Kind", 1)
        obj.addProperty("App::PropertyLinkSubListGlobal", "References", "Refinement", KINDS[kind].meaning)
        if not hasattr(obj, "Suppressed"):  # FreeCAD 1.x may have it for every object of FEM
            obj.addProperty("App::PropertyBool", "Suppressed", "Refinement", "Whether the mesh does without it")
        obj.addProperty("App::PropertyString", "Fault", "Refinement", "What is wrong with it")
        obj.setEditorMode("Fault", 1)
        if KINDS[kind].value:
            type_name, name, default, meaning = KINDS[kind].value
            obj.addProperty(type_name, name, "Refinement", meaning)
            setattr(obj, name, default)

    def onDocumentRestored(self, obj):
        if obj.Kind == "levels":
            obj.Levels = (obj.Levels, *_LEVELS[2][1:])  # documents do not hold the bounds

    def execute(self, obj):
        wrong = fault(obj)
        if obj.Fault != wrong:
            obj.Fault = wrong
            obj.Label2 = wrong  # FreeCAD's tree shows it

    def onChanged(self, obj, name):
        if "Restore" in obj.State or name not in ("References", "Suppressed", *_VALUES):
            return
        mesh = mesh_of(obj)
        if mesh is not None:
            self.execute(obj)
            mesh.Proxy.execute(mesh)
