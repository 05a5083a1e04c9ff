"""The command `sweep`: goes on where it was stopped, takes whatever answer a part gives, judges, makes its page."""

import errno
import glob
import json
import os
import signal
import subprocess
import sys
import time
import unittest

import meshio
import numpy as np
from support import PROGRAM, REPO, FolderTest, box, cylinder, plate

SCRIPTS = os.path.join(REPO, "resources", "sweep")
SWEEP = os.path.join(SCRIPTS, "sweep.py")
sys.path.insert(0, SCRIPTS)
import picture  # noqa: E402
MESH = ("--order", "1", "--hexes", "60")

# Answers as no part gives them at will: by its name the part is the program's undoing.
PROGRAM_THAT_FAILS = """#!/bin/sh
case $2 in
*/crash.*) kill -SEGV $$ ;;
*/limit.*) kill -XCPU $$ ;;
*/endless.*) while :; do :; done ;;
*/refused.*) echo 'polycube: stage label: no way out (Face3, Edge12)' >&2; exit 2 ;;
*/late.*) echo 'polycube: out of time' >&2; exit 3 ;;
esac
exec {} "$@"
"""

# Waits at its third and its sixth mesh, for the first line of a fifo and no longer than a minute.
PROGRAM_THAT_WAITS = """#!/bin/sh
case $2 in
parts/*)
    echo "$2" >> {folder}/starts
    case $(wc -l < {folder}/starts) in
    3 | 6) timeout --foreground 60 head -n 1 {folder}/fifo ;;
    esac
    ;;
esac
exec {program} "$@"
"""

# In the place of polycube-tet: what a bug or a limit would do to the engine, its parent.
WORKER = """#!/bin/sh
kill -{} $PPID
while kill -0 $PPID 2> {}; do sleep 0.1; done
"""

JUDGE = """#!/bin/sh
case $1 in
*wrong*) echo '{"valid": false, "faces": 0.5}' ;;
*silent*) echo 'no such thing' >&2; exit 1 ;;
*) echo '{"valid": true, "vertices": 1, "sharp_edges": 1, "faces": 0.9}' ;;
esac
"""


def children(pid):
    with open("/proc/{0}/task/{0}/children".format(pid), encoding="ascii") as file:
        return [int(number) for number in file.read().split()]


