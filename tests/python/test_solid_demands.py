"""What is asked of faces, edges and solids in one mesh of several with common nodes; what the mesh is to a finite element program."""

import unittest

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from support import VECTOR, FolderTest, Part, chamfered, cylinder, plate
from test_solids import ConformTest, box_on_box, laminate, mesh, pin_in_plate, shared

import _polycube


def flush():
    """A box on a plate, with one of its edges in the middle of one of the plate's."""
    return Part.Compound([Part.makeBox(10, 10, 3), Part.makeBox(4, 4, 2, VECTOR(3, 0, 3))])


def edge(shape, *ends):
    return next("Edge{}".format(n) for n, e in enumerate(shape.Edges, 1) if all(any(v.Point.isEqual(VECTOR(*p), 1e-6) for v in e.Vertexes) for p in ends))


def circles(shape):
    return ["Edge{}".format(n) for n, e in enumerate(shape.Edges, 1) if e.Curve.TypeId == "Part::GeomCircle"]


class Demands(FolderTest):
    """Faces and edges keep the names that they had before the solids were joined, though a face may have become several."""

    def along(self, found, name, axis):
        return np.unique(np.round(found.nodes[found.groups[name]["nodes"]][:, axis], 9))

    def counts(self, found):
        return np.bincount(found.hex_solid)[1:].tolist()

    def test_divisions_of_an_edge_that_fell_to_pieces(self):
        shape = flush()
        long, short = edge(shape, (0, 0, 3), (10, 0, 3)), edge(shape, (3, 0, 3), (7, 0, 3))
        found = mesh(shape, size=1, divisions={long: 14}, order=1)
        self.assertEqual(len(found.groups[long]["segments"]), 14)
        self.assertEqual(len(self.along(found, long, 0)), 15)
        self.assertEqual(len(mesh(shape, size=1, divisions={short: "7"}).groups[short]["segments"]), 7)
        self.assertEqual(found.report["warnings"], [])

    def test_divisions_of_a_circle_between_solids(self):
        shape = pin_in_plate()
        for name in circles(shape):
            self.assertEqual(len(mesh(shape, size=2, divisions={name: 20}).groups[name]["segments"]), 20)

    def test_divisions_between_faces_end_at_the_interface(self):
        """Face6 is the plate's upper face, partly under the box; Face11 lies on it, Face12 is the upper one of the box."""
        self.assertEqual(self.counts(mesh(box_on_box(), size=1, divisions={"Face5-Face6": 5})), [500, 32])
        self.assertEqual(self.counts(mesh(box_on_box(), size=1, divisions={"Face11-Face12": 4})), [300, 64])

    def test_divisions_that_clash_are_named(self):
        shape = box_on_box()
        with self.assertRaisesRegex(_polycube.InvalidInput, "Solid1, Solid2: .*Face5-Face6=5.*Edge[0-9]+=3"):
            mesh(shape, size=1, divisions={"Face5-Face6": 5, edge(shape, (0, 0, 0), (0, 0, 3)): 3})
        with self.assertRaises(_polycube.StageFailed) as caught:
            mesh(shape, size=1, divisions={"Face1-Face3": 4})
        self.assertIn("nowhere opposite each other", str(caught.exception))
        self.assertEqual(caught.exception.entities, ["Face1", "Face3"])

    def test_padding_is_taken_off_a_division(self):
        """The layer under the outside of a tube round a pin comes on top of the elements through its wall; the number asked for comes out."""
        shape = Part.Compound([Part.makeCylinder(3, 10), Part.makeCylinder(6, 10).cut(Part.makeCylinder(3, 10))])
        inner, outer = ("Face{}".format(n) for n, f in enumerate(shape.Faces[3:], 4) if f.Surface.TypeId == "Part::GeomCylinder")
        for number in (2, 4):
            found = mesh(shape, size=2, order=1, min_layers=1, per_circle=0, divisions={"{}-{}".format(inner, outer): number})
            self.assertEqual(found.report["warnings"], [])
            self.assertGreater(found.report["solids"][1]["counts"]["padded_hexes"], 0)

    def test_sizes_of_faces(self):
        """Of an upper face in part, a lower one in all, an interface by the numbers of both of its sides."""
        plain = self.counts(mesh(box_on_box(), size=2, min_layers=1, growth=1))
        self.assertEqual(self.counts(mesh(box_on_box(), size=2, min_layers=1, growth=1, sizes={"Face6": 0.5})), [20 * 20 * 6, 8 * 8 * 1])
        on_box = self.counts(mesh(box_on_box(), size=2, min_layers=1, growth=1, sizes={"Face12": 0.5}))
        self.assertEqual(on_box[0], plain[0])
        self.assertEqual(on_box[1], 4 * plain[1])
        self.assertEqual(self.counts(mesh(box_on_box(), size=2, min_layers=1, growth=1, sizes={"Face11": 0.5})), on_box)

    def test_sizes_that_the_cells_do_not_have_are_told(self):
        """A sheet of cells goes on through the lower box, which is to have larger ones; by themselves each box has its own."""
        for interfaces in ("conform", "separate"):
            for what in ("Face6", "Face11", "Face12", "Solid1", "Solid2"):
                found = mesh(box_on_box(), size=1.5, order=1, sizes={what: 0.4}, interfaces=interfaces)
                if what[0] == "S":
                    cells, sides = found.hexes[found.hex_solid == int(what[5:])], ((0, 1), (1, 2), (0, 4))
                else:
                    cells, sides = found.quads[found.groups[what]["quads"]], ((0, 1), (1, 2))
                length = np.mean(np.max([np.linalg.norm(found.nodes[cells[:, a]] - found.nodes[cells[:, b]], axis=1) for a, b in sides], axis=0))
                told = [line for line in found.report["warnings"] if "size {}=0.4: the cells there are".format(what) in line]
                self.assertEqual(len(told), int(length > 0.6), (interfaces, what, length))
                if interfaces == "separate":
                    self.assertEqual(told, [])
        self.assertTrue(mesh(box_on_box(), size=1.5, order=1, sizes={"Solid1": 3}).report["warnings"])

    def test_sizes_along_an_axis(self):
        found = mesh(box_on_box(), size=2, min_layers=1, growth=1, sizes={"Z": 0.5}, order=1)
        self.assertEqual(len(np.unique(np.round(found.nodes[:, 2], 9))), 6 + 4 + 1)

    def test_a_bore_that_solids_share_or_have_each(self):
        """One face by its number, two that lie against each other by both; which of them a cut leaves depends on OpenCASCADE."""
        plate_and_pin = pin_in_plate().Solids
        for shape, number in ((shared(*plate_and_pin), 1), (Part.Compound([solid.copy() for solid in plate_and_pin]), 2)):
            bore = ["Face{}".format(n) for n, f in enumerate(shape.Faces, 1) if f.Surface.TypeId == "Part::GeomCylinder"]
            self.assertEqual(len(bore), number)
            coarse, fine = mesh(shape, size=2), mesh(shape, size=2, sizes={face: 0.7 for face in bore})
            self.assertGreater(min(np.array(self.counts(fine)) / self.counts(coarse)), 3)

    def test_bias_from_the_start_of_the_edge(self):
        shape = laminate(2, 2)
        name = edge(shape, (0, 0, 2), (12, 0, 2))
        start = shape.Edges[int(name[4:]) - 1].firstVertex().X
        at = np.abs(self.along(mesh(shape, size=2, order=1, bias={name: 3}), name, 0) - start)
        cells = np.abs(np.diff(np.sort(at)))
        self.assertAlmostEqual(cells[-1] / cells[0], 3, delta=1e-6)

    def test_labels_of_interfaces_from_both_sides(self):
        for labels in ({"Face6": "+Z"}, {"Face11": "-Z"}, {"Face6": "+Z", "Face11": "-Z"}):
            self.assertEqual(self.counts(mesh(box_on_box(), size=1, labels=labels)), [300, 32])
        for face, wrong, right in (("Face11", "+Z", "-Z"), ("Face6", "+X", r"\+Z")):
            with self.assertRaisesRegex(_polycube.InvalidInput, "{} cannot be .*it can be {}".format(face, right)):
                mesh(box_on_box(), size=1, labels={face: wrong})

    def test_labels_of_an_oblique_interface_that_contradict(self):
        profile = [Part.Face(Part.makePolygon([VECTOR(*p) for p in points + points[:1]])) for points in ([(0, 0, 0), (10, 0, 0), (0, 0, 10)], [(10, 0, 0), (10, 0, 10), (0, 0, 10)])]
        shape = Part.Compound([one.extrude(VECTOR(0, 6, 0)) for one in profile])
        oblique = ["Face{}".format(n) for n, f in enumerate(shape.Faces, 1) if abs(f.Area - 6 * 200**0.5) < 1e-6]
        self.assertEqual(len(oblique), 2)
        with self.assertRaisesRegex(_polycube.InvalidInput, "{}=.X and {}=.Z contradict each other: they are the two sides of one face".format(*oblique)):
            mesh(shape, size=2, labels={oblique[0]: "+X", oblique[1]: "-Z"})

    def test_smooth_edges(self):
        """Two plates whose side bends by 5 degrees; with a feature angle the edges of the bend go, the interface's stay."""
        base = Part.Face(Part.makePolygon([VECTOR(*p) for p in ((0, 0, 0), (6, 0, 0), (12, 0.5, 0), (12, 6, 0), (0, 6, 0), (0, 0, 0))]))
        shape = Part.Compound([base.extrude(VECTOR(0, 0, 4)), base.translated(VECTOR(0, 0, 4)).extrude(VECTOR(0, 0, 3))])
        bend = [edge(shape, (6, 0, 0), (6, 0, 4)), edge(shape, (6, 0, 4), (6, 0, 7))]
        sides = [sorted(n for n, f in enumerate(shape.Faces, 1) if f.CenterOfMass.y < 1 and low < f.CenterOfMass.z < low + 4) for low in (0, 4)]
        found = mesh(shape, size=1, feature_angle=10)
        self.assertEqual([solid["cad"]["edges"]["ignored"] for solid in found.report["solids"]], [bend[:1], bend[1:]])
        for pair, line in zip(sides, found.report["warnings"]):
            self.assertIn("Face{}, Face{} are one surface".format(*pair), line)
        kept = mesh(shape, size=1, feature_angle=10, keep_faces=["Face{}".format(sides[1][0])])
        self.assertEqual([solid["cad"]["edges"]["ignored"] for solid in kept.report["solids"]], [bend[:1], []])

    def test_a_number_of_cells(self):
        self.assertLess(abs(len(mesh(pin_in_plate(), hexes=2000).hexes) / 2000 - 1), 0.15)

    def test_more_cells_than_any_computer_has_room_for(self):
        with self.assertRaisesRegex(_polycube.InvalidInput, "more than the 10000000"):
            mesh(box_on_box(), size=0.005)

    def test_shortfalls_are_told_by_the_numbers_of_the_part(self):
        found = mesh(laminate(1, 1), size=3, divisions={"Face5-Face6": 1}, order=1, growth=1)
        self.assertIn("Solid1: Face5-Face6: 1 element through the wall, not 3", found.report["warnings"])
        self.assertEqual([solid["counts"]["thin_walls"] for solid in found.report["solids"]], [1, 0])


