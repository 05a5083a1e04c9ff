"""Files that everyone reads: every format, FreeCAD's names of faces, loose things, PartDesign bodies, odd names, damage."""

import json
import os
import random
import re
import sys
import unittest
import zipfile

import numpy as np
from support import VECTOR, FolderTest, FreeCAD, Part, box, plate

import _polycube

sys.path.append(os.path.join(FreeCAD.getResourceDir(), "Mod"))
import PartDesign  # noqa: E402, F401  (its types of document objects)

NAME = "Größe 1 für Ø 8 мм"


def with_loose_things():
    """A line and a face, then the solid, then a vertex."""
    line = Part.makeLine(VECTOR(0, 0, 30), VECTOR(5, 0, 30))
    return Part.Compound([line, Part.makePlane(3, 3, VECTOR(40, 0, 0)), plate(), Part.Vertex(9, 9, 50)])


def apart():
    """The faces of a plate, none of which shares an edge with another."""
    return Part.Compound([face.copy() for face in reversed(plate().Faces)])


class Reading(FolderTest):
    def label(self, part, *arguments):
        run = self.run_program("label", part, "--report", self.path("report.json"), *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.path("report.json")) as file:
            return json.load(file), run.stderr

    def files(self, shape, folder=None, name="part"):
        """The shape in every format that FreeCAD writes."""
        writers = {".step": shape.exportStep, ".stp": shape.exportStep, ".iges": shape.exportIges, ".igs": shape.exportIges,
                   ".brep": shape.exportBrep, ".brp": shape.exportBrep}
        paths = [os.path.join(folder or self.folder, name + suffix) for suffix in writers]
        for path, write in zip(paths, writers.values()):
            write(path)
        return paths


class Formats(Reading):
    def check_names(self, path):
        """Every triangle is on the face that FreeCAD calls so."""
        shape = Part.Shape()
        shape.read(path)
        labels = _polycube.labels(path=path, size=4)
        middles = np.asarray(labels["points"])[np.asarray(labels["triangles"])].mean(axis=1)
        numbers = np.asarray(labels["triangle_face"])
        for number in np.unique(numbers):
            face = shape.Faces[number - 1]
            for middle in middles[numbers == number][:5]:
                self.assertLess(face.distToShape(Part.Vertex(*middle))[0], 0.3, (path, number))
        return set(numbers), shape

    def test_names_are_freecads(self):
        for make in (plate, with_loose_things, apart):
            for path in self.files(make()):
                with self.subTest(path=os.path.basename(path), shape=make.__name__):
                    numbers, shape = self.check_names(path)
                    self.assertEqual(len(numbers), 7)
                    self.assertLessEqual(max(numbers), len(shape.Faces))

    def test_loose_things_are_told(self):
        part = self.files(with_loose_things())[4]
        told = "left out beside the solid: 1 loose face, 1 loose edge, 1 loose vertex"
        report, stderr = self.label(part)
        self.assertEqual(stderr, "polycube: warning: {}\n".format(told))
        self.assertEqual(report["warnings"], [told])
        run = self.run_program("mesh", part, "-o", self.path("a.inp"), "--size", "4", "--order", "1", "--report", self.path("r.json"))
        self.assertEqual((run.returncode, run.stderr), (0, "polycube: warning: {}\n".format(told)))
        self.assertIn("CAD faces 7/7 edges 14/14 vertices 10/10", run.stdout)
        with open(self.path("r.json")) as file:
            self.assertIn(told, json.load(file)["warnings"])
        with open(self.path("a.inp")) as file:
            sets = set(re.findall(r"Face\d+", file.read()))
        self.assertEqual(sets, {"Face{}".format(number) for number in range(2, 9)})
        self.assertIn("Face1 does not belong to the solid", self.refuses(part, "--keep-faces", "Face1"))

    def test_faces_are_sewn_unless_told_not_to(self):
        part = self.files(apart())[4]
        report, stderr = self.label(part)
        self.assertIn("its 7 faces are sewn to one within", stderr)
        self.assertEqual(len(report["faces"]), 7)
        self.label(part, "--sew")
        self.assertIn("not a solid", self.refuses(part, "--no-sew"))
        text = apart().exportBrepToString()
        self.assertEqual(len(_polycube.labels(brep=text)["face_label"]), 7)
        with self.assertRaises(_polycube.InvalidInput):
            _polycube.labels(brep=text, sew=False)

    def test_names_of_files(self):
        folder = self.path(NAME)
        os.mkdir(folder)
        for path in self.files(box(), folder, NAME):
            with self.subTest(os.path.basename(path)):
                report, stderr = self.label(path)
                self.assertEqual(len(report["faces"]), 6)
        os.rename(path, os.path.join(folder, NAME + ".BREP"))
        self.label(os.path.join(folder, NAME + ".BREP"))


