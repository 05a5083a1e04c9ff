"""What helps before and after a mesh: the number of cells, ways out of a refusal, blocks and polycube to look at, the guide; run by gui.sh."""

import re
from unittest import mock

import FreeCAD
import FreeCADGui
import gui_panel
import Part
from gui_support import mouse, picture, process_events, wait_until
from pivy import coin
from PySide import QtCore, QtGui

from freecad.polycube import commands, help_page, preferences, typical
from freecad.polycube.errors import StageFailed
from freecad.polycube.label_view import beside
from freecad.polycube.quality_view import block_colours
from freecad.polycube.result import as_runs, of_runs
from freecad.polycube.run_section import RunSection


class AidsTest(gui_panel.PanelTest):
    def setUp(self):
        super().setUp()
        self.plate = self.document.addObject("Part::Feature", "Plate")
        self.plate.Shape = Part.makeBox(60, 40, 10).cut(Part.makeCylinder(8, 10, FreeCAD.Vector(20, 20, 0)))
        self.document.recompute()
        self.box.ViewObject.hide()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        self.panel = self.open_panel(self.plate)
        self.stages = []
        heard = self.panel._heard
        self.enterContext(mock.patch.object(self.panel, "_heard", lambda kind, value: (self.stages.append(value[0] if kind == "progress" else ""), heard(kind, value))))

    def counted(self):
        """Cells that the panel has counted, once it has."""
        found = []

        def told():
            found[:] = re.findall(r"([\d,]+) cells with these", self.panel.form.size_hint.text())
            return found

        self.assertTrue(wait_until(told, 60), self.panel.form.size_hint.text())
        return int(found[0].replace(",", ""))

    def settle(self):
        self.assertTrue(wait_until(lambda: not self.panel.process and not self.panel._taking))


class Count(AidsTest):
    def test_it_is_that_of_the_mesh(self):
        """By the button, with every change of an option from then on, by one process; within 15 % of what comes."""
        panel = self.panel
        self.assertRegex(panel.form.size_hint.text(), "about [0-9,]+ cells")
        self.assertIsNone(panel._session)
        panel.hint.count_button.click()
        automatic = self.counted()
        self.assertFalse(panel.hint.count_button.isVisible())
        pid, folder = panel._session.processId(), panel._session.job.folder
        panel.field("size").value = 3.0
        self.assertRegex(panel.form.size_hint.text(), "about [0-9,]+ cells")
        finer = self.counted()
        self.assertGreater(finer, automatic)
        panel.field("divisions").value = "Edge99=3"
        panel.changed()
        self.assertTrue(wait_until(lambda: "Edge99" in panel.form.size_hint.text(), 60))
        panel.field("divisions").value = ""
        panel.changed()
        self.assertEqual(self.counted(), finer)
        self.assertEqual(panel._session.processId(), pid)
        self.apply(panel)
        self.assertAlmostEqual(finer / panel.obj.Hexahedra, 1, delta=0.15)
        self.assertNotIn("with these", panel.form.size_hint.text(), "it is known")
        self.press("Ok")
        self.assertFalse(QtCore.QFileInfo.exists(folder))
        self.assertFalse(QtCore.QFileInfo.exists("/proc/{}".format(pid)))

    def test_once_labels_are_known(self):
        panel = self.panel
        panel.field("size").value = 4.0
        panel.axes.preview.setChecked(True)
        self.settle()
        told = self.counted()
        self.assertIn("tet", self.stages)
        self.stages.clear()
        panel.axes.update()
        panel.form.parameters.setEnabled(True)
        self.settle()
        self.assertIn("label", "".join(self.stages) or "label")
        self.assertNotIn("tet", self.stages, "each click makes them anew")
        panel.axes.preview.setChecked(False)
        self.apply(panel)
        self.assertAlmostEqual(told / panel.obj.Hexahedra, 1, delta=0.15)
        self.press("Ok")

    def test_after_a_session_that_was_ended_by_force(self):
        """As where labels are cancelled while the CAD kernel reads the part: the next ones have a process of their own, and the panel closes."""
        panel = self.panel
        for again in (True, False):
            panel.axes.preview.setChecked(True)
            session = panel._session
            session._kill()
            self.assertTrue(wait_until(session.has_ended, 10))
            self.settle()
            panel.axes.preview.setChecked(False)
            if again:
                panel.axes.preview.setChecked(True)
                self.settle()
                self.assertIsNotNone(panel.axes.shown, panel.form.status.text())
                self.assertIsNot(panel._session, session)
                panel.axes.preview.setChecked(False)
                panel._session.close()
        with mock.patch.object(FreeCAD.Console, "PrintError", create=True) as error:
            self.press("Cancel")
        self.assertEqual(error.call_args_list, [])
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def test_a_part_that_changes(self):
        panel = self.panel
        panel.hint.begin()
        before = self.counted()
        pid = panel._session.processId()
        self.plate.Shape = Part.makeBox(60, 40, 30)
        panel.changed()
        self.assertNotEqual(self.counted(), before)
        self.assertNotEqual(panel._session.processId(), pid)
        self.press("Cancel")


