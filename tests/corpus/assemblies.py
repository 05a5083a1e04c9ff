"""Parts of several solids in nine kinds: assemblies.py FOLDER writes FOLDER/<kind>_<name>.brep, 27 of them.

Those of tests/scoreboard.md. Runs under Debian's /usr/bin/python3 with the package freecad-python3.
"""

import math
import os
import sys

from families.tools import FreeCAD, Part

VECTOR = FreeCAD.Vector
#: By name, what makes the solids of a part.
ASSEMBLIES = {}


def assembly(make):
    ASSEMBLIES[make.__name__] = make
    return make


def box(length, width, height, at=(0, 0, 0)):
    return Part.makeBox(length, width, height, VECTOR(*at))


def cylinder(radius, height, at=(0, 0, 0), axis=(0, 0, 1), angle=360):
    return Part.makeCylinder(radius, height, VECTOR(*at), VECTOR(*axis), angle)


def ball(radius, at):
    return Part.makeSphere(radius, VECTOR(*at))


def tube(outer, inner, height, z=0, angle=360):
    return cylinder(outer, height, (0, 0, z), angle=angle).cut(cylinder(inner, height, (0, 0, z), angle=angle))


def without(solid, *others):
    for other in others:
        solid = solid.cut(other)
    return solid


def joined(*solids):
    return solids[0].multiFuse(list(solids[1:])).removeSplitter()


def turned(solid, axis, angle):
    result = solid.copy()
    result.rotate(VECTOR(0, 0, 0), VECTOR(*axis), angle)
    return result


@assembly
def laminate_with_a_hole():
    return [box(40, 20, t, (0, 0, z)).cut(cylinder(4, 20, (20, 10, -1))) for z, t in ((0, 2), (2, 0.8), (2.8, 3))]


@assembly
def laminate_stepped():
    steps = box(30, 20, 3), box(22, 20, 2, (0, 0, 3)), box(14, 20, 2, (0, 0, 5)), box(6, 12, 4, (0, 4, 7))
    return [turned(step, (1, 2, 3), 33) for step in steps]


@assembly
def laminate_bent():
    return [tube(21, 20, 12, angle=120), tube(22.5, 21, 12, angle=120)]


@assembly
def boxes_over_the_edge():
    return [box(10, 10, 6), box(9, 5, 4, (-3, 2, 6)), box(3, 14, 3, (10, -2, 1))]


@assembly
def boxes_bridge():
    return [box(20, 14, 5), box(6, 6, 6, (2, 4, 5)), box(6, 6, 9, (11, 3, 5)), without(box(15, 4, 2, (2, 5, 11)), box(6, 4, 2, (11, 5, 11)))]


@assembly
def boxes_slot():
    return [without(box(20, 10, 8), box(4, 10, 5, (8, 0, 3))), box(4, 14, 7, (8, -2, 3))]


@assembly
def pin_two():
    pins = cylinder(2.5, 5, (8, 8, 0)), cylinder(4, 5, (22, 9, 0))
    return [without(box(32, 18, 5), *pins), *pins]


@assembly
def pin_stepped():
    hole = cylinder(3, 6, (10, 10, 0))
    return [without(box(20, 20, 6), hole), joined(hole, cylinder(5, 3, (10, 10, 6)))]


@assembly
def pin_hollow():
    return [without(box(18, 18, 10), cylinder(5, 7, (9, 9, 3))), without(cylinder(5, 9, (9, 9, 3)), cylinder(2.5, 9, (9, 9, 3)))]


@assembly
def cylinder_two():
    return [box(30, 16, 6), cylinder(4, 8, (8, 8, 6)), cylinder(5, 5, (21, 8, 6))]


@assembly
def cylinder_cone():
    return [box(20, 20, 6), Part.makeCone(7, 4, 9, VECTOR(10, 10, 6))]


@assembly
def cylinder_under_a_plate():
    return [box(10, 24, 6), cylinder(4, 6, (5, 12, 6)), box(18, 18, 3, (-4, 3, 12))]


@assembly
def inclusion_two_balls():
    balls = ball(4, (7, 7, 7)), ball(3.5, (17, 7, 7))
    return [without(box(24, 14, 14), *balls), *balls]


