"""Parts that transmit motion."""

import math

from .registry import family
from .tools import V, arc, cut, cylinder, face_of, fillet, keyed_bore, polar, polygon, require, ring_of, slab, strap, turned, union, Part


def _gear_outline(teeth, module, points=6):
    """Involute flanks of 20 degrees from the base circle, radial below it; tip and root are arcs."""
    pitch, pressure = teeth * module / 2, math.radians(20)
    base, tip, root = pitch * math.cos(pressure), pitch + module, pitch - 1.25 * module
    start = max(base, root)
    half = math.pi / (2 * teeth) + math.tan(pressure) - pressure  # of a tooth at the base circle, as an angle

    def flank(side, k):
        result = []
        for i in range(points):
            radius = start + (tip - start) * i / (points - 1)
            roll = math.sqrt(max((radius / base) ** 2 - 1, 0))
            angle = half - (roll - math.atan(roll))
            result.append(polar(radius, math.degrees(2 * math.pi * k / teeth + side * angle)))
        return result

    def curve(through):
        spline = Part.BSplineCurve()
        spline.interpolate(through)
        return spline.toShape()

    edges = []
    for k in range(teeth):
        up, down = flank(-1, k), flank(1, k)[::-1]
        turn = 360.0 * k / teeth
        foot_up, foot_down = [polar(root, math.degrees(math.atan2(p.y, p.x))) for p in (up[0], down[-1])]
        following = flank(-1, k + 1)[0]
        foot_next = polar(root, math.degrees(math.atan2(following.y, following.x)))
        if start > root:
            edges.append(Part.makeLine(foot_up, up[0]))
        edges += [curve(up), arc(up[-1], polar(tip, turn), down[0]), curve(down)]
        if start > root:
            edges.append(Part.makeLine(down[-1], foot_down))
        edges.append(arc(foot_down, polar(root, turn + 180.0 / teeth), foot_next))
    return face_of(*edges)


@family
def spur_gear(draw):
    """Involute teeth; a bore with or without keyway; with or without hub and a recess in the web."""
    teeth, module = draw.count(10, 20), draw.pick(2.0, 2.5, 3.0)
    width, root = draw.length(8, 16), teeth * module / 2 - 1.25 * module
    bore = root * draw.real(0.25, 0.4)
    body = _gear_outline(teeth, module).extrude(V(0, 0, width))
    height = width
    hub = bore + draw.length(3, 5)
    if hub < root - 4 and draw.chance():
        height = width + draw.length(6, 10)
        body = union(body, cylinder(hub, height))
    if hub < root - 9 and draw.chance():
        ring = cylinder(root - 3, 0.3 * width).cut(cylinder(hub + 1, 0.3 * width))
        body = cut(body, ring)
    return cut(body, keyed_bore(bore, 0.5 * bore, height) if draw.chance() else cylinder(bore, height))


@family
def connecting_rod(draw):
    """Two eyes, a tapering shank with a pocket on both sides, with or without a fillet at the eyes."""
    length = draw.length(80, 120)
    big, small = draw.length(18, 24), draw.length(10, 14)
    eye, shank = draw.length(16, 22), draw.length(9, 13)
    require(eye - shank > 4, "the shank is as thick as the eyes")
    arm = strap(length, 0.7 * big, 0.75 * small, shank, -shank / 2)
    body = union(arm, cylinder(big, eye, (0, 0, -eye / 2)), cylinder(small, eye, (length, 0, -eye / 2)))
    if draw.chance(0.6):
        first, last = big + 6, length - small - 5
        require(last - first > 20, "no room for the pockets")
        pocket = strap(last - first - 8, 0.35 * big, 0.32 * small, shank).translated(V(first + 4, 0, 0))
        web = draw.length(1.5, 2.5)
        body = cut(body, pocket.translated(V(0, 0, web)), pocket.translated(V(0, 0, -web - shank)))
    elif draw.chance():
        body = fillet(body, draw.length(1, 2), lambda edge: abs(abs(edge.CenterOfMass.z) - shank / 2) < 1e-6 and edge.BoundBox.ZLength < 1e-6 and
                      isinstance(edge.Curve, Part.Circle))
    bore = [0.72 * big, 0.6 * small]
    return cut(body, cylinder(bore[0], eye, (0, 0, -eye / 2)), cylinder(bore[1], eye, (length, 0, -eye / 2)))


