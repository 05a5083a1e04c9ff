"""Parts from the lathe."""

from .registry import family
from .tools import (V, X, Y, ORIGIN, block, cone, cut, cylinder, fillet, is_circle, keyed_bore, polar, require, ring_of, slot, turned, turned_copies, union,
                    Part)


@family
def shaft(draw):
    """Steps, chamfered ends, and one or two of keyway, flat, ring groove, cross bore."""
    radii = sorted(draw.length(6, 22) for _ in range(draw.count(3, 5)))
    require(all(b - a > 1 for a, b in zip(radii, radii[1:])), "steps too low to be meant")
    radii = radii[::2] + radii[1::2][::-1]
    lengths = [draw.length(12, 45) for _ in radii]
    bevel = draw.length(0.8, 1.5)
    profile, z = [(0, 0), (radii[0] - bevel, 0), (radii[0], bevel)], 0
    for k, (radius, length) in enumerate(zip(radii, lengths)):
        if k:
            profile.append((radius, z))
        z += length
        profile.append((radius, z - (bevel if k == len(radii) - 1 else 0)))
    body = turned([*profile, (radii[-1] - bevel, z), (0, z)])
    thick = radii.index(max(radii))
    start = sum(lengths[:thick])
    works = [draw.pick("keyway", "flat", "groove", "cross"), draw.pick("keyway", "flat", "none")]
    if "keyway" in works:
        width = round(0.5 * radii[thick], 1)
        key = slot(lengths[thick] - 2.2 * width, width, radii[thick], z=radii[thick] - 0.55 * width)
        require(lengths[thick] > 2.6 * width, "no room for the keyway")
        key.rotate(ORIGIN, Y, -90)
        key.rotate(ORIGIN, V(0, 0, 1), 180)
        key.translate(V(0, 0, start + lengths[thick] / 2))
        body = cut(body, key)
    if "flat" in works:
        depth = radii[-1] * draw.real(0.2, 0.4)
        body = cut(body, block(4 * radii[-1], 4 * radii[-1], 0.7 * lengths[-1] + 1, (-2 * radii[-1], radii[-1] - depth, z - 0.7 * lengths[-1])))
    if "groove" in works:
        width = draw.length(1.5, 2.5)
        body = cut(body, turned([(radii[0] - 1.2, 0.4 * lengths[0]), (radii[0] + 1, 0.4 * lengths[0]), (radii[0] + 1, 0.4 * lengths[0] + width),
                                 (radii[0] - 1.2, 0.4 * lengths[0] + width)]))
    if "cross" in works:
        body = cut(body, cylinder(0.3 * radii[0], 4 * radii[0], (-2 * radii[0], 0, 0.6 * lengths[0]), X))
    return body


@family
def flange(draw):
    """Disc, hub, bore, bolt circle; with or without raised face, fillet at the hub, conical hub."""
    radius, thickness = draw.length(35, 70), draw.length(8, 16)
    bore = radius * draw.real(0.2, 0.35)
    hub = bore + draw.length(5, 10)
    height = thickness + draw.length(10, 30)
    bolts, bolt = draw.count(4, 8), draw.length(3, 6)
    circle = (hub + radius) / 2 + 1
    require(radius - circle > bolt + 3 and circle - hub > bolt + 4, "no room for the bolts")
    top = hub - draw.length(1, 3) if draw.chance(0.4) else hub
    require(top - bore > 2.5, "the hub gets thin")
    body = union(cylinder(radius, thickness), cone(hub, top, height) if top != hub else cylinder(hub, height))
    if draw.chance(0.4):
        body = union(body, cylinder((circle - bolt + hub) / 2, draw.length(1.5, 3), axis=V(0, 0, -1)))
    if top == hub and draw.chance():
        body = fillet(body, draw.length(2, 3.5), is_circle(hub, thickness))
    body = cut(body, cylinder(bore, height + 20, (0, 0, -10)))
    return cut(body, *ring_of(bolts, circle, cylinder(bolt, thickness + 10, (0, 0, -5)), draw.real(0, 360)))


