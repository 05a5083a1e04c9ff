"""All-hexahedral FEM meshes of CAD solids.

    from freecad import polycube
    result = polycube.mesh(shape_or_object, size=5, order=2)      # arrays and report, no document needed
    with polycube.prepare(shape_or_object) as session:            # several meshes, one map
        coarse, fine = session.mesh(size=8), session.mesh(size=4)
    obj = polycube.create_fem_mesh(part_object, size=5)           # a FEM mesh object in the part's document
    solution = polycube.solve(analysis)                           # CalculiX, results in the analysis
    series = polycube.converge(analysis)                          # finer and finer, and the limit of a result
    labels = polycube.labels(shape_or_object)                     # the polycube's axis of every piece of the boundary

Works in FreeCAD and freecadcmd; nothing here needs a window. The work itself runs in a child process.
FreeCAD imports this package at start, so it imports nothing heavy.
"""

import os
import re

from .api import compound_of, converge, create_fem_mesh, labels, mesh, options, prepare, refine, set_analysis, set_options, set_refinement, solve, update_fem_mesh
from .errors import Cancelled, InvalidInput, NoMesher, PolycubeError, SolverFailed, StageFailed

__all__ = [
    "Cancelled",
    "InvalidInput",
    "NoMesher",
    "PolycubeError",
    "SolverFailed",
    "StageFailed",
    "compound_of",
    "converge",
    "create_fem_mesh",
    "labels",
    "mesh",
    "options",
    "prepare",
    "refine",
    "set_analysis",
    "set_options",
    "set_refinement",
    "solve",
    "update_fem_mesh",
]


def __getattr__(name):
    """The version, from the package's description, the one place where it is written."""
    if name != "__version__":
        raise AttributeError(name)
    with open(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "package.xml"), encoding="utf-8") as file:
        return re.search("<version>(.*)</version>", file.read()).group(1)