@family
def cam(draw):
    """A disc cam of four arcs or with straight flanks, a keyed bore, with or without hub."""
    base, nose = draw.length(18, 26), draw.length(6, 10)
    rise, width = base + draw.length(2, 10), draw.length(8, 14)
    if draw.chance():
        body = strap(rise, base, nose, width)
    else:
        # Flanks bulge: arcs of a larger circle that touch base and nose circles from outside.
        large = (base + rise) * draw.real(1.2, 1.8)
        # Centre of the flank's circle: at (large - base) from the base's centre, (large - nose) from the nose's.
        a, b = large - base, large - nose
        x = (a * a - b * b + rise * rise) / (2 * rise)
        require(abs(x) < a, "no such arc")
        y = -math.sqrt(a * a - x * x)
        centre = V(x, y, 0)
        on_base, on_nose = centre * (-base / a), V(rise, 0, 0) + (V(rise, 0, 0) - centre) * (nose / b)
        middle = centre + ((on_base + on_nose) * 0.5 - centre).normalize() * large

        def flip(p):
            return V(p.x, -p.y, 0)

        body = face_of(arc(on_base, middle, on_nose), arc(on_nose, (rise + nose, 0, 0), flip(on_nose)), arc(flip(on_nose), flip(middle), flip(on_base)),
                       arc(flip(on_base), (-base, 0, 0), on_base)).extrude(V(0, 0, width))
    bore = base * draw.real(0.35, 0.5)
    height = width
    if draw.chance():
        height = width + draw.length(6, 12)
        body = union(body, cylinder(bore + 0.5 * (base - bore), height))
    return cut(body, keyed_bore(bore, 0.5 * bore, height) if draw.chance(0.7) else cylinder(bore, height))


@family
def lever(draw):
    """One or two arms between bosses, straight or bent, with bores and a keyway."""
    hub, end = draw.length(13, 18), draw.length(8, 11)
    length, thickness = draw.length(50, 80), draw.length(7, 11)
    height = thickness + draw.length(6, 14)
    arms = [0.0] if draw.chance() else [0.0, draw.pick(180.0, draw.real(80, 150))]
    body = cylinder(hub, height)
    for angle in arms:
        arm = union(strap(length, 0.8 * hub, 0.8 * end, thickness), cylinder(end, draw.pick(thickness, thickness + 5), (length, 0, 0)))
        body = union(body, arm.rotated(V(0, 0, 0), V(0, 0, 1), angle))
    for angle in arms:
        body = cut(body, cylinder(0.5 * end, height, polar(length, angle)))
    return cut(body, keyed_bore(0.5 * hub, 0.3 * hub, height) if draw.chance(0.6) else cylinder(0.5 * hub, height))


@family
def ratchet(draw):
    """Saw teeth round a disc, a hub, a bore with a keyway or a square."""
    teeth, radius, width = draw.count(8, 16), draw.length(30, 42), draw.length(6, 12)
    depth = draw.length(4, 6)
    lead = 360.0 / teeth / 15  # from a tooth's tip to its foot, past the radial line
    outline = [at for k in range(teeth) for at in (polar(radius, 360.0 * k / teeth), polar(radius - depth, 360.0 * k / teeth + lead))]
    body = polygon(outline).extrude(V(0, 0, width))
    hub, height = 0.45 * radius, width + draw.length(4, 10)
    if draw.chance(0.6):
        body = union(body, cylinder(hub, height))
    else:
        height = width
    bore = 0.25 * radius
    return cut(body, draw.pick(cylinder(bore, height), keyed_bore(bore, 0.5 * bore, height), slab(1.4 * bore, 1.4 * bore, height)))


@family
def claw_coupling(draw):
    """A coupling half: claws on a disc, a hub with a bore, screw holes."""
    claws, radius = draw.pick(2, 3, 4), draw.length(24, 34)
    disc, claw = draw.length(8, 12), draw.length(8, 14)
    bore = draw.length(6, 8)
    inner = bore + draw.length(3, 6)
    body = cylinder(radius, disc)
    sector = turned([(inner, disc - 1), (radius, disc - 1), (radius, disc + claw), (inner, disc + claw)], 180.0 / claws * draw.real(0.75, 1.0))
    body = union(body, *ring_of(claws, 0, sector))
    height = draw.length(8, 16)
    if draw.chance(0.6):
        body = union(body, cylinder(bore + 5, height, (0, 0, -height)))
    return cut(body, keyed_bore(bore, 0.5 * bore, 3 * height + disc, -height) if draw.chance() else cylinder(bore, 3 * height + disc, (0, 0, -height)))
