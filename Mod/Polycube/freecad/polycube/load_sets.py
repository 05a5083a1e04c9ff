"""FreeCAD's solver writers take the nodes and mesh faces of a constraint from the groups of a Polycube mesh.

FreeCAD searches for them in space, within 1e-7 mm. That misses mid-edge nodes which could not be on the CAD, finds no sides of hexahedra for heat flux and
section print (FreeCAD 0.20 and 1.0), and gives a force by areas of triangles, a few percent short on coarse round faces. Of a face between two solids it cannot
tell the nodes of one from those of the other. The groups know all of it, whenever the constraint was made. `install` puts them before the search, for our
meshes only, and has the Report view tell of a load that the mesh does not take.
"""

import functools
import json

import FreeCAD

from . import compat, shapes
from .errors import InvalidInput
from .words import tr

#: what the search for nodes and mesh faces leaves in the entry of a constraint
_FOUND = (
    "Nodes",
    "NodeLoadTable",
    "PressureFaces",
    "HeatFluxFaceTable",
    "SectionPrintFaces",
    "ContactSlaveFaces",
    "ContactMasterFaces",
    "TieSlaveFaces",
    "TieMasterFaces",
)
#: those of them that are pairs of a title and what is there
_TITLED = ("NodeLoadTable", "PressureFaces", "HeatFluxFaceTable")
#: share of a force that may be missing: FreeCAD's own search integrates over triangles
_FORCE_MISS = 0.01

#: corners of the sides of a hexahedron in SMESH's order, by their numbers in the files for CalculiX that FreeCAD writes
_SIDES = {1: (4, 5, 6, 7), 2: (0, 1, 2, 3), 3: (1, 2, 5, 6), 4: (2, 3, 6, 7), 5: (0, 3, 4, 7), 6: (0, 1, 4, 5)}
#: abscissas and weights of three Gauss points
_GAUSS = ((-(0.6**0.5), 5 / 9), (0.0, 8 / 9), (0.6**0.5, 5 / 9))
#: what a force is spread over, by the type of the shape: kind of the mesh's elements there, and size of the shape
_SPREAD = {"Face": ("Face", lambda face: face.Area), "Edge": ("Edge", lambda edge: edge.Length), "Vertex": ("Node", lambda vertex: 1.0)}


def install(grouped_shape):
    """Has FreeCAD's writers ask our groups from now on; False where this FreeCAD has other writers than those known here. To be called once.

    grouped_shape(mesh object): the shape whose faces Face1, Face2 ... the mesh has groups for; None where they are not to be asked.
    """
    try:
        from femmesh.meshsetsgetter import MeshSetsGetter
    except ImportError:
        return False
    wrappers = {
        "__init__": functools.partial(_with_groups, grouped_shape),
        "get_constraints_force_nodeloads": _whole_forces,
        "get_constraints_pressure_faces": _whole_pressures,
        "get_constraints_contact_faces": functools.partial(_sides_between, "Contact"),
        "get_constraints_tie_faces": functools.partial(_sides_between, "Tie"),
        "get_mesh_sets": _with_losses_told,
    }
    if not all(hasattr(MeshSetsGetter, name) for name in wrappers):
        return False
    for name, wrapper in wrappers.items():
        setattr(MeshSetsGetter, name, wrapper(getattr(MeshSetsGetter, name)))
    return True


