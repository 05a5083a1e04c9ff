"""Documents of FreeCAD 0.20 and 1.0 in the version that runs, and what the versions do differently."""

import os
import shutil
import tempfile
import unittest
from unittest import mock

import FreeCAD

from freecad import polycube
from freecad.polycube import compat, fem_mesh, objects, refinements

DOCUMENTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "documents")


class DocumentTest(unittest.TestCase):
    def open(self, name):
        folder = tempfile.mkdtemp(prefix="polycube-versions-")
        self.addCleanup(shutil.rmtree, folder, True)
        path = shutil.copy(os.path.join(DOCUMENTS, name), folder)
        document = FreeCAD.openDocument(path)
        self.addCleanup(lambda: FreeCAD.closeDocument(document.Name))
        return document

    def knows_meshes_of_1_0(self, document):
        """FreeCAD 0.20 does not know the type of the mesh object and leaves it out."""
        return "Fem::FemMeshShapeBaseObjectPython" in document.supportedTypes()


class Documents(DocumentTest):
    """A box of 10 mm in an analysis with a support on Face1, meshed with size 5 and Face2=+X."""

    def check(self, document):
        obj = next(obj for obj in document.Analysis.Group if objects.is_polycube(obj))
        self.assertEqual(objects.part_of(obj), document.Box)
        self.assertEqual((obj.FemMesh.HexaCount, obj.Hexahedra, obj.ElementOrder), (8, 8, "2nd"))
        self.assertIn("Face1", [obj.FemMesh.getGroupName(group) for group in obj.FemMesh.Groups])
        self.assertEqual(obj.Labels, ["Face2=+X"])
        document.recompute()
        self.assertEqual(obj.MeshState, objects.CURRENT)
        document.Box.Length = 20
        document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        polycube.update_fem_mesh(obj)
        self.assertEqual((obj.MeshState, obj.FemMesh.HexaCount), (objects.CURRENT, 16))
        document.save()

    def test_of_0_20(self):
        self.check(self.open("box-0.20.FCStd"))

    def test_of_1_0(self):
        """What is beside a mesh object that is left out is there."""
        document = self.open("box-1.0.FCStd")
        if self.knows_meshes_of_1_0(document):
            self.check(document)
        else:
            self.assertEqual([obj for obj in document.Objects if objects.is_polycube(obj)], [])
            self.assertEqual(polycube.create_fem_mesh(document.Box, size=5, analysis=document.Analysis).Hexahedra, 8)


class Refined(DocumentTest):
    """A mesh with a refinement of each kind, as documents/make.py makes it."""

    KINDS = ["size", "divisions", "layers", "bore", "bias", "keep", "axis"]
    ASKED = {"divisions": "Edge4=8,Face3-Face5=3,Edge10=16..", "bias": "Edge2=2.0", "keep_faces": "Face3", "labels": {"Face1": "-X"}}

    def check(self, document, mesh):
        self.assertEqual([one.Kind for one in mesh.Refinements], self.KINDS)
        self.assertEqual([one.Fault for one in mesh.Refinements], [""] * len(self.KINDS))
        self.assertEqual([one.Suppressed for one in mesh.Refinements], [True] + [False] * (len(self.KINDS) - 1))
        self.assertEqual(refinements.with_refinements({}, mesh), self.ASKED)
        size, divisions = mesh.Refinements[:2]
        self.assertEqual((size.Size.Value, polycube.set_refinement(divisions, "10").Elements), (2, "10"))
        document.recompute()
        self.assertNotEqual(mesh.MeshState, objects.CURRENT)
        polycube.update_fem_mesh(mesh)
        edge4 = next(group for group in mesh.FemMesh.Groups if mesh.FemMesh.getGroupName(group) == "Edge4" and mesh.FemMesh.getGroupElementType(group) == "Edge")
        self.assertEqual((mesh.MeshState, len(mesh.FemMesh.getGroupElements(edge4))), (objects.CURRENT, 10))
        document.save()

    def check_mesh(self, document):
        document.recompute()
        (mesh,) = objects.meshes_of(document.Plate)
        self.assertEqual(mesh.MeshState, objects.CURRENT)
        self.check(document, mesh)

    def test_of_0_20(self):
        self.check_mesh(self.open("refined-0.20.FCStd"))

    def test_of_1_0(self):
        """Refinements whose mesh object is left out can be given to another."""
        document = self.open("refined-1.0.FCStd")
        if self.knows_meshes_of_1_0(document):
            return self.check_mesh(document)
        kept = [obj for obj in document.Objects if refinements.is_refinement(obj)]
        mesh = polycube.create_fem_mesh(document.Plate, size=8, order=1, only_object=True)
        mesh.Refinements = kept
        document.recompute()
        self.check(document, mesh)


class Compat(unittest.TestCase):
    def test_groups_are_added_without_a_word(self):
        """FreeCAD writes to descriptor 1 from C++, two lines for every group."""
        import Fem

        mesh = Fem.FemMesh()
        mesh.addNode(0, 0, 0, 1)
        with tempfile.TemporaryFile() as file:
            kept = os.dup(1)
            os.dup2(file.fileno(), 1)
            try:
                fem_mesh.add_group(mesh, "Vertex1", "Node", [1])
                os.write(1, b"heard")
            finally:
                os.dup2(kept, 1)
                os.close(kept)
            file.seek(0)
            self.assertEqual(file.read(), b"heard")
        self.assertEqual(mesh.GroupCount, 1)

    def test_forces_in_newtons(self):
        """0.20 has plain numbers; 1.x quantities, of which its writer takes the value, so that it has to be without a unit."""
        Quantity = FreeCAD.Units.Quantity
        self.assertEqual(compat.newtons(mock.Mock(Force=1000.0)), 1000)
        for text in ("1 kN", "1000 N", "1e6 mN"):
            force = compat.newtons(mock.Mock(Force=Quantity(text)))
            self.assertAlmostEqual(force.Value, 1000)
            self.assertEqual(force.Unit, FreeCAD.Units.Unit())

    def test_quiet_ends_with_an_error(self):
        before = os.fstat(1)
        with self.assertRaises(ValueError), compat.quiet():
            raise ValueError
        self.assertTrue(os.path.samestat(os.fstat(1), before))
