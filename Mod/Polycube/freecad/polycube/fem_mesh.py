"""A Fem.FemMesh from the arrays, and the groups that FreeCAD's solvers look for."""

import importlib.util

from . import compat, engine, shapes
from .words import noop, tr

#: Constraints that FreeCAD's own search, in 0.20 and 1.0, does not find on hexahedra: it knows tetrahedra only.
_TETRAHEDRA_ONLY = {"Fem::ConstraintHeatflux": noop("heat flux"), "Fem::ConstraintSectionPrint": noop("section print")}
#: Constraints that FreeCAD has in its menus and, in some versions, no writer for: type and the writer's name, by which special_loads knows them
_SPECIAL = {
    "Fem::ConstraintBearing": "bearing",
    "Fem::ConstraintBodyHeatSource": "bodyheatsource",
    "Fem::ConstraintGear": "gear",
    "Fem::ConstraintPulley": "pulley",
    "Fem::ConstraintSpring": "spring",
}
#: Constraints that load faces of the mesh.
_FACE_LOADS = {"Fem::ConstraintForce": noop("force"), "Fem::ConstraintPressure": noop("pressure")}
#: Nodes or elements that are added between two breaths: a few hundredths of a second.
_SLICE = 4000


def build(result, breathe=None):
    """Fem.FemMesh with cells, boundary quads and edges in SMESH order, and groups Face3, Edge5, Vertex2, Solid1.

    Of several solids also Solid1_Solid2 and Solid2_Solid1, the faces of each that touch the other, and Solid1_Face3 where they share Face3.
    Node i of the arrays is node i + 1. Cell i is element i + 1; quads follow the cells, edges follow the quads. `breathe(fraction)` is called again and
    again meanwhile, for a window that is not to freeze: 200,000 cells of second order take ten seconds.
    """
    import Fem

    second = result.order == 2
    mesh = Fem.FemMesh()
    order = engine.description()["smesh_hex20"]
    cells = result.hexes[:, order if second else order[:8]] + 1
    quads, segments = result.quads + 1, result.segments + 1
    work = len(result.nodes) + len(cells) + len(quads) + len(segments)
    done = 0

    def add(rows, add_one, first):
        nonlocal done
        for start in range(0, len(rows), _SLICE):
            slice_of = rows[start : start + _SLICE].tolist()
            for number, row in enumerate(slice_of, first + start):
                add_one(row, number)
            done += len(slice_of)
            if breathe:
                breathe(done / work)

    add(result.nodes, lambda point, number: mesh.addNode(*point, number), 1)
    add(cells, mesh.addVolume, 1)
    add(quads, mesh.addFace, 1 + len(cells))
    add(segments, mesh.addEdge, 1 + len(cells) + len(quads))
    offsets = {"hexes": 1, "quads": 1 + len(cells), "segments": 1 + len(cells) + len(quads), "nodes": 1}
    kinds = {"quads": "Face", "segments": "Edge", "hexes": "Volume", "nodes": "Node"}
    for name, parts in result.groups.items():
        kind, what = next((kind, what) for what, kind in kinds.items() if what in parts)
        add_group(mesh, name, kind, (parts[what] + offsets[what]).tolist())
    if breathe:
        breathe(1.0)
    return mesh


def add_group(mesh, name, kind, elements):
    """Adds a group of `kind` Node, Edge, Face or Volume."""
    if elements:
        with compat.quiet():
            mesh.addGroupElements(mesh.addGroup(name, kind), elements)


