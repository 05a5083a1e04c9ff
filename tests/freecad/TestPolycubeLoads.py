"""Loads and heat of FreeCAD's objects arrive whole in the solver's input, made before or after the mesh, on straight and curved faces."""

import json
import math
import os
import re
from unittest import mock

import FreeCAD
import Part
import TestPolycubeSolver as solver_tests
from FreeCAD import Vector
from femmesh import meshtools

from freecad import polycube
from freecad.polycube import load_sets, objects, shapes

calculix = solver_tests.calculix


class LoadTest(solver_tests.SolverTest):
    def part(self, shape):
        self.document = FreeCAD.newDocument()
        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = shape
        return part

    def tube(self, outer=10.0, inner=9.3, height=10.0):
        """Walls so thin for the cells that arcs on the CAD need inner edges to give way: (part, name of the outer side, of the inner, ends)"""
        part = self.part(Part.makeCylinder(outer, height).cut(Part.makeCylinder(inner, height)))
        names = {}
        for number, face in enumerate(part.Shape.Faces, 1):
            key = face.Surface.Radius if face.Surface.TypeId == "Part::GeomCylinder" else face.CenterOfMass.z
            names[round(key, 6)] = "Face{}".format(number)
        return part, names[outer], names[inner], (names[0.0], names[height])

    def add(self, analysis, kind, part, *names, **values):
        return calculix.add_constraint(analysis, kind, part, names, **values)

    def written(self, analysis):
        """Path of the input file that FreeCAD writes."""
        return calculix.write(analysis, solver_tests.solver_of(analysis), self.folder).inp_file_name

    def in_turned_container(self):
        """(container, a box of 10 mm in it)"""
        self.document = FreeCAD.newDocument()
        container = self.document.addObject("App::Part", "Container")
        box = self.document.addObject("Part::Box", "Box")
        container.addObject(box)
        container.Placement = FreeCAD.Placement(Vector(5, -3, 2), FreeCAD.Rotation(Vector(1, 2, 3), 50))
        self.document.recompute()
        return container, box

    def group(self, mesh, name):
        return next(mesh.getGroupElements(group) for group in mesh.Groups if mesh.getGroupName(group) == name)