class Refinements(ConformTest):
    """Cells divided locally where solids have common nodes: both see the same quads afterwards."""

    def cells(self, found):
        return [solid["counts"]["hexes"] for solid in found.report["solids"]]

    def test_entities_of_every_kind(self):
        shape = box_on_box()
        plain = self.cells(mesh(shape, size=1, order=1))
        rim, corner = edge(shape, (3, 3, 3), (7, 3, 3)), next("Vertex{}".format(n) for n, v in enumerate(shape.Vertexes, 1) if v.Point.isEqual(VECTOR(3, 3, 3), 1e-6))
        for name in ("Face6", "Face11", rim, corner, "Solid1", "Solid2"):
            found = self.check(shape, size=1, order=1, refine={name: 1})
            self.assertGreater(found.scaled_jacobian.min(), 0.4, name)
            for one, before in zip(self.cells(found), plain):
                self.assertGreater(one, before, name)
            self.assertEqual(found.report["warnings"], [])

    def test_stops_before_an_interface(self):
        """The upper face of the box on top: two layers of cells under it, the plate keeps its cells to the last bit."""
        plain, found = (self.check(box_on_box(), size=1, order=1, refine=refine) for refine in ({}, {"Face12": 1}))
        self.assertEqual(self.cells(found)[0], self.cells(plain)[0])
        self.assertEqual(self.cells(found)[1], 16 * (27 + 13 + 1))
        np.testing.assert_allclose(*(np.unique(m.nodes[m.groups["Solid1"]["nodes"]].round(9), axis=0) for m in (plain, found)))

    def test_all_of_a_solid(self):
        """Its neighbour gets templates in the cells on the interface, and keeps the others."""
        plain, found = (mesh(laminate(2, 4), size=1, order=1, min_layers=1, growth=1, refine=refine) for refine in ({}, {"Solid1": 1}))
        before = self.cells(plain)
        self.assertEqual(self.cells(found), [27 * before[0], before[1] + 12 * 96])

    def test_a_bore_and_its_pin(self):
        """Several levels through a curved interface by the number of either side; nodes stand on the cylinder."""
        shape = pin_in_plate()
        bores = ["Face{}".format(n) for n, f in enumerate(shape.Faces, 1) if f.Surface.TypeId == "Part::GeomCylinder"]
        plain = len(mesh(shape, size=3, order=1, per_circle=8).groups["Solid1_Solid2"]["quads"])
        for name, levels in [(bores[0], 2)] + [(bore, 1) for bore in bores]:
            found = self.check(shape, volume=0.2, size=3, order=1, per_circle=8, refine={name: levels})
            between = found.groups["Solid1_Solid2"]
            self.assertEqual(len(between["quads"]), plain * 9**levels)
            nodes = found.nodes[between["nodes"]]
            np.testing.assert_allclose(np.hypot(nodes[:, 0] - 8, nodes[:, 1] - 8), 3, atol=1e-9)

    def test_an_edge_of_several_pieces(self):
        shape = flush()
        name = edge(shape, (0, 0, 3), (10, 0, 3))
        found = self.check(shape, size=1, refine={name: 1})
        self.assertEqual(len(found.groups[name]["segments"]), 3 * len(mesh(shape, size=1).groups[name]["segments"]))

    def test_by_themselves_and_apart(self):
        """With nodes of their own solids are refined each for itself; in one mesh with others a solid that touches none."""
        self.assertEqual(self.cells(mesh(box_on_box(), size=1, order=1, interfaces="separate", refine={"Solid2": 1}))[0], 300)
        shape = Part.Compound([*laminate(1, 1).Solids, Part.makeBox(2, 2, 2, VECTOR(20, 0, 0))])
        for name, changed in (("Solid3", [False, False, True]), ("Solid1", [True, True, False])):
            plain, found = (self.cells(mesh(shape, size=1, order=1, refine=refine)) for refine in ({}, {name: 1}))
            self.assertEqual([a != b for a, b in zip(plain, found)], changed)

    def test_refused(self):
        part = self.save(pin_in_plate())
        self.assertIn("Face99 does not exist", self.refuses(part, "--refine", "Face99=1"))
        self.assertIn("the edge is a seam", self.refuses(part, "--refine", edge(pin_in_plate(), (11, 8, 0), (11, 8, 4)) + "=1"))
        self.assertIn("more than the 10000000", self.refuses(part, "--refine", "Solid1=6"))


