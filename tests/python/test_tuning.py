"""`bench --tuning`: tells values that matter from those that do not, on whose account, and goes on where it was stopped."""

import os
import subprocess
import sys
import unittest

from support import REPO, FolderTest

SCRIPT = os.path.join(REPO, "tests", "benchmarks", "tuning.py")
# One value changes every mesh, one the mesh of one family, one another one's not worth a word.
PROGRAM_BY_RULES = """#!{} -B
import json, os, sys
if sys.argv[1] == "describe":
    print(json.dumps({{"tet.far": 1e-3, "tet.near": 1e-6, "tet.probes": 6, "tet.samples": 9, "tet.quantile": 0.75}}))
    sys.exit()
open(os.environ["CALLS"], "a").write("x")
part, output, report = sys.argv[2], sys.argv[sys.argv.index("-o") + 1], sys.argv[sys.argv.index("--report") + 1]
tuning = dict(item.split("=") for item in os.environ["POLYCUBE_TUNING"].split(",") if item)
cells, least, lost = 100, 0.5, 0
if "tet.far" in tuning:
    cells = 150
if "tet.probes" in tuning and "shaft" in part:
    lost = 1
if "tet.samples" in tuning:
    least = 0.499
if "tet.quantile" in tuning and float(tuning["tet.quantile"]) > 1 and "cam" in part:
    sys.exit(2)
full = {{"captured": 5, "total": 5}}
json.dump({{"counts": {{"hexes": cells}}, "quality": {{"min_scaled_jacobian": least, "mean_scaled_jacobian": 0.9}},
           "cad": {{"faces": full, "vertices": full, "edges": {{"captured": 5 - lost, "total": 5}}}}}}, open(report, "w"))
open(output, "w").write(str((cells, least, lost)))
"""


class Tuning(FolderTest):
    def setUp(self):
        super().setUp()
        self.program, self.page, self.calls = self.path("program"), self.path("page.md"), self.path("calls")
        with open(self.program, "w", encoding="utf-8") as file:
            file.write(PROGRAM_BY_RULES.format(sys.executable))
        os.chmod(self.program, 0o755)
        os.mkdir(self.path("parts"))
        for name in ("shaft_00", "shaft_01", "cam_00"):
            with open(self.path("parts/{}.step".format(name)), "w", encoding="ascii"):
                pass

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, self.program, *arguments], capture_output=True, text=True, env={**os.environ, "CALLS": self.calls})

    def rows(self):
        with open(self.page, encoding="utf-8") as file:
            return {line.split(" | ")[0][2:]: line.rstrip(" |\n").split(" | ")[3:] for line in file if line.startswith("| tet.")}

    def test_verdicts(self):
        run = self.run_script(self.path("parts"), "-o", self.page, "--jobs", "2")
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = self.rows()
        self.assertEqual(rows["tet.far"], ["3 of 3", "cells +50%", "matters"])
        self.assertEqual(rows["tet.near"], ["0 of 3", "", "changes nothing"])
        self.assertEqual(rows["tet.probes"], ["2 of 3", "complete -> valid", "matters, for shaft only"])
        self.assertEqual(rows["tet.samples"], ["3 of 3", "min SJ -0.001", "other meshes, as good"])
        self.assertEqual(rows["tet.quantile"], ["1 of 3", "complete -> no mesh", "matters, for cam only"])

    def test_goes_on_where_it_was_stopped(self):
        self.run_script(self.path("parts"), "-o", self.page)
        with open(self.page, encoding="utf-8") as file:
            page = file.read()
        with open(self.page + ".trials", encoding="utf-8") as file:
            trials = file.readlines()
        first = os.path.getsize(self.calls)
        self.assertEqual(first, len(trials) + 3)  # without changes
        with open(self.page + ".trials", "w", encoding="utf-8") as file:
            file.write("".join(trials[:-3]) + trials[-3][:20])
        self.run_script(self.path("parts"), "-o", self.page)
        self.assertIn(os.path.getsize(self.calls) - first, range(3 + 1, 3 + 4))
        with open(self.page, encoding="utf-8") as file:
            self.assertEqual(file.read(), page)

    def test_entries(self):
        self.run_script(self.path("parts"), "-o", self.page, "--entries", "tet.near,tet.probes")
        self.assertEqual(set(self.rows()), {"tet.near", "tet.probes"})
        run = self.run_script(self.path("parts"), "-o", self.page, "--entries", "tet.nowhere")
        self.assertEqual(run.returncode, 2)
        self.assertIn("tet.nowhere", run.stderr.splitlines()[-1])
        self.assertRegex(self.run_script("--list").stdout, r"pad\.hopeless +2500 +Gain")


if __name__ == "__main__":
    unittest.main()
