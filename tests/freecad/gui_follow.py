"""The panel while its document changes under it: undo, the tree, the property editor, renamed parts, analyses, other views in front; run by gui.sh."""

import os
import tempfile

import FemGui
import FreeCAD
import FreeCADGui
import gui_refine
import ObjectsFem
from gui_support import picture, process_events, wait_until
from PySide import QtCore

from freecad import polycube
from freecad.polycube import objects, overlay


class FollowTest(gui_refine.RefineTest):
    def settle(self):
        process_events(0.3)

    def first_line(self, panel):
        return panel.result.summary.text().split("\n")[0]


class OfRefinements(FollowTest):
    def test_undo_and_redo(self):
        panel = self.open_panel(self.box)
        self.choose("Face1", "Face2")
        self.add(panel, "layers")
        self.choose("Edge1")
        self.add(panel, "divisions")
        table = panel.refine.table
        for step, rows in ((self.document.undo, 1), (self.document.undo, 0), (self.document.redo, 1), (self.document.redo, 2)):
            step()
            self.settle()
            self.assertEqual(table.rowCount(), rows)
        table.item(1, 2).setText("7")
        self.assertEqual([obj.Elements for obj in panel.obj.Refinements], ["3..", "7"])
        self.press("Cancel")

    def test_what_is_done_elsewhere(self):
        panel = self.open_panel(self.box)
        self.choose("Face1", "Face2")
        layers = self.add(panel, "layers")
        self.choose("Edge1")
        divisions = self.add(panel, "divisions")
        table = panel.refine.table
        layers.Elements = "9"
        self.settle()
        self.assertEqual(table.item(0, 2).text(), "9")
        self.assertEqual(table.currentRow(), 1)
        layers.Elements = "many"
        self.settle()
        self.assertIn("'many' is not a number of elements", table.item(0, 0).toolTip())
        self.document.removeObject(layers.Name)
        # Before the panel has heard of it a click must find nothing.
        table.item(0, 0).setCheckState(QtCore.Qt.Unchecked)
        table.selectRow(0)
        self.settle()
        self.assertEqual([table.rowCount(), divisions.Suppressed], [1, False])
        self.press("Cancel")

    def test_text_that_is_no_number(self):
        panel = self.open_panel(self.box)
        panel.field("sizes").widget.setText("Face1=abc")
        panel.refine.as_objects.click()
        self.assertIn("'abc' is not a length", panel.refine.told.text())
        self.assertEqual(panel.refine.refinements(), [])
        self.press("Cancel")


