"""Parts milled from plate and bar, or bent from sheet."""

from .registry import family
from .tools import (V, X, Y, Z, Part, block, chamfer, cone, cut, cylinder, fillet, is_upright, polygon, prism, require, rounded_slab, slab, slot, strap,
                    union)


@family
def bracket(draw):
    """An angle with a rib, bolt holes, a fillet in the inner corner and round free corners."""
    width, depth, height = draw.length(50, 90), draw.length(40, 70), draw.length(40, 70)
    plate, wall, rib = draw.length(7, 12), draw.length(7, 12), draw.length(6, 10)
    body = union(block(width, depth, plate), block(width, wall, height))
    inner = draw.length(3, 5)
    body = fillet(body, inner, lambda edge: edge.BoundBox.XLength > 1 and abs(edge.BoundBox.YMin - wall) < 1e-6 and abs(edge.BoundBox.ZMin - plate) < 1e-6)
    if draw.chance():
        body = fillet(body, draw.length(5, 9), lambda edge: is_upright(edge) and abs(edge.BoundBox.YMin - depth) < 1e-6)
    if draw.chance(0.7):
        reach, rise = 0.7 * (depth - wall), 0.7 * (height - plate)
        middle = width / 2
        body = union(body, polygon([(middle - rib / 2, wall - 1, plate - 1), (middle - rib / 2, wall + reach, plate - 1), (middle - rib / 2, wall + reach, plate),
                                    (middle - rib / 2, wall, plate + rise), (middle - rib / 2, wall - 1, plate + rise)]).extrude(V(rib, 0, 0)))
    hole = draw.length(3, 5)
    for x in (0.22 * width, 0.78 * width):
        body = cut(body, cylinder(hole, plate, (x, wall + 0.55 * (depth - wall), 0)))
        if draw.chance(0.8):
            body = cut(body, cylinder(hole, wall, (x, 0, plate + 0.6 * (height - plate)), Y))
    return body


@family
def pocket_plate(draw):
    """A plate with pockets, through holes with and without counterbores, slots and bevels."""
    width, depth, height = draw.length(70, 120), draw.length(50, 80), draw.length(12, 22)
    body = slab(width, depth, height)
    if draw.chance():
        body = chamfer(body, draw.length(3, 6), is_upright)
    columns = draw.count(1, 3)
    for k in range(columns):
        x = width * ((k + 0.5) / columns - 0.5)
        room = width / columns - 12
        kind = draw.pick("pocket", "pocket", "window", "slot", "counterbore")
        level = height * draw.real(0.35, 0.65)
        if kind == "pocket":
            radius = draw.length(3, 6)
            tool = rounded_slab(room, 0.6 * depth, height, radius, x=x, z=level)
            if draw.chance(0.4):
                tool = union(tool, cylinder(0.15 * depth, height, (x, 0, -1)))
        elif kind == "window":
            tool = slab(0.7 * room, 0.5 * depth, height, x=x)
        elif kind == "slot":
            tool = slot(0.5 * depth, min(0.4 * room, 12), height, z=draw.pick(0.0, level)).rotated(V(0, 0, 0), Z, 90).translated(V(x, 0, 0))
        else:
            radius = min(0.3 * room, 0.3 * depth)
            tool = union(cylinder(0.5 * radius, height, (x, 0, 0)), cylinder(radius, height, (x, 0, level)))
        body = cut(body, tool)
    hole = draw.length(2, 3)
    if draw.chance(0.6):
        body = cut(body, *[cylinder(hole, height, (sx * (width / 2 - 7.5), sy * (depth / 2 - 7), 0)) for sx in (1, -1) for sy in (1, -1)])
    return body


