"""Set-up on more than one system, and what happens where the solver is missing."""

import os
import subprocess
import unittest
from unittest import mock

from support import REPO, FolderTest, ccx

LISTS = os.path.join(REPO, "resources", "packages")


def packages(name):
    with open(os.path.join(LISTS, name), encoding="ascii") as file:
        return file.read().splitlines()


class Packages(unittest.TestCase):
    def test_every_system_gets_the_same_but_for_the_solver(self):
        """And for what judges the sources, in the version of the one system."""
        lists = {name: packages(name) for name in os.listdir(LISTS)}
        self.assertEqual(set(lists), {"debian-12.txt", "debian-13.txt"})
        for name, listed in lists.items():
            self.assertEqual(listed, sorted(set(listed)), name)
        self.assertEqual(set(lists["debian-12.txt"]) ^ set(lists["debian-13.txt"]), {"calculix-ccx", "clang-format", "clang-tidy"})

    def test_a_tree_of_an_unknown_system_is_refused(self):
        for arguments in (["--on"], ["--on", "debian-1"], ["--On", "debian-13"]):
            run = subprocess.run(["sh", os.path.join(REPO, "resources", "polycube"), "test", *arguments], capture_output=True, text=True, timeout=60)
            self.assertNotEqual(run.returncode, 0)
            self.assertEqual(run.stdout, "")
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)


class Copies(FolderTest):
    """What is copied into the tree of another system."""

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), encoding="ascii") as file:
            return file.read()

    def copy(self):
        subprocess.run(["sh", os.path.join(REPO, "tests", "copy_files"), self.path("from"), self.path("to")], check=True, timeout=60)

    def test_a_change_is_younger_than_what_was_built_before(self):
        """Also where the change itself is older, and what did not change keeps its time."""
        for name in ("changed.cpp", "same.cpp", "gone.cpp", "script"):
            self.write("from/" + name, "1")
        subprocess.run(["git", "init", "-q", self.path("from")], check=True)
        self.copy()
        self.write("to/built", "of 1")
        before = 1e9
        for name in ("changed.cpp", "same.cpp", "gone.cpp", "script", "built"):
            os.utime(self.path("to/" + name), (before, before))
        self.write("from/changed.cpp", "2")
        os.utime(self.path("from/changed.cpp"), (before - 1000, before - 1000))
        os.chmod(self.path("from/script"), 0o755)
        os.remove(self.path("from/gone.cpp"))
        self.copy()
        self.assertEqual(set(os.listdir(self.path("to"))), {"changed.cpp", "same.cpp", "script", "built"})
        self.assertEqual(self.read("to/changed.cpp"), "2")
        self.assertGreater(os.path.getmtime(self.path("to/changed.cpp")), before)
        self.assertEqual(os.path.getmtime(self.path("to/same.cpp")), before)
        self.assertTrue(os.access(self.path("to/script"), os.X_OK))


class Solver(FolderTest):
    def program(self, name):
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write("#!/bin/sh\n")
        os.chmod(self.path(name), 0o755)
        return self.path(name)

    def find(self, **environment):
        with mock.patch.dict(os.environ, environment):
            return ccx.find()

    def test_named_by_the_environment(self):
        mine = self.program("my-solver")
        self.assertEqual(self.find(POLYCUBE_CCX=mine), mine)
        with self.assertRaisesRegex(RuntimeError, "POLYCUBE_CCX names no program: /nowhere/ccx"):
            self.find(POLYCUBE_CCX="/nowhere/ccx")

    def test_on_the_path_or_missing(self):
        self.assertIsNone(self.find(POLYCUBE_CCX="", PATH=self.folder))
        there = self.program("ccx")
        self.assertEqual(self.find(POLYCUBE_CCX="", PATH=self.folder), there)

    def test_demo_without_solver(self):
        """It meshes and draws, says how to name a solver, and ends well."""
        programs = self.path("bin")
        os.mkdir(programs)
        for folder in os.environ["PATH"].split(os.pathsep):
            for name in os.listdir(folder) if os.path.isdir(folder) else []:
                if name != "ccx" and not os.path.lexists(os.path.join(programs, name)):
                    os.symlink(os.path.join(folder, name), os.path.join(programs, name))
        run = subprocess.run(
            ["sh", os.path.join(REPO, "resources", "demo"), self.path("demo")],
            env=dict(os.environ, PATH=programs, POLYCUBE_CCX=""),
            capture_output=True,
            text=True,
            timeout=300,
        )
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("Not solved: " + ccx.MISSING, run.stdout)
        for name in ("bracket.FCStd", "bracket.inp", "report.json", "mesh.png"):
            self.assertGreater(os.path.getsize(self.path(os.path.join("demo", name))), 1000, name)
        self.assertFalse(os.path.exists(self.path("demo/stress.png")))


if __name__ == "__main__":
    unittest.main()
