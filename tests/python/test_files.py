"""Mesh files read back by other programs: meshio, FreeCAD and CalculiX."""

import re
import subprocess
import unittest

import meshio
import numpy as np
from support import FolderTest, box, ccx, needs_calculix, plate

import _polycube
import Fem

STEEL = 210000.0


class Meshio(FolderTest):
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


@needs_calculix
class CalculiX(FolderTest):
    """A bar of 8 x 2 x 2 under tension and a cantilever, by the sets and surfaces of the .inp."""

    def solve(self, element_type, load):
        mesh = _polycube.mesh(brep=box().exportBrepToString(), size=0.5, element_type=element_type)
        mesh.write(self.path("mesh.inp"))
        deck = f"""*INCLUDE, INPUT=mesh.inp
*MATERIAL, NAME=STEEL
*ELASTIC
{STEEL}, 0.0
*SOLID SECTION, ELSET=Solid1, MATERIAL=STEEL
*BOUNDARY
Face1, 1, 3
*STEP
*STATIC
{load(mesh)}
*NODE PRINT, NSET=Face2
U
*NODE PRINT, NSET=Face1, TOTALS=ONLY
RF
*END STEP
"""
        with open(self.path("job.inp"), "w") as file:
            file.write(deck)
        run = subprocess.run([ccx.find(), "job"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertNotIn("*ERROR", run.stdout)
        with open(self.path("job.dat")) as file:
            text = file.read()
        table, totals = text.split("total force")
        rows = [line.split() for line in table.splitlines() if re.match(r"\s+\d+\s", line)]
        force = [float(x) for x in totals.split("\n")[2].split()]
        return np.array([[float(x) for x in row[1:4]] for row in rows]).mean(axis=0), force

    def test_tension_is_exact(self):
        for element_type in ("C3D8", "C3D8I", "C3D8R", "C3D20", "C3D20R"):
            with self.subTest(element_type):
                # Face2 of FreeCAD's box is the side x = 8; a pressure of -100 pulls with 400 N.
                u, force = self.solve(element_type, lambda _: "*DLOAD\n" + self.pressure(-100))
                self.assertAlmostEqual(u[0], 100 / STEEL * 8, delta=1e-7)
                self.assertAlmostEqual(force[0], -400, delta=0.1)

    def pressure(self, value):
        # CalculiX' *DLOAD wants elements and faces: those of the surface.
        with open(self.path("mesh.inp")) as file:
            rows = re.search(r"\*SURFACE, NAME=Face2_Surface, TYPE=ELEMENT\n((?:\d.*\n)+)", file.read())
        return "".join("{}, P{}, {}\n".format(*row.replace(" ", "").split(",S"), value) for row in rows.group(1).splitlines())

    def test_bending_needs_the_right_element(self):
        beam = 100 * 8**3 / (3 * STEEL * 2**4 / 12)  # 100 N at the tip, without shear
        for element_type, low, high in (("C3D20", 1.0, 1.2), ("C3D20R", 1.0, 1.2), ("C3D8I", 1.0, 1.2)):
            with self.subTest(element_type):
                u, force = self.solve(element_type, lambda mesh: "*CLOAD\nFace2, 3, {}".format(-100 / len(mesh.groups["Face2"]["nodes"])))
                self.assertAlmostEqual(force[2], 100, delta=0.1)
                self.assertGreater(-u[2], low * beam)
                self.assertLess(-u[2], high * beam)


if __name__ == "__main__":
    unittest.main()