class MechanicalLoads(LoadTest):
    def check_totals(self, when, order):
        part, outer, inner, ends = self.tube()
        analysis, solver = calculix.make_analysis(part, [ends[0]])

        def load():
            self.add(analysis, "Force", part, outer, Force=1000, Direction=(part, [ends[1]]))
            self.add(analysis, "Pressure", part, inner, Pressure=5.0)

        if when == "before":
            load()
        obj = polycube.create_fem_mesh(part, size=9, order=order, analysis=analysis)
        self.assertEqual(json.loads(obj.Report)["quality"]["straightened_edges"], 0)
        if when == "after":
            load()
        self.document.recompute()
        path = self.written(analysis)
        self.assertAlmostEqual(solver_tests.nodal_loads(path).Length, 1000, delta=0.01)
        self.assertEqual(len(set(solver_tests.pressure_faces(path))), len(self.group(obj.FemMesh, inner)))

    def test_loads_made_before_the_mesh(self):
        for order in (1, 2):
            with self.subTest(order=order):
                self.check_totals("before", order)

    def test_loads_made_after_the_mesh(self):
        for order in (1, 2):
            with self.subTest(order=order):
                self.check_totals("after", order)

    def test_freecads_own_search_finds_all_nodes_and_mesh_faces(self):
        """Mid-edge nodes are on the CAD: nothing is lost where our groups are not asked."""
        part, outer, inner, _ = self.tube()
        mesh = polycube.create_fem_mesh(part, size=9).FemMesh
        for name in (outer, inner):
            face = part.Shape.getElement(name)
            self.assertEqual(set(mesh.getFacesByFace(face)), set(self.group(mesh, name)))
            self.assertEqual(set(mesh.getNodesByFace(face)), {node for quad in self.group(mesh, name) for node in mesh.getElementNodes(quad)})

    def test_nodes_off_the_cad_lose_no_load(self):
        """Loads, supports and pressures on a face whose nodes FreeCAD's search does not find, made after the mesh, and moved to it."""
        part = self.part(Part.makeBox(10, 10, 10))
        analysis, solver = calculix.make_analysis(part, ["Face1"])
        result = polycube.mesh(part, size=5)
        result.nodes[result.groups["Face1"]["nodes"]] += (1e-6, 0, 0)
        result.nodes[result.groups["Face2"]["nodes"]] += (1e-6, 0, 0)
        obj = objects.make(self.document, part)
        analysis.addObject(obj)
        self.assertEqual(self.set_mesh(obj, result), [])
        self.assertFalse(obj.FemMesh.getFacesByFace(part.Shape.getElement("Face2")))
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        pressure = self.add(analysis, "Pressure", part, "Face3", Pressure=2.0)
        pressure.References = [(part, "Face2")]
        # A group of this name is older than the support's present face.
        support = next(member for member in analysis.Group if member.isDerivedFrom("Fem::ConstraintFixed"))
        self.assertIn("Support_Nodes", [obj.FemMesh.getGroupName(group) for group in obj.FemMesh.Groups])
        path = self.written(analysis)
        self.assertLess((solver_tests.nodal_loads(path) - Vector(1000, 0, 0)).Length, 1e-6)
        self.assertEqual(len(solver_tests.pressure_faces(path)), len(result.groups["Face2"]["quads"]))
        self.assertEqual(self.fixed(path, support), set((result.groups["Face1"]["nodes"] + 1).tolist()))
        support.References = [(part, "Face5")]
        self.assertEqual(self.fixed(self.written(analysis), support), set((result.groups["Face5"]["nodes"] + 1).tolist()))

    def test_supports_on_copies_of_a_face(self):
        """Both sections of a part of revolution are one face in two places, and FreeCAD 1.x looks up copies of them."""
        section = Part.Face(Part.makePolygon([Vector(10, 0, 0), Vector(20, 0, 0), Vector(20, 0, 5), Vector(10, 0, 5), Vector(10, 0, 0)]))
        part = self.part(section.revolve(Vector(), Vector(0, 0, 1), 90))
        ends = {name: at for name in ("x", "y") for at, face in enumerate(part.Shape.Faces, 1) if abs(getattr(face.CenterOfMass, name)) < 1e-6}
        analysis, solver = calculix.make_analysis(part, ["Face{}".format(ends["x"])])
        supports = {"x": next(member for member in analysis.Group if member.isDerivedFrom("Fem::ConstraintFixed"))}
        supports["y"] = self.add(analysis, "Fixed", part, "Face{}".format(ends["y"]))
        mesh = polycube.create_fem_mesh(part, size=5, analysis=analysis).FemMesh
        self.document.recompute()
        path = self.written(analysis)
        for name, support in supports.items():
            on = {number for number, point in mesh.Nodes.items() if abs(getattr(point, name)) < 1e-6}
            self.assertEqual(self.fixed(path, support), on, name)

    def fixed(self, path, support):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        block = re.search(r"\*NSET,NSET={}\n((?:\d+,\n)+)".format(support.Name), text).group(1)
        return {int(number) for number in re.findall(r"\d+", block)}

    def test_force_on_edges_and_several_faces(self):
        part, outer, inner, ends = self.tube()
        rim = next(n for n, edge in enumerate(part.Shape.Edges, 1) if edge.Closed and edge.Curve.Radius == 10 and edge.CenterOfMass.z > 9)
        for names in ([outer, inner], ["Edge{}".format(rim)]):
            with self.subTest(names):
                analysis, solver = calculix.make_analysis(part, [ends[0]])
                polycube.create_fem_mesh(part, size=9, analysis=analysis)
                self.add(analysis, "Force", part, *names, Force=1000, Direction=(part, [ends[1]]))
                self.document.recompute()
                path = self.written(analysis)
                self.assertAlmostEqual(solver_tests.nodal_loads(path).Length, 1000, delta=0.01)
                for member in [*analysis.Group, analysis]:
                    self.document.removeObject(member.Name)

    def test_pressure_on_both_faces_of_a_thin_wall(self):
        """All nodes are on the two faces; the sides in between carry nothing."""
        part = self.part(Part.makeBox(20, 20, 2))
        analysis, _ = calculix.make_analysis(part, ["Face1"])
        mesh = polycube.create_fem_mesh(part, size=5, order=1, min_layers=1, analysis=analysis).FemMesh
        self.assertEqual(len(mesh.Volumes), len(self.group(mesh, "Face5")))
        self.add(analysis, "Pressure", part, "Face5", "Face6", Pressure=2.0)
        self.assertEqual(len(solver_tests.pressure_faces(self.written(analysis))), 2 * len(mesh.Volumes))

    def test_a_document_that_is_opened_again(self):
        part, outer, _, ends = self.tube()
        analysis, solver = calculix.make_analysis(part, [ends[0]])
        polycube.create_fem_mesh(part, size=9, analysis=analysis)
        self.add(analysis, "Force", part, outer, Force=1000, Direction=(part, [ends[1]]))
        self.document.recompute()
        path = os.path.join(self.folder, "part.FCStd")
        self.document.saveAs(path)
        FreeCAD.closeDocument(self.document.Name)
        self.document = FreeCAD.openDocument(path)
        again = self.written(self.document.Analysis)
        self.assertAlmostEqual(solver_tests.nodal_loads(again).Length, 1000, delta=0.01)

    def test_a_part_that_has_changed_is_searched(self):
        """Its faces may have other numbers than when it was meshed."""
        part = self.part(Part.makeBox(10, 10, 10))
        analysis, solver = calculix.make_analysis(part, ["Face1"])
        polycube.create_fem_mesh(part, size=5, analysis=analysis)
        self.add(analysis, "Pressure", part, "Face2", Pressure=2.0)
        part.Shape = Part.makeBox(12, 10, 10)
        self.document.recompute()
        with mock.patch.object(FreeCAD.Console, "PrintWarning", create=True) as warn:
            path = self.written(analysis)
        self.assertTrue(any("has changed" in call.args[0] for call in warn.call_args_list))
        self.assertEqual(solver_tests.pressure_faces(path), [])

    def test_a_part_that_is_gone_is_searched(self):
        self.document = FreeCAD.newDocument()
        container = self.document.addObject("App::Part", "Container")
        box, other = (container.addObject(self.document.addObject("Part::Box", name))[0] for name in ("Box", "Other"))
        other.Placement.Base = Vector(30, 0, 0)
        container.removeObject(other)
        self.document.recompute()
        analysis, _ = calculix.make_analysis(other, ["Face1"])
        polycube.create_fem_mesh(container, size=5, analysis=analysis)
        container.removeObject(box)
        with mock.patch.object(FreeCAD.Console, "PrintWarning", create=True) as warn:
            self.written(analysis)
        self.assertTrue(any("has changed" in call.args[0] for call in warn.call_args_list))

    def test_a_part_in_a_turned_container(self):
        """FreeCAD 0.20 looks for its faces, and takes the direction of a force, inside the container; the mesh stands where the part is."""
        container, box = self.in_turned_container()
        rims = ["Edge{}".format(n) for n, edge in enumerate(box.Shape.Edges, 1) if edge.CenterOfMass.x > 9]
        corners = ["Vertex{}".format(n) for n, vertex in enumerate(box.Shape.Vertexes, 1) if vertex.X > 9]
        for part in (box, container):
            for loaded in (["Face2"], rims, corners, corners[:1]):
                with self.subTest(part.Name, loaded=loaded):
                    analysis, _ = calculix.make_analysis(box, ["Face1"])
                    obj = polycube.create_fem_mesh(part, size=5, analysis=analysis)
                    self.add(analysis, "Force", box, *loaded, Force=1000, Direction=(box, ["Face2"]))
                    self.add(analysis, "Pressure", box, "Face3", Pressure=2.0)
                    self.document.recompute()
                    path = self.written(analysis)
                    along = container.Placement.Rotation.multVec(Vector(1, 0, 0))
                    self.assertLess((solver_tests.nodal_loads(path) - along * 1000).Length, 0.01)
                    self.assertEqual(len(solver_tests.pressure_faces(path)), len(self.group(obj.FemMesh, "Face3")))
                    for member in [*analysis.Group, analysis]:
                        self.document.removeObject(member.Name)

    def test_other_meshes_are_left_to_freecad(self):
        from femexamples import ccx_cantilever_faceload

        self.document = ccx_cantilever_faceload.setup()
        with mock.patch.object(load_sets.GroupedMesh, "__init__", side_effect=AssertionError):
            path = self.written(self.document.Analysis)
        self.assertLess((solver_tests.nodal_loads(path) - Vector(0, 0, -9e6)).Length, 1e-3 * 9e6)