@family
def bush(draw):
    """A flanged bush with bevels, an oil hole and a groove inside."""
    bore, wall = draw.length(6, 15), draw.length(3, 6)
    radius, height = bore + wall, draw.length(20, 45)
    collar, thickness, bevel = radius + draw.length(4, 8), draw.length(3, 6), draw.length(0.6, 1.2)
    body = turned([(bore, 0), (collar, 0), (collar, thickness), (radius, thickness), (radius, height - bevel), (radius - bevel, height), (bore, height)])
    middle = (thickness + height) / 2
    if draw.chance(0.6):
        width = draw.length(3, 5)
        depth = 0.3 * wall
        body = cut(body, turned([(bore - 1, middle - width / 2), (bore + depth, middle - width / 2), (bore + depth, middle + width / 2),
                                 (bore - 1, middle + width / 2)]))
    return cut(body, *turned_copies(draw.count(1, 3), cylinder(draw.length(0.8, 1.4), 2 * radius, (0, 0, middle), X)))


@family
def pulley(draw):
    """V grooves, a thin web on a hub, a bore with or without keyway, holes in the web."""
    grooves, pitch, depth = draw.count(1, 3), draw.length(10, 14), draw.length(6, 9)
    radius = draw.length(40, 65)
    width = grooves * pitch + draw.length(3, 6)
    bore = draw.length(6, 11)
    hub, rim, web = bore + draw.length(5, 8), radius - depth - draw.length(5, 8), width * draw.real(0.35, 0.6)
    require(rim - hub > 8, "no web")
    outline = [(bore, 0), (hub, 0), (hub, (width - web) / 2), (rim, (width - web) / 2), (rim, 0), (radius, 0)]
    for k in range(grooves):
        z = width / 2 + (k - (grooves - 1) / 2) * pitch
        outline += [(radius, z - 0.42 * pitch), (radius - depth, z - 0.2 * pitch), (radius - depth, z + 0.2 * pitch), (radius, z + 0.42 * pitch)]
    outline += [(radius, width), (rim, width), (rim, (width + web) / 2), (hub, (width + web) / 2), (hub, width), (bore, width)]
    body = turned(outline)
    if draw.chance(0.7):
        body = cut(body, keyed_bore(bore, 0.6 * bore, width + 2, -1))
    if draw.chance(0.6):
        hole = 0.3 * (rim - hub)
        body = cut(body, *ring_of(draw.count(3, 6), (rim + hub) / 2, cylinder(hole, width)))
    return body


@family
def piston(draw):
    """A cup with ring grooves, two bosses inside and the bore of the pin through them."""
    radius, height, wall = draw.length(30, 45), draw.length(50, 75), draw.length(5, 8)
    crown = draw.length(9, 13)
    body = cylinder(radius, height)
    inside = cylinder(radius - wall, height - crown)
    pin = draw.length(7, 10)
    boss, gap, level = pin + draw.length(5, 7), draw.length(20, 28), draw.length(22, 28)
    require(level > boss and level + boss < height - crown, "no room for the pin")
    bosses = cylinder(boss, 2 * radius, (-radius, 0, level), X).common(cylinder(radius - wall / 2, height)).cut(
        block(gap, 4 * radius, height, (-gap / 2, -2 * radius, 0)))
    body = union(body.cut(inside), bosses)
    grooves = draw.count(1, 3)
    for k in range(grooves):
        z = height - 5 - 6.5 * k
        require(z - 4 > level + pin, "a groove meets the bore")
        body = cut(body, turned([(radius - 0.5 * wall, z - 2.5), (radius + 1, z - 2.5), (radius + 1, z), (radius - 0.5 * wall, z)]))
    return cut(body, cylinder(pin, 4 * radius, (-2 * radius, 0, level), X))


