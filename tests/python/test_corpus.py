"""The corpus of parts by script: every family makes valid parts, the same ones from the same seed."""

import filecmp
import os
import subprocess
import sys
import unittest

from support import REPO, FolderTest, Part

GENERATE = os.path.join(REPO, "tests", "corpus", "generate.py")
sys.path.insert(0, os.path.dirname(GENERATE))
from families import FAMILIES, HARD  # noqa: E402
from families.registry import Draw  # noqa: E402
import generate  # noqa: E402


class Corpus(FolderTest):
    def generate(self, folder, *arguments):
        run = subprocess.run([sys.executable, GENERATE, self.path(folder), *arguments], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return {name: os.path.join(self.path(folder), name) for name in sorted(os.listdir(self.path(folder)))}

    def read(self, path):
        shape = Part.Shape()
        shape.read(path)
        self.assertEqual(len(shape.Solids), 1, path)
        self.assertTrue(shape.isValid(), path)
        self.assertTrue(shape.Solids[0].isClosed(), path)
        self.assertGreater(shape.Volume, 0, path)
        self.assertTrue(30 < shape.BoundBox.DiagonalLength < 250, path)
        return shape

    def test_every_family(self):
        self.assertGreaterEqual(len(FAMILIES), 25)
        parts = self.generate("parts", "--per-family", "1")
        self.assertEqual(len(parts), len(FAMILIES))
        for path in parts.values():
            shape = self.read(path)
            self.assertGreater(len(shape.Faces), 3, path)

    def test_hard_families(self):
        self.assertEqual(len(HARD), 9)
        parts = self.generate("parts", "--hard", "--per-family", "1")
        self.assertEqual(len(parts), 9)
        for name, path in parts.items():
            shape = self.read(path)
            if name.startswith("big_bracket"):
                self.assertGreater(len(shape.Faces), 300)

    def test_same_seed_same_bytes(self):
        arguments = ("--families", "flange", "cam", "--per-family", "2")
        first = self.generate("a", *arguments)
        second = self.generate("b", *arguments)
        alone = self.generate("c", "--families", "cam", "--per-family", "2")
        other = self.generate("d", *arguments, "--seed", "2")
        self.assertEqual(len(first), 4)
        for name, path in first.items():
            self.assertTrue(filecmp.cmp(path, second[name], shallow=False), name)
            self.assertFalse(filecmp.cmp(path, other[name], shallow=False), name)
        for name, path in alone.items():
            self.assertTrue(filecmp.cmp(path, first[name], shallow=False), name)
        self.assertFalse(filecmp.cmp(first["cam_00.step"], first["cam_01.step"], shallow=False))

    def test_faults_are_found(self):
        box, apart = Part.makeBox(1, 1, 1), Part.makeBox(1, 1, 1)
        apart.translate(generate.FreeCAD.Vector(3, 0, 0))
        inside_out = box.copy()
        inside_out.reverse()
        self.assertIsNone(generate.fault(box))
        for shape in (Part.Compound([box, apart]), Part.Compound([box, apart.Faces[0]]), Part.makeShell(box.Faces[:5]), inside_out):
            self.assertIsNotNone(generate.fault(shape))

    def test_draws_that_make_no_part_are_drawn_again(self):
        tried = []

        def family(draw):
            tried.append(draw.length(1, 2))
            if len(tried) < 3:
                raise generate.Unsuitable("too picky")
            return Part.makeBox(tried[-1], 1, 1)

        generate.FAMILIES["picky"] = family
        self.addCleanup(generate.FAMILIES.pop, "picky")
        _, solid, reasons = generate.make("picky", 0, 1)
        self.assertEqual(reasons, ["too picky"] * 2)
        self.assertAlmostEqual(solid.Volume, tried[-1], places=6)
        self.assertEqual(tried, [Draw(1, "picky", 0, attempt).length(1, 2) for attempt in range(3)])

    def test_unknown_family(self):
        run = subprocess.run([sys.executable, GENERATE, self.path("x"), "--families", "spaceship"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertIn("spaceship", run.stderr)
        self.assertFalse(os.path.exists(self.path("x")))


if __name__ == "__main__":
    unittest.main()
