"""The compiled module by itself, in plain Python."""

import math
import pathlib
import pickle
import unittest

import numpy as np
from support import VECTOR, FolderTest, box, chamfered, cylinder, plate

import _polycube

CORNER_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]


class Options(unittest.TestCase):
    def test_table_is_complete(self):
        table = {option["name"]: option for option in _polycube.options()}
        self.assertLessEqual({"size", "hexes", "coarsest", "order", "time_limit", "element_type", "labels", "threads"}, set(table))
        for option in table.values():
            self.assertEqual(set(option), {"name", "unit", "meaning", "type", "default", "min", "max", "choices", "advanced"})
            self.assertIn(option["type"], ("double", "int", "bool", "string", "labels", "frame", "divisions", "sizes", "bias", "faces", "refine"))
        self.assertEqual(table["order"]["default"], 2)

    def test_bad_options_are_named(self):
        text = box().exportBrepToString()
        for bad in ({"size": 0}, {"size": -1}, {"size": math.nan}, {"size": math.inf}, {"size": 1e9}, {"size": "x"}, {"hexes": 2.5}, {"order": 3},
                    {"element_type": "C3D10"}, {"labels": {"Face1": "up"}}, {"labels": {7: "+X"}}, {"time_limit": -1}, {"threads": -1}):
            with self.subTest(bad), self.assertRaises(_polycube.InvalidInput) as caught:
                _polycube.mesh(brep=text, **bad)
            self.assertNotIn("\n", str(caught.exception))
            name = next(iter(bad))
            flag = "--label:" if name == "labels" else "--" + name.replace("_", "-")  # --label is given once for every face
            self.assertIn(flag, str(caught.exception))
        for bad in ({"colour": 1}, {}):
            with self.subTest(bad), self.assertRaises(ValueError):
                _polycube.mesh(path="a.step", brep=text, **bad)

    def test_faces_to_keep_by_name_or_number(self):
        for faces in (["Face3", "Face1"], [1, 3], "Face1,Face3"):
            mesh = _polycube.mesh(brep=box().exportBrepToString(), size=2, feature_angle=5, keep_faces=faces)
            self.assertEqual(mesh.report["options"]["keep_faces"], "Face1,Face3")

    def test_none_is_the_default(self):
        mesh = _polycube.mesh(brep=box().exportBrepToString(), size=2, order=None, labels=None)
        self.assertEqual(mesh.order, 2)


