"""The shape of a document object, or of several: where it stands, has it solids, what are its entities called, and is it still the one that was meshed?"""

from .errors import InvalidInput
from .words import noop, tr

RELATIVE_TOLERANCE = 1e-7
#: type of the proxies of likenesses
LIKENESS = "Polycube::Likeness"
#: what is wrong with a seam
SEAM = noop("a seam, where a round face closes: the mesh has nodes there by chance only")


def shape_of(thing, beside=None):
    """The Part.Shape of a shape, or of a document object as it stands in the 3D view, whatever containers and links it is in. Raises InvalidInput.

    Of a list of these it is a compound. With `beside`, a document object, the coordinates are those of the container that this one is in: what is made of the
    shape stands right there.
    """
    import Part

    if isinstance(thing, (list, tuple)):
        if not thing:
            raise InvalidInput(tr("the list of parts is empty"))
        found = [shape_of(one, beside) for one in thing]
        return found[0] if len(found) == 1 else Part.makeCompound(found)
    if not hasattr(thing, "Document"):
        if not isinstance(thing, Part.Shape):
            raise InvalidInput(tr("{} has no shape").format(type(thing).__name__))
        return thing
    inside = solid_objects(thing)
    if not inside:
        raise InvalidInput(tr("{} has no solid inside").format(thing.Label))
    found = [_standing_shape(part, beside) for part in inside]
    return found[0] if len(found) == 1 else Part.makeCompound(found)


def solid_labels(thing):
    """Per solid of shape_of(thing) the label of the object that it comes from, of a compound or of fragments that of the member; nothing of a bare shape."""
    if isinstance(thing, (list, tuple)):
        return [label for one in thing for label in solid_labels(one)]
    if not hasattr(thing, "Document"):
        return [""] * len(thing.Solids)
    return [label for obj in solid_objects(thing) for label in _labels_of(obj)]


def shown_by(member):
    """The object in containers that a member of a compound shows where it stands, by a likeness or, in older documents, by a link into its container; or None."""
    if getattr(getattr(member, "Proxy", None), "Type", "") == LIKENESS:
        return member.Source
    is_link = member.isDerivedFrom("App::Link") and isinstance(member.LinkedObject, tuple) and member.Placement.isIdentity()
    return member.getLinkedObject() if is_link else None


def _labels_of(obj):
    import Part

    whole = getattr(obj, "Shape", None) or Part.getShape(obj)
    labels = [obj.Label] * len(whole.Solids)
    for member in obj.OutList if len(labels) > 1 else ():
        shape = getattr(member, "Shape", None)
        for solid in shape.Solids if shape else ():
            number = number_of(whole, solid)
            if number:
                labels[number - 1] = (shown_by(member) or member).Label
    return labels


def _standing_shape(part, beside):
    import FreeCAD
    import Part

    placement = standing(part)
    if beside:
        placement = standing(beside).inverse().multiply(placement)
    # A shape that is moved by nothing stays what it is to the last bit.
    if part.isDerivedFrom("Part::Feature") and placement == FreeCAD.Placement():
        return part.Shape
    shape = Part.getShape(part)
    if shape.isNull() and not hasattr(part, "Shape"):
        raise InvalidInput(tr("{} has no shape").format(part.Label))
    if not shape.isNull():
        shape.Placement = placement.multiply(shape.Placement)
    return shape


def has_shape(obj):
    """Whether a document object may have a solid of its own or inside."""
    return hasattr(obj, "Shape") or is_container(obj)


def is_container(obj):
    """Whether an object places those inside it: App::Part, a body, a group of links."""
    return obj.hasExtension("App::GeoFeatureGroupExtension") or bool(_elements(obj))


def container_of(obj):
    """The container that the object stands in, or None."""
    around = obj.getParentGeoFeatureGroup() or next((parent for parent in obj.InList if obj in _elements(parent)), None)
    group = None if around else obj.getParentGroup()
    return container_of(group) if group else around


def containers_of(obj):
    """All containers that the object stands in, the innermost first."""
    around = container_of(obj)
    return [around, *containers_of(around)] if around else []


def standing(obj):
    """The placement of the coordinates that the object's own placement refers to."""
    import FreeCAD

    around = container_of(obj)
    return standing(around).multiply(around.Placement) if around else FreeCAD.Placement()