@assembly
def inclusion_cylinder():
    core = cylinder(3, 8, (8, 8, 4))
    return [without(box(16, 16, 16), core), core]


@assembly
def inclusion_turned_box():
    core = turned(box(6, 6, 6, (-3, -3, -3)), (0, 0, 1), 30)
    return [without(box(16, 16, 16, (-8, -8, -8)), core), core]


@assembly
def coat_with_a_hole():
    angle = joined(box(30, 16, 4), box(4, 16, 20))
    return [without(angle, cylinder(3, 4, (20, 8, 0))), without(box(26, 16, 1, (4, 0, 4)), cylinder(3, 1, (20, 8, 4)))]


@assembly
def coat_on_both_sides():
    return [joined(box(24, 14, 3), box(3, 14, 16)), box(24, 14, 1, (0, 0, -1)), box(21, 14, 0.7, (3, 0, 3))]


@assembly
def coat_beside_a_fillet():
    angle = joined(box(24, 14, 4), box(4, 14, 18))
    inner = [e for e in angle.Edges if abs(e.CenterOfMass.x - 4) < 1e-6 and abs(e.CenterOfMass.z - 4) < 1e-6]
    return [angle.makeFillet(3, inner), box(17, 14, 1, (7, 0, 4))]


@assembly
def bushing_with_a_collar():
    outside = joined(cylinder(5, 8), cylinder(8, 2, (0, 0, 8)))
    return [without(box(40, 20, 8, (-10, -10, 0)), cylinder(5, 8)), without(outside, cylinder(3, 10))]


@assembly
def bushing_two():
    lever = joined(cylinder(10, 6), box(30, 12, 6, (0, -6, 0)), cylinder(9, 6, (30, 0, 0)))
    second = without(cylinder(5, 8, (30, 0, -1)), cylinder(3.5, 8, (30, 0, -1)))
    return [without(lever, cylinder(6, 6), cylinder(5, 6, (30, 0, 0))), tube(6, 4, 6), second]


@assembly
def bushing_nested():
    return [without(box(20, 20, 6, (-10, -10, 0)), cylinder(7, 6)), tube(7, 5, 6), tube(5, 3, 6), cylinder(3, 9, (0, 0, -1))]


def flange(thickness, z, holes):
    ring = tube(32, 14, thickness, z)
    angles = [2 * math.pi * (i + 0.25) / holes for i in range(holes)]
    return without(ring, *[cylinder(2.5, thickness, (23 * math.cos(a), 23 * math.sin(a), z)) for a in angles])


@assembly
def flanges_six_holes():
    return [flange(6, 0, 6), flange(2, 6, 6), flange(6, 8, 6)]


@assembly
def flanges_square():
    def plate(z, thickness):
        holes = [cylinder(2.5, thickness, (x, y, z)) for x in (-14, 14) for y in (-14, 14)]
        return without(box(40, 40, thickness, (-20, -20, z)), cylinder(9, thickness, (0, 0, z)), *holes)

    return [plate(0, 6), plate(6, 1.5), plate(7.5, 6)]


@assembly
def flanges_bolted():
    def plate(z, thickness):
        return without(tube(26, 10, thickness, z), *[cylinder(3, thickness, (x, 0, z)) for x in (-18, 18)])

    return [plate(0, 6), plate(6, 2), plate(8, 6), *[cylinder(3, 14, (x, 0, 0)) for x in (-18, 18)]]


@assembly
def many_wall():
    return [box(6, 3, 3, (6 * i + 3 * (k % 2), 0, 3 * k)) for k in range(3) for i in range(3)]


@assembly
def many_ring():
    return [turned(tube(10, 6, 5, angle=60), (0, 0, 1), 60 * i) for i in range(6)]


@assembly
def many_on_a_shaft():
    discs = [without(cylinder(10, 5, (x, 0, 0), (1, 0, 0)), cylinder(4, 5, (x, 0, 0), (1, 0, 0))) for x in (8, 20, 32, 44)]
    return [cylinder(4, 60, axis=(1, 0, 0)), *discs]


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n", maxsplit=1)[0])
    os.makedirs(sys.argv[1], exist_ok=True)
    for name, make in ASSEMBLIES.items():
        Part.Compound(make()).exportBrep(os.path.join(sys.argv[1], name + ".brep"))
