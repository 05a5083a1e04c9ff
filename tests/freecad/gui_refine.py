"""Refinements in the window: made from the selection, changed in the panel and in the tree, recorded in macros; run by gui.sh."""

from unittest import mock

import FreeCAD
import FreeCADGui
import gui_panel
from gui_support import mouse, picture, process_events, set_panel_width
from PySide import QtCore, QtGui

from freecad.polycube import macro, objects, option_table, refinements


class RefineTest(gui_panel.PanelTest):
    def setUp(self):
        super().setUp()
        self.lines = []
        original = macro.record

        def record(line, obj):
            self.lines.append(line)
            original(line, obj)

        patch = mock.patch.object(macro, "record", record)
        patch.start()
        self.addCleanup(patch.stop)

    def choose(self, *names):
        """As clicks in the 3D view do."""
        FreeCADGui.Selection.clearSelection()
        for name in names:
            FreeCADGui.Selection.addSelection(self.name, self.box.Name, name)
        process_events(0.1)

    def offered(self, panel):
        """Kinds that can be added now."""
        menu = panel.refine.add_button.menu()
        menu.aboutToShow.emit()
        return {action.objectName() for action in menu.actions() if action.isEnabled()}

    def add(self, panel, kind):
        menu = panel.refine.add_button.menu()
        menu.aboutToShow.emit()
        next(action for action in menu.actions() if action.objectName() == kind).trigger()
        process_events(0.1)
        return panel.obj.Refinements[-1]


