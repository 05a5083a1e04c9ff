"""Constraints that FreeCAD has in its menus and writes nothing for into the input of CalculiX: bearing, gear, pulley, spring and body heat source.

The cards are made from the groups of a Polycube mesh, so that the whole of each arrives. How each is understood:

- bearing: the nodes of its round face stay at their distance from the axis, and along the axis unless it is free there; turning is free.
- gear: its force at half its diameter from the axis, turned round it by the angle, as FreeCAD draws it. Force and moment are spread over the face.
- pulley: the two forces of its belt where they leave the wheel. FreeCAD calculates them; the pulley's force is a moment in Nm there.
- spring: stiffness of all its faces together, against the ground, spread by area; along the normal and across it.
- body heat source: W/kg times the density of the material, or in FreeCAD 1.x a power per volume.
"""

import math

import FreeCAD

from . import compat, shapes
from .errors import InvalidInput
from .load_sets import references
from .words import tr

#: below this share of its row a coefficient of an equation is rounding
_ROUNDING = 1e-9
#: Length of springs over the width of their face. CalculiX follows the turning of a spring in linear runs too: a displacement u across one of length l
#: lengthens it by u^2 / 2 l.
_LONG = 1000.0


class Cards:
    """Lines for an input file: before the step and in it, and what they have to know of the rest of it.

    held: {node: directions 1 to 3 that are fixed already}. materials: (density in t/mm3, its cells), None for all. supports: nodes that get reactions,
    loads: {node: force}.
    """

    def __init__(self, first_node, first_element, held, materials):
        self.model, self.step = [], []
        self.held, self.materials = held, materials
        self.supports, self.loads = set(), {}
        self._node, self._element = first_node, first_element

    def new_node(self):
        self._node += 1
        return self._node - 1

    def new_element(self):
        self._element += 1
        return self._element - 1


def write(kind, mesh, constraint, cards):
    """Adds the cards of one constraint; kind: its key in WRITERS. Raises InvalidInput."""
    WRITERS[kind](mesh, constraint, cards)


def _faces(mesh, constraint):
    """Mesh faces of all CAD faces that the constraint refers to."""
    found = []
    for obj, name in references(constraint):
        elements = mesh.elements(obj.Shape.getElement(name), "Face") if name.startswith("Face") else ()
        if not elements:
            raise InvalidInput(tr("{}: the mesh has no faces on {} of {}").format(constraint.Label, name or tr("all"), obj.Label))
        found += elements
    if not found:
        raise InvalidInput(tr("{}: it refers to nothing").format(constraint.Label))
    return found


def _placement(mesh, constraint):
    """From the coordinates of what the constraint refers to into those of the mesh."""
    return shapes.standing(mesh.owner).inverse().multiply(shapes.standing(constraint.References[0][0]))


def _axis(mesh, constraint):
    """(point, unit vector) of a round face's axis."""
    if constraint.Radius <= 0 or constraint.Axis.Length <= 0:
        raise InvalidInput(tr("{}: it needs a round face").format(constraint.Label))
    placement = _placement(mesh, constraint)
    return placement.multVec(constraint.BasePoint), placement.Rotation.multVec(constraint.Axis).normalize()


def _bearing(mesh, constraint, cards):
    base, axis = _axis(mesh, constraint)
    points = mesh.Nodes
    for node in sorted({node for face in _faces(mesh, constraint) for node in mesh.getElementNodes(face)}):
        away = points[node] - base
        away -= axis * away.dot(axis)
        rows = [] if away.Length < _ROUNDING * constraint.Radius else [list(away.normalize())]
        if not constraint.AxialFree:
            rows.append(list(axis))
        for row in reduced(rows, cards.held.get(node, ())):
            if len(row) == 1:
                cards.model += ["*BOUNDARY", "{},{},{}".format(node, row[0][0], row[0][0])]
            else:
                cards.model += ["*EQUATION", str(len(row)), ",".join("{},{},{:.13G}".format(node, along, factor) for along, factor in row)]
        cards.supports.add(node)


