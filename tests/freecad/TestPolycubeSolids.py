"""Several solids in one mesh: objects, groups, materials, ties."""

import FreeCAD
import ObjectsFem
import Part
import TestPolycubeSolve as solving
from FreeCAD import Vector

from freecad import polycube
from freecad.polycube import objects, shapes


class Solids(solving.SolveTest):
    """Two bars of 20 x 10 x 10 mm one behind the other along X, in one document."""

    def bars(self, placement=None):
        self.document = FreeCAD.newDocument()
        self.document.UndoMode = 1
        found = []
        for number in range(2):
            box = self.document.addObject("Part::Box", "Bar")
            box.Length, box.Width, box.Height = 20, 10, 10
            box.Placement.Base = Vector(20 * number, 0, 0)
            found.append(box)
        self.document.recompute()
        return found

    def compound(self, parts):
        compound = self.document.addObject("Part::Compound", "Both")
        compound.Links = parts
        self.document.recompute()
        return compound

    def with_materials(self, parts, whole):
        """The analysis, fixed at x = 0, a bar of 210 GPa and one of 70 GPa, neither of which contracts across."""
        analysis = self.analysis(whole, ["Face1"], PoissonRatio="0")
        other = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Aluminium"))[0]
        other.Material = dict(other.Material, Name="Aluminium", YoungsModulus="70000 MPa", PoissonRatio="0")
        other.References = [(parts[1], "Solid1")]
        steel = next(member for member in analysis.Group if member.Name.startswith("Steel"))
        steel.References = [(parts[0], "Solid1")]
        return analysis

    def end(self, shape, x):
        return "Face{}".format(next(n for n, face in enumerate(shape.Faces, 1) if face.CenterOfMass.isEqual(Vector(x, 5, 5), 1e-6)))

    def test_objects_become_a_compound(self):
        parts = self.bars()
        before = len(self.document.Objects)
        obj = polycube.create_fem_mesh(parts, size=5, order=1, min_layers=1, interfaces="separate")
        part = objects.part_of(obj)
        self.assertEqual(part.TypeId, "Part::Compound")
        self.assertEqual(part.Links, parts)
        self.assertEqual(len(self.document.Objects), before + 2)
        self.assertEqual(obj.MeshState, "Up to date")
        self.assertEqual(obj.Interfaces, "separate")
        self.assertEqual(len(self.group(obj.FemMesh, "Solid2")), 16)
        self.assertEqual(len(self.group(obj.FemMesh, "Solid1_Solid2")), 4)
        self.document.undo()
        self.assertEqual(len(self.document.Objects), before)

    def test_common_nodes(self):
        obj = polycube.create_fem_mesh(self.bars(), size=5, order=1, min_layers=1)
        self.assertEqual(obj.NodeCount, 9 * 9)
        self.assertEqual(self.group(obj.FemMesh, "Solid1_Solid2"), self.group(obj.FemMesh, "Solid2_Solid1"))

    def test_what_cannot_conform_is_refused(self):
        """Two of them meet in an edge only."""
        parts = self.bars()
        for size, base in (((20, 10, 10), (40, 10, 0)), ((60, 20, 5), (0, 0, 10))):
            box = self.document.addObject("Part::Box", "Bar")
            box.Length, box.Width, box.Height = size
            box.Placement.Base = Vector(*base)
            parts.append(box)
        self.document.recompute()
        before = len(self.document.Objects)
        with self.assertRaisesRegex(polycube.StageFailed, "separate"):
            polycube.create_fem_mesh(parts, size=5)
        self.assertEqual(len(self.document.Objects), before)

    def test_a_container_with_several_solids(self):
        parts = self.bars()
        container = self.document.addObject("App::Part", "Container")
        container.addObjects(parts)
        container.Placement.Base = Vector(0, 0, 50)
        self.document.recompute()
        obj = polycube.create_fem_mesh(container, size=5, order=1, min_layers=1, interfaces="separate")
        self.assertEqual(objects.part_of(obj), container)
        self.assertAlmostEqual(obj.FemMesh.BoundBox.ZMin, 50)
        self.assertEqual(obj.MeshState, "Up to date")

    def test_names_of_the_members(self):
        parts = self.bars()
        whole = self.compound(parts)
        self.assertEqual(shapes.names_in(whole, parts[1], ["Face1", "Solid1", "Vertex3", "Face9"]), ["Face7", "Solid2", "Vertex11"])
        self.assertEqual(shapes.names_in(whole, whole, ["Face7"]), ["Face7"])
        self.assertEqual(shapes.solids_in(whole, parts[1], ("Solid1",)), [2])
        self.assertEqual(shapes.solids_in(whole, whole, ()), [1, 2])

    def test_materials_and_tie(self):
        """In tension each bar stretches by its own modulus: F l / (E A); constraints on the compound and on its members."""
        parts = self.bars()
        whole = self.compound(parts)
        shape = whole.Shape
        analysis = self.with_materials(parts, whole)
        self.add(analysis, "Force", parts[1], "Face2", Force=1000, Direction=(parts[1], ["Face2"]))
        inside = [n for n, face in enumerate(shape.Faces, 1) if face.CenterOfMass.isEqual(Vector(20, 5, 5), 1e-6)]
        self.assertEqual(len(inside), 2)
        self.add(analysis, "Tie", whole, *("Face{}".format(n) for n in reversed(inside)), Tolerance=0.1)
        polycube.create_fem_mesh(whole, size=5, interfaces="separate", analysis=analysis)
        solution = self.solve(analysis, whole)
        mesh = self.mesh(analysis).FemMesh
        for material, solid in (("Steel", "Solid1"), ("Aluminium", "Solid2")):
            name = next(member.Name for member in analysis.Group if member.Name.startswith(material)) + "_Volumes"
            self.assertEqual(self.group(mesh, name), self.group(mesh, solid))
        moved = self.of_face(solution, analysis, self.end(shape, 40), solution.result.DisplacementVectors)
        expected = 1000 / 100 * (20 / 210000 + 20 / 70000)
        self.assertAlmostEqual(sum(vector.x for vector in moved) / len(moved) / expected, 1, delta=5e-3)

    def test_a_material_without_references_is_that_of_the_rest(self):
        parts = self.bars()
        whole = self.compound(parts)
        analysis = self.with_materials(parts, whole)
        next(member for member in analysis.Group if member.Name.startswith("Steel")).References = []
        obj = polycube.create_fem_mesh(whole, size=5, order=1, min_layers=1, analysis=analysis)
        self.assertEqual(self.group(obj.FemMesh, "Steel_Volumes"), self.group(obj.FemMesh, "Solid1"))
        self.assertEqual(self.group(obj.FemMesh, "Aluminium_Volumes"), self.group(obj.FemMesh, "Solid2"))


