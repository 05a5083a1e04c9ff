"""Workbench, command and task panel in a real window; run by gui.sh."""

import os
import tempfile
from unittest import mock

import Fem
import FemGui
import FreeCAD
import FreeCADGui
import matplotlib.image
import ObjectsFem
import Part
import stuck
from gui_support import GuiTest, picture, process_events, wait_until
from pivy import coin
from PySide import QtCore, QtGui

from freecad import polycube
from freecad.polycube import commands, measures, objects, quality_view, task_panel


class Workbench(GuiTest):
    def test_is_there_with_its_command(self):
        self.assertIn("PolycubeWorkbench", FreeCADGui.listWorkbenches())
        self.assertIn(commands.MeshFromShape.Name, FreeCADGui.listCommands())
        menus = [action.text().replace("&", "") for action in FreeCADGui.getMainWindow().menuBar().actions()]
        self.assertIn("Polycube", menus)

    def test_fem_workbench_offers_the_command(self):
        FreeCADGui.activateWorkbench("FemWorkbench")
        process_events()
        mesh = FreeCADGui.getMainWindow().menuBar().findChild(QtGui.QMenu, "M&esh")
        self.assertIn(commands.MeshFromShape.Name, [action.objectName() for action in mesh.actions()])

    def test_command_needs_a_selected_part(self):
        FreeCADGui.Selection.clearSelection()
        self.assertFalse(commands.MeshFromShape().IsActive())
        FreeCADGui.Selection.addSelection(self.box)
        self.assertTrue(commands.MeshFromShape().IsActive())

    def test_solve_needs_an_active_analysis(self):
        self.assertFalse(commands.Solve().IsActive())