def selection_path(obj):
    """(object at the top of the document, names from there with a point after each), as the selection wants them of an object in containers."""
    around = container_of(obj)
    if not around:
        return obj, ""
    top, path = selection_path(around)
    return top, path + obj.Name + "."


def distinct(parts):
    """Document objects, each once, without those that stand in another of them."""
    chosen = {(part.Document.Name, part.Name): part for part in parts}

    def is_inside(part):
        around = container_of(part)
        return around is not None and ((around.Document.Name, around.Name) in chosen or is_inside(around))

    return [part for part in chosen.values() if not is_inside(part)]


def solid_object(part):
    """The object whose faces the names Face1, Face2 ... of a mesh of `part` number: of a container with one solid inside, the object of that."""
    inside = solid_objects(part)
    return inside[0] if len(inside) == 1 else part


def numbered_shape(part):
    """The shape whose entities the names Face1, Solid1 ... of a mesh of `part` number, in the coordinates of the objects: of several objects a compound."""
    import Part

    inside = solid_objects(part)
    return inside[0].Shape if len(inside) == 1 else Part.makeCompound([member.Shape for member in inside])


def number_of(whole, shape, owner=None):
    """The number of a face, edge, vertex or solid in a shape, from 1, or 0: itself, a copy, or of solids one of the same volume at the same place. Of several
    copies (both ends of a cylinder, a bore and the pin that cut it, an array) it is the one in the same place, or moved there with the whole, and turned alike;
    with `owner`, the shape that it is from, in a solid of that."""
    numbered = list(enumerate(entities(whole, shape.ShapeType), 1))
    same = [number for number, own in numbered if own.isSame(shape)]
    copies = [] if same else [(number, own) for number, own in numbered if own.isPartner(shape)]
    if len(copies) > 1:
        places = [placement.toMatrix().A for placement in (shape.Placement, whole.Placement.multiply(shape.Placement))]

        def unlike(copy):
            own = copy[1].Placement.toMatrix().A
            reach = RELATIVE_TOLERANCE * max(1.0, *map(abs, own))
            near = [all(abs(a - b) <= reach for a, b in zip(own, place)) for place in places]
            strange = not any(copy[1].isSame(entity) for entity in inside)
            return near.index(True) if True in near else len(near), strange, copy[1].Orientation != shape.Orientation

        solids = {number_of(whole, solid) for solid in owner.Solids} - {0} if owner else ()
        inside = [entity for number in solids for entity in entities(whole.Solids[number - 1], shape.ShapeType)]
        copies.sort(key=unlike)
    same += [number for number, _ in copies]
    if not same and shape.ShapeType == "Solid":
        reach = RELATIVE_TOLERANCE * shape.BoundBox.DiagonalLength
        same = [number for number, own in numbered if coincide(own, shape, reach)]
    return same[0] if same else 0


def coincide(a, b, reach):
    """Whether two shapes of one kind, faces, edges, vertices or solids, are of the same size and at the same place, `reach` apart at most."""
    size = {"Face": "Area", "Edge": "Length", "Solid": "Volume"}.get(a.ShapeType)
    if size is None:
        return a.Point.isEqual(b.Point, reach)
    own, other = getattr(a, size), getattr(b, size)
    least = reach ** {"Area": 2, "Length": 1, "Volume": 3}[size]
    return abs(own - other) <= least + RELATIVE_TOLERANCE * other and a.CenterOfMass.isEqual(b.CenterOfMass, reach)


def exists(obj):
    """Whether the object is still in its document. One that was undone lives on for redo, without a name, and writing to it crashes FreeCAD."""
    try:
        return obj is not None and bool(obj.Name) and obj.Document.getObject(obj.Name) == obj
    except (ReferenceError, RuntimeError, AttributeError):  # deleted; out of its document; its document closed
        return False


def is_seam(shape, edge):
    """Whether an edge of the shape is one where a round face closes."""
    import Part

    return not edge.Degenerated and any(edge.isSeam(face) for face in shape.ancestorsOfType(edge, Part.Face))


def entities(shape, kind):
    """The shape's faces, edges, vertices or solids, by the word in their names; nothing by other words."""
    kinds = {"Face": "Faces", "Edge": "Edges", "Vertex": "Vertexes", "Solid": "Solids"}
    return getattr(shape, kinds[kind]) if kind in kinds else ()


