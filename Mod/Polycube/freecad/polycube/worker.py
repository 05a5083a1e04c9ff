"""The child process where the mesher is the compiled module: `python3 worker.py FOLDER mesh|labels`, without FreeCAD. backend/job/README.md has the protocol.

`worker.py --version` prints the module's version. The module is looked for on the module path, then beside this file.
"""

import os
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:] = [path for path in sys.path if os.path.realpath(path) != HERE] + [HERE]  # last, so that what stands here hides no other module

import _polycube

if __name__ == "__main__":
    if sys.argv[1:] == ["--version"]:
        print(_polycube.__version__)
    else:
        sys.exit(_polycube.serve_job(*sys.argv[1:]))
