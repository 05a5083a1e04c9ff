"""The API in a FreeCAD from which the compiled module is hidden; run by TestPolycubeMesher."""

import os
import tempfile
import unittest

import FreeCAD
import hidden
import Part

from freecad import polycube
from freecad.polycube import engine


class HiddenApi(unittest.TestCase):
    def setUp(self):
        hidden.check(self)
        self.document = FreeCAD.newDocument()
        self.addCleanup(FreeCAD.closeDocument, self.document.Name)
        self.part = self.document.addObject("Part::Feature", "Part")
        self.part.Shape = Part.makeCylinder(5, 10)

    def test_the_program_is_taken(self):
        self.assertEqual(engine.find().command, (os.path.join(hidden.BUILD, "polycube"), "serve-job"))

    def test_mesh_object_and_labels(self):
        seen, lines = [], []
        obj = polycube.create_fem_mesh(self.part, size=2.5, progress=lambda *step: seen.append(step), log=lines.append)
        self.assertGreater(obj.Hexahedra, 20)
        self.assertEqual(obj.FemMesh.HexaCount, obj.Hexahedra)
        self.assertEqual({name for name, _ in seen} & {"tet", "fem"}, {"tet", "fem"})
        self.assertTrue(lines)
        self.assertTrue(polycube.labels(self.part).valid)
        polycube.update_fem_mesh(obj)

    def test_errors(self):
        with self.assertRaisesRegex(polycube.InvalidInput, r"\Atime_limit must be greater than 0\Z"):
            polycube.mesh(self.part, time_limit=0)
        with self.assertRaises(polycube.Cancelled):
            polycube.mesh(self.part, size=0.2, cancel=lambda: True)
        with self.assertRaises(polycube.Cancelled):
            polycube.mesh(self.part, size=0.2, time_limit=0.1)

    def test_a_python_that_has_the_module_by_the_preference(self):
        preferences = FreeCAD.ParamGet(engine.PREFERENCES)
        self.addCleanup(preferences.RemString, "Mesher")
        with tempfile.TemporaryDirectory() as folder:
            python = os.path.join(folder, "mine")
            with open(python, "w", encoding="utf-8") as file:
                file.write('#!/bin/sh\nPYTHONPATH="{}" exec /usr/bin/python3 "$@"\n'.format(hidden.MODULE_FOLDER))
            os.chmod(python, 0o755)
            preferences.SetString("Mesher", python)
            self.assertEqual(engine.find().command[0], python)
            self.assertGreater(len(polycube.mesh(self.part, size=2.5).hexes), 20)