class FromTheSelection(RefineTest):
    def test_kinds_follow_the_selection(self):
        panel = self.open_panel(self.box)
        for names, kinds in (
            ((), set()),
            (("Face1",), {"size", "levels", "bore", "keep", "axis"}),
            (("Face1", "Face2"), {"size", "levels", "bore", "keep", "axis", "layers"}),
            (("Edge1", "Edge2"), {"size", "levels", "divisions", "bias"}),
            (("Face1", "Edge2"), {"size", "levels", "bore", "keep", "axis", "divisions", "bias"}),
            (("Vertex1",), {"levels"}),
        ):
            with self.subTest(names=names):
                self.choose(*names)
                self.assertEqual(self.offered(panel), kinds)
        self.press("Cancel")

    def test_before_the_first_mesh_and_in_it(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 10.0
        self.choose("Face1", "Face2")
        layers = self.add(panel, "layers")
        self.assertEqual(panel.obj.MeshState, objects.EMPTY)
        self.assertEqual(list(self.document.UndoNames), ["Refinement"])
        self.assertTrue(panel.refine.is_open())
        self.choose("Edge1")
        self.add(panel, "divisions")
        self.choose("Face1")
        size = self.add(panel, "size")
        self.assertEqual(size.Size.Value, 5)
        table = panel.refine.table
        self.assertEqual([table.item(row, 1).text() for row in range(3)], ["Face1, Face2", "Edge1", "Face1"])
        table.item(0, 2).setText("7")
        self.assertEqual(layers.Elements, "7")
        table.item(1, 2).setText("none")
        self.assertIn("not a number of elements", panel.form.status.text())
        self.assertEqual(table.item(1, 2).text(), "4")
        table.item(2, 0).setCheckState(QtCore.Qt.Unchecked)
        self.assertTrue(size.Suppressed)
        picture("refinements")
        self.apply(panel)
        self.assertEqual(panel.obj.MeshState, objects.CURRENT)
        mesh = panel.obj.FemMesh
        (edge,) = [group for group in mesh.Groups if mesh.getGroupName(group) == "Edge1"]
        self.assertEqual(len(mesh.getGroupElements(edge)), 4)
        self.assertEqual(panel.obj.Hexahedra % 7, 0)
        table.selectRow(2)
        panel.refine.remove_button.click()
        self.assertEqual(panel.obj.Refinements, panel.refine.refinements())
        self.assertEqual(len(panel.obj.Refinements), 2)
        self.press("Ok")
        self.assertIn("Refinement", self.document.UndoNames)

    def edit(self, table, row):
        """A double click on a value; the editor that it opens."""
        mouse(table.viewport(), table.visualItemRect(table.item(row, 2)).center(), double=True)
        process_events(0.1)
        return next(widget for widget in table.viewport().findChildren(QtGui.QWidget) if widget.isVisible() and widget.parentWidget() is table.viewport())

    def test_local_refinement(self):
        """At what is clicked, its levels set within their bounds; an axis is chosen of those that there are."""
        panel = self.meshed()
        before = panel.obj.Hexahedra
        self.choose("Vertex1", "Edge1")
        levels = self.add(panel, "levels")
        self.assertEqual((refinements.places_of(levels), levels.Levels), (["Vertex1", "Edge1"], 1))
        editor = self.edit(panel.refine.table, 0)
        self.assertEqual((editor.minimum(), editor.maximum(), editor.value()), (1, 6, 1))
        editor.setValue(2)
        picture("levels")
        self.finish(editor)
        self.assertEqual(levels.Levels, 2)
        self.assertIn("value='2'", self.lines[-1])
        self.choose("Face1")
        axis = self.add(panel, "axis")
        editor = self.edit(panel.refine.table, 1)
        self.assertEqual([editor.itemText(row) for row in range(editor.count())], ["+X", "-X", "+Y", "-Y", "+Z", "-Z"])
        editor.setCurrentIndex(1)
        self.finish(editor)
        self.assertEqual(axis.Axis, "-X")
        self.apply(panel)
        self.assertEqual(panel.obj.MeshState, objects.CURRENT, panel.form.log.toPlainText())
        self.assertGreater(panel.obj.Hexahedra, before)
        self.press("Ok")

    def test_values_are_in_sight_in_a_narrow_dock(self):
        panel = self.meshed()
        for names, kind in ((("Face1", "Face2", "Face3"), "size"), (("Edge1", "Edge2"), "divisions"), (("Face1", "Edge1", "Vertex1"), "levels")):
            self.choose(*names)
            self.add(panel, kind)
        set_panel_width(280)
        process_events(0.3)
        table = panel.refine.table
        for row in range(table.rowCount()):
            self.assertLessEqual(table.visualItemRect(table.item(row, 2)).right(), table.viewport().width())
            self.assertEqual(table.item(row, 1).toolTip(), table.item(row, 1).text())
        self.assertEqual(table.horizontalScrollBar().maximum(), 0)
        self.assertEqual((self.box.ViewObject.isVisible(), panel.obj.ViewObject.isVisible()), (True, False), "the places are on the part, the mesh would hide them")
        picture("narrow-refinements")
        self.press("Ok")

    @staticmethod
    def finish(editor):
        for kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.KeyRelease):
            QtGui.QApplication.sendEvent(editor, QtGui.QKeyEvent(kind, QtCore.Qt.Key_Return, QtCore.Qt.NoModifier))
        process_events(0.1)

    def test_of_several_solids_one_is_chosen_in_the_tree(self):
        other = self.document.addObject("Part::Box", "Beside")
        other.Placement.Base.x = 60
        FreeCADGui.Selection.clearSelection()
        both = self.document.addObject("Part::Compound", "Both")
        both.Links = [self.box, other]
        self.document.recompute()
        panel = self.open_panel(both)
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(other)
        self.assertEqual(panel.refine.selected_places(), ["Solid2"])
        self.press("Cancel")

    def test_the_tree_has_them_below_the_mesh(self):
        panel = self.meshed()
        self.choose("Face1")
        refinement = self.add(panel, "size")
        self.press("Ok")
        self.assertEqual(panel.obj.ViewObject.Proxy.claimChildren(), [refinement])
        again = self.caught(lambda: refinement.ViewObject.Proxy.doubleClicked(refinement.ViewObject))
        self.assertIs(again.obj, panel.obj)
        self.assertEqual(again.refine.table.currentRow(), 0)
        self.press("Cancel")

    def test_icons_tell_what_is_off_and_what_is_faulty(self):
        panel = self.meshed()
        self.choose("Face1")
        refinement = self.add(panel, "axis")
        self.press("Ok")
        icon = refinement.ViewObject.Proxy.getIcon
        seen = {icon()}
        refinement.Suppressed = True
        seen.add(icon())
        refinement.References = [(self.box, ["Face9"])]
        seen.add(icon())
        self.assertEqual(len(seen), 3, seen)

    def test_a_faulty_one_is_told_at_apply(self):
        panel = self.meshed()
        self.choose("Face1")
        refinement = self.add(panel, "keep")
        refinement.References = [(self.box, ["Face9"])]
        self.press("Apply")
        self.assertIsNone(panel.process)
        self.assertEqual(panel.form.status.text(), "Faces to keep: Block has no Face9 any more")
        self.press("Ok")