def names_in(part, obj, names):
    """What entities of an object, Face3 or the like, are called in a mesh of `part`; those that the part does not have are left out."""
    if obj == solid_object(part):
        return [name for name in names if name]
    whole, shape, found = numbered_shape(part), getattr(obj, "Shape", None), []
    for name in names if shape else ():
        kind = name.rstrip("0123456789")
        own = entities(shape, kind)
        number = int(name[len(kind) :] or 0)
        if 1 <= number <= len(own):
            same = number_of(whole, own[number - 1], shape)
            found += ["{}{}".format(kind, same)] if same else []
    return found


def solids_in(part, obj, names):
    """Numbers of the solids in a mesh of `part` that references to an object mean: Solid1 ..., or all of the object where the name is empty."""
    shape = getattr(obj, "Shape", None)
    if not shape or shape.isNull():
        return []
    whole, found = numbered_shape(part), set()
    for name in names or ("",):
        wanted = [shape.Solids[int(name[5:]) - 1]] if name.startswith("Solid") else (shape.getElement(name) if name else shape).Solids
        found.update(number_of(whole, solid) for solid in wanted)
    return sorted(found - {0})


def solid_objects(part):
    """The objects with solids inside a container or a list, the part itself if it is none. What another of them was made of, and is hidden, does not count; nor
    does a compound of what is there itself, such as the one that several objects are meshed as."""
    import Part

    members = _members(part)
    if members is None:
        return [part]
    inside = {member.Name: member for child in members for member in solid_objects(child) if Part.getShape(member).Solids}
    for member in list(inside.values()):
        if member.isDerivedFrom("Part::Compound") and all(one.Name in inside and one.Visibility for one in member.Links):
            del inside[member.Name]
    used = {used.Name for member in inside.values() for used in member.OutListRecursive}
    return [member for member in inside.values() if member.Visibility or member.Name not in used]


def _members(obj):
    """What is inside a list, or a container that has no shape of its own; None of other objects."""
    if isinstance(obj, (list, tuple)):
        return obj
    if obj.isDerivedFrom("App::Part") or obj.isDerivedFrom("App::DocumentObjectGroup"):
        return obj.Group
    return _elements(obj) or None


def _elements(obj):
    """The elements of a group of links."""
    return obj.ElementList if obj.isDerivedFrom("App::LinkGroup") else []


def check_solid(shape):
    """Raises InvalidInput unless the shape has valid solids with a volume, or faces only, which the engine sews. It checks again and more closely."""
    if shape.isNull() or not shape.Faces:
        raise InvalidInput(tr("the shape is empty"))
    if not shape.Solids:
        return
    for number, solid in enumerate(shape.Solids, 1):
        name = tr("the solid") if len(shape.Solids) == 1 else "Solid{}".format(number)
        if not solid.isValid():
            raise InvalidInput(tr("{} is not valid; Part > Check geometry shows why").format(name))
        if not solid.Volume > 1e-12 * solid.BoundBox.DiagonalLength**3:
            raise InvalidInput(tr("{} has no volume").format(name))


def signature(shape):
    """Numbers that change when the shape changes: counts, size, and per face, edge and vertex where it is and how big. None of an empty shape."""
    if shape.isNull() or not shape.Faces:
        return []
    numbers = [len(shape.Faces), len(shape.Edges), len(shape.Vertexes), shape.BoundBox.DiagonalLength, shape.Volume]
    for face in shape.Faces:
        numbers += [face.Area, *face.CenterOfMass]
    for edge in shape.Edges:
        numbers.append(edge.Length)
    for vertex in shape.Vertexes:
        numbers += [*vertex.Point]
    return [float(number) for number in numbers]


def same(signature_a, signature_b):
    """Whether two signatures are of the same shape, up to rounding (a document writes its numbers as text)."""
    if len(signature_a) != len(signature_b) or len(signature_a) < 5:
        return False
    scale = max(abs(signature_a[3]), 1e-30)
    return all(
        abs(a - b) <= RELATIVE_TOLERANCE * max(abs(a), abs(b), scale) for a, b in zip(signature_a, signature_b)
    )