class OneInACompound(unittest.TestCase):
    def test_is_the_mesh_of_the_solid(self):
        """Bit for bit, in all that comes out."""
        for make in (plate, chamfered, cylinder, lambda: Part.makeSphere(4)):
            for order in (1, 2):
                alone, one = mesh(make(), size=2, order=order).to_dict(), mesh(Part.Compound([make()]), size=2, order=order).to_dict()
                self.assertEqual(sorted(alone), sorted(one))
                for key, value in alone.items():
                    if isinstance(value, np.ndarray):
                        np.testing.assert_array_equal(value, one[key], key)
                for name, group in alone["groups"].items():
                    for kind, members in group.items():
                        np.testing.assert_array_equal(members, one["groups"][name][kind])


#: VTK's 8 and 20 nodes of the cube from -1 to 1.
CORNERS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)], float)
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]


def shape_gradients(order, at):
    """Of the nodes' shape functions (trilinear, or serendipity of second order) at a point of the cube: a fit to monomials."""
    powers = [(i, j, k) for i in range(order + 1) for j in range(order + 1) for k in range(order + 1) if sum(p == 2 for p in (i, j, k)) <= 1]
    nodes = CORNERS if order == 1 else np.vstack([CORNERS, [(CORNERS[a] + CORNERS[b]) / 2 for a, b in EDGES]])
    coefficients = np.linalg.inv(np.array([[np.prod(node ** np.array(p)) for p in powers] for node in nodes]))
    gradients = np.zeros((3, len(powers)))
    for n, p in enumerate(powers):
        for axis in range(3):
            lower = np.array(p)
            lower[axis] = max(0, lower[axis] - 1)
            gradients[axis, n] = p[axis] * np.prod(at**lower)
    return (gradients @ coefficients).T


