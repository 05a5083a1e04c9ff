"""Cast parts: fillets, bosses, cavities, pipes."""

from .registry import family
from .tools import (ORIGIN, V, X, Y, Z, Part, at_height, block, cut, cylinder, fillet, polar, polygon, require, ring_of, rounded_slab, slab,
                    turned_copies, union)


@family
def casting(draw):
    """A foot, a boss and ribs, every edge filleted, bored afterwards."""
    width, depth, foot = draw.length(60, 90), draw.length(45, 65), draw.length(10, 14)
    boss, height = draw.length(13, 18), draw.length(30, 45)
    radius = draw.length(1.5, 3)
    parts = [slab(width, depth, foot), cylinder(boss, height)]
    kind = draw.pick("plain", "rib", "wall")
    if kind == "rib":
        parts.append(slab(0.8 * width, draw.length(8, 10), foot + 0.5 * (height - foot)))
    elif kind == "wall":
        parts.append(block(10, depth, 0.8 * height, (-width / 2, -depth / 2, 0)))
        require(width / 2 - 10 - boss > 3 * radius, "the wall is too near to the boss")
    body = fillet(union(*parts), radius)
    bore = 0.55 * boss
    body = cut(body, cylinder(bore, height + 2, (0, 0, -1)))
    if draw.chance() and kind != "wall":
        hole, far = draw.length(2.5, 4), 0.5 * width - 9
        body = cut(body, *[cylinder(hole, 3 * height, (s * far, t * (depth / 2 - 9), -height)) for s in (1, -1) for t in (1, -1)])
    return body


@family
def housing(draw):
    """An open box with round corners, a rim, screw bosses in the corners and a bore with a collar in a wall."""
    width, depth, height = draw.length(60, 95), draw.length(45, 70), draw.length(25, 45)
    wall, corner = draw.length(4, 6), draw.length(6, 10)
    body = rounded_slab(width, depth, height, corner)
    if draw.chance():
        rim = draw.length(4, 7)
        body = union(body, rounded_slab(width + 2 * rim, depth + 2 * rim, draw.length(4, 6), corner + rim, z=height - 4))
    top = body.BoundBox.ZMax
    body = cut(body, rounded_slab(width - 2 * wall, depth - 2 * wall, top, corner - wall / 2, z=wall))
    if draw.chance(0.6):
        boss = draw.length(4, 5.5)
        posts = [cylinder(boss, top, (s * (width / 2 - wall - 0.6 * boss), t * (depth / 2 - wall - 0.6 * boss), 0)) for s in (1, -1) for t in (1, -1)]
        body = union(body, *posts)
        body = cut(body, *[cylinder(0.4 * boss, 12, (post.CenterOfMass.x, post.CenterOfMass.y, top - 12)) for post in posts])
    port, level = draw.length(5, 8), 0.45 * height
    require(level - port > wall + 2 and level + port < height - 6, "no room for the port")
    if draw.chance():
        body = union(body, cylinder(port + 3, 8, (width / 2 - wall, 0, level), X).cut(block(wall, 60, 60, (width / 2 - wall, -30, 0))))
    body = cut(body, cylinder(port, 20 + wall, (width / 2 - wall - 5, 0, level), X))
    if draw.chance(0.4):
        body = cut(body, cylinder(draw.length(6, 10), wall))
    return body


@family
def tee(draw):
    """Three pipes that meet, with or without flanges and a fillet between them."""
    radius, wall, reach = draw.length(14, 20), draw.length(3.5, 5), draw.length(35, 50)
    branch = radius * draw.pick(1.0, draw.real(0.6, 0.9))
    angle = draw.pick(90.0, 90.0, draw.real(60, 80))
    axis = polar(1, angle)
    body = union(cylinder(radius, 2 * reach, (-reach, 0, 0), X), cylinder(branch, reach, (0, 0, 0), axis))
    if branch < radius and draw.chance(0.6):
        body = fillet(body, draw.length(1.5, 3), lambda edge: not hasattr(edge.Curve, "Radius") and not isinstance(edge.Curve, Part.Line))
    if draw.chance():
        rim, thickness = draw.length(7, 10), draw.length(5, 7)
        flanges = [cylinder(radius + rim, thickness, (-reach, 0, 0), X), cylinder(radius + rim, thickness, (reach, 0, 0), -X)]
        if angle == 90.0:
            flanges.append(cylinder(branch + rim, thickness, axis * reach, -axis))
        body = union(body, *flanges)
    return cut(body, cylinder(radius - wall, 2 * reach, (-reach, 0, 0), X), cylinder(branch - wall, reach, (0, 0, 0), axis))


