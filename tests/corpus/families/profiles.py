"""Prisms whose profile has smooth sides and sharp edges: two smooth faces meet in them."""

import math

from .registry import family
from .tools import V, arc, cut, cylinder, face_of, line, polar, require, Part


@family
def lens_prism(draw):
    """Two arcs, equal or not, extruded; with or without a bore."""
    chord, height = draw.length(40, 70), draw.length(10, 30)
    upper, lower = chord * draw.real(0.12, 0.3), chord * draw.pick(0.0, draw.real(0.05, 0.25))
    half = chord / 2
    first, second = (-half, 0, 0), (half, 0, 0)
    bottom = arc(second, (0, -lower, 0), first) if lower else line(second, first)
    body = face_of(arc(first, (0, upper, 0), second), bottom).extrude(V(0, 0, height))
    if draw.chance(0.4):
        radius = 0.25 * (upper + lower)
        body = cut(body, cylinder(radius, height, (0, (upper - lower) / 2, 0)))
    return body


@family
def drop_prism(draw):
    """An arc and its two tangents, which meet in a sharp edge; straight or bent to a comma."""
    radius, height = draw.length(12, 20), draw.length(10, 30)
    reach = radius * draw.real(1.6, 2.6)
    angle = math.degrees(math.acos(radius / reach))
    a, tip = polar(radius, angle), (reach, 0, 0)
    if draw.chance(0.7):
        b = V(a.x, -a.y, 0)
        body = face_of(line(tip, a), arc(a, (-radius, 0, 0), b), line(b, tip)).extrude(V(0, 0, height))
    else:
        # The lower side leaves the arc along its tangent and bends back to the tip.
        spline = Part.BSplineCurve()
        start = V(0, -radius, 0)
        spline.interpolate(Points=[start, V(*tip)], Tangents=[V(radius, 0, 0), V(radius, 1.2 * radius, 0)], TangentFlags=[True, True])
        body = face_of(line(tip, a), arc(a, (-radius, 0, 0), start), spline).extrude(V(0, 0, height))
    if draw.chance():
        body = cut(body, cylinder(0.5 * radius, height))
    return body


@family
def naca_prism(draw):
    """A symmetric or cambered four-digit aerofoil with a sharp trailing edge, straight or tapering, with or without a spar hole."""
    chord, span = draw.length(60, 100), draw.length(30, 80)
    thick, camber, place = draw.real(0.12, 0.21), draw.pick(0.0, draw.real(0.02, 0.05)), 0.4
    require(thick > 2 * camber, "bent more than thick")

    def sides(scale, z):
        upper, lower = [], []
        for i in range(17):
            x = (1 - math.cos(math.pi * i / 16)) / 2
            # The last coefficient closes the trailing edge.
            t = 5 * thick * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x ** 2 + 0.2843 * x ** 3 - 0.1036 * x ** 4)
            c = camber / place ** 2 * (2 * place * x - x * x) if x < place else camber / (1 - place) ** 2 * (1 - 2 * place + 2 * place * x - x * x)
            upper.append(V(x, c + t, 0) * (chord * scale) + V(0.25 * chord * (1 - scale), 0, z))
            lower.append(V(x, c - t, 0) * (chord * scale) + V(0.25 * chord * (1 - scale), 0, z))
        return upper, lower

    def outline(scale, z):
        """Two curves, from the trailing edge over the nose, upright there, and back."""
        curves = []
        for points in sides(scale, z):
            spline = Part.BSplineCurve()
            up = V(0, chord if len(curves) == 0 else -chord, 0)
            spline.interpolate(Points=points, Tangents=[up] + [V(0, 0, 0)] * 16, TangentFlags=[True] + [False] * 16)
            curves.append(spline.toShape())
        return Part.Wire(curves)

    if draw.chance(0.6):
        body = Part.Face(outline(1, 0)).extrude(V(0, 0, span))
    else:
        body = Part.makeLoft([outline(1, 0), outline(draw.real(0.55, 0.85), span)], True, True)
    if draw.chance(0.4):
        body = cut(body, cylinder(0.25 * thick * chord, span, (0.3 * chord, camber * chord, 0)))
    return body