class Sides(LoadTest):
    def test_numbers_of_sides_are_those_that_freecad_finds(self):
        part = self.part(Part.makeBox(10, 8, 6))
        for order in (1, 2):
            obj = polycube.create_fem_mesh(part, size=2, order=order)
            mesh, grouped = obj.FemMesh, load_sets.GroupedMesh(obj, part.Shape)
            table = meshtools.get_femelement_table(mesh)
            beside = meshtools.get_femnodes_ele_table(mesh.Nodes, table)
            for number, face in enumerate(part.Shape.Faces, 1):
                nodes = sorted(grouped.getNodesByFace(face))
                found = meshtools.get_ccxelement_faces_from_binary_search(meshtools.get_bit_pattern_dict(table, beside, nodes))
                self.assertEqual(sorted(map(tuple, found)), sorted(grouped.getccxVolumesByFace(face)), number)

    def test_weights_sum_to_the_area(self):
        part, outer, _, _ = self.tube(inner=5.0)
        grouped = load_sets.GroupedMesh(polycube.create_fem_mesh(part, size=2), part.Shape)
        face = part.Shape.getElement(outer)
        weights = grouped.weights(grouped.elements(face, "Face"))
        self.assertAlmostEqual(sum(weights.values()) / face.Area, 1, delta=1e-3)
        self.assertEqual(set(weights), set(grouped.getNodesByFace(face)))


