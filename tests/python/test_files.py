"""Mesh files read back by other programs: meshio and FreeCAD."""

import base64
import unittest
from xml.etree import ElementTree

import meshio
import numpy as np
from support import FolderTest, plate

import _polycube
import Fem


class Meshio(FolderTest):
    def test_arrays_of_a_vtu_are_one_run_of_base64(self):
        """Padding in the middle is an error to some of those who read it."""
        _polycube.mesh(brep=plate().exportBrepToString(), size=4).write(self.path("a.vtu"))
        arrays = [array for array in ElementTree.parse(self.path("a.vtu")).iter("DataArray") if array.get("format") == "binary"]
        self.assertGreater(len(arrays), 5)
        for array in arrays:
            content = base64.b64decode(array.text.strip(), validate=True)
            self.assertEqual(int.from_bytes(content[:8], "little"), len(content) - 8, array.get("Name"))

    def test_vtu(self):
        for order, kind, quad in ((1, "hexahedron", "quad"), (2, "hexahedron20", "quad8")):
            mesh = _polycube.mesh(brep=plate().exportBrepToString(), size=4, order=order)
            mesh.write(self.path("a.vtu"))
            read = meshio.read(self.path("a.vtu"))
            cells = {block.type: block.data for block in read.cells}
            np.testing.assert_array_equal(read.points, mesh.nodes)
            np.testing.assert_array_equal(cells[kind], mesh.hexes)
            np.testing.assert_array_equal(cells[quad], mesh.quads)
            data = dict(zip(cells, read.cell_data["ScaledJacobian"]))
            np.testing.assert_array_equal(data[kind], mesh.scaled_jacobian)
            np.testing.assert_array_equal(dict(zip(cells, read.cell_data["CadFace"]))[quad], mesh.quad_face)

    def test_medit(self):
        mesh = _polycube.mesh(brep=plate().exportBrepToString(), size=4, order=2)
        mesh.write(self.path("a.mesh"))
        read = meshio.read(self.path("a.mesh"))
        cells = {block.type: block.data for block in read.cells}
        np.testing.assert_array_equal(cells["hexahedron"], mesh.hexes[:, :8])
        np.testing.assert_array_equal(cells["quad"], mesh.quads[:, :4])
        self.assertLess(len(read.points), len(mesh.nodes))


class FreeCad(FolderTest):
    """unv and med keep cells, their orientation and the groups."""

    def check(self, suffix, order):
        mesh = _polycube.mesh(brep=plate().exportBrepToString(), size=4, order=order)
        mesh.write(self.path("part" + suffix))
        read = Fem.read(self.path("part" + suffix))
        self.assertEqual(read.NodeCount, len(mesh.nodes))
        self.assertEqual(read.VolumeCount, len(mesh.hexes))
        self.assertEqual(read.FaceCount, len(mesh.quads))
        self.assertEqual(read.EdgeCount, len(mesh.segments))
        points = {i: np.array(p) for i, p in read.Nodes.items()}
        middles = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
        for volume in read.Volumes:
            x = [points[i] for i in read.getElementNodes(volume)]
            self.assertLess(np.dot(np.cross(x[1] - x[0], x[3] - x[0]), x[4] - x[0]), 0)
            if order == 2:
                for k, (a, b) in enumerate(middles):
                    self.assertLess(np.linalg.norm(x[8 + k] - (x[a] + x[b]) / 2), 0.2 * np.linalg.norm(x[a] - x[b]))
        groups = {(read.getGroupName(g), read.getGroupElementType(g)): len(read.getGroupElements(g)) for g in read.Groups}
        for name, group in mesh.groups.items():
            self.assertEqual(groups[name + "_Nodes", "Node"], len(group["nodes"]))
            for key, kind in (("hexes", "Volume"), ("quads", "Face"), ("segments", "Edge")):
                if key in group:
                    self.assertEqual(groups[name, kind], len(group[key]))

    def test_unv(self):
        for order in (1, 2):
            with self.subTest(order=order):
                self.check(".unv", order)

    def test_med(self):
        for order in (1, 2):
            with self.subTest(order=order):
                self.check(".med", order)


if __name__ == "__main__":
    unittest.main()
