"""Several solids in one mesh: objects, groups, materials, ties."""

import math
import os
import tempfile

import FreeCAD
import ObjectsFem
import Part
import TestPolycubeSolve as solving
from FreeCAD import Vector

from freecad import polycube
from freecad.polycube import api, objects, shapes


class BarsTest(solving.SolveTest):
    """Two bars of 20 x 10 x 10 mm one behind the other along X, in one document."""

    def bars(self, placement=None):
        self.document = FreeCAD.newDocument()
        self.document.UndoMode = 1
        found = []
        for number in range(2):
            box = self.document.addObject("Part::Box", "Bar")
            box.Length, box.Width, box.Height = 20, 10, 10
            box.Placement.Base = Vector(20 * number, 0, 0)
            found.append(box)
        self.document.recompute()
        return found

    def compound(self, parts):
        compound = self.document.addObject("Part::Compound", "Both")
        compound.Links = parts
        self.document.recompute()
        return compound

    def with_materials(self, parts, whole):
        """The analysis, fixed at x = 0, a bar of 210 GPa and one of 70 GPa, neither of which contracts across."""
        analysis = self.analysis(whole, ["Face1"], PoissonRatio="0")
        other = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Aluminium"))[0]
        other.Material = dict(other.Material, Name="Aluminium", YoungsModulus="70000 MPa", PoissonRatio="0")
        other.References = [(parts[1], "Solid1")]
        steel = next(member for member in analysis.Group if member.Name.startswith("Steel"))
        steel.References = [(parts[0], "Solid1")]
        return analysis

    def end(self, shape, x):
        return "Face{}".format(next(n for n, face in enumerate(shape.Faces, 1) if face.CenterOfMass.isEqual(Vector(x, 5, 5), 1e-6)))


