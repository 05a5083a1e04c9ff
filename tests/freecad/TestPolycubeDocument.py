"""What meshing does to documents: undo steps, marks, options given anew; the count of cells told beforehand."""

import unittest

import FreeCAD
import Part

from freecad import polycube
from freecad.polycube import api, compat, objects, option_table, prediction


class DocumentTest(unittest.TestCase):
    def setUp(self):
        self.document = self.new_document()
        self.box = self.make_box(self.document)
        self.document.clearUndos()

    def new_document(self):
        document = FreeCAD.newDocument()
        document.UndoMode = 1
        self.addCleanup(lambda name=document.Name: name in FreeCAD.listDocuments() and FreeCAD.closeDocument(name))
        return document

    @staticmethod
    def make_box(document):
        box = document.addObject("Part::Box", "Box")
        box.Length, box.Width, box.Height = 40, 20, 10
        document.recompute()
        return box


class Steps(DocumentTest):
    def test_a_step_is_in_the_meshs_document_only(self):
        for elsewhere in (False, True):
            with self.subTest(elsewhere=elsewhere):
                active = self.new_document() if elsewhere else self.document
                FreeCAD.setActiveDocument(active.Name)
                self.document.clearUndos()
                obj = polycube.create_fem_mesh(self.box, size=10)
                self.assertEqual(list(self.document.UndoNames), ["Hexahedral mesh from shape"])
                self.assertEqual(FreeCAD.ActiveDocument.Name, active.Name)
                if elsewhere:
                    self.assertEqual(list(active.UndoNames), [])
                self.assertIsNone(FreeCAD.getActiveTransaction())
                name = obj.Name
                self.document.undo()
                self.assertIsNone(self.document.getObject(name))

    def test_a_step_that_fails_leaves_none_anywhere(self):
        active = self.new_document()
        with self.assertRaises(ZeroDivisionError), api.transaction(self.document, "Step"):
            self.box.Length = 1 / 0
        for document in (self.document, active):
            self.assertEqual(list(document.UndoNames), [])
        self.assertIsNone(FreeCAD.getActiveTransaction())

    def test_a_mesh_that_was_made_is_not_touched(self):
        """The mark of what is to be recomputed hides the icon of the mesh's state."""
        obj = polycube.create_fem_mesh(self.box, size=10)
        self.assertNotIn("Touched", obj.State)
        polycube.update_fem_mesh(obj)
        self.assertNotIn("Touched", obj.State)
        self.box.Length = 50
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)


class Copies(DocumentTest):
    def test_a_copy_is_a_mesh_of_its_own(self):
        """Alone, with its part and refinements, into another document: cells, groups, options and state are there, and it can be meshed again."""
        obj = polycube.create_fem_mesh(self.box, size=10, order=1)
        polycube.refine(obj, "layers", ["Face1", "Face2"], 6)
        polycube.update_fem_mesh(obj)
        for document, with_what in ((self.document, False), (self.document, True), (self.new_document(), True)):
            with self.subTest(document=document.Name, with_what=with_what):
                made = document.copyObject(obj, with_what)
                copy = next(one for one in (made if isinstance(made, (list, tuple)) else [made]) if objects.is_polycube(one))
                document.recompute()
                self.assertEqual((copy.FemMesh.HexaCount, copy.MeshState, copy.Blocks), (obj.FemMesh.HexaCount, objects.CURRENT, obj.Blocks))
                self.assertEqual(len(copy.FemMesh.Groups), len(obj.FemMesh.Groups))
                self.assertEqual(compat.part_of(copy) == self.box, not with_what)
                self.assertEqual(polycube.update_fem_mesh(copy, size=5).MeshState, objects.CURRENT)
                self.assertGreater(copy.Hexahedra, obj.Hexahedra)
                self.assertEqual(obj.MeshState, objects.CURRENT)