def add_constraint_groups(mesh, result, part, analysis, groups_are_asked):
    """Adds groups with the names of constraints and materials, by which FreeCAD finds what its search does not; returns warnings, one line each.

    A group `<Constraint>_Nodes` is for a FreeCAD whose writers do not ask our other groups (`groups_are_asked`, see load_sets), such as one without this
    workbench. It replaces the search for that constraint, also after its references were changed; so it is written only where the search (1e-7 mm) misses
    nodes, as it does on curved edges that second order had to leave straight. `<Material>_Volumes`, where there are several materials, is for every FreeCAD.
    """
    warnings, node_groups, materials = [], [], []
    whole = shapes.numbered_shape(part)
    lost = {name for kind in result.report["cad"].values() for name in kind["lost"] + kind["ignored"]}
    for member in analysis.Group:
        kind = getattr(getattr(member, "Proxy", None), "Type", "") or member.TypeId
        what = _TETRAHEDRA_ONLY.get(kind) or _TETRAHEDRA_ONLY.get(member.TypeId)
        if what and not groups_are_asked:
            warnings.append(tr("{}: FreeCAD cannot apply {} to hexahedra").format(member.Label, tr(what)))
        writer = special_kind(member)
        if writer and not importlib.util.find_spec("femsolver.calculix.write_constraint_" + writer):
            warnings.append(tr("{}: this FreeCAD's own run of CalculiX leaves it out, polycube.solve does not").format(member.Label))
        if kind in ("Fem::MaterialCommon", "Fem::Material"):
            materials.append(member)
        elif member.isDerivedFrom("Fem::Constraint"):
            references = _references(member, part)
            warnings += [tr("{}: the mesh does not capture {}").format(member.Label, name) for name in references if name in lost]
            references = [name for name in references if name in result.groups and not name.startswith("Solid")]
            nodes = sorted({int(node) + 1 for name in references for node in result.groups[name]["nodes"]})
            if references and set(nodes) - _found(mesh, whole, references):
                node_groups.append((member.Name + "_Nodes", nodes))
            for load_kind, load in _FACE_LOADS.items():
                if member.isDerivedFrom(load_kind) and not groups_are_asked:
                    warnings += _lost_load(mesh, result, member, whole, references, load)
    # FreeCAD takes the first group whose name starts with the constraint's name and "_": the shorter name has to come first.
    for name, nodes in sorted(node_groups, key=lambda group: (len(group[0]), group[0])):
        add_group(mesh, name, "Node", nodes)
    if len(materials) > 1:
        referred = {material.Name: {number for obj, names in material.References for number in solids_of(part, obj, names)} for material in materials}
        rest = set(result.hex_solid.tolist()).difference(*referred.values())
        for material in sorted(materials, key=lambda member: (len(member.Name), member.Name)):
            # One that refers to nothing is that of all others.
            solids = referred[material.Name] if material.References else rest
            add_group(mesh, material.Name + "_Volumes", "Volume", [cell for cell, solid in enumerate(result.hex_solid.tolist(), 1) if solid in solids])
    return warnings


def special_kind(member):
    """The kind of a constraint that special_loads writes, None of others."""
    return _SPECIAL.get(getattr(getattr(member, "Proxy", None), "Type", "")) or _SPECIAL.get(member.TypeId)


def solids_of(part, obj, names):
    """Numbers of the solids that references of a material mean; all for the part itself, which may be a container."""
    if obj == part and not hasattr(obj, "Shape"):
        return range(1, len(shapes.numbered_shape(part).Solids) + 1)
    return shapes.solids_in(part, obj, names)


def _lost_load(mesh, result, member, whole, references, load):
    """FreeCAD finds the mesh faces that carry a load by geometry alone, groups do not help it."""
    for name in references:
        if name.startswith("Face"):
            found, there = len(mesh.getFacesByFace(whole.getElement(name))), len(result.groups[name]["quads"])
            if found < there:
                share = tr("part of the {} gets lost") if found else tr("all of the {} gets lost")
                yield tr("{}: FreeCAD finds {} of the {} mesh faces on {}, {}").format(member.Label, found, there, name, share.format(tr(load)))


def _references(member, part):
    """Names, as the mesh has them, of the part's entities that a constraint refers to."""
    return [name for obj, names in getattr(member, "References", []) for name in shapes.names_in(part, obj, names)]


def exists(shape, name):
    """Whether the shape has the entity, Face3 or the like."""
    kind = name.rstrip("0123456789")
    return 1 <= int(name[len(kind) :] or 0) <= len(shapes.entities(shape, kind))


def constrained_faces(part, analysis):
    """Names of the part's faces that carry constraints of the analysis, or have an edge or vertex that does; no mesh may do without them."""
    inside = shapes.solid_objects(part)
    if not analysis or not inside or not all(getattr(member, "Shape", None) for member in inside):
        return []
    shape = shapes.numbered_shape(part)
    faces = shape.Faces
    found = set()
    for member in analysis.Group:
        if not member.isDerivedFrom("Fem::Constraint"):
            continue
        for name in _references(member, part):
            if not exists(shape, name):
                continue
            if name.startswith("Face"):
                found.add(int(name[4:]))
            elif not name.startswith("Solid"):
                around = shape.ancestorsOfType(shape.getElement(name), type(faces[0]))
                found.update(number for number, face in enumerate(faces, 1) if any(face.isSame(other) for other in around))
    return ["Face{}".format(number) for number in sorted(found)]


def _found(mesh, whole, references):
    """Node numbers that FreeCAD's search finds on these entities: it looks where they are in their container, not where that stands."""
    search = {"Face": mesh.getNodesByFace, "Edge": mesh.getNodesByEdge, "Vertex": mesh.getNodesByVertex}
    return {node for name in references for node in search[name.rstrip("0123456789")](whole.getElement(name))}
