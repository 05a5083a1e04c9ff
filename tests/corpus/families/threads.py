"""Screws, nuts and what has a thread. The plain ones have smooth shanks and bores; those with helical threads are hard."""

import math

from .registry import family, hard
from .tools import (ORIGIN, V, Z, Part, arc, cone, cut, cylinder, face_of, fillet, hexagon, is_circle, line, polygon, require, slab, turned,
                    turned_copies, union)


def chamfered_hexagon(across_flats, height, top, bottom=False, share=1.0):
    """A hexagon whose corners a cone of 30 degrees takes off. The cone's circle on the end is `share` of the width across flats: at 1 it touches the six edges."""
    radius = across_flats / math.sqrt(3)
    circle = share * across_flats / 2
    drop = (radius + 1 - circle) * math.tan(math.radians(30))
    require(height > 2 * drop + 1, "the chamfers meet")
    outline = [(0, 0), (circle, 0), (radius + 1, drop)] if bottom else [(0, 0), (radius + 1, 0)]
    outline += [(radius + 1, height - drop), (circle, height), (0, height)] if top else [(radius + 1, height), (0, height)]
    return hexagon(across_flats, height).common(turned(outline))


@family
def hex_bolt(draw):
    """A head with a chamfer that touches its edges or leaves a land; shank with a bevel, with or without washer face and fillet below the head."""
    radius = draw.length(5, 10)
    across, height = round(radius * draw.real(3.0, 3.4), 1), radius * draw.real(1.2, 1.5)
    body = chamfered_hexagon(across, height, True, share=draw.pick(1.0, 1.0, 0.95))
    length, bevel = draw.length(20, 60), 0.15 * radius
    shank = turned([(0, 1), (radius, 1), (radius, bevel - length), (radius - bevel, -length), (0, -length)])
    if draw.chance(0.4):
        body = union(body, cylinder(0.475 * across, 0.6, axis=V(0, 0, -1)))
    body = union(body, shank)
    if draw.chance(0.4):
        body = fillet(body, 0.1 * radius, lambda edge: is_circle(radius)(edge) and edge.Curve.Center.z > -1)
    if draw.chance(0.3):
        body = cut(body, cylinder(0.15 * radius, 4 * radius, (0, -2 * radius, 0.5 * height), V(0, 1, 0)))
    return body


@family
def hex_nut(draw):
    """Chamfers on one or both ends; a bore with countersinks; with or without flange."""
    radius = draw.length(5, 12)
    across, height = round(radius * draw.real(3.0, 3.4), 1), radius * draw.real(1.5, 1.9)
    flanged = draw.chance(0.3)
    body = chamfered_hexagon(across, height, True, not flanged and draw.chance(0.7), draw.pick(1.0, 1.0, 0.95))
    if flanged:
        body = union(body, turned([(0, 0), (0.7 * across, 0), (0.7 * across, 0.1 * height), (0.56 * across, 0.3 * height), (0, 0.3 * height)]))
    body = cut(body, cylinder(radius, height))
    sink = 0.12 * radius
    if draw.chance(0.7):
        body = cut(body, cone(radius + sink, radius, sink), cone(radius, radius + sink, sink, (0, 0, height - sink)))
    return body


@family
def standoff(draw):
    """A hexagonal spacer: stud on one end, blind bore in the other, chamfers or plain ends."""
    across, height, bore = draw.length(12, 20), draw.length(18, 40), draw.length(3, 4.5)
    share = draw.pick(0.92, 1.0)
    body = chamfered_hexagon(across, height, True, True, share) if draw.chance() else hexagon(across, height)
    if draw.chance(0.7):
        body = union(body, cylinder(0.8 * bore, draw.length(8, 14), axis=V(0, 0, -1)))
        return cut(body, cylinder(bore, 0.6 * height, (0, 0, 0.4 * height)))
    return cut(body, cylinder(bore, height))


def helical(profile, pitch, height, radius, cone_angle=0.0):
    """The solid that a closed profile, given in the plane y = 0, sweeps along a helix about Z that starts at (radius, 0, 0)."""
    helix = Part.makeHelix(pitch, height, radius, cone_angle)
    wire = Part.makePolygon([V(r, 0, z) for r, z in [*profile, profile[0]]])
    swept = Part.Wire(helix.Edges).makePipeShell([wire], True, True)
    require(swept.ShapeType == "Solid" or swept.Shells, "no solid was swept")
    solid = swept if swept.ShapeType == "Solid" else Part.Solid(swept.Shells[0])
    if solid.Volume < 0:
        solid.reverse()
    return solid