def reduced(rows, fixed):
    """Homogeneous equations between three displacements, for CalculiX: each begins with one that is in no other and not `fixed` (1 to 3).

    Returns lists of (direction, coefficient) without zeros; an equation between fixed ones only is left out.
    """
    rows = [list(row) for row in rows]
    begun = {}
    for i, row in enumerate(rows):
        size = max(map(abs, row), default=0.0)
        free = [along for along in range(3) if along + 1 not in fixed and along not in begun.values()]
        lead = max(free, key=lambda along: abs(row[along]), default=None)
        if lead is None or abs(row[lead]) <= _ROUNDING * max(size, _ROUNDING):
            continue
        begun[i] = lead
        rows[i] = [value / row[lead] for value in row]
        for j, other in enumerate(rows):
            if j != i:
                rows[j] = [value - other[lead] * mine for value, mine in zip(other, rows[i])]
    found = []
    for i, lead in begun.items():
        terms = [(along + 1, rows[i][along]) for along in range(3) if along != lead and abs(rows[i][along]) > _ROUNDING]
        found.append([(lead + 1, 1.0), *terms])
    return found


def spread(mesh, faces, pulls):
    """{node: force} with the sum and the moment of `pulls`, pairs of a point and a force, spread over mesh faces by their area."""
    import numpy

    weights = mesh.weights(faces)
    points = mesh.Nodes
    share = numpy.array(list(weights.values()))
    places = numpy.array([points[node][:] for node in weights])
    centre = share @ places / share.sum()
    arms = places - centre
    force = sum((numpy.array(pull[:]) for _, pull in pulls), numpy.zeros(3))
    moment = sum((numpy.cross(numpy.array(point[:]) - centre, numpy.array(pull[:])) for point, pull in pulls), numpy.zeros(3))
    inertia = numpy.einsum("n,nij->ij", share, numpy.einsum("ni,ni->n", arms, arms)[:, None, None] * numpy.eye(3) - arms[:, :, None] * arms[:, None, :])
    turning = numpy.linalg.solve(inertia, moment)
    loads = share[:, None] * (force / share.sum() + numpy.cross(turning, arms))
    return dict(zip(weights, loads.tolist()))


def _pull(mesh, constraint, cards, pulls):
    cards.step.append("*CLOAD")
    for node, load in sorted(spread(mesh, _faces(mesh, constraint), pulls).items()):
        cards.loads[node] = [one + other for one, other in zip(cards.loads.get(node, (0.0,) * 3), load)]
        cards.step += ["{},{},{:.13E}".format(node, along, value) for along, value in enumerate(load, 1) if value]


def _wheel(axis):
    """As FreeCAD draws gears and pulleys: function of an angle, the direction from the axis at it. At 0 it is Z turned as Y is into the axis."""
    turn = FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), axis)
    return lambda angle: turn.multVec(FreeCAD.Vector(math.sin(angle), 0, math.cos(angle)))


def _gear(mesh, constraint, cards):
    base, axis = _axis(mesh, constraint)
    direction = _placement(mesh, constraint).Rotation.multVec(constraint.DirectionVector).normalize()
    arm = _wheel(axis)(math.radians(compat.plain(constraint.ForceAngle, "deg"))) * (compat.plain(constraint.Diameter, "mm") / 2)
    _pull(mesh, constraint, cards, [(base + arm, direction * compat.plain(constraint.Force, "N"))])


def _pulley(mesh, constraint, cards):
    base, axis = _axis(mesh, constraint)
    towards = _wheel(axis)
    angle, belt = math.radians(compat.plain(constraint.ForceAngle, "deg")), compat.plain(constraint.BeltAngle, "rad")
    radius = compat.plain(constraint.Diameter, "mm") / 2
    first, second = compat.plain(constraint.BeltForce1, "N"), compat.plain(constraint.BeltForce2, "N")
    quarter = math.pi / 2
    _pull(
        mesh,
        constraint,
        cards,
        [
            (base + towards(angle + belt) * radius, towards(angle + belt + quarter) * first),
            (base - towards(angle - belt) * radius, towards(angle - belt - quarter) * -second),
        ],
    )


