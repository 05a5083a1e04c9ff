"""Makes commands known to FreeCAD.

A macro that is recorded imports the file that has done so by its bare name, before its first line; without one that can be imported so it would not replay.
This folder is on Python's path, as that of every workbench.
"""


def register(commands):
    """Adds those that FreeCAD does not know yet: classes of commands with a Name."""
    import FreeCADGui

    known = FreeCADGui.listCommands()
    for command in commands:
        if command.Name not in known:
            FreeCADGui.addCommand(command.Name, command())
