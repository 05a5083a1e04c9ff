"""Turbomachinery."""

import math

from .registry import hard
from .tools import V, Z, Part, cut, cylinder, require, turned, turned_copies, union


def _blade(inner, outer, bottom, top, twist, thickness, sections=5):
    """A plate that stands on a hub from radius `inner` to `outer` and winds by `twist` degrees from `bottom` to `top`."""
    wires = []
    for k in range(sections):
        share = k / (sections - 1)
        z, turn, half = bottom + share * (top - bottom), twist * share * (2 - share), thickness / 2 * (1 - 0.3 * share)
        corners = [V(inner, -half, 0), V(outer, -half, 0), V(outer, half, 0), V(inner, half, 0)]
        wire = Part.makePolygon([*corners, corners[0]])
        wire.rotate(V(0, 0, 0), Z, turn)
        wire.translate(V(0, 0, z))
        wires.append(wire)
    return Part.makeLoft(wires, True, False)


@hard(quick_check=True)  # OpenCASCADE searches its lofts for faces that meet for minutes, and cuts them a little beyond its own tolerance
def impeller(draw):
    """Twisted blades on a conical hub with a back plate and a bore, trimmed to a conical shroud."""
    radius, eye, height = draw.length(38, 50), draw.length(20, 26), draw.length(24, 34)
    hub, plate, bore = draw.length(10, 13), draw.length(3, 5), draw.length(4, 6)
    blades, twist, thickness = draw.count(5, 8), draw.real(25, 50), draw.length(2, 3)
    require(math.pi * 2 * hub / blades > thickness + 2, "the blades meet at the hub")
    core = turned([(0, 0), (radius, 0), (radius, plate), (0.55 * radius, plate + 0.2 * height), (hub, height), (0, height)])
    envelope = turned([(0, 0), (radius, 0), (radius, plate + 0.25 * height), (eye, 0.92 * height), (0, 0.92 * height)])
    blade = _blade(0.5 * hub, radius + 2, 0.5 * plate, height, twist, thickness).common(envelope)
    return cut(union(core, *turned_copies(blades, blade)), cylinder(bore, height))
