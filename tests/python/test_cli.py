"""The command line: exit statuses, messages, files, cancel."""

import collections
import colorsys
import json
import os
import random
import re
import signal
import subprocess
import sys
import time
import unittest

import matplotlib
import meshio
import numpy as np
from support import PROGRAM, REPO, VECTOR, FolderTest, Part, box, chamfered, cylinder, plate

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (after the choice of what draws)


class Cli(FolderTest):
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
                          ["--size", "0.001"], ["--size", "1e-300"], ["--divisions", "Edge1=1000000", "--divisions", "Edge2=1000000"],
                          ["--keep-faces", "Face7"], ["--feature-angle", "181"], ["--report", self.path("none/r.json")]):
            with self.subTest(arguments):
                self.refuses(part, *arguments)
        self.refuses(part, output="a.stl")
        self.refuses(part, output="none/a.inp")

    def test_tuning_of_a_trial(self):
        """It reaches the process that meshes; what is no value is told in one line."""
        part = self.save(box())
        arguments = [PROGRAM, "mesh", part, "-o", self.path("a.inp"), "--order", "1"]

        def run(tuning):
            return subprocess.run(arguments, capture_output=True, text=True, env={**os.environ, "POLYCUBE_TUNING": tuning})
        cells = [int(re.search(r"(\d+) hexahedra", run(tuning).stdout).group(1)) for tuning in ("", "core.layers_of_first_order=5,core.sizes_per_diagonal=15")]
        self.assertNotEqual(*cells)
        self.assertRegex(run("label.snap=0.25").stderr, r"\Apolycube: warning: .*label.snap=0.25\n\Z")
        for tuning in ("label.snip=0.2", "label.snap", "label.snap=much", "label.samples=2.5", "label.samples=-1", "snap=1"):
            with self.subTest(tuning):
                done = run(tuning)
                self.assertEqual((done.returncode, done.stderr.count("\n"), done.stdout), (1, 1, ""))
        listed = subprocess.run([PROGRAM, "describe", "--tuning"], capture_output=True, text=True, check=True)
        self.assertEqual(json.loads(listed.stdout)["label.compactness.1"], 0.3)

    def test_hex_writes_medit_and_vtu_only(self):
        done = subprocess.run([PROGRAM, "hex", "--tets", "a", "--labels", "b", "--map", "c", "-o", self.path("a.inp")], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1))
        self.assertIn("suffix", done.stderr)

    def test_bad_parts(self):
        with open(self.path("empty.step"), "w"):
            pass
        with open(self.path("text.step"), "w") as file:
            file.write("hello\n")
        with open(self.path("text.FCStd"), "w") as file:
            file.write("hello\n")
        overlapping = Part.makeBox(4, 4, 4, VECTOR(1, 1, 1))
        shapes = {
            "shell.brep": Part.makeShell(box().Faces[:5]),
            "overlapping.brep": Part.Compound([box(), overlapping]),
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
            self.assertNotIn("ended by signal", run.stderr)
            if run.returncode:
                self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        self.assertGreater(statuses[1], 10)

    def test_files_that_are_cut_off_are_told_from_other_files(self):
        plate().exportStep(self.path("whole.step"))
        with open(self.path("whole.step")) as file:
            text = file.read()
        for name, content, said in (("cut.step", text[: len(text) // 2], "damaged or cut off"), ("other.step", "not this\n", "not a STEP file")):
            with self.subTest(name):
                with open(self.path(name), "w") as file:
                    file.write(content)
                self.assertIn(said, self.refuses(self.path(name)))

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
        self.assertIn("Face3_Surface", self.run_program("mesh", "--help").stdout)

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

    def test_a_terminal_that_closes(self):
        part = self.save(plate())
        temporary = os.path.join(self.folder, "tmp")
        os.mkdir(temporary)
        process = subprocess.Popen(
            [PROGRAM, "mesh", part, "-o", self.path("a.inp"), "--size", "0.4"],
            stderr=subprocess.PIPE,
            text=True,
            env=dict(os.environ, TMPDIR=temporary),
            preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL),  # under nohup it is ignored, and that is inherited
        )
        while not os.listdir(temporary):
            time.sleep(0.01)
        process.send_signal(signal.SIGHUP)
        _, error = process.communicate(timeout=60)
        self.assertEqual((process.returncode, error), (3, "polycube: cancelled\n"))
        self.assertEqual(os.listdir(temporary), [])

    def test_stopped_before_the_engine_began(self):
        """The temporary folder is made just before the engine's process is: some of these signals come in between."""
        part = self.save(plate())
        temporary = os.path.join(self.folder, "tmp")
        os.mkdir(temporary)
        for _ in range(40):
            process = subprocess.Popen(
                [PROGRAM, "mesh", part, "-o", self.path("a.inp"), "--size", "0.4"],
                stderr=subprocess.PIPE,
                text=True,
                env=dict(os.environ, TMPDIR=temporary),
            )
            while not os.listdir(temporary):
                pass
            process.send_signal(signal.SIGTERM)
            _, error = process.communicate(timeout=60)
            self.assertEqual((process.returncode, error), (3, "polycube: cancelled\n"))

    def test_nobody_reads_what_is_printed(self):
        reading, writing = os.pipe()
        os.close(reading)
        run = subprocess.run([PROGRAM, "mesh", self.save(box()), "-o", self.path("a.inp"), "-v"], stdout=writing, stderr=writing)
        os.close(writing)
        self.assertEqual(run.returncode, 0)
        self.assertTrue(os.path.exists(self.path("a.inp")))

    def test_no_file_is_written_over(self):
        part = self.save(box())
        with open(part) as file:
            before = file.read()
        self.refuses(part, "--report", part)
        self.assertIn("written twice", self.refuses(part, "--report", self.path("out.inp")))
        self.assertIn("no regular file", self.refuses(part, "--report", "/dev/null"))
        os.symlink(part, self.path("link.json"))
        self.assertIn("written over", self.refuses(part, "--report", self.path("link.json")))
        with open(part) as file:
            self.assertEqual(file.read(), before)
        self.assertEqual(sorted(os.listdir(self.folder)), ["link.json", "part.brep"])

    def test_a_link_is_followed(self):
        with open(self.path("real.inp"), "w"):
            pass
        os.symlink(self.path("real.inp"), self.path("a.inp"))
        self.assertEqual(self.run_program("mesh", self.save(box()), "-o", self.path("a.inp")).returncode, 0)
        self.assertTrue(os.path.islink(self.path("a.inp")))
        self.assertGreater(os.path.getsize(self.path("real.inp")), 1000)

    def test_no_place_for_temporary_files(self):
        run = subprocess.run(
            [PROGRAM, "mesh", self.save(box()), "-o", self.path("a.inp")], capture_output=True, text=True, env=dict(os.environ, TMPDIR=self.path("nowhere"))
        )
        self.assertEqual((run.returncode, run.stderr), (1, "polycube: the folder for temporary files, TMPDIR, does not exist\n"))

    def test_label_files(self):
        part = self.save(cylinder())
        run = self.run_program("label", part, "-o", self.path("l.vtu"), "-o", self.path("l.png"), "--report", self.path("l.json"), "--pixels", "400", "--numbers")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertRegex(run.stdout, "valid, 0 turning points, 6 charts, 8 corners, CAD edges 2 on boundaries 0 with feature charts 0 not captured")
        with open(self.path("l.json")) as file:
            report = json.load(file)
        self.assertEqual((report["valid"], report["monotone"], report["map"]), (True, True, "made"))
        self.assertEqual(report["edges"], {"total": 2, "boundary": 2, "feature": 0, "lost": []})
        self.assertEqual(sorted(report["faces"]), ["Face1", "Face2", "Face3"])
        self.assertEqual([stage["name"] for stage in report["stages"]], ["tet", "label", "deform"])
        grid = meshio.read(self.path("l.vtu"))
        data = {name: np.concatenate([np.ravel(block) for block in blocks]) for name, blocks in grid.cell_data.items()}
        triangles = data["kind"] == 0
        self.assertEqual(set(data["label"][triangles]), set(range(6)))
        self.assertEqual(set(data["chart"][triangles]), set(range(6)))
        self.assertEqual(set(data["face"][triangles]), {1, 2, 3})
        self.assertEqual((data["kind"] == 5).sum(), 8)
        # Charts are planes of the map.
        for label, chart in {(a, b) for a, b in zip(data["label"][triangles], data["chart"][triangles])}:
            nodes = np.unique(grid.cells_dict["triangle"][data["chart"][triangles] == chart])
            self.assertLess(np.ptp(grid.point_data["g"][nodes, label // 2]), 1e-9 * np.ptp(grid.points))

    def test_label_picture(self):
        self.assertEqual(self.run_program("label", self.save(box()), "-o", self.path("l.png"), "--pixels", "400").returncode, 0)
        image = pyplot.imread(self.path("l.png"))
        self.assertEqual(image.shape[1], 400)
        # Each of the six labels covers a part of the picture that is not the key at its top.
        body = np.round(255 * image[20:, :, :3]).reshape(-1, 3)
        hues = [colorsys.rgb_to_hsv(*(c / 255 for c in colour))[0] for colour in ((236, 106, 94), (90, 200, 205), (118, 196, 92), (214, 122, 208), (100, 140, 235), (240, 205, 90))]
        found = np.array([colorsys.rgb_to_hsv(*(pixel / 255))[0] for pixel in body if np.ptp(pixel) > 60])
        for hue in hues:
            self.assertGreater((np.abs(found - hue) < 0.02).sum(), 500)

    def test_label_refuses(self):
        part = self.save(box())
        for arguments in (["-o", self.path("l.stl")], ["-o", self.path("none/l.png")], ["--pixels", "5"], ["--frame", "1,0,0"], ["--frame", "1,0,0/1,0,0"],
                          ["--label", "Face1=+X", "--frame", "1,0,0/0,1,0"], ["--label", "Face1=+Y"]):
            with self.subTest(arguments):
                run = self.run_program("label", part, *arguments)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        self.assertEqual(os.listdir(self.folder), ["part.brep"])

    def test_steering(self):
        part = self.save(chamfered())
        (face,) = (f"Face{i}" for i, face in enumerate(chamfered().Faces, 1) if abs(face.normalAt(0, 0).x) > 0.1 and abs(face.normalAt(0, 0).z) > 0.1)
        for axis in ("+X", "+Z"):
            run = self.run_program("label", part, "--label", f"{face}={axis}", "--report", self.path("l.json"))
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(self.path("l.json")) as file:
                self.assertEqual(json.load(file)["faces"][face], axis)
        # In a frame with X and Z exchanged the same face has the other name.
        run = self.run_program("mesh", part, "-o", self.path("a.inp"), "--frame", "0,0,1/0,-1,0", "--label", f"{face}=-Y")
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, f"{face} cannot be -Y, it does not face that way; it can be \\+X or \\+Z")
        run = self.run_program("mesh", part, "-o", self.path("a.inp"), "--frame=-1,0,0/0,-1,0", "--label", f"{face}=-X", "--order", "1")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_page_of_labels(self):
        self.save(box(), "one.brep")
        cylinder().exportIges(self.path("one.iges"))
        script = os.path.join(REPO, "tests", "benchmarks", "label_page.py")
        for page in ("page.html", "page.png"):
            run = subprocess.run([sys.executable, script, PROGRAM, self.folder, "-o", self.path(page), "--", "--pixels", "200"], capture_output=True, text=True)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("2 parts: 2 labelled, 2 valid, 2 valid and monotone; of 14 CAD edges 14 are chart boundaries", run.stdout)
        with open(self.path("page.html")) as file:
            self.assertEqual(len(set(re.findall('<img src="[^"]*"', file.read()))), 2)
        self.assertEqual(pyplot.imread(self.path("page.png")).ndim, 3)
        with open(self.path("three|four.brep"), "w") as file:
            file.write("nothing")
        run = subprocess.run([sys.executable, script, PROGRAM, self.path("three|four.brep")], capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("| three\\|four | ", run.stdout)


if __name__ == "__main__":
    unittest.main()
