"""Parts in containers and links: the mesh stands where the part stands in the 3D view, and knows when that changes."""

import os
import tempfile
import unittest
from unittest import mock

import FreeCAD
import ObjectsFem
import Part
from FreeCAD import Placement, Rotation, Vector

from freecad import polycube
from freecad.polycube import fem_mesh, objects, shapes

TURNED = Placement(Vector(100, -20, 7), Rotation(Vector(1, 2, 3), 50))
MOVED = Placement(Vector(-3, 40, 0), Rotation(Vector(0, 0, 1), 30))


class PlacesTest(unittest.TestCase):
    def setUp(self):
        self.document = FreeCAD.newDocument()
        self.document.UndoMode = 1
        self.addCleanup(lambda: FreeCAD.closeDocument(self.document.Name))

    def add(self, kind, inside=None, placement=None, **properties):
        obj = self.document.addObject(kind, kind.split(":")[-1])
        for name, value in properties.items():
            setattr(obj, name, value)
        if placement:
            obj.Placement = placement
        if inside:
            inside.addObject(obj)
        return obj

    def box(self, inside=None):
        return self.add("Part::Box", inside, Placement(Vector(1, 2, 3), Rotation()), Length=20, Width=10, Height=5)

    def check_stands(self, obj, box, placement):
        """The mesh covers the box, which the placement moves from where it is by itself."""
        mesh = obj.FemMesh
        corners = [placement.multVec(vertex.Point) for vertex in box.Shape.Vertexes]
        points = list(mesh.Nodes.values())
        for corner in corners:
            self.assertLess(min((point - corner).Length for point in points), 1e-6)
        self.assertAlmostEqual(obj.MeshVolume.Value, 1000, delta=1e-3)
        self.assertEqual(obj.MeshState, objects.CURRENT)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.CURRENT)


class Containers(PlacesTest):
    def test_a_solid_in_moved_containers(self):
        outer = self.add("App::Part", placement=TURNED)
        inner = self.add("App::Part", outer, MOVED)
        group = self.add("App::DocumentObjectGroup", inner)
        for inside, placement in ((outer, TURNED), (inner, TURNED.multiply(MOVED)), (group, TURNED.multiply(MOVED))):
            with self.subTest(inside=inside.Name):
                box = self.box(inside)
                self.document.recompute()
                self.check_stands(polycube.create_fem_mesh(box, size=5, order=1), box, placement)
                result = polycube.mesh(box, size=5, order=1)
                labels = polycube.labels(box)
                for points in (result.nodes, labels.points):
                    self.assertLess(min((Vector(*point) - placement.multVec(box.Shape.Vertexes[0].Point)).Length for point in points), 1e-6)

    def test_the_container_as_the_part(self):
        outer = self.add("App::Part", placement=TURNED)
        inner = self.add("App::Part", outer, MOVED)
        box = self.box(inner)
        self.document.recompute()
        for part in (outer, inner):
            obj = polycube.create_fem_mesh(part, size=5, order=1)
            self.assertEqual(objects.part_of(obj), part)
            self.assertEqual(shapes.solid_object(part), box)
            self.check_stands(obj, box, TURNED.multiply(MOVED))

    def test_the_container_as_the_part_by_hand(self):
        container = self.add("App::Part", placement=TURNED)
        box = self.box(container)
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1)
        objects.set_part(obj, container)
        self.document.recompute()
        self.assertTrue(obj.isValid())
        self.assertEqual(obj.MeshState, objects.CURRENT, "the same solid at the same place")
        for wrong in (self.add("App::Part"), self.add("App::TextDocument")):
            objects.set_part(obj, wrong)
            self.document.recompute()
            self.assertTrue(obj.isValid())
            self.assertEqual(obj.MeshState, objects.OUTDATED)
            with self.assertRaises(polycube.InvalidInput) as caught:
                polycube.update_fem_mesh(obj)
            self.assertRegex(str(caught.exception), "^" + wrong.Label + " has no (solid inside|shape)$")

    def test_what_is_inside_a_container(self):
        container = self.add("App::Part")
        first, second = self.box(container), self.box(container)
        second.Placement.Base = Vector(10, 5, 0)
        self.document.recompute()
        with self.assertRaises(polycube.InvalidInput) as caught:
            polycube.mesh(container)
        self.assertRegex(str(caught.exception), 'Solid1 "Box" and Solid2 "Box001" overlap')
        cut = self.add("Part::Cut", container, Base=first, Tool=second)
        first.Visibility = second.Visibility = False
        self.document.recompute()
        self.assertEqual(shapes.solid_object(container), cut, "what a cut was made of is no solid beside it")
        cut.Visibility = False
        self.assertEqual(shapes.solid_object(container), cut, "hidden to see the mesh")
        obj = polycube.create_fem_mesh(container, size=5, order=1)
        self.assertAlmostEqual(obj.MeshVolume.Value, cut.Shape.Volume, delta=1e-3)

    def test_bodies(self):
        container = self.add("App::Part", placement=TURNED)
        body = self.add("PartDesign::Body", container, MOVED)
        feature = body.newObject("PartDesign::AdditiveBox", "Block")
        feature.Length, feature.Width, feature.Height = 20, 10, 5
        self.document.recompute()
        for part, placement in ((body, TURNED), (feature, TURNED.multiply(MOVED)), (container, TURNED)):
            with self.subTest(part=part.Name):
                self.check_stands(polycube.create_fem_mesh(part, size=5, order=1), body if part == container else part, placement)

    def test_an_analysis_in_the_same_container(self):
        """What is in the container is moved by it once, the mesh too."""
        container = self.add("App::Part", placement=TURNED)
        box = self.box(container)
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        container.addObject(analysis)
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1, analysis=analysis)
        self.check_stands(obj, box, Placement())
        container.Placement = MOVED
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.CURRENT, "the mesh goes with the part")
        polycube.update_fem_mesh(obj)
        self.check_stands(obj, box, Placement())