@solver_tests.needs_calculix
class Heat(LoadTest):
    """A tube held at 300 K outside; heat comes in at the bore, as a flux and from a fluid. Closed forms of the wall's temperature there."""

    OUTER, INNER, HEIGHT, CONDUCTIVITY, FILM, FLUX = 20.0, 10.0, 10.0, 50.0, 2000.0, 50000.0

    def temperature(self, **heat):
        part, outer, inner, ends = self.tube(self.OUTER, self.INNER, self.HEIGHT)
        analysis, solver = calculix.make_analysis(part, [ends[0]])
        solver.AnalysisType = "thermomech"
        solver.ThermoMechSteadyState = True
        steel = next(member for member in analysis.Group if member.TypeId == "App::MaterialObjectPython")
        steel.Material = dict(
            steel.Material, ThermalConductivity="50 W/m/K", ThermalExpansionCoefficient="0 m/m/K", SpecificHeat="500 J/kg/K"
        )
        self.add(analysis, "InitialTemperature", part, initialTemperature=300)
        self.add(analysis, "Temperature", part, outer, Temperature=300)
        obj = polycube.create_fem_mesh(part, size=3, analysis=analysis)
        self.add(analysis, "Heatflux", part, inner, **heat)
        self.document.recompute()
        _, result = calculix.solve(analysis, solver, self.folder)
        mesh = obj.FemMesh
        nodes = {node for quad in self.group(mesh, inner) for node in mesh.getElementNodes(quad)}
        values = [value for node, value in zip(result.NodeNumbers, result.Temperature) if node in nodes]
        return sum(values) / len(values)

    def test_flux(self):
        found = self.temperature(ConstraintType="DFlux", DFlux=self.FLUX)
        expected = self.FLUX * self.INNER / 1000 * math.log(self.OUTER / self.INNER) / self.CONDUCTIVITY
        self.assertAlmostEqual((found - 300) / expected, 1, delta=1e-3)

    def test_film(self):
        found = self.temperature(ConstraintType="Convection", AmbientTemp=400, FilmCoef=self.FILM)
        at_wall, through = 1 / (self.FILM * self.INNER / 1000), math.log(self.OUTER / self.INNER) / self.CONDUCTIVITY
        self.assertAlmostEqual((found - 300) / (100 * through / (at_wall + through)), 1, delta=1e-3)


@solver_tests.needs_calculix
class SectionPrint(LoadTest):
    def test_force_through_a_face(self):
        part = self.part(Part.makeBox(40, 10, 10))
        analysis, solver = calculix.make_analysis(part, ["Face1"])
        polycube.create_fem_mesh(part, size=2.5, analysis=analysis)
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face2"]))
        self.add(analysis, "SectionPrint", part, "Face2")
        self.document.recompute()
        path, _ = calculix.solve(analysis, solver, self.folder)
        with open(os.path.splitext(path)[0] + ".dat", encoding="utf-8") as file:
            text = file.read()
        section = text[text.index("statistics for surface set") :]
        force = [float(number) for number in re.findall(r"-?\d\.\d+E[+-]\d+", section[section.index("\n") :])[:3]]
        self.assertAlmostEqual(abs(force[0]), 1000, delta=5)