def stiffness(nodes, hexes, order, young=1.0, poisson=0.3):
    """Of linear elasticity, by as many Gauss points as make it exact for a constant strain."""
    mu, lame = young / (2 + 2 * poisson), young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    elasticity = lame * np.einsum("ij,kl->ijkl", np.eye(3), np.eye(3)) + mu * (
        np.einsum("ik,jl->ijkl", np.eye(3), np.eye(3)) + np.einsum("il,jk->ijkl", np.eye(3), np.eye(3))
    )
    places, weights = np.polynomial.legendre.leggauss(order + 1)
    blocks = 0
    for u, wu in zip(places, weights):
        for v, wv in zip(places, weights):
            for w, ww in zip(places, weights):
                gradients = shape_gradients(order, np.array([u, v, w]))
                jacobian = np.einsum("enx,nr->exr", nodes[hexes], gradients)
                moved = np.einsum("nr,erx->enx", gradients, np.linalg.inv(jacobian))
                blocks = blocks + np.einsum("e,enj,ijkl,eml->enimk", wu * wv * ww * np.linalg.det(jacobian), moved, elasticity, moved, optimize=True)
    freedoms = (3 * hexes[:, :, None] + np.arange(3)).reshape(len(hexes), -1)
    count = freedoms.shape[1]
    rows, columns = np.repeat(freedoms, count, axis=1), np.tile(freedoms, (1, count))
    return coo_matrix((blocks.reshape(-1), (rows.reshape(-1), columns.reshape(-1))), shape=(3 * len(nodes),) * 2).tocsr()