class Links(PlacesTest):
    def test_links_to_a_solid_and_to_a_container(self):
        container, other = self.add("App::Part", placement=TURNED), self.add("App::Part")
        box, inside_other = self.box(container), self.box(other)
        self.document.recompute()
        place = Placement(Vector(-50, 0, 8), Rotation(Vector(0, 1, 0), 20))
        own = box.Placement.inverse()
        for target, transform, inside, placement in (
            (box, False, False, place.multiply(own)),
            (box, True, False, place),
            (box, False, True, TURNED.multiply(place).multiply(own)),
            (other, False, False, place),
        ):
            with self.subTest(target=target.Name, transform=transform, inside=inside):
                link = self.add("App::Link", LinkedObject=target, LinkTransform=transform)
                link.Placement = place
                if inside:
                    container.addObject(link)
                self.document.recompute()
                obj = polycube.create_fem_mesh(link, size=5, order=1)
                self.check_stands(obj, box if target == box else inside_other, placement)
                link.Placement = MOVED
                self.document.recompute()
                self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_a_group_of_links(self):
        box = self.box()
        group = self.add("App::LinkGroup", ElementList=[box], Placement=TURNED)
        self.document.recompute()
        for part in (box, group):
            obj = polycube.create_fem_mesh(part, size=5, order=1)
            self.check_stands(obj, box, TURNED)
        group.Placement = MOVED
        self.document.recompute()
        self.assertEqual({obj.MeshState for obj in self.document.Objects if objects.is_polycube(obj)}, {objects.OUTDATED})