class Copied(RefineTest):
    def with_copy(self, with_part):
        """A refinement of a mesh, and what FreeCAD's Copy and Paste make of it, with a copy of the part or without."""
        panel = self.open_panel(self.box)
        self.choose("Face1", "Face2")
        layers = self.add(panel, "layers")
        self.press("Ok")
        process_events(0.3)
        copy = self.document.copyObject([self.box, layers] if with_part else layers)
        process_events(0.3)
        return panel.obj, layers, copy[1] if with_part else copy

    def test_it_joins_the_mesh_of_its_part(self):
        mesh, layers, copy = self.with_copy(False)
        self.assertEqual((mesh.Refinements, copy.Fault), ([layers, copy], ""))
        self.assertEqual(refinements.places_of(copy), ["Face1", "Face2"])

    def test_with_a_copy_of_the_part_it_waits_to_be_dropped_onto_a_mesh(self):
        mesh, layers, copy = self.with_copy(True)
        self.assertEqual(mesh.Refinements, [layers])
        self.assertIn("belongs to no mesh", copy.Fault)
        view = mesh.ViewObject
        self.assertTrue(view.Proxy.canDropObject(copy) and view.Proxy.canDragObject(layers))
        self.assertFalse(view.Proxy.canDropObject(self.box))
        view.dropObject(copy)
        self.assertEqual((mesh.Refinements, copy.Fault, refinements.fault(copy)), ([layers, copy], "", ""))
        view.dragObject(layers)
        self.assertEqual(mesh.Refinements, [copy])
        self.assertIn("belongs to no mesh", layers.Fault)

    def test_with_its_mesh(self):
        mesh, layers, copy = self.with_copy(False)
        self.document.copyObject(mesh, True)
        process_events(0.3)
        other = next(obj for obj in self.document.Objects if objects.is_polycube(obj) and obj != mesh)
        self.assertEqual(len(other.Refinements), 2)
        self.assertEqual(mesh.Refinements, [layers, copy])


class AsText(RefineTest):
    def test_text_becomes_objects(self):
        panel = self.meshed()
        panel.field("sizes").value = "Face3=0.5,X=2"
        panel.field("divisions").value = "Edge4=6,Face1-Face2=3.."
        panel.field("refine").value = "Face6=2,Edge3=1,Vertex2=1"
        panel.field("keep_faces").value = "Face5"
        panel.changed()
        asked = panel._parameters()
        self.document.clearUndos()
        panel.refine.as_objects.click()
        self.assertEqual(list(self.document.UndoNames), ["Refinements of text"])
        self.assertEqual(panel._parameters(), {"size": 10.0, "sizes": "X=2"})
        merged = refinements.with_refinements(panel._parameters(), panel.obj)
        self.assertEqual(sorted(merged.pop("sizes").split(",")), ["Face3=0.5", "X=2"])
        asked.pop("sizes")
        self.assertEqual(merged, asked)
        self.press("Ok")
        self.assertEqual(option_table.read(panel.obj), {"size": 10.0, "sizes": "X=2"})


class Recorded(RefineTest):
    def test_a_session_replays_to_the_same_mesh(self):
        panel = self.open_panel(self.box)
        panel.field("size").value = 10.0
        self.choose("Face1", "Face2")
        self.add(panel, "layers")
        panel.refine.table.item(0, 2).setText("5")
        self.choose("Edge1")
        self.add(panel, "divisions")
        panel.refine.table.item(1, 0).setCheckState(QtCore.Qt.Unchecked)
        self.apply(panel)
        self.press("Ok")
        lines = list(self.lines)
        document = FreeCAD.newDocument()
        self.addCleanup(lambda: FreeCAD.closeDocument(document.Name))
        box = document.addObject("Part::Box", "Block")
        box.Length, box.Width, box.Height = 60, 40, 20
        document.recompute()
        FreeCAD.setActiveDocument(document.Name)
        exec("\n".join(lines), {"App": FreeCAD, "Gui": FreeCADGui})
        FreeCAD.setActiveDocument(self.name)
        (made,) = [obj for obj in document.Objects if objects.is_polycube(obj)]
        self.assertEqual(made.MeshState, objects.CURRENT)
        self.assertEqual(made.MeshedOptions, panel.obj.MeshedOptions)
        points = [{number: tuple(point) for number, point in obj.FemMesh.Nodes.items()} for obj in (made, panel.obj)]
        self.assertEqual(points[0], points[1])
