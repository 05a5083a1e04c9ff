"""Linters over all scripts: a finding is a failure."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

import tidy
from test_architecture import REPO, tracked

#: pycodestyle's own defaults, which leave breaks at operators to the author, spaces in slices, the length of lines, and the names of the field (`l`).
IGNORED = "E121,E123,E126,E203,E226,E24,E402,E501,E704,E741,W503,W504"

CLANG_FORMAT = 14


def scripts():
    """Shell scripts have no suffix here."""
    for name in tracked():
        with open(os.path.join(REPO, name), "rb") as file:
            if file.readline().startswith(b"#!/bin/sh"):
                yield name


class Lint(unittest.TestCase):
    maxDiff = None  # findings are told in full

    def run_on(self, names, tool, *arguments):
        self.assertTrue(names)
        if not shutil.which(tool):
            self.skipTest(tool + " is not there")
        run = subprocess.run([tool, *arguments, *names], cwd=REPO, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_shell(self):
        self.run_on(list(scripts()), "shellcheck")

    def test_cpp(self):
        """Versions of clang-format differ in small things: the tree is formatted with that of Debian 12."""
        version = subprocess.run(["clang-format", "--version"], capture_output=True, text=True).stdout if shutil.which("clang-format") else ""
        if not re.search(r"version {}\.".format(CLANG_FORMAT), version):
            self.skipTest("clang-format {} is not there".format(CLANG_FORMAT))
        self.run_on([name for name in tracked() if name.endswith((".cpp", ".h"))], "clang-format", "--dry-run", "--Werror")

    def test_cpp_by_clang_tidy(self):
        self.assertGreater(len(tidy.sources()), 100)
        self.assertEqual(tidy.of_backend(self.clang_tidy(), os.environ.get("build") or os.path.join(REPO, "build")), "")

    def test_clang_tidy_sees_every_source(self):
        """Those too that use one name each for something of its own, and headers."""
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "backend"))
            with open(os.path.join(folder, "backend", "shared.h"), "w", encoding="ascii") as file:
                file.write("#pragma once\ninline int* in_header() { return 0; }\n")
            paths = [os.path.join(folder, "backend", name) for name in ("a.cpp", "b.cpp", "c.cpp")]
            for path, kind in zip(paths, ("int", "char", "double")):
                with open(path, "w", encoding="ascii") as file:
                    file.write('#include <shared.h>\nnamespace {{\nconst {0}* kSame = 0;\n}}  // namespace\nconst {0}* same_{0}() {{ return kSame; }}\n'.format(kind))
            self.assertEqual(sorted(tidy.groups(paths, 1)), [[path] for path in paths])
            found = tidy.findings(self.clang_tidy(), os.path.join(folder, "units"), paths, ["-std=c++20", "-I", os.path.join(folder, "backend")])
        for name in ("a.cpp", "b.cpp", "c.cpp", "shared.h"):
            self.assertRegex(found, name + r":\d+:\d+: error: use nullptr")

    def clang_tidy(self):
        return tidy.tool() or self.skipTest("clang-tidy {} is not there".format(tidy.VERSION))

    def test_python(self):
        self.run_on([name for name in tracked() if name.endswith(".py")], "pycodestyle", "--ignore=" + IGNORED)


if __name__ == "__main__":
    unittest.main()