class Solids(BarsTest):
    def test_objects_become_a_compound(self):
        parts = self.bars()
        before = len(self.document.Objects)
        obj = polycube.create_fem_mesh(parts, size=5, order=1, min_layers=1, interfaces="separate")
        part = objects.part_of(obj)
        self.assertEqual(part.TypeId, "Part::Compound")
        self.assertEqual(part.Links, parts)
        self.assertEqual(len(self.document.Objects), before + 2)
        self.assertEqual(obj.MeshState, "Up to date")
        self.assertEqual(obj.Interfaces, "separate")
        self.assertEqual(len(self.group(obj.FemMesh, "Solid2")), 16)
        self.assertEqual(len(self.group(obj.FemMesh, "Solid1_Solid2")), 4)
        self.document.undo()
        self.assertEqual(len(self.document.Objects), before)

    def test_common_nodes(self):
        obj = polycube.create_fem_mesh(self.bars(), size=5, order=1, min_layers=1)
        self.assertEqual(obj.NodeCount, 9 * 9)
        self.assertEqual(self.group(obj.FemMesh, "Solid1_Solid2"), self.group(obj.FemMesh, "Solid2_Solid1"))

    def test_what_cannot_conform_is_refused(self):
        """Two of them meet in an edge only."""
        parts = self.bars()
        for size, base in (((20, 10, 10), (40, 10, 0)), ((60, 20, 5), (0, 0, 10))):
            box = self.document.addObject("Part::Box", "Bar")
            box.Length, box.Width, box.Height = size
            box.Placement.Base = Vector(*base)
            parts.append(box)
        self.document.recompute()
        before = len(self.document.Objects)
        with self.assertRaisesRegex(polycube.StageFailed, "separate"):
            polycube.create_fem_mesh(parts, size=5)
        self.assertEqual(len(self.document.Objects), before)

    def test_a_container_with_several_solids(self):
        parts = self.bars()
        container = self.document.addObject("App::Part", "Container")
        container.addObjects(parts)
        container.Placement.Base = Vector(0, 0, 50)
        self.document.recompute()
        obj = polycube.create_fem_mesh(container, size=5, order=1, min_layers=1, interfaces="separate")
        self.assertEqual(objects.part_of(obj), container)
        self.assertAlmostEqual(obj.FemMesh.BoundBox.ZMin, 50)
        self.assertEqual(obj.MeshState, "Up to date")

    def test_names_of_the_members(self):
        parts = self.bars()
        whole = self.compound(parts)
        self.assertEqual(shapes.names_in(whole, parts[1], ["Face1", "Solid1", "Vertex3", "Face9"]), ["Face7", "Solid2", "Vertex11"])
        self.assertEqual(shapes.names_in(whole, whole, ["Face7"]), ["Face7"])
        self.assertEqual(shapes.solids_in(whole, parts[1], ("Solid1",)), [2])
        self.assertEqual(shapes.solids_in(whole, whole, ()), [1, 2])

    def test_names_of_copies(self):
        """Both ends of a cylinder are one face in two places, a bore is a copy of the pin that cut it, links are copies of what they show."""
        self.document = FreeCAD.newDocument()
        plate, pin, cut = (self.document.addObject("Part::" + kind, kind) for kind in ("Box", "Cylinder", "Cut"))
        pin.Radius, pin.Height, pin.Placement.Base = 3, 10, Vector(5, 5, 0)
        cut.Base, cut.Tool = plate, pin
        link = self.document.addObject("App::Link", "Link")
        link.LinkedObject, link.Placement.Base = cut, Vector(20, 0, 0)
        self.document.recompute()
        whole = self.compound([cut, pin, link])
        for moved in (FreeCAD.Placement(), FreeCAD.Placement(Vector(1, 2, 30), FreeCAD.Rotation(Vector(1, 2, 3), 50))):
            whole.Placement = moved
            self.document.recompute()
            first = {"Face": 1, "Edge": 1, "Vertex": 1, "Solid": 1}
            for member in (cut, pin, link):
                for kind, number in first.items():
                    own = shapes.entities(member.Shape, kind)
                    names = ["{}{}".format(kind, n) for n in range(1, len(own) + 1)]
                    self.assertEqual(shapes.names_in(whole, member, names), ["{}{}".format(kind, n) for n in range(number, number + len(own))])
                    first[kind] += len(own)

    def test_materials_and_tie(self):
        """In tension each bar stretches by its own modulus: F l / (E A); constraints on the compound and on its members."""
        parts = self.bars()
        whole = self.compound(parts)
        shape = whole.Shape
        analysis = self.with_materials(parts, whole)
        self.add(analysis, "Force", parts[1], "Face2", Force=1000, Direction=(parts[1], ["Face2"]))
        inside = [n for n, face in enumerate(shape.Faces, 1) if face.CenterOfMass.isEqual(Vector(20, 5, 5), 1e-6)]
        self.assertEqual(len(inside), 2)
        self.add(analysis, "Tie", whole, *("Face{}".format(n) for n in reversed(inside)), Tolerance=0.1)
        polycube.create_fem_mesh(whole, size=5, interfaces="separate", analysis=analysis)
        solution = self.solve(analysis, whole)
        mesh = self.mesh(analysis).FemMesh
        for material, solid in (("Steel", "Solid1"), ("Aluminium", "Solid2")):
            name = next(member.Name for member in analysis.Group if member.Name.startswith(material)) + "_Volumes"
            self.assertEqual(self.group(mesh, name), self.group(mesh, solid))
        moved = self.of_face(solution, analysis, self.end(shape, 40), solution.result.DisplacementVectors)
        expected = 1000 / 100 * (20 / 210000 + 20 / 70000)
        self.assertAlmostEqual(sum(vector.x for vector in moved) / len(moved) / expected, 1, delta=5e-3)

    def test_a_material_without_references_is_that_of_the_rest(self):
        parts = self.bars()
        whole = self.compound(parts)
        analysis = self.with_materials(parts, whole)
        next(member for member in analysis.Group if member.Name.startswith("Steel")).References = []
        obj = polycube.create_fem_mesh(whole, size=5, order=1, min_layers=1, analysis=analysis)
        self.assertEqual(self.group(obj.FemMesh, "Steel_Volumes"), self.group(obj.FemMesh, "Solid1"))
        self.assertEqual(self.group(obj.FemMesh, "Aluminium_Volumes"), self.group(obj.FemMesh, "Solid2"))


