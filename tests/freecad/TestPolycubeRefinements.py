"""Refinements as objects: what they ask of the mesh, faults, undo, suppression, documents saved and opened."""

import os
import tempfile
import unittest

import FreeCAD
import Part

from freecad import polycube
from freecad.polycube import objects, option_table, refinements


class RefinementTest(unittest.TestCase):
    """A plate with a bore: Face1 to Face7, two full circles."""

    def setUp(self):
        self.document = FreeCAD.newDocument()
        self.document.UndoMode = 1
        self.addCleanup(lambda: self.document.Name in FreeCAD.listDocuments() and FreeCAD.closeDocument(self.document.Name))
        self.plate = self.document.addObject("Part::Feature", "Plate")
        self.plate.Shape = Part.makeBox(60, 40, 10).cut(Part.makeCylinder(8, 10, FreeCAD.Vector(25, 20, 0)))
        self.document.recompute()
        self.mesh = polycube.create_fem_mesh(self.plate, size=8, order=1)
        self.document.clearUndos()

    def named(self, kind, test):
        """The name of the first face or edge for which `test` holds."""
        return next("{}{}".format(kind, number) for number, one in enumerate(getattr(self.plate.Shape, kind + "s"), 1) if test(one))

    @property
    def bore(self):
        return self.named("Face", lambda face: face.Surface.TypeId == "Part::GeomCylinder")

    @property
    def bottom_and_top(self):
        return [self.named("Face", lambda face, z=z: face.BoundBox.ZLength < 1e-6 and abs(face.BoundBox.ZMin - z) < 1e-6) for z in (0, 10)]

    def group(self, name, what):
        mesh = self.mesh.FemMesh
        return next(len(mesh.getGroupElements(group)) for group in mesh.Groups if mesh.getGroupName(group) == name and mesh.getGroupElementType(group) == what)