class SweepTest(FolderTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("parts"))
        self.page, self.work = self.path("page.html"), self.path("page.sweep")

    def add(self, shape, *names):
        for name in names:
            self.save(shape, os.path.join("parts", name))

    def script(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(self.path(name), 0o755)
        return self.path(name)

    def command(self, *arguments, program=PROGRAM):
        return [sys.executable, SWEEP, program, self.path("parts"), "-o", self.page, "--jobs", "1", *arguments]

    def sweep(self, *arguments, status=0, **settings):
        run = subprocess.run(self.command(*arguments, **settings), capture_output=True, text=True)
        self.assertEqual(run.returncode, status, run.stderr + self.log())
        return run

    def log(self):
        path = os.path.join(self.work, "snakemake.log")
        if not os.path.exists(path):
            return ""
        with open(path, encoding="utf-8") as file:
            return file.read()

    def results(self):
        """Key -> when its result was written."""
        paths = glob.glob(os.path.join(self.work, "results", "*.json"))
        return {os.path.basename(path)[:-len(".json")]: os.stat(path).st_mtime_ns for path in paths}

    def row(self, key, kind="results"):
        with open(os.path.join(self.work, kind, key + ".json"), encoding="utf-8") as file:
            return json.load(file)

    def text(self, path=None):
        with open(path or self.page, encoding="utf-8") as file:
            return file.read()

    def working(self):
        """Processes whose folder is the sweep's."""
        found = []
        for link in glob.glob("/proc/[0-9]*/cwd"):
            try:
                inside = os.readlink(link).startswith(os.path.realpath(self.work))
            except OSError:  # it has ended, or is a zombie
                continue
            if inside:
                found.append(int(link.split("/")[2]))
        return found


class GoesOn(SweepTest):
    def stop_at_wait(self, program, stop):
        """Starts the sweep and calls stop(process) once the program waits. Returns what the process says."""
        process = subprocess.Popen(
            self.command(*MESH, program=program), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN),  # as what a shell starts in the background
        )
        fifo = None
        while fifo is None and process.poll() is None:
            try:
                fifo = os.open(self.path("fifo"), os.O_WRONLY | os.O_NONBLOCK)
            except OSError as error:
                self.assertEqual(error.errno, errno.ENXIO)  # nobody reads
                time.sleep(0.01)
        self.assertIsNone(process.poll(), "the sweep ended by itself")
        self.addCleanup(os.close, fifo)  # until then the program waits
        stop(process)
        output = process.communicate(timeout=60)
        for _ in range(1000):
            if not self.working():
                break
            time.sleep(0.01)
        self.assertEqual(self.working(), [], "processes are left")
        return output

    def test_killed_in_the_middle(self):
        for k in range(7):
            self.add((box, cylinder, plate)[k % 3](), "part_{}.brep".format(k))
        os.mkfifo(self.path("fifo"))
        program = self.script("program", PROGRAM_THAT_WAITS.format(program=PROGRAM, folder=self.folder))

        _, errors = self.stop_at_wait(program, lambda process: process.send_signal(signal.SIGTERM))
        self.assertIn("stopped", errors)
        self.assertEqual(len(errors.splitlines()), 1, errors)
        after_stop = self.results()
        self.assertEqual(len(after_stop), 2)
        self.assertFalse(os.path.exists(self.page))

        def kill(process):
            workflow = children(process.pid)
            self.assertEqual(len(workflow), 1)
            os.killpg(workflow[0], signal.SIGKILL)  # a session of its own
            process.kill()

        self.stop_at_wait(program, kill)
        after_kill = self.results()
        self.assertEqual(len(after_kill), 4)
        self.assertFalse(os.path.exists(self.page))

        run = self.sweep(*MESH, program=program)
        last = self.results()
        self.assertEqual(len(last), 7)
        for key, written in {**after_stop, **after_kill}.items():
            self.assertEqual(last[key], written, key + " was made twice")
        self.assertEqual(len(self.text(self.path("starts")).splitlines()), 7 + 2)
        lines = run.stdout.splitlines()
        self.assertEqual(len(lines), 3 + 1, run.stdout)
        self.assertEqual(lines[-1], self.page + ": 7 parts: 7 complete")
        page = self.text()
        self.assertEqual(page.count("<img src='data:image/webp;base64,"), 7)
        self.assertNotIn("http", page.split("base64,")[0])

        # All is there: nothing is made again, until a part, an option or the program is another.
        self.assertEqual(len(self.sweep(*MESH, program=program).stdout.splitlines()), 1)
        self.assertEqual(self.results(), last)
        self.add(box(), "part_1.brep")
        self.assertEqual(len(self.sweep(*MESH, program=program).stdout.splitlines()), 2)
        self.assertEqual({key for key, written in self.results().items() if last[key] != written}, {"part_1.brep"})

    def test_other_options_other_results(self):
        self.add(box(), "box.brep")
        self.sweep(*MESH)
        first = self.row("box.brep")["report"]["counts"]["hexes"]
        self.sweep("--order", "1", "--size", "0.5")
        self.assertGreater(self.row("box.brep")["report"]["counts"]["hexes"], 2 * first)


