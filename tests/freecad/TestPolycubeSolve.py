"""polycube.solve: every constraint of FreeCAD that acts on solids acts on hexahedra, with its whole."""

import math
import os
import re
from unittest import mock

import FreeCAD
import Part
import TestPolycubeLoads as whole_loads
import TestPolycubeSolver as solver_tests
from FreeCAD import Vector

from freecad import polycube
from freecad.polycube import deck, fem_mesh, special_loads

calculix = solver_tests.calculix

#: of steel, in N, mm, t
YOUNG, DENSITY = 210000.0, 7.85e-9


def total_of(path, name):
    """Sum of the reactions that CalculiX printed last of a node set."""
    with open(os.path.splitext(path)[0] + ".dat", encoding="utf-8") as file:
        text = file.read()
    numbers = text[text.rindex("for set {} ".format(name.upper())) :].splitlines()[2].split()
    return Vector(*map(float, numbers))


def loads_of(path):
    """{node: force} of the *CLOAD lines."""
    found, reading = {}, False
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("*"):
                reading = reading and line.startswith("**") or line.upper().startswith("*CLOAD")
            elif reading and re.match(r"\d+,\d,", line):
                node, along, value = line.split(",")
                found.setdefault(int(node), Vector())[int(along) - 1] += float(value)
    return found


@solver_tests.needs_calculix
class SolveTest(whole_loads.LoadTest):
    def analysis(self, part, fixed, kind="static", **material):
        analysis, solver = calculix.make_analysis(part, fixed)
        solver.AnalysisType = kind
        steel = next(member for member in analysis.Group if member.TypeId == "App::MaterialObjectPython")
        heat = {"ThermalConductivity": "50 W/m/K", "ThermalExpansionCoefficient": "0 m/m/K", "SpecificHeat": "500 J/kg/K"}
        steel.Material = dict(steel.Material, **heat, **material)
        if not fixed:
            self.document.removeObject("Support")
        return analysis

    def bar(self, *fixed, **options):
        """A bar of 40 x 10 x 10 mm and its analysis, fixed at faces: Face1 and Face2 are its ends."""
        part = self.part(Part.makeBox(40, 10, 10))
        return part, self.analysis(part, fixed, **options)

    def solve(self, analysis, part, size=5, order=2, **options):
        """Every static case is in balance, but those with contact and ties."""
        if not any(member.isDerivedFrom("Fem::FemMeshObject") for member in analysis.Group):
            polycube.create_fem_mesh(part, size=size, order=order, min_layers=1, analysis=analysis)
        self.document.recompute()
        solution = polycube.solve(analysis, folder=self.folder, **options)
        if solution.balance:
            self.assertTrue(solution.balance.holds, solution.balance.line())
        kinds = {kind for member in analysis.Group for kind in ("Contact", "Tie") if kind in member.Name}
        known = solver_tests.solver_of(analysis).AnalysisType in ("static", "thermomech") and not kinds
        self.assertEqual(solution.balance is not None, known)
        return solution

    def mesh(self, analysis):
        return next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemMeshObject"))

    def of_face(self, solution, analysis, name, values):
        """The values, one per node of the result, at the nodes of a face."""
        mesh = self.mesh(analysis).FemMesh
        nodes = {node for quad in self.group(mesh, name) for node in mesh.getElementNodes(quad)}
        return [value for node, value in zip(solution.result.NodeNumbers, values) if node in nodes]

    def near(self, found, expected, share=5e-3):
        found, expected = ((Vector(vector) if isinstance(vector, Vector) else Vector(vector, 0, 0)) for vector in (found, expected))
        self.assertLess((found - expected).Length, share * expected.Length, (found, expected))