@family
def ball_stud(draw):
    """A ball on a conical neck, a collar and a stem, with or without flats on the collar."""
    ball, neck = draw.length(9, 15), draw.length(4.5, 6.5)
    collar, stem = draw.length(10, 14), draw.length(5, 8)
    height = draw.length(8, 14)
    require(ball > neck + 2 and collar > stem + 2, "no ball, or no collar")
    thickness, length = draw.length(4, 7), draw.length(20, 35)
    body = turned([(0, -length), (stem - 1, -length), (stem, 1 - length), (stem, 0), (collar, 0), (collar, thickness), (neck + draw.length(0.5, 2), thickness),
                   (neck, thickness + height), (0, thickness + height)])
    body = union(body, Part.makeSphere(ball, V(0, 0, thickness + height + 0.8 * ball)))
    if draw.chance():
        across = collar + stem
        for side in (1, -1):
            body = cut(body, block(40, 40, thickness, (-20, across / 2 if side > 0 else -across / 2 - 40, 0)))
    return body


@family
def clamp(draw):
    """A split collar: ring, slot, two ears with a screw hole."""
    bore, wall, height = draw.length(10, 18), draw.length(5, 8), draw.length(10, 16)
    radius, gap = bore + wall, draw.length(2.5, 4)
    ear, thickness = draw.length(12, 18), draw.length(6, 9)
    screw = draw.length(2.2, 3.2)
    require(ear - 2 > 2 * screw + 2 and height > 2 * screw + 4, "no room for the screw")
    body = union(cylinder(radius, height), block(radius + ear, gap + 2 * thickness, height, (0, -gap / 2 - thickness, 0)))
    body = cut(body, cylinder(bore, height), block(radius + ear, gap, height, (0, -gap / 2, 0)))
    return cut(body, cylinder(screw, 60, (radius + ear / 2, -30, height / 2), Y))


@family
def cover(draw):
    """A round cover with lugs on its rim, a spigot below and a boss or a cup on top."""
    radius, thickness = draw.length(30, 50), draw.length(5, 9)
    lugs, lug = draw.count(3, 6), draw.length(7, 9)
    spigot, depth = radius - draw.length(4, 8), draw.length(4, 8)
    body = union(cylinder(radius, thickness), *ring_of(lugs, radius, cylinder(lug, thickness)))
    body = union(body, cylinder(spigot, depth, axis=V(0, 0, -1)))
    body = cut(body, *ring_of(lugs, radius + 0.15 * lug, cylinder(0.4 * lug, thickness)))
    if draw.chance():
        boss, height = radius * draw.real(0.3, 0.5), draw.length(8, 15)
        body = union(body, cylinder(boss, height, (0, 0, thickness)))
        body = cut(body, cylinder(0.6 * boss, height + thickness + depth, (0, 0, -depth)))
    else:
        body = cut(body, cylinder(spigot - draw.length(4, 6), depth + 0.3 * thickness, (0, 0, -depth)))
    return body


@family
def hose_end(draw):
    """A plain pipe end: bore with a countersink, a collar, a bead with a round back, a cross hole."""
    bore, wall = draw.length(5, 10), draw.length(3, 5)
    radius, length = bore + wall, draw.length(30, 50)
    bead, collar = draw.length(1.5, 2.5), draw.length(4, 7)
    body = turned([(bore, 0), (radius + collar, 0), (radius + collar, collar), (radius, collar), (radius, length - 1), (radius - 1, length), (bore + 0.8, length),
                   (bore, length - 1.5)])
    ring = Part.makeTorus(radius, bead, V(0, 0, 0.7 * length))
    body = union(body, ring.cut(cylinder(radius - 0.4 * wall, length)))
    for k in range(draw.count(0, 2)):
        body = cut(body, block(60, 60, collar, tuple(polar(radius + 0.6 * collar, 0)) if k == 0 else (-60 - radius - 0.6 * collar, 0, 0)).translated(V(0, -30, 0)))
    return body
