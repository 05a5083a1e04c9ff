"""Several solids in one mesh: each with nodes of its own, groups, reports, files and refusals."""

import json
import unittest

import numpy as np
from support import VECTOR, FolderTest, FreeCAD, Part, needs_calculix
from test_decks import STEEL, DeckTest, face, plane, round_side

import _polycube


def box_on_box():
    """A box of 4 x 4 x 2 in the middle of one of 10 x 10 x 3."""
    return Part.Compound([Part.makeBox(10, 10, 3), Part.makeBox(4, 4, 2, VECTOR(3, 3, 3))])


def pin_in_plate(radius=3.0):
    hole = Part.makeCylinder(radius, 4, VECTOR(8, 8, 0))
    return Part.Compound([Part.makeBox(16, 16, 4).cut(hole), hole])


def shared(*solids):
    """Solids that share the faces where they touch, as BooleanFragments leaves them."""
    whole, _ = solids[0].generalFuse(list(solids[1:]))
    return whole


def turned(*corners):
    """A ring about Z whose section has these corners (radius, z)."""
    points = [VECTOR(x, 0, z) for x, z in corners]
    return Part.Face(Part.makePolygon([*points, points[0]])).revolve(VECTOR(), VECTOR(0, 0, 1), 360)


def mesh(shape, **options):
    return _polycube.mesh(brep=shape.exportBrepToString(), **options)