class Refusal(AidsTest):
    def refuse(self, stage):
        self.panel._fail(StageFailed("12 cells stay inverted", stage, ["Face3"]))
        process_events(0.1)
        return {button.text(): button for button in self.panel.form.run.tries.findChildren(QtGui.QPushButton)}

    def test_where_and_what_to_try(self):
        """The faces are selected and looked at; each way sets its option and meshes again."""
        panel = self.panel
        camera = FreeCADGui.activeDocument().activeView().getCameraNode()
        before = camera.height.getValue() if hasattr(camera, "height") else None
        self.panel.look_at(["Edge1"])
        near = camera.height.getValue() if before else None
        ways = self.refuse("fit")
        picture("refusal")
        (selected,) = FreeCADGui.Selection.getSelectionEx()
        self.assertEqual((selected.Object, selected.SubElementNames), (self.plate, ("Face3",)))
        if before:
            self.assertLess(near, 0.7 * before, "an edge fills the view")
            self.assertNotEqual(camera.height.getValue(), before)
        self.assertRegex(panel.form.status.text(), r"^Refused: Moving nodes onto the CAD: 12 cells stay inverted \(Face3\)\. Try a finer size")
        self.assertEqual(list(ways), ["A finer size", "More effort", "Smooth edges given up"])
        for text, name, value in (("More effort", "effort", "thorough"), ("Smooth edges given up", "feature_angle", 15.0), ("A finer size", "size", 1.8)):
            mouse(self.refuse("fit")[text], QtCore.QPoint(5, 5))
            self.assertEqual(panel.field(name).value, value if name != "size" else panel.field("size").value)
            self.assertIsNotNone(panel.process)
            self.assertFalse(panel.form.run.tries.isVisible())
            self.press("Cancel")
            self.settle()
        self.assertGreater(panel.field("size").value, 0)
        self.assertEqual(list(self.refuse("fit")), ["A finer size"], "what is set already is not offered")
        self.assertEqual(list(self.refuse("quantize")), [])
        mouse(self.refuse("label")["Other axes of faces"], QtCore.QPoint(5, 5))
        self.assertTrue(panel.axes.preview.isChecked())
        self.settle()
        self.press("Cancel")


