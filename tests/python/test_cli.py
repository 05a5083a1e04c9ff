"""The command line: exit statuses, messages, files, cancel."""

import collections
import json
import os
import random
import signal
import subprocess
import time
import unittest

import numpy as np
from support import PROGRAM, VECTOR, FolderTest, FreeCAD, Part, box, cylinder, plate


class Cli(FolderTest):
    def refuses(self, part, *arguments, status=1, output="out.inp"):
        before = set(os.listdir(self.folder))
        run = self.run_program("mesh", part, "-o", self.path(output), *arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        self.assertTrue(run.stderr.startswith("polycube: "), run.stderr)
        self.assertEqual(set(os.listdir(self.folder)), before, "something was written")
        return run.stderr

    def test_mesh_with_report(self):
        part = self.save(plate())
        run = self.run_program("mesh", part, "-o", self.path("a.inp"), "--size", "3", "--order", "1", "--report", self.path("r.json"))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "")
        self.assertEqual(len(run.stdout.splitlines()), 1)
        with open(self.path("r.json")) as file:
            report = json.load(file)
        self.assertEqual(report["options"]["size"], 3)
        self.assertEqual(report["options"]["order"], 1)
        self.assertGreater(report["counts"]["hexes"], 20)
        self.assertGreater(report["peak_memory_mb"], 1)
        self.assertEqual([stage["name"] for stage in report["stages"]][:2], ["read", "tet"])
        self.assertEqual(report["quality"]["inverted"], 0)
        self.assertAlmostEqual(report["volume"]["mesh"] / report["volume"]["cad"], 1, delta=0.03)
        with open(self.path("a.inp")) as file:
            self.assertIn("TYPE=C3D8,", file.read())

    def test_verbose_logs_seconds(self):
        run = self.run_program("mesh", self.save(box()), "-o", self.path("a.vtu"), "--size", "2", "-v")
        self.assertEqual(run.returncode, 0)
        self.assertRegex(run.stderr, r"fit: \d+\.\d+ s")

    def test_same_input_same_bytes(self):
        part = self.save(plate())
        for name in ("a", "b"):
            self.assertEqual(self.run_program("mesh", part, "-o", self.path(name + ".unv"), "--size", "3", "--threads", "1" if name == "a" else "2").returncode, 0)
        with open(self.path("a.unv"), "rb") as a, open(self.path("b.unv"), "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_bad_options(self):
        part = self.save(box())
        for arguments in (["--size", "0"], ["--size", "-1"], ["--size", "nan"], ["--size", "abc"], ["--size", "100"], ["--size"], ["--order", "3"],
                          ["--nonsense"], ["--hexes", "0"], ["--size", "1", "--hexes", "5"], ["--element-type", "C3D10"], ["--label", "Face99=+X"],
                          ["--label", "Face1=up"], ["--time-limit", "0"], ["--order", "2", "--element-type", "C3D8I"], ["--object", "Box"],
                          ["--report", self.path("none/r.json")]):
            with self.subTest(arguments):
                self.refuses(part, *arguments)
        self.refuses(part, output="a.stl")
        self.refuses(part, output="none/a.inp")

    def test_bad_parts(self):
        with open(self.path("empty.step"), "w"):
            pass
        with open(self.path("text.step"), "w") as file:
            file.write("hello\n")
        with open(self.path("text.FCStd"), "w") as file:
            file.write("hello\n")
        far = Part.makeBox(1, 1, 1, VECTOR(5, 0, 0))
        shapes = {
            "shell.brep": Part.makeShell(box().Faces[:5]),
            "two.brep": Part.makeCompound([box(), far.translated(VECTOR(20, 0, 0))]),
            "face.brep": box().Faces[0],
            "edge.brep": box().Edges[0],
        }
        for name, shape in shapes.items():
            self.save(shape, name)
        for name in ("empty.step", "text.step", "text.FCStd", "missing.step", "missing.FCStd", *shapes):
            with self.subTest(name):
                self.refuses(self.path(name))
        self.assertIn("missing.step", self.refuses(self.path("missing.step")))

    def test_damaged_step_files_do_not_crash(self):
        plate().exportStep(self.path("good.step"))
        with open(self.path("good.step")) as file:
            text = file.read()
        start = text.index("DATA;")
        chance = random.Random(1)
        statuses = collections.Counter()
        for _ in range(25):
            damaged = list(text)
            for _ in range(chance.choice((1, 3, 20))):
                damaged[chance.randrange(start, len(text))] = chance.choice("0123456789 ,;#()")
            with open(self.path("bad.step"), "w") as file:
                file.write("".join(damaged))
            run = self.run_program("mesh", self.path("bad.step"), "-o", self.path("a.vtu"), "--order", "1", "--size", "4")
            statuses[run.returncode] += 1
            self.assertIn(run.returncode, (0, 1, 2), run.stderr)
            if run.returncode:
                self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        self.assertGreater(statuses[1], 10)

    def test_no_arguments(self):
        for arguments in ([], ["mesh"], ["nonsense"], ["mesh", "a.step"]):
            run = self.run_program(*arguments)
            self.assertEqual(run.returncode, 1)
            self.assertEqual(len(run.stderr.strip().splitlines()), 1)

    def test_help(self):
        for arguments in (["--help"], ["mesh", "--help"], ["label", "--help"], ["hex", "--help"]):
            run = self.run_program(*arguments)
            self.assertEqual(run.returncode, 0)
            self.assertIn("Usage", run.stdout)
        self.assertIn("--time-limit", self.run_program("mesh", "--help").stdout)

    def test_time_limit(self):
        self.refuses(self.save(cylinder()), "--time-limit", "0.01", status=3)

    def test_interrupt(self):
        part = self.save(plate())
        process = subprocess.Popen([PROGRAM, "mesh", part, "-o", self.path("a.inp"), "--size", "0.4"], stderr=subprocess.PIPE, text=True)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3, error)
        self.assertEqual(error, "polycube: cancelled\n")
        self.assertEqual(os.listdir(self.folder), ["part.brep"])

    def test_label(self):
        run = self.run_program("label", self.save(cylinder()), "-o", self.path("l.vtu"))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(os.path.getsize(self.path("l.vtu")) > 1000)


