"""As a new user goes about it: a part that no other test has, from its STEP file to CalculiX' stresses, by mouse and keys alone; run by gui.sh."""

import math
import os
import tempfile

import FemGui
import FreeCAD
import FreeCADGui
import gui_keys
import ImportGui
import Part
from FreeCAD import Vector
from gui_support import mouse, picture, process_events, set_panel_width, wait_until
from PySide import QtCore, QtGui

from freecad.polycube import ccx, objects


def rocker():
    """Two bosses of different heights, a tapered arm between them with sides that touch both, bores, a keyway."""
    length, large, small = 90.0, 20.0, 14.0
    turn = math.acos((large - small) / length)

    def touching(x, radius, side):
        return Vector(x + radius * math.cos(turn), side * radius * math.sin(turn), 0)

    corners = [touching(0, large, 1), touching(length, small, 1), touching(length, small, -1), touching(0, large, -1)]
    ends = [Part.Arc(corners[1], Vector(length + small, 0, 0), corners[2]), Part.Arc(corners[3], Vector(-large, 0, 0), corners[0])]
    outline = [Part.makeLine(*corners[:2]), ends[0].toShape(), Part.makeLine(*corners[2:]), ends[1].toShape()]
    arm = Part.Face(Part.Wire(outline)).extrude(Vector(0, 0, 12))
    arm.translate(Vector(0, 0, 6))
    whole = arm.fuse([Part.makeCylinder(large, 32), Part.makeCylinder(small, 24, Vector(length, 0, 0))]).removeSplitter()
    holes = [Part.makeCylinder(10, 40, Vector(0, 0, -2)), Part.makeBox(6, 13, 40, Vector(-3, 0, -2)), Part.makeCylinder(6, 40, Vector(length, 0, -2))]
    return whole.cut(holes).removeSplitter().Solids[0]