class Answers(SweepTest):
    def test_whatever_comes(self):
        self.add(plate(), "a plate {1} ä.brep", "good.brep", "crash.brep", "limit.brep", "refused.brep", "late.brep")
        self.script(os.path.join("parts", "text.step"), "hello\n")
        self.script(os.path.join("parts", "notes.txt"), "no part\n")
        program = self.script("program", PROGRAM_THAT_FAILS.format(PROGRAM))
        run = self.sweep(*MESH, program=program, status=2)
        self.assertEqual(len(run.stdout.splitlines()), 8, run.stdout)
        self.assertIn("7 parts: 2 complete, 1 refused, 1 bad input, 1 out of time, 1 no answer, 1 crash", run.stdout)
        self.assertEqual([self.row(name + ".brep")["exit"] for name in ("good", "crash", "limit", "refused", "late")], [0, None, None, 2, 3])
        self.assertEqual(self.row("crash.brep")["reason"], "crash: signal 11 (Segmentation fault)")
        self.assertEqual(self.row("refused.brep")["reason"], "stage label: no way out (Face3, Edge12)")
        good = self.row("good.brep")
        self.assertGreater(good["memory_mb"], 1)
        self.assertGreater(good["seconds"], 0)
        page = self.text()
        for text in ("a plate {1} ä.brep", "Segmentation fault", "no way out (Face3, Edge12)", "7/7"):
            self.assertIn(text, page)

        self.page = self.path("page.md")  # the same results
        self.sweep(*MESH, program=program, status=2)
        table = self.text()
        self.assertIn("| crash.brep | crash |  | - |", table)
        self.assertEqual(sum(line.startswith("| ") for line in table.splitlines()), 8)

    def test_processor_limit(self):
        self.add(box(), "endless.brep")
        run = self.sweep(*MESH, "--cpu-limit", "0.5", program=self.script("program", PROGRAM_THAT_FAILS.format(PROGRAM)))
        self.assertIn("1 parts: 1 no answer", run.stdout)
        self.assertIn("more processor time than the limit", self.row("endless.brep")["reason"])
        self.assertGreater(self.row("endless.brep")["cpu_seconds"], 0.9)

    def mesh_part(self, program, *limits, **environment):
        """The row that mesh_part.py makes of a box."""
        part, result, mesh = self.save(box()), self.path("result.json"), self.path("mesh.vtu")
        run = subprocess.run([sys.executable, os.path.join(SCRIPTS, "mesh_part.py"), program, part, result, mesh, *limits], capture_output=True, text=True,
                             env=dict(os.environ, **environment), timeout=300)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(os.path.getsize(mesh), 0)
        with open(result, encoding="utf-8") as file:
            return json.load(file)

    def test_an_engine_that_a_signal_ends(self):
        """The program itself ends well then, with a line."""
        for name, word in (("SEGV", "crash"), ("ABRT", "crash"), ("XCPU", "no answer"), ("KILL", "no answer")):
            with self.subTest(name):
                row = self.mesh_part(PROGRAM, "0", "0", POLYCUBE_TET_WORKER=self.script("worker", WORKER.format(name, os.devnull)))
                self.assertEqual((row["result"], row["exit"]), (word, 2))
                self.assertRegex(row["reason"], r"\Astage tet: the engine ended by signal {} ".format(int(getattr(signal, "SIG" + name))))

    def test_a_program_that_keeps_no_limit_is_killed(self):
        row = self.mesh_part(self.script("program", "#!/bin/sh\nexec sleep 60\n"), "0.1", "0")
        self.assertEqual((row["result"], row["exit"], row["reason"]), ("no answer", None, "killed: it did not end at the time limit"))

    def test_verdicts(self):
        self.add(box(), "box_1.brep", "box_2_wrong.brep", "silent.brep")
        run = self.sweep(*MESH, "--judge", self.script("judge", JUDGE), status=2)
        self.assertIn("3 parts: 1 complete, 1 valid, 1 INVALID", run.stdout)
        self.assertEqual(self.row("box_1.brep", "verdicts")["verdict"], "valid")
        self.assertIn("no such thing", self.row("silent.brep", "verdicts")["verdict"])
        self.assertIn("judge: INVALID", run.stdout)
        self.assertIn("<td>complete</td><td>INVALID</td>", self.text())

        run = self.sweep(*MESH)  # what the judge said is there still, but nobody asks
        self.assertEqual(run.stdout, self.page + ": 3 parts: 3 complete\n")
        self.assertNotIn("<td>INVALID</td>", self.text())

    def test_bad_arguments(self):
        self.add(box(), "box.brep")
        os.mkdir(self.path("empty"))
        sweep, parts = [sys.executable, SWEEP, PROGRAM], self.path("parts")
        for arguments in ([self.path("empty"), "-o", self.page], [self.path("none"), "-o", self.page], [parts, "-o", self.path("page.png")],
                          [parts, "-o", "/proc/page.html"], [parts, "-o", self.page, "--sise", "3"],
                          [parts, "-o", self.page, "--order", "3"], [parts, "-o", self.page, "--judge", self.path("none")], [parts, "-o", self.page, "--jobs", "0"],
                          [parts, "-o", self.page, "--time-limit", "-1"], [parts], ["-o", self.page, parts], []):
            with self.subTest(arguments):
                run = subprocess.run([*sweep, *arguments], capture_output=True, text=True)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
                self.assertTrue(run.stderr.startswith("polycube: "), run.stderr)
                self.assertEqual(sorted(os.listdir(self.folder)), ["empty", "parts"])