class Warnings(LoadTest):
    def test_constraints_that_only_our_command_writes(self):
        part, _, inner, ends = self.tube(inner=5.0)
        analysis, _ = calculix.make_analysis(part, [ends[0]])
        self.add(analysis, "Bearing", part, inner)
        obj = objects.make(self.document, part)
        analysis.addObject(obj)
        warnings = self.set_mesh(obj, polycube.mesh(part, size=9))
        self.assertIn("Bearing: this FreeCAD's own run of CalculiX leaves it out, polycube.solve does not", warnings)

    def test_without_our_groups_what_freecad_loses_is_told(self):
        part = self.part(Part.makeBox(10, 10, 10))
        analysis, _ = calculix.make_analysis(part, ["Face1"])
        self.add(analysis, "Heatflux", part, "Face2")
        obj = objects.make(self.document, part)
        analysis.addObject(obj)
        result = polycube.mesh(part, size=5)
        self.assertEqual(self.set_mesh(obj, result), [])
        with mock.patch.object(objects, "GROUPS_ARE_ASKED", False):
            self.assertTrue(any("heat flux" in line for line in self.set_mesh(obj, result)))

    def told(self, analysis):
        """What FreeCAD's own writer warns of."""
        self.document.recompute()
        with mock.patch.object(load_sets, "FreeCAD") as freecad:
            self.written(analysis)
        return [call.args[0].rstrip("\n") for call in freecad.Console.PrintWarning.call_args_list]

    def test_what_the_mesh_does_not_take_is_told_when_freecad_writes(self):
        """A seam has no mesh edges: it takes no load, and as a support two nodes; a rim beside it takes only its share."""
        part = self.part(Part.makeCylinder(10, 20))
        edges = part.Shape.Edges
        seam = "Edge{}".format(next(n for n, edge in enumerate(edges, 1) if not edge.Closed))
        rim = "Edge{}".format(next(n for n, edge in enumerate(edges, 1) if edge.Closed and edge.CenterOfMass.z > 19))
        ends = {round(face.CenterOfMass.z): "Face{}".format(n) for n, face in enumerate(part.Shape.Faces, 1)}
        analysis, _ = calculix.make_analysis(part, [ends[0]])
        polycube.create_fem_mesh(part, size=6, analysis=analysis)
        for kind, names, values in (
            ("Force", [seam], {"Force": 1000, "Direction": (part, [ends[20]])}),
            ("Force", [rim, seam], {"Force": 1000, "Direction": (part, [ends[20]])}),
            ("Force", [rim], {"Force": 1000, "Direction": (part, [ends[20]])}),
            ("Fixed", [seam], {}),
        ):
            with self.subTest((kind, names)):
                added = self.add(analysis, kind, part, *names, **values)
                try:
                    expected = ["{}: {} is {}".format(kind, seam, shapes.SEAM)] if seam in names else []
                    self.assertEqual(self.told(analysis), expected)
                    if expected:
                        with self.assertRaisesRegex(polycube.InvalidInput, "seam"):
                            polycube.solve(analysis)
                finally:
                    self.document.removeObject(added.Name)

    def test_what_the_mesh_does_not_capture_is_told_when_freecad_writes(self):
        """Two faces of one surface, as the feature angle of a right angle has all of them."""
        part = self.part(Part.makeBox(10, 10, 10))
        analysis, _ = calculix.make_analysis(part, ["Face1"])
        obj = polycube.create_fem_mesh(part, size=5, analysis=analysis)
        report = json.loads(obj.Report)
        report["cad"]["faces"]["ignored"] = ["Face6"]
        obj.Report = json.dumps(report)
        self.add(analysis, "Pressure", part, "Face6", Pressure=1)
        self.assertEqual(self.told(analysis), ["Pressure: the mesh does not capture Face6"])
        with self.assertRaisesRegex(polycube.InvalidInput, "does not capture Face6"):
            polycube.solve(analysis)

    def test_a_share_of_a_force_that_finds_no_place_is_told(self):
        whole = {"Object": mock.Mock(Force=1000.0, References=[]), "NodeLoadTable": [("", {1: 600.0, 2: 400.0})]}
        self.assertEqual(load_sets.loss(whole), "")
        self.assertIn("of 1000 N", load_sets.loss({**whole, "NodeLoadTable": [("", {1: 600.0})]}))
        self.assertIn("nothing", load_sets.loss({**whole, "NodeLoadTable": [("", {})]}))