class OfTheMesh(FollowTest):
    def test_undo_and_redo_of_apply(self):
        """With cells by themselves and colours, which were those of another mesh."""
        panel = self.meshed(10.0)
        panel.field("size").value = 5.0
        self.apply(panel)
        result = panel.result
        result.cut.setCurrentIndex(1)
        result.colours.setChecked(True)
        self.document.undo()
        self.settle()
        self.assertEqual((panel.obj.Hexahedra, panel.field("size").value), (48, 10.0))
        self.assertIn("48 cells", self.first_line(panel))
        self.assertEqual((result.cut.currentIndex(), result.colours.isChecked()), (0, False))
        result.cut.setCurrentIndex(1)
        self.document.undo()
        self.settle()
        self.assertFalse(panel.mesh_exists())
        self.assertEqual(self.first_line(panel), "No mesh yet")
        self.assertFalse(result.worst.isEnabled())
        self.document.redo()
        self.document.redo()
        self.settle()
        self.assertIn("384 cells", self.first_line(panel))
        result.cut.setCurrentIndex(1)
        self.assertIn("of 384 cells shown", result.told.text())
        self.press("Ok")
        self.assertTrue(panel.obj.ViewObject.isVisible())

    def test_a_mesh_that_is_deleted(self):
        panel = self.meshed(10.0)
        panel.result.cut.setCurrentIndex(1)
        self.document.removeObject(panel.obj.Name)
        self.settle()
        self.assertEqual(self.first_line(panel), "No mesh yet")
        self.assertIsNotNone(self.apply(panel))
        self.assertIn("48 cells", self.first_line(panel))
        self.press("Ok")

    def test_options_of_the_property_editor(self):
        """They are taken over, and OK does not write back what was there before; what was typed meanwhile stays."""
        panel = self.meshed(10.0)
        panel.field("min_layers").value = 3
        panel.obj.CharacteristicLengthMax = 5
        panel.obj.Labels = ["Face1=-X"]
        self.settle()
        self.assertEqual((panel.field("size").value, panel.field("min_layers").value, panel.axes.labels), (5.0, 3, {"Face1": "-X"}))
        self.assertIn("out of date", self.first_line(panel))
        self.press("Ok")
        mesh = self.document.PolycubeMesh
        self.assertEqual((mesh.CharacteristicLengthMax.Value, mesh.MinLayers, mesh.Labels), (5, 3, ["Face1=-X"]))

    def test_what_is_typed_right_after_a_mesh(self):
        """The panel gave the object its options itself: they are no news."""
        panel = self.meshed(10.0)
        panel.field("size").value = 8.0
        self.settle()
        self.assertEqual(panel.field("size").value, 8.0)
        self.press("Cancel")

    def test_a_mesh_that_is_made_by_a_script(self):
        panel = self.meshed(10.0)
        polycube.update_fem_mesh(panel.obj, size=5)
        self.settle()
        self.assertIn("384 cells", self.first_line(panel))
        self.assertEqual(panel.field("size").value, 5.0)
        self.press("Ok")

    def test_a_mesh_that_is_hidden_while_some_of_its_cells_are_shown(self):
        panel = self.meshed(10.0)
        view = panel.obj.ViewObject
        panel.result.cut.setCurrentIndex(1)
        view.hide()
        view.show()
        panel.result.cut_place.setValue(20)
        self.assertEqual(view.SwitchNode.whichChild.getValue(), -1)  # the whole would stand over its cells
        view.hide()
        panel.result.cut.setCurrentIndex(0)
        self.assertFalse(view.isVisible())
        view.show()
        self.assertTrue(view.isVisible())
        self.press("Ok")

    def test_no_cell_is_like_this(self):
        """A part that vanishes would be taken for a fault."""
        panel = self.meshed(10.0)
        panel.result.below.setChecked(True)
        self.assertIn("No cell", panel.result.told.text())
        panel.result.threshold.setValue(1.01)
        self.assertIn("48 of 48", panel.result.told.text())
        panel.result.below.setChecked(False)
        self.assertEqual(panel.result.told.text(), "")
        self.press("Ok")


