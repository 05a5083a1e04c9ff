"""The public API and the document object, without a window."""

import json
import math
import os
import signal
import subprocess
import tempfile
import unittest
from fractions import Fraction
from unittest import mock

import FreeCAD
import numpy
import ObjectsFem
import Part
import stuck
from FreeCAD import Rotation, Vector

from freecad import polycube
from freecad.polycube import api, cells, job, measures, objects, option_table, prediction, shapes


def moved(shape, placement=None, scale=1.0):
    """A copy that was scaled about the origin and then placed."""
    copy = shape.copy()
    copy.scale(scale)
    if placement:
        copy.Placement = placement.multiply(copy.Placement)
    return copy


class DocumentTest(unittest.TestCase):
    def setUp(self):
        self.document = FreeCAD.newDocument()
        self.document.UndoMode = 1
        self.addCleanup(self.close)

    def close(self):
        if self.document.Name in FreeCAD.listDocuments():
            FreeCAD.closeDocument(self.document.Name)

    def box(self, length=40, width=20, height=10):
        box = self.document.addObject("Part::Box", "Box")
        box.Length, box.Width, box.Height = length, width, height
        self.document.recompute()
        return box

    def feature(self, shape, name="Feature"):
        feature = self.document.addObject("Part::Feature", name)
        feature.Shape = shape
        return feature


class MeshArrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = polycube.mesh(Part.makeBox(40, 20, 10), size=5)

    def test_cells_fill_the_box(self):
        result = self.result
        self.assertEqual(result.order, 2)
        self.assertEqual(result.hexes.shape[1], 20)
        self.assertEqual(len(result.scaled_jacobian), len(result.hexes))
        self.assertGreater(result.scaled_jacobian.min(), 0)
        self.assertAlmostEqual(result.report["volume"]["mesh"], 8000, delta=1e-6 * 8000)

    def test_boundary_is_grouped_by_cad_entity(self):
        groups = self.result.groups
        for name in ["Face{}".format(i) for i in range(1, 7)] + ["Edge{}".format(i) for i in range(1, 13)]:
            self.assertIn(name, groups)
        self.assertEqual({len(groups["Vertex{}".format(i)]["nodes"]) for i in range(1, 9)}, {1})
        self.assertEqual(sum(len(groups["Face{}".format(i)]["quads"]) for i in range(1, 7)), len(self.result.quads))

    def test_size_as_a_quantity(self):
        result = polycube.mesh(Part.makeBox(40, 20, 10), size=FreeCAD.Units.Quantity("0.5 cm"))
        self.assertEqual(len(result.hexes), len(self.result.hexes))

    def test_first_order(self):
        result = polycube.mesh(Part.makeBox(40, 20, 10), size=5, order=1, min_layers=2)
        self.assertEqual(result.hexes.shape, (len(self.result.hexes), 8))
        self.assertEqual(result.quads.shape[1], 4)

    def test_target_count(self):
        result = polycube.mesh(Part.makeBox(40, 20, 10), hexes=1000)
        self.assertAlmostEqual(len(result.hexes), 1000, delta=200)

    def test_time_limit(self):
        with self.assertRaises(polycube.Cancelled):
            polycube.mesh(Part.makeBox(40, 20, 10), size=0.5, time_limit=0.2)

    def test_a_mesher_that_is_stuck_keeps_the_time_limit(self):
        with stuck.mesher(), self.assertRaisesRegex(polycube.Cancelled, "out of time"):
            polycube.mesh(Part.makeBox(10, 10, 10), time_limit=1)

    def test_a_time_limit_that_is_none_is_refused(self):
        for limit in (0, -5, math.nan):
            with self.subTest(limit=limit), self.assertRaisesRegex(polycube.InvalidInput, "time_limit"):
                polycube.mesh(Part.makeBox(10, 10, 10), time_limit=limit)

    def test_progress_and_log_arrive(self):
        stages, lines = [], []
        polycube.mesh(Part.makeBox(10, 10, 10), size=5, progress=lambda stage, fraction: stages.append((stage, fraction)), log=lines.append)
        self.assertTrue(stages)
        self.assertTrue(all(0 <= fraction <= 1 for _, fraction in stages))

    def test_cancel(self):
        with self.assertRaises(polycube.Cancelled):
            polycube.mesh(Part.makeBox(40, 20, 10), size=0.5, cancel=lambda: True)

    def test_what_cancel_raises_ends_the_job(self):
        with self.assertRaises(ZeroDivisionError):
            polycube.mesh(Part.makeBox(40, 20, 10), size=0.5, cancel=lambda: 1 / 0)

    def test_no_folder_is_left(self):
        def stop(*_):
            raise KeyboardInterrupt

        box = Part.makeBox(10, 10, 10)
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.enterContext(mock.patch("tempfile.tempdir", folder))
        polycube.mesh(box, size=5, progress=lambda *_: self.assertEqual(len(os.listdir(folder)), 1))
        self.assertEqual(os.listdir(folder), [])
        for ending, options in (
            (polycube.InvalidInput, {"size": 1e6}),
            (polycube.InvalidInput, {"size": object()}),
            (polycube.InvalidInput, {"sizes": {"Face1": object()}}),
            (polycube.Cancelled, {"size": 0.2, "cancel": lambda: True}),
            (polycube.Cancelled, {"size": 0.2, "time_limit": 0.1}),
            (KeyboardInterrupt, {"size": 5, "progress": stop}),
        ):
            with self.subTest(options=options):
                with self.assertRaises(ending):
                    polycube.mesh(box, **options)
                self.assertEqual(os.listdir(folder), [])
        # A script that is killed leaves its folder to the next one; one that lives keeps it.
        script = "import sys, time; sys.path.insert(0, {!r}); import job_folder; print(job_folder.JobFolder({!r}).path, flush=True); time.sleep(600)"
        script = script.format(os.path.dirname(job.__file__), folder)
        with subprocess.Popen(["/usr/bin/python3", "-c", script], stdout=subprocess.PIPE, text=True) as other:
            left = other.stdout.readline().strip()
            polycube.mesh(box, size=5)
            self.assertEqual(os.listdir(folder), [os.path.basename(left)])
            other.kill()
        polycube.mesh(box, size=5)
        self.assertEqual(os.listdir(folder), [])
        for shape, options in ((box, {"size": object()}), (object(), {})):
            with self.assertRaises((TypeError, AttributeError)):
                job.Job(shape, options)
            self.assertEqual(os.listdir(folder), [])