class OptionsAnew(DocumentTest):
    def test_options_of_an_update(self):
        obj = polycube.create_fem_mesh(self.box, size=10, min_layers=2)
        cells = obj.Hexahedra
        polycube.update_fem_mesh(obj, size=5)
        self.assertEqual((obj.CharacteristicLengthMax.Value, obj.MinLayers), (5, 2))
        self.assertGreater(obj.Hexahedra, cells)
        defaults = {option["name"]: option["default"] for option in polycube.options()}
        polycube.update_fem_mesh(obj, size=defaults["size"], hexes=100)
        self.assertEqual(option_table.read(obj), {"hexes": 100, "min_layers": 2})
        self.assertEqual(obj.MeshState, objects.CURRENT)

    def test_local_refinement(self):
        obj = polycube.create_fem_mesh(self.box, size=10, order=1)
        self.assertEqual(obj.Refine, "")

        def groups():
            mesh = obj.FemMesh
            return {(mesh.getGroupName(group), mesh.getGroupElementType(group)): len(mesh.getGroupElements(group)) for group in mesh.Groups}

        coarse = groups()
        polycube.update_fem_mesh(obj, refine={"Face1": 1})
        self.assertEqual(obj.Refine, "Face1=1")
        fine = groups()
        self.assertEqual(set(fine), set(coarse))
        self.assertEqual(fine["Face1", "Face"], 9 * coarse["Face1", "Face"])
        with self.assertRaises(polycube.InvalidInput):
            polycube.update_fem_mesh(obj, refine="Face7=1")
        self.assertEqual(obj.Refine, "Face1=1")

    def test_a_bad_option_changes_nothing(self):
        obj = polycube.create_fem_mesh(self.box, size=10)
        before = obj.MeshedOptions, obj.Report
        for bad in ({"size": 1e6}, {"sizes": "Face3=0,5"}, {"wide": 1}):
            with self.assertRaises(polycube.InvalidInput):
                polycube.update_fem_mesh(obj, **bad)
        self.assertEqual((obj.MeshedOptions, obj.Report, obj.MeshState), (*before, objects.CURRENT))


class Prediction(unittest.TestCase):
    """How many cells there will be, before the labels are known."""

    def test_of_parts_without_local_sizes(self):
        for shape in (Part.makeBox(40, 20, 10), Part.makeBox(60, 40, 20).cut(Part.makeCylinder(8, 20, FreeCAD.Vector(20, 20, 0)))):
            for options in ({"size": 3}, {}, {"hexes": 3000}):
                with self.subTest(volume=shape.Volume, options=options):
                    cells = len(polycube.mesh(shape, order=1, **options).hexes)
                    self.assertAlmostEqual(prediction.predict(shape, options).cells / cells, 1, delta=0.35)

    def test_after_a_first_mesh(self):
        """Cylinders get layers of their own, which their shape does not tell."""
        for shape in (Part.makeCylinder(10, 40), Part.makeCylinder(20, 40).cut(Part.makeCylinder(15, 40)), Part.makeBox(40, 20, 10)):
            first = {"size": shape.BoundBox.DiagonalLength / 25}
            cells = len(polycube.mesh(shape, order=1, **first).hexes)
            for options in ({"size": first["size"] / 1.5}, {"hexes": 4 * cells}, first):
                with self.subTest(volume=shape.Volume, options=options):
                    expected = prediction.predict_again(shape, {"order": 1, **options}, {"order": 1, **first}, cells).cells
                    self.assertAlmostEqual(expected / len(polycube.mesh(shape, order=1, **options).hexes), 1, delta=0.5)

    def test_local_sizes_go_through_the_part(self):
        """A count that surprises is told; it is one for blocks through the whole part, so the mesh has less or as many."""
        shape = Part.makeBox(40, 20, 10)
        for sizes, least in (("Face1=0.5", 3), ("X=0.5", 7), ("Face1=1,Face5=1", 3)):
            with self.subTest(sizes=sizes):
                expected = prediction.predict(shape, {"size": 4, "sizes": sizes})
                cells = len(polycube.mesh(shape, size=4, sizes=sizes, order=1).hexes)
                self.assertGreater(expected.cells, least * expected.plain)
                self.assertGreater(expected.cells, 0.65 * cells)
        self.assertTrue(prediction.predict(shape, {"size": 2, "sizes": "Face1=0.2"}).is_startling())
        self.assertFalse(prediction.predict(shape, {"size": 2, "sizes": "Face1=1"}).is_startling())

    def test_none_of_what_cannot_be_told(self):
        shape = Part.makeBox(40, 20, 10)
        for options in ({"coarsest": True}, {"sizes": "Face3=wide"}, {"sizes": "Face99=1"}, {"sizes": "Face3"}, {"sizes": "Face3=0"}):
            self.assertIsNone(prediction.predict(shape, options), options)
