"""The workbench in a FreeCAD in which the FEM workbench was not opened before; run by gui.sh, which gives each module a FreeCAD of its own."""

import sys

import FreeCADGui
from gui_support import GuiTest, process_events
from PySide import QtGui

BEFORE = set(FreeCADGui.listCommands())


class First(GuiTest):
    """An analysis from our own toolbar: the block gets all that CalculiX needs but the mesh."""

    def setUp(self):
        # Whatever loads FEM's commands before makes the test void; so it is the only one of its module.
        self.assertNotIn("FEM_Analysis", BEFORE)
        self.assertNotIn("femcommands.commands", sys.modules)
        super().setUp()

    def actions(self):
        """The workbench's actions by command, from its toolbar and from its menu."""
        window = FreeCADGui.getMainWindow()
        places = [bar for bar in window.findChildren(QtGui.QToolBar) if bar.objectName() == "Polycube"]
        places += [menu for menu in window.menuBar().findChildren(QtGui.QMenu) if menu.title().replace("&", "") == "Polycube"]
        self.assertEqual(len(places), 2)
        return [[action for action in place.actions() if not action.isSeparator()] for place in places]

    def test_an_analysis_is_made_with_our_toolbar_alone(self):
        toolbar, menu = self.actions()
        self.assertEqual([action.text() for action in toolbar], [action.text() for action in menu])
        self.assertEqual(len(toolbar), 10, [action.text() for action in toolbar])
        _, analysis, *others, solve, errors, guide = toolbar
        process_events()
        self.assertFalse(solve.isEnabled())
        self.assertFalse(errors.isEnabled(), "it needs results")
        self.assertFalse(any(action.isEnabled() for action in others), "they need an analysis")
        self.assertTrue(analysis.isEnabled())
        self.assertTrue(guide.isEnabled())
        analysis.trigger()
        process_events(0.5)
        self.assertTrue(any(obj.isDerivedFrom("Fem::FemAnalysis") for obj in self.document.Objects))
        self.assertTrue(all(action.isEnabled() for action in others), [action.text() for action in others if not action.isEnabled()])
        self.assertTrue(solve.isEnabled())
        for action in others:
            before = len(self.document.Objects)
            action.trigger()
            process_events(0.5)
            self.assertGreater(len(self.document.Objects), before, action.text())
            FreeCADGui.Control.closeDialog()
            FreeCADGui.activeDocument().resetEdit()
            process_events()
        kinds = {obj.TypeId for obj in self.document.Objects}
        for kind in ("Fem::ConstraintFixed", "Fem::ConstraintForce", "Fem::ConstraintPressure", "Fem::FemSolverObjectPython"):
            self.assertIn(kind, kinds)
        self.assertTrue(any(kind.startswith("App::MaterialObject") for kind in kinds), kinds)