class Options(unittest.TestCase):
    """What scripts give, in the ways that they have it: quantities, numbers of numpy, faces by number."""

    Q = FreeCAD.Units.Quantity

    def plain(self, **given):
        return option_table.plain(given)

    def test_quantities_are_taken_in_the_options_unit(self):
        given = {
            **{"size": self.Q("0.5 cm"), "time_limit": self.Q("2 min"), "feature_angle": self.Q("0.1 rad")},
            **{"sizes": {"Face3": self.Q("500 um"), "X": self.Q("0.002 m")}, "hexes": self.Q("300"), "divisions": {"Edge2": self.Q("4")}},
        }
        plain = self.plain(**given)
        self.assertAlmostEqual(plain.pop("feature_angle"), math.degrees(0.1))
        self.assertEqual(plain.pop("sizes"), {"Face3": 0.5, "X": 2})
        self.assertEqual(plain, {"size": 5, "time_limit": 120, "hexes": 300, "divisions": {"Edge2": 4}})

    def test_a_quantity_of_another_kind_is_refused(self):
        lengths = [option["name"] for option in polycube.options() if option["unit"] == "mm"]
        self.assertEqual(sorted(lengths), ["max_size", "size", "sizes"])
        box = Part.makeBox(10, 10, 10)
        for option, value, message in (
            ("size", "5 kg", "size: 5.0 kg is not a length"),
            ("size", "5 mm^2", "size: 5.0 mm^2 is not a length"),
            ("sizes", "5 kg", "sizes: 5.0 kg is not a length"),
            ("time_limit", "5 mm", "time_limit: 5.0 mm is not a time"),
            ("feature_angle", "5 mm", "feature_angle: 5.0 mm is not an angle"),
            ("hexes", "5 mm", "hexes: 5.0 mm is not a plain number"),
        ):
            with self.subTest(option=option, value=value):
                value = self.Q(value)
                for call in (polycube.mesh, polycube.labels):
                    with self.assertRaises(polycube.InvalidInput) as caught:
                        call(box, **{option: {"Face3": value} if option == "sizes" else value})
                    self.assertEqual(str(caught.exception), message)

    def test_numbers_of_any_type_and_faces_by_number(self):
        for number in (numpy.float32(0.5), numpy.float64(0.5), Fraction(1, 2)):
            self.assertEqual(self.plain(size=number, sizes={3: number}), {"size": 0.5, "sizes": {"Face3": 0.5}})
        for number in (numpy.int64(4), 4, 4.0):
            self.assertEqual(json.dumps(self.plain(hexes=number, divisions={"Edge1": number})), '{"hexes": 4, "divisions": {"Edge1": 4}}')
        for three in (3, numpy.int32(3), "Face3"):
            plain = self.plain(labels={three: "+X"}, sizes={three: 1}, keep_faces={three})
            self.assertEqual(plain, {"labels": {"Face3": "+X"}, "sizes": {"Face3": 1}, "keep_faces": ["Face3"]})

    def test_a_killed_mesher_is_told_with_its_stage(self):
        def kill(stage, _):
            if stage == "tet":
                children = subprocess.run(["pgrep", "-P", str(os.getpid())], capture_output=True, text=True).stdout.split()
                for child in children:
                    os.kill(int(child), signal.SIGSEGV)

        with self.assertRaisesRegex(polycube.StageFailed, r"ended by signal 11 \(SIGSEGV\)") as caught:
            polycube.mesh(Part.makeBox(10, 10, 10), size=0.5, progress=kill)
        self.assertEqual(caught.exception.stage, "tet")

    def test_a_name_is_one_name_and_given_once(self):
        for option, value in (("sizes", 1), ("divisions", 2), ("labels", "+X")):
            with self.subTest(option):
                self.assertEqual(list(self.plain(**{option: {" Face3 ": value}})[option]), ["Face3"])
                with self.assertRaisesRegex(polycube.InvalidInput, option + (" is not edges" if option == "divisions" else ": Face3 is given twice")):
                    self.plain(**{option: {3: value, "Face3": value}})
                for name in ("Face3=2,X", "Face3,X", "Face3=2", True, None, 3.0):
                    with self.assertRaisesRegex(polycube.InvalidInput, option + " is not (faces|edges)"):
                        self.plain(**{option: {name: value}})
        self.assertEqual(self.plain(coarsest=numpy.bool_(True), size=None), {"coarsest": True})

    def test_what_cannot_be_read_is_one_line(self):
        for name in (option["name"] for option in polycube.options()):
            for value in (object(), [object()], {object(): object()}, numpy.ones((3, 3))):
                with self.subTest(option=name, value=type(value).__name__):
                    with self.assertRaises(polycube.InvalidInput) as caught:
                        self.plain(**{name: value})
                    self.assertRegex(str(caught.exception), "^" + name + " is not [^\n]+$")

    def test_text_with_a_unit(self):
        plain = self.plain(size="0.5 cm", time_limit="2 min", sizes={"Face3": "500 um"})
        self.assertEqual(plain, {"size": 5, "time_limit": 120, "sizes": {"Face3": 0.5}})
        for option, value, message in (
            ("size", "5 kg", "size: 5.0 kg is not a length"), ("hexes", "5 mm", "hexes is not a number"), ("size", "5 mmm", "size is not a number"),
        ):
            with self.subTest(value=value), self.assertRaises(polycube.InvalidInput) as caught:
                self.plain(**{option: value})
            self.assertEqual(str(caught.exception), message)

    def test_a_wrong_name_is_told_the_right_one(self):
        for wrong, right in (("min_layer", "min_layers"), ("hexas", "hexes"), ("feature_angel", "feature_angle")):
            with self.assertRaises(polycube.InvalidInput) as caught:
                self.plain(**{wrong: 1})
            self.assertIn("did you mean '{}'?".format(right), str(caught.exception))

    def test_numbers_as_text(self):
        for option in polycube.options():
            if option["type"] in ("double", "int"):
                self.assertEqual(self.plain(**{option["name"]: "2"}), {option["name"]: 2})
                for text in ("wide", "", "2 and a half"):
                    with self.assertRaises(polycube.InvalidInput) as caught:
                        self.plain(**{option["name"]: text})
                    self.assertEqual(str(caught.exception), option["name"] + " is not a number")
        self.assertEqual(self.plain(coarsest="true", sew="false", sizes={"X": "0.5"}), {"coarsest": True, "sew": False, "sizes": {"X": 0.5}})
        document = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(document.Name))
        box = document.addObject("Part::Box", "Box")
        document.recompute()
        obj = polycube.create_fem_mesh(box, size="5", order="1", time_limit="100", sew="true", min_layers="1")
        self.assertEqual((obj.CharacteristicLengthMax.Value, obj.ElementOrder, obj.TimeLimit, obj.Sew), (5, "1st", 100, True))
        self.assertEqual(obj.Hexahedra, 8)

    def test_truths(self):
        for value, truth in ((True, True), (0, False), (1.0, True)):
            self.assertIs(self.plain(coarsest=value)["coarsest"], truth)
        for value in (2, -1, 0.5, "2", "maybe", ""):
            with self.subTest(value=value), self.assertRaises(polycube.InvalidInput) as caught:
                self.plain(coarsest=value)
            self.assertEqual(str(caught.exception), "coarsest is not True or False")

    def test_sizes_reach_the_mesh_and_the_properties(self):
        document = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(document.Name))
        box = document.addObject("Part::Box", "Box")
        document.recompute()
        plain = polycube.create_fem_mesh(box, size=5)
        for sizes in ({"Face3": self.Q("1 mm")}, {3: 1}):
            obj = polycube.create_fem_mesh(box, size=5, sizes=sizes)
            self.assertGreater(obj.Hexahedra, plain.Hexahedra)
            self.assertEqual(float(obj.Sizes.split("=")[1]), 1)
            self.assertEqual(obj.Sizes.split("=")[0], "Face3")
            self.assertEqual(obj.MeshState, objects.CURRENT)
            cells = obj.Hexahedra
            polycube.update_fem_mesh(obj)
            self.assertEqual(obj.Hexahedra, cells)