class Panel(GuiTest):
    def test_cancel_leaves_the_document_alone(self):
        self.open_panel(self.box)
        self.press("Cancel")
        self.assertIsNone(FreeCADGui.Control.activeDialog() or None)
        self.assertEqual(self.document.Objects, [self.box])
        self.assertEqual(list(self.document.UndoNames), [])

    def test_several_selected_objects(self):
        """They become a compound, in which each has its cells, with common nodes where they touch; the preview shows the labels of all."""
        pin = self.document.addObject("Part::Cylinder", "Pin")
        pin.Radius, pin.Height, pin.Placement.Base = 8, 15, FreeCAD.Vector(30, 20, 20)
        self.document.recompute()
        FreeCADGui.Selection.clearSelection()
        for part in (self.box, pin):
            FreeCADGui.Selection.addSelection(part)
        self.assertTrue(commands.MeshFromShape().IsActive())
        panel = self.caught(lambda: FreeCADGui.runCommand(commands.MeshFromShape.Name))
        self.assertEqual(panel.part.Links, [self.box, pin])
        panel.field("size").value = 8.0
        panel.axes.preview.setChecked(True)
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertTrue(panel.axes.shown.valid)
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertIsNotNone(panel.obj, panel.form.log.toPlainText())
        picture("several-selected")
        groups = [panel.obj.FemMesh.getGroupName(group) for group in panel.obj.FemMesh.Groups]
        for name in ("Solid1", "Solid2", "Solid1_Solid2", "Solid2_Solid1"):
            self.assertIn(name, groups)
        self.press("Ok")

    def test_apply_meshes_in_one_undo_step(self):
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        self.document.clearUndos()
        panel = self.open_panel(self.box)
        panel.field("size").value = 5.0
        picture("panel-before")
        self.press("Apply")
        self.assertIsNotNone(panel.process)
        self.press("Ok")
        self.assertTrue(FreeCADGui.Control.activeDialog(), "OK must be refused while the mesher runs")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertIsNotNone(panel.obj, panel.form.log.toPlainText())
        self.assertEqual(panel.obj.FemMesh.HexaCount, panel.obj.Hexahedra)
        self.assertIn(panel.obj, analysis.Group)
        self.assertEqual(panel.obj.CharacteristicLengthMax.Value, 5)
        self.assertIn("cells", panel.result.summary.text())
        self.assertGreater(sum(panel.result.histogram.counts), 0)
        FreeCADGui.SendMsgToActiveView("ViewFit")
        panel.result.worst.selectRow(0)
        picture("panel-after")
        self.press("Ok")
        process_events()
        self.assertEqual(len(self.document.UndoNames), 1, self.document.UndoNames)
        name = panel.obj.Name
        self.document.undo()
        self.assertIsNone(self.document.getObject(name))

    def test_quality_of_a_cylinder(self):
        cylinder = self.document.addObject("Part::Feature", "Cylinder")
        cylinder.Shape = Part.makeCylinder(20, 30)
        self.box.ViewObject.hide()
        panel = self.open_panel(cylinder)
        panel.field("size").value = 5.0
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertIsNotNone(panel.obj, panel.form.log.toPlainText())
        self.assertGreater(sum(count > 0 for count in panel.result.histogram.counts), 1)
        panel.result.colours.setChecked(True)
        FreeCADGui.getMainWindow().findChild(QtGui.QDockWidget, "Report view").hide()
        area = next(widget for widget in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea) if widget.isAncestorOf(panel.form))
        area.verticalScrollBar().setValue(area.verticalScrollBar().maximum())
        panel.result.worst.selectRow(0)
        picture("panel-colours")
        self.press("Ok")

    def test_undo_while_the_panel_is_open(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 20.0
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.document.undo()
        process_events()
        self.assertEqual(self.document.Objects, [self.box])
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertEqual(len(self.document.Objects), 2, panel.form.log.toPlainText())
        self.document.undo()
        self.press("Ok")
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def test_cancel_kills_the_mesher(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 0.4
        self.press("Apply")
        process_events(0.3)
        pid = int(panel.process.processId())
        folder = panel.job.folder
        self.press("Cancel")
        self.assertTrue(wait_until(lambda: not panel.process, 10))
        self.assertFalse(os.path.exists("/proc/{}/status".format(pid)))
        self.assertFalse(os.path.exists(folder))
        self.assertTrue(FreeCADGui.Control.activeDialog(), "the panel stays for another try")
        self.assertIn("cancelled", panel.form.log.toPlainText())
        self.assertEqual(self.document.Objects, [self.box])
        self.press("Cancel")
        self.assertEqual(list(self.document.UndoNames), [])

    def test_a_mesher_that_is_stuck_keeps_the_time_limit(self):
        obj = polycube.create_fem_mesh(self.box, size=20)
        obj.TimeLimit = 1
        panel = self.caught(lambda: obj.ViewObject.Proxy.doubleClicked(obj.ViewObject))
        with stuck.mesher():
            self.press("Apply")
            folder = panel.job.folder
            self.assertTrue(wait_until(lambda: not panel.process, 20))
        self.assertIn("out of time", panel.form.log.toPlainText())
        self.assertFalse(os.path.exists(folder))
        self.assertTrue(FreeCADGui.Control.activeDialog(), "the panel stays for another try")

    def test_a_part_that_changes_while_it_is_meshed(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 20.0
        self.press("Apply")
        self.box.Length = 80
        self.document.recompute()
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertEqual(panel.obj.MeshState, objects.OUTDATED)
        self.assertIn("the part has changed while it was meshed", panel.form.log.toPlainText())
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertEqual(panel.obj.MeshState, objects.CURRENT)

    def test_an_analysis_that_goes_while_the_part_is_meshed(self):
        FemGui.setActiveAnalysis(ObjectsFem.makeAnalysis(self.document, "Analysis"))
        panel = self.open_panel(self.box)
        panel.field("size").value = 20.0
        self.press("Apply")
        self.document.removeObject(panel.analysis.Name)
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertEqual(self.document.Objects, [self.box, panel.obj], panel.form.log.toPlainText())
        self.assertEqual(panel.obj.MeshState, objects.CURRENT)

    def test_a_bad_size_is_said_in_the_log(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 1e5
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process, 30))
        self.assertIn("size", panel.form.log.toPlainText())
        picture("panel-error")
        self.assertEqual(self.document.Objects, [self.box])

    def test_double_click_edits_and_the_icon_follows_the_state(self):
        obj = polycube.create_fem_mesh(self.box, size=10)
        current = obj.ViewObject.Proxy.getIcon()
        self.box.Length = 80
        self.document.recompute()
        self.assertEqual(obj.MeshState, objects.OUTDATED)
        self.assertNotEqual(obj.ViewObject.Proxy.getIcon(), current)
        obj.ViewObject.Proxy.doubleClicked(obj.ViewObject)
        process_events()
        self.assertTrue(FreeCADGui.Control.activeDialog())
        picture("panel-edit")
        cells = obj.Hexahedra
        self.document.clearUndos()
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not task_panel.MeshPanel._running))
        self.assertEqual(obj.MeshState, objects.CURRENT)
        self.assertNotEqual(obj.Hexahedra, cells)
        self.press("Ok")
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(len(self.document.UndoNames), 1, self.document.UndoNames)

    def test_ok_keeps_parameters_without_meshing(self):
        obj = polycube.create_fem_mesh(self.box, size=10)
        cells = obj.FemMesh.HexaCount
        obj.ViewObject.Proxy.doubleClicked(obj.ViewObject)
        process_events()
        spin = next(widget for widget in FreeCADGui.getMainWindow().findChildren(QtGui.QSpinBox) if widget.objectName() == "hexes")
        spin.setValue(500)
        self.press("Ok")
        self.assertEqual(obj.Hexes, 500)
        self.assertEqual(obj.FemMesh.HexaCount, cells)
        self.assertEqual(obj.MeshState, objects.OUTDATED)