class Separate(FolderTest):
    def test_every_solid_is_what_it_is_alone(self):
        whole = mesh(box_on_box(), size=1, interfaces="separate")
        self.assertEqual(whole.report["interfaces"], [{"solids": ["Solid1", "Solid2"], "faces": [["Face6"], ["Face11"]], "area": whole.report["interfaces"][0]["area"]}])
        self.assertAlmostEqual(whole.report["interfaces"][0]["area"], 16, delta=1e-9)
        np.testing.assert_array_equal(np.unique(whole.hex_solid), [1, 2])
        for number, solid in enumerate(box_on_box().Solids, 1):
            alone = mesh(solid, size=1)
            of_solid = whole.nodes[whole.groups["Solid{}".format(number)]["nodes"]]
            self.assertEqual((whole.hex_solid == number).sum(), len(alone.hexes))
            order = np.lexsort(of_solid.T), np.lexsort(alone.nodes.T)
            np.testing.assert_array_equal(of_solid[order[0]], alone.nodes[order[1]])
            report = whole.report["solids"][number - 1]
            self.assertEqual(report["quality"], alone.report["quality"])
            self.assertEqual(report["counts"], alone.report["counts"])
        self.assertEqual(len(set(whole.groups["Solid1"]["nodes"]) & set(whole.groups["Solid2"]["nodes"])), 0)

    def test_one_solid_in_a_compound_is_the_mesh_of_the_solid(self):
        solid = Part.makeBox(8, 4, 4).cut(Part.makeCylinder(1, 4, VECTOR(4, 2, 0)))
        for interfaces in ("conform", "separate"):
            one, alone = mesh(Part.Compound([solid]), size=1, interfaces=interfaces), mesh(solid, size=1)
            np.testing.assert_array_equal(one.nodes, alone.nodes)
            np.testing.assert_array_equal(one.hexes, alone.hexes)
            self.assertEqual(sorted(one.groups), sorted(alone.groups))
            self.assertNotIn("solids", one.report)

    def test_groups_have_the_names_of_the_whole_shape(self):
        shape = box_on_box()
        found = mesh(shape, size=1, interfaces="separate")
        for number, one in enumerate(shape.Faces, 1):
            nodes = found.nodes[found.groups["Face{}".format(number)]["nodes"]]
            for node in nodes[:: max(1, len(nodes) // 5)]:
                self.assertLess(one.distToShape(Part.Vertex(*node))[0], 1e-7)
        np.testing.assert_array_equal(found.groups["Solid1_Solid2"]["quads"], found.groups["Face6"]["quads"])
        np.testing.assert_array_equal(found.groups["Solid2_Solid1"]["quads"], found.groups["Face11"]["quads"])

    def test_a_shared_face_has_both_sides(self):
        shape = shared(Part.makeBox(4, 4, 1), Part.makeBox(4, 4, 2, VECTOR(0, 0, 1)))
        found = mesh(shape, size=1, interfaces="separate")
        number = found.report["interfaces"][0]["faces"][0][0]
        self.assertEqual(found.report["interfaces"][0]["faces"], [[number], [number]])
        sides = [found.groups["Solid{}_{}".format(solid, number)]["quads"] for solid in (1, 2)]
        np.testing.assert_array_equal(sorted(np.concatenate(sides)), found.groups[number]["quads"])
        for solid, quads in enumerate(sides, 1):
            np.testing.assert_array_equal(np.unique(found.hex_solid[found.quad_hex[quads, 0]]), [solid])

    def test_sizes_and_layers_by_solid(self):
        shape = box_on_box()
        found = mesh(shape, size=2, interfaces="separate", sizes={"Solid2": 0.5}, divisions={"Solid1": "4.."}, min_layers=1)
        self.assertEqual((found.hex_solid == 2).sum(), 8 * 8 * 4)
        self.assertEqual((found.hex_solid == 1).sum(), 5 * 5 * 4)
        one = mesh(Part.makeBox(4, 4, 4), size=2, sizes={"Solid1": 1}, min_layers=1)
        self.assertEqual(len(one.hexes), 64)

    def test_cells_are_shared_by_volume(self):
        counts = np.bincount(mesh(box_on_box(), hexes=2000, interfaces="separate").hex_solid)[1:]
        self.assertLess(abs(counts.sum() - 2000), 600)
        self.assertAlmostEqual(counts[0] / counts[1], 300 / 32, delta=3)

    def test_step_of_several_products(self):
        """Each solid by the name of its product, with common nodes or its own."""
        import Import

        document = FreeCAD.newDocument()
        self.addCleanup(FreeCAD.closeDocument, document.Name)
        for label, solid in zip(("Base plate", "Block"), box_on_box().Solids):
            feature = document.addObject("Part::Feature", "Part")
            feature.Label, feature.Shape = label, solid
        Import.export(document.Objects, self.path("two.step"))
        for interfaces in ("conform", "separate"):
            run = self.run_program("mesh", self.path("two.step"), "-o", self.path("out.inp"), "--size", "1", "--interfaces", interfaces, "--report", self.path("report.json"))
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(self.path("report.json")) as file:
                report = json.load(file)
            self.assertEqual([(solid["name"], solid["label"]) for solid in report["solids"]], [("Solid1", "Base plate"), ("Solid2", "Block")])
            self.assertEqual([solid["counts"]["hexes"] for solid in report["solids"]], [300, 32])

    def test_files(self):
        part = self.save(box_on_box())
        for suffix in ("inp", "unv", "med", "vtu", "mesh"):
            run = self.run_program("mesh", part, "-o", self.path("out." + suffix), "--size", "1", "--interfaces", "separate", "--report", self.path("report.json"))
            self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.path("report.json")) as file:
            report = json.load(file)
        self.assertEqual([solid["name"] for solid in report["solids"]], ["Solid1", "Solid2"])
        self.assertEqual(sum(solid["counts"]["hexes"] for solid in report["solids"]), report["counts"]["hexes"])
        with open(self.path("out.inp")) as file:
            text = file.read()
        names = [line for line in text.splitlines() if line.startswith("*")]
        self.assertEqual(len(names), len(set(names)))
        for name in ("Solid1_Solid2_Surface", "Solid2_Solid1_Surface"):
            self.assertIn("*SURFACE, NAME={}, TYPE=ELEMENT".format(name), names)

    def test_groups_survive_in_freecad(self):
        import Fem

        found = mesh(box_on_box(), size=1, interfaces="separate", order=1)
        for suffix in ("unv", "med"):
            found.write(self.path("out." + suffix))
            read = Fem.read(self.path("out." + suffix))
            groups = {read.getGroupName(group): read.getGroupElements(group) for group in read.Groups}
            for name in ("Face6", "Solid1_Solid2", "Solid2_Solid1", "Solid1", "Solid2"):
                what = "hexes" if name in ("Solid1", "Solid2") else "quads"
                self.assertEqual(len(groups[name]), len(found.groups[name][what]), name)


def laminate(*thicknesses):
    """Plates of 12 x 8 one on the other."""
    base = [sum(thicknesses[:i]) for i in range(len(thicknesses))]
    return Part.Compound([Part.makeBox(12, 8, t, VECTOR(0, 0, z)) for t, z in zip(thicknesses, base)])


class ConformTest(FolderTest):
    def check(self, shape, volume=1e-9, **options):
        """The mesh, of which every solid is complete and valid and every interface is the same node for node. `volume`: by how much chords may fall short."""
        found = mesh(shape, **options)
        solids = shape.Solids
        corners = found.hexes[:, :8]
        self.assertEqual(sorted(set(found.hex_solid.tolist())), list(range(1, len(solids) + 1)))
        self.assertGreater(found.scaled_jacobian.min(), 0.1)
        self.assertEqual(len(np.unique(np.round(found.nodes, 9), axis=0)), len(found.nodes), "two nodes in one place")
        sides = {}
        for cell, hexagon in enumerate(corners):
            for side in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
                sides.setdefault(frozenset(hexagon[list(side)].tolist()), []).append(cell)
        self.assertLessEqual(max(map(len, sides.values())), 2)
        for solid, report in zip(solids, found.report["solids"]):
            self.assertAlmostEqual(report["volume"]["mesh"] / solid.Volume, 1, delta=volume)
            self.assertEqual(report["cad"]["faces"]["total"], len(solid.Faces))
            for kind in report["cad"].values():
                self.assertEqual(kind["captured"], kind["total"])
        between = {key for key, cells in sides.items() if len({int(found.hex_solid[cell]) for cell in cells}) == 2}
        listed = set()
        for interface in found.report["interfaces"]:
            a, b = interface["solids"]
            one, other = (found.groups["{}_{}".format(*pair)] for pair in ((a, b), (b, a)))
            np.testing.assert_array_equal(one["quads"], other["quads"])
            np.testing.assert_array_equal(one["nodes"], np.intersect1d(found.groups[a]["nodes"], found.groups[b]["nodes"]))
            listed |= {frozenset(quad.tolist()) for quad in found.quads[one["quads"]][:, :4]}
        self.assertEqual(listed, between)
        return found


class Conform(ConformTest):
    def test_laminate(self):
        found = self.check(laminate(1, 0.5, 2), size=1, min_layers=1, growth=1)
        self.assertEqual([solid["counts"]["hexes"] for solid in found.report["solids"]], [96, 96, 192])

    def test_boxes_that_touch_in_part_of_a_face(self):
        found = self.check(box_on_box(), size=1)
        area = len(found.groups["Solid1_Solid2"]["quads"])
        self.assertGreater(len(found.groups["Face6"]["quads"]), area)
        self.assertEqual(len(found.groups["Face11"]["quads"]), area)
        part = self.save(box_on_box())
        self.assertEqual(self.run_program("mesh", part, "-o", self.path("out.inp"), "--size", "1").returncode, 0)

    def test_shared_faces_and_round_ones_beside_them(self):
        self.check(shared(Part.makeBox(16, 16, 4), Part.makeCylinder(4, 6, VECTOR(8, 8, 4))), size=2, volume=0.1)

    def test_pin_in_a_plate(self):
        """The bore takes four charts, so does the pin; nodes of the interface are on the cylinder for both."""
        found = self.check(pin_in_plate(), size=2, volume=0.1)
        nodes = found.nodes[found.groups["Solid1_Solid2"]["nodes"]]
        np.testing.assert_allclose(np.hypot(nodes[:, 0] - 8, nodes[:, 1] - 8), 3, atol=1e-9)

    def test_bushing_that_sticks_out(self):
        hole = Part.makeCylinder(5, 4, VECTOR(8, 8, 0))
        bushing = Part.makeCylinder(5, 7, VECTOR(8, 8, -1)).cut(Part.makeCylinder(3, 7, VECTOR(8, 8, -1)))
        self.check(Part.Compound([Part.makeBox(16, 16, 4).cut(hole), bushing]), size=2, volume=0.1)

    def test_inclusion(self):
        ball = Part.makeSphere(3, VECTOR(5, 5, 5))
        self.check(Part.Compound([Part.makeBox(10, 10, 10).cut(ball), ball]), size=2, volume=0.3)

    def test_a_thin_coat_on_all_sides(self):
        """Beside the box's edges the nearest triangle of the interface is beyond the edge; the plane tells."""
        box = Part.makeBox(12, 10, 8)
        found = self.check(Part.Compound([box, Part.makeBox(12.4, 10.4, 8.4, VECTOR(-0.2, -0.2, -0.2)).cut(box)]), size=0.6, order=1)
        self.assertGreater(found.scaled_jacobian.min(), 0.99)

    def test_halves_of_a_ball(self):
        """Nothing on the outside tells the axes; the face between the halves does."""
        ball = Part.makeSphere(6)
        self.check(Part.Compound([ball.common(Part.makeBox(20, 20, 20, VECTOR(-10, -10, z))) for z in (0, -20)]), size=2, volume=0.3)

    def test_the_same_solid_twice_is_one(self):
        box = Part.makeBox(4, 4, 4)
        found = mesh(Part.Compound([box, box]), size=2)
        np.testing.assert_array_equal(found.nodes, mesh(box, size=2).nodes)
        self.assertEqual(found.report["warnings"], ["the solid is in the shape 2 times; it is meshed once"])

    def test_layers_go_through_interfaces(self):
        """The outside of a stack of discs is one cylinder: one layer under all of it, where each disc by itself could not lay it past its neighbours."""
        discs = [Part.makeCylinder(6, t, VECTOR(0, 0, z)).cut(Part.makeCylinder(3, t, VECTOR(0, 0, z))) for z, t in ((0, 3), (3, 2), (5, 3))]
        found = self.check(Part.Compound(discs), size=1.5, volume=0.1)
        self.assertGreater(found.scaled_jacobian.min(), 0.6)
        self.assertTrue(all(solid["counts"]["padded_hexes"] > 0 for solid in found.report["solids"]))

    def test_ring_in_a_groove(self):
        """In a plate's face, flush, where each solid would take another way for the circles between them; and in a shaft's groove, sticking out."""
        ring = Part.makeCylinder(6, 2, VECTOR(10, 10, 4)).cut(Part.makeCylinder(4, 2, VECTOR(10, 10, 4)))
        self.check(Part.Compound([Part.makeBox(20, 20, 6).cut(ring), ring]), size=1.5, order=1, volume=0.1)
        ring = Part.makeCylinder(9, 3, VECTOR(0, 0, 8)).cut(Part.makeCylinder(5, 3, VECTOR(0, 0, 8)))
        self.check(Part.Compound([Part.makeCylinder(8, 20).cut(ring), ring]), size=1.5, order=1, volume=0.1)
        ring = Part.makeTorus(7, 1.5, VECTOR(0, 0, 9.5))
        self.check(Part.Compound([Part.makeCylinder(7, 20).cut(ring), ring]), size=1.5, order=1, volume=0.1)

    def test_a_slot_that_a_ring_fills(self):
        """The outside is one cylinder: a layer under all of it, and one in the shaft under the bottom of the slot, which alone would have to go round the ring."""
        for inner, size in ((6, 1.5), (9, 1)):
            ring = Part.makeCylinder(10, 2, VECTOR(0, 0, 3)).cut(Part.makeCylinder(inner, 2, VECTOR(0, 0, 3)))
            found = self.check(Part.Compound([Part.makeCylinder(10, 8).cut(ring), ring]), size=size, order=1, volume=0.1)
            self.assertGreater(found.scaled_jacobian.min(), 0.6)

    def test_a_finer_grid_where_none_fits_on_the_one_asked_for(self):
        """A ring of .4 of the size in width: cells stay inverted on that grid."""
        ring = Part.makeCylinder(10, 2, VECTOR(0, 0, 3)).cut(Part.makeCylinder(9, 2, VECTOR(0, 0, 3)))
        self.check(Part.Compound([Part.makeCylinder(10, 8).cut(ring), ring]), size=2.5, order=1, volume=0.1)

    def test_rings_of_triangular_section(self):
        """A weld round a pin on a plate, and a ring in a groove with two sides: one cone faces along the axis and sideways, on both sides of it."""
        weld = turned((6, 4), (9, 4), (6, 7))
        plate, pin = Part.makeBox(30, 30, 4, VECTOR(-15, -15, 0)), Part.makeCylinder(6, 20, VECTOR(0, 0, 4))
        self.check(Part.Compound([plate, pin, weld]), size=2, order=1, volume=0.1)
        ring = turned((10, 8), (8, 10), (10, 12))
        self.check(Part.Compound([Part.makeCylinder(10, 20).cut(ring), ring]), size=2, order=1, volume=0.1)

    def test_a_ball_let_into_plates_a_little(self):
        """Its outside would face the plate's at the rim: there it may not be what the labels of the ball alone are."""
        ball = Part.makeSphere(5, VECTOR(0, 0, 5))
        plates = [Part.makeBox(20, 20, 4, VECTOR(-10, -10, z)).cut(ball) for z in (-3, 9)]
        found = self.check(Part.Compound([plates[0], ball]), size=1.5, order=1, volume=0.2)
        self.assertGreater(found.scaled_jacobian.min(), 0.5)
        self.check(Part.Compound([plates[0], ball, plates[1]]), size=1.5, order=1, volume=0.2)

    def test_bushing_with_a_collar(self):
        """Layers under the outside go on along the bore between both: their cells are the bushing's, the interface stays where it is."""
        outside = Part.makeCylinder(5, 8).fuse(Part.makeCylinder(8, 2, VECTOR(0, 0, 8))).removeSplitter()
        plate = Part.makeBox(40, 20, 8, VECTOR(-10, -10, 0)).cut(Part.makeCylinder(5, 8))
        found = self.check(Part.Compound([plate, outside.cut(Part.makeCylinder(3, 10))]), size=1.5, order=1, volume=0.1)
        self.assertGreater(found.scaled_jacobian.min(), 0.6)
        nodes = found.nodes[found.groups["Solid1_Solid2"]["nodes"]]
        round_ones = nodes[nodes[:, 2] < 8 - 1e-6]
        np.testing.assert_allclose(np.hypot(round_ones[:, 0], round_ones[:, 1]), 5, atol=1e-9)

    def test_five_in_a_row(self):
        self.check(Part.Compound([Part.makeBox(4, 5, 5, VECTOR(4 * i, 0, 0)) for i in range(5)]), size=2)

    def test_coated_bracket(self):
        angle = Part.makeBox(16, 8, 3).fuse(Part.makeBox(3, 8, 12)).removeSplitter()
        coat = Part.makeBox(13, 8, 1, VECTOR(3, 0, 3)).fuse(Part.makeBox(1, 8, 9, VECTOR(3, 0, 3))).removeSplitter()
        self.check(Part.Compound([angle, coat]), size=2, order=1, min_layers=1)

    def test_bolted_flanges_with_a_gasket(self):
        def plate(z, thickness):
            ring = Part.makeCylinder(26, thickness, VECTOR(0, 0, z)).cut(Part.makeCylinder(10, thickness, VECTOR(0, 0, z)))
            for x in (-18, 18):
                ring = ring.cut(Part.makeCylinder(3, thickness, VECTOR(x, 0, z)))
            return ring

        bolts = [Part.makeCylinder(3, 14, VECTOR(x, 0, 0)) for x in (-18, 18)]
        found = self.check(Part.Compound([plate(0, 6), plate(6, 2), plate(8, 6), *bolts]), size=4, order=1, min_layers=1, volume=0.1)
        self.assertEqual(len(found.report["interfaces"]), 2 + 2 * 3)

    def test_layers_and_sizes_by_solid(self):
        found = self.check(laminate(1, 1), size=1, divisions={"Solid2": "3.."}, order=1, min_layers=1, growth=1)
        self.assertEqual([solid["counts"]["hexes"] for solid in found.report["solids"]], [96, 288])
        coarse, fine = self.check(laminate(4, 4), size=2), self.check(laminate(4, 4), size=2, sizes={"Solid2": 1})
        self.assertEqual(len(coarse.hexes) < len(fine.hexes), True)

    def test_solids_apart_do_not_need_each_other(self):
        shape = Part.Compound([*laminate(1, 1).Solids, Part.makeBox(2, 2, 2, VECTOR(20, 0, 0))])
        self.check(shape, size=1)

    def test_the_same_again(self):
        one, two = (mesh(box_on_box(), size=1, threads=threads) for threads in (1, 2))
        np.testing.assert_array_equal(one.nodes, two.nodes)
        np.testing.assert_array_equal(one.hexes, two.hexes)

    def test_sides_of_surfaces_in_the_deck(self):
        found = mesh(box_on_box(), size=1, order=1)
        found.write(self.path("mesh.inp"))
        with open(self.path("mesh.inp")) as file:
            text = file.read()
        for name, solid in (("Solid1_Solid2", 1), ("Solid2_Solid1", 2), ("Face11", 2)):
            block = text.split("*SURFACE, NAME={}_Surface, TYPE=ELEMENT\n".format(name))[1].split("*")[0]
            cells = [int(line.split(",")[0]) - 1 for line in block.strip().splitlines()]
            self.assertEqual(len(cells), len(found.groups[name]["quads"]))
            self.assertEqual({int(found.hex_solid[cell]) for cell in cells}, {solid})


class Looking(FolderTest):
    """Labels of solids that touch, and several meshes of them."""

    def test_labels_of_both_sides(self):
        """Of boxes the labels are the normals; an interface has opposite ones on its two sides, each by its own number."""
        shape = box_on_box()
        found = _polycube.labels(brep=shape.exportBrepToString(), size=1)
        normal = {(1, 0, 0): 0, (-1, 0, 0): 1, (0, 1, 0): 2, (0, -1, 0): 3, (0, 0, 1): 4, (0, 0, -1): 5}
        expected = {n: normal[tuple(round(x) for x in face.normalAt(0, 0))] for n, face in enumerate(shape.Faces, 1)}
        self.assertEqual(found["face_label"], expected)
        self.assertTrue(found["valid"])
        self.assertEqual(sorted(found["edges"]), list(range(1, len(shape.Edges) + 1)))
        self.assertEqual({fate for fate, _ in found["edges"].values()}, {"boundary"})
        self.assertEqual(len(found["triangle_face"]), len(found["label"]))

    def test_a_shared_bore_has_all_four_labels(self):
        found = _polycube.labels(brep=pin_in_plate().exportBrepToString(), size=2)
        bore = next(n for n, face in enumerate(pin_in_plate().Faces, 1) if face.Surface.TypeId == "Part::GeomCylinder")
        self.assertEqual(set(found["label"][found["triangle_face"] == bore].tolist()), {0, 1, 2, 3})

    def test_pictures_and_reports(self):
        part = self.save(pin_in_plate())
        run = self.run_program("label", part, "-o", self.path("labels.png"), "-o", self.path("labels.vtu"), "--report", self.path("labels.json"))
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.path("labels.json")) as file:
            report = json.load(file)
        self.assertTrue(report["valid"])
        self.assertEqual(sorted(report["faces"]), sorted("Face{}".format(n) for n in range(1, len(pin_in_plate().Faces) + 1)))

    def test_solids_apart_have_no_common_axes(self):
        for shape, options in ((Part.Compound([Part.makeBox(1, 1, 1), Part.makeBox(1, 1, 1, VECTOR(3, 0, 0))]), ()), (box_on_box(), ("--interfaces", "separate"))):
            run = self.run_program("label", self.save(shape), *options)
            self.assertEqual(run.returncode, 1)
            self.assertIn("of 2 solids that are meshed separately each has axes of its own: look at one of them", run.stderr)


