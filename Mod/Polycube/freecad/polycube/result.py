"""The mesh as arrays, as it comes out of the child process."""

import json
import os
from dataclasses import dataclass, field


@dataclass(repr=False)
class MeshResult:
    """A hexahedral mesh. Indices are 0-based, lengths mm, corners and mid-edge nodes in VTK's (= Abaqus') order."""

    nodes: object  #: (n, 3) float64: corners first, then mid-edge nodes
    hexes: object  #: (m, 8 or 20) int32
    quads: object  #: (q, 4 or 8) int32, all boundary faces, outward
    quad_face: object  #: (q,) int32, CAD face of each quad: 3 is Face3
    quad_hex: object  #: (q, 2) int32, cell of each quad and the cell's face, 0 to 5 as Abaqus' S1 to S6
    segments: object  #: (s, 2 or 3) int32, mesh edges on CAD edges, the mid node last
    segment_edge: object  #: (s,) int32, CAD edge of each segment
    scaled_jacobian: object  #: (m,) float64
    groups: dict = field(default_factory=dict)  #: "Face3" -> {"nodes": (k,) int32, "quads": (j,) int32}, likewise Edge, Vertex, Solid
    report: dict = field(default_factory=dict)  #: stages, seconds, counts, quality, worst cells, CAD capture, warnings, options, version

    @property
    def order(self):
        """1 or 2."""
        return 1 if self.hexes.shape[1] == 8 else 2

    def __repr__(self):
        quality = self.report["quality"]["min_scaled_jacobian"]
        return "<MeshResult: {} hexahedra of order {}, {} nodes, min scaled Jacobian {:.3f}>".format(
            len(self.hexes), self.order, len(self.nodes), quality
        )


def load(folder):
    """The MeshResult that the worker left in a job folder."""
    import numpy

    arrays, groups = {}, {}
    with numpy.load(os.path.join(folder, "result.npz"), allow_pickle=False) as file:
        for key in file.files:
            if key.startswith("group/"):
                _, name, what = key.split("/")
                groups.setdefault(name, {})[what] = file[key]
            else:
                arrays[key] = file[key]
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    return MeshResult(groups=groups, report=report, **arrays)