class User(gui_keys.KeysTest):
    def setUp(self):
        super().setUp()
        self.document.removeObject(self.box.Name)
        folder = self.enterContext(tempfile.TemporaryDirectory())
        path = os.path.join(folder, "rocker.step")
        rocker().exportStep(path)
        ImportGui.insert(path, self.name)
        self.document.recompute()
        (self.part,) = self.document.Objects
        set_panel_width(280).show()
        FreeCADGui.activeDocument().activeView().viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        process_events(0.5)

    def toolbar(self, number):
        """A click on a button of our toolbar, where FreeCAD leaves room for it, else on its entry in our menu."""
        bar = next(bar for bar in FreeCADGui.getMainWindow().findChildren(QtGui.QToolBar) if bar.objectName() == "Polycube")
        action = [action for action in bar.actions() if not action.isSeparator()][number]
        self.assertTrue(wait_until(action.isEnabled, 10), action.text())
        button = bar.widgetForAction(action)
        if button.isVisible():
            mouse(button, button.rect().center())
        else:
            action.trigger()
        process_events(0.5)

    def in_tree(self, label, double=False):
        window = FreeCADGui.getMainWindow()
        for tabs in window.findChildren(QtGui.QTabBar):
            if tabs.isVisible() and tabs.count() and tabs.tabText(0) == "Model":
                mouse(tabs, tabs.tabRect(0).center())
                process_events(0.2)
        tree = next(tree for tree in window.findChildren(QtGui.QTreeWidget) if tree.isVisible() and tree.findItems(label, QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive))
        (item,) = tree.findItems(label, QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive)
        tree.scrollToItem(item)
        process_events(0.2)
        mouse(tree.viewport(), tree.visualItemRect(item).center(), double)
        process_events(0.3)

    def in_view(self, point):
        """A click in the 3D view at a point of the part."""
        window, view = FreeCADGui.getMainWindow(), FreeCADGui.activeDocument().activeView()
        port = next(one for one in window.findChildren(QtGui.QGraphicsView) if one.isVisible()).viewport()
        x, y = view.getPointOnScreen(point)
        at = QtCore.QPointF(x, port.height() - y)
        there = QtCore.QPointF(port.mapToGlobal(at.toPoint()))
        left, none = QtCore.Qt.LeftButton, QtCore.Qt.NoButton
        for kind, button, held in (
            (QtCore.QEvent.MouseMove, none, none),
            (QtCore.QEvent.MouseMove, none, none),
            (QtCore.QEvent.MouseButtonPress, left, left),
            (QtCore.QEvent.MouseButtonRelease, left, none),
        ):
            QtGui.QApplication.sendEvent(port, QtGui.QMouseEvent(kind, at, there, button, held, QtCore.Qt.NoModifier))
            process_events(0.2)

    def named(self, kind, name):
        return next(widget for widget in FreeCADGui.getMainWindow().findChildren(kind) if widget.objectName() == name and widget.isVisible())

    def add(self, point):
        """The button "Add" of a constraint's panel, and a face."""
        button = self.named(QtGui.QAbstractButton, "btnAdd")
        mouse(button, button.rect().center())
        process_events(0.2)
        self.in_view(point)

    def of_type(self, kind):
        return next(obj for obj in self.document.Objects if obj.isDerivedFrom(kind))

    def test_from_a_step_file_to_stresses(self):
        if not ccx.find():
            self.skipTest(ccx.MISSING)
        self.addCleanup(FemGui.setActiveAnalysis)
        self.toolbar(1)
        analysis = self.of_type("Fem::FemAnalysis")
        if not any(member.isDerivedFrom("Fem::FemSolverObject") for member in analysis.Group):
            self.toolbar(6)  # which FreeCAD 1.x leaves to the user, 0.20 does not
        self.in_tree(self.part.Label)
        panel = self.caught(lambda: self.toolbar(0))
        self.assertIs(panel.analysis_box.chosen(), analysis)
        self.focus(panel, "order")
        gui_keys.press(QtCore.Qt.Key_Up)
        self.assertEqual(panel.field("order").value, 1, "which takes CalculiX less time")
        self.press("Apply")
        self.assertTrue(wait_until(lambda: not panel.process and not panel._taking))
        self.assertTrue(self.is_in_sight(panel.form.status))
        self.assertRegex(panel.form.status.text(), "^Meshed: ")
        picture("user-meshed")
        self.press("Ok")
        self.assertIn(panel.obj, analysis.Group)
        self.material()
        self.in_tree(self.part.Label)
        FreeCADGui.runCommand("Std_ToggleVisibility")  # the space bar
        process_events(0.3)
        self.toolbar(3)
        self.add(Vector(-15, -4, 32))
        self.press("Ok")
        self.toolbar(4)
        self.add(Vector(90, -10, 24))
        force = self.named(QtGui.QAbstractSpinBox, "spinForce")
        force.setFocus()
        force.selectAll()
        for letter in "1000":
            gui_keys.press(0, letter)
        gui_keys.press(QtCore.Qt.Key_Tab)
        picture("user-force")
        self.press("Ok")
        for kind, z in (("Fem::ConstraintFixed", 32), ("Fem::ConstraintForce", 24)):
            ((owner, (face,)),) = self.of_type(kind).References
            self.assertAlmostEqual(owner.Shape.getElement(face).CenterOfMass.z, z, 6, kind)
        self.solved(panel.obj)

    def material(self):
        """Steel of the cards that FreeCAD has."""
        self.toolbar(2)
        card = "Steel-Generic"
        visible = [widget for widget in FreeCADGui.getMainWindow().findChildren(QtGui.QWidget) if widget.isVisible()]
        for box in (widget for widget in visible if isinstance(widget, QtGui.QComboBox) and widget.findText(card) >= 0):
            box.setCurrentIndex(box.findText(card))
            box.activated.emit(box.currentIndex())
        # FreeCAD 1.x has a folded tree of them, and starts with the one that was chosen last.
        for tree in (tree for widget in visible if widget.objectName() == "wgt_material_tree" for tree in widget.findChildren(QtGui.QTreeView)):
            model = tree.model()
            found = model.match(model.index(0, 0), QtCore.Qt.DisplayRole, card, -1, QtCore.Qt.MatchStartsWith | QtCore.Qt.MatchRecursive)
            tree.selectionModel().setCurrentIndex(found[-1], QtCore.QItemSelectionModel.ClearAndSelect)  # in favourites besides
        process_events(0.3)
        self.press("Ok")
        self.assertEqual(FreeCAD.Units.Quantity(self.of_type("App::MaterialObject").Material["YoungsModulus"]).getValueAs("MPa").Value, 200000)

    def solved(self, mesh):
        """No question, no warning; the picture is that of the stresses alone, and the mesh is the one that was made."""
        asked = []

        def look():
            box = QtGui.QApplication.activeModalWidget()
            if isinstance(box, QtGui.QMessageBox):
                asked.append(box.text())
                box.reject()

        timer = QtCore.QTimer()
        timer.timeout.connect(look)
        timer.start(100)
        self.toolbar(7)
        timer.stop()
        picture("user-stresses")
        self.assertEqual(asked, [])
        result = self.of_type("Fem::FemResultObject")
        self.assertEqual([result.Mesh.ViewObject.isVisible(), mesh.ViewObject.isVisible(), self.part.ViewObject.isVisible()], [True, False, False])
        self.assertEqual(mesh.MeshState, objects.CURRENT)
        # 1000 N bend the arm, 12 mm high and some 38 mm wide where it leaves the large boss, 70 mm away: 77 MPa by beam theory, more in the corner.
        self.assertTrue(70 < max(result.vonMises) < 230, max(result.vonMises))
