"""polycube.converge: a series of meshes, the limit of a result, a table and a plot."""

import os
from unittest import mock

import TestPolycubeSolve as solve_tests
import TestPolycubeSolver as solver_tests
from FreeCAD import Vector

from freecad import polycube
from freecad.polycube import convergence


class Limits(solve_tests.SolveTest):
    def test_of_values_with_an_order(self):
        for order in (1.0, 2.0, 3.3):
            widths = (1.0, 0.7, 0.45)
            found, limit, band = convergence.extrapolated(widths, [5 - 2 * width**order for width in widths])
            self.assertAlmostEqual(found, order, delta=1e-6)
            self.assertAlmostEqual(limit, 5, delta=1e-6)
            self.assertAlmostEqual(band, 1.25 * 2 * 0.45**order, delta=1e-6)

    def test_of_values_without_an_order(self):
        self.assertEqual(convergence.extrapolated((1, 0.7, 0.5), (1.0, 2.0, 1.5)), (None, None, 1.0))
        self.assertEqual(convergence.extrapolated((1, 0.7, 0.5), (1.0, 2.0, 4.0)), (None, None, 3.0))
        self.assertEqual(convergence.extrapolated((1, 0.7, 0.5), (1.0, 2.0, 2.0)), (None, 2.0, 0.0))
        found = convergence.Convergence("stress", [{"cells": cells, "value": value} for cells, value in ((10, 1.0), (30, 2.0), (100, 4.0))])
        self.assertEqual(found.line(), "stress: 4 on the finest mesh; no order is to be seen, the last three differ by 3 (75 %)")

    def test_of_values_that_are_alike_by_chance(self):
        """An order that elements do not have is not believed: the band is that of order 2."""
        order, limit, band = convergence.extrapolated((1, 0.7, 0.49), (1.0, 2.0, 2.001))
        self.assertAlmostEqual(order, 2)
        self.assertAlmostEqual(limit, 2.001 + 0.001 * 0.49**2 / (0.7**2 - 0.49**2))
        self.assertAlmostEqual(band, 1.25 * (limit - 2.001))


@solver_tests.needs_calculix
class Series(solve_tests.SolveTest):
    def cantilever(self, **options):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face6"]))
        polycube.create_fem_mesh(part, size=5, analysis=analysis, **options)
        self.document.recompute()
        return part, analysis

    def test_deflection(self):
        part, analysis = self.cantilever()
        self.document.UndoMode = 1
        mesh = self.mesh(analysis)
        before, size = [member.Name for member in analysis.Group], mesh.CharacteristicLengthMax.Value
        picture, lines = os.path.join(self.folder, "series.png"), []
        found = polycube.converge(analysis, folder=self.folder, plot=picture, log=lines.append)
        self.assertEqual([row["cells"] for row in found.rows], sorted({row["cells"] for row in found.rows}))
        self.assertEqual(len(found.rows), 3)
        self.assertTrue(any("cells" in line for line in lines))
        # beam theory with shear, its end held less stiffly than a clamp holds it
        theory = 1000 * 40**3 / (3 * 210000 * 10**4 / 12) + 1000 * 40 / (210000 / 2.6 * 100 * 5 / 6)
        self.assertAlmostEqual(found.limit / theory, 1, delta=0.01)
        self.assertLess(abs(found.value - found.limit), found.band)
        self.assertGreater(os.path.getsize(picture), 1000)
        sheet = self.document.getObject("Convergence")
        self.assertEqual((sheet.A1, sheet.B4, sheet.A6), ("size", found.rows[-1]["cells"], found.line()))
        self.assertEqual(mesh.Hexahedra, found.rows[-1]["cells"])
        self.assertEqual(len([member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject")]), 1)
        self.document.undo()
        self.assertEqual(([member.Name for member in analysis.Group], mesh.CharacteristicLengthMax.Value), (before, size))

    def test_quantities(self):
        part, analysis = self.cantilever()
        face = part.Shape.getElement("Face2").CenterOfMass
        solution = polycube.solve(analysis, folder=self.folder)
        mesh = self.mesh(analysis)
        values = {}
        for quantity in ("max displacement", "max stress", ((40, 5, 5), "displacement"), ("Face2", "displacement"), ("Face1", "stress")):
            measure, name = convergence._measure(quantity, mesh)
            values[name] = measure(solution.result)
        self.assertEqual(face, Vector(40, 5, 5))
        largest = max(solution.result.DisplacementLengths)
        self.assertEqual(values["max displacement / mm"], largest)
        for name in ("displacement at (40.0, 5.0, 5.0) / mm", "mean displacement on Face2 / mm"):
            self.assertAlmostEqual(values[name] / largest, 1, delta=0.03)
        self.assertLess(values["mean stress on Face1 / MPa"], values["max stress / MPa"])

    def test_bad_input_changes_nothing(self):
        part, analysis = self.cantilever()
        before, mesh = [member.Name for member in analysis.Group], self.mesh(analysis)
        for sizes, quantity, said in (
            (2, "max displacement", "three different sizes"),
            ([5, 5, 4], "max displacement", "three different sizes"),
            (3, "least displacement", "a quantity is"),
            (3, ("Face9", "stress"), "there is no Face9"),
        ):
            with self.subTest(said), self.assertRaisesRegex(polycube.InvalidInput, said):
                polycube.converge(analysis, sizes, quantity)
        self.document.removeObject("Support")
        with mock.patch("tempfile.tempdir", self.folder), self.assertRaisesRegex(polycube.InvalidInput, "Neither|No mechanical"):
            polycube.converge(analysis)
        self.assertEqual(os.listdir(self.folder), [])
        before.remove("Support")
        self.assertEqual(([member.Name for member in analysis.Group], mesh.CharacteristicLengthMax.Value), (before, 5))
        self.add(analysis, "Fixed", part, "Face1")
        self.document.UndoMode = 1
        with self.assertRaises(polycube.Cancelled):
            polycube.converge(analysis, folder=self.folder, cancel=lambda: mesh.CharacteristicLengthMax.Value < 6)
        self.assertEqual(mesh.CharacteristicLengthMax.Value, 5)
        self.document.removeObject(mesh.Name)
        with self.assertRaisesRegex(polycube.InvalidInput, "a mesh of Polycube is needed"):
            polycube.converge(analysis)

    def test_sizes_go_together(self):
        part, analysis = self.bar("Face1")
        obj = polycube.create_fem_mesh(part, hexes=256, sizes={"Face2": 1.25}, analysis=analysis)
        sizes = [(round(options["size"], 6), round(options["sizes"]["Face2"], 6)) for options, _ in convergence._options(obj, 3)]
        self.assertEqual(sizes, [(round(2.5 * factor, 6), round(1.25 * factor, 6)) for factor in (2**0.5, 1, 0.5**0.5)])
