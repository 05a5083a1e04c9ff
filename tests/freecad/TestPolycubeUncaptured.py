"""What of an analysis a mesh will not have, told before it is made."""

from unittest import mock

import FreeCAD
import ObjectsFem
import Part
import TestPolycubeSolve as solving

from freecad import polycube
from freecad.polycube import uncaptured


class Lines(solving.SolveTest):
    def told(self, part, analysis, labels=None):
        self.document.recompute()
        return uncaptured.lines(part, analysis, labels)

    def test_nothing_of_what_is_there(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Force", part, "Edge3", Force=100.0)
        self.add(analysis, "Displacement", part, "Vertex2")
        self.add(analysis, "BodyHeatSource", part, "Solid1")
        analysis.addObject(ObjectsFem.makeConstraintSelfWeight(self.document))
        analysis.addObject(ObjectsFem.makeConstraintInitialTemperature(self.document))
        self.assertEqual(self.told(part, analysis), [])
        self.assertEqual(uncaptured.lines(part, None), [])

    def test_other_parts_and_what_is_gone(self):
        part, analysis = self.bar("Face1")
        other = self.document.addObject("Part::Box", "Other")
        other.Placement.Base.x = 100
        self.document.recompute()
        self.add(analysis, "Pressure", other, "Face2", Pressure=1.0)
        self.add(analysis, "Force", part, "Face6", Force=100.0)
        self.add(analysis, "Fixed", part)
        part.Shape = Part.makeCylinder(5, 40)
        support = self.document.Support
        found = self.told(part, analysis)
        self.assertEqual(found, ["Pressure: Face2 of Other is not of Part", "Force: Part has no Face6 any more", "Fixed: refers to nothing"])
        self.assertEqual(support.References[0][1], ("Face1",))

    def test_a_face_at_the_same_place_is_found(self):
        part, analysis = self.bar("Face1")
        copy = self.document.addObject("Part::Feature", "Copy")
        copy.Shape = Part.makeBox(40, 10, 10)
        self.add(analysis, "Pressure", copy, "Face2", Pressure=1.0)
        self.assertEqual(self.told(part, analysis), [])

    def test_seams_and_points(self):
        part = self.part(Part.makeCone(10, 0, 20))
        analysis = self.analysis(part, [])
        for number, edge in enumerate(part.Shape.Edges, 1):
            self.add(analysis, "Displacement", part, "Edge{}".format(number)).Label = "Held{}".format(number)
        told = self.told(part, analysis)
        seam = next(number for number, edge in enumerate(part.Shape.Edges, 1) if abs(edge.BoundBox.ZLength - 20) < 1e-6)
        tip = next(number for number, edge in enumerate(part.Shape.Edges, 1) if edge.Degenerated)
        self.assertEqual(len(told), 2, told)
        self.assertIn("Held{0}: Edge{0} of Part is a seam".format(seam), " ".join(told))
        self.assertIn("Held{0}: Edge{0} of Part is a point".format(tip), " ".join(told))

    def test_materials(self):
        part, analysis = self.bar("Face1")
        other = self.document.addObject("Part::Box", "Other")
        other.Placement.Base.x = 40
        both = self.document.addObject("Part::Compound", "Both")
        both.Links = [part, other]
        third = self.document.addObject("Part::Box", "Third")
        third.Placement.Base.x = 400
        self.document.recompute()
        steel = next(member for member in analysis.Group if member.isDerivedFrom("App::MaterialObject"))
        self.assertEqual(self.told(both, analysis), [])
        steel.References = [(part, "")]
        self.assertEqual(self.told(both, analysis), ["Solid2 of Both has no material"])
        steel.References = [(both, "Solid1"), (third, "")]
        brass = ObjectsFem.makeMaterialSolid(self.document, "Brass")
        analysis.addObject(brass)
        brass.References = [(third, "Solid1")]
        found = self.told(both, analysis)
        self.assertEqual(found[0], "{}: Third is no solid of Both".format(steel.Label))
        self.assertEqual(found[1:], ["Brass: Solid1 of Third is no solid of Both", "Solid2 of Both has no material"])
        brass.References = []
        self.assertEqual(self.told([part, other], analysis)[1:], [])

    def test_edges_that_the_axes_give_up(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Force", part, "Edge3", Force=100.0)
        labels = polycube.labels(part)
        self.assertEqual(self.told(part, analysis, labels), [])
        labels.edges[3] = ("lost", "the map folds there")
        self.assertEqual(self.told(part, analysis, labels), ["Force: Edge3 of Part will have no mesh edges: the map folds there"])

    def test_scripts_are_warned_before_the_mesh(self):
        part, analysis = self.bar("Face1")
        self.add(analysis, "Fixed", part)
        mesh = polycube.create_fem_mesh(part, size=5, analysis=analysis)
        order = []
        with mock.patch.object(FreeCAD.Console, "PrintWarning", lambda text: order.append(text), create=True):
            for call in (lambda **more: polycube.create_fem_mesh(part, size=5, analysis=analysis, **more), lambda **more: polycube.update_fem_mesh(mesh, **more)):
                order.clear()
                call(progress=lambda stage, fraction: order.append(stage))
                self.assertEqual(order[0], "Fixed: refers to nothing\n")