@family
def stamped(draw):
    """Sheet bent to an L, U, Z or hat section, with holes and notches."""
    thickness, length = draw.length(2, 4), draw.length(40, 80)
    inner = draw.length(1, 1.5) * thickness
    a, b, c = draw.length(20, 35), draw.length(25, 45), draw.length(20, 35)
    kind = draw.pick("L", "U", "Z", "hat")
    spine = {"L": [(0, b), (0, 0), (a, 0)], "U": [(0, a), (0, 0), (b, 0), (b, c)], "Z": [(-a, b), (0, b), (0, 0), (c, 0)],
             "hat": [(-a, b), (0, b), (0, 0), (c, 0), (c, b), (c + a, b)]}[kind]
    spine = [V(x, 0, z) for x, z in spine]
    left, right = [], []
    for k, at in enumerate(spine):
        # Halfway to both sides of the spine; at a bend along the bisector of its right angle.
        normals = [V(-d.z, 0, d.x).normalize() for d in ([at - spine[k - 1]] if k else []) + ([spine[k + 1] - at] if k + 1 < len(spine) else [])]
        offset = sum(normals, V(0, 0, 0)) * (thickness / 2)
        left.append(at + offset)
        right.append(at - offset)
    body = polygon(left + right[::-1]).extrude(V(0, length, 0))
    for k in range(1, len(spine) - 1):
        for corner, other in ((left[k], right[k]), (right[k], left[k])):
            convex = (corner - spine[k - 1]).Length + (corner - spine[k + 1]).Length > (other - spine[k - 1]).Length + (other - spine[k + 1]).Length
            at = Part.makeLine(corner, corner + V(0, length, 0))
            edges = [edge for edge in body.Edges if edge.distToShape(at)[0] < 1e-6 and edge.Length > 0.9 * length]
            require(edges, "a bend without an edge")
            body = body.makeFillet(inner + thickness if convex else inner, edges)
    hole = draw.length(2.5, 4)
    top = spine[-1]
    lying = abs(top.z - spine[-2].z) < 1e-9
    for k in range(draw.count(1, 3)):
        y = length * (0.2 + 0.3 * k)
        middle = (top * 0.6 + spine[-2] * 0.4)
        tool = cylinder(hole, 4 * thickness, (middle.x, y, middle.z - 2 * thickness)) if lying else cylinder(
            hole, 4 * thickness, (middle.x - 2 * thickness, y, middle.z), X)
        body = cut(body, tool)
    if draw.chance(0.4):
        first = spine[0] * 0.5 + spine[1] * 0.5
        body = cut(body, slab(0.25 * a, 0.3 * length, 6 * thickness, first.x, length / 2, first.z - 3 * thickness)) if kind in ("Z", "hat") else cut(
            body, slab(6 * thickness, 0.3 * length, 0.3 * a, first.x, length / 2, first.z))
    return body


