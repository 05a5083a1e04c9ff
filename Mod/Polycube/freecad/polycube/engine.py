"""Finds the compiled module and the Python that runs it in a child process.

Runs inside FreeCAD and in plain Python: the worker imports this file by its path, so it uses the standard library only.
"""

import importlib
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def load():
    """The compiled module `_polycube`: on the module path, or beside this file. ImportError says what to do."""
    try:
        return importlib.import_module("_polycube")
    except ModuleNotFoundError as missing:
        if missing.name != "_polycube":
            raise
    sys.path.append(HERE)
    try:
        return importlib.import_module("_polycube")
    except ModuleNotFoundError as missing:
        if missing.name != "_polycube":
            raise
        raise ImportError("Polycube's compiled module is not installed; build it with: sh resources/polycube --help") from None
    finally:
        sys.path.remove(HERE)


def environment(folder):
    """Environment for the child process: the compiled module's folder on PYTHONPATH, temporary files in the job's `folder`, which goes with it."""
    env = dict(os.environ, TMPDIR=folder, TEMP=folder, TMP=folder)
    env.pop("PYTHONHOME", None)
    module = os.path.dirname(os.path.realpath(load().__file__))
    env["PYTHONPATH"] = os.pathsep.join([module] + [path for path in [env.get("PYTHONPATH")] if path])
    return env


def python():
    """The plain interpreter of the Python that runs this code: inside FreeCAD sys.executable is FreeCAD itself."""
    name = "python{}.{}".format(*sys.version_info[:2])
    candidates = [os.path.join(sys.base_exec_prefix, "bin", name), os.path.join(sys.base_exec_prefix, "bin", "python3")]
    if os.name == "nt":
        candidates = [os.path.join(sys.base_exec_prefix, "python.exe"), os.path.join(sys.base_exec_prefix, "bin", "python.exe")]
    for candidate in candidates:
        if os.access(candidate, os.X_OK):
            return candidate
    return sys.executable