class Demands(RefinementTest):
    def test_each_kind_reaches_the_mesh(self):
        edge = self.named("Edge", lambda edge: edge.BoundBox.XLength > 59)
        circles = [name for name in ("Edge{}".format(i) for i in range(1, 16)) if len(self.plate.Shape.getElement(name).Vertexes) == 1]
        polycube.refine(self.mesh, "divisions", [edge], 13)
        polycube.refine(self.mesh, "layers", self.bottom_and_top, "4")
        polycube.refine(self.mesh, "bore", [self.bore], "20")
        self.assertEqual(self.mesh.MeshState, objects.OUTDATED)
        polycube.update_fem_mesh(self.mesh)
        self.assertEqual(self.mesh.MeshState, objects.CURRENT)
        self.assertEqual(self.group(edge, "Edge"), 13)
        self.assertEqual({self.group(circle, "Edge") for circle in circles}, {20})
        self.assertEqual(self.group(self.bore, "Face"), 80)

    def test_a_local_size(self):
        before = self.mesh.Hexahedra
        polycube.refine(self.mesh, "size", [int(self.bore[4:])], "2 mm")
        polycube.update_fem_mesh(self.mesh)
        self.assertGreater(self.mesh.Hexahedra, before)

    def test_local_refinement(self):
        """Of the elements at a place, and no others; the bounds hold in a document that is opened again too."""
        before = self.mesh.Hexahedra
        quads = self.group("Face1", "Face")
        obj = polycube.refine(self.mesh, "levels", ["Face1", "Vertex1"], 1)
        self.assertEqual(refinements.with_refinements({"refine": "Edge3=1"}, self.mesh), {"refine": "Edge3=1,Face1=1,Vertex1=1"})
        polycube.update_fem_mesh(self.mesh)
        self.assertEqual(self.group("Face1", "Face"), 9 * quads)
        self.assertGreater(self.mesh.Hexahedra, before)
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.document.saveAs(os.path.join(folder, "refined.FCStd"))
        name = obj.Name
        FreeCAD.closeDocument(self.document.Name)
        self.document = FreeCAD.openDocument(os.path.join(folder, "refined.FCStd"))
        obj = self.document.getObject(name)
        self.assertEqual((obj.Levels, obj.Fault, self.document.PolycubeMesh.MeshState), (1, "", objects.CURRENT))
        obj.Levels = 99
        self.assertEqual(obj.Levels, 6)

    def test_sizes_of_edges_and_solids(self):
        """Along an edge as many elements as its length asks for, at least."""
        edge = self.named("Edge", lambda edge: edge.BoundBox.XLength > 59)
        obj = polycube.refine(self.mesh, "size", [edge, "Face1", "Solid1"], 6)
        self.assertEqual(refinements.with_refinements({}, self.mesh), {"sizes": "Face1=6.0,Solid1=6.0", "divisions": edge + "=10.."})
        obj.References = [(self.plate, [edge])]
        polycube.update_fem_mesh(self.mesh)
        self.assertGreaterEqual(self.group(edge, "Edge"), 10)

    def test_as_options(self):
        asked = [("size", ["Face1", "Face2"], 1.5), ("keep", ["Face3"], None), ("axis", ["Face1"], "-X"), ("layers", ["Face1", "Face2"], "3.."), ("bias", ["Edge2"], 3)]
        made = [polycube.refine(self.mesh, *one) for one in asked]
        options = refinements.with_refinements({"sizes": "X=2", "labels": {"Face2": "+X"}, "size": 5}, self.mesh)
        wanted = {"sizes": "X=2,Face1=1.5,Face2=1.5", "keep_faces": "Face3", "labels": {"Face2": "+X", "Face1": "-X"}, "divisions": "Face1-Face2=3..", "bias": "Edge2=3.0"}
        self.assertEqual(options, {"size": 5, **wanted})
        self.assertEqual([refinements.value_of(obj) for obj in made[1:]], ["", "-X", "3..", "3.0"])
        for obj in made:
            polycube.set_refinement(obj, suppressed=True)
        self.assertEqual(refinements.with_refinements({"size": 5}, self.mesh), {"size": 5})

    def test_changes_make_the_mesh_out_of_date_and_back(self):
        obj = polycube.refine(self.mesh, "layers", self.bottom_and_top, 2)
        polycube.update_fem_mesh(self.mesh)
        for changes in ({"value": 3}, {"suppressed": True}):
            polycube.set_refinement(obj, **changes)
            self.assertEqual(self.mesh.MeshState, objects.OUTDATED)
            self.document.undo()
            self.document.recompute()
            self.assertEqual(self.mesh.MeshState, objects.CURRENT, changes)
        self.document.removeObject(obj.Name)
        self.assertEqual(self.mesh.MeshState, objects.OUTDATED)
        self.assertEqual(self.mesh.Refinements, [])