class Documents(Reading):
    """FreeCAD documents; those of older programs are made from what this one saves."""

    def save(self, build, name="part.FCStd"):
        document = FreeCAD.newDocument()
        try:
            build(document)
            document.recompute()
            document.saveAs(self.path(name))
        finally:
            FreeCAD.closeDocument(document.Name)
        return self.path(name)

    def test_links_are_not_passed_over(self):
        """The file holds no shape of a link: it is named, alone or beside what it leads to."""

        def build(document):
            box = document.addObject("Part::Box", "Cube")
            for name, target in (("Again", box), ("Third", "Again")):
                document.addObject("App::Link", name).LinkedObject = document.getObject(target) if isinstance(target, str) else target
            document.getObject("Again").Placement.Base = VECTOR(10, 0, 0)

        path = self.save(build)
        run = self.run_program("mesh", path, "-o", self.path("out.inp"), "--size", "5")
        self.assertEqual(run.returncode, 0, run.stderr)
        for name in ("Again", "Third"):
            self.assertEqual(run.stderr.count("left out: {}, which is a link".format(name)), 1, run.stderr)
            self.assertIn("{}, which is a link: the workbench in FreeCAD follows links".format(name), self.refuses(path, "--object", name))

    def edit(self, path, change):
        """Document.xml of a saved document as another program would have written it."""
        with zipfile.ZipFile(path) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        files["Document.xml"] = change(files["Document.xml"].decode()).encode()
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in files.items():
                archive.writestr(name, content)

    @staticmethod
    def body(document, name="Body", size=(8, 4, 4), holder=None):
        """A block with a chamfer, each step a feature of its own: 7 faces."""
        body = document.addObject("PartDesign::Body", name)
        block = document.addObject("PartDesign::AdditiveBox", name + "Block")
        block.Length, block.Width, block.Height = size
        body.addObject(block)
        document.recompute()
        chamfer = document.addObject("PartDesign::Chamfer", name + "Chamfer")
        body.addObject(chamfer)
        chamfer.Base = (block, ["Edge1"])
        chamfer.Size = 1
        body.Tip = chamfer
        if holder:
            holder.addObject(body)
        return body

    def extents(self, path, *arguments):
        run = self.run_program("mesh", path, "-o", self.path("a.inp"), "--size", "2", "--order", "1", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.path("a.inp")) as file:
            rows = [row for row in file.read().split("*ELEMENT")[0].splitlines() if not row.startswith("*")]
        points = np.array([[float(x) for x in row.split(",")[1:]] for row in rows])
        return [*points.min(axis=0), *points.max(axis=0)], run.stdout

    def test_the_final_solid_is_taken_where_it_stands(self):
        def cut(document):
            result = document.addObject("Part::Cut", "Result")
            result.Base, result.Tool = document.addObject("Part::Box", "Base"), document.addObject("Part::Cylinder", "Tool")
            result.Tool.Placement.Base = VECTOR(5, 5, 0)
            result.Placement.Base = VECTOR(100, 0, 0)

        np.testing.assert_allclose(self.extents(self.save(cut))[0], [100, 0, 0, 110, 10, 10], atol=1e-6)

    def test_a_document_without_a_solid(self):
        self.refuses(self.save(lambda document: document.addObject("Part::Plane", "Plane")))
        self.assertIn("no object", self.refuses(self.save(lambda document: document.addObject("App::DocumentObjectGroup", "Group"))))

    def test_the_tip_of_a_body_is_its_shape(self):
        def no_dependencies(xml):
            return re.sub(r"<ObjectDeps [^>]*/>|<ObjectDeps .*?</ObjectDeps>", "", xml, flags=re.S).replace(' Dependencies="1"', "")

        def cycle(xml):
            return re.sub(r'(<ObjectDeps Name="Body(?:Block|Chamfer)" Count="\d+">)', r'\1<Dep Name="Body"/>', xml)

        def no_shape_of_the_body(xml):
            return re.sub(r'(<Object name="Body" .*?<Property name="Shape".*?)<Part [^>]*/>', r'\1<Part file=""/>', xml, count=1, flags=re.S)

        changes = {"as saved": str, "0.18": no_dependencies, "cycle": cycle, "no shape of the body": no_shape_of_the_body}
        for name, change in changes.items():
            with self.subTest(name):
                path = self.save(self.body)
                with zipfile.ZipFile(path) as archive:
                    before = archive.read("Document.xml").decode()
                if change is not str:
                    self.assertNotEqual(change(before), before)
                self.edit(path, change)
                box, out = self.extents(path)
                np.testing.assert_allclose(box, [0, 0, 0, 8, 4, 4], atol=1e-6)
                self.assertIn("CAD faces 7/7", out)

    def test_where_freecad_shows_it(self):
        turn = FreeCAD.Rotation(VECTOR(0, 0, 1), 90)
        expected = {}

        def build(document):
            outer = document.addObject("App::Part", "Outer")
            inner = document.addObject("App::Part", "Inner")
            group = document.addObject("App::DocumentObjectGroup", "Group")
            outer.addObject(inner)
            inner.addObject(group)
            outer.Placement = FreeCAD.Placement(VECTOR(100, 0, 0), turn)
            inner.Placement = FreeCAD.Placement(VECTOR(0, 10, 0), FreeCAD.Rotation(VECTOR(1, 0, 0), 90))
            body = self.body(document, holder=inner)
            body.Placement.Base = VECTOR(1, 2, 3)
            block = document.addObject("Part::Box", "Plain")
            block.Placement.Base = VECTOR(0, 0, 50)
            group.addObject(block)
            document.recompute()
            for obj in (body, document.BodyBlock, block):
                shape = obj.Shape.copy()
                # getGlobalPlacement has the object's own placement in it, as the shape has.
                shape.Placement = obj.getGlobalPlacement()
                bounds = shape.BoundBox
                expected[obj.Name] = [bounds.XMin, bounds.YMin, bounds.ZMin, bounds.XMax, bounds.YMax, bounds.ZMax]

        path = self.save(build)
        self.assertGreater(expected["Body"][0], 50)
        for name, bounds in expected.items():
            with self.subTest(name):
                np.testing.assert_allclose(self.extents(path, "--object", name)[0], bounds, atol=1e-6)

    def test_several_bodies_need_a_choice(self):
        def build(document):
            self.body(document, "First").Label = NAME
            self.body(document, "Second", (6, 4, 4))
            container = document.addObject("App::Part", "Container")
            self.body(document, "Third", (5, 4, 4), container)

        path = self.save(build, NAME + ".FCStd")
        message = self.refuses(path)
        self.assertIn('several solids: choose one with --object (First "{}", Second, Third)'.format(NAME), message)
        for name, length in ((NAME, 8), ("First", 8), ("Second", 6), ("Third", 5), ("Container", 5)):
            with self.subTest(name):
                self.assertAlmostEqual(self.extents(path, "--object", name)[0][3], length, delta=1e-6)
        self.assertIn("no object with a shape named 'Fourth'", self.refuses(path, "--object", "Fourth"))
        self.assertEqual(len(_polycube.labels(path=path, object="Second")["face_label"]), 7)
        with self.assertRaises(_polycube.InvalidInput):
            _polycube.labels(brep=box().exportBrepToString(), object="Second")

    def test_what_cannot_be_read_is_not_passed_over(self):
        def build(document):
            self.body(document, "First")
            self.body(document, "Second", (6, 4, 4))

        path = self.save(build)
        with zipfile.ZipFile(path) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        shape = re.search(r'<Object name="First".*?<Property name="Shape".*?file="(.*?)"', files["Document.xml"].decode(), re.S).group(1)
        tip = re.search(r'<Object name="FirstChamfer".*?<Property name="Shape".*?file="(.*?)"', files["Document.xml"].decode(), re.S).group(1)
        for damage, said in ((lambda text: text[: len(text) // 2], "First: .*damaged.*--object .Second"), (lambda text: b"", None)):
            with self.subTest(said=said):
                with zipfile.ZipFile(self.path("damaged.FCStd"), "w") as archive:
                    for name, text in files.items():
                        archive.writestr(name, damage(text) if name in (shape, tip) else text)
                if said:
                    self.assertRegex(self.refuses(self.path("damaged.FCStd")), said)
                else:  # FreeCAD writes that of a body that is empty
                    self.assertAlmostEqual(self.extents(self.path("damaged.FCStd"))[0][3], 6, delta=1e-6)

    def test_a_feature_that_failed_does_not_leave_what_it_was_made_of(self):
        def build(document):
            block = document.addObject("Part::Box", "Block")
            failed = document.addObject("Part::Fillet", "Rounded")
            failed.Base = block
            failed.Edges = [(1, 100.0, 100.0)]

        self.assertRegex(self.refuses(self.save(build)), "Rounded has no shape.*--object .Block")

    def test_what_has_no_solid_does_not_use_one_up(self):
        def build(document):
            block = document.addObject("Part::Box", "Block")
            sketch = document.addObject("Part::Feature", "Drawing")
            sketch.Shape = Part.makeLine(VECTOR(0, 0, 0), VECTOR(1, 0, 0))
            sketch.addProperty("App::PropertyLink", "Support")
            sketch.Support = block

        self.assertAlmostEqual(self.extents(self.save(build))[0][3], 10, delta=1e-6)

    def test_damage_ends_in_a_mesh_or_a_refusal(self):
        path = self.save(self.body)
        with zipfile.ZipFile(path) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        # The same every day: without dates and random numbers.
        text = files["Document.xml"].decode()
        files["Document.xml"] = re.sub(r"\d{4}-\d\d-\d\dT[\d:]{8}Z|[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", "", text).replace(self.folder, "").encode()

        def write(contents):
            with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
                for name in sorted(contents):
                    archive.writestr(zipfile.ZipInfo(name), contents[name], zipfile.ZIP_DEFLATED)

        write(files)
        with open(path, "rb") as file:
            whole = file.read()
        chance = random.Random(3)

        def damaged(content):
            content = bytearray(content or b"?")
            for _ in range(chance.choice((1, 3, 20))):
                content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
            return bytes(content[: chance.choice((len(content), chance.randrange(len(content))))])

        statuses = []
        for turn in range(40):
            if turn % 2:
                # Inside the archive, where no checksum tells.
                chosen = chance.choice(sorted(files))
                write({**files, chosen: damaged(files[chosen])})
            else:
                with open(path, "wb") as file:
                    file.write(damaged(whole))
            run = self.run_program("label", path)
            statuses.append(run.returncode)
            self.assertIn(run.returncode, (0, 1), run.stderr)
            if run.returncode:
                self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        self.assertGreater(statuses.count(1), 10)


if __name__ == "__main__":
    unittest.main()
