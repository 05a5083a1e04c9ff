"""A FreeCAD from which the compiled module is hidden: a copy of the workbench without it, in a user's folder of its own."""

import os
import shutil

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ.get("build") or os.path.join(REPO, "build")
MODULE_FOLDER = os.path.join(BUILD, "python")


def environment(folder):
    """Makes the copy below `folder`, as an installation does; the environment that FreeCAD needs to take it. `polycube` is on its PATH."""
    mod = os.path.join(folder, "data", "FreeCAD", "Mod", "Polycube")
    package = os.path.join(mod, "freecad", "polycube")
    shutil.copytree(os.path.join(REPO, "Mod", "Polycube"), mod, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    for name in ("icons", "ui"):
        shutil.copytree(os.path.join(REPO, "resources", name), os.path.join(package, "resources", name))
    env = dict(os.environ, XDG_DATA_HOME=os.path.join(folder, "data"), XDG_CONFIG_HOME=os.path.join(folder, "config"), POLYCUBE_HIDDEN=folder)
    env["PATH"] = BUILD + os.pathsep + env["PATH"]
    env.pop("PYTHONPATH", None)
    return env


def check(test):
    """What makes the tests in such a FreeCAD mean something."""
    import importlib.util

    import freecad.polycube

    test.assertTrue(freecad.polycube.__file__.startswith(os.path.realpath(os.environ["POLYCUBE_HIDDEN"])), freecad.polycube.__file__)
    test.assertIsNone(importlib.util.find_spec("_polycube"))
    test.assertEqual([name for name in os.listdir(os.path.dirname(freecad.polycube.__file__)) if name.endswith(".so")], [])