class GroupedMesh:
    """A Fem.FemMesh that answers searches by shape from its groups, and where it has none by the search."""

    def __init__(self, owner, shape):
        self.owner = owner
        self._mesh = mesh = owner.FemMesh
        self.part_volume, self.faces = shape.Volume, shape.Faces
        self._shape = shape
        self._elements = {}
        for group in mesh.Groups:
            self._elements[mesh.getGroupName(group), mesh.getGroupElementType(group)] = group
        self._sides = None

    def __getattr__(self, name):
        return getattr(self._mesh, name)

    @property
    def Groups(self):
        """Without those of nodes: FreeCAD takes a constraint's `<Name>_Nodes` even where the constraint has changed since."""
        return [group for group in self._mesh.Groups if self._mesh.getGroupElementType(group) != "Node"]

    @property
    def GroupCount(self):
        return len(self.Groups)

    def elements(self, shape, kind):
        """Numbers of the mesh's elements (of a vertex: nodes) on a face, edge, vertex or solid of the part; empty where the mesh has no group for it."""
        name = shape.ShapeType
        group = self._elements.get((name + str(shapes.number_of(self._shape, shape)), kind))
        return () if group is None else self._mesh.getGroupElements(group)

    def sides_of(self, obj, face):
        """[mesh faces on a face of the part, for each solid that has them with nodes of its own]: of a face that solids share those of the object's solids."""
        name = "Face{}".format(shapes.number_of(self._shape, face, obj.Shape))
        solids = {shapes.number_of(self._shape, solid) for solid in obj.Shape.Solids}
        groups = [self._elements.get(("Solid{}_{}".format(number, name), "Face")) for number in sorted(solids)]
        groups = [group for group in groups if group is not None] or [self._elements.get((name, "Face"))]
        return [self._mesh.getGroupElements(group) for group in groups if group is not None]

    def between_solids(self):
        """Mesh faces at which two solids touch."""
        return {face for (name, kind), group in self._elements.items() if kind == "Face" and name.count("Solid") == 2 for face in self._mesh.getGroupElements(group)}

    def solids(self):
        """[cells of a solid, for each of the part]"""
        groups = [group for (name, kind), group in self._elements.items() if kind == "Volume" and name.startswith("Solid") and name[5:].isdigit()]
        return [self._mesh.getGroupElements(group) for group in groups]

    def _nodes(self, shape, kind, search):
        elements = self.elements(shape, kind)
        return sorted({node for element in elements for node in self._mesh.getElementNodes(element)}) if elements else search(shape)

    def getNodesByFace(self, shape):
        return self._nodes(shape, "Face", self._mesh.getNodesByFace)

    def getNodesByEdge(self, shape):
        return self._nodes(shape, "Edge", self._mesh.getNodesByEdge)

    def getNodesBySolid(self, shape):
        return self._nodes(shape, "Volume", self._mesh.getNodesBySolid)

    def getNodesByVertex(self, shape):
        return list(self.elements(shape, "Node")) or self._mesh.getNodesByVertex(shape)

    def getFacesByFace(self, shape):
        return list(self.elements(shape, "Face")) or self._mesh.getFacesByFace(shape)

    def getEdgesByEdge(self, shape):
        return list(self.elements(shape, "Edge")) or self._mesh.getEdgesByEdge(shape)

    def getccxVolumesByFace(self, shape):
        """(volume, number of its side) of every mesh face on a face of the part."""
        elements = self.elements(shape, "Face")
        if not elements:
            return self._mesh.getccxVolumesByFace(shape)
        sides = self.sides()
        return [sides[face] for face in elements if face in sides]

    def sides(self):
        """{mesh face: (volume, number of its side)} of the mesh faces that are sides of volumes."""
        if self._sides is None:
            corners = {frozenset(self._mesh.getElementNodes(face)[:4]): face for face in self._mesh.Faces}
            self._sides = {}
            for volume in self._mesh.Volumes:
                nodes = self._mesh.getElementNodes(volume)
                for number, side in _SIDES.items():
                    face = corners.get(frozenset(nodes[i] for i in side))
                    if face is not None:
                        self._sides[face] = (volume, number)
        return self._sides

    def weights(self, elements):
        """{node: integral of its shape function} over mesh faces or edges: the share of an even load that it takes, in mm2 or mm."""
        return self._integrals(elements, lambda value, size: value * _lengths(size))

    def lumped_weights(self, elements):
        """As weights(), none of them negative: by the squares of the shape functions, scaled to the size of each mesh face."""
        rows, squares = self._per_element(elements, lambda value, size: value**2 * _lengths(size))
        _, even = self._per_element(elements, lambda value, size: value * _lengths(size))
        return self._summed(rows, squares * (even.sum(axis=1) / squares.sum(axis=1))[:, None])

    def area_vectors(self, elements):
        """{node: integral of its shape function times the normal} over mesh faces, in mm2: what a pressure of -1 MPa does to it, in N."""
        return self._integrals(elements, lambda value, size: value[:, None] * size[:, None, :])

    def _integrals(self, elements, integrand):
        rows, found = self._per_element(elements, integrand)
        return self._summed(rows, found)

    def _per_element(self, elements, integrand):
        """(nodes of the elements, integrals of integrand(shape functions, size vectors)): arrays with a row for every element and a column for every node."""
        import numpy

        rows = numpy.array([self._mesh.getElementNodes(element) for element in elements])
        points = self._mesh.Nodes
        places = numpy.array([[points[node][:] for node in row] for row in rows.tolist()])
        found = 0.0
        for value, slopes, weight in _QUADRATURE[rows.shape[1]]:
            along = [numpy.einsum("n,mnd->md", slope, places) for slope in slopes]
            found = found + weight * integrand(numpy.array(value), numpy.cross(*along) if len(along) == 2 else along[0])
        return rows, found

    @staticmethod
    def _summed(rows, found):
        import numpy

        nodes, places = numpy.unique(rows, return_inverse=True)
        total = numpy.zeros((len(nodes), *found.shape[2:]))
        numpy.add.at(total, places.ravel(), found.reshape(-1, *found.shape[2:]))
        return dict(zip(nodes.tolist(), total.tolist()))