class Faults(RefinementTest):
    def test_what_cannot_be_is_refused_and_changes_nothing(self):
        objects_before = self.document.Objects
        for kind, places, value, message in (
            ("size", ["Face99"], 1, "Plate has no Face99 any more"),
            ("size", ["Vertex1"], 1, "Vertex1 is no face, edge or solid"),
            ("keep", ["Edge1"], None, "Edge1 is no face"),
            ("levels", ["Face1"], 0, "'0' is not a whole number from 1 to 6"),
            ("levels", ["Face1"], 7, "not a whole number"),
            ("levels", ["Face1"], 1.5, "not a whole number"),
            ("levels", ["Face1"], "many", "not a whole number"),
            ("levels", ["Vertex99"], 1, "Plate has no Vertex99 any more"),
            ("size", [], 1, "no face, edge or solid is chosen"),
            ("size", ["Face1"], "5 kg", "not a length"),
            ("size", ["Face1"], "wide", "not a length"),
            ("size", ["Face1"], -1, "greater than 0"),
            ("layers", ["Face1"], 3, "2 faces are needed, not 1"),
            ("divisions", ["Edge1"], "0", "not a number of elements"),
            ("divisions", ["Edge1"], "..", "not a number of elements"),
            ("divisions", ["Edge1"], "3,5", "not a number of elements"),
            ("bore", ["Face1"], 8, "Face1 has no full circle"),
            ("axis", ["Face1"], "up", "is not one of"),
            ("bias", ["Edge1"], 0, "is not a ratio"),
            ("bias", ["Edge1"], "wide", "is not a ratio"),
            ("colour", ["Face1"], "red", "there is no refinement 'colour'"),
        ):
            with self.subTest(kind=kind, places=places, value=value):
                with self.assertRaises(polycube.InvalidInput) as caught:
                    polycube.refine(self.mesh, kind, places, value)
                self.assertIn(message, str(caught.exception))
                self.assertNotIn("\n", str(caught.exception))
                self.assertEqual(self.document.Objects, objects_before)
                self.assertEqual(list(self.document.UndoNames), [])

    def test_a_place_that_goes_is_told_and_refused(self):
        obj = polycube.refine(self.mesh, "bore", [self.bore], 16)
        name = self.bore
        self.plate.Shape = Part.makeBox(60, 40, 10)
        self.document.recompute()
        self.assertIn(name, obj.Fault)
        self.assertEqual(obj.Label2, obj.Fault)
        with self.assertRaises(polycube.InvalidInput) as caught:
            polycube.update_fem_mesh(self.mesh)
        self.assertTrue(str(caught.exception).startswith(obj.Label + ": "))
        polycube.set_refinement(obj, suppressed=True)
        polycube.update_fem_mesh(self.mesh)
        self.assertEqual(self.mesh.MeshState, objects.CURRENT)

    def test_before_the_first_mesh(self):
        mesh = polycube.create_fem_mesh(self.plate, size=8, order=1, only_object=True)
        self.assertEqual(mesh.MeshState, objects.EMPTY)
        self.assertEqual(option_table.read(mesh), {"size": 8, "order": 1})
        polycube.refine(mesh, "layers", self.bottom_and_top, 5)
        polycube.update_fem_mesh(mesh)
        self.assertEqual(mesh.Hexahedra % 5, 0)
        self.assertEqual(mesh.MeshState, objects.CURRENT)


class Saved(RefinementTest):
    def test_undo_and_redo(self):
        obj = polycube.refine(self.mesh, "size", ["Face1"], 2)
        name = obj.Name
        self.assertEqual(list(self.document.UndoNames), ["Refinement"])
        self.document.undo()
        self.assertIsNone(self.document.getObject(name))
        self.assertEqual((self.mesh.Refinements, self.mesh.MeshState), ([], objects.CURRENT))
        self.document.redo()
        self.assertEqual([one.Name for one in self.mesh.Refinements], [name])
        self.assertEqual(self.mesh.MeshState, objects.OUTDATED)

    def test_saved_opened_and_copied(self):
        polycube.refine(self.mesh, "size", ["Face1"], 2)
        off = polycube.refine(self.mesh, "bore", [self.bore], "16..")
        polycube.set_refinement(off, suppressed=True)
        polycube.update_fem_mesh(self.mesh)
        folder = self.enterContext(tempfile.TemporaryDirectory())
        path = os.path.join(folder, "refined.FCStd")
        self.document.saveAs(path)
        asked = refinements.with_refinements({}, self.mesh)
        FreeCAD.closeDocument(self.document.Name)
        self.document = FreeCAD.openDocument(path)
        mesh = self.document.PolycubeMesh
        self.document.recompute()
        self.assertEqual(mesh.MeshState, objects.CURRENT)
        self.assertEqual(refinements.with_refinements({}, mesh), asked)
        first, second = mesh.Refinements
        self.assertEqual((first.Size.Value, second.Elements, second.Suppressed, second.Fault), (2, "16..", True, ""))
        self.assertIs(refinements.mesh_of(first), mesh)
        copy = self.document.copyObject(mesh, True)
        copy = next(obj for obj in (copy if isinstance(copy, (list, tuple)) else [copy]) if objects.is_polycube(obj))
        self.assertEqual(len(copy.Refinements), 2)
        self.assertNotEqual(copy.Refinements[0].Name, first.Name)
