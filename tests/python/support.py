"""What the Python tests share: the build under test and small parts made by FreeCAD's Part module."""

import os
import subprocess
import sys
import tempfile
import unittest

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ.get("POLYCUBE_BUILD", os.path.join(REPO, "build"))
PROGRAM = os.path.join(BUILD, "polycube")
sys.path.insert(0, os.path.join(BUILD, "python"))
sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib", os.path.join(REPO, "resources", "examples")]

import FreeCAD  # noqa: E402
import Part  # noqa: E402

import ccx  # noqa: E402

#: For a test that runs CalculiX, whose program is ccx.find().
needs_calculix = unittest.skipUnless(ccx.find(), ccx.MISSING)

VECTOR = FreeCAD.Vector


def box():
    return Part.makeBox(8, 2, 2)


def chamfered():
    """A block with a chamfer between its +X and +Z faces."""
    block = Part.makeBox(8, 4, 4)
    return block.makeChamfer(1.5, [edge for edge in block.Edges if edge.BoundBox.XMin > 7.9 and edge.BoundBox.ZMin > 3.9])


def cylinder():
    return Part.makeCylinder(5, 10)


def plate():
    return Part.makeBox(20, 16, 4).cut(Part.makeCylinder(4, 4, VECTOR(10, 8, 0)))


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, self.path(name)."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def save(self, shape, name="part.brep"):
        shape.exportBrep(self.path(name))
        return self.path(name)

    def run_program(self, *arguments, **settings):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, **settings)

    def refuses(self, part, *arguments, status=1, output="out.inp"):
        """The line with which `polycube mesh` refuses; it must be one, and nothing may be written."""
        before = set(os.listdir(self.folder))
        run = self.run_program("mesh", part, "-o", self.path(output), *arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        self.assertTrue(run.stderr.startswith("polycube: "), run.stderr)
        self.assertEqual(set(os.listdir(self.folder)), before, "something was written")
        return run.stderr
