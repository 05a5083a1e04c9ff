"""FreeCAD's own examples and simple loads, solved by CalculiX on our meshes."""

import importlib
import json
import os
import re
import shutil
import sys
import tempfile
import unittest
from unittest import mock

import FreeCAD
import ObjectsFem
import Part
from FreeCAD import Vector

from freecad import polycube
from freecad.polycube import fem_mesh, objects, shapes

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "resources", "examples"))
import bracket  # noqa: E402  (the demo's part)
import calculix  # noqa: E402
import ccx  # noqa: E402

needs_calculix = unittest.skipUnless(ccx.find(), ccx.MISSING)


def nodal_loads(path):
    """Sum of the *CLOAD lines of an input file, (x, y, z)."""
    sums, reading = [0.0, 0.0, 0.0], False
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("*"):
                reading = reading and line.startswith("**") or line.upper().startswith("*CLOAD")
            elif reading and re.match(r"\d+,\d,", line.replace(" ", "")):
                _, axis, value = line.split(",")[:3]
                sums[int(axis) - 1] += float(value)
    return Vector(*sums)


def pressure_faces(path):
    """(element, face number 1 to 6, pressure) of the *DLOAD lines of an input file."""
    found, reading = [], False
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("*"):
                reading = reading and line.startswith("**") or line.upper().startswith("*DLOAD")
            elif reading and re.match(r"\d+,P\d,", line.replace(" ", "")):
                element, face, value = line.replace(" ", "").split(",")[:3]
                found.append((int(element), int(face[1:]), float(value)))
    return found


def total_reaction(path):
    """Sum of the reaction forces that CalculiX printed beside the input file."""
    with open(os.path.splitext(path)[0] + ".dat", encoding="utf-8") as file:
        lines = file.read().splitlines()
    start = next(i for i, line in enumerate(lines) if line.strip().startswith("total force"))
    return Vector(*[float(value) for value in lines[start + 2].split()[:3]])


def quad_area_vector(points):
    """Area vector of an 8-node face (corners, then mid nodes in between): integral of its normal by 3 x 3 Gauss points."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    middles = [(0, -1), (1, 0), (0, 1), (-1, 0)]
    total = Vector()
    gauss = ((-(0.6**0.5), 5 / 9), (0.0, 8 / 9), (0.6**0.5, 5 / 9))
    for r, weight_r in gauss:
        for s, weight_s in gauss:
            along_r, along_s = Vector(), Vector()
            for point, (a, b) in zip(points, corners):
                along_r += point * (0.25 * a * (1 + b * s) * (2 * a * r + b * s))
                along_s += point * (0.25 * b * (1 + a * r) * (2 * b * s + a * r))
            for point, (a, b) in zip(points[4:], middles):
                if a == 0:
                    along_r += point * (-r * (1 + b * s))
                    along_s += point * (0.5 * b * (1 - r * r))
                else:
                    along_r += point * (0.5 * a * (1 - s * s))
                    along_s += point * (-s * (1 + a * r))
            total += along_r.cross(along_s) * (weight_r * weight_s)
    return total


def solver_of(analysis):
    return next(obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemSolverObject"))


class SolverTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="polycube-solver-")
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.addCleanup(self.close_documents, set(FreeCAD.listDocuments()))

    @staticmethod
    def close_documents(others):
        """Those that the test has opened, FreeCAD's examples among them."""
        for name in set(FreeCAD.listDocuments()) - others:
            FreeCAD.closeDocument(name)

    @staticmethod
    def set_mesh(obj, result):
        """Gives the object a mesh of its part that the test may have changed; returns the warnings."""
        return objects.set_mesh(obj, result, {}, shapes.signature(shapes.shape_of(objects.part_of(obj), obj)))