def _lengths(vectors):
    import numpy

    return numpy.linalg.norm(vectors, axis=1)[:, None]


class _StandIn:
    """A document object with other values for some of its properties."""

    def __init__(self, obj, **values):
        self._obj = obj
        self.__dict__.update(values)

    def __getattr__(self, name):
        return getattr(self._obj, name)


def _with_groups(grouped_shape, original):
    @functools.wraps(original)
    def __init__(self, *arguments, **named):
        original(self, *arguments, **named)
        obj = getattr(self, "mesh_object", None)
        shape = grouped_shape(obj)
        if shape is not None:
            self.femmesh = GroupedMesh(obj, shape)
            self.mesh_object = _StandIn(obj, FemMesh=self.femmesh)

    return __init__


def _whole_forces(original):
    """Even loads on faces and edges by the shape functions, equal ones on vertices, scaled to the force: its whole arrives, however coarse the mesh."""
    return _replaced(original, "cons_force", _fill_force)


def _whole_pressures(original):
    """Pressures on the sides of cells on the CAD faces. FreeCAD takes all sides whose nodes are on the faces: of a wall of one linear cell those inside too."""
    return _replaced(original, "cons_pressure", _fill_pressure)


def _sides_between(kind, original):
    """Of two faces in contact or tied the sides of cells, each of its own solid. One face that two solids share is both of them."""
    return _replaced(original, "cons_" + kind.lower(), functools.partial(_fill_sides, kind))


def _replaced(original, members, fill):
    """Has `fill` do the members that it can do by our groups, and the original the others."""

    @functools.wraps(original)
    def get(self):
        everyone = getattr(self.member, members)
        ours = isinstance(self.femmesh, GroupedMesh)
        setattr(self.member, members, [member for member in everyone if not (ours and fill(self.femmesh, member))])
        try:
            original(self)
        finally:
            setattr(self.member, members, everyone)

    return get


def _with_losses_told(original):
    """Warns of constraints that the search finds nothing for: FreeCAD's writer leaves them out without a word, as a force on the seam of a cylinder."""

    @functools.wraps(original)
    def get(self):
        original(self)
        if not isinstance(self.femmesh, GroupedMesh):
            return
        for entries in vars(self.member).values():
            for entry in entries if isinstance(entries, list) else ():
                names = not_captured(entry["Object"], self.femmesh.owner)
                lost = tr("the mesh does not capture {}").format(", ".join(names)) if names else loss(entry)
                if lost:
                    FreeCAD.Console.PrintWarning("{}: {}\n".format(entry["Object"].Label, lost))

    return get


def not_captured(constraint, obj):
    """Names of the faces, edges and vertices that a constraint is on and the mesh object does not have as they are."""
    missing = {name for kind in json.loads(obj.Report)["cad"].values() for name in kind["lost"] + kind["ignored"]}
    references = getattr(constraint, "References", []) if missing else []
    return sorted({name for owner, names in references for name in missing.intersection(shapes.names_in(compat.part_of(obj), owner, names))})


def loss(entry):
    """What of a constraint's entry the mesh does not take, as a sentence; empty where it takes all."""
    for obj, name in references(entry["Object"]) if hasattr(entry["Object"], "References") else ():
        if name.startswith("Edge") and shapes.is_seam(obj.Shape, obj.Shape.getElement(name)):
            return tr("{} is {}").format(name, tr(shapes.SEAM))
    for name in (name for name in _FOUND if name in entry):
        found = entry[name]
        if name in _TITLED:
            found = [part for _, there in found for part in there]
        if not found:
            return tr("nothing of the mesh is where it acts")
    if "NodeLoadTable" in entry:
        asked = float(compat.newtons(entry["Object"]))
        arrived = float(sum(load for _, loads in entry["NodeLoadTable"] for load in loads.values()))
        if abs(asked - arrived) > _FORCE_MISS * abs(asked):
            return tr("only {:.4g} of {:.4g} N are where the mesh is").format(arrived, asked)
    return ""


