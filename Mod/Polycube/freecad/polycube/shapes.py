"""The shape of a document object: is it one solid, and is it still the one that was meshed?"""

from .errors import InvalidInput

RELATIVE_TOLERANCE = 1e-7


def shape_of(thing):
    """The Part.Shape of a shape or of a document object that has one. Raises InvalidInput."""
    shape = getattr(thing, "Shape", thing)
    if not hasattr(shape, "exportBrepToString"):
        raise InvalidInput("{} has no shape".format(getattr(thing, "Label", None) or type(thing).__name__))
    return shape


def check_solid(shape):
    """Raises InvalidInput unless the shape is one valid closed solid with a volume. The engine checks again and more closely."""
    if shape.isNull() or not shape.Faces:
        raise InvalidInput("the shape is empty")
    solids = len(shape.Solids)
    if solids == 0:
        closed = "closed shell, not a solid" if all(shell.isClosed() for shell in shape.Shells) and shape.Shells else "open surface"
        raise InvalidInput("the shape is an {}; a solid is needed".format(closed) if closed[0] == "o" else "the shape is a " + closed)
    if solids > 1:
        raise InvalidInput("the shape has {} solids; mesh one solid at a time".format(solids))
    if len(shape.Solids[0].Faces) != len(shape.Faces):
        raise InvalidInput("the shape has faces beside its solid")
    if not shape.isValid():
        raise InvalidInput("the solid is not valid; Part > Check geometry shows why")
    if not shape.Volume > 1e-12 * shape.BoundBox.DiagonalLength**3:
        raise InvalidInput("the solid has no volume")


def signature(shape):
    """Numbers that change when the shape changes: counts, size, and per face, edge and vertex where it is and how big."""
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