class OtherShapes(unittest.TestCase):
    """Shapes that are more or less than a solid."""

    def setUp(self):
        self.document = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(self.document.Name))

    def mesh(self, shape, **options):
        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = shape
        obj = polycube.create_fem_mesh(part, size=5, order=1, **options)
        self.assertEqual(obj.MeshState, objects.CURRENT)
        return part, obj.FemMesh

    def check_faces(self, part, mesh, numbers):
        """Groups of these faces only, and FreeCAD's own search finds their nodes."""
        groups = {mesh.getGroupName(group): mesh.getGroupElements(group) for group in mesh.Groups if mesh.getGroupElementType(group) == "Face"}
        self.assertEqual(set(groups), {"Face{}".format(number) for number in numbers})
        for number in numbers:
            nodes = {node for quad in groups["Face{}".format(number)] for node in mesh.getElementNodes(quad)}
            self.assertEqual(nodes, set(mesh.getNodesByFace(part.Shape.Faces[number - 1])))

    def test_loose_things_beside_the_solid(self):
        loose = [Part.makeLine(Vector(0, 0, 50), Vector(9, 0, 50)), Part.makePlane(5, 5, Vector(50, 0, 0))]
        part, mesh = self.mesh(Part.makeCompound([*loose, Part.makeBox(20, 10, 10)]))
        self.check_faces(part, mesh, range(2, 8))
        with self.assertRaises(polycube.InvalidInput) as caught:
            self.mesh(part.Shape, keep_faces=["Face1"])
        self.assertIn("Face1 does not belong to the solid", str(caught.exception))

    def test_faces_without_a_solid(self):
        apart = Part.makeCompound([face.copy() for face in Part.makeBox(20, 10, 10).Faces])
        for shape in (apart, Part.makeBox(20, 10, 10).Shells[0]):
            self.check_faces(*self.mesh(shape), range(1, 7))
            with self.assertRaises(polycube.InvalidInput) as caught:
                self.mesh(shape, sew=False)
            self.assertIn("not a solid", str(caught.exception))