class Assemblies(BarsTest):
    """What FreeCAD has of several solids: fragments, compounds of solids, bodies, links, containers in containers."""

    def check(self, part, count, touching, **options):
        """A mesh with a group for each solid, as large as it is, and for each of both sides where two touch."""
        obj = polycube.create_fem_mesh(part, size=5, order=1, min_layers=1, **options)
        self.assertEqual(obj.MeshState, "Up to date")
        mesh = obj.FemMesh
        names = [mesh.getGroupName(group) for group in mesh.Groups]
        self.assertEqual(sorted(name for name in names if name.startswith("Solid") and "_" not in name), ["Solid{}".format(n) for n in range(1, count + 1)])
        self.assertEqual(sum(name.count("Solid") == 2 for name in names), 2 * touching)
        return obj

    def test_fragments(self):
        """As BooleanFragments leaves them, by its kinds: solids that share faces, in a compound or a CompSolid."""
        try:
            from BOPTools import SplitFeatures
        except ImportError:
            self.skipTest("this FreeCAD has no BooleanFragments")
        for mode in ("Standard", "CompSolid"):
            parts = self.bars()
            fragments = SplitFeatures.makeBooleanFragments(name="Fragments")
            fragments.Objects, fragments.Mode = parts, mode
            self.document.recompute()
            self.assertEqual(len(fragments.Shape.Faces), 11)
            self.check(fragments, 2, 1)
            self.assertEqual(self.check(fragments, 2, 1, interfaces="separate").NodeCount, 2 * 5 * 9)

    def test_bodies_and_links(self):
        self.document = FreeCAD.newDocument()
        body = self.document.addObject("PartDesign::Body", "Body")
        box = self.document.addObject("PartDesign::AdditiveBox", "Box")
        body.addObject(box)
        box.Length, box.Width, box.Height = 20, 10, 10
        link = self.document.addObject("App::Link", "Link")
        link.LinkedObject, link.Placement.Base = body, Vector(20, 0, 0)
        self.document.recompute()
        obj = self.check([body, link], 2, 1)
        self.assertAlmostEqual(obj.FemMesh.BoundBox.XMax, 40)

    def test_containers_in_containers(self):
        parts = self.bars()
        inner, outer = (self.document.addObject("App::Part", name) for name in ("Inner", "Outer"))
        inner.addObject(parts[1])
        inner.Placement.Base = Vector(0, 0, 10)
        outer.addObjects([parts[0], inner])
        outer.Placement = FreeCAD.Placement(Vector(0, 0, 50), FreeCAD.Rotation(Vector(0, 0, 1), 90))
        parts[1].Placement.Base = Vector(0, 0, 0)
        self.document.recompute()
        obj = self.check(outer, 2, 1)
        self.assertAlmostEqual(obj.FemMesh.BoundBox.ZMax, 70)
        self.assertAlmostEqual(obj.FemMesh.BoundBox.XMin, -10)

    TURNED = FreeCAD.Placement(Vector(5, 6, 7), FreeCAD.Rotation(Vector(0, 0, 1), 90))

    def in_containers(self, count):
        """(bars one behind the other in turned containers, containers): one container for both, or one for each."""
        parts = self.bars()
        containers = [self.document.addObject("App::Part", "Container") for _ in range(count)]
        for number, container in enumerate(containers):
            container.Placement = self.TURNED
            container.addObjects(parts if count == 1 else [parts[number]])
        self.document.recompute()
        return parts, containers

    def test_objects_in_moved_containers(self):
        """Those of one container or of several, and a container beside an object of another; the mesh stands where they do, and is out of date when one is moved."""
        for count, choose in ((1, lambda parts, _: parts), (2, lambda parts, _: parts), (2, lambda parts, containers: [containers[0], parts[1]])):
            parts, containers = self.in_containers(count)
            before = len(self.document.Objects)
            obj = self.check(choose(parts, containers), 2, 1)
            box = obj.FemMesh.BoundBox
            for one, expected in zip((box.XMin, box.XMax, box.YMin, box.YMax, box.ZMin), (-5, 5, 6, 46, 7)):
                self.assertAlmostEqual(one, expected)
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.CURRENT)
            for part in parts:
                faces = shapes.names_in(objects.part_of(obj), part, ["Face{}".format(n) for n in range(1, 7)])
                self.assertEqual(len(set(faces)), 6)
            containers[-1].Placement.Base = Vector(0, 0, 100)
            self.document.recompute()
            self.assertEqual(obj.MeshState, objects.OUTDATED)
            self.document.undo()
            self.assertEqual(len(self.document.Objects), before)
            self.assertEqual(len(shapes.shape_of(containers[0]).Solids), 3 - count)

    def test_undo_and_redo_of_a_compound_of_objects_in_containers(self):
        """In one step, again and again, and the document can be saved after it: FreeCAD 1.0 leaves ruins where the making of a link is undone."""
        parts, _ = self.in_containers(2)
        parts[0].Label = "Flange"
        self.document.clearUndos()
        before = [obj.Name for obj in self.document.Objects]
        with api.transaction(self.document, "Compound"):
            compound = polycube.compound_of(parts)
        size, height = compound.Shape.BoundBox.DiagonalLength, compound.Shape.BoundBox.ZMax
        after = [obj.Name for obj in self.document.Objects]
        for _ in range(3):
            self.assertEqual(list(self.document.UndoNames), ["Compound"])
            self.document.undo()
            self.document.recompute()
            self.assertEqual([obj.Name for obj in self.document.Objects], before)
            self.document.redo()
            self.document.recompute()
            self.assertEqual([obj.Name for obj in self.document.Objects], after)
            self.assertEqual(compound.Shape.BoundBox.DiagonalLength, size)
            self.assertEqual([shapes.shown_by(member) for member in compound.Links], parts)
        with tempfile.TemporaryDirectory() as folder:
            path, name, names = os.path.join(folder, "compound.FCStd"), compound.Name, [part.Name for part in parts]
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
        compound = self.document.getObject(name)
        self.assertEqual([shapes.shown_by(member).Name for member in compound.Links], names)
        shapes.shown_by(compound.Links[0]).getParentGeoFeatureGroup().Placement.Base.z += 100
        self.document.recompute()
        self.assertGreater(compound.Shape.BoundBox.ZMax, height + 50)
        self.assertEqual(shapes.solid_labels(compound)[0], "Flange")

    def test_a_compound_of_links_as_older_documents_have_it(self):
        parts, containers = self.in_containers(2)
        compound = self.document.addObject("Part::Compound", "Older")
        for part, container in zip(parts, containers):
            link = self.document.addObject("App::Link", part.Name)
            link.setLink(container, part.Name + ".")
            link.LinkTransform, link.Label = True, "Link"
            compound.Links += [link]
        self.document.recompute()
        self.assertTrue(all(any(api.stands_for(member, part) for member in compound.Links) for part in parts))
        self.assertEqual(shapes.solid_labels(compound), [part.Label for part in parts])
        self.assertTrue(shapes.same(shapes.signature(shapes.shape_of(compound)), shapes.signature(shapes.shape_of(parts))))

    def test_labels_of_the_objects(self):
        """In the report and in refusals, by the objects of a list, of a compound, of fragments and of containers."""
        parts, containers = self.in_containers(2)
        for part, label in zip(parts, ("Flange, left", "Bolzen \u00d8 8")):
            part.Label = label
        expected = [part.Label for part in parts]
        with polycube.prepare(parts, size=5, order=1) as session:
            self.assertEqual([solid["label"] for solid in session.mesh().report["solids"]], expected)
        for thing in (parts, containers, polycube.compound_of(parts)):
            self.assertEqual([solid["label"] for solid in polycube.mesh(thing, size=5, order=1).report["solids"]], expected)
        shape_alone = polycube.mesh([part.Shape for part in self.bars()], size=5, order=1)
        self.assertEqual([solid["label"] for solid in shape_alone.report["solids"]], ["", ""])
        parts = self.bars()
        parts[0].Label, parts[1].Placement.Base = "Flange", Vector(15, 0, 0)
        self.document.recompute()
        with self.assertRaisesRegex(polycube.InvalidInput, 'Solid1 "Flange" and Solid2 "{}" overlap: they have 500 mm'.format(parts[1].Label)):
            polycube.create_fem_mesh(parts, size=5, order=1)

    def test_a_container_after_its_objects(self):
        """The compound that they were meshed as is no solid beside them."""
        parts, (container,) = self.in_containers(1)
        self.check(parts, 2, 1)
        self.check(container, 2, 1)

    def test_an_object_twice(self):
        """Named twice, or with the container that it is in, it is meant once."""
        parts, containers = self.in_containers(2)
        self.check([parts[0], parts[1], parts[0]], 2, 1)
        self.check([containers[0], parts[0], containers[1]], 2, 1)
        self.assertEqual(objects.part_of(polycube.create_fem_mesh([parts[0], parts[0]], size=5, order=1)), parts[0])

    def test_materials_across_moved_containers(self):
        """Materials and loads on objects in containers of their own: each bar stretches by its modulus."""
        parts, _ = self.in_containers(2)
        analysis = self.with_materials(parts, parts[0])
        self.add(analysis, "Force", parts[1], "Face2", Force=1000, Direction=(parts[1], ["Face2"]))
        obj = polycube.create_fem_mesh(parts, size=5, analysis=analysis)
        whole = objects.part_of(obj)
        solution = self.solve(analysis, whole)
        moved = self.of_face(solution, analysis, shapes.names_in(whole, parts[1], ["Face2"])[0], solution.result.DisplacementVectors)
        self.assertAlmostEqual(sum(vector.y for vector in moved) / len(moved) / (1000 / 100 * (20 / 210000 + 20 / 70000)), 1, delta=5e-3)

    def test_an_analysis_in_a_container_of_the_parts(self):
        """With both in one container it goes; with links to two containers, of which one holds the analysis, everything would depend on itself."""
        for count in (1, 2):
            parts, containers = self.in_containers(count)
            analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
            containers[0].addObject(analysis)
            before = len(self.document.Objects)
            if count == 1:
                obj = self.check(parts, 2, 1, analysis=analysis)
                self.assertAlmostEqual(obj.FemMesh.BoundBox.XMax, 40)
            else:
                with self.assertRaisesRegex(polycube.InvalidInput, "Analysis is in a container of some of the parts"):
                    polycube.create_fem_mesh(parts, size=5, order=1, analysis=analysis)
                self.assertEqual(len(self.document.Objects), before)


