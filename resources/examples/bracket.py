"""The demo's part: an angle bracket, milled from steel. Lengths in mm.

A base plate and an upright wall with a stiffening rib between them; two bores in the plate for the bolts, two in the wall for the load,
a fillet in the inner corner, the free corners rounded.
"""

import Part
from FreeCAD import Vector

WIDTH, DEPTH, HEIGHT = 100.0, 60.0, 64.0
PLATE, WALL, RIB = 12.0, 12.0, 12.0
BOLT_BORE, LOAD_BORE = 11.0, 14.0
FILLET, ROUND = 6.0, 10.0


def make_bracket():
    """The bracket as one Part.Solid: the wall stands along y = DEPTH, its bores run along y."""
    base = Part.makeBox(WIDTH, DEPTH, PLATE)
    wall = Part.makeBox(WIDTH, WALL, HEIGHT, Vector(0, DEPTH - WALL, 0))
    body = base.fuse(wall).removeSplitter()
    inner = [edge for edge in body.Edges if _on(edge, y=DEPTH - WALL, z=PLATE)]
    body = body.makeFillet(FILLET, inner)
    body = body.makeFillet(ROUND, [edge for edge in body.Edges if _on(edge, x=0, y=0) or _on(edge, x=WIDTH, y=0)])
    body = body.makeFillet(ROUND, [edge for edge in body.Edges if _on(edge, x=0, z=HEIGHT) or _on(edge, x=WIDTH, z=HEIGHT)])
    body = body.fuse(_rib()).removeSplitter()
    for x in (0.22 * WIDTH, 0.78 * WIDTH):
        body = body.cut(Part.makeCylinder(BOLT_BORE / 2, PLATE, Vector(x, 0.4 * DEPTH, 0)))
        body = body.cut(Part.makeCylinder(LOAD_BORE / 2, WALL, Vector(x, DEPTH - WALL, 0.66 * HEIGHT), Vector(0, 1, 0)))
    return body.Solids[0]


def _rib():
    """A web across the inner corner with a flat top and a steep front."""
    left = (WIDTH - RIB) / 2
    corner = DEPTH - WALL
    profile = [(corner + 1, PLATE - 1), (corner - 22, PLATE - 1), (corner - 22, PLATE), (corner - 12, 44), (corner + 1, 44)]
    points = [Vector(left, y, z) for y, z in profile]
    return Part.Face(Part.makePolygon(points + points[:1])).extrude(Vector(RIB, 0, 0))


def _on(edge, **where):
    """Whether the whole edge has these coordinates."""
    return all(abs(getattr(vertex.Point, axis) - value) < 1e-6 for vertex in edge.Vertexes for axis, value in where.items())


def faces(shape):
    """Names of the faces that the analysis refers to: "bolts" (bores of the plate), "loads" (bores of the wall), "top" (the wall's top), "bottom", "back"."""
    found = {"bolts": [], "loads": [], "top": [], "bottom": [], "back": []}
    for number, face in enumerate(shape.Faces, 1):
        name, box, surface = "Face{}".format(number), face.BoundBox, face.Surface
        if surface.TypeId == "Part::GeomCylinder" and abs(surface.Radius - BOLT_BORE / 2) < 1e-9:
            found["bolts"].append(name)
        elif surface.TypeId == "Part::GeomCylinder" and abs(surface.Radius - LOAD_BORE / 2) < 1e-9:
            found["loads"].append(name)
        elif box.ZMax < 1e-6:
            found["bottom"].append(name)
        elif box.YMin > DEPTH - 1e-6:
            found["back"].append(name)
        elif box.ZMin > HEIGHT - 1e-6:
            found["top"].append(name)
    return found