class Labels(unittest.TestCase):
    """Labels to look at, and those that the user sets."""

    @staticmethod
    def shape():
        """A block with a chamfer between its +X and +Z faces."""
        block = Part.makeBox(40, 20, 20)
        return block.makeChamfer(6, [edge for edge in block.Edges if edge.BoundBox.XMin > 39 and edge.BoundBox.ZMin > 19])

    @staticmethod
    def chamfer_of(shape):
        normals = [face.normalAt(0, 0) for face in shape.Faces]
        return next(number for number, normal in enumerate(normals, 1) if normal.x > 0.1 and normal.z > 0.1)

    def setUp(self):
        self.part = self.shape()
        self.chamfer = self.chamfer_of(self.part)
        self.left = next(number for number, face in enumerate(self.part.Faces, 1) if face.normalAt(0, 0).x < -0.9)

    def test_arrays(self):
        labels = polycube.labels(self.part)
        self.assertTrue(labels.valid)
        self.assertEqual((labels.chart.max(), len(labels.turning_points), len(labels.corners)), (5, 0, 8))
        self.assertEqual(labels.face_label[self.left], 1)
        self.assertEqual(labels.possible(self.left), [1])
        self.assertEqual(labels.possible(self.chamfer), [0, 4])
        self.assertIn("6 charts", repr(labels))

    def test_given_labels_are_obeyed(self):
        for key, axis, label in (("Face{}".format(self.chamfer), "+X", 0), (self.chamfer, "+Z", 4)):
            labels = polycube.labels(self.part, labels={key: axis})
            self.assertEqual(set(labels.label[labels.triangle_face == self.chamfer]), {label})

    def test_what_cannot_be_is_refused(self):
        for call in (polycube.labels, polycube.mesh):
            with self.assertRaises(polycube.InvalidInput) as caught:
                call(self.part, labels={self.left: "+X"})
            self.assertEqual(
                str(caught.exception), "labels: Face{} cannot be +X, it does not face that way; it can be -X".format(self.left)
            )

    def test_frame(self):
        for frame in (((0, 1, 0), (-1, 0, 0)), [Vector(0, 2, 0), Vector(-1, 0, 0)]):
            labels = polycube.labels(self.part, frame=frame)
            self.assertEqual(labels.frame.round(12).tolist(), [[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
            self.assertEqual(labels.face_label[self.left], 2)
        for bad in (((1, 0, 0), (1, 1, 0)), 3, (1, 2)):
            with self.assertRaises(polycube.InvalidInput) as caught:
                polycube.labels(self.part, frame=bad)
            self.assertTrue(str(caught.exception).startswith("frame"))


class Invariance(unittest.TestCase):
    """A part turned, moved and scaled gives the same cells."""

    def check(self, shape, size):
        base = polycube.mesh(shape, size=size)
        quality = base.report["quality"]["min_scaled_jacobian"]
        turn = FreeCAD.Placement(Vector(13, -7, 29), Rotation(Vector(1, 2, 3), 37))
        for name, other, scale in (
            ("turned", moved(shape, placement=turn), 1),
            ("small", moved(shape, scale=1e-3), 1e-3),
            ("large", moved(shape, scale=1e3), 1e3),
        ):
            with self.subTest(name):
                result = polycube.mesh(other, size=size * scale)
                self.assertEqual(len(result.hexes), len(base.hexes))
                self.assertAlmostEqual(result.report["quality"]["min_scaled_jacobian"], quality, delta=0.02)

    def test_box(self):
        self.check(Part.makeBox(40, 20, 10), 5)

    def test_cylinder(self):
        self.check(Part.makeCylinder(10, 30), 4)


class BadInput(DocumentTest):
    """One clear line, and the document stays as it was."""

    def check(self, part, **options):
        before = [obj.Name for obj in self.document.Objects]
        undo = list(self.document.UndoNames)
        with self.assertRaises(polycube.InvalidInput) as caught:
            polycube.create_fem_mesh(part, **options)
        message = str(caught.exception)
        self.assertTrue(message)
        self.assertNotIn("\n", message)
        self.assertEqual([obj.Name for obj in self.document.Objects], before)
        self.assertEqual(list(self.document.UndoNames), undo)
        self.assertFalse(self.document.HasPendingTransaction)
        return message

    def test_name_that_is_none(self):
        for name in (5, "", None):
            self.assertIn("name", self.check(self.feature(Part.makeBox(1, 1, 1)), name=name))

    def test_empty_compound(self):
        self.check(self.feature(Part.makeCompound([])))

    def test_null_shape(self):
        self.check(self.document.addObject("Part::Feature", "Nothing"))

    def test_open_shell(self):
        self.assertIn("solid", self.check(self.feature(Part.makeShell(Part.makeBox(1, 1, 1).Faces[:5]))))

    def test_solids_that_overlap(self):
        two = Part.makeCompound([Part.makeBox(10, 10, 10), Part.makeBox(10, 10, 10, Vector(5, 0, 0))])
        self.assertIn("overlap", self.check(self.feature(two)))

    def test_zero_volume(self):
        flat = FreeCAD.Matrix()
        flat.scale(1, 1, 1e-13)
        self.check(self.feature(Part.makeBox(10, 10, 10).transformGeometry(flat)))

    def test_size(self):
        box = self.box()
        for size in (0, -1, math.nan, math.inf, 1e4, "wide"):
            with self.subTest(size=size):
                self.assertIn("size", self.check(box, size=size))
        self.assertIn("sizes", self.check(box, sizes={"Face3": math.nan}))

    def test_a_property_that_is_no_number(self):
        obj = polycube.create_fem_mesh(self.box(), size=10)
        for value in (math.nan, math.inf):
            obj.TimeLimit = value
            with self.subTest(value=value), self.assertRaisesRegex(polycube.InvalidInput, r"\Atime_limit: '\w+' is not a number\Z"):
                polycube.update_fem_mesh(obj)

    def test_unknown_option(self):
        self.assertIn("seize", self.check(self.box(), seize=3))

    def test_order(self):
        self.assertIn("order", self.check(self.box(), order=3))

    def test_two_ways_of_giving_the_size(self):
        message = self.check(self.box(), size=5, hexes=100)
        self.assertIn("hexes", message)
        self.assertNotIn("--", message)

    def test_labels(self):
        self.assertIn("Face99", self.check(self.box(), labels={"Face99": "+X"}))

    def test_an_analysis_that_is_none(self):
        box = self.box()
        for analysis in ("Analysis", 3, box):
            self.assertIn("analysis", self.check(box, analysis=analysis))

    def test_an_analysis_in_another_document(self):
        box, other = self.box(), FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(other.Name))
        analysis = ObjectsFem.makeAnalysis(other, "Elsewhere")
        self.assertEqual(self.check(box, analysis=analysis), "Elsewhere is in another document than Box")
        self.assertEqual((other.Objects, list(analysis.Group)), ([analysis], []))

    def test_not_a_shape(self):
        with self.assertRaises(polycube.InvalidInput):
            polycube.mesh("Box")
        with self.assertRaises(polycube.InvalidInput):
            polycube.create_fem_mesh(None)

    def test_sketch_without_solid(self):
        self.check(self.feature(Part.makeCircle(3)))


class FemMeshObject(DocumentTest):
    def test_create_is_one_undo_step(self):
        box = self.box()
        self.document.clearUndos()
        obj = polycube.create_fem_mesh(box, size=5)
        name = obj.Name
        self.assertEqual(len(self.document.UndoNames), 1)
        self.assertTrue(obj.isDerivedFrom("Fem::FemMeshObject"))
        self.assertEqual(obj.FemMesh.HexaCount, obj.Hexahedra)
        self.assertEqual(obj.FemMesh.FaceCount, obj.FemMesh.QuadrangleCount)
        self.assertEqual(obj.MeshState, objects.CURRENT)
        self.assertAlmostEqual(obj.MeshVolume.Value, 8000, delta=1e-3)
        self.document.undo()
        self.assertIsNone(self.document.getObject(name))
        self.document.redo()
        self.assertEqual(self.document.getObject(name).FemMesh.HexaCount, self.document.getObject(name).Hexahedra)

    def test_undo_takes_the_cells_back_too(self):
        """FreeCAD leaves a mesh object its cells."""
        box = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1)
        coarse = obj.FemMesh.HexaCount
        polycube.update_fem_mesh(obj, size=2.5)
        fine = obj.FemMesh.HexaCount
        self.assertNotEqual(coarse, fine)
        for change, number in ((self.document.undo, coarse), (self.document.redo, fine), (self.document.undo, coarse)):
            change()
            self.assertEqual((obj.FemMesh.HexaCount, obj.Hexahedra, obj.MeshState), (number, number, "Up to date"))
        self.document.openTransaction("Caller's")
        polycube.update_fem_mesh(obj, size=2.5)
        self.document.abortTransaction()
        self.assertEqual((obj.FemMesh.HexaCount, obj.Hexahedra, obj.MeshState), (coarse, coarse, "Up to date"))
        # As many cells of another shape are others.
        polycube.update_fem_mesh(obj)
        box.Length = 11
        self.document.recompute()
        polycube.update_fem_mesh(obj)
        self.assertAlmostEqual(max(point.x for point in obj.FemMesh.Nodes.values()), 11)
        self.document.undo()
        self.assertAlmostEqual(max(point.x for point in obj.FemMesh.Nodes.values()), 10)

    def test_cells_that_are_not_remembered_are_out_of_date(self):
        box = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1)
        polycube.update_fem_mesh(obj, size=2.5)
        with mock.patch.dict(cells._remembered, clear=True):
            self.document.undo()
        self.assertEqual(obj.MeshState, "Out of date")
        self.document.recompute()
        self.assertEqual(obj.MeshState, "Out of date")

    def test_what_is_gone_is_told(self):
        box = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1)
        gone = polycube.create_fem_mesh(box, size=5, order=1)
        self.document.removeObject(gone.Name)
        for call in (polycube.update_fem_mesh, polycube.set_options, lambda mesh: polycube.refine(mesh, "size", ["Face1"], 2), polycube.solve, polycube.converge):
            with self.subTest(call), self.assertRaisesRegex(polycube.InvalidInput, "gone|needed|is no mesh"):
                call(gone)
        before = len(self.document.Objects)
        with self.assertRaisesRegex(polycube.InvalidInput, "gone"):
            polycube.create_fem_mesh(box, size=5, order=1, progress=lambda *_: self.document.getObject("Box") and self.document.removeObject("Box"))
        self.assertEqual(len(self.document.Objects), before - 1)
        with self.assertRaisesRegex(polycube.InvalidInput, "gone"):
            polycube.update_fem_mesh(obj, size=2)

    def test_joins_the_callers_transaction(self):
        box = self.box()
        self.document.clearUndos()
        self.document.openTransaction("Mine")
        polycube.create_fem_mesh(box, size=5)
        self.document.commitTransaction()
        self.assertEqual(list(self.document.UndoNames), ["Mine"])

    def test_groups_and_numbering(self):
        obj = polycube.create_fem_mesh(self.box(), size=5)
        mesh = obj.FemMesh
        groups = {mesh.getGroupName(group): (mesh.getGroupElementType(group), mesh.getGroupElements(group)) for group in mesh.Groups}
        self.assertEqual({kind for name, (kind, _) in groups.items() if name.startswith("Face")}, {"Face"})
        self.assertEqual({kind for name, (kind, _) in groups.items() if name.startswith("Edge")}, {"Edge"})
        self.assertEqual(set(groups["Solid1"][1]), set(mesh.Volumes))
        part = objects.part_of(obj)
        for name, search in (("Face3", mesh.getNodesByFace), ("Edge5", mesh.getNodesByEdge)):
            found = set(search(part.Shape.getElement(name)))
            grouped = {node for element in groups[name][1] for node in mesh.getElementNodes(element)}
            self.assertEqual(found, grouped, name)
        point = mesh.getNodeById(groups["Vertex2"][1][0])
        self.assertLess((point - part.Shape.Vertexes[1].Point).Length, 1e-7)

    def test_cells_wind_as_smesh_wants(self):
        obj = polycube.create_fem_mesh(self.box(), size=5)
        for cell in obj.FemMesh.Volumes:
            n1, n2, _, n4, n5 = [obj.FemMesh.getNodeById(node) for node in obj.FemMesh.getElementNodes(cell)[:5]]
            self.assertLess((n2 - n1).cross(n4 - n1).dot(n5 - n1), 0)

    def test_quality_of_the_fem_mesh_is_that_of_the_arrays(self):
        part = self.feature(Part.makeCylinder(10, 30))
        obj = polycube.create_fem_mesh(part, size=5)
        cells = measures.Cells(obj.FemMesh)
        self.assertEqual(set(cells.node_numbers), set(obj.FemMesh.Nodes))
        self.assertAlmostEqual(cells.node_goodness(measures.MEASURES[0]).min(), obj.MinScaledJacobian, delta=1e-6)
        result = polycube.mesh(part, size=5)
        same = measures.Cells.of_result(result)
        for name in ("numbers", "node_numbers", "nodes", "points"):
            numpy.testing.assert_array_equal(getattr(same, name), getattr(cells, name), name)
        for measure in measures.MEASURES:
            with self.subTest(measure=measure.name):
                values = cells.values(measure)
                numpy.testing.assert_allclose(values, getattr(result, measure.name), atol=1e-6)
                (worst,) = cells.worst(measure, 1)
                self.assertEqual(measure.goodness(values[worst]), measure.goodness(values).min())
                self.assertEqual(sum(measure.histogram(values)), len(values))
        self.assertEqual(measures.MEASURES[0].histogram(cells.values(measures.MEASURES[0])), result.report["quality"]["histogram"])

    def test_measures_of_a_cube_and_of_what_is_none(self):
        cube = numpy.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]], float)
        worst = {"scaled_jacobian": -1, "edge_ratio": math.inf, "skew": 1, "warpage": 1}
        for measure in measures.MEASURES:
            self.assertEqual(measure.goodness(measure.of(cube)[0]), 1, measure.name)
            self.assertEqual(measure.bars(measure.of(cube)), [measures.BARS - 1])
            self.assertEqual(measure.of(0 * cube)[0], worst[measure.name], measure.name)
            for good in (0.1, 0.5, 1):
                self.assertAlmostEqual(measure.goodness(measure.value(good)), good)

    def test_mid_nodes_between_their_corners(self):
        obj = polycube.create_fem_mesh(self.box(), size=5)
        edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
        for cell in obj.FemMesh.Volumes[:20]:
            points = [obj.FemMesh.getNodeById(node) for node in obj.FemMesh.getElementNodes(cell)]
            for middle, (a, b) in enumerate(edges, 8):
                self.assertLess((points[middle] - (points[a] + points[b]) * 0.5).Length, 1e-9)

    def test_out_of_date_when_the_shape_changes(self):
        box = self.box()
        obj = polycube.create_fem_mesh(box, size=5)
        cells = obj.FemMesh.HexaCount
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.CURRENT)
        box.Length = 80
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        self.assertEqual(obj.FemMesh.HexaCount, cells, "recompute must not mesh")
        polycube.update_fem_mesh(obj)
        self.assertEqual(obj.MeshState, objects.CURRENT)
        self.assertGreater(obj.FemMesh.HexaCount, cells)

    def test_out_of_date_when_the_shape_changes_while_it_is_meshed(self):
        box = self.box()
        obj = polycube.create_fem_mesh(box, size=5)

        def longer(*_):
            box.Length = 80
            self.document.recompute()

        cells = obj.Hexahedra
        with mock.patch.object(FreeCAD.Console, "PrintWarning", create=True) as warn:
            polycube.update_fem_mesh(obj, progress=longer)
        self.assertIn("the part has changed while it was meshed", warn.call_args.args[0])
        self.assertEqual((obj.Hexahedra, obj.MeshState), (cells, objects.OUTDATED))
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        polycube.update_fem_mesh(obj)
        self.assertEqual((obj.Hexahedra, obj.MeshState), (2 * cells, objects.CURRENT))

    def test_faces_with_constraints_go_while_the_part_is_meshed(self):
        box = Part.makeBox(10, 10, 10)
        part = self.feature(box.makeChamfer(3, box.Edges[:1]))
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))[0]
        fixed.References = [(part, "Face7")]

        def other(*_):
            part.Shape = box

        obj = polycube.create_fem_mesh(part, size=5, analysis=analysis, progress=other)
        self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_out_of_date_when_the_part_has_no_shape_any_more(self):
        part = self.feature(Part.makeBox(10, 10, 10))
        obj = polycube.create_fem_mesh(part, size=5)
        for nothing in (Part.makeCompound([]), Part.Shape()):
            part.Shape = nothing
            obj.touch()
            self.document.recompute()
            self.assertTrue(obj.isValid())
            self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_out_of_date_when_an_option_changes(self):
        obj = polycube.create_fem_mesh(self.box(), size=5)
        obj.CharacteristicLengthMax = 2.5
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        obj.CharacteristicLengthMax = 5
        self.assertEqual(obj.MeshState, objects.CURRENT)
        obj.ElementOrder = "1st"
        self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_moved_part_is_out_of_date(self):
        box = self.box()
        obj = polycube.create_fem_mesh(box, size=5)
        box.Placement.Base = Vector(1e-3, 0, 0)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_a_failed_update_changes_nothing(self):
        obj = polycube.create_fem_mesh(self.box(), size=5)
        cells = obj.FemMesh.HexaCount
        obj.CharacteristicLengthMax = 1e5
        self.document.clearUndos()
        with self.assertRaises(polycube.InvalidInput):
            polycube.update_fem_mesh(obj)
        self.assertEqual(obj.FemMesh.HexaCount, cells)
        self.assertEqual(list(self.document.UndoNames), [])

    def test_save_and_restore(self):
        box = self.box()
        obj = polycube.create_fem_mesh(box, size=5)
        cells, nodes, name = obj.FemMesh.HexaCount, obj.FemMesh.NodeCount, obj.Name
        groups = sorted(obj.FemMesh.getGroupName(group) for group in obj.FemMesh.Groups)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "part.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
            obj = self.document.getObject(name)
            self.assertTrue(objects.is_polycube(obj))
            self.assertEqual((obj.FemMesh.HexaCount, obj.FemMesh.NodeCount), (cells, nodes))
            self.assertEqual(sorted(obj.FemMesh.getGroupName(group) for group in obj.FemMesh.Groups), groups)
            self.assertEqual(obj.CharacteristicLengthMax.Value, 5)
            self.assertEqual(obj.MeshState, objects.CURRENT)
            obj.touch()
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.CURRENT, "a document read back has the same shape")
            self.document.getObject("Box").Width = 30
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_old_documents_get_missing_properties(self):
        obj = polycube.create_fem_mesh(self.box(), size=5)
        obj.removeProperty("TimeLimit")
        obj.Proxy.onDocumentRestored(obj)
        self.assertTrue(hasattr(obj, "TimeLimit"))

    def test_options_are_properties(self):
        obj = objects.make(self.document, self.box())
        for option in polycube.options():
            if option["name"] != "element_type":
                name = objects.option_table.property_name(option)
                self.assertTrue(hasattr(obj, name), name)
        self.assertEqual(objects.option_table.read(obj), {})
        given = {"size": 4.0, "order": 1, "labels": {"Face3": "+X"}, "frame": "0.0,1.0,0.0/-1.0,0.0,0.0"}
        objects.option_table.write(obj, given)
        self.assertEqual(objects.option_table.read(obj), given)
        objects.option_table.write(obj, dict(given, frame=[[0, 1, 0], [-1, 0, 0]]))
        self.assertEqual(objects.option_table.read(obj), given)

    def test_axes_and_frame_of_the_object_are_obeyed(self):
        part = self.feature(Labels.shape())
        chamfer = Labels.chamfer_of(part.Shape)
        obj = polycube.create_fem_mesh(part, size=6, order=1, labels={chamfer: "+X"}, frame=((1, 0, 0), (0, 1, 0)))
        self.assertEqual((list(obj.Labels), obj.Frame), (["Face{}=+X".format(chamfer)], "1.0,0.0,0.0/0.0,1.0,0.0"))
        self.assertEqual(obj.MeshState, objects.CURRENT)
        obj.Labels = ["Face{}=-X".format(chamfer)]
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        with self.assertRaises(polycube.InvalidInput) as caught:
            polycube.update_fem_mesh(obj)
        self.assertIn("cannot be -X", str(caught.exception))
        obj.Frame = "0,0,1 / 0,1,0"
        obj.Labels = ["Face{}=+X".format(chamfer)]
        polycube.update_fem_mesh(obj)
        self.assertEqual(obj.MeshState, objects.CURRENT)
        obj.Frame = "1,0,0"
        with self.assertRaises(polycube.InvalidInput) as caught:
            polycube.update_fem_mesh(obj)
        self.assertTrue(str(caught.exception).startswith("frame"))