@family
def heat_sink(draw):
    """A plate with fins that are thinner at the top; with or without holes through the plate."""
    fins, pitch, foot = draw.count(4, 8), draw.length(8, 11), draw.length(3, 4)
    tip, rise = foot * draw.real(0.4, 0.8), draw.length(15, 28)
    plate, length = draw.length(5, 8), draw.length(40, 70)
    width = fins * pitch
    outline = [(0, 0), (width, 0), (width, plate)]
    for k in reversed(range(fins)):
        x = (k + 0.5) * pitch
        outline += [(x + foot / 2, plate), (x + tip / 2, plate + rise), (x - tip / 2, plate + rise), (x - foot / 2, plate)]
    body = polygon([V(x, 0, z) for x, z in [*outline, (0, plate)]]).extrude(V(0, length, 0))
    if draw.chance(0.4):
        # In the gap next to the middle fin, narrower than the gap or wider, so that it leaves the fins' feet on both sides.
        hole, x = draw.length(1.5, 4.5), pitch * (fins // 2)
        for share in draw.pick((0.5,), (0.2, 0.8)):
            body = cut(body, cylinder(hole, plate + rise + 1, (x, share * length, 0)))
    return body


@family
def manifold(draw):
    """A block with a long bore, crossing bores from three sides, counterbores and bolt holes."""
    length, width, height = draw.length(70, 110), draw.length(32, 45), draw.length(32, 45)
    main = draw.length(5, 8)
    body = slab(length, width, height)
    tools = [cylinder(main, length * draw.pick(1.0, 0.8), (-length / 2, 0, height / 2), X)]
    ports = draw.count(2, 4)
    for k in range(ports):
        x = length * ((k + 0.5) / ports - 0.5) * 0.75
        radius = main * draw.pick(draw.real(0.5, 0.85), draw.real(0.5, 0.85), 1.0)
        side = draw.pick("top", "top", "front", "back")
        at, axis = {"top": ((x, 0, height / 2), Z), "front": ((x, 0, height / 2), V(0, -1, 0)), "back": ((x, 0, height / 2), Y)}[side]
        reach = (height if side == "top" else width) / 2
        tools.append(cylinder(radius, reach, at, axis))
        if draw.chance():
            tools.append(cylinder(1.5 * radius, 5, V(*at) + axis * (reach - 5), axis))
    body = cut(body, *tools)
    hole = draw.length(2, 3)
    if draw.chance():
        body = cut(body, *[cylinder(hole, height, (sx * (length / 2 - 6), sy * (width / 2 - 6), 0)) for sx in (1, -1) for sy in (1, -1)])
    return body


@family
def bearing_block(draw):
    """A foot with slots or holes, a round back, a bore with a shoulder."""
    bore, wall, thickness = draw.length(14, 22), draw.length(7, 10), draw.length(24, 36)
    radius, axis = bore + wall, draw.length(32, 42)
    foot, base = 2 * radius + draw.length(40, 60), draw.length(9, 14)
    require(axis > bore + base + 2, "the bore meets the foot")
    back = cylinder(radius, thickness, (0, 0, axis), Y)
    body = union(back, block(2 * radius, thickness, axis, (-radius, 0, 0)), block(foot, thickness, base, (-foot / 2, 0, 0)))
    body = cut(body, cylinder(bore, thickness, (0, 0, axis), Y))
    if draw.chance():
        body = cut(body, cylinder(bore + 0.4 * wall, 0.3 * thickness, (0, 0, axis), Y))
    at, hole = (foot / 2 + radius) / 2, draw.length(3.5, 5)
    if draw.chance():
        body = cut(body, *[slot(draw.length(5, 8), 2 * hole, base, s * at, thickness / 2) for s in (1, -1)])
    else:
        body = cut(body, *[cylinder(hole, base, (s * at, thickness / 2, 0)) for s in (1, -1)])
    if draw.chance(0.4):
        body = cut(body, cylinder(draw.length(2, 3), radius + 5, (0, thickness / 2 + 2, axis)))
    return body


@family
def clevis(draw):
    """A fork with a pin hole and round ends, on a round or square stem."""
    width, gap, reach = draw.length(24, 36), draw.length(9, 13), draw.length(28, 45)
    thickness = draw.length(20, 28)
    stem, length = draw.length(6, 9), draw.length(25, 40)
    pin = draw.length(4, 6)
    require(thickness / 2 > pin + 3 and (width - gap) / 2 > 4, "thin cheeks")
    body = strap(reach, thickness / 2, thickness / 2, width).translated(V(0, 0, -width / 2))
    body = union(body, block(reach - 2, thickness, width, (-thickness / 2 - 2, -thickness / 2, -width / 2)))
    slit = draw.length(0, 5)
    body = cut(body, block(reach + thickness, thickness, gap, (slit, -thickness / 2, -gap / 2)))
    body = cut(body, cylinder(pin, width, (reach, 0, -width / 2)))
    at = (-thickness / 2 - 2, 0, 0)
    if draw.chance(0.6):
        require(stem < min(thickness, width) / 2, "the stem is thicker than the fork")
        return union(body, cylinder(stem, length, at, V(-1, 0, 0)))
    return union(body, block(length, 1.6 * stem, 1.6 * stem, (at[0] - length, -0.8 * stem, -0.8 * stem)))


@family
def v_block(draw):
    """A V with an undercut, slots in the sides and a bolt hole with a countersink."""
    width, length, height = draw.length(40, 60), draw.length(35, 60), draw.length(35, 50)
    mouth, under = 0.35 * width, draw.length(2, 4)
    foot = height - mouth
    outline = [(-width / 2, 0), (width / 2, 0), (width / 2, height), (mouth, height), (under / 2, foot + under / 2), (under / 2, foot - 2), (-under / 2, foot - 2),
               (-under / 2, foot + under / 2), (-mouth, height), (-width / 2, height)]
    body = polygon([V(x, 0, z) for x, z in outline]).extrude(V(0, length, 0))
    if draw.chance():
        rise, deep = draw.length(5, 8), draw.length(4, 7)
        for x in (-width / 2, width / 2 - deep):
            body = cut(body, block(deep, length, rise, (x, 0, 0.3 * height)))
    hole = draw.length(2.5, 4)
    if draw.chance():
        body = cut(body, cylinder(hole, foot, (0, length / 2, 0)), cone(2 * hole, hole, hole, (0, length / 2, 0)))
    return body


@family
def dovetail(draw):
    """A slide: dovetail below, a slope or a slot on top, holes with countersinks."""
    width, length, height = draw.length(40, 60), draw.length(50, 80), draw.length(14, 22)
    tail, depth = 0.55 * width, draw.length(6, 10)
    lean = depth * draw.real(0.5, 0.8)
    outline = [(-width / 2, 0), (-tail / 2 + lean, 0), (-tail / 2, -depth), (tail / 2, -depth), (tail / 2 - lean, 0), (width / 2, 0), (width / 2, height),
               (-width / 2, height)]
    body = polygon([V(x, 0, z) for x, z in outline]).extrude(V(0, length, 0))
    if draw.chance():
        fall = height * draw.real(0.2, 0.45)
        body = cut(body, polygon([(-width, 0, height), (-width, length, height), (-width, length, height - fall)]).extrude(V(2 * width, 0, 0)))
    else:
        body = cut(body, slab(draw.length(8, 12), length, height, 0, length / 2, 0.5 * height))
    hole = draw.length(2.5, 3.5)
    for share in (0.25, 0.75):
        body = cut(body, cylinder(hole, height + depth, (0.33 * width, share * length, -depth)))
    return body


@family
def extrusion(draw):
    """An aluminium profile with T slots on four sides and a bore, cut to length."""
    side, mouth = draw.length(36, 44), draw.length(7, 9)
    lip, inner, depth = draw.length(3, 4.5), draw.length(15, 18), draw.length(10, 12)
    body = slab(side, side, draw.length(20, 50))
    height = body.BoundBox.ZMax
    body = fillet(body, draw.length(1.5, 3), is_upright)
    half = side / 2
    narrow = mouth / 2
    tool = prism([(half + 1, -narrow), (half + 1, narrow), (half - lip, narrow), (half - lip, inner / 2), (half - lip - 2, inner / 2),
                  (half - depth, narrow), (half - depth, -narrow), (half - lip - 2, -inner / 2), (half - lip, -inner / 2), (half - lip, -narrow)], height)
    for k in range(4):
        body = cut(body, tool.rotated(V(0, 0, 0), Z, 90 * k))
    return cut(body, cylinder(draw.length(2.5, 4), height))
