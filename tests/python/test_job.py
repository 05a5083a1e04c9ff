"""Jobs: a folder, lines on standard output, files; the same from the program and from a Python that has the module."""

import json
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
from support import BUILD, PROGRAM, REPO, FolderTest, box, cylinder

import _polycube

WORKBENCH = os.path.join(REPO, "Mod", "Polycube", "freecad", "polycube")
MESHERS = {
    "program": [PROGRAM, "serve-job"],
    "module": [sys.executable, os.path.join(WORKBENCH, "worker.py")],
}
ENVIRONMENT = dict(os.environ, PYTHONPATH=os.path.join(BUILD, "python"))


class JobTest(FolderTest):
    def job(self, shape, name="job", **options):
        """A folder with a job to do."""
        folder = self.path(name)
        shutil.rmtree(folder, ignore_errors=True)
        os.mkdir(folder)
        with open(os.path.join(folder, "shape.brep"), "w", encoding="ascii") as file:
            file.write(shape if isinstance(shape, str) else shape.exportBrepToString())
        with open(os.path.join(folder, "options.json"), "w", encoding="ascii") as file:
            json.dump(options, file)
        return folder

    def serve(self, mesher, folder, kind="mesh", **environment):
        """Status and messages; each line has to be one."""
        run = subprocess.run([*MESHERS[mesher], folder, kind], capture_output=True, text=True, timeout=300, env=dict(ENVIRONMENT, TMPDIR=folder, **environment))
        self.assertEqual(run.stderr, "")
        return run.returncode, [json.loads(line) for line in run.stdout.splitlines()]

    @staticmethod
    def plain(folder, name):
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return json.load(file)


class Results(JobTest):
    def test_a_mesh_is_that_of_the_module(self):
        given = {"size": 2.5, "labels": {}, "keep_faces": "Face1", "threads": 1}
        wanted = _polycube.mesh(brep=cylinder().exportBrepToString(), **given)
        for mesher in MESHERS:
            with self.subTest(mesher):
                folder = self.job(cylinder(), **given)
                status, messages = self.serve(mesher, folder)
                self.assertEqual(status, 0)
                self.assertEqual(set(os.listdir(folder)), {"shape.brep", "options.json", "result.npz", "report.json"})
                stages = [message["progress"][0] for message in messages if "progress" in message]
                self.assertEqual(stages[0], "tet")
                self.assertEqual(stages[-1], "fem")
                self.assertTrue(any("log" in message for message in messages))
                with np.load(os.path.join(folder, "result.npz"), allow_pickle=False) as arrays:
                    names = set(arrays.files)
                    for name in names:
                        if name.startswith("group/"):
                            _, group, what = name.split("/")
                            array = wanted.groups[group][what]
                        else:
                            array = getattr(wanted, name)
                        np.testing.assert_array_equal(arrays[name], array, name)
                        self.assertEqual(arrays[name].dtype, array.dtype, name)
                whole = wanted.to_dict()
                groups = {"group/{}/{}".format(group, what) for group, parts in whole.pop("groups").items() for what in parts}
                self.assertEqual(names, groups | (set(whole) - {"order", "report"}))
                report = self.plain(folder, "report.json")
                self.assertEqual(report["options"], wanted.report["options"])
                self.assertEqual(report["quality"], wanted.report["quality"])

    def test_labels_are_those_of_the_module(self):
        wanted = _polycube.labels(brep=box().exportBrepToString(), frame=((0, 1, 0), (-1, 0, 0)))
        for mesher in MESHERS:
            with self.subTest(mesher):
                folder = self.job(box(), frame=[[0, 1, 0], [-1, 0, 0]])
                status, _ = self.serve(mesher, folder, "labels")
                self.assertEqual(status, 0)
                plain = self.plain(folder, "labels.json")
                self.assertEqual(plain["valid"], wanted["valid"])
                self.assertEqual({int(face): label for face, label in plain["face_label"].items()}, wanted["face_label"])
                self.assertEqual({int(edge): tuple(fate) for edge, fate in plain["edges"].items()}, wanted["edges"])
                with np.load(os.path.join(folder, "labels.npz"), allow_pickle=False) as arrays:
                    self.assertEqual(set(arrays.files), set(wanted) - {"valid", "face_label", "edges"})
                    for name in arrays.files:
                        np.testing.assert_array_equal(arrays[name], wanted[name], name)