class Helpers(unittest.TestCase):
    def test_signature_tells_shapes_apart(self):
        box = shapes.signature(Part.makeBox(1, 2, 3))
        self.assertTrue(shapes.same(box, shapes.signature(Part.makeBox(1, 2, 3))))
        self.assertFalse(shapes.same(box, shapes.signature(Part.makeBox(1, 2, 3.00001))))
        self.assertFalse(shapes.same(box, shapes.signature(Part.makeBox(1, 2, 3, Vector(0.001, 0, 0)))))
        self.assertFalse(shapes.same([], []))

    def test_a_crashed_child_is_reported(self):
        with job.Job(Part.makeBox(1, 1, 1), {}) as work:
            with self.assertRaises(polycube.StageFailed) as caught:
                work.finish(-11, "some text\nSegmentation fault\n")
        self.assertIn("signal 11 (SIGSEGV)", str(caught.exception))
        self.assertIn("Segmentation fault", str(caught.exception))

    def test_a_failed_stage_says_where(self):
        error = polycube.StageFailed("two charts overlap", "label", ["Face3", "Face7"])
        self.assertEqual(str(error), "label: two charts overlap (Face3, Face7)")

    def test_transaction_is_taken_back(self):
        for undo in (0, 1):
            document = FreeCAD.newDocument()
            document.UndoMode = undo
            kept = document.addObject("Part::Box", "Kept")
            try:
                with self.assertRaises(KeyError):
                    with api.transaction(document, "Test"):
                        document.addObject("Part::Box", "Box")
                        raise KeyError
                self.assertEqual(document.Objects, [kept])
            finally:
                FreeCAD.closeDocument(document.Name)
