"""The mesher: what it offers, and which one is at hand. Nothing of it is imported into FreeCAD, whose Python and CAD kernel may be others than the mesher's.

It runs in a child process, by one protocol (backend/job/README.md), in one of two shapes: the program `polycube`, or a Python that has the compiled module.
"""

import importlib.machinery
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from functools import lru_cache

import FreeCAD

from .errors import NoMesher
from .words import tr

HERE = os.path.dirname(os.path.abspath(__file__))
_MODULE = "_polycube"
_WORKER = os.path.join(HERE, "worker.py")
_PROGRAM = "polycube"
#: Where the preference "Mesher" is kept.
PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Polycube"
# Seconds for a mesher to say its version, a guess: it takes a fifth of one, and a machine may be busy. What does not answer is no mesher.
_PATIENCE = 60


@lru_cache(maxsize=None)
def description():
    """What every mesher of this version offers: options, label_names, label_colours, smesh_hex20. From engine.json, which `polycube describe` writes."""
    with open(os.path.join(HERE, "engine.json"), encoding="utf-8") as file:
        return json.load(file)


@dataclass(frozen=True)
class Mesher:
    """One that was found."""

    command: tuple  #: what starts it on a job; the folder and the kind of job are to follow
    module_folder: str = ""  #: for PYTHONPATH, where the module is in a place that only this Python knows

    def environment(self, folder):
        """Environment for the child process: temporary files go into the job's folder, which goes with it."""
        return dict(_environment(self.module_folder), TMPDIR=folder, TEMP=folder, TMP=folder)


def find():
    """The Mesher to take: the module of this Python; what the preference names; the program on PATH. NoMesher says in one line what is missing."""
    where = FreeCAD.ParamGet(PREFERENCES).GetString("Mesher", ""), os.environ.get("PATH", ""), os.environ.get("PYTHONPATH", "")
    mesher = _find(*where)
    if not shutil.which(mesher.command[0]):  # it was removed meanwhile
        _find.cache_clear()
        mesher = _find(*where)
    return mesher


@lru_cache(maxsize=None)
def _find(preferred, _path, _python_path):
    """The search is repeated when what it depends on has changed. One that found nothing is not kept: the user will see to it."""
    found = _this_python() or (_named(preferred) if preferred else _program(_PROGRAM))
    if found:
        return found
    raise NoMesher(
        tr("no mesher is at hand: this Python has no module {}, and {}").format(
            _MODULE,
            tr("the preference Mesher names neither the program {} nor a Python that has the module: {}").format(_PROGRAM, preferred)
            if preferred
            else tr("there is no program {} on PATH; Edit > Preferences > Polycube names one").format(_PROGRAM),
        )
    )


def _this_python():
    folder = _module_folder()
    return _python(_interpreter(), folder) if folder else None


def _named(name):
    """The program, or a Python that has the module."""
    name = shutil.which(os.path.expanduser(name))
    return (_program(name) or _python(name, "")) if name else None


def _program(name):
    name = shutil.which(name)
    return _answering(Mesher((name, "serve-job"))) if name else None


def _python(interpreter, module_folder):
    return _answering(Mesher((interpreter, _WORKER), module_folder)) if interpreter else None


def _answering(mesher):
    """The mesher, if it starts and says its version."""
    try:
        run = subprocess.run(
            [*mesher.command, "--version"],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=_PATIENCE,
            env=_environment(mesher.module_folder),
        )
    except (OSError, subprocess.SubprocessError, UnicodeDecodeError):
        return None
    return mesher if run.returncode == 0 and re.fullmatch(r"\d+(\.\d+)+\s*", run.stdout) else None


def _module_folder():
    """Where this Python would take the module from, on its module path or beside this file; it is not loaded."""
    spec = importlib.util.find_spec(_MODULE) or importlib.machinery.PathFinder.find_spec(_MODULE, [HERE])
    return os.path.dirname(os.path.realpath(spec.origin)) if spec and spec.origin else ""


def _environment(module_folder):
    """Without `module_folder` the mesher is a stranger to this Python: what a bundle like an AppImage sets for its own libraries is not for it."""
    env = dict(os.environ)
    env.pop("PYTHONHOME", None)
    if module_folder:
        env["PYTHONPATH"] = os.pathsep.join([module_folder] + [path for path in [env.get("PYTHONPATH")] if path])
        return env
    bundle = os.path.realpath(sys.base_exec_prefix)
    if bundle not in ("/usr", "/usr/local"):
        for name in ("LD_LIBRARY_PATH", "PYTHONPATH"):
            kept = [path for path in env.get(name, "").split(os.pathsep) if path and not (os.path.realpath(path) + os.sep).startswith(bundle + os.sep)]
            env.pop(name, None)
            if kept:
                env[name] = os.pathsep.join(kept)
    return env


def _interpreter():
    """The plain interpreter of the Python that runs this code, or None: inside FreeCAD sys.executable is FreeCAD itself."""
    name = "python{}.{}".format(*sys.version_info[:2])
    candidates = [os.path.join(sys.base_exec_prefix, "bin", name), os.path.join(sys.base_exec_prefix, "bin", "python3")]
    if os.name == "nt":
        candidates = [os.path.join(sys.base_exec_prefix, "python.exe"), os.path.join(sys.base_exec_prefix, "bin", "python.exe")]
    if os.path.basename(sys.executable or "").lower().startswith("python"):
        candidates.append(sys.executable)
    return next((candidate for candidate in candidates if os.access(candidate, os.X_OK)), None)