class Inputs(solving.SolveTest):
    def test_a_list_of_shapes(self):
        result = polycube.mesh([Part.makeBox(10, 10, 5), Part.makeBox(4, 4, 4, Vector(3, 3, 5))], size=2, order=1, min_layers=1, interfaces="separate")
        self.assertEqual(sorted(set(result.hex_solid.tolist())), [1, 2])
        self.assertEqual(len(result.report["solids"]), 2)
        with self.assertRaises(polycube.InvalidInput):
            polycube.mesh([])

    def test_labels_and_sessions(self):
        parts = [Part.makeBox(10, 10, 5), Part.makeBox(4, 4, 4, Vector(3, 3, 5))]
        labels = polycube.labels(parts, size=2)
        self.assertTrue(labels.valid)
        self.assertEqual(sorted(labels.face_label), list(range(1, 13)))
        with polycube.prepare(parts, size=2, order=1, min_layers=1) as session:
            self.assertEqual(sorted(set(session.mesh().hex_solid.tolist())), [1, 2])

    def test_a_list_of_one(self):
        one, alone = polycube.mesh([Part.makeBox(4, 4, 4)], size=2), polycube.mesh(Part.makeBox(4, 4, 4), size=2)
        self.assertTrue((one.nodes == alone.nodes).all())