class Sessions(unittest.TestCase):
    """Of solids with common nodes tetrahedra, labels, map and blocks are kept, of others those of each."""

    MADE_ONCE = {"tet", "deform", "blocks"}

    def same(self, one, other):
        np.testing.assert_array_equal(one.nodes, other.nodes)
        np.testing.assert_array_equal(one.hexes, other.hexes)
        self.assertEqual(one.report["solids"][0]["quality"], other.report["solids"][0]["quality"])

    def made_once(self, found):
        return self.MADE_ONCE.intersection(stage["name"] for stage in found.report["stages"])

    def test_what_does_not_depend_on_sizes_is_made_once(self):
        for shape in (pin_in_plate(), Part.Compound([*laminate(1, 1).Solids, Part.makeBox(2, 2, 2, VECTOR(20, 0, 0))])):
            for interfaces in ("conform", "separate"):
                session = _polycube.prepare(brep=shape.exportBrepToString(), size=2, interfaces=interfaces)
                first = session.mesh()
                self.assertEqual(self.made_once(first), set())
                self.same(first, mesh(shape, size=2, interfaces=interfaces))
                for options in ({"size": 1.5}, {"order": 1}, {"hexes": 1000}, {"divisions": {"Solid2": "4.."}}, {"sizes": {"Solid1": 1}}, {"refine": {"Solid2": 1}}, {"coarsest": True}):
                    found = session.mesh(**options)
                    self.assertEqual(self.made_once(found), set(), options)
                    self.assertGreater(found.scaled_jacobian.min(), 0.1)
                    self.assertEqual(session.count(**options), len(found.hexes), options)
                self.same(first, session.mesh())

    def test_other_structures_are_made_anew(self):
        shape = box_on_box()
        session = _polycube.prepare(brep=shape.exportBrepToString(), size=2)
        first = session.mesh()
        for options, made in (({"frame": ((1, 0, 0), (0, 0, 1))}, {"deform", "blocks"}), ({"labels": {"Face11": "-Z"}}, {"deform", "blocks"}), ({"interfaces": "separate"}, self.MADE_ONCE)):
            found = session.mesh(**options)
            self.assertEqual(self.made_once(found), made)
            self.same(found, mesh(shape, size=2, **options))
        self.same(first, session.mesh())

    def test_refusals_leave_it_as_it_was(self):
        session = _polycube.prepare(brep=box_on_box().exportBrepToString(), size=2)
        with self.assertRaisesRegex(_polycube.InvalidInput, "Solid3 does not exist"):
            session.mesh(sizes={"Solid3": 1})
        with self.assertRaisesRegex(_polycube.InvalidInput, "Face11 cannot be"):
            session.mesh(labels={"Face11": "+Z"})
        with self.assertRaisesRegex(_polycube.StageFailed, "nowhere opposite each other"):
            session.count(divisions={"Face1-Face3": 4})
        with self.assertRaises(_polycube.Cancelled):
            session.mesh(frame=((0, 1, 0), (1, 0, 0)), cancel=lambda: True)
        self.same(session.mesh(), mesh(box_on_box(), size=2))

    def test_solids_without_a_common_mesh(self):
        """What fails is told by each mesh; by themselves they have one."""
        boxes = [Part.makeBox(2, 2, 2), Part.makeBox(2, 2, 2, VECTOR(2, 0, 0)), Part.makeBox(2, 2, 2, VECTOR(4, 2, 0)), Part.makeBox(6, 4, 2, VECTOR(0, 0, 2))]
        session = _polycube.prepare(brep=Part.Compound(boxes).exportBrepToString(), size=1)
        for _ in range(2):
            with self.assertRaisesRegex(_polycube.StageFailed, "Solid1, Solid2, Solid3, Solid4: .*--interfaces separate"):
                session.mesh()
        self.assertEqual(len(session.mesh(interfaces="separate").report["solids"]), 4)


