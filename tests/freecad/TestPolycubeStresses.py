"""Stresses recovered from integration points: what fields they reproduce, how fast they converge, and that polycube.solve gives them."""

import os
import unittest
from unittest import mock

import numpy as np
import Part
import TestPolycubeRuns as run_tests
import TestPolycubeSolve as solve_tests
import TestPolycubeSolver as solver_tests
from FreeCAD import Vector

from freecad import polycube
from freecad.polycube import estimate, recovery, serendipity, stresses, symmetry

#: places of the 20 nodes of a cell from 0 to 2
_NODES = np.concatenate([serendipity.CORNERS, serendipity.MIDDLES]) + 1


def block(counts, place):
    """(points, cells) of a block of cells; place: of (n, 3) coordinates from 0 to 1."""
    grid = np.stack(np.meshgrid(*(np.arange(2 * count + 1) for count in counts), indexing="ij"), axis=-1)
    there = (grid % 2).sum(axis=-1) <= 1
    number = np.full(there.shape, -1)
    number[there] = np.arange(there.sum())
    first = 2 * np.stack(np.meshgrid(*(np.arange(count) for count in counts), indexing="ij"), axis=-1).reshape(-1, 1, 3)
    return place(grid[there] / (2 * np.array(counts))), number[tuple(np.moveaxis(first + _NODES, -1, 0))]


def bent(at):
    """Sides are curved and cells of different shapes."""
    x, y, z = at.T
    return np.stack([x + 0.1 * y * y + 0.05 * np.sin(3 * z), y + 0.1 * x * z, z - 0.1 * x + 0.08 * np.sin(4 * y)], axis=1)


def tube(at):
    """A quarter of a tube, radii 1 and 2."""
    angle, radius = at[:, 0] * np.pi / 2, 1 + at[:, 1]
    return np.stack([radius * np.sin(angle), radius * np.cos(angle), at[:, 2] / 2], axis=1)


def lame(points):
    """Stresses of a thick tube whose bore is under pressure."""
    x, y, _ = points.reshape(-1, 3).T
    square = x * x + y * y
    radial, hoop, nought = (1 - 4 / square) / 3, (1 + 4 / square) / 3, np.zeros(len(x))
    found = [(radial * x * x + hoop * y * y) / square, (radial * y * y + hoop * x * x) / square, nought + 0.2, (radial - hoop) * x * y / square, nought, nought]
    return np.stack(found, axis=1).reshape(*points.shape[:-1], 6)


def of_degree(degree, seed=1):
    """A function of places: six polynomials of that degree."""
    terms = [(a, b, c) for a in range(3) for b in range(3) for c in range(3) if a + b + c <= degree]
    factors = np.random.default_rng(seed).uniform(-1, 1, (len(terms), 6))
    return lambda points: np.stack([points[..., 0] ** a * points[..., 1] ** b * points[..., 2] ** c for a, b, c in terms], axis=-1) @ factors


