"""FreeCAD's window loads this: the workbench, and the mesher's command in the FEM workbench's mesh menu."""

import FreeCADGui

from . import commands, resources


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
    ToolTip = "All-hexahedral FEM meshes of CAD solids"
    Icon = resources.icon("Polycube_Workbench")

    def Initialize(self):
        import FemGui  # registers the commands of FEM that are written in C++
        import femcommands.commands  # and those written in Python

        del FemGui, femcommands
        known = FreeCADGui.listCommands()
        fem = [next((name for name in names if name in known), None) for names in _FEM_COMMANDS]
        names = [commands.MeshFromShape.Name, "Separator", *filter(None, fem), "Separator", commands.Solve.Name]
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
                command = commands.MeshFromShape
                action = QtGui.QAction(QtGui.QIcon(resources.icon(command.Name)), command().GetResources()["MenuText"], menu)
                action.setObjectName(command.Name)
                action.triggered.connect(lambda *_: FreeCADGui.runCommand(command.Name))
                menu.addAction(action)


commands.register()
FreeCADGui.addWorkbench(PolycubeWorkbench())
FreeCADGui.addIcon("preferences-polycube", resources.icon("Polycube_Workbench"))
FreeCADGui.addPreferencePage(resources.path("ui", "Preferences.ui"), "Polycube")
if hasattr(FreeCADGui, "addWorkbenchManipulator"):
    FreeCADGui.addWorkbenchManipulator(_FemMenu())
else:
    FreeCADGui.getMainWindow().workbenchActivated.connect(_FemMenu.activated)