class Refusals(FolderTest):
    def test_what_cannot_conform_names_separate(self):
        """Two of these boxes meet in an edge only, so that the whole is no solid."""
        boxes = [Part.makeBox(2, 2, 2), Part.makeBox(2, 2, 2, VECTOR(2, 0, 0)), Part.makeBox(2, 2, 2, VECTOR(4, 2, 0)), Part.makeBox(6, 4, 2, VECTOR(0, 0, 2))]
        part = self.save(Part.Compound(boxes))
        message = self.refuses(part, status=2)
        for text in ("Solid1, Solid2, Solid3, Solid4", "more than two faces meet", "--interfaces separate"):
            self.assertIn(text, message)
        self.assertIn("Edge", message.split("(")[-1])
        self.assertEqual(len(set(mesh(Part.Compound(boxes), size=1, interfaces="separate").hex_solid.tolist())), 4)

    def test_a_map_that_folds_is_told_with_its_faces(self):
        """Five sectors round one edge, where a polycube has room for four: their sides are named, by the numbers of the shape; by themselves they have a mesh."""
        sectors = [Part.makeCylinder(10, 8, VECTOR(), VECTOR(0, 0, 1), 72) for _ in range(5)]
        for number, sector in enumerate(sectors):
            sector.rotate(VECTOR(), VECTOR(0, 0, 1), 72 * number)
        shape = Part.Compound(sectors)
        sides = {"Face{}".format(n) for n, one in enumerate(shape.Faces, 1) if one.CenterOfMass.z == 4}
        with self.assertRaisesRegex(_polycube.StageFailed, "Solid1, .*, Solid5: .*: the map folds; --interfaces separate") as refusal:
            mesh(shape, size=2)
        self.assertTrue(sides & set(refusal.exception.entities))
        self.assertEqual(len(mesh(shape, size=2, order=1, interfaces="separate").report["solids"]), 5)

    def test_what_touches_itself_in_a_point(self):
        """A cylinder tangent to the edge of the block below it; a ring tangent to the bolt holes of the plates on both sides."""
        tangent = Part.Compound([Part.makeBox(20, 20, 8), Part.makeCylinder(5, 12, VECTOR(15, 10, 8))])
        plates = [Part.makeBox(30, 30, 3, VECTOR(-15, -15, z)).cut(Part.makeCylinder(2, 3, VECTOR(0, 8, z))) for z in (0, 5)]
        ring = Part.makeCylinder(6, 2, VECTOR(0, 0, 3)).cut(Part.makeCylinder(3, 2, VECTOR(0, 0, 3)))
        for shape, fault in ((tangent, "Vertex"), (Part.Compound([plates[0], ring, plates[1]]), "Edge")):
            message = self.refuses(self.save(shape), status=2)
            self.assertIn("their outside touches itself in a point only; --interfaces separate", message)
            self.assertIn(fault, message.split("(")[-1])

    def test_a_solid_lost_to_damage(self):
        """A quote that is missing takes the entities up to the next one with it: the other solid would be meshed alone."""
        whole = self.path("whole.step")
        box_on_box().exportStep(whole)
        with open(whole) as file:
            lines = file.read().split("\n")
        at = [number for number, line in enumerate(lines) if "= FACE_BOUND('" in line or "= VECTOR('" in line]
        for number in (at[0], at[len(at) // 2], at[-1]):
            damaged = list(lines)
            damaged[number] = damaged[number].replace("(''", "('")
            with open(self.path("damaged.step"), "w") as file:
                file.write("\n".join(damaged))
            self.assertIn("damaged", self.refuses(self.path("damaged.step")))

    def test_overlap(self):
        part = self.save(Part.Compound([Part.makeBox(2, 2, 2), Part.makeBox(2, 2, 2, VECTOR(1, 0, 0))]))
        for interfaces in ("conform", "separate"):
            self.assertIn("Solid1 and Solid2 overlap: they have 4 mm^3 in common", self.refuses(part, "--interfaces", interfaces))

    def test_demands_on_what_is_not_there(self):
        part = self.save(box_on_box())
        separate = ("--interfaces", "separate")
        self.assertIn("Solid3 does not exist, the part has 2 solids", self.refuses(part, "--sizes", "Solid3=1", *separate))
        self.assertIn("Face13 does not exist, the part has 12 faces", self.refuses(part, "--sizes", "Face13=1", *separate))
        self.assertIn("the faces belong to different solids", self.refuses(part, "--divisions", "Face5-Face12=2", *separate))
        self.assertIn("only the least number", self.refuses(part, "--divisions", "Solid1=2", *separate))
        self.assertIn("'both' is not one of conform, separate", self.refuses(part, "--interfaces", "both"))

    def test_a_failure_names_the_solid(self):
        part = self.save(box_on_box())
        self.assertIn("Solid2: --label: Face12", self.refuses(part, "--label", "Face12=-Z", "--interfaces", "separate"))


@needs_calculix
class Patch(DeckTest):
    def test_a_linear_field_over_an_interface(self):
        """Displacements that are linear on the outer boundary are linear inside, to the last digit that CalculiX prints."""
        found = mesh(laminate(2, 1.5, 2), size=2, element_type="C3D20")
        found.write(self.path("mesh.inp"))
        field = np.array([[1e-3, 2e-4, -3e-4], [5e-4, -2e-3, 1e-4], [-1e-4, 4e-4, 3e-3]])
        expected = found.nodes @ field.T
        inner = set(range(len(found.nodes)))
        for name, group in found.groups.items():
            if name.startswith("Face") and not set(group["quads"]) <= set(np.concatenate([g["quads"] for n, g in found.groups.items() if "_Solid" in n])):
                inner -= set(group["nodes"].tolist())
        fixed = sorted(set(range(len(found.nodes))) - inner)
        self.assertGreater(len(inner), 10)
        lines = ["{}, {}, {}, {:.12e}".format(n + 1, k + 1, k + 1, expected[n, k]) for n in fixed for k in range(3)]
        solids = "".join("*SOLID SECTION, ELSET=Solid{}, MATERIAL=STEEL\n".format(i) for i in (1, 2, 3))
        text = self.run_deck(
            "*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n{}*STEP\n*STATIC\n*BOUNDARY\n{}\n*NODE PRINT, NSET=Nall\nU\n*END STEP\n".format(solids, "\n".join(lines))
        )
        rows = [line.split() for line in text.splitlines() if len(line.split()) == 4 and line.split()[0].isdigit()]
        moved = np.array([[float(x) for x in row[1:]] for row in rows])
        self.assertEqual(len(moved), len(found.nodes))
        # CalculiX prints seven digits.
        np.testing.assert_allclose(moved, expected, rtol=1e-6, atol=1e-9)


@needs_calculix
class Tied(DeckTest):
    def test_a_pin_in_its_plate(self):
        """Pressed on its end; tied it moves as with common nodes, to 1 %."""
        shape = pin_in_plate()
        end = [n for n, one in enumerate(shape.Faces, 1) if one.Surface.TypeId == "Part::GeomPlane" and abs(one.CenterOfMass.z - 4) < 1e-6 and one.Area < 40]
        fixed, end = face(shape, plane(0, 0)), "Face{}".format(end[0])
        moved = {}
        for interfaces in ("conform", "separate"):
            mesh(shape, size=1, interfaces=interfaces, element_type="C3D20").write(self.path("mesh.inp"))
            tie = "*TIE, NAME=T1, POSITION TOLERANCE=0.05\nSolid2_Solid1_Surface, Solid1_Solid2_Surface\n" if interfaces == "separate" else ""
            sections = "*SOLID SECTION, ELSET=Solid2, MATERIAL=STEEL\n" + tie + "*SOLID SECTION"
            deck = self.STATIC.replace("*SOLID SECTION", sections).format(e=STEEL, fixed=fixed, load="*DSLOAD\n{}_Surface, P, 100.".format(end), more="*NODE PRINT, NSET={}\nU".format(end))
            moved[interfaces] = self.moved(self.run_deck(deck))[2]
        self.assertLess(moved["conform"], 0)
        self.assertAlmostEqual(moved["separate"] / moved["conform"], 1, delta=1e-2)

    def test_a_bar_of_two_halves_in_tension(self):
        """Different meshes on both sides of the tie; the elongation is that of one bar to 0.5 %."""
        shape = Part.Compound([Part.makeBox(4, 2, 2), Part.makeBox(4, 2, 2, VECTOR(4, 0, 0))])
        mesh(shape, size=1, sizes={"Solid2": 0.7}, interfaces="separate", element_type="C3D20").write(self.path("mesh.inp"))
        fixed, end = face(shape, plane(0, 0)), face(shape, plane(0, 8))
        text = self.run_deck(
            self.STATIC.replace("*SOLID SECTION", "*SOLID SECTION, ELSET=Solid2, MATERIAL=STEEL\n*TIE, NAME=T1, POSITION TOLERANCE=0.01\nSolid2_Solid1_Surface, Solid1_Solid2_Surface\n*SOLID SECTION").format(
                e=STEEL, fixed=fixed, load="*DSLOAD\n{}_Surface, P, -100.".format(end), more="*NODE PRINT, NSET={}\nU".format(end)
            )
        )
        self.assertAlmostEqual(self.moved(text)[0], 100 / STEEL * 8, delta=5e-3 * 100 / STEEL * 8)


if __name__ == "__main__":
    unittest.main()