class Mesh(FolderTest):
    def test_arrays_of_a_box(self):
        mesh = _polycube.mesh(brep=box().exportBrepToString(), size=1, order=1, min_layers=1)
        self.assertEqual(mesh.hexes.shape, (32, 8))
        self.assertEqual(mesh.nodes.shape, (9 * 3 * 3, 3))
        self.assertEqual(mesh.quads.shape, (8 + 64, 4))
        self.assertEqual(mesh.report["counts"]["hexes"], 32)
        for measure, best in (("scaled_jacobian", 1), ("edge_ratio", 1), ("skew", 0), ("warpage", 0)):
            np.testing.assert_allclose(getattr(mesh, measure), best, atol=1e-9)
        self.assertEqual({name for name in mesh.groups if name.startswith("Face")}, {f"Face{i}" for i in range(1, 7)})
        for i, face in enumerate(box().Faces, 1):
            nodes = mesh.nodes[mesh.groups[f"Face{i}"]["nodes"]]
            bounds = face.BoundBox
            np.testing.assert_allclose(nodes.min(axis=0), (bounds.XMin, bounds.YMin, bounds.ZMin), atol=1e-6)
            np.testing.assert_allclose(nodes.max(axis=0), (bounds.XMax, bounds.YMax, bounds.ZMax), atol=1e-6)

    def test_second_order_nodes_are_on_the_cylinder(self):
        mesh = _polycube.mesh(brep=cylinder().exportBrepToString(), size=2.5, order=2)
        self.assertEqual(mesh.hexes.shape[1], 20)
        wall = [f"Face{i}" for i, face in enumerate(cylinder().Faces, 1) if face.Surface.TypeId == "Part::GeomCylinder"]
        nodes = mesh.nodes[mesh.groups[wall[0]]["nodes"]]
        np.testing.assert_allclose(np.hypot(nodes[:, 0], nodes[:, 1]), 5, atol=1e-7)
        inner = np.setdiff1d(np.arange(len(mesh.nodes)), mesh.quads)
        middles = {int(row[8 + k]): (row[a], row[b]) for row in mesh.hexes for k, (a, b) in enumerate(CORNER_EDGES)}
        for node in inner:
            if int(node) in middles:
                a, b = middles[int(node)]
                np.testing.assert_allclose(mesh.nodes[node], (mesh.nodes[a] + mesh.nodes[b]) / 2, atol=1e-12)

    def test_quads_know_their_cells(self):
        mesh = _polycube.mesh(brep=plate().exportBrepToString(), size=3, order=1)
        faces = np.array([[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]])
        for quad, (cell, side) in zip(mesh.quads, mesh.quad_hex):
            self.assertEqual(set(quad), set(mesh.hexes[cell][faces[side]]))
        p = mesh.nodes[mesh.quads]
        areas = np.linalg.norm(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]), axis=1) / 2
        for i, face in enumerate(plate().Faces, 1):
            self.assertAlmostEqual(areas[mesh.quad_face == i].sum() / face.Area, 1, delta=0.03)

    def test_same_mesh_at_any_thread_count(self):
        text = plate().exportBrepToString()
        one, two = (_polycube.mesh(brep=text, size=3, threads=n) for n in (1, 2))
        np.testing.assert_array_equal(one.nodes, two.nodes)
        np.testing.assert_array_equal(one.hexes, two.hexes)

    def test_dict_survives_pickling(self):
        mesh = _polycube.mesh(brep=box().exportBrepToString(), size=2)
        again = pickle.loads(pickle.dumps(mesh.to_dict()))
        np.testing.assert_array_equal(again["nodes"], mesh.nodes)
        self.assertEqual(again["report"]["version"], _polycube.__version__)
        self.assertEqual(set(again), {"order", "nodes", "hexes", "quads", "quad_face", "quad_hex", "segments", "segment_edge", "groups", "scaled_jacobian", "edge_ratio", "skew", "warpage", "report", "hex_block", "hex_solid"})

    def test_smesh_order_mirrors(self):
        mesh = _polycube.mesh(brep=box().exportBrepToString(), size=2)
        x = mesh.nodes[mesh.hexes[0][_polycube.SMESH_HEX20]]
        self.assertLess(np.dot(np.cross(x[1] - x[0], x[3] - x[0]), x[4] - x[0]), 0)
        for k, (a, b) in enumerate(CORNER_EDGES):
            np.testing.assert_allclose(x[8 + k], (x[a] + x[b]) / 2, atol=1e-12)
        np.testing.assert_array_equal(_polycube.SMESH_HEX8, _polycube.SMESH_HEX20[:8])

    def test_bad_shapes(self):
        with open(self.path("text.step"), "w") as file:
            file.write("not a step file\n")
        for path in (self.path("text.step"), self.path("missing.step")):
            with self.subTest(path), self.assertRaises(_polycube.InvalidInput):
                _polycube.mesh(path=path)
        for text in ("", "nonsense", box().Faces[0].exportBrepToString()):
            with self.subTest(text[:10]), self.assertRaises(_polycube.InvalidInput):
                _polycube.mesh(brep=text)


class Paths(FolderTest):
    def test_paths_are_text_or_path_objects(self):
        part = pathlib.Path(self.save(box()))
        mesh = _polycube.mesh(path=part, size=2, order=1)
        np.testing.assert_array_equal(mesh.nodes, _polycube.mesh(path=str(part), size=2, order=1).nodes)
        for suffix in (".inp", ".INP"):
            mesh.write(part.with_suffix(suffix))
            self.assertTrue(part.with_suffix(suffix).exists())
        for refused in (pathlib.Path(self.path("missing.step")), pathlib.Path()):
            with self.subTest(refused), self.assertRaises(_polycube.InvalidInput):
                _polycube.mesh(path=refused)


class Sessions(unittest.TestCase):
    def setUp(self):
        self.session = _polycube.prepare(brep=box().exportBrepToString(), order=1, size=1)

    def test_sizes_share_the_map(self):
        fine, coarse = self.session.mesh(), self.session.mesh(size=2)
        self.assertGreater(len(fine.hexes), len(coarse.hexes))
        for mesh in (fine, coarse):
            self.assertEqual(mesh.order, 1)
            self.assertFalse({"read", "tet", "deform", "blocks"} & {stage["name"] for stage in mesh.report["stages"]})
        again = self.session.mesh(size=1)
        np.testing.assert_array_equal(again.nodes, fine.nodes)
        few = self.session.mesh(hexes=50)
        self.assertLess(len(few.hexes), len(fine.hexes))
        self.assertEqual([line for line in few.report["warnings"] if "asked for" in line], [])
        # Less than the layers that a wall has to have.
        told = "{} hexahedra where 1 were asked for"
        for mesh in (self.session.mesh(hexes=1), _polycube.mesh(brep=box().exportBrepToString(), hexes=1)):
            self.assertIn(told.format(len(mesh.hexes)), mesh.report["warnings"])
        self.assertEqual(self.session.mesh(order=2).order, 2)

    def test_errors_leave_it_usable(self):
        with self.assertRaises(_polycube.InvalidInput):
            self.session.mesh(divisions={"Edge99": "3"})
        with self.assertRaises(_polycube.Cancelled):
            self.session.mesh(size=0.5, cancel=lambda: True)
        self.assertGreater(len(self.session.mesh().hexes), 0)
        with self.assertRaises(_polycube.InvalidInput):
            _polycube.prepare(brep="nonsense")