class Patch(unittest.TestCase):
    """Elements of one material on both sides of interfaces: what is linear on the outer boundary is linear inside."""

    FIELD = np.array([[1e-3, 2e-4, -3e-4], [5e-4, -2e-3, 1e-4], [-1e-4, 4e-4, 3e-3]])

    def outer_nodes(self, found):
        """Nodes of the sides that one cell alone has; of second order with those in the middle of their edges."""
        corners = (0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)
        sides = {}
        for row in found.hexes:
            for side in corners:
                own = list(side) + [8 + n for n, (a, b) in enumerate(EDGES) if a in side and b in side and found.order == 2]
                sides.setdefault(frozenset(row[list(side)].tolist()), []).append(row[own])
        return np.unique(np.concatenate([rows[0] for rows in sides.values() if len(rows) == 1]))

    def test_a_linear_field_across_interfaces(self):
        for shape, size, refine in ((laminate(2, 1.5, 2), 3, {}), (pin_in_plate(), 4, {}), (box_on_box(), 2, {}), (laminate(6, 6), 6, {"Solid2": 1})):
            for order in (1, 2):
                found = mesh(shape, size=size, order=order, min_layers=2, per_circle=0, refine=refine)
                expected = (found.nodes @ self.FIELD.T).reshape(-1)
                fixed = np.zeros(len(expected), bool)
                fixed[(3 * self.outer_nodes(found)[:, None] + np.arange(3)).reshape(-1)] = True
                between = np.concatenate([group["nodes"] for name, group in found.groups.items() if "_Solid" in name])
                self.assertTrue((~fixed[3 * between]).any(), "no node of an interface is free")
                matrix = stiffness(found.nodes, found.hexes, order)
                moved = expected.copy()
                moved[~fixed] = spsolve(matrix[~fixed][:, ~fixed].tocsc(), -matrix[~fixed][:, fixed] @ expected[fixed])
                np.testing.assert_allclose(moved, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


if __name__ == "__main__":
    unittest.main()