@hard(quick_check=True)  # OpenCASCADE searches its sweep for faces that meet for minutes, and cuts by it a little beyond its own tolerance
def thread(draw):
    """A rod with a thread of three to nine turns, cut by a profile swept along a helix; run out in the open at both ends, or ending in the rod."""
    radius, pitch, turns = draw.length(8, 14), draw.length(2.5, 4), draw.count(5, 9)
    deep = 0.55 * pitch
    profile = [(radius - deep, -pitch / 16), (radius + 0.3, -0.45 * pitch), (radius + 0.3, 0.45 * pitch), (radius - deep, pitch / 16)]
    groove = helical(profile, pitch, turns * pitch, radius)
    # The seams of rod and groove apart: where they meet OpenCASCADE makes faces of no area.
    body = cut(cylinder(radius, (turns + 3) * pitch, (0, 0, -1.5 * pitch)).rotated(ORIGIN, Z, 40), groove)
    if draw.chance():
        body = body.common(slab(4 * radius, 4 * radius, (turns - 2) * pitch, z=pitch))
    return body


@hard
def pump_nut(draw):
    """A union nut: a ring with hammer lugs, a bore with a shoulder and a cone in it, bevels outside."""
    radius, height = draw.length(30, 42), draw.length(26, 38)
    bore = radius * draw.real(0.55, 0.68)
    lugs, lug, reach = draw.count(2, 4), draw.length(12, 18), draw.length(12, 20)
    bevel = draw.length(2, 4)
    body = turned([(0, 0), (radius - bevel, 0), (radius, bevel), (radius, height - bevel), (radius - bevel, height), (0, height)])
    low, foot, far = 0.2 * height, 0.7 * radius, radius + reach
    arm = polygon([(foot, -lug / 2, low), (far, -0.36 * lug, low), (far, 0.36 * lug, low), (foot, lug / 2, low)]).extrude(V(0, 0, 0.6 * height))
    arms = turned_copies(lugs, arm)
    body = union(body, *arms)
    body = fillet(body, draw.length(1.5, 3), lambda edge: abs(edge.BoundBox.ZLength - 0.6 * height) < 1e-3)
    seat = bore * draw.real(0.6, 0.75)
    shoulder = 0.3 * height
    inside = [(0, -1), (seat, -1), (seat, 0.5 * shoulder), (bore, shoulder), (bore, height - 2), (bore + 2, height), (bore + 2, height + 1), (0, height + 1)]
    return cut(body, turned(inside))


@hard
def hose_nipple(draw):
    """Barbs on one end, a hexagon, a pipe end with an undercut and a cone; bored through."""
    radius = draw.length(7, 10)
    bore = radius * draw.real(0.5, 0.65)
    barbs, pitch, rise = draw.count(3, 5), draw.length(5, 7), draw.length(1, 1.8)
    across, thickness = 3.2 * radius, draw.length(7, 10)
    z = thickness + 4
    outline = [(bore, 0), (radius, 0), (radius, z)]
    for _ in range(barbs):
        outline += [(radius + rise, z), (radius, z + pitch)]
        z += pitch
    outline += [(radius, z), (radius - 1.5, z + 3), (bore, z + 3)]
    outline = [point for k, point in enumerate(outline) if k == 0 or point != outline[k - 1]]
    pipe, length = 1.25 * radius, draw.length(14, 20)
    tail = [(bore, 0), (pipe - 1.5, 0), (pipe - 1.5, -2.5), (pipe, -4), (pipe, 1.5 - length), (pipe - 1.5, -length), (bore + 2, -length), (bore, -length + 3)]
    flat = chamfered_hexagon(across, thickness, True, True, draw.pick(0.95, 1.0)).cut(cylinder(bore, thickness))
    return union(turned(outline), flat, turned(tail))


@hard
def bottle(draw):
    """A hollow bottle after the tutorial that OpenCASCADE is known by: arcs in plan, fillets, a neck with a helical thread on it."""
    width, thickness, height = draw.length(45, 60), draw.length(25, 32), draw.length(60, 80)
    half = width / 2
    flat = thickness / 4
    outline = face_of(line((-half, -flat, 0), (-half, flat, 0)), arc((-half, flat, 0), (0, thickness / 2, 0), (half, flat, 0)), line((half, flat, 0), (half, -flat, 0)),
                      arc((half, -flat, 0), (0, -thickness / 2, 0), (-half, -flat, 0)))
    body = fillet(outline.extrude(V(0, 0, height)), thickness / 12)
    neck, rise = thickness / 4, draw.length(9, 12)
    body = union(body, cylinder(neck, rise, (0, 0, height)))
    top = max(body.Faces, key=lambda face: face.CenterOfMass.z)
    body = body.makeThickness([top], -thickness / 50, 1e-3)
    pitch = rise / 4
    profile = [(neck - thickness / 120, -0.3 * pitch), (neck + 0.35 * pitch, -0.05 * pitch), (neck + 0.35 * pitch, 0.05 * pitch), (neck - thickness / 120, 0.3 * pitch)]
    ridge = helical(profile, pitch, 2 * pitch, neck).translated(V(0, 0, height + 0.8 * pitch))
    return body.fuse(ridge)