class Picture(FolderTest):
    def test_an_edge_too_short_to_draw_is_left_out_of_the_picture(self):
        class Edge:
            Degenerated = False
            Length = 2e-8

            def __init__(self, points):
                self.points = points

            def discretize(self, _):
                if not self.points:
                    raise picture.Part.OCCError("Discretization of edge failed")
                return self.points

        class Shape:
            Edges = [Edge([]), Edge([(0, 0, 0), (1, 0, 0)])]

        scene = picture.Scene(1.0, False)
        picture.add_edges(scene, Shape, set(), 1.0)
        self.assertEqual(len(scene.lines), 1)

    def test_bad_cells(self):
        """Of 3 x 3 x 3 cells that in the middle and one at the boundary are bad: a dot inside, one red quad for each side outside."""
        x = np.arange(4)
        points = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)

        def cell(i, j, k):
            return [16 * a + 4 * b + c for a, b, c in ((i, j, k), (i + 1, j, k), (i + 1, j + 1, k), (i, j + 1, k), (i, j, k + 1), (i + 1, j, k + 1), (i + 1, j + 1, k + 1), (i, j + 1, k + 1))]

        places = [(i, j, k) for i in range(3) for j in range(3) for k in range(3)]
        hexes = np.array([cell(*place) for place in places])
        quality = np.array([0.1 if place in ((1, 1, 1), (1, 1, 0)) else 1.0 for place in places])
        sides = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
        outside = [(h, side) for h in range(27) for side in sides if any(np.isin(np.ptp(points[hexes[h][side]], axis=0), 0) &
                                                                         np.isin(points[hexes[h][side]].mean(axis=0), (0, 3)))]
        self.assertEqual(len(outside), 54)
        quads, quad_quality = np.array([hexes[h][side] for h, side in outside]), np.array([quality[h] for h, _ in outside])
        meshio.Mesh(points.astype(float), [("hexahedron", hexes), ("quad", quads)],
                    cell_data={"ScaledJacobian": [quality, quad_quality]}).write(self.path("mesh.vtu"))
        scene = picture.mesh_scene(None, self.path("mesh.vtu"), {})
        np.testing.assert_allclose(scene.dots, [[1.5, 1.5, 1.5]])
        marked = [facet.mean(axis=0) for facet, colour in zip(scene.facets, scene.facet_colours) if tuple(colour) != picture.STEEL]
        np.testing.assert_allclose(marked, [[1.5, 1.5, 0]])

    def test_reads_what_the_mesher_writes(self):
        for order in ("1", "2"):
            run = self.run_program("mesh", self.save(plate()), "-o", self.path("mesh.vtu"), "--size", "4", "--order", order, "--report", self.path("r.json"))
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(self.path("r.json"), encoding="utf-8") as file:
                report = json.load(file)
            _, hexes, quality, quads, quad_quality = picture.read_mesh(self.path("mesh.vtu"))
            self.assertEqual((hexes.shape, quads.shape[1]), ((report["counts"]["hexes"], 8), 4))
            self.assertEqual((len(quality), len(quad_quality)), (len(hexes), len(quads)))
            self.assertAlmostEqual(quality.min(), report["quality"]["min_scaled_jacobian"], delta=1e-6)


class Cluster(SweepTest):
    def test_jobs_go_through_a_profile(self):
        """The queue is a script that runs what it is given: every mesh must come by way of it."""
        self.add(box(), "box.brep")
        queue = self.script("queue", "#!/bin/sh\necho \"$*\" >> {}\nsh \"$1\" > /dev/null 2>&1\necho 1\n".format(self.path("queue.log")))
        os.mkdir(self.path("profile"))
        self.script(os.path.join("profile", "config.yaml"), "cluster: {}\nlatency-wait: 60\n".format(queue))
        run = self.sweep(*MESH, "--profile", self.path("profile"))
        self.assertIn("1 parts: 1 complete", run.stdout)
        self.assertEqual(sum("mesh" in line for line in self.text(self.path("queue.log")).splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