class ToSee(AidsTest):
    def test_blocks_and_polycube(self):
        panel = self.panel
        scene = FreeCADGui.activeDocument().activeView().getSceneGraph()
        before = scene.getNumChildren()
        panel.axes.beside.setChecked(True)
        self.settle()
        self.assertTrue(panel.axes.preview.isChecked())
        labels = panel.axes.shown
        places = beside(labels)
        self.assertGreater(places[:, 0].min(), labels.points[:, 0].max(), "beside the part")
        flat = []
        for chart in range(labels.chart.max() + 1):
            own = labels.chart == chart
            along = places[labels.triangles[own]][:, :, int(labels.label[own][0]) // 2]
            flat.append(along.max() - along.min())
        self.assertLess(max(flat), 1e-6, "each chart is on a plane")
        self.assertEqual(scene.getNumChildren(), before + 1)
        picture("polycube-beside")
        panel.axes.preview.setChecked(False)
        self.assertFalse(panel.axes.beside.isChecked())
        self.apply(panel)
        before = scene.getNumChildren()  # with the mesh
        blocks = of_runs(panel.obj.Blocks)
        self.assertEqual(len(blocks), panel.obj.Hexahedra)
        self.assertGreater(len(set(blocks)), 3)
        panel.result.blocks.setChecked(True)
        picture("blocks")
        self.assertEqual(scene.getNumChildren(), before + 1)
        panel.result.cut.setCurrentIndex(3)
        panel.result.blocks.setChecked(False)
        panel.result.cut.setCurrentIndex(0)
        self.assertEqual(scene.getNumChildren(), before)
        panel.result.colours.setChecked(True)
        self.assertFalse(panel.result.blocks.isChecked(), "one of them is seen")
        self.assertEqual(scene.getNumChildren(), before)
        panel.result.blocks.setChecked(True)
        self.assertFalse(panel.result.colours.isChecked())
        self.look_at_cells(scene, before)
        self.press("Ok")
        self.assertEqual(scene.getNumChildren(), before)

    def look_at_cells(self, scene, before):
        """A cell of the list from near, by itself; CAD edges that have no mesh edges, in red."""
        result = self.panel.result
        result.blocks.setChecked(False)
        camera = FreeCADGui.activeDocument().activeView().getCameraNode()
        whole = camera.height.getValue() if hasattr(camera, "height") else None
        result.worst.itemDoubleClicked.emit(result.worst.item(0, 0))
        self.assertEqual(scene.getNumChildren(), before + 1)
        if whole:
            self.assertLess(camera.height.getValue(), 0.5 * whole)
        result.cut.setCurrentIndex(1)
        result.cut.setCurrentIndex(0)
        self.assertEqual(scene.getNumChildren(), before)
        result._report["cad"]["edges"]["lost"] = ["Edge1", "Edge5"]
        result.lost.setChecked(True)
        self.assertEqual(scene.getNumChildren(), before + 1)
        search = coin.SoSearchAction()
        search.setType(coin.SoBaseColor.getClassTypeId())
        search.apply(scene.getChild(before))
        self.assertEqual(tuple(round(channel, 2) for channel in search.getPath().getTail().rgb[0].getValue()), (0.86, 0.08, 0.12))
        picture("lost-edges")
        result.lost.setChecked(False)
        self.assertEqual(scene.getNumChildren(), before)

    def test_beside_the_clip_plane_of_freecad(self):
        """FreeCAD's own clip plane and the panel's cut, cells and colours leave each other alone."""
        panel, view = self.panel, FreeCADGui.activeDocument().activeView()
        self.apply(panel)
        plain = view.getSceneGraph().getNumChildren()
        view.toggleClippingPlane()
        clipped = view.getSceneGraph().getNumChildren()
        self.assertTrue(view.hasClippingPlane())
        panel.result.colours.setChecked(True)
        panel.result.cut.setCurrentIndex(1)
        picture("clip-plane")
        view.toggleClippingPlane()
        self.assertFalse(view.hasClippingPlane())
        view.toggleClippingPlane()
        self.press("Ok")
        self.assertTrue(view.hasClippingPlane())
        self.assertEqual(view.getSceneGraph().getNumChildren(), clipped)
        view.toggleClippingPlane()
        self.assertEqual(view.getSceneGraph().getNumChildren(), plain)

    def test_axes_and_cells_do_not_stand_in_one_place(self):
        panel = self.panel
        self.apply(panel)
        panel.result.cut.setCurrentIndex(1)
        self.assertIsNotNone(panel.result._cell_overlay)
        panel.axes.preview.setChecked(True)
        self.assertIsNone(panel.result._cell_overlay)
        self.assertEqual(panel.result.cut.currentIndex(), 0)
        self.settle()
        panel.result.blocks.setChecked(True)
        self.assertFalse(panel.axes.preview.isChecked())
        self.assertIsNone(panel.axes.overlay)
        self.assertIsNotNone(panel.result._cell_overlay)
        self.press("Ok")

    def test_numbers_as_text(self):
        for numbers in ([], [3], [3, 3, 7, 3], list(range(20)) + [5] * 1000):
            self.assertEqual(of_runs(as_runs(numbers)), numbers)
        self.assertEqual(as_runs([3, 3, 7]), "3x2,7x1")
        colours = block_colours([4, 4, 9] + list(range(10, 40)))
        self.assertEqual(colours[0].tolist(), colours[1].tolist())
        self.assertEqual(len({tuple(colour) for colour in colours.tolist()}), 32)


class Time(gui_panel.PanelTest):
    def test_what_is_typical(self):
        group = FreeCAD.ParamGet(preferences.GROUP)
        before = group.GetFloat("SecondsPerFace", 0.0)
        self.addCleanup(lambda: group.SetFloat("SecondsPerFace", before) if before else group.RemFloat("SecondsPerFace"))
        group.RemFloat("SecondsPerFace")
        self.assertIsNone(typical.seconds(None, self.box.Shape))
        typical.learn(self.box.Shape, 12.0)
        self.assertAlmostEqual(typical.seconds(None, self.box.Shape), 12.0, delta=1e-3)
        typical.learn(self.box.Shape, 24.0)
        self.assertAlmostEqual(typical.seconds(None, self.box.Shape), 15.0, delta=1e-3)
        run = RunSection()
        run.begin("Meshing", 15.0)
        run.show_time(3.21)
        self.assertEqual(run.time.text(), "3.2 s of about 15 s")
        run.show_time(3.21, ended=True)
        self.assertEqual(run.time.text(), "3.2 s")
        run.begin("Meshing")
        run.show_time(1)
        self.assertEqual(run.time.text(), "1.0 s")


class Guide(gui_panel.PanelTest):
    def test_a_page_inside_freecad(self):
        FreeCADGui.runCommand(commands.Help.Name)
        process_events(0.3)
        (page,) = [widget for widget in QtGui.QApplication.topLevelWidgets() if isinstance(widget, help_page.HelpPage)]
        self.assertTrue(page.isVisible())
        text = page.toPlainText()
        for words in ("A first mesh", "Where a part is refused", "Which element", "Limits"):
            self.assertIn(words, text)
        seen = [page.loadResource(QtGui.QTextDocument.ImageResource, QtCore.QUrl(name)) for name in re.findall(r"!\[[^]]*\]\(([^)]*)\)", open(help_page.GUIDE, encoding="utf-8").read())]
        self.assertGreaterEqual(len(seen), 5)
        for image in seen:
            self.assertGreater(image.width(), 100)
            self.assertLess(image.width(), page.width())
        picture("guide")
        page.close()
