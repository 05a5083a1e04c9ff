"""What the families are built with: FreeCAD's Part module in a few words. Lengths in mm, angles in degrees; axes are Z unless said otherwise."""

import math
import sys

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"]
import FreeCAD  # noqa: E402
import Part  # noqa: E402

V = FreeCAD.Vector
X, Y, Z = V(1, 0, 0), V(0, 1, 0), V(0, 0, 1)
ORIGIN = V(0, 0, 0)


class Unsuitable(Exception):
    """Dimensions that make no part of the family: others are drawn."""


def require(condition, what):
    if not condition:
        raise Unsuitable(what)


def cylinder(radius, height, at=ORIGIN, axis=Z):
    return Part.makeCylinder(radius, height, V(*at), axis)


def cone(bottom, top, height, at=ORIGIN, axis=Z):
    return Part.makeCone(bottom, top, height, V(*at), axis)


def block(dx, dy, dz, at=ORIGIN):
    """From a corner."""
    return Part.makeBox(dx, dy, dz, V(*at))


def slab(dx, dy, dz, x=0, y=0, z=0):
    """Centred in x and y, standing on z."""
    return Part.makeBox(dx, dy, dz, V(x - dx / 2, y - dy / 2, z))


def union(first, *others):
    """Without edges between faces of one surface."""
    return first.multiFuse(list(others)).removeSplitter() if others else first


def cut(body, *tools):
    for tool in tools:
        body = body.cut(tool)
    return body


def polar(radius, angle, z=0.0):
    return V(radius * math.cos(math.radians(angle)), radius * math.sin(math.radians(angle)), z)


def polygon(points):
    """A plane face; points as tuples of two or three numbers, or vectors."""
    corners = [point if isinstance(point, V) else V(*point) for point in points]
    return Part.Face(Part.makePolygon([*corners, corners[0]]))


def prism(points, height, z=0.0):
    return polygon([(x, y, z) for x, y in points]).extrude(V(0, 0, height))


def turned(profile, angle=360.0):
    """Solid of revolution about Z of a polygon of (radius, z)."""
    return polygon([V(radius, 0, z) for radius, z in profile]).revolve(ORIGIN, Z, angle)


def face_of(*curves):
    """The plane face that edges or curves enclose, in order."""
    return Part.Face(Part.Wire([curve if isinstance(curve, Part.Shape) else curve.toShape() for curve in curves]))


def arc(a, middle, b):
    return Part.Arc(V(*a), V(*middle), V(*b)).toShape()


def line(a, b):
    return Part.makeLine(V(*a), V(*b))


def hexagon(across_flats, height, z=0.0):
    radius = across_flats / math.sqrt(3)
    return prism([tuple(polar(radius, 60 * k))[:2] for k in range(6)], height, z)


def strap(length, first, second, height, z=0.0):
    """Two discs on the x axis, at 0 and `length`, with their common tangents: the outline of a lever."""
    require(length > abs(first - second) + 1, "one disc lies in the other")
    angle = math.degrees(math.acos((first - second) / length))
    a, b = polar(first, angle, z), polar(second, angle, z) + V(length, 0, 0)
    c, d = V(b.x, -b.y, z), V(a.x, -a.y, z)
    return face_of(line(a, b), arc(b, (length + second, 0, z), c), line(c, d), arc(d, (-first, 0, z), a)).extrude(V(0, 0, height))


def slot(length, width, depth, x=0.0, y=0.0, z=0.0):
    """With round ends, along x, centred; `length` is from middle to middle of the ends."""
    radius, half = width / 2, length / 2
    outline = face_of(line((x - half, y - radius, z), (x + half, y - radius, z)),
                      arc((x + half, y - radius, z), (x + half + radius, y, z), (x + half, y + radius, z)),
                      line((x + half, y + radius, z), (x - half, y + radius, z)),
                      arc((x - half, y + radius, z), (x - half - radius, y, z), (x - half, y - radius, z)))
    return outline.extrude(V(0, 0, depth))


def rounded_slab(dx, dy, dz, radius, x=0.0, y=0.0, z=0.0):
    """A slab with round corners in plan."""
    return fillet(slab(dx, dy, dz, x, y, z), radius, is_upright)


def ring_of(count, radius, tool, start=0.0):
    """`tool`, which stands on the axis, set `count` times on a circle."""
    copies = []
    for k in range(count):
        copy = tool.copy()
        copy.translate(V(radius, 0, 0))
        copy.rotate(ORIGIN, Z, start + 360.0 * k / count)
        copies.append(copy)
    return copies


def turned_copies(count, tool, start=0.0):
    """`tool` turned about Z `count` times."""
    return ring_of(count, 0.0, tool, start)


def keyed_bore(radius, width, height, z=0.0):
    """The tool of a bore with a keyway on its +x side; the keyway is as deep as half its width."""
    return union(cylinder(radius, height, (0, 0, z)), block(radius + width / 2, width, height, (0, -width / 2, z)))


# Choices of edges, for fillet and chamfer.
def is_upright(edge):
    return isinstance(edge.Curve, Part.Line) and abs(edge.Curve.Direction.z) > 1 - 1e-9


def is_circle(radius, z=None):
    def chosen(edge):
        return (isinstance(edge.Curve, Part.Circle) and abs(edge.Curve.Radius - radius) < 1e-6 and
                (z is None or abs(edge.Curve.Center.z - z) < 1e-6))
    return chosen


def at_height(z):
    return lambda edge: abs(edge.BoundBox.ZMin - z) < 1e-6 and abs(edge.BoundBox.ZMax - z) < 1e-6


def any_edge(edge):
    return True


def chosen_edges(shape, choice):
    edges = [edge for edge in shape.Edges if not edge.Degenerated and choice(edge)]
    require(edges, "no edge to work on")
    return edges


def fillet(shape, radius, choice=any_edge):
    return shape.makeFillet(radius, chosen_edges(shape, choice))


def chamfer(shape, length, choice):
    return shape.makeChamfer(length, chosen_edges(shape, choice))