class Kinds(PlacesTest):
    """Whatever shows a solid: the mesh fills just that."""

    def check(self, part, solids=1):
        shape = Part.getShape(part)
        obj = polycube.create_fem_mesh(part, size=5, order=1)
        for name in ("XMin", "XMax", "YMin", "YMax", "ZMin", "ZMax"):
            self.assertAlmostEqual(getattr(obj.FemMesh.BoundBox, name), getattr(shape.BoundBox, name), delta=1e-6)
        self.assertAlmostEqual(obj.MeshVolume.Value / shape.Volume, 1, delta=1e-6)
        self.assertEqual(sum(obj.FemMesh.getGroupName(group).startswith("Solid") for group in obj.FemMesh.Groups), solids)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.CURRENT)
        return obj

    def test_links_that_scale_and_mirror(self):
        box = self.box()
        for scale in (Vector(2, 2, 2), Vector(1, 2, 3), Vector(-1, 1, 1), Vector(-1, -1, -1)):
            with self.subTest(scale=scale):
                link = self.add("App::Link", LinkedObject=box, ScaleVector=scale, Placement=TURNED)
                self.document.recompute()
                obj = self.check(link)
                link.ScaleVector = scale * 1.5
                self.document.recompute()
                self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_mirrored_cloned_and_repeated(self):
        import Draft

        box = self.box()
        mirrored = self.add("Part::Mirroring", Source=box, Base=Vector(30, 0, 0), Normal=Vector(1, 0, 0))
        self.document.recompute()
        clone = Draft.make_clone(box)
        clone.Scale = Vector(2, 1, 1)
        row = self.add("App::Link", LinkedObject=box, ShowElement=False, ElementCount=2)
        row.PlacementList = [Placement(), Placement(Vector(40, 0, 0), Rotation())]
        link = self.add("App::Link", LinkedObject=mirrored, Placement=MOVED)
        self.document.recompute()
        for part, solids in ((mirrored, 1), (clone, 1), (link, 1), (row, 2)):
            with self.subTest(part=part.Label):
                self.check(part, solids)

    def test_a_pad_on_a_sketch(self):
        body, sketch = self.add("PartDesign::Body"), self.add("Sketcher::SketchObject")
        body.addObject(sketch)
        corners = [Vector(0, 0), Vector(20, 0), Vector(20, 10), Vector(0, 10)]
        for start, end in zip(corners, corners[1:] + corners[:1]):
            sketch.addGeometry(Part.LineSegment(start, end))
        pad = self.add("PartDesign::Pad")
        body.addObject(pad)
        pad.Profile, pad.Length = sketch, 6
        self.document.recompute()
        meshes = [self.check(body), self.check(pad)]
        pad.Length = 9
        self.document.recompute()
        self.assertEqual([obj.MeshState for obj in meshes], [objects.OUTDATED] * 2)
        self.assertAlmostEqual(polycube.update_fem_mesh(meshes[0]).MeshVolume.Value, 1800, delta=1e-3)

    def test_a_part_that_is_deleted(self):
        box = self.box()
        self.document.recompute()
        obj = self.check(box)
        self.document.removeObject(box.Name)
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        self.document.recompute()
        with self.assertRaisesRegex(polycube.InvalidInput, "the part that PolycubeMesh was made of is gone"):
            polycube.update_fem_mesh(obj)
        self.assertGreater(obj.FemMesh.HexaCount, 0)
        self.document.undo()

    def test_a_link_into_another_document(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        box = self.box()
        self.document.recompute()
        first, self.document = self.document, FreeCAD.newDocument()
        first.saveAs(os.path.join(folder.name, "first.FCStd"))
        self.document.saveAs(os.path.join(folder.name, "second.FCStd"))
        link = self.add("App::Link", LinkedObject=box, Placement=MOVED)
        self.document.recompute()
        obj = self.check(link)
        box.Length = 30
        first.recompute()
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        polycube.update_fem_mesh(obj)
        self.assertEqual((obj.Document, obj.MeshState), (self.document, objects.CURRENT))
        self.assertEqual([other for other in first.Objects if objects.is_polycube(other)], [])
        FreeCAD.closeDocument(first.Name)
        self.document.recompute()
        with self.assertRaises(polycube.InvalidInput):
            polycube.update_fem_mesh(obj)


class Moves(PlacesTest):
    def test_moving_a_container_is_noticed(self):
        outer = self.add("App::Part", placement=TURNED)
        inner = self.add("App::Part", outer, MOVED)
        box = self.box(inner)
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1)
        for container in (outer, inner):
            before = container.Placement
            container.Placement = Placement(Vector(0, 0, 1e-3), Rotation()).multiply(before)
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.OUTDATED)
            container.Placement = before
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.CURRENT)
        outer.removeObject(inner)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        outer.addObject(inner)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.CURRENT)

    def test_a_container_moved_by_an_expression(self):
        container = self.add("App::Part")
        box = self.box(container)
        other = self.box()
        container.setExpression("Placement.Base.x", "{}.Length * 2".format(other.Name))
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1)
        self.check_stands(obj, box, Placement(Vector(40, 0, 0), Rotation()))
        other.Length = 30
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)

    def test_only_what_the_container_moves_is_marked(self):
        first, second = self.add("App::Part"), self.add("App::Part")
        near = polycube.create_fem_mesh(self.box(first), size=5, order=1)
        far = polycube.create_fem_mesh(self.box(second), size=5, order=1)
        other = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(other.Name))
        box = other.addObject("Part::Box", "Box")
        other.recompute()
        elsewhere = polycube.create_fem_mesh(box, size=5, order=1)

        def marked():
            return [obj for obj in (near, far, elsewhere) if "Touched" in obj.State]

        def settle():
            self.document.recompute()
            other.recompute()
            self.assertEqual(marked(), [])

        settle()
        first.Placement = MOVED
        self.assertEqual(marked(), [near])
        settle()
        self.assertEqual([obj.MeshState for obj in (near, far, elsewhere)], [objects.OUTDATED, objects.CURRENT, objects.CURRENT])
        second.addObject(self.add("Part::Sphere"))
        self.assertNotIn(elsewhere, marked())
        settle()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        settle()
        analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))
        self.assertEqual(marked(), [], "an analysis places nothing")

    def test_a_container_that_is_deleted(self):
        container = self.add("App::Part", placement=TURNED)
        inner = self.add("App::Part", container, MOVED)
        links = self.add("App::LinkGroup", ElementList=[self.box()], Placement=TURNED)
        meshes = [polycube.create_fem_mesh(box, size=5, order=1) for box in (self.box(container), self.box(inner), links.ElementList[0])]
        self.document.recompute()
        for number, gone in ((1, inner), (0, container), (2, links)):
            self.assertEqual(meshes[number].MeshState, objects.CURRENT)
            for _ in range(2):
                self.document.openTransaction("Delete")
                self.document.removeObject(gone.Name)
                self.document.commitTransaction()
                self.document.recompute()
                self.assertEqual(meshes[number].MeshState, objects.OUTDATED)
                self.document.undo()
                self.document.recompute()
                self.assertEqual(meshes[number].MeshState, objects.CURRENT)

    def test_into_a_plain_group_in_a_container(self):
        container = self.add("App::Part", placement=TURNED)
        group = self.add("App::DocumentObjectGroup", container)
        box = self.box()
        self.document.recompute()
        obj = polycube.create_fem_mesh(box, size=5, order=1)
        self.document.recompute()
        group.addObject(box)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        group.removeObject(box)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED, "FreeCAD leaves it in the container")
        container.removeObject(box)
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.CURRENT)

    def test_after_opening_a_document_again(self):
        container = self.add("App::Part", placement=TURNED)
        obj = polycube.create_fem_mesh(self.box(container), size=5, order=1)
        names = container.Name, obj.Name
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "part.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
            container, obj = map(self.document.getObject, names)
            obj.touch()
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.CURRENT)
            container.Placement = MOVED
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.OUTDATED)


