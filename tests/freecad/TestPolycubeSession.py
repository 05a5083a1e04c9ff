"""polycube.prepare: one part, several meshes, one map."""

import os
import threading
import unittest

import FreeCAD
import numpy as np
import Part

from freecad import polycube


def stages(result):
    return {stage["name"] for stage in result.report["stages"]}


class Sessions(unittest.TestCase):
    def setUp(self):
        plate = Part.makeBox(40, 30, 8).cut(Part.makeCylinder(5, 8, FreeCAD.Vector(20, 15, 0)))
        self.session = polycube.prepare(plate, order=1, size=4)
        self.addCleanup(self.session.close)

    def test_sizes_share_the_map(self):
        first = self.session.mesh()
        self.assertIn("deform", stages(first))
        finer = self.session.mesh(size=FreeCAD.Units.Quantity("3 mm"))
        self.assertFalse({"tet", "deform", "blocks"} & stages(finer))
        self.assertGreater(len(finer.hexes), len(first.hexes))
        refined = self.session.mesh(refine={"Face7": 1})
        self.assertFalse({"tet", "deform", "blocks"} & stages(refined))
        self.assertGreater(len(refined.hexes), len(first.hexes))
        self.assertLess(abs(len(self.session.mesh(hexes=3000).hexes) - 3000), 450)
        np.testing.assert_array_equal(self.session.mesh().nodes, first.nodes)

    def test_errors_leave_it_usable(self):
        with self.assertRaises(polycube.InvalidInput):
            self.session.mesh(divisions={"Edge99": 3})
        with self.assertRaises(polycube.InvalidInput):
            self.session.mesh(colour="red")
        with self.assertRaises(polycube.Cancelled):
            self.session.mesh(size=0.4, cancel=lambda: True)
        with self.assertRaises(polycube.Cancelled):
            self.session.mesh(size=0.4, time_limit=0.1)
        lines = []
        self.assertGreater(len(self.session.mesh(log=lines.append).hexes), 0)
        self.assertTrue(lines)

    def test_another_thread_is_refused(self):
        said = []

        def ask():
            try:
                self.session.mesh()
            except polycube.InvalidInput as error:
                said.append(str(error))

        def progress(*_):
            if not said:
                other = threading.Thread(target=ask)
                other.start()
                other.join(60)

        self.assertGreater(len(self.session.mesh(progress=progress).hexes), 0)
        self.assertEqual(said, ["the session is at work in another thread"])

    def test_labels_and_counts_share_the_tetrahedra(self):
        first = self.session.labels()
        plane = next(face for face in first.face_label if len(first.possible(face)) == 1)
        self.assertTrue(first.valid)
        lines, seen = [], []
        given = self.session.labels(labels={plane: "+X -X +Y -Y +Z -Z".split()[first.face_label[plane]]}, log=lines.append, progress=lambda *step: seen.append(step))
        self.assertNotIn("tet", {stage for stage, _ in seen})
        np.testing.assert_array_equal(given.points, first.points)
        seen.clear()
        told = [self.session.count(progress=lambda *step: seen.append(step), size=size) for size in (4, 3)]
        self.assertNotIn("tet", {stage for stage, _ in seen})
        for size, cells in zip((4, 3), told):
            self.assertAlmostEqual(cells / len(self.session.mesh(size=size).hexes), 1, delta=0.15)
        with self.assertRaises(polycube.InvalidInput):
            self.session.count(divisions={"Edge99": 3})

    def test_nothing_is_left(self):
        with self.session as session:
            session.mesh()
            folder, child = session._job.folder, session._child
            self.assertTrue(os.path.isdir(folder))
        self.assertFalse(os.path.exists(folder))
        self.assertIsNotNone(child.poll())

    def test_no_solid_no_session(self):
        with self.assertRaises(polycube.InvalidInput):
            polycube.prepare(Part.Shape())
        with self.assertRaises(polycube.InvalidInput):
            polycube.prepare(Part.makePlane(10, 10)).mesh()