def references(constraint):
    """(object, name) of what the constraint acts on, each once, however often it is named."""
    return list({(obj.Document.Name, obj.Name, name): (obj, name) for obj, names in constraint.References for name in names}.values())


def _shapes(constraint):
    return [(obj, name, obj.Shape.getElement(name)) for obj, name in references(constraint)]


def _fill_force(mesh, member):
    force = member["Object"]
    found = []
    for obj, name, shape in _shapes(force):
        kind, size = _SPREAD.get(shape.ShapeType, (None, None))
        elements = mesh.elements(shape, kind)
        if not elements:
            return False
        weights = dict.fromkeys(elements, 1.0) if kind == "Node" else mesh.weights(elements)
        found.append(("node loads on shape: {}:{}".format(obj.Name, name), size(shape), weights))
    whole = sum(size for _, size, _ in found)
    member["NodeLoadTable"] = []
    for title, size, weights in found:
        factor = compat.newtons(force) * (size / whole / sum(weights.values()))
        member["NodeLoadTable"].append((title, {node: weight * factor for node, weight in weights.items()}))
    # FreeCAD takes the direction of a force inside the container of what it is the direction of; the mesh may stand elsewhere.
    source = force.Direction[0] if force.Direction else force.References[0][0]
    turn = shapes.standing(mesh.owner).inverse().multiply(shapes.standing(source)).Rotation
    if turn.Angle:
        member["Object"] = _StandIn(force, DirectionVector=turn.multVec(force.DirectionVector))
    return True


def _fill_pressure(mesh, member):
    faces = []
    for _, _, shape in _shapes(member["Object"]):
        if shape.ShapeType != "Face" or not mesh.elements(shape, "Face"):
            return False
        faces += mesh.getccxVolumesByFace(shape)
    member["PressureFaces"] = [("{}: face load".format(member["Object"].Name), faces)]
    return True


def _fill_sides(kind, mesh, member):
    constraint = member["Object"]
    found = [mesh.sides_of(obj, shape) if shape.ShapeType == "Face" else [] for obj, _, shape in _shapes(constraint)]
    if len(found) == 1:
        found = [[side] for side in found[0]]
    if len(found) != 2 or not all(found):
        return False
    slave, master = ([face for side in sides for face in side] for sides in found)
    if mesh.between_solids().intersection(slave).intersection(master):
        raise InvalidInput(tr("{}: the solids have common nodes where it acts; make the mesh with Interfaces = separate").format(constraint.Label))
    sides = mesh.sides()
    member[kind + "SlaveFaces"], member[kind + "MasterFaces"] = ([list(sides[face]) for face in faces] for faces in (slave, master))
    return True


def _line_rule(count):
    for at, weight in _GAUSS:
        if count == 2:
            yield ((1 - at) / 2, (1 + at) / 2), ((-0.5, 0.5),), weight
        else:
            yield (at * (at - 1) / 2, at * (at + 1) / 2, 1 - at * at), ((at - 0.5, at + 0.5, -2 * at),), weight


def _quad_rule(count):
    corners, middles = ((-1, -1), (1, -1), (1, 1), (-1, 1)), ((0, -1), (1, 0), (0, 1), (-1, 0))
    for r, weight_r in _GAUSS:
        for s, weight_s in _GAUSS:
            if count == 4:
                value = [(1 + a * r) * (1 + b * s) / 4 for a, b in corners]
                by_r, by_s = [a * (1 + b * s) / 4 for a, b in corners], [b * (1 + a * r) / 4 for a, b in corners]
            else:
                value = [(1 + a * r) * (1 + b * s) * (a * r + b * s - 1) / 4 for a, b in corners]
                value += [(1 - r * r) * (1 + b * s) / 2 if a == 0 else (1 + a * r) * (1 - s * s) / 2 for a, b in middles]
                by_r = [a * (1 + b * s) * (2 * a * r + b * s) / 4 for a, b in corners]
                by_r += [-r * (1 + b * s) if a == 0 else a * (1 - s * s) / 2 for a, b in middles]
                by_s = [b * (1 + a * r) * (2 * b * s + a * r) / 4 for a, b in corners]
                by_s += [b * (1 - r * r) / 2 if a == 0 else -s * (1 + a * r) for a, b in middles]
            yield value, (by_r, by_s), weight_r * weight_s


#: per number of nodes: (shape functions, their slopes along each direction, weight) at Gauss points
_QUADRATURE = {2: list(_line_rule(2)), 3: list(_line_rule(3)), 4: list(_quad_rule(4)), 8: list(_quad_rule(8))}