class Documents(FolderTest):
    """FreeCAD documents as input."""

    def save_document(self, build):
        document = FreeCAD.newDocument()
        build(document)
        document.recompute()
        document.saveAs(self.path("part.FCStd"))
        FreeCAD.closeDocument(document.Name)

    def mesh(self, *arguments):
        return self.run_program("mesh", self.path("part.FCStd"), "-o", self.path("a.inp"), "--size", "2", "--order", "1", *arguments)

    def points(self):
        with open(self.path("a.inp")) as file:
            rows = file.read().split("*ELEMENT")[0].splitlines()[2:]
        return np.array([[float(x) for x in row.split(",")[1:]] for row in rows])

    @staticmethod
    def cut(document):
        base = document.addObject("Part::Box", "Base")
        tool = document.addObject("Part::Cylinder", "Tool")
        tool.Placement.Base = VECTOR(5, 5, 0)
        result = document.addObject("Part::Cut", "Result")
        result.Base, result.Tool = base, tool
        result.Placement.Base = VECTOR(100, 0, 0)

    def test_the_final_solid_is_taken_where_it_stands(self):
        self.save_document(self.cut)
        run = self.mesh()
        self.assertEqual(run.returncode, 0, run.stderr)
        points = self.points()
        np.testing.assert_allclose([points[:, 0].min(), points[:, 0].max()], [100, 110], atol=1e-6)

    def test_several_solids_need_a_choice(self):
        def build(document):
            document.addObject("Part::Box", "One")
            document.addObject("Part::Box", "Two").Label = "My part"

        self.save_document(build)
        run = self.mesh()
        self.assertEqual(run.returncode, 1)
        self.assertIn("One, Two", run.stderr)
        for name in ("Two", "My part"):
            self.assertEqual(self.mesh("--object", name).returncode, 0)
        self.assertEqual(self.mesh("--object", "Three").returncode, 1)

    def test_a_document_without_a_solid(self):
        self.save_document(lambda document: document.addObject("Part::Plane", "Plane"))
        self.assertEqual(self.mesh().returncode, 1)
        self.save_document(lambda document: document.addObject("App::DocumentObjectGroup", "Group"))
        run = self.mesh()
        self.assertEqual(run.returncode, 1)
        self.assertIn("no object", run.stderr)


if __name__ == "__main__":
    unittest.main()