class Interfaces(BarsTest):
    """FreeCAD's contact and tie between faces of two solids with nodes of their own, as CalculiX sees them: no Poisson's ratio, cells of other sizes on both sides."""

    def between(self, analysis, kind, *references):
        constraint = analysis.addObject(getattr(ObjectsFem, "makeConstraint" + kind)(self.document, kind))[0]
        constraint.References = list(references)
        if kind == "Contact":
            solving.calculix.set_quantity(constraint, "Slope", 1e8, "MPa/mm")
        else:
            constraint.Tolerance = 0.1

    def pulled(self, kind, by, references, slave_first):
        """Forces along X with which the far end of the bars, moved by so much, is held, and their near end; the places of the two faces between afterwards."""
        parts = self.bars()
        whole = self.compound(parts)
        shape = whole.Shape
        analysis = self.analysis(whole, ["Face1"], PoissonRatio="0")
        faces = [self.end(parts[0].Shape, 20), self.end(parts[1].Shape, 20)]
        if references == "members":
            references = list(zip(parts, faces))
        else:
            references = [(whole, faces[0]), (whole, "Face{}".format(6 + int(faces[1][4:])))]
        self.between(analysis, kind, *(references if slave_first else reversed(references)))
        end = self.end(shape, 40)
        self.add(analysis, "Displacement", whole, end, xFree=False, xDisplacement=by, yFree=False, yFix=True, zFree=False, zFix=True)
        polycube.create_fem_mesh(whole, size=5, sizes={"Solid2": 3}, min_layers=1, interfaces="separate", analysis=analysis)
        solution = self.solve(analysis, whole)
        places = [
            {round(20 + vector.x, 9) for vector in self.of_face(solution, analysis, name, solution.result.DisplacementVectors)} for name in ("Solid1_Solid2", "Solid2_Solid1")
        ]
        return solving.total_of(solution.path, "Displacement"), solving.total_of(solution.path, "Support"), places

    def test_pressed_and_drawn(self):
        """Pressed, the load of E A d / L passes through either; drawn, contact opens and nothing passes, and a tie holds."""
        whole = 210000 * 100 * 0.01 / 40
        for kind in ("Contact", "Tie"):
            for by in (-0.01, 0.01):
                for references, slave_first in (("members", True), ("compound", False)):
                    with self.subTest(kind, by=by, references=references):
                        far, near, (one, other) = self.pulled(kind, by, references, slave_first)
                        self.assertLess((far + near).Length, 1e-3 * whole)
                        if kind == "Contact" and by > 0:
                            self.assertLess(abs(far.x), 1e-3 * whole)
                            self.assertAlmostEqual(min(other) - max(one), by, delta=1e-3 * by)
                        else:
                            self.assertAlmostEqual(far.x / whole, by / abs(by), delta=0.02)
                            for place in one | other:
                                self.assertAlmostEqual(place, 20 + by / 2, delta=0.1 * abs(by))

    def pinned(self, shared):
        """(objects, whole): a plate of 30 x 30 x 6 mm with a pin through its middle, in one object in which they share the bore's face, or in two with a compound."""
        pin = Part.makeCylinder(5, 18, Vector(15, 15, -6))
        plate = Part.makeBox(30, 30, 6).cut(pin)
        if shared:
            whole = self.part(plate.generalFuse([pin])[0])
            return [whole, whole], whole
        members = [self.part(plate), self.document.addObject("Part::Feature", "Pin")]
        members[1].Shape = pin
        return members, self.compound(members)

    def round_face(self, obj):
        faces = enumerate(obj.Shape.Faces, 1)
        return next("Face{}".format(n) for n, face in faces if face.Surface.TypeId == "Part::GeomCylinder" and face.CenterOfMass.isEqual(Vector(15, 15, 3), 1e-6))

    def test_a_pin_in_its_bore(self):
        """A pin drawn along the plate: what moves it is what holds the plate, by contact all of it on one half of the bore, which opens on the other. A face that
        both share is named once or twice, otherwise each of the objects has its own."""
        carried = {}
        for kind, named in (("Contact", "once"), ("Contact", "members"), ("Tie", "twice"), ("Tie", "members")):
            members, whole = self.pinned(shared=named != "members")
            bores = [(member, self.round_face(member)) for member in members][: 1 if named == "once" else 2]
            side = next("Face{}".format(n) for n, face in enumerate(whole.Shape.Faces, 1) if face.CenterOfMass.isEqual(Vector(0, 15, 3), 1e-6))
            ends = ["Face{}".format(n) for n, face in enumerate(whole.Shape.Faces, 1) if abs(face.Area - 25 * math.pi) < 1e-6]
            analysis = self.analysis(whole, [side])
            self.between(analysis, kind, *bores)
            self.add(analysis, "Displacement", whole, *ends, xFree=False, xDisplacement=0.01, yFree=False, yFix=True, zFree=False, zFix=True)
            polycube.create_fem_mesh(whole, size=3, min_layers=1, interfaces="separate", analysis=analysis)
            solution = self.solve(analysis, whole)
            drawn, held = (solving.total_of(solution.path, name) for name in ("Displacement", "Support"))
            self.assertGreater(drawn.x, 1000)
            self.assertLess((drawn + held).Length, 1e-3 * drawn.Length)
            carried[kind, named] = drawn.x
            mesh = self.mesh(analysis).FemMesh
            at = dict(zip(solution.result.NodeNumbers, solution.result.DisplacementVectors))
            for side in (-1, 1):
                mean = []
                for name in ("Solid1_Solid2", "Solid2_Solid1"):
                    nodes = {node for quad in self.group(mesh, name) for node in mesh.getElementNodes(quad) if -0.1 < mesh.Nodes[node].z < 6.1}
                    along = [at[node].x for node in nodes if side * (mesh.Nodes[node].x - 15) > 4.5]
                    mean.append(sum(along) / len(along))
                if kind == "Contact" and side < 0:
                    self.assertGreater(abs(mean[1] - mean[0]), 3e-3)
                else:
                    self.assertLess(abs(mean[1] - mean[0]), 1e-3)  # the nodes of both sides are not at the same places: 6e-4 is measured
        self.assertAlmostEqual(carried["Tie", "members"] / carried["Tie", "twice"], 1, delta=0.02)  # two meshes of the pin: 1.3 % is measured
        self.assertLess(max(carried["Contact", "once"], carried["Contact", "members"]), 0.8 * carried["Tie", "twice"])

    def test_a_tie_without_a_tolerance(self):
        """FreeCAD's tie has a tolerance of 0, and hardly a node is on the other bore then; the one that is put in its place ties them as if they were common. One
        that is too small is told, nodes of the pin outside the plate are not."""
        moved, notes = {}, {}
        for name, interfaces, tolerance in (("common", "conform", None), ("default", "separate", 0), ("small", "separate", 1e-3)):
            members, whole = self.pinned(shared=False)
            analysis = self.analysis(whole, ["Face1"])
            self.add(analysis, "Force", members[1], "Face2", Force=1000, Direction=(whole, ["Edge1"]))
            if tolerance is not None:
                self.between(analysis, "Tie", *((member, self.round_face(member)) for member in reversed(members)))
                self.document.getObject("Tie").Tolerance = tolerance
            polycube.create_fem_mesh(whole, size=3, min_layers=1, interfaces=interfaces, analysis=analysis)
            solution = self.solve(analysis, whole)
            moved[name], notes[name] = max(solution.result.DisplacementLengths), solution.notes
        self.assertAlmostEqual(moved["default"] / moved["common"], 1, delta=0.05)
        self.assertEqual(notes["common"], [])
        self.assertEqual(len(notes["default"]), 1, notes["default"])
        self.assertRegex(notes["default"][0], r"^Tie: its tolerance is 0; nodes within 0\.\d+ mm of the other face are tied$")
        self.assertEqual(len(notes["small"]), 1, notes["small"])
        self.assertRegex(notes["small"][0], r"^Tie: \d+ of \d+ nodes are at the other face and not tied to it; its tolerance may be too small$")

    def test_common_nodes_are_no_contact(self):
        members, whole = self.pinned(shared=False)
        analysis = self.analysis(whole, ["Face1"])
        self.between(analysis, "Tie", *((member, self.round_face(member)) for member in members))
        self.add(analysis, "Force", members[1], "Face2", Force=100, Direction=(members[1], ["Face2"]))
        polycube.create_fem_mesh(whole, size=6, min_layers=1, analysis=analysis)
        with self.assertRaisesRegex(polycube.InvalidInput, "Tie: the solids have common nodes where it acts; make the mesh with Interfaces = separate"):
            self.solve(analysis, whole)


