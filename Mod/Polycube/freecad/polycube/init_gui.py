"""FreeCAD's window loads this: the workbench, and the mesher's command in the FEM workbench's mesh menu."""

import FreeCADGui

from . import commands, resources
from .preferences_page import PreferencesPage
from .words import tr

#: What an analysis needs beside the mesh; of the names that a command has had, the first is taken that FreeCAD knows.
_FEM_COMMANDS = [
    ("FEM_Analysis",),
    ("FEM_MaterialSolid",),
    ("FEM_ConstraintFixed",),
    ("FEM_ConstraintForce",),
    ("FEM_ConstraintPressure",),
    ("FEM_SolverCalculixCxxtools", "FEM_SolverCalculiXCcxTools", "FEM_SolverCalculiX"),
]


class PolycubeWorkbench(FreeCADGui.Workbench):
    """Hexahedral meshes; the rest of an analysis is the FEM workbench's."""

    MenuText = "Polycube"
    ToolTip = tr("All-hexahedral FEM meshes of CAD solids")
    Icon = resources.icon("Polycube_Workbench")

    def Initialize(self):
        import FemGui  # registers the commands of FEM that are written in C++
        import femcommands.commands  # and those written in Python

        del FemGui, femcommands
        known = FreeCADGui.listCommands()
        fem = [next((name for name in names if name in known), None) for names in _FEM_COMMANDS]
        ours = [commands.MeshFromShape.Name, commands.Solve.Name, commands.ShowErrors.Name, commands.Help.Name]
        names = [ours[0], "Separator", *filter(None, fem), "Separator", *ours[1:3], "Separator", ours[3]]
        self.appendToolbar("Polycube", names)
        self.appendMenu("&Polycube", names)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


class _FemMenu:
    """Adds the command to the FEM workbench."""

    def modifyMenuBar(self):
        """For FreeCAD 1.x, whose workbenches take additions."""
        return [{"append": commands.MeshFromShape.Name, "menuItem": "FEM_MeshGmshFromShape"}]

    @staticmethod
    def activated(workbench):
        """For FreeCAD 0.20, which makes the menus anew whenever a workbench is activated."""
        from PySide import QtGui

        if workbench != "FemWorkbench":
            return
        window = FreeCADGui.getMainWindow()
        for entry in window.menuBar().actions():
            menu = entry.menu()
            if menu and menu.objectName() == "M&esh":
                menu.addAction(_action(menu))


def _action(menu):
    """The command in a menu that FreeCAD does not fill; as FreeCAD's own entries it can be chosen where the command can do something."""
    from PySide import QtGui

    command = commands.MeshFromShape
    told = command().GetResources()
    action = QtGui.QAction(QtGui.QIcon(resources.icon(command.Name)), told["MenuText"], menu)
    action.setObjectName(command.Name)
    action.setToolTip(told["ToolTip"])
    action.setStatusTip(told["ToolTip"])
    action.triggered.connect(lambda *_: FreeCADGui.runCommand(command.Name))
    menu.aboutToShow.connect(lambda: action.setEnabled(command().IsActive()))
    return action


commands.register()
FreeCADGui.addWorkbench(PolycubeWorkbench())
FreeCADGui.addIcon("preferences-polycube", resources.icon("Polycube_Workbench"))
FreeCADGui.addPreferencePage(PreferencesPage, "Polycube")
if hasattr(FreeCADGui, "addWorkbenchManipulator"):
    FreeCADGui.addWorkbenchManipulator(_FemMenu())
else:
    FreeCADGui.getMainWindow().workbenchActivated.connect(_FemMenu.activated)