class OfTheRest(FollowTest):
    def test_the_part(self):
        panel = self.open_panel(self.box)
        before = panel.hint.label.text()
        self.box.Label = "Block <b>of steel</b>"
        self.box.Length = 200
        self.document.recompute()
        self.settle()
        self.assertEqual(panel.form.part.text(), self.box.Label)
        self.assertEqual(panel.form.part.textFormat(), QtCore.Qt.PlainText)
        self.assertNotEqual(panel.hint.label.text(), before)
        self.press("Cancel")

    def test_axes_of_a_part_that_changes(self):
        panel = self.open_panel(self.box)
        panel.axes.preview.setChecked(True)
        self.assertTrue(wait_until(lambda: panel.axes.shown is not None and not panel.process))
        before = panel.axes.shown
        self.box.Length = 90
        self.document.recompute()
        self.assertTrue(wait_until(lambda: panel.axes.shown is not before and not panel.process, 20))
        self.document.removeObject(self.box.Name)
        self.settle()
        self.assertFalse(panel.axes.preview.isChecked())
        self.press("Cancel")

    def test_analyses(self):
        panel = self.open_panel(self.box)
        late = ObjectsFem.makeAnalysis(self.document, "Late")
        FemGui.setActiveAnalysis(late)
        self.settle()
        self.assertEqual(panel.analysis_box.chosen(), late)  # none was chosen, and the user works on it
        late.Label = "Bending"
        other = ObjectsFem.makeAnalysis(self.document, "Other")
        self.settle()
        self.assertEqual((panel.analysis_box.currentText(), panel.analysis_box.count()), ("Bending", 3))
        mesh = self.apply(panel)
        self.assertEqual(objects.analysis_of(mesh), late)
        late.removeObject(mesh)
        other.addObject(mesh)
        self.settle()
        self.assertEqual(panel.analysis_box.chosen(), other)
        self.press("Ok")
        self.assertEqual(objects.analysis_of(mesh), other)

    def test_another_view_is_in_front(self):
        """A table of this document: what is shown of the mesh is in its 3D view, which comes to the front."""
        panel = self.meshed(10.0)
        view = FreeCADGui.activeDocument().activeView()
        sheet = self.document.addObject("Spreadsheet::Sheet", "Sheet")
        for show, hide in (
            (lambda: panel.result.cut.setCurrentIndex(1), lambda: panel.result.cut.setCurrentIndex(0)),
            (lambda: panel.result.worst.itemDoubleClicked.emit(panel.result.worst.item(0, 0)), panel.result.show_whole),
            (lambda: panel.axes.preview.setChecked(True), lambda: panel.axes.preview.setChecked(False)),
        ):
            sheet.ViewObject.doubleClicked()
            self.settle()
            self.assertFalse(hasattr(FreeCADGui.activeDocument().activeView(), "getSceneGraph"))
            show()
            self.assertTrue(wait_until(lambda: not panel.process))
            self.settle()
            drawn = (panel.axes.overlay or panel.result._cell_overlay)._node
            self.assertGreaterEqual(view.getSceneGraph().findChild(drawn), 0)
            self.assertTrue(hasattr(FreeCADGui.activeDocument().activeView(), "getSceneGraph"))
            hide()
            self.assertEqual(view.getSceneGraph().findChild(drawn), -1)
        picture("table-in-front")
        self.press("Ok")

    def test_a_document_without_a_3d_view(self):
        hidden = FreeCAD.newDocument("Unseen", hidden=True)
        self.assertIsNone(overlay.view_of(hidden))
        self.addCleanup(FreeCAD.closeDocument, hidden.Name)
        overlay.Overlay(hidden, FreeCAD.Placement()).remove()