class Callbacks(unittest.TestCase):
    text = cylinder().exportBrepToString()

    def test_progress_names_every_stage_in_order(self):
        seen = []
        _polycube.mesh(brep=self.text, size=2.5, progress=lambda stage, fraction: seen.append((stage, fraction)))
        order = ["tet", "label", "deform", "blocks", "quantize", "hex", "pad", "fit", "fem"]
        first = [next(i for i, (stage, _) in enumerate(seen) if stage == name) for name in order]
        self.assertEqual(first, sorted(first))
        self.assertTrue(all(0 <= fraction <= 1 for _, fraction in seen))

    def test_log_gets_lines(self):
        lines = []
        _polycube.mesh(brep=self.text, size=2.5, log=lines.append)
        self.assertGreater(len(lines), 3)
        self.assertFalse([line for line in lines if "\n" in line])

    def test_cancel(self):
        with self.assertRaises(_polycube.Cancelled):
            _polycube.mesh(brep=self.text, cancel=lambda: True)

    def test_time_limit(self):
        with self.assertRaises(_polycube.Cancelled):
            _polycube.mesh(brep=self.text, time_limit=0.01)

    def test_exceptions_come_through(self):
        def fail(*_):
            raise KeyError("mine")

        for callback in ("progress", "log", "cancel"):
            with self.subTest(callback), self.assertRaises(KeyError):
                _polycube.mesh(brep=self.text, **{callback: fail})


class Labels(unittest.TestCase):
    def test_box_faces_get_six_labels(self):
        labels = _polycube.labels(brep=box().exportBrepToString())
        self.assertEqual(sorted(labels["face_label"].values()), [0, 1, 2, 3, 4, 5])
        self.assertEqual(len(labels["label"]), len(labels["triangles"]))
        np.testing.assert_allclose(labels["frame"] @ labels["frame"].T, np.eye(3), atol=1e-12)
        self.assertTrue(labels["valid"])
        self.assertEqual(labels["chart"].max(), 5)
        self.assertEqual((len(labels["corners"]), len(labels["turning_points"])), (8, 0))
        self.assertEqual(labels["edges"], {edge: ("boundary", "") for edge in range(1, 13)})

    def test_names_and_colours(self):
        self.assertEqual(_polycube.LABEL_NAMES, ["+X", "-X", "+Y", "-Y", "+Z", "-Z"])
        self.assertEqual(len(set(_polycube.LABEL_COLOURS)), 6)

    def test_a_label_given_by_hand(self):
        part = chamfered()
        (chamfer,) = (i for i, face in enumerate(part.Faces, 1) if abs(face.normalAt(0, 0).x) > 0.1 and abs(face.normalAt(0, 0).z) > 0.1)
        text = part.exportBrepToString()
        for key, axis, label in (("Face{}".format(chamfer), "+X", 0), (chamfer, "+Z", 4)):
            labels = _polycube.labels(brep=text, labels={key: axis})
            self.assertEqual(set(labels["label"][labels["triangle_face"] == chamfer]), {label})
        for call in (_polycube.labels, _polycube.mesh):
            with self.assertRaises(_polycube.InvalidInput) as caught:
                call(brep=text, labels={chamfer: "-X"})
            self.assertRegex(str(caught.exception), "Face{} cannot be -X.*it can be \\+X or \\+Z".format(chamfer))

    def test_frame(self):
        text = box().exportBrepToString()
        for frame in (((0, 2, 0), (-1, 0, 0)), [np.array([0, 1.0, 0]), VECTOR(-3, 0, 0)], "0,1,0/-1,0,0"):
            found = _polycube.labels(brep=text, frame=frame)
            np.testing.assert_allclose(found["frame"], [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], atol=1e-12)
            for face, label in found["face_label"].items():
                normal = found["frame"] @ np.array(box().Faces[face - 1].normalAt(0, 0))
                self.assertAlmostEqual(normal[label // 2] * (1 - 2 * (label % 2)), 1)
        for bad in (((1, 0, 0), (1, 1, 0)), ((1, 0, 0),), ((1, 0), (0, 1)), (1, 0, 0), "x", 5, (("a", 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0)), ((math.nan, 0, 0), (0, 1, 0))):
            with self.subTest(bad), self.assertRaises((_polycube.InvalidInput, ValueError)) as caught:
                _polycube.labels(brep=text, frame=bad)
            self.assertNotIn("\n", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