class QualityInColours(GuiTest):
    """The nodes in the colours of the histogram, whatever the range of quality and the size of the mesh."""

    def grid(self, cells, shear):
        """A cube of `cells` cells along each edge, its layers pushed the farther along x the higher their y."""
        points = cells + 1
        mesh = Fem.FemMesh()
        for number in range(points**3):
            x, y, z = number % points, number // points % points, number // points**2
            mesh.addNode(x + shear * y * y / cells, y, z, number + 1)
        corners = [0, points, points + 1, 1]
        for number in range(cells**3):
            first = number % cells + points * (number // cells % cells) + points**2 * (number // cells**2) + 1
            mesh.addVolume([first + corner for corner in corners] + [first + corner + points**2 for corner in corners], number + 1)
        obj = self.document.addObject("Fem::FemMeshObject", "Grid")
        obj.FemMesh = mesh
        return obj

    @staticmethod
    def painted(view):
        """The colours that the 3D view has for single nodes, each once."""
        search = coin.SoSearchAction()
        search.setType(coin.SoMaterial.getClassTypeId())
        search.setInterest(coin.SoSearchAction.ALL)
        search.setSearchingAll(True)
        search.apply(view.RootNode)
        paths = search.getPaths()
        fields = [paths[i].getTail().diffuseColor for i in range(paths.getLength())]
        return {tuple(round(channel, 3) for channel in colour.getValue()) for field in fields if field.getNum() > 1 for colour in field.getValues(0)}

    def test_colours_are_those_of_the_bars(self):
        for shear in (0, 0.4, 1.5, 4):
            with self.subTest(shear=shear):
                obj = self.grid(6, shear)
                cells = measures.Cells(obj.FemMesh)
                quality_view.paint(obj.ViewObject, cells, measures.MEASURES[0])
                bars = set(measures.bar_of(cells.node_goodness(measures.MEASURES[0])).tolist())
                self.assertEqual(len(bars) > 1, shear > 0)
                self.assertEqual(self.painted(obj.ViewObject), {tuple(round(channel, 3) for channel in quality_view.colour(bar)) for bar in bars})

    def test_bars_differ_and_the_best_is_not_dark(self):
        colours = [QtGui.QColor.fromRgbF(*quality_view.colour(bar)) for bar in range(measures.BARS)]
        self.assertEqual(len({colour.rgb() for colour in colours}), measures.BARS)
        self.assertEqual(colours[0].getRgb(), (255, 0, 0, 255))
        self.assertGreater(colours[-1].blueF(), 0.9)
        self.assertGreater(min(QtGui.qGray(colour.rgb()) for colour in colours), 75)

    def test_all_nodes_are_painted_at_once(self):
        """`NodeColor` takes a time that grows with the square of the nodes."""
        obj = self.grid(3, 1)
        view = mock.Mock(spec_set=["setNodeColorByScalars"])
        quality_view.paint(view, measures.Cells(obj.FemMesh), measures.MEASURES[0])
        view.setNodeColorByScalars.assert_called_once()
        self.assertLessEqual(set(obj.FemMesh.Nodes), set(view.setNodeColorByScalars.call_args.args[0]))


class AxesOfFaces(GuiTest):
    """The preview of the labels, and the axes that a click gives to faces."""

    def setUp(self):
        super().setUp()
        self.chamfered = self.document.addObject("Part::Feature", "Chamfered")
        block = Part.makeBox(60, 40, 30).cut(Part.makeCylinder(8, 30, FreeCAD.Vector(20, 20, 0)))
        edge = next(edge for edge in block.Edges if edge.BoundBox.XMin > 59 and edge.BoundBox.ZMin > 29)
        self.chamfered.Shape = block.makeChamfer(10, [edge])
        self.document.recompute()
        faces = self.chamfered.Shape.Faces
        self.chamfer = next(number for number, face in enumerate(faces, 1) if face.normalAt(0, 0).x > 0.1 and face.normalAt(0, 0).z > 0.1)
        self.bore = next(number for number, face in enumerate(faces, 1) if face.Surface.TypeId == "Part::GeomCylinder")
        self.box.ViewObject.hide()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        self.panel = self.open_panel(self.chamfered)

    def settle(self):
        self.assertTrue(wait_until(lambda: not self.panel.process))

    def click(self, face):
        """As the 3D view tells of a click."""
        FreeCADGui.Selection.addSelection(self.document.Name, self.chamfered.Name, "Face{}".format(face))
        process_events(0.2)
        self.settle()

    def shown(self, face):
        labels = self.panel.axes.shown
        return {int(label) for label in labels.label[labels.triangle_face == face]}

    def children_of_scene(self):
        return FreeCADGui.activeDocument().activeView().getSceneGraph().getNumChildren()

    def test_clicks_go_through_the_axes(self):
        before = self.children_of_scene()
        self.panel.axes.preview.setChecked(True)
        self.settle()
        self.assertEqual(self.children_of_scene(), before + 1)
        self.assertTrue(self.panel.axes.shown.valid)
        view = FreeCADGui.activeDocument().activeView()
        hit = view.getObjectInfo(view.getPointOnScreen(self.chamfered.Shape.Faces[self.chamfer - 1].CenterOfMass))
        self.assertEqual((hit["Object"], hit["Component"]), (self.chamfered.Name, "Face{}".format(self.chamfer)), "the preview lets clicks through")
        (automatic,) = self.shown(self.chamfer)
        self.assertIn(automatic, (0, 4))
        picture("labels-automatic")
        other = 4 - automatic
        self.click(self.chamfer)
        self.assertEqual(self.panel.axes.labels, {"Face{}".format(self.chamfer): {0: "+X", 4: "+Z"}[other]})
        self.assertEqual(self.shown(self.chamfer), {other})
        self.assertEqual(FreeCADGui.Selection.getSelectionEx(), [], "a click must not leave a selection")
        picture("labels-by-hand")
        self.click(self.chamfer)
        self.assertEqual(self.shown(self.chamfer), {automatic})
        self.assertEqual(len(self.panel.axes.labels), 1)
        self.click(self.chamfer)
        self.assertEqual(self.panel.axes.labels, {})
        self.click(self.bore)
        self.assertEqual(self.panel.axes.labels, {})
        self.assertIn("Face{} turns too far".format(self.bore), self.panel.form.log.toPlainText())
        self.panel.axes.preview.setChecked(False)
        self.assertEqual(self.children_of_scene(), before)
        self.click(self.chamfer)
        self.assertEqual(self.panel.axes.labels, {}, "without the preview clicks select as ever")
        self.panel.axes.preview.setChecked(True)
        self.settle()
        FreeCADGui.Control.closeDialog()
        process_events()
        self.assertEqual(self.children_of_scene(), before)
        self.click(self.chamfer)
        self.assertEqual(self.panel.axes.labels, {}, "a panel that is gone takes no clicks")

    def test_axes_reach_mesh_and_properties(self):
        self.panel.axes.preview.setChecked(True)
        self.settle()
        self.click(self.chamfer)
        wanted = dict(self.panel.axes.labels)
        self.assertEqual([self.panel.axes.given.item(0).text()], ["{}={}".format(*item) for item in wanted.items()])
        self.panel.field("size").value = 6.0
        self.press("Apply")
        self.settle()
        self.assertIsNotNone(self.panel.obj, self.panel.form.log.toPlainText())
        self.assertFalse(self.panel.axes.preview.isChecked(), "the mesh takes the place of the preview")
        self.assertIsNone(self.panel.axes.overlay)
        self.assertEqual(list(self.panel.obj.Labels), ["{}={}".format(*item) for item in wanted.items()])
        self.assertEqual(self.panel.obj.MeshState, objects.CURRENT)
        self.panel.axes.automatic.click()
        self.assertEqual(self.panel.axes.given.count(), 0)
        self.press("Ok")
        self.assertEqual(list(self.panel.obj.Labels), [])
        self.assertEqual(self.panel.obj.MeshState, objects.OUTDATED)


class ConvexFillets(GuiTest):
    """FreeCAD draws them up to half a percent of the part's size off the labels' triangles."""

    def grey(self):
        """Pixels of the part's own colour in the 3D view."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "view.png")
            FreeCADGui.activeDocument().activeView().saveImage(path, 640, 512, "Current")
            pixels = matplotlib.image.imread(path)[:, :, :3]
        return int(((pixels.min(axis=2) > 0.25) & (pixels.min(axis=2) > 0.97 * pixels.max(axis=2))).sum())

    def test_the_labels_hide_the_part(self):
        rounded = self.document.addObject("Part::Feature", "Rounded")
        block = Part.makeBox(60, 40, 30)
        rounded.Shape = block.makeFillet(9, block.Edges)
        rounded.ViewObject.ShapeColor = (1.0, 1.0, 1.0)
        self.document.recompute()
        self.box.ViewObject.hide()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        process_events(0.3)
        panel = self.open_panel(rounded)
        FreeCADGui.Selection.clearSelection()
        process_events(0.3)
        before = self.grey()
        self.assertGreater(before, 10000)
        panel.axes.preview.setChecked(True)
        self.assertTrue(wait_until(lambda: not panel.process))
        process_events(0.3)
        picture("labels-of-fillets")
        self.assertLess(self.grey(), 1e-4 * before)


class InAContainer(GuiTest):
    """A solid in a moved App::Part, and the container itself as the part."""

    def setUp(self):
        super().setUp()
        self.container = self.document.addObject("App::Part", "Container")
        self.container.addObject(self.box)
        self.container.Placement = FreeCAD.Placement(FreeCAD.Vector(90, 30, 10), FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), 30))
        self.document.recompute()
        FreeCADGui.SendMsgToActiveView("ViewFit")

    def mesh(self, part):
        panel = self.open_panel(part)
        self.assertIn("0 is automatic", panel.form.size_hint.text())
        panel.field("size").value = 10.0
        panel.axes.preview.setChecked(True)
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertTrue(panel.axes.shown.valid)
        picture("container-labels-" + part.Name)
        asked = []
        panel.axes.face_clicked = panel.axes.clicks._clicked = asked.append
        FreeCADGui.Selection.addSelection(self.document.Name, self.container.Name, self.box.Name + ".Face3")
        process_events(0.3)
        self.assertEqual(asked, [3], "a click as the 3D view tells of it")
        panel.select(["Face2"])
        (selected,) = FreeCADGui.Selection.getSelectionEx()
        self.assertEqual((selected.Object, selected.SubElementNames), (self.box, ("Face2",)))
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process))
        self.assertIsNotNone(panel.obj, panel.form.log.toPlainText())
        picture("container-mesh-" + part.Name)
        return panel.obj

    def test_the_mesh_stands_where_the_part_stands(self):
        for part in (self.box, self.container):
            obj = self.mesh(part)
            box = obj.FemMesh.BoundBox
            standing = self.box.Shape.transformed(self.container.Placement.Matrix).BoundBox
            for name in ("XMin", "XMax", "YMin", "YMax", "ZMin", "ZMax"):
                self.assertAlmostEqual(getattr(box, name), getattr(standing, name), delta=1e-6)
            self.assertTrue(obj.ViewObject.isVisible())
            self.assertFalse(self.box.ViewObject.isVisible())
            self.press("Ok")
            self.assertEqual(obj.MeshState, objects.CURRENT)
            obj.ViewObject.hide()

    def test_an_analysis_inside(self):
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        self.container.addObject(analysis)
        FemGui.setActiveAnalysis(analysis)
        obj = self.mesh(self.container)
        self.assertIn(obj, analysis.Group)
        self.assertTrue(self.container.ViewObject.isVisible())
        self.assertAlmostEqual(obj.FemMesh.BoundBox.XMin, 0, delta=1e-6)
        self.press("Ok")
        self.assertEqual(obj.MeshState, objects.CURRENT)


class RefusedShapes(GuiTest):
    def test_what_has_no_faces_opens_a_message_and_no_panel(self):
        wire = self.document.addObject("Part::Feature", "Wire")
        wire.Shape = Part.makeLine(FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(1, 0, 0))
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(wire)
        texts = []

        def close():
            box = QtGui.QApplication.activeModalWidget()
            if isinstance(box, QtGui.QMessageBox):
                texts.append(box.text())
                box.close()
            else:
                QtCore.QTimer.singleShot(100, close)

        QtCore.QTimer.singleShot(100, close)
        FreeCADGui.runCommand(commands.MeshFromShape.Name)
        self.assertEqual(len(texts), 1)
        self.assertIn("the shape is empty", texts[0])
        self.assertFalse(FreeCADGui.Control.activeDialog())