class Recovery(unittest.TestCase):
    def error(self, mesh, field, **more):
        points, cells = mesh
        values, trust, _ = recovery.recovered(points, cells, field(recovery.sample_places(points, cells)), **more)
        self.assertEqual(trust.min(), 1)
        return np.abs(values - field(points)).max() / np.abs(field(points)).max()

    def test_polynomials_on_bent_cells(self):
        for counts in ((2, 2, 2), (5, 4, 3)):
            mesh = block(counts, bent)
            self.assertLess(self.error(mesh, of_degree(1)), 1e-9)
            self.assertLess(self.error(mesh, of_degree(2)), 1e-6)

    def test_samples_of_27_points_are_as_good(self):
        points, cells = block((3, 3, 3), bent)
        shapes = np.array([serendipity.shape_functions(20, place)[0] for place in recovery.gauss(3)[0]])
        field = of_degree(1)
        samples = recovery.at_superconvergent(field(np.einsum("pn,mnd->mpd", shapes, block((3, 3, 3), lambda at: at)[0][cells])))
        plain = block((3, 3, 3), lambda at: at)
        self.assertLess(np.abs(samples - field(recovery.sample_places(*plain))).max(), 1e-12)
        self.assertEqual(len(points), len(plain[0]))

    def test_rate_on_a_tube(self):
        """From exact samples the error at all nodes, those on the faces with them, falls with the fourth power; that of what CalculiX does with the second."""
        coarse, fine = (self.error(block((n, n, 2), tube), lame) for n in (4, 8))
        self.assertGreater(np.log2(coarse / fine), 2.7)

    def test_estimate_is_the_error_in_energy(self):
        """Of the stresses that cells have, in a tube: exact samples, trilinear between them."""
        points, cells = block((8, 8, 2), tube)
        samples = lame(recovery.sample_places(points, cells))
        found = stresses.Recovered(np.arange(len(points)), points, cells, samples, *recovery.recovered(points, cells, samples))
        estimated = estimate.energy_error(found, [(210000.0, 0.3)] * len(cells))
        rounding = stresses.Recovered(np.arange(len(points)), points, cells, 1e-12 * samples, found.values, found.trust, 0 * found.of_cells)
        self.assertEqual(estimate.energy_error(rounding, [(210000.0, 0.3)] * len(cells)).share, 0)
        found.of_cells = lame(points[cells])  # but for what 20 nodes miss of it
        exact = estimate.energy_error(found, [(210000.0, 0.3)] * len(cells))
        self.assertGreater(exact.share, 0.005)
        self.assertAlmostEqual(estimated.share / exact.share, 1, delta=0.1)
        radius = np.hypot(*points[cells].mean(axis=1)[:, :2].T)
        self.assertGreater(estimated.of_cells[radius < 1.25].mean(), 2 * estimated.of_cells[radius > 1.75].mean())

    def test_nothing_without_a_corner_inside(self):
        points, cells = block((3, 3, 1), lambda at: at)
        _, trust, _ = recovery.recovered(points, cells, of_degree(1)(recovery.sample_places(points, cells)))
        self.assertFalse(trust.any())

    def test_no_trust_where_stresses_have_no_limit(self):
        """The stress of a crack along x = y = 0.5."""
        points, cells = block((4, 4, 4), lambda at: at)

        def field(points):
            return np.repeat((np.hypot(points[..., 0] - 0.5, points[..., 1] - 0.5) + 1e-9)[..., None] ** -0.5, 6, axis=-1)

        _, trust, _ = recovery.recovered(points, cells, field(recovery.sample_places(points, cells)))
        self.assertEqual(trust[np.hypot(*(points[:, :2] - 0.5).T) < 1e-9].max(), 0)
        _, smooth, _ = recovery.recovered(points, cells, field(recovery.sample_places(points, cells) + [2, 0, 0]))
        self.assertEqual(smooth.min(), 1)

    def test_between_materials_stresses_jump(self):
        points, cells = block((4, 3, 3), lambda at: at)
        places = recovery.sample_places(points, cells)
        right = places[:, 0, 0] > 0.5
        fields = of_degree(1, 1), of_degree(1, 2)
        samples = np.where(right[:, None, None], fields[1](places), fields[0](places))
        values, _, of_cells = recovery.recovered(points, cells, samples, right)
        x = points[:, 0]
        wanted = np.select([x[:, None] < 0.5 - 1e-9, x[:, None] > 0.5 + 1e-9], [fields[0](points), fields[1](points)], (fields[0](points) + fields[1](points)) / 2)
        self.assertLess(np.abs(values - wanted).max(), 1e-9)
        for side, field in enumerate(fields):
            self.assertLess(np.abs(of_cells - field(points[cells]))[right == side].max(), 1e-9)
        # a patch across them would smear it
        self.assertGreater(np.abs(recovery.recovered(points, cells, samples)[0] - wanted).max(), 0.1)

    def test_solids_and_materials_are_regions(self):
        mesh = mock.Mock(solids=lambda: [[11, 12, 13], [14, 15]])
        found = stresses._regions(mesh, np.array([11, 12, 13, 14, 15]), [[11, 14, 15], [12]])
        same = [(a, b) for a in range(5) for b in range(a) if found[a] == found[b]]
        self.assertEqual(same, [(4, 3)])

    def test_planes_of_symmetry(self):
        """Half of a field that is even across x = 0, its shear odd: nodes on the plane are inside, and as good as if the other half were there."""

        def field(points):
            x, y, z = np.moveaxis(points, -1, 0)
            even, odd = np.cos(2 * x + 0 * y) * (1 + y * z), np.sin(2 * x) * (1 + y)
            return np.stack([even, 2 * even, even + z, odd, even, odd], axis=-1)

        points, cells = block((3, 3, 3), lambda at: at)
        samples = field(recovery.sample_places(points, cells))
        plane = np.flatnonzero(points[:, 0] == 0)
        alone, mirrored = (recovery.recovered(points, cells, samples, mirrors=mirrors)[0] for mirrors in ((), [(0, plane)]))
        both, their_cells = block((6, 3, 3), lambda at: at * [2, 1, 1] - [1, 0, 0])
        whole, *_ = recovery.recovered(both, their_cells, field(recovery.sample_places(both, their_cells)))
        inside = [node for node in plane if ((points[node, 1:] > 0.2) & (points[node, 1:] < 0.8)).all()]
        same = [np.linalg.norm(both - points[node], axis=1).argmin() for node in inside]
        self.assertGreater(len(inside), 4)
        self.assertLess(np.abs(mirrored[inside] - whole[same]).max(), 1e-9)
        errors = [np.abs(values - field(points))[plane].max() for values in (alone, mirrored)]
        self.assertLess(errors[1], errors[0] / 3)