def _spring(mesh, constraint, cards):
    names = ("NormalStiffness", "TangentialStiffness") if hasattr(constraint, "NormalStiffness") else ("normalStiffness", "tangentialStiffness")
    normal, across = (compat.plain(getattr(constraint, name), "N/mm", 1e-3) for name in names)  # plain numbers are N/m
    faces = _faces(mesh, constraint)
    weights, normals, points = mesh.lumped_weights(faces), mesh.area_vectors(faces), mesh.Nodes
    area = sum(weights.values())
    ground = []
    for node, weight in sorted(weights.items()):
        out = FreeCAD.Vector(*normals[node])
        # At a ridge between faces, or a corner of them, the normals may cancel.
        out = out.normalize() if out.Length > _ROUNDING * area else FreeCAD.Vector(0, 0, 1)
        aside = out.cross(min((FreeCAD.Vector(1, 0, 0), FreeCAD.Vector(0, 1, 0), FreeCAD.Vector(0, 0, 1)), key=lambda unit: abs(unit.dot(out)))).normalize()
        for stiffness, along in ((normal, out), (across, aside), (across, out.cross(aside))):
            if stiffness:
                ground.append(_grounded(cards, constraint, node, points[node] + along * (_LONG * area**0.5), stiffness * weight / area))
    cards.model += ["*BOUNDARY", *("{},1,3".format(node) for node in ground)]
    cards.supports.update(ground)


def _grounded(cards, constraint, node, place, stiffness):
    """A spring from the node to a new one at the place. Returns the new node."""
    end, element = cards.new_node(), cards.new_element()
    name = "SPRING{}".format(element)
    cards.model += ["*NODE", "{},{:.13G},{:.13G},{:.13G}".format(end, *place)]
    cards.model += ["*ELEMENT, TYPE=SPRINGA, ELSET={}".format(name), "{},{},{}".format(element, node, end)]
    cards.model += ["*SPRING, ELSET={}".format(name), "", "{:.13G}".format(stiffness)]
    return end


def _body_heat(mesh, constraint, cards):
    solids = [solid for obj, name in references(constraint) for solid in _solids(obj, name)]
    heated = {cell for solid in solids for cell in mesh.elements(solid, "Volume")} if solids else set(mesh.Volumes)
    if not heated:
        raise InvalidInput(tr("{}: the mesh has no cells in what it refers to").format(constraint.Label))
    volume = sum(solid.Volume for solid in solids) or mesh.part_volume
    for number, (density, cells) in enumerate(cards.materials):
        inside = sorted(heated if cells is None else heated.intersection(cells))
        if inside:
            name = "HEAT{}_{}".format(number, constraint.Name)
            cards.model += ["*ELSET,ELSET={}".format(name), *("{},".format(cell) for cell in inside)]
            cards.step += ["*DFLUX", "{},BF,{:.13G}".format(name, _power(constraint, density, volume))]


def _solids(obj, name):
    """Solids of a reference; FreeCAD 0.20 does not know them by name."""
    if name.startswith("Solid"):
        return [obj.Shape.Solids[int(name[5:]) - 1]]
    return (obj.Shape.getElement(name) if name else obj.Shape).Solids


def _power(constraint, density, volume):
    """Power per volume in mW/mm3, which is t/mm/s3."""
    if getattr(constraint, "Mode", "") == "Total Power":
        return compat.plain(constraint.TotalPower, "W") * 1e3 / volume
    if not density:
        raise InvalidInput(tr("{}: the material has no density").format(constraint.Label))
    rate = constraint.DissipationRate if hasattr(constraint, "DissipationRate") else constraint.HeatSource
    return compat.plain(rate, "W/kg") * 1e6 * density


#: by kind of constraint, as fem_mesh knows them
WRITERS = {"bearing": _bearing, "gear": _gear, "pulley": _pulley, "spring": _spring, "bodyheatsource": _body_heat}
#: in which analyses each does something; the others of any
ANALYSES = {"bodyheatsource": ("thermomech",)}