class BesideEachOther(FollowTest):
    """Several parts that are meshed as one, and a mesh that is asked for while a preview is made."""

    def setUp(self):
        super().setUp()
        self.pin = self.document.addObject("Part::Box", "Pin")
        self.pin.Placement.Base = FreeCAD.Vector(60, 0, 0)
        self.document.recompute()
        self.document.clearUndos()

    def open_for_both(self):
        FreeCADGui.Selection.clearSelection()
        for part in (self.box, self.pin):
            FreeCADGui.Selection.addSelection(part)
        return self.caught(lambda: FreeCADGui.runCommand("Polycube_MeshFromShape"))

    def test_cancel_leaves_the_document_alone(self):
        for button in ("Cancel", "Ok"):
            with self.subTest(button=button):
                self.lines.clear()
                panel = self.open_for_both()
                self.assertEqual(panel.part.Links, [self.box, self.pin])
                self.press(button)
                self.settle()
                self.assertEqual([obj.Name for obj in self.document.Objects], ["Block", "Pin"])
                self.assertEqual(list(self.document.UndoNames), [])
                self.assertTrue(self.box.ViewObject.isVisible() and self.pin.ViewObject.isVisible())
                self.assertEqual(self.lines, ["from freecad import polycube"])

    def test_parts_in_moved_containers(self):
        """In one, where the compound is too, and in one each, where it has likenesses: they go with a panel that is closed, and another one finds them."""
        for count in (1, 2):
            with self.subTest(containers=count):
                containers = [self.document.addObject("App::Part", "Container") for _ in range(count)]
                for number, part in enumerate((self.box, self.pin)):
                    containers[number % count].addObject(part)
                containers[0].Placement.Base = FreeCAD.Vector(0, 30, 0)
                self.document.recompute()
                self.document.clearUndos()
                before = sorted(obj.Name for obj in self.document.Objects)
                panel = self.open_for_both()
                other = self.document.addObject("App::FeaturePython", "Another")  # a step after that of the compound
                self.document.removeObject(other.Name)
                self.press("Cancel")
                self.settle()
                self.assertEqual(sorted(obj.Name for obj in self.document.Objects), before)
                panel = self.open_for_both()
                panel.field("size").value = 10.0
                mesh = self.apply(panel)
                self.assertGreater(mesh.FemMesh.BoundBox.YMax, 50)
                self.press("Ok")
                self.settle()
                again = self.open_for_both()
                self.assertEqual((again.part, again.obj), (panel.part, mesh))
                self.press("Cancel")
                self.settle()
                self.document.removeObject(mesh.Name)
                for member in [panel.part, *panel.part.Links]:
                    if member not in (self.box, self.pin):
                        self.document.removeObject(member.Name)
                for container in containers:
                    container.removeObjects([self.box, self.pin])
                    self.document.removeObject(container.Name)

    def test_the_user_undoes_a_compound_of_parts_in_containers(self):
        """By the command, mesh and compound, redoes and undoes them again: nothing is left, and the document can be saved. FreeCAD 1.0 fails to undo links."""
        containers = [self.document.addObject("App::Part", "Container") for _ in range(2)]
        for container, part in zip(containers, (self.box, self.pin)):
            container.addObject(part)
            container.Placement.Base = FreeCAD.Vector(0, 30, 0)
        self.document.recompute()
        self.document.clearUndos()
        before = [obj.Name for obj in self.document.Objects]
        panel = self.open_for_both()
        panel.field("size").value = 10.0
        self.apply(panel)
        self.press("Ok")
        self.settle()
        after = [obj.Name for obj in self.document.Objects]
        self.assertEqual(len(after), len(before) + 4)
        for command, names in (("Std_Undo", before), ("Std_Redo", after)) * 2:
            for _ in range(2):
                FreeCADGui.runCommand(command)
                self.settle()
            self.document.recompute()
            self.assertEqual([obj.Name for obj in self.document.Objects], names)
        with tempfile.TemporaryDirectory() as folder:
            self.document.saveAs(os.path.join(folder, "undone.FCStd"))

    def test_what_refers_to_the_compound_keeps_it(self):
        panel = self.open_for_both()
        other = self.document.addObject("Part::Compound", "Other")
        other.Links = [panel.part]
        self.press("Cancel")
        self.settle()
        self.assertEqual(other.Links[0].Links, [self.box, self.pin])

    def test_a_second_mesh_takes_the_same_compound(self):
        panel = self.open_for_both()
        panel.field("size").value = 10.0
        mesh = self.apply(panel)
        self.press("Ok")
        self.settle()
        self.assertEqual(list(self.document.UndoNames), ["Hexahedral mesh from shape", "Compound of the parts to mesh"])
        self.assertIsNone(FreeCAD.getActiveTransaction())
        self.assertEqual(sum("compound_of" in line for line in self.lines), 1)
        again = self.open_for_both()
        self.assertEqual((again.part, again.obj), (panel.part, mesh))
        self.press("Cancel")
        self.settle()
        self.assertEqual(len(self.document.findObjects("Part::Compound")), 1)

    def test_a_double_click_takes_back_no_step_that_another_has_left_open(self):
        panel = self.meshed(10.0)
        self.press("Ok")
        FreeCAD.setActiveTransaction("Another's")
        self.pin.Length = 25
        self.double_click_in_tree(panel.obj)
        self.settle()
        self.assertEqual(self.pin.Length.Value, 25)
        self.assertTrue(panel.mesh_exists())
        self.press("Cancel")

    def test_apply_while_a_preview_is_made(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 10.0
        panel.axes.preview.setChecked(True)
        self.assertEqual(panel.process.what, "labels")
        self.press("Apply")
        self.assertTrue(wait_until(lambda: panel.mesh_exists() and not panel.process and not panel._taking, 60))
        self.assertIn("Meshed", panel.form.status.text())
        self.assertFalse(panel.axes.preview.isChecked())
        self.press("Ok")