class Errors(JobTest):
    def fails(self, folder, status, kind, pattern, job="mesh", **environment):
        kept = set(os.listdir(folder))
        for mesher in MESHERS:
            with self.subTest(mesher):
                self.assertEqual(self.serve(mesher, folder, job, **environment)[0], status)
                self.assertEqual(set(os.listdir(folder)), kept | {"error.json"})
                error = self.plain(folder, "error.json")
                self.assertEqual(error["kind"], kind)
                self.assertRegex(error["message"], pattern)
                os.remove(os.path.join(folder, "error.json"))
        return error

    def test_bad_input(self):
        self.fails(self.job(box(), size=0), 1, "InvalidInput", r"\A--size must be greater than 0\Z")
        self.fails(self.job(box(), colour=1), 1, "InvalidInput", "colour")
        for job in ("mesh", "labels"):
            self.fails(self.job(box(), labels={"Face9": "+X"}), 1, "InvalidInput", "Face9 does not exist", job)
            self.fails(self.job("nonsense"), 1, "InvalidInput", ".", job)
        folder = self.job(box())
        os.remove(os.path.join(folder, "shape.brep"))
        self.fails(folder, 1, "InvalidInput", "shape.brep cannot be read")
        for wrong in ("nonsense", "[1, 2]", "{}"):
            folder = self.job(box())
            with open(os.path.join(folder, "solids.json"), "w", encoding="ascii") as file:
                file.write(wrong)
            self.fails(folder, 1, "InvalidInput", "solids.json is no list of texts")

    def test_a_stage_that_fails(self):
        error = self.fails(self.job(box()), 2, "StageFailed", ".", POLYCUBE_TET_WORKER="/bin/false")
        self.assertEqual(error["stage"], "tet")
        self.assertIsInstance(error["entities"], list)

    def test_enough_without_a_mesh(self):
        """With one it is handed out, as at a time limit: tests/unit/pipeline/search_test.cpp."""
        for mesher in MESHERS:
            folder = self.job(cylinder(), size=0.05)
            with open(os.path.join(folder, "enough"), "w", encoding="ascii"):
                pass
            status, _ = self.serve(mesher, folder)
            self.assertEqual((status, self.plain(folder, "error.json")), (3, {"kind": "Cancelled", "message": "stopped by the user"}))

    def test_out_of_time(self):
        self.fails(self.job(cylinder(), time_limit=0.01), 3, "Cancelled", "time")

    def test_arguments_of_the_program(self):
        for arguments in ([], [self.path("missing")], [self.folder, "both"]):
            run = self.run_program("serve-job", *arguments)
            self.assertEqual(run.returncode, 1)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)

    def test_version(self):
        for command in MESHERS.values():
            run = subprocess.run([*command, "--version"], capture_output=True, text=True, env=ENVIRONMENT)
            self.assertEqual((run.returncode, run.stdout.strip()), (0, _polycube.__version__))


class Process(JobTest):
    def test_leads_a_group_and_ends_with_its_parent(self):
        stuck = self.path("stuck")
        with open(stuck, "w", encoding="ascii") as file:
            file.write("#!/bin/sh\nexec sleep 60\n")
        os.chmod(stuck, 0o700)
        for mesher, command in MESHERS.items():
            with self.subTest(mesher):
                folder = self.job(box())
                parent = subprocess.Popen(
                    ["sh", "-c", '"$@" & echo $! >&2; read -r line', "sh", *command, folder],
                    stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=dict(ENVIRONMENT, POLYCUBE_TET_WORKER=stuck),
                )
                engine = int(parent.stderr.readline())
                self.assertIn("progress", json.loads(parent.stdout.readline()))
                self.assertEqual(os.getpgid(engine), engine)
                parent.stdin.close()  # the shell ends
                parent.stdout.read()  # to the end of the engine, which holds it open
                parent.wait()
                parent.stdout.close()
                parent.stderr.close()
                self.assertFalse(os.path.exists(folder), "nobody removes it any more")


class Description(FolderTest):
    def test_the_workbench_has_it_as_the_program_gives_it(self):
        with open(os.path.join(WORKBENCH, "engine.json"), encoding="utf-8") as file:
            kept = file.read()
        self.assertEqual(kept, self.run_program("describe").stdout, "sh resources/polycube build renews it")

    def test_it_is_that_of_the_module(self):
        given = json.loads(self.run_program("describe").stdout)
        self.assertEqual(given["options"], _polycube.options())
        self.assertEqual(given["label_names"], _polycube.LABEL_NAMES)
        self.assertEqual([tuple(colour) for colour in given["label_colours"]], _polycube.LABEL_COLOURS)
        self.assertEqual(given["smesh_hex20"], _polycube.SMESH_HEX20.tolist())


if __name__ == "__main__":
    unittest.main()