class Mechanical(SolveTest):
    def test_force_and_fixed(self):
        for order in (1, 2):
            for loaded in ("Face2", "Edge5", "Vertex5"):
                with self.subTest(loaded, order=order):
                    part, analysis = self.bar("Face1")
                    self.add(analysis, "Force", part, loaded, Force=1000, Direction=(part, ["Face2"]))
                    solution = self.solve(analysis, part, order=order)
                    self.near(total_of(solution.path, "Support"), Vector(-1000, 0, 0))

    def test_pressure(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Pressure", part, "Face2", Pressure=5.0)
        self.near(total_of(self.solve(analysis, part).path, "Support"), Vector(500, 0, 0))

    def test_displacement(self):
        part, analysis = self.bar("Face1", PoissonRatio="0")
        self.add(analysis, "Displacement", part, "Face2", xFree=False, xDisplacement=0.01)
        self.near(total_of(self.solve(analysis, part).path, "Displacement"), Vector(YOUNG * 0.01 / 40 * 100, 0, 0))

    def test_plane_rotation(self):
        """A force on a corner tilts the end of the bar, which stays plane."""
        part, analysis = self.bar("Face1")
        self.add(analysis, "PlaneRotation", part, "Face2")
        corner = next("Vertex{}".format(n) for n, v in enumerate(part.Shape.Vertexes, 1) if v.Point == Vector(40, 10, 10))
        self.add(analysis, "Force", part, corner, Force=1000, Direction=(part, ["Face2"]))
        solution = self.solve(analysis, part)
        self.near(total_of(solution.path, "Support"), Vector(-1000, 0, 0))
        mesh = self.mesh(analysis).FemMesh
        ends = {n: u for n, u in zip(solution.result.NodeNumbers, solution.result.DisplacementVectors) if mesh.Nodes[n].x > 39.9}
        by_place = {(round(mesh.Nodes[n].y), round(mesh.Nodes[n].z)): u.x for n, u in ends.items()}
        self.assertGreater(max(by_place.values()), 1.5 * min(by_place.values()))
        middle = (by_place[0, 0] + by_place[10, 10]) / 2
        self.assertAlmostEqual(by_place[5, 5] / middle, 1, delta=1e-3)

    def test_self_weight(self):
        for order in (1, 2):
            with self.subTest(order=order):
                part, analysis = self.bar("Face1")
                self.add(analysis, "SelfWeight", part)
                solution = self.solve(analysis, part, order=order)
                self.near(Vector(*solution.balance.reactions), Vector(0, 0, DENSITY * 4000 * 9806))

    def test_centrifugal(self):
        part, analysis = self.bar("Face1")
        axis = next("Edge{}".format(n) for n, edge in enumerate(part.Shape.Edges, 1) if edge.BoundBox.XMax < 1 and edge.BoundBox.YMax < 1)
        centrif = self.add(analysis, "Centrif", part, RotationFrequency="100 1/s")
        centrif.RotationAxis = [(part, axis)]
        reactions = self.solve(analysis, part).balance.reactions
        # the axis is the edge along Z, at the corner of the bar's middle line: 20 mm and 5 mm from it
        self.near(Vector(*reactions), Vector(-20, -5, 0) * (DENSITY * 4000 * (2 * math.pi * 100) ** 2))

    def test_loads_on_the_same_nodes_and_faces_add_up(self):
        part, outer, inner, ends = self.tube(20.0, 10.0, 30.0)
        analysis = self.analysis(part, [ends[0]])
        for force in (1000, 500):
            self.add(analysis, "Force", part, ends[1], Force=force, Direction=(part, [ends[1]]))
        self.add(analysis, "Force", part, outer, Force=300, Direction=(part, [ends[1]]))
        self.add(analysis, "Gear", part, outer, Diameter=60, Force=200, Direction=(part, [ends[1]]))
        for pressure in (2.0, 1.0):
            self.add(analysis, "Pressure", part, ends[1], Pressure=pressure)
        self.near(Vector(*self.solve(analysis, part).balance.reactions), Vector(0, 0, 3 * math.pi * 300 - 2000))

    def test_a_face_that_is_named_twice_is_loaded_once(self):
        part, outer, inner, ends = self.tube(20.0, 10.0, 30.0)
        analysis = self.analysis(part, [ends[0]])
        for kind, names, properties in (
            ("Pressure", [ends[1]] * 2, {"Pressure": 1.0}),
            ("Force", [outer, inner, outer], {"Force": 300, "Direction": (part, [ends[1]])}),
            ("Gear", [outer] * 2, {"Diameter": 60, "Force": 200, "Direction": (part, [ends[1]])}),
        ):
            self.add(analysis, kind, part, names[0], **properties).References = [(part, name) for name in names]
        solution = self.solve(analysis, part)
        self.near(Vector(*solution.balance.reactions), Vector(0, 0, math.pi * 300 - 500))

    def test_loads_that_get_lost_are_told(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Pressure", part, "Face2", Pressure=5.0)
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        polycube.create_fem_mesh(part, size=5, analysis=analysis)
        self.document.recompute()
        lost = mock.patch.object(deck, "add_cards", lambda text, model, step: add_cards(text.replace("*DLOAD", "*DLOAD, AMPLITUDE=NOTHING"), model, step))
        add_cards = deck.add_cards
        with lost, mock.patch.object(deck, "set_types", lambda text, *_: text + "\n*AMPLITUDE, NAME=NOTHING\n0.,0.,1.,0.\n"):
            solution = polycube.solve(analysis, folder=self.folder)
        self.assertAlmostEqual(solution.balance.miss, 500 / 1500, delta=1e-3)
        self.assertEqual(solution.notes, [solution.balance.line()])
        self.assertIn("NOT IN BALANCE by 33 %", solution.notes[0])

    def test_transform(self):
        """A tube whose bore is turned by 0.01 mm, in coordinates round its axis; outside it is held. A moment of 4 pi G h times the angle turns it back."""
        part, outer, inner, _ = self.tube(20.0, 10.0, 10.0)
        analysis = self.analysis(part, [outer])
        turned = self.add(analysis, "Displacement", part, inner, xFree=False, xFix=True, yFree=False, yDisplacement=0.01, zFree=False, zFix=True)
        self.add(analysis, "Transform", part, inner, TransformType="Cylindrical", NameDispl=[turned])
        self.document.recompute()
        solution = self.solve(analysis, part, size=2.5)
        bore = [vector.Length for vector in self.of_face(solution, analysis, inner, solution.result.DisplacementVectors)]
        self.assertLess(max(abs(length - 0.01) for length in bore), 1e-6)
        middle = [
            vector.Length
            for node, vector in zip(solution.result.NodeNumbers, solution.result.DisplacementVectors)
            if abs(math.hypot(*self.mesh(analysis).FemMesh.Nodes[node][:2]) - 15) < 0.1
        ]
        # between r and the outer side the angle is as 1/r^2 - 1/20^2
        exact = 15 * 0.01 / 10 * (1 / 15**2 - 1 / 20**2) / (1 / 10**2 - 1 / 20**2)
        self.assertTrue(middle)
        self.near(sum(middle) / len(middle), exact, 0.03)

    def test_contact_and_tie(self):
        """A clip of two arms: the lower is held, the upper pressed onto it. The gap closes, and no more; glued together they bend as one."""
        slot = Part.makeBox(40, 10, 1, Vector(10, 0, 5))
        shape = Part.makeBox(50, 10, 11).cut(slot)
        heights = {}
        for number, face in enumerate(shape.Faces, 1):
            if abs(face.normalAt(0, 0).z) > 0.9:
                heights[round(face.CenterOfMass.z)] = "Face{}".format(number)
        moved = {}
        for kind in (None, "Contact", "Tie"):
            part = self.part(shape)
            analysis = self.analysis(part, [heights[0]], YoungsModulus="1000 MPa")
            self.add(analysis, "Force", part, heights[11], Force=600, Direction=(part, [heights[11]]), Reversed=True)
            if kind == "Contact":
                self.add(analysis, kind, part, heights[6], heights[5], Slope=1e5)
            elif kind:
                self.add(analysis, kind, part, heights[6], heights[5], Tolerance=1.1)
            solution = self.solve(analysis, part, size=5)
            self.near(solver_tests.nodal_loads(solution.path), Vector(0, 0, -600))
            self.near(total_of(solution.path, "Support"), Vector(0, 0, 600))
            moved[kind] = -min(vector.z for vector in self.of_face(solution, analysis, heights[6], solution.result.DisplacementVectors))
        self.assertGreater(moved[None], 2)
        self.assertAlmostEqual(moved["Contact"], 1, delta=0.1)
        self.assertLess(moved["Tie"], 0.1)

    def test_section_print(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        self.add(analysis, "SectionPrint", part, "Face2")
        solution = self.solve(analysis, part)
        with open(os.path.splitext(solution.path)[0] + ".dat", encoding="utf-8") as file:
            section = file.read().split("statistics for surface set")[1]
        force = [float(number) for number in re.findall(r"-?\d\.\d+E[+-]\d+", section[section.index("\n") :])[:3]]
        self.near(abs(force[0]), 1000)


class Special(SolveTest):
    """What FreeCAD's own writer leaves out."""

    def wheel(self, *fixed):
        part, outer, inner, ends = self.tube(20.0, 10.0, 30.0)
        self.names = {"outer": outer, "inner": inner, "bottom": ends[0], "top": ends[1]}
        return part, self.analysis(part, [self.names[name] for name in fixed])

    def check_pull(self, analysis, solution, force, moment):
        points = self.mesh(analysis).FemMesh.Nodes
        loads = loads_of(solution.path)
        self.near(sum(loads.values(), Vector()), force)
        self.near(sum((points[node].cross(load) for node, load in loads.items()), Vector()), moment)
        self.assertGreater(max(solution.result.DisplacementLengths), 0)

    def test_gear(self):
        for angle in (0, 90):
            with self.subTest(angle):
                part, analysis = self.wheel("bottom")
                gear = self.add(analysis, "Gear", part, self.names["outer"], Diameter=60, Force=500, Direction=(part, [self.names["top"]]))
                gear.ForceAngle = angle
                solution = self.solve(analysis, part)
                self.document.recompute()
                arm = Vector(*(round(value) for value in special_loads._wheel(gear.Axis)(math.radians(angle)) * 30))
                self.assertAlmostEqual(arm.Length, 30)
                self.check_pull(analysis, solution, Vector(0, 0, 500), (gear.BasePoint + arm).cross(Vector(0, 0, 500)))

    def test_pulley(self):
        part, analysis = self.wheel("bottom")
        # a moment of 1 Nm on a wheel of 100 mm: the one belt pulls 20 N more than the other
        pulley = self.add(analysis, "Pulley", part, self.names["outer"], Diameter=100, OtherDiameter=100)
        calculix.set_quantity(pulley, "TensionForce", 30, "N")
        calculix.set_quantity(pulley, "Force", 1, "N")
        self.document.recompute()
        solution = self.solve(analysis, part)
        total = sum(loads_of(solution.path).values(), Vector())
        self.near(total.Length, 80)
        self.assertAlmostEqual(total.z, 0, delta=1e-6)
        points = self.mesh(analysis).FemMesh.Nodes
        moment = sum((points[node].cross(load) for node, load in loads_of(solution.path).items()), Vector())
        self.near(abs(moment.z), 1000)

    def test_bearing(self):
        """A wheel on an axle pulled sideways; one point keeps it from turning."""
        for free in (False, True):
            with self.subTest(axial_free=free):
                part, analysis = self.wheel()
                self.add(analysis, "Bearing", part, self.names["inner"], AxialFree=free)
                seam = next(n for n, edge in enumerate(part.Shape.Edges, 1) if not edge.Closed and abs(edge.CenterOfMass.x - 20) < 1e-6)
                rim = next(n for n, point in enumerate(part.Shape.Vertexes, 1) if point.isSame(part.Shape.Edges[seam - 1].Vertexes[0]))
                self.add(analysis, "Displacement", part, "Vertex{}".format(rim), yFree=False, yFix=True, zFree=not free, zFix=free)
                self.add(analysis, "Force", part, self.names["top"], Force=1000, Direction=(part, ["Edge{}".format(seam)]))
                push = self.document.getObject("Force")
                push.DirectionVector = Vector(1, 0, 0)
                solution = self.solve(analysis, part)
                load = sum(loads_of(solution.path).values(), Vector())
                self.near(load.Length, 1000)
                self.near(Vector(*solution.balance.reactions) * -1, load)
                bore = self.of_face(solution, analysis, self.names["inner"], solution.result.DisplacementVectors)
                mesh = self.mesh(analysis).FemMesh
                nodes = {node for quad in self.group(mesh, self.names["inner"]) for node in mesh.getElementNodes(quad)}
                places = [mesh.Nodes[node] for node in solution.result.NodeNumbers if node in nodes]
                radial = max(abs(Vector(p.x, p.y, 0).normalize().dot(u)) for p, u in zip(places, bore))
                self.assertLess(radial, 1e-5 * max(solution.result.DisplacementLengths))
                self.assertEqual(max(abs(u.z) for u in bore) > 1e-9, free)

    def test_spring(self):
        """A bar on springs, pulled: its face moves by force over stiffness, along the normal and across."""
        for direction, stiffness in (("Face2", 2000), ("Face4", 500)):
            with self.subTest(direction):
                part, analysis = self.bar(PoissonRatio="0")
                self.add(analysis, "Spring", part, "Face1", normalStiffness=2e6, tangentialStiffness=5e5)
                self.add(analysis, "Force", part, "Face1", Force=100, Direction=(part, [direction]))
                solution = self.solve(analysis, part)
                moved = self.of_face(solution, analysis, "Face1", solution.result.DisplacementVectors)
                self.near(sum(moved, Vector()).Length / len(moved), 100 / stiffness)
                self.near(total_of(solution.path, "POLYCUBE_SUPPORTS").Length, 100)
                mesh = solution.result.Mesh.FemMesh
                self.assertEqual((mesh.NodeCount, mesh.EdgeCount), (self.mesh(analysis).FemMesh.NodeCount, 0))
                self.assertEqual(len(solution.result.NodeNumbers), mesh.NodeCount)

    def test_springs_leave_stresses_alone(self):
        """CalculiX takes them for cells without stress in the means at nodes: a bar that is pulled had a half and a third of its stress at soft springs."""
        for order in (1, 2):
            with self.subTest(order=order):
                part, analysis = self.bar("Face1", PoissonRatio="0")
                self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
                for face in ("Face3", "Face6"):
                    self.add(analysis, "Spring", part, face, normalStiffness=1e-6)
                result = self.solve(analysis, part, order=order, stresses="calculix").result
                for values, expected in ((result.vonMises, 10), (result.NodeStrainXX, 10 / YOUNG)):
                    self.assertEqual(len(values), len(result.NodeNumbers))
                    for found in values:
                        self.assertAlmostEqual(found / expected, 1, delta=1e-4)

    def test_what_is_missing_is_refused_by_name(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Gear", part)
        with self.assertRaisesRegex(polycube.InvalidInput, "^Gear: it needs a round face"):
            self.solve(analysis, part)
        self.document.removeObject("Gear")
        other = self.document.addObject("Part::Box", "Other")
        self.document.recompute()
        other.Placement.Base = Vector(100, 0, 0)
        self.document.recompute()
        self.add(analysis, "Pressure", other, "Face2", Pressure=1.0)
        with self.assertRaisesRegex(polycube.InvalidInput, "^Pressure: nothing of the mesh is where it acts"):
            self.solve(analysis, part)

    def test_several_meshes_are_refused_by_name(self):
        part, analysis = self.bar("Face1")
        meshes = [polycube.create_fem_mesh(part, size=5, order=order, min_layers=1, analysis=analysis) for order in (1, 2)]
        with self.assertRaisesRegex(polycube.InvalidInput, "has several meshes, one is needed: PolycubeMesh, PolycubeMesh"):
            self.solve(analysis, part)
        self.document.removeObject(meshes[0].Name)
        self.assertEqual(self.solve(analysis, part).element, "C3D20R")

    def test_a_folder_that_cannot_be_made_is_refused(self):
        part, analysis = self.bar("Face1")
        polycube.create_fem_mesh(part, size=5, min_layers=1, analysis=analysis)
        path = os.path.join(self.folder, "file")
        with open(path, "w", encoding="utf-8"):
            pass
        for folder in (path, os.path.join(path, "below"), 5):
            with self.assertRaisesRegex(polycube.InvalidInput, "^no folder for CalculiX' files: "):
                polycube.solve(analysis, folder=folder)

    def test_a_part_that_can_move_as_a_whole_is_told(self):
        """Held along X by one end, then in Y and Z at one corner, then in Y at another."""
        part, analysis = self.bar()
        self.add(analysis, "Displacement", part, "Face1", xFree=False, xFix=True)
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        corners = {tuple(vertex.Point): "Vertex{}".format(n) for n, vertex in enumerate(part.Shape.Vertexes, 1)}
        for ways, corner, more in ((3, (0, 0, 0), ("y", "z")), (1, (0, 0, 10), ("y",)), (0, None, ())):
            line = "the supports leave the part free to move as a whole in {} of 6 ways: displacements mean nothing".format(ways)
            self.assertEqual([note for note in self.solve(analysis, part).notes if "whole in" in note], [line] if ways else [])
            if corner:
                self.add(analysis, "Displacement", part, corners[corner], **{axis + end: end == "Fix" for axis in more for end in ("Free", "Fix")})

    def test_what_the_part_has_no_more_is_refused_by_name(self):
        part, analysis = self.bar("Face1")
        polycube.create_fem_mesh(part, size=5, analysis=analysis)
        self.add(analysis, "Force", part, "Face6", Force=100.0)
        part.Shape = Part.makeCylinder(5, 40)
        self.document.recompute()
        self.assertEqual(fem_mesh.constrained_faces(part, analysis), ["Face1"])
        polycube.update_fem_mesh(self.mesh(analysis))
        with self.assertRaisesRegex(polycube.InvalidInput, "^Force: .* has no Face6$"):
            polycube.solve(analysis, folder=self.folder)

    def test_an_edge_that_is_a_point_is_refused(self):
        part = self.part(Part.makeCone(10, 0, 20))
        tip = next(i for i, edge in enumerate(part.Shape.Edges, 1) if edge.Length < 1e-9)
        base = next(i for i, face in enumerate(part.Shape.Faces, 1) if isinstance(face.Surface, Part.Plane))
        analysis = self.analysis(part, ["Face{}".format(base)])
        polycube.create_fem_mesh(part, size=5, analysis=analysis)
        self.add(analysis, "Force", part, "Edge{}".format(tip), Force=100.0)
        with self.assertRaisesRegex(polycube.InvalidInput, "^Force: Edge{} of .* is a point$".format(tip)):
            polycube.solve(analysis, folder=self.folder)

    def test_equations_of_a_node(self):
        self.assertEqual(special_loads.reduced([[0, 0, 1]], ()), [[(3, 1.0)]])
        self.assertEqual(special_loads.reduced([[0, 0, 1]], (3,)), [])
        self.assertEqual(special_loads.reduced([[0.6, 0.8, 0]], (2,)), [[(1, 1.0), (2, 0.8 / 0.6)]])
        both = special_loads.reduced([[0.6, 0.8, 0], [0.8, -0.6, 0]], ())
        self.assertEqual(both, [[(2, 1.0)], [(1, 1.0)]])
        self.assertEqual(special_loads.reduced([[0.6, 0.8, 0]], (1, 2, 3)), [])


class Heat(SolveTest):
    """A tube held at 300 K outside; heat comes in at the bore, or in the wall. Closed forms of the temperature at the bore."""

    OUTER, INNER, CONDUCTIVITY = 0.02, 0.01, 50.0

    def temperature(self, order=2, size=3, **heat):
        part, outer, inner, ends = self.tube(self.OUTER * 1000, self.INNER * 1000, 10.0)
        analysis = self.analysis(part, [ends[0]], kind="thermomech")
        solver_tests.solver_of(analysis).ThermoMechSteadyState = True
        self.add(analysis, "InitialTemperature", part, initialTemperature=300)
        self.add(analysis, "Temperature", part, outer, Temperature=300)
        kind = heat.pop("kind")
        self.add(analysis, kind, part, *([inner] if kind == "Heatflux" else ["Solid1"]), **heat)
        solution = self.solve(analysis, part, size=size, order=order)
        self.assertEqual(solution.element, "C3D20" if order == 2 else "C3D8I")
        values = self.of_face(solution, analysis, inner, solution.result.Temperature)
        return sum(values) / len(values)

    def test_flux(self):
        expected = 50000 * self.INNER * math.log(self.OUTER / self.INNER) / self.CONDUCTIVITY
        self.near(self.temperature(kind="Heatflux", ConstraintType="DFlux", DFlux=50000) - 300, expected, 1e-3)

    def test_film(self):
        at_wall, through = 1 / (2000 * self.INNER), math.log(self.OUTER / self.INNER) / self.CONDUCTIVITY
        found = self.temperature(kind="Heatflux", ConstraintType="Convection", AmbientTemp=400, FilmCoef=2000)
        self.near(found - 300, 100 * through / (at_wall + through), 1e-3)

    def test_body_heat(self):
        power = 10000 * 7850  # W/kg times kg/m3
        first = power / 4 / self.CONDUCTIVITY * (self.OUTER**2 - self.INNER**2)
        expected = first - power * self.INNER**2 / 2 / self.CONDUCTIVITY * math.log(self.OUTER / self.INNER)
        rate = "HeatSource" if FreeCAD.Version()[0] == "0" else "DissipationRate"
        self.near(self.temperature(kind="BodyHeatSource", **{rate: 10000}) - 300, expected, 1e-3)

    def test_flux_of_nodes(self):
        part, analysis = self.bar("Face1", kind="thermomech")
        solver_tests.solver_of(analysis).ThermoMechSteadyState = True
        self.add(analysis, "InitialTemperature", part, initialTemperature=300)
        self.add(analysis, "Temperature", part, "Face1", Temperature=300)
        self.add(analysis, "Temperature", part, "Face2", ConstraintType="CFlux", CFlux=2e6)
        solution = self.solve(analysis, part)
        values = self.of_face(solution, analysis, "Face1", solution.result.Temperature)
        self.assertAlmostEqual(max(values), 300, delta=1e-3)
        middle = [t for n, t in zip(solution.result.NodeNumbers, solution.result.Temperature) if abs(self.mesh(analysis).FemMesh.Nodes[n].x - 20) < 1e-6]
        # 2 W through 0.02 m of 1e-4 m2
        self.near(sum(middle) / len(middle) - 300, 2 * 0.02 / (50 * 1e-4), 1e-2)

    def test_expansion_that_is_held(self):
        part, analysis = self.bar(kind="thermomech", PoissonRatio="0")
        steel = next(member for member in analysis.Group if member.TypeId == "App::MaterialObjectPython")
        steel.Material = dict(steel.Material, ThermalExpansionCoefficient="1e-5 m/m/K")
        solver_tests.solver_of(analysis).ThermoMechSteadyState = True
        self.add(analysis, "InitialTemperature", part, initialTemperature=300)
        self.add(analysis, "Temperature", part, "Face1", "Face2", Temperature=400)
        self.add(analysis, "Displacement", part, "Face1", xFree=False, xFix=True)
        self.add(analysis, "Displacement", part, "Face2", xFree=False, xFix=True)
        self.add(analysis, "Displacement", part, "Edge1", yFree=False, yFix=True, zFree=False, zFix=True)
        solution = self.solve(analysis, part)
        self.near(total_of(solution.path, "Displacement"), Vector(YOUNG * 1e-5 * 100 * 100, 0, 0))