@needs_calculix
class Cantilever(SolverTest):
    def test_faceload(self):
        """FreeCAD's ccx_cantilever_faceload, 8 m long, 9 MN at its end: beam theory with shear gives -87.8 mm."""
        from femexamples import ccx_cantilever_faceload

        self.document = ccx_cantilever_faceload.setup()
        document = self.document
        document.removeObject(document.getObject("Mesh").Name)
        obj = polycube.create_fem_mesh(document.Box, size=500, order=2, analysis=document.Analysis)
        self.assertEqual(objects.analysis_of(obj), document.Analysis)
        document.recompute()
        path, result = calculix.solve(document.Analysis, solver_of(document.Analysis), self.folder)
        self.assertLess((nodal_loads(path) - Vector(0, 0, -9e6)).Length, 1e-4 * 9e6)
        lowest = min(vector.z for vector in result.DisplacementVectors)
        self.assertGreater(lowest, -88.6)
        self.assertLess(lowest, -86.8)
        self.assertLess((total_reaction(path) - Vector(0, 0, 9e6)).Length, 0.005 * 9e6)


@needs_calculix
class FreeCadExamples(SolverTest):
    """Largest displacement against what FreeCAD's own meshes give (mm)."""

    def check(self, module, expected, tolerance, **options):
        self.document = importlib.import_module("femexamples." + module).setup()
        analysis = self.document.Analysis
        theirs = next(obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemMeshObject"))
        part = objects.part_of(theirs)
        self.document.removeObject(theirs.Name)
        polycube.create_fem_mesh(part, analysis=analysis, **options)
        self.document.recompute()
        _, result = calculix.solve(analysis, solver_of(analysis), self.folder)
        self.assertAlmostEqual(max(result.DisplacementLengths) / expected, 1, delta=tolerance)

    def test_prescribed_displacement(self):
        self.check("ccx_cantilever_prescribeddisplacement", 251.09, 0.001, size=500)

    def test_self_weight(self):
        self.check("constraint_selfweight_cantilever", 577.7, 0.005, hexes=400)

    def test_box_under_pressure_and_force(self):
        """Its load ends at clamped corners: a finer mesh is softer, 0.0937 is that of FreeCAD's tetrahedra."""
        self.check("boxanalysis_static", 0.0937, 0.02, size=2)

    def test_two_boxes_in_tension(self):
        """A material for each of two solids."""
        self.check("material_multiple_tensionrod_twoboxes", 0.18363, 0.005, size=3)

    def test_five_boxes_in_bending(self):
        self.check("material_multiple_bendingbeam_fiveboxes", 1.0355, 0.005, size=2)


class CylinderSide(SolverTest):
    RADIUS, HEIGHT = 10.0, 30.0

    def cylinder(self):
        self.document = FreeCAD.newDocument()
        part = self.document.addObject("Part::Cylinder", "Cylinder")
        part.Radius, part.Height = self.RADIUS, self.HEIGHT
        self.document.recompute()
        side = "Face{}".format(1 + [face.Surface.TypeId for face in part.Shape.Faces].index("Part::GeomCylinder"))
        ends = ["Face{}".format(i + 1) for i, face in enumerate(part.Shape.Faces) if face.Surface.TypeId == "Part::GeomPlane"]
        return part, side, ends

    @needs_calculix
    def test_force_arrives_whole(self):
        part, side, ends = self.cylinder()
        analysis, solver = calculix.make_analysis(part, [ends[0]])
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        force.References = [(part, side)]
        calculix.set_quantity(force, "Force", 1000, "N")
        force.Direction = (part, [ends[1]])
        polycube.create_fem_mesh(part, size=4, analysis=analysis)
        self.document.recompute()
        path, result = calculix.solve(analysis, solver, self.folder)
        # The supports' reaction is no measure here: the rim belongs to both faces, its share of the force goes straight into the support.
        self.assertAlmostEqual(nodal_loads(path).Length, 1000, delta=0.01)
        self.assertGreater(max(result.DisplacementLengths), 0)

    def test_pressure_arrives_whole(self):
        part, side, ends = self.cylinder()
        analysis, solver = calculix.make_analysis(part, [ends[0]])
        pressure = analysis.addObject(ObjectsFem.makeConstraintPressure(self.document, "Pressure"))[0]
        pressure.References = [(part, side)]
        calculix.set_quantity(pressure, "Pressure", 5.0, "MPa")
        obj = polycube.create_fem_mesh(part, size=4, analysis=analysis)
        self.document.recompute()
        path = calculix.write(analysis, solver, self.folder).inp_file_name
        faces = pressure_faces(path)
        mesh = obj.FemMesh
        group = next(group for group in mesh.Groups if mesh.getGroupName(group) == side)
        self.assertEqual(len(faces), len(mesh.getGroupElements(group)))
        self.assertEqual(len(set(faces)), len(faces))
        self.assertEqual({value for _, _, value in faces}, {5.0})
        # SMESH's winding of a boundary quad is ours: outward. The loaded area is that of the CAD face.
        area, resultant = 0.0, Vector()
        for quad in mesh.getGroupElements(group):
            vector = quad_area_vector([mesh.getNodeById(node) for node in mesh.getElementNodes(quad)])
            area += vector.Length
            resultant += vector
        self.assertAlmostEqual(area / part.Shape.getElement(side).Area, 1, delta=0.02)
        self.assertLess(resultant.Length, 1e-3 * area)

    @needs_calculix
    def test_pressure_on_an_end_is_carried_by_the_other(self):
        part, _, ends = self.cylinder()
        analysis, solver = calculix.make_analysis(part, [ends[0]])
        pressure = analysis.addObject(ObjectsFem.makeConstraintPressure(self.document, "Pressure"))[0]
        pressure.References = [(part, ends[1])]
        calculix.set_quantity(pressure, "Pressure", 5.0, "MPa")
        polycube.create_fem_mesh(part, size=4, analysis=analysis)
        self.document.recompute()
        path, _ = calculix.solve(analysis, solver, self.folder)
        expected = 5.0 * part.Shape.getElement(ends[1]).Area
        self.assertAlmostEqual(total_reaction(path).Length / expected, 1, delta=0.02)


@needs_calculix
class DemoPart(SolverTest):
    def test_bracket(self):
        self.document = FreeCAD.newDocument()
        part = self.document.addObject("Part::Feature", "Bracket")
        part.Shape = bracket.make_bracket()
        self.assertGreaterEqual(len(part.Shape.Faces), 20)
        named = bracket.faces(part.Shape)
        self.assertEqual({what: len(faces) for what, faces in named.items()}, {"bolts": 2, "loads": 2, "top": 1, "bottom": 1, "back": 1})
        analysis, solver = calculix.make_analysis(part, [named["bottom"][0]])
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Pull"))[0]
        force.References = [(part, name) for name in named["loads"]]
        calculix.set_quantity(force, "Force", 4000, "N")
        force.Direction = (part, named["back"])
        force.Reversed = True
        obj = polycube.create_fem_mesh(part, size=5, analysis=analysis)
        for what in ("faces", "edges", "vertices"):
            captured = json.loads(obj.Report)["cad"][what]
            self.assertEqual(captured["captured"], captured["total"], what)
        self.assertGreater(obj.MinScaledJacobian, 0.3)
        self.document.recompute()
        path, result = calculix.solve(analysis, solver, self.folder)
        self.assertLess((nodal_loads(path) - Vector(0, -4000, 0)).Length, 0.02 * 4000)
        self.assertLess((total_reaction(path) + nodal_loads(path)).Length, 0.005 * 4000)
        # 0.0174 mm at size 4, 0.0176 mm at size 3, with the pressure on the wall's top that is left out here
        self.assertAlmostEqual(max(result.DisplacementLengths), 0.0175, delta=0.0015)


class FeatureAngle(SolverTest):
    """A block with one edge along Z rounded, whose face on the +X side carries a constraint."""

    def setUp(self):
        super().setUp()
        self.document = FreeCAD.newDocument()
        block = Part.makeBox(20, 20, 10)
        self.part = self.document.addObject("Part::Feature", "Block")
        self.part.Shape = block.makeFillet(6, [edge for edge in block.Edges if edge.BoundBox.XMin > 19 and edge.BoundBox.YMin > 19])
        faces = self.part.Shape.Faces
        self.side, self.other = (
            "Face{}".format(next(number for number, face in enumerate(faces, 1) if face.CenterOfMass[axis] > 19.9)) for axis in (0, 1)
        )
        self.rounding = "Face{}".format(next(number for number, face in enumerate(faces, 1) if face.Surface.TypeId == "Part::GeomCylinder"))
        self.analysis, _ = calculix.make_analysis(self.part, [self.side])

    def test_faces_with_constraints_are_kept(self):
        obj = polycube.create_fem_mesh(self.part, size=5, order=1, feature_angle=10, analysis=self.analysis)
        captured = json.loads(obj.Report)["cad"]
        self.assertEqual(set(captured["faces"]["ignored"]), {self.other, self.rounding})
        self.assertEqual((captured["faces"]["lost"], len(captured["edges"]["ignored"])), ([], 1))
        self.assertEqual(obj.KeepFaces, "")
        obj.KeepFaces = self.other
        polycube.update_fem_mesh(obj)
        self.assertEqual(json.loads(obj.Report)["cad"]["faces"]["ignored"], [])
        self.assertEqual(obj.KeepFaces, self.other)

    def test_edges_with_constraints_keep_their_faces(self):
        shape = self.part.Shape
        rim = next(edge for edge in shape.getElement(self.rounding).Edges if any(edge.isSame(other) for other in shape.getElement(self.other).Edges))
        number = next(number for number, edge in enumerate(shape.Edges, 1) if edge.isSame(rim))
        support = next(member for member in self.analysis.Group if member.isDerivedFrom("Fem::ConstraintFixed"))
        support.References = [(self.part, "Edge{}".format(number))]
        self.assertEqual(set(fem_mesh.constrained_faces(self.part, self.analysis)), {self.other, self.rounding})


class Warnings(SolverTest):
    def test_entities_that_the_mesh_does_not_capture(self):
        self.document = FreeCAD.newDocument()
        part = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        analysis, _ = calculix.make_analysis(part, ["Face1"])
        result = polycube.mesh(part, size=5)
        result.report["cad"]["faces"]["lost"] = ["Face1"]
        obj = objects.make(self.document, part)
        analysis.addObject(obj)
        self.assertIn("Support: the mesh does not capture Face1", self.set_mesh(obj, result))

    def test_groups_replace_a_search_that_misses_nodes(self):
        """A mesh whose nodes are 1e-6 mm off the face: FreeCAD's search finds none of them, the group does."""
        self.document = FreeCAD.newDocument()
        part = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        analysis, _ = calculix.make_analysis(part, ["Face1"])
        result = polycube.mesh(part, size=5)
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Push"))[0]
        force.References = [(part, "Face1")]
        result.nodes[result.groups["Face1"]["nodes"]] += (1e-6, 0, 0)
        obj = objects.make(self.document, part)
        analysis.addObject(obj)
        with mock.patch.object(objects, "GROUPS_ARE_ASKED", False):
            warnings = self.set_mesh(obj, result)
        self.assertTrue(any("Push" in line and "force gets lost" in line for line in warnings), warnings)
        names = [obj.FemMesh.getGroupName(group) for group in obj.FemMesh.Groups]
        self.assertIn("Support_Nodes", names)
        group = obj.FemMesh.Groups[names.index("Support_Nodes")]
        self.assertEqual(obj.FemMesh.getGroupElementType(group), "Node")
        self.assertEqual(len(obj.FemMesh.getGroupElements(group)), len(result.groups["Face1"]["nodes"]))
