"""Whether what holds the part carries what loads it: the loads of the analysis, as they were asked for, against CalculiX's reactions.

The reactions that CalculiX sums have the loads of the same nodes in them, a force on a face goes straight into the support where the two share an edge. So
the loads of the nodes that hold the part are taken off them, spread as CalculiX spreads them.
"""

import math
import os
import re

from . import compat, serendipity, shapes
from .load_sets import references
from .words import tr

#: share of the loads by which reactions may miss them
TOLERANCE = 0.005
#: abscissas and weights of three Gauss points
_GAUSS = ((-(0.6**0.5), 5 / 9), (0.0, 8 / 9), (0.6**0.5, 5 / 9))


class Balance:
    """loads: sum of what was asked for, N; reactions: of what holds the part; miss: their difference over the size of the loads."""

    def __init__(self, loads, reactions, size):
        import numpy

        self.loads, self.reactions = loads, reactions
        self.miss = float(numpy.linalg.norm(loads + reactions) / size) if size else 0.0

    @property
    def holds(self):
        return self.miss <= TOLERANCE

    def line(self):
        """One line for the log."""
        parts = ["({})".format(", ".join("{:.6g}".format(value) for value in vector)) for vector in (self.loads, self.reactions)]
        said = tr("reactions {} N carry the loads {} N").format(parts[1], parts[0])
        return tr("{}, but for {:.2g} %").format(said, 100 * self.miss) if self.holds else tr("NOT IN BALANCE by {:.2g} %: {}").format(100 * self.miss, said)


def check(mesh, member, special, supports, path, set_name):
    """The Balance of a linear run; None where something takes or gives forces that are not known here: contact, ties, rigid bodies.

    mesh: a GroupedMesh. member: FreeCAD's entries of the analysis. special: {node: load} that special_loads wrote. supports: nodes that hold the part.
    path: of the input file, set_name: the set whose reactions are printed.
    """
    import numpy

    if any(getattr(member, "cons_" + kind, []) for kind in ("contact", "tie", "rigidbody")):
        return None
    reaction = _printed(path, set_name)
    if reaction is None:
        return None
    asked, size, held = numpy.zeros(3), 0.0, numpy.zeros(3)
    for total, amount, loads in _loads(mesh, member, special):
        asked += total
        size += amount
        for node in supports.intersection(loads):
            held += loads[node]
    return Balance(asked, reaction - held, size)


def _loads(mesh, member, special):
    """(sum as asked for, sum of its sizes, {node: load as it is in the input file}) of each load: a pressure on a tube is no force, but it has a size."""
    import numpy

    for entry in member.cons_force:
        force = entry["Object"]
        direction = numpy.array(force.DirectionVector[:])
        loads = {}
        for _, table in entry["NodeLoadTable"]:
            for node, value in table.items():
                loads[node] = loads.get(node, 0.0) + direction * float(value)
        yield direction * float(compat.newtons(force)), abs(float(compat.newtons(force))), loads
    for entry in member.cons_pressure:
        pressure = compat.plain(entry["Object"].Pressure, "MPa") * (-1 if entry["Object"].Reversed else 1)
        faces = [face for obj, name in references(entry["Object"]) for face in mesh.elements(obj.Shape.getElement(name), "Face")]
        loads = {node: -pressure * numpy.array(vector) for node, vector in mesh.area_vectors(faces).items()}
        yield sum(loads.values(), numpy.zeros(3)), abs(pressure) * sum(mesh.weights(faces).values()), loads
    if member.cons_selfweight or member.cons_centrif:
        yield from _body_loads(mesh, member)
    if special:
        loads = {node: numpy.array(load) for node, load in special.items()}
        total = sum(loads.values(), numpy.zeros(3))
        yield total, numpy.linalg.norm(total), loads


def _body_loads(mesh, member):
    import numpy

    densities = {}
    for entry in member.mats_linear:
        densities.update(dict.fromkeys(entry.get("FEMElements") or mesh.Volumes, compat.density(entry["Object"])))
    nodes, shares, places = _volumes(mesh)
    mass = shares * numpy.array([densities.get(volume, 0.0) for volume in mesh.Volumes])[:, None, None]

    def summed(field):
        """Loads of nodes from an acceleration at the Gauss points."""
        found = numpy.einsum("mpn,mpd->mnd", mass, field)
        loads = {}
        for node, load in zip(nodes.ravel().tolist(), found.reshape(-1, 3)):
            loads[node] = loads.get(node, 0.0) + load
        return loads

    for entry in member.cons_selfweight:
        gravity = numpy.array(compat.gravity(entry["Object"])[:])
        loads = summed(numpy.broadcast_to(gravity, places.shape))
        yield gravity * mass.sum(), numpy.linalg.norm(gravity) * mass.sum(), loads
    for entry in member.cons_centrif:
        base, axis = _line(mesh, entry["Object"])
        arms = places - base
        arms = arms - (arms @ axis)[..., None] * axis
        field = (2 * math.pi * entry["Object"].RotationFrequency.getValueAs("1/s").Value) ** 2 * arms
        loads = summed(field)
        yield sum(loads.values(), numpy.zeros(3)), (mass.sum(axis=2) * numpy.linalg.norm(field, axis=2)).sum(), loads


def _line(mesh, centrif):
    import numpy

    obj, (name, *_) = centrif.RotationAxis[0]
    curve = obj.Shape.getElement(name).Curve
    placement = shapes.standing(obj)
    return numpy.array(placement.multVec(curve.Location)[:]), numpy.array(placement.Rotation.multVec(curve.Direction).normalize()[:])


def _volumes(mesh):
    """(nodes of the cells, shape function times volume at each Gauss point: cells, points, nodes; places of the points)"""
    import numpy

    nodes = numpy.array([mesh.getElementNodes(volume) for volume in mesh.Volumes])
    points = mesh.Nodes
    corners = numpy.array([[points[node][:] for node in row] for row in nodes.tolist()])
    shares, places = [], []
    for a, weight_a in _GAUSS:
        for b, weight_b in _GAUSS:
            for c, weight_c in _GAUSS:
                value, slopes = serendipity.shape_functions(nodes.shape[1], numpy.array((a, b, c)))
                jacobian = numpy.abs(numpy.linalg.det(numpy.einsum("nk,mnd->mkd", slopes, corners)))
                shares.append(jacobian[:, None] * value * (weight_a * weight_b * weight_c))
                places.append(numpy.einsum("n,mnd->md", value, corners))
    return nodes, numpy.stack(shares, axis=1), numpy.stack(places, axis=1)


def _printed(path, set_name):
    """The last sum of the reactions of a node set in the .dat file beside the input file, or None."""
    import numpy

    with open(os.path.splitext(path)[0] + ".dat", encoding="utf-8") as file:
        found = re.findall(r"total force .* for set {} .*\n\s*\n\s*(\S+)\s+(\S+)\s+(\S+)".format(set_name), file.read())
    return numpy.array([float(value) for value in found[-1]]) if found else None