class Constraints(PlacesTest):
    """FreeCAD 0.20 looks for a constraint's nodes where its face is inside the container: groups have to help it."""

    def check(self, part, box):
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        fixed = ObjectsFem.makeConstraintFixed(self.document, "Fixed")
        force = ObjectsFem.makeConstraintForce(self.document, "Force")
        pressure = ObjectsFem.makeConstraintPressure(self.document, "Pressure")
        fixed.References, force.References, pressure.References = [(box, "Face1")], [(box, "Face2")], [(box, "Face2")]
        for member in (fixed, force, pressure):
            analysis.addObject(member)
        self.document.recompute()
        self.assertEqual(fem_mesh.constrained_faces(part, analysis), ["Face1", "Face2"])
        obj = polycube.create_fem_mesh(part, size=5, order=1, analysis=analysis)
        mesh = obj.FemMesh
        result = polycube.mesh(part, size=5, order=1)
        self.assertEqual(fem_mesh.add_constraint_groups(mesh.copy(), result, part, analysis, True), [])
        lost = fem_mesh.add_constraint_groups(mesh.copy(), result, part, analysis, False)
        loaded = mesh.getFacesByFace(box.Shape.getElement("Face2"))
        self.assertEqual([line.rpartition(", ")[2] for line in lost], [] if loaded else ["all of the force gets lost", "all of the pressure gets lost"])
        groups = {mesh.getGroupName(group): mesh.getGroupElements(group) for group in mesh.Groups}
        quads = groups["Face1"]
        on_face = {node for quad in quads for node in mesh.getElementNodes(quad)}
        found = set(mesh.getNodesByFace(box.Shape.getElement("Face1")))
        self.assertEqual(set(groups.get(fixed.Name + "_Nodes", found)), on_face)

    def test_the_solid_and_the_container_as_the_part(self):
        for placement in (TURNED, Placement()):
            container = self.add("App::Part", placement=placement)
            box = self.box(container)
            self.document.recompute()
            for part in (box, container):
                with self.subTest(part=part.Name):
                    self.check(part, box)

    def test_references_by_the_container_are_none_of_the_mesh(self):
        """FreeCAD's writers read the shape of the object that is named; a container has none. FreeCAD 1.0 crashes when a constraint is given one."""
        container = self.add("App::Part", placement=TURNED)
        box = self.box(container)
        self.document.recompute()
        fixed = mock.Mock(TypeId="Fem::ConstraintFixed", References=[(container, (box.Name + ".Face1",))], isDerivedFrom="Fem::Constraint".__eq__)
        analysis = mock.Mock(Group=[fixed])
        mesh, result = polycube.create_fem_mesh(box, size=5, order=1).FemMesh, polycube.mesh(box, size=5, order=1)
        for part in (box, container):
            self.assertEqual(fem_mesh.constrained_faces(part, analysis), [])
            self.assertEqual(fem_mesh.add_constraint_groups(mesh, result, part, analysis, True), [])
            self.assertEqual(mesh.GroupCount, len(result.groups))


class Shapes(PlacesTest):
    def test_a_part_that_nothing_moves_is_meshed_as_it_is(self):
        box = self.box()
        box.Placement = TURNED
        self.document.recompute()
        self.assertEqual(shapes.shape_of(box).exportBrepToString(), box.Shape.exportBrepToString())
        self.assertTrue(shapes.shape_of(box).isPartner(box.Shape))

    def test_no_shape(self):
        for thing in (None, 3, "Box", self.document, self.add("App::TextDocument"), self.add("App::Part"), self.add("App::Link")):
            with self.assertRaises(polycube.InvalidInput) as caught:
                shapes.shape_of(thing)
            self.assertRegex(str(caught.exception), "has no")

    def test_a_move_gives_the_same_cells(self):
        container = self.add("App::Part", placement=TURNED)
        part = self.add("Part::Feature", container, Shape=Part.makeCylinder(10, 30))
        self.document.recompute()
        alone = polycube.mesh(part.Shape, size=5, order=1)
        self.assertEqual(len(polycube.mesh(part, size=5, order=1).hexes), len(alone.hexes))
