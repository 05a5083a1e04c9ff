"""Layers, divisions and local sizes from the command line and from Python."""

import unittest

import meshio
import numpy as np
from support import FolderTest, box

import _polycube


class Demands(FolderTest):
    def levels(self, nodes, axis):
        """Distinct coordinates of the nodes of a mesh of a box."""
        return len(np.unique(np.round(nodes[:, axis], 6)))

    def test_layers_by_command_line(self):
        part = self.save(box())
        run = self.run_program("mesh", part, "-o", self.path("a.vtu"), "--size", "2", "--order", "1", "--min-layers", "3")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual([self.levels(meshio.read(self.path("a.vtu")).points, axis) for axis in range(3)], [5, 4, 4])

    def test_divisions_in_python(self):
        text = box().exportBrepToString()
        for given in ({"Face1-Face2": "5", "Face3-Face4": "..2"}, "Face1-Face2=5,Face3-Face4=..2"):
            mesh = _polycube.mesh(brep=text, size=0.5, order=1, divisions=given)
            self.assertEqual(mesh.report["options"]["divisions"], "Face1-Face2=5,Face3-Face4=..2")
            self.assertEqual([self.levels(mesh.nodes, axis) for axis in range(3)], [6, 3, 5])

    def test_sizes_in_python(self):
        mesh = _polycube.mesh(brep=box().exportBrepToString(), size=2, order=1, sizes={"X": 0.5}, min_layers=2)
        self.assertEqual([self.levels(mesh.nodes, axis) for axis in range(3)], [17, 3, 3])

    def test_contradiction_names_both(self):
        with self.assertRaises(_polycube.InvalidInput) as caught:
            _polycube.mesh(brep=box().exportBrepToString(), divisions={"Face1-Face2": "3"}, min_layers=4)
        self.assertIn("Face1-Face2=3", str(caught.exception))
        self.assertIn("at least 4 elements through every wall", str(caught.exception))

    def test_local_refinement(self):
        text = box().exportBrepToString()
        plain = _polycube.mesh(brep=text, size=1, order=2)
        for given in ({"Face1": 1, "Vertex8": 2}, "Face1=1,Vertex8=2"):
            mesh = _polycube.mesh(brep=text, size=1, order=2, refine=given)
            self.assertEqual(mesh.report["options"]["refine"], "Face1=1,Vertex8=2")
            self.assertEqual(len(mesh.groups["Face1"]["quads"]), 9 * len(plain.groups["Face1"]["quads"]))
            self.assertEqual(set(mesh.groups), set(plain.groups))
            self.assertGreater(mesh.scaled_jacobian.min(), 0.25)
            self.assertAlmostEqual(mesh.report["volume"]["mesh"], mesh.report["volume"]["cad"], 9)
        for flag, complaint in (("Face9=1", "Face9 does not exist"), ("Face1=0", "from 1 to 6"), ("Face1=x", "is not of the form"), ("Solid1=6", "more than the")):
            run = self.run_program("mesh", self.save(box()), "-o", self.path("a.inp"), "--refine", flag)
            self.assertEqual((run.returncode, run.stderr.count("\n")), (1, 1), run.stderr)
            self.assertIn(complaint, run.stderr)

    def test_unknown_face_is_named(self):
        run = self.run_program("mesh", self.save(box()), "-o", self.path("a.vtu"), "--divisions", "Face1-Face9=2")
        self.assertEqual(run.returncode, 1)
        self.assertIn("Face9 does not exist", run.stderr)


if __name__ == "__main__":
    unittest.main()