class Inputs(solving.SolveTest):
    def test_a_list_of_shapes(self):
        result = polycube.mesh([Part.makeBox(10, 10, 5), Part.makeBox(4, 4, 4, Vector(3, 3, 5))], size=2, order=1, min_layers=1, interfaces="separate")
        self.assertEqual(sorted(set(result.hex_solid.tolist())), [1, 2])
        self.assertEqual(len(result.report["solids"]), 2)
        with self.assertRaises(polycube.InvalidInput):
            polycube.mesh([])

    def test_labels_and_sessions(self):
        parts = [Part.makeBox(10, 10, 5), Part.makeBox(4, 4, 4, Vector(3, 3, 5))]
        labels = polycube.labels(parts, size=2)
        self.assertTrue(labels.valid)
        self.assertEqual(sorted(labels.face_label), list(range(1, 13)))
        with polycube.prepare(parts, size=2, order=1, min_layers=1) as session:
            found = session.mesh()
            self.assertEqual(sorted(set(found.hex_solid.tolist())), [1, 2])
            self.assertEqual(session.count(), len(found.hexes))
            self.assertGreater(session.count(sizes={"Solid2": 1}), len(found.hexes))
            self.assertEqual(session.labels().face_label, labels.face_label)

    def test_a_list_of_one(self):
        one, alone = polycube.mesh([Part.makeBox(4, 4, 4)], size=2), polycube.mesh(Part.makeBox(4, 4, 4), size=2)
        self.assertTrue((one.nodes == alone.nodes).all())
