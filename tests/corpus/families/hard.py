"""Parts of the kinds on which hexahedral meshers are known to fail, but for those with threads and blades."""

from .registry import hard
from .tools import (ORIGIN, V, X, Y, Z, Part, block, cut, cylinder, fillet, is_upright, polar, require, rounded_slab, slab, strap, union)


@hard
def crankshaft(draw):
    """One to four throws in turn by the part's number: journals, webs with counterweights, pins; ends of different length."""
    throws = 1 + draw.index % 4
    main, pin, stroke = draw.length(9, 12), draw.length(7, 9.5), draw.length(14, 19)
    web, journal, width = draw.length(6, 8), draw.length(12, 16), draw.length(12, 16)
    order = {1: (0,), 2: (0, 180), 3: (0, 120, 240), 4: (0, 180, 180, 0)}[throws]
    pieces, z = [cylinder(main, 25, (0, 0, -25))], 0
    for k, turn in enumerate(order):
        for at in (z, z + web + width):
            cheek = strap(stroke, 1.55 * main, 1.45 * pin, web, at)
            pieces.append(cheek.rotated(ORIGIN, Z, turn))
        pieces.append(cylinder(pin, width + 2 * web, polar(stroke, turn, z)))
        z += 2 * web + width
        length = journal if k + 1 < throws else 30
        pieces.append(cylinder(main, length, (0, 0, z)))
        z += length
    body = union(*pieces)
    if draw.chance():
        body = cut(body, cylinder(0.3 * main, 12, (0, 0, -25)))
    return body


@hard
def cylinder_head(draw):
    """An air-cooled head: fins with round corners round a block, chamber and ports, bolt bores, a slanting spark plug bore."""
    side, fins, pitch, thickness = draw.length(70, 90), draw.count(4, 6), draw.length(7, 9), draw.length(2.5, 3.5)
    core, foot = 0.6 * side, draw.length(9, 12)
    height = foot + fins * pitch
    body = union(rounded_slab(side, side, foot, 8), rounded_slab(core, core, height, 10),
                 *[rounded_slab(side - 2 * k, side - 2 * k, thickness, 8, z=foot + (k + 1) * pitch - thickness) for k in range(fins)])
    chamber = draw.length(15, 19)
    ball = chamber * draw.real(1.1, 1.3)
    level = (ball * ball - chamber * chamber) ** 0.5
    body = cut(body, Part.makeSphere(ball, V(0, 0, -level)))
    far = side / 2 - 9
    body = cut(body, *[cylinder(3.2, height, (s * far, t * far, 0)) for s in (1, -1) for t in (1, -1)])
    plug = cylinder(draw.length(4, 5), 2 * height, (0, 0, 0.3 * chamber), V(0, 0.35, 1))
    return cut(body, plug, cylinder(draw.length(5, 6.5), side, (0, 0, foot + 1.6 * pitch), X))


@hard
def yoke(draw):
    """A universal joint's yoke: a hub, two arms that curve out of it, eyes with bores across, fillets."""
    hub, length, bore = draw.length(14, 18), draw.length(24, 32), draw.length(7, 9)
    eye, span, rise = draw.length(11, 14), draw.length(30, 38), draw.length(32, 42)
    cheek = draw.length(8, 11)
    fork = cylinder(span / 2 + cheek, 4 * eye, (0, -2 * eye, rise), Y).cut(cylinder(span / 2, 4 * eye, (0, -2 * eye, rise), Y))
    fork = fork.common(block(4 * span, 2 * eye, rise, (-2 * span, -eye, 0)))
    arms = [block(cheek, 2 * eye, 0.5 * eye, (x, -eye, rise - 0.5)) for x in (span / 2, -span / 2 - cheek)]
    eyes = [cylinder(eye, cheek, (x, 0, rise + 0.5 * eye - 0.5), X) for x in (span / 2, -span / 2 - cheek)]
    bottom = rise - span / 2 - cheek
    body = union(fork, *arms, *eyes, cylinder(hub, length, (0, 0, bottom + 0.6 * cheek), -Z))
    if draw.chance(0.6):
        body = fillet(body, draw.length(1, 2), lambda edge: edge.BoundBox.ZMin > bottom + cheek and is_upright(edge))
    body = cut(body, cylinder(0.6 * eye, 4 * span, (-2 * span, 0, rise + 0.5 * eye - 0.5), X))
    return cut(body, cylinder(bore, 0.8 * length, (0, 0, bottom + 0.6 * cheek - length)))


@hard
def big_bracket(draw):
    """More than 300 faces: a plate with rows of filleted bosses and ribs, every edge of which is round, and a bore in each boss."""
    columns, rows, pitch = draw.count(4, 5), draw.count(3, 4), draw.length(26, 30)
    plate, boss, height = draw.length(8, 10), draw.length(7, 8.5), draw.length(12, 18)
    radius = draw.length(1, 1.6)
    rib = draw.length(5, 6.5)
    width, depth = columns * pitch, rows * pitch
    places = [(pitch * (i - (columns - 1) / 2), pitch * (j - (rows - 1) / 2)) for i in range(columns) for j in range(rows)]
    pieces = [slab(width, depth, plate)] + [cylinder(boss, plate + height, (x, y, 0)) for x, y in places]
    for j in range(rows):
        y = pitch * (j - (rows - 1) / 2)
        pieces.append(slab(width - pitch, rib, plate + 0.55 * height, 0, y))
    pieces.append(block(12, depth, plate + 2.5 * height, (width / 2 - 1, -depth / 2, 0)))
    body = union(*pieces)
    body = fillet(body, radius)
    bores = [cylinder(0.5 * boss, 60, (x, y, -30)) for x, y in places]
    sinks = [cylinder(0.7 * boss, 60, (x, y, plate + height - 3)) for x, y in places]
    body = cut(body, *bores, *sinks)
    require(len(body.Faces) > 300, "only {} faces".format(len(body.Faces)))
    return body
