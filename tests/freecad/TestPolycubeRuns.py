"""polycube.solve: choice of elements, errors, cancelling, results in the document."""

import json
import os
import re
from unittest import mock

import Part
import TestPolycubeSolve as solve_tests
import TestPolycubeSolver as solver_tests
from FreeCAD import Vector

from freecad import polycube
from freecad.polycube import ccx, deck, objects
from freecad.polycube.estimate import StressError

YOUNG = solve_tests.YOUNG


def types_of(path):
    """{element type: number of cells} of an input file."""
    found, kind = {}, None
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("*"):
                head = re.match(r"\*ELEMENT, TYPE=(\w+)", line.upper())
                kind = head and head.group(1)
            elif kind:
                found[kind] = found.get(kind, 0) + len(re.findall(r"\d+", line))
    return {kind: numbers // (1 + int(re.match(r"C3D(\d+)", kind).group(1))) for kind, numbers in found.items()}


class Elements(solve_tests.SolveTest):
    def cantilever(self, width, **options):
        """A bar of 40 x width x width mm, one end fixed, 10 N at the other: (deflection over that of beam theory with shear, the solution)."""
        part = self.part(Part.makeBox(40, width, width))
        analysis = self.analysis(part, ["Face1"], PoissonRatio="0")
        self.add(analysis, "Force", part, "Face2", Force=10, Direction=(part, ["Face6"]))
        solution = self.solve(analysis, part, **options)
        theory = 10 * 40**3 / (3 * YOUNG * width**4 / 12) + 10 * 40 / (YOUNG / 2 * width**2 * 5 / 6)
        return max(vector.z for vector in solution.result.DisplacementVectors) / theory, solution

    def test_defaults_by_order(self):
        for order, kind in ((1, "C3D8I"), (2, "C3D20R")):
            with self.subTest(order=order):
                found, solution = self.cantilever(10, order=order, size=5)
                self.assertEqual((solution.element, set(types_of(solution.path)), solution.notes), (kind, {kind}, []))
                self.assertAlmostEqual(found, 1, delta=0.01)

    def test_on_request(self):
        for order, kind, low, high in ((1, "C3D8", 0.5, 0.95), (2, "C3D20", 0.99, 1.01)):
            with self.subTest(kind):
                found, solution = self.cantilever(10, order=order, size=5, element=kind)
                self.assertEqual(set(types_of(solution.path)), {kind})
                self.assertTrue(low < found < high, found)

    def test_a_bar_of_single_cells(self):
        """Hourglassing threatens: C3D20 there, and a line that says so; what is asked for is taken."""
        found, solution = self.cantilever(5, size=5)
        self.assertEqual(types_of(solution.path), {"C3D20": 8})
        self.assertEqual(solution.notes, ["C3D20 in place of C3D20R in 8 of 8 cells, against hourglassing: 8 that are the whole section of a bar"])
        self.assertAlmostEqual(found, 1, delta=0.01)
        _, solution = self.cantilever(5, size=5, element="C3D20R")
        self.assertEqual((types_of(solution.path), solution.notes), ({"C3D20R": 8}, []))

    def frequencies(self, *size, **options):
        """Those of a free block that are of no motion of the whole, lowest first, with cells of 5 mm."""
        part = self.part(Part.makeBox(*size))
        analysis = self.analysis(part, [], kind="frequency")
        solver_tests.solver_of(analysis).EigenmodesCount = 12
        solution = self.solve(analysis, part, **options)
        return sorted(result.EigenmodeFrequency for result in solution.results if result.EigenmodeFrequency > 1), solution

    def test_frequencies_of_hourglassing(self):
        """Beam theory gives the bar 4160 Hz and more. C3D20R has others between, by rounding at 60 Hz or at 7000. A plate of one layer has none of it."""
        bar, _ = self.frequencies(80, 5, 5)
        self.assertGreater(bar[0], 4000)
        others = [one for one in self.frequencies(80, 5, 5, element="C3D20R")[0] if min(abs(one / true - 1) for true in bar) > 0.05]
        self.assertTrue(others and others[0] < 8000, others)
        plate, solution = self.frequencies(40, 40, 5)
        self.assertEqual(set(types_of(solution.path)), {"C3D20R"})
        self.assertAlmostEqual(plate[0] / self.frequencies(40, 40, 5, element="C3D20")[0][0], 1, delta=0.01)

    def test_point_loads(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Force", part, "Vertex5", Force=10, Direction=(part, ["Face2"]))
        solution = self.solve(analysis, part)
        self.assertEqual(types_of(solution.path), {"C3D20R": 31, "C3D20": 1})
        self.assertEqual(solution.notes, ["C3D20 in place of C3D20R in 1 of 32 cells, against hourglassing: 1 at point loads"])

    def test_the_mesh_object_says_which(self):
        part, analysis = self.bar("Face1")
        mesh = polycube.create_fem_mesh(part, size=5, analysis=analysis)
        self.assertEqual(mesh.SolverElement, "Default")
        mesh.SolverElement = "C3D20"
        self.assertEqual(types_of(self.solve(analysis, part).path), {"C3D20": 32})
        self.assertEqual(mesh.MeshState, objects.CURRENT)
        self.assertEqual(types_of(self.solve(analysis, part, element="C3D20R").path), {"C3D20R": 32})

    def test_elements_of_another_order_are_refused(self):
        part, analysis = self.bar("Face1")
        with self.assertRaisesRegex(polycube.InvalidInput, "^C3D8I is not an element of a mesh of order 2: C3D20R, C3D20$"):
            self.solve(analysis, part, element="C3D8I")

    def test_meshes_of_others_keep_their_elements(self):
        from femexamples import ccx_cantilever_faceload

        self.document = ccx_cantilever_faceload.setup()
        solution = polycube.solve(self.document.Analysis, folder=self.folder)
        self.assertEqual((solution.element, solution.notes), ("", []))
        self.assertIsNone(solution.recovered)
        with self.assertRaisesRegex(polycube.InvalidInput, "stresses are recovered on meshes of Polycube only$"):
            polycube.solve(self.document.Analysis, folder=self.folder, stresses="recovered")
        self.assertAlmostEqual(min(vector.z for vector in solution.result.DisplacementVectors), -86.93, delta=0.05)


class Loaded(solve_tests.SolveTest):
    def loaded(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        polycube.create_fem_mesh(part, size=5, analysis=analysis)
        self.document.recompute()
        return part, analysis


class Runs(Loaded):
    def test_results_are_one_undo_step_and_replace_those_before(self):
        part, analysis = self.loaded()
        self.document.UndoMode = 1
        before = [member.Name for member in analysis.Group]
        lines = []
        solution = polycube.solve(analysis, folder=self.folder, log=lines.append)
        self.assertTrue(any("CalculiX" in line for line in lines))
        self.assertEqual(solution.results, [member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject")])
        self.assertGreater(solution.seconds, 0)
        again = polycube.solve(analysis, folder=self.folder)
        self.assertEqual(len([member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject")]), 1)
        self.assertEqual(again.result.NodeNumbers[-1], len(again.result.NodeNumbers))
        self.document.undo()
        self.document.undo()
        self.assertEqual([member.Name for member in analysis.Group], before)

    def test_where_stresses_are_least_certain(self):
        """A plate with a small hole, pulled: the worst face is the hole's, and the estimate falls with the size of the cells."""
        worst = []
        for size in (5, 1.5):  # 12 and 16 cells round the hole
            part = self.part(Part.makeBox(60, 30, 5, Vector(-30, -15, 0)).cut(Part.makeCylinder(4, 5)))
            hole, left, right = (
                next("Face{}".format(n) for n, face in enumerate(part.Shape.Faces, 1) if chosen(face))
                for chosen in (
                    lambda face: face.Surface.TypeId == "Part::GeomCylinder",
                    lambda face: face.CenterOfMass.x < -29,
                    lambda face: face.CenterOfMass.x > 29,
                )
            )
            analysis = self.analysis(part, [], PoissonRatio="0")
            self.add(analysis, "Displacement", part, left, xFree=False, xFix=True, yFree=False, yFix=True, zFree=False, zFix=True)
            self.add(analysis, "Force", part, right, Force=1000, Direction=(part, [right]))
            lines = []
            solution = self.solve(analysis, part, size=size, log=lines.append)
            found = solution.stress_error
            self.assertEqual((found.faces[0][0], len(found.faces)), (hole, 3))
            self.assertIn(found.line(), lines)
            self.assertEqual(len(solution.result.StressError), len(solution.result.NodeNumbers))
            self.assertAlmostEqual(max(solution.result.StressError), max(found.percent.values()), delta=1e-6)
            energy = solution.energy_error
            self.assertEqual((energy.faces[0][0], len(energy.faces)), (hole, 3))
            self.assertIn("on {} (".format(hole), energy.line())
            self.assertIn(energy.line(), lines)
            self.assertEqual(max(solution.result.EnergyError), max(energy.of_nodes().values()))
            worst.append((found.faces[0][1], energy.faces[0][1]))
        self.assertLess(worst[1][0], worst[0][0])
        self.assertLess(worst[1][1], worst[0][1])

    def test_certainty_is_said_in_plain_figures(self):
        line = StressError({}, [("Face5", 18.4, 131.7), ("Face7", 0.0634, 9.81)]).line()
        self.assertTrue(line.endswith("on Face5 (18 MPa, 132 %), Face7 (0.063 MPa, 9.8 %)"), line)

    def test_an_input_file_in_parts(self):
        """FreeCAD writes the mesh, and each kind of load, to files of their own."""
        part, analysis = self.loaded()
        solver_tests.solver_of(analysis).SplitInputWriter = True
        self.add(analysis, "Spring", part, "Face3", normalStiffness=1.0)
        solution = polycube.solve(analysis, folder=self.folder)
        self.assertEqual(types_of(os.path.join(self.folder, "PolycubeMesh_femesh.inp")), {"C3D20R": 32})
        self.assertTrue(solution.balance.holds, solution.balance.line())

    def test_frequencies(self):
        part, analysis = self.loaded()
        solver = solver_tests.solver_of(analysis)
        solver.AnalysisType, solver.EigenmodesCount = "frequency", 3
        solution = polycube.solve(analysis, folder=self.folder)
        self.assertIn("Force: has no effect in an analysis of type frequency", solution.notes)
        self.assertEqual([result.Eigenmode for result in solution.results], [1, 2, 3])
        self.assertGreater(solution.results[0].EigenmodeFrequency, 1000)

    def test_calculix_own_words(self):
        part, analysis = self.loaded()
        before, undo = [member.Name for member in analysis.Group], self.document.UndoCount
        wrong = mock.patch.object(deck, "add_cards", lambda text, model, step: text.replace("*END STEP", "*BOUNDARY\nNOWHERE,1\n*END STEP"))
        with wrong, self.assertRaises(polycube.SolverFailed) as caught:
            polycube.solve(analysis, folder=self.folder)
        self.assertRegex(str(caught.exception), r"^CalculiX: \*ERROR reading \*BOUNDARY.*NOWHERE")
        self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(([member.Name for member in analysis.Group], self.document.UndoCount), (before, undo))

    def test_cancel(self):
        part, analysis = self.loaded()
        with mock.patch.object(ccx, "find", return_value=self.sleeper()), self.assertRaises(polycube.Cancelled):
            polycube.solve(analysis, folder=self.folder, cancel=lambda: True)

    def sleeper(self):
        """A program that never ends by itself."""
        path = os.path.join(self.folder, "sleeper")
        with open(path, "w", encoding="ascii") as file:
            file.write("#!/bin/sh\nexec sleep 600\n")
        os.chmod(path, 0o755)
        return path

    def test_what_is_needed(self):
        part, analysis = self.loaded()
        with self.assertRaisesRegex(polycube.InvalidInput, "an analysis is needed"):
            polycube.solve(part)
        with mock.patch.object(ccx, "find", return_value=None), self.assertRaisesRegex(polycube.InvalidInput, "POLYCUBE_CCX"):
            polycube.solve(analysis)
        self.document.removeObject("Support")
        with self.assertRaisesRegex(polycube.InvalidInput, "Static analysis: (Neither|No mechanical)"):
            polycube.solve(analysis, folder=self.folder)
        self.document.removeObject("Solver")
        with self.assertRaisesRegex(polycube.InvalidInput, "has no solvers"):
            polycube.solve(analysis, folder=self.folder)

    def test_what_the_mesh_does_not_capture_is_refused(self):
        """A search in space would find some nodes of a face that was ignored, and part of the load."""
        block = Part.makeBox(20, 20, 10)
        part = self.part(block.makeFillet(6, [edge for edge in block.Edges if edge.BoundBox.XMin > 19 and edge.BoundBox.YMin > 19]))
        analysis = self.analysis(part, ["Face1"])
        obj = polycube.create_fem_mesh(part, size=5, feature_angle=10, analysis=analysis)
        ignored = json.loads(obj.Report)["cad"]["faces"]["ignored"][0]
        self.add(analysis, "Pressure", part, ignored, Pressure=1.0)
        with self.assertRaisesRegex(polycube.InvalidInput, "^Pressure: the mesh does not capture {}; make it again$".format(ignored)):
            self.solve(analysis, part)
        polycube.update_fem_mesh(obj)
        self.assertTrue(self.solve(analysis, part).balance.holds)

    def test_what_means_nothing_is_told(self):
        part, analysis = self.loaded()
        self.add(analysis, "ElectrostaticPotential", part, "Face3")
        self.add(analysis, "Heatflux", part, "Face3")
        self.add(analysis, "BodyHeatSource", part)
        notes = polycube.solve(analysis, folder=self.folder).notes
        self.assertIn("ElectrostaticPotential: means nothing to CalculiX", notes)
        self.assertIn("Heatflux: has no effect in an analysis of type static", notes)
        self.assertIn("BodyHeatSource: has no effect in an analysis of type static", notes)

    def test_turned_container(self):
        """A gear of a part in a turned container pulls where the mesh stands."""
        container, box = self.in_turned_container()
        self.assertTrue(container.Placement.Rotation.Angle)
        hole = self.document.addObject("Part::Feature", "Ring")
        container.addObject(hole)
        hole.Shape = Part.makeCylinder(20, 10).cut(Part.makeCylinder(10, 10))
        self.document.removeObject(box.Name)
        faces = {face.Surface.TypeId[6:] + str(round(face.CenterOfMass.z)): "Face{}".format(n) for n, face in enumerate(hole.Shape.Faces, 1)}
        analysis = self.analysis(hole, [faces["GeomPlane0"]])
        outer = next("Face{}".format(n) for n, face in enumerate(hole.Shape.Faces, 1) if getattr(face.Surface, "Radius", 0) == 20)
        self.add(analysis, "Gear", hole, outer, Diameter=60, Force=500, Direction=(hole, [faces["GeomPlane10"]]))
        solution = self.solve(analysis, hole, size=5)
        total = sum(solve_tests.loads_of(solution.path).values(), Vector())
        self.assertLess((total - container.Placement.Rotation.multVec(Vector(0, 0, 500))).Length, 1e-6)