@solver_tests.needs_calculix
class Solved(run_tests.Loaded):
    """What users get."""

    def plate(self):
        """A quarter of a plate with a hole, pulled."""
        part = self.part(Part.makeBox(40, 30, 10).cut(Part.makeCylinder(10, 10)))
        analysis = self.analysis(part, [])
        for axis, at in (("x", 0), ("y", 0), ("z", 0)):
            (name,) = [
                "Face{}".format(n)
                for n, face in enumerate(part.Shape.Faces, 1)
                if all(abs(getattr(vertex.Point, axis) - at) < 1e-9 for vertex in face.Vertexes)
            ]
            self.add(analysis, "Displacement", part, name, **{axis + "Free": False, axis + "Fix": True})
        (end,) = ["Face{}".format(n) for n, face in enumerate(part.Shape.Faces, 1) if face.CenterOfMass.x > 40 - 1e-9]
        self.add(analysis, "Force", part, end, Force=1000, Direction=(part, [end]))
        return part, analysis

    def test_results_have_recovered_stresses(self):
        part, analysis = self.plate()
        lines = []
        solution = self.solve(analysis, part, size=3, log=lines.append)
        result, found = solution.result, solution.recovered
        self.assertEqual(result.Stresses, "recovered")
        self.assertIn(found.line(), lines)
        self.assertGreater(found.trust.mean(), 0.7)
        self.assertIn(solution.energy_error.line(), lines)
        self.assertAlmostEqual(max(result.EnergyError), 100 * solution.energy_error.of_cells.max(), delta=1e-3)
        self.assertEqual(list(found.nodes), list(result.NodeNumbers))
        np.testing.assert_allclose(result.NodeStressXX, found.values[:, 0], rtol=1e-5, atol=1e-4)
        xx, yy, zz, xy, yz, zx = found.values.T
        mises = np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (xy**2 + yz**2 + zx**2))
        np.testing.assert_allclose(result.vonMises, mises, rtol=1e-4, atol=1e-3)
        with open(os.path.splitext(solution.path)[0] + ".dat", encoding="utf-8") as file:
            self.assertNotIn("stresses", file.read())
        self.assertTrue(solution.balance.holds)

        bore = np.abs(np.hypot(*found.points[:, :2].T) - 10) < 1e-3

        def radial(result):
            """Stress across the bore, where nothing presses."""
            c, s = found.points[bore, :2].T / 10
            xx, yy, xy = (np.array(getattr(result, "NodeStress" + name))[bore] for name in ("XX", "YY", "XY"))
            return np.sqrt(np.mean((xx * c * c + yy * s * s + 2 * xy * s * c) ** 2))

        recovered = radial(result)
        moved = list(result.DisplacementLengths)
        own = polycube.solve(analysis, folder=self.folder, stresses="calculix")
        self.assertEqual((own.result.Stresses, own.recovered, own.energy_error), ("calculix", None, None))
        self.assertLess(recovered, radial(own.result) / 1.2)
        np.testing.assert_allclose(own.result.DisplacementLengths, moved)

    def test_the_mesh_object_says_which_stresses(self):
        part, analysis = self.loaded()
        mesh = next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemMeshObject"))
        self.assertEqual(mesh.SolverStresses, "recovered")
        mesh.SolverStresses = "calculix"
        self.assertEqual(polycube.solve(analysis, folder=self.folder).result.Stresses, "calculix")
        self.assertEqual(polycube.solve(analysis, folder=self.folder, stresses="recovered").result.Stresses, "recovered")
        with self.assertRaisesRegex(polycube.InvalidInput, "^stresses are recovered or calculix, not exact$"):
            polycube.solve(analysis, folder=self.folder, stresses="exact")

    def test_where_stresses_stay_calculix_own(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        self.assertEqual(self.solve(analysis, part, order=1, size=5).result.Stresses, "calculix")
        self.document.removeObject(self.mesh(analysis).Name)
        polycube.create_fem_mesh(part, size=5, analysis=analysis)
        solver_tests.solver_of(analysis).GeometricalNonlinearity = "nonlinear"
        self.assertEqual(polycube.solve(analysis, folder=self.folder).result.Stresses, "calculix")

    def test_every_result_of_a_run(self):
        """Of a bar that is pulled while it gets warm, step by step: each has recovered stresses, and the displacements and temperatures of CalculiX."""
        part, analysis = self.bar("Face1", kind="thermomech")
        chosen = solver_tests.solver_of(analysis)
        chosen.ThermoMechSteadyState, chosen.IterationsUserDefinedTimeStepLength, chosen.TimeInitialStep, chosen.TimeEnd = False, True, 0.25, 1.0
        self.add(analysis, "InitialTemperature", part, initialTemperature=300)
        self.add(analysis, "Temperature", part, "Face1", Temperature=310)
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        found = {}
        for kind in ("recovered", "calculix"):
            results = self.solve(analysis, part, size=2.5, stresses=kind).results
            self.assertEqual([result.Stresses for result in results], [kind] * 4)
            found[kind] = [[np.array(getattr(one, name), float) for name in ("DisplacementVectors", "Temperature", "vonMises")] for one in results]
        for (moved, warm, better), (moved_too, warm_too, own) in zip(*found.values()):
            np.testing.assert_allclose(moved, moved_too, atol=1e-9)
            np.testing.assert_allclose(warm, warm_too, atol=1e-6)
            self.assertLess(np.sqrt(np.mean((better - own) ** 2)), 0.02 * own.max())
            self.assertTrue((better != own).any())

    def test_buckling_has_calculix_stresses(self):
        part, analysis = self.loaded()
        solver_tests.solver_of(analysis).AnalysisType = "buckling"
        solution = polycube.solve(analysis, folder=self.folder, stresses="recovered")
        self.assertEqual((len(solution.results), solution.recovered, solution.energy_error), (2, None, None))
        with open(solution.path, encoding="utf-8") as file:
            self.assertNotIn("*EL PRINT", file.read())

    def test_planes_of_symmetry_of_an_input_file(self):
        part, analysis = self.plate()
        solution = self.solve(analysis, part, size=5)
        found = solution.recovered
        sides = recovery.boundary(found.cells, len(found.points))
        planes = symmetry.planes(solution.path, found.nodes.tolist(), found.points, sides)
        self.assertEqual([axis for axis, _ in planes], [0, 1, 2])
        for axis, nodes in planes:
            self.assertLess(np.abs(found.points[nodes, axis]).max(), 1e-6)
            self.assertEqual(len(nodes), (np.abs(found.points[:, axis]) < 1e-6).sum())
        with open(solution.path, encoding="utf-8") as file:
            text = file.read()
        for more in ("*TEMPERATURE\nNall,1.\n*END STEP", "*DLOAD\nEall,GRAV,9810.,0.,0.,-1.\n*END STEP", "*BOUNDARY\nNall,1,3\n*END STEP"):
            with open(solution.path, "w", encoding="utf-8") as file:
                file.write(text.replace("*END STEP", more))
            self.assertEqual(symmetry.planes(solution.path, found.nodes.tolist(), found.points, sides), [])
        # a force along a plane leaves the others, though these have nodes on the edges that they share with it
        on_plane = planes[0][1]
        for axis, left in ((2, [1, 2]), (1, [0, 1, 2])):
            rows = "".join("{},{},1.\n".format(found.nodes[node], axis) for node in on_plane)
            with open(solution.path, "w", encoding="utf-8") as file:
                file.write(text.replace("*END STEP", "*CLOAD\n" + rows + "*END STEP"))
            again = symmetry.planes(solution.path, found.nodes.tolist(), found.points, sides)
            self.assertEqual([axis for axis, _ in again], left)
            for axis, nodes in again:
                self.assertEqual(len(nodes), (np.abs(found.points[:, axis]) < 1e-6).sum())

    def test_a_force_along_a_plane_that_is_held_across(self):
        """A cube drawn along such a plane has the same shear in it as everywhere, which an image on the other side would take away."""
        part = self.part(Part.makeBox(20, 20, 20))
        face = {place: "Face{}".format(n) for n, f in enumerate(part.Shape.Faces, 1) for place in [tuple(round(x) for x in f.CenterOfMass)]}
        analysis = self.analysis(part, [face[20, 10, 10]], PoissonRatio="0")
        self.add(analysis, "Displacement", part, face[0, 10, 10], xFree=False, xFix=True)
        self.add(analysis, "Force", part, face[0, 10, 10], Force=10000, Direction=(part, ["Edge{}".format(self.along_y(part))]))
        # an even pressure across adds stresses that an error in the shear is small beside
        for y, z in ((0, 10), (20, 10), (10, 0), (10, 20)):
            self.add(analysis, "Pressure", part, face[10, y, z], Pressure=500)
        solution = self.solve(analysis, part, size=4)
        places = self.mesh(analysis).FemMesh.Nodes
        middle = [n for n, node in enumerate(solution.result.NodeNumbers) if places[node].x < 1e-6 and (places[node] - Vector(0, 10, 10)).Length < 3]
        self.assertTrue(middle)
        for row in middle:
            self.assertGreater(abs(solution.result.NodeStressXY[row]), 15)

    def along_y(self, part):
        return next(n for n, edge in enumerate(part.Shape.Edges, 1) if abs(edge.tangentAt(edge.FirstParameter).y) > 0.9)