@family
def elbow(draw):
    """A bent pipe with straight ends; with or without flanges, with or without bolts in them."""
    radius, wall, bend = draw.length(12, 18), draw.length(3, 5), draw.length(32, 50)
    angle, straight = draw.pick(90.0, draw.real(40, 120)), draw.length(8, 18)

    def pipe(r):
        ring = Part.Face(Part.Wire(Part.makeCircle(r, V(bend, 0, 0), Y)))
        end = polar(bend, angle)
        return union(ring.revolve(ORIGIN, Z, angle), cylinder(r, straight, (bend, 0, 0), -Y), cylinder(r, straight, end, polar(1, angle + 90)))

    body = pipe(radius)
    if draw.chance(0.7):
        rim, thickness = radius + draw.length(8, 12), draw.length(5, 7)
        first, second = V(bend, -straight, 0), polar(bend, angle) + polar(straight, angle + 90)
        body = union(body, cylinder(rim, thickness, first, Y), cylinder(rim, thickness, second, polar(1, angle - 90)))
        hole = draw.length(2, 2.6)
        if draw.chance():
            bolts = ring_of(4, (rim + radius) / 2, cylinder(hole, 2 * thickness), 45)
            for bolt in bolts:
                bolt.rotate(ORIGIN, X, -90)
                bolt.translate(first - Y * (thickness / 2))
            body = cut(body, *bolts)
    return cut(body, pipe(radius - wall))


@family
def valve_body(draw):
    """A round body between two pipe ends, a bonnet flange on top, a seat inside."""
    radius, reach = draw.length(20, 26), draw.length(38, 50)
    pipe, wall = draw.length(10, 13), draw.length(4, 5)
    rise = radius + draw.length(6, 12)
    outer = union(Part.makeSphere(radius), cylinder(pipe, 2 * reach, (-reach, 0, 0), X), cylinder(0.65 * radius, rise))
    rim = pipe + draw.length(6, 9)
    outer = union(outer, cylinder(rim, 6, (-reach, 0, 0), X), cylinder(rim, 6, (reach, 0, 0), -X))
    if draw.chance():
        outer = union(outer, cylinder(0.65 * radius + 6, 5, (0, 0, rise - 5)))
    body = cut(outer, cylinder(pipe - wall, 2 * reach, (-reach, 0, 0), X), cylinder(0.65 * radius - wall, rise + 1))
    if draw.chance(0.6):
        body = cut(body, Part.makeSphere(radius - wall - 1))
    return body


@family
def pipe_support(draw):
    """A tube on a foot: wall with side ribs between them, fillets at the foot, holes in it."""
    bore, wall, length = draw.length(10, 15), draw.length(5, 7), draw.length(35, 50)
    axis, foot = draw.length(42, 60), draw.length(8, 11)
    width = draw.length(60, 80)
    web = draw.length(8, 11)
    radius = bore + wall
    body = union(cylinder(radius, length, (0, -length / 2, axis), Y), slab(width, length, foot), slab(1.2 * radius, web, axis))
    if draw.chance(0.6):
        gusset = polygon([V(0, -length / 2 + 3, foot - 1), V(0, length / 2 - 3, foot - 1), V(0, length / 2 - 3, foot), V(0, web / 2, 0.7 * axis),
                          V(0, -web / 2, 0.7 * axis), V(0, -length / 2 + 3, foot)]).extrude(V(web, 0, 0)).translated(V(-web / 2, 0, 0))
        body = union(body, gusset)
    elif draw.chance():
        body = fillet(body, draw.length(2, 4), lambda edge: at_height(foot)(edge) and abs(edge.CenterOfMass.x) < 0.49 * width
                      and abs(edge.CenterOfMass.y) < 0.49 * length)
    hole = draw.length(2.5, 4)
    body = cut(body, cylinder(bore, length, (0, -length / 2, axis), Y))
    return cut(body, *[cylinder(hole, foot, (s * (width / 2 - 8), t * (length / 2 - 8), 0)) for s in (1, -1) for t in (1, -1)])


@family
def handwheel(draw):
    """A round rim, spokes and a hub with a keyed or square bore."""
    radius, rim = draw.length(50, 70), draw.length(6, 8)
    hub, height, bore = draw.length(13, 17), draw.length(20, 28), draw.length(5, 7)
    spokes, spoke = draw.count(3, 5), draw.length(4, 5.5)
    arms = turned_copies(spokes, cylinder(spoke, radius, (0, 0, 0), X))
    body = union(Part.makeTorus(radius, rim), cylinder(hub, height, (0, 0, -height / 2)), *arms)
    if draw.chance():
        return cut(body, slab(1.6 * bore, 1.6 * bore, height, z=-height / 2))
    return cut(body, cylinder(bore, height, (0, 0, -height / 2)))
