"""Mesh and labels as arrays, as they come out of the child process."""

import itertools
import json
import os
from dataclasses import dataclass, field


@dataclass(repr=False)
class MeshResult:
    """A hexahedral mesh. Indices are 0-based, lengths mm, corners and mid-edge nodes in VTK's (= Abaqus') order."""

    nodes: object  #: (n, 3) float64: corners first, then mid-edge nodes
    hexes: object  #: (m, 8 or 20) int32
    hex_block: object  #: (m,) int32, block of the polycuboid that the cell is part of; of the coarsest mesh the cell itself
    hex_solid: object  #: (m,) int32, number of each cell's solid: 1 is Solid1
    quads: object  #: (q, 4 or 8) int32, all boundary faces, outward
    quad_face: object  #: (q,) int32, CAD face of each quad: 3 is Face3
    quad_hex: object  #: (q, 2) int32, cell of each quad and the cell's face, 0 to 5 as Abaqus' S1 to S6
    segments: object  #: (s, 2 or 3) int32, mesh edges on CAD edges, the mid node last
    segment_edge: object  #: (s,) int32, CAD edge of each segment
    scaled_jacobian: object  #: (m,) float64: 1 for a cube
    edge_ratio: object  #: (m,) float64, longest over shortest edge: 1 for a cube
    skew: object  #: (m,) float64, Verdict's: 0 for right angles, at most 1
    warpage: object  #: (m,) float64, Verdict's, of the most warped side: 0 for plane sides, at most 2
    groups: dict = field(default_factory=dict)  #: "Face3" -> {"nodes": (k,) int32, "quads": (j,) int32}, likewise Edge, Vertex, Solid; of several solids Solid1_Solid2 too
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


@dataclass(repr=False)
class LabelResult:
    """Which of six axis directions each piece of the boundary takes in the polycube. Indices are 0-based."""

    points: object  #: (n, 3) float64, mm
    triangles: object  #: (t, 3) int32, the boundary
    triangle_face: object  #: (t,) int32, CAD face: 3 is Face3
    label: object  #: (t,) int32: 0 to 5 are +X -X +Y -Y +Z -Z of the frame
    chart: object  #: (t,) int32: connected triangles of one label have one number
    frame: object  #: (3, 3) float64, rows are the axes
    corners: object  #: points where three or more charts meet
    turning_points: object  #: points where the border of a chart reverses
    valid: bool  #: whether the labels are those of a polycube, by the published rules
    face_label: dict  #: {3: 0}: the label that covers most of Face3
    edges: dict  #: {5: ("lost", "the map folds there")}: "boundary" of a chart, "feature" inside one, or "lost", with the reason
    image: object = None  #: (n, 3) float64, the place of every point in the polycube; None of labels alone

    def possible(self, face):
        """Labels that the whole of CAD face number `face` can have: some of it faces that way and nothing of it the other way."""
        import numpy

        a, b, c = (self.points[self.triangles[self.triangle_face == face, k]] for k in range(3))
        normals = numpy.cross(b - a, c - a) @ self.frame.T
        normals /= numpy.linalg.norm(normals, axis=1, keepdims=True)
        cosines = numpy.stack([normals, -normals], axis=2).reshape(-1, 6)
        # the engine's rule: within 85 degrees somewhere, beyond 100 nowhere
        return [label for label in range(6) if cosines[:, label].max() > 0.087 and cosines[:, label].min() > -0.174]

    def __repr__(self):
        return "<LabelResult: {} charts, {}, {} turning points>".format(
            self.chart.max() + 1, "valid" if self.valid else "not valid", len(self.turning_points)
        )


def as_runs(numbers):
    """Numbers as text, "3x5,7x2" for five times 3 and twice 7: those of neighbours are most often equal."""
    return ",".join("{}x{}".format(number, len(list(equal))) for number, equal in itertools.groupby(numbers))


def of_runs(text):
    """The numbers that as_runs() made text of."""
    found = []
    for run in filter(None, text.split(",")):
        number, length = map(int, run.split("x"))
        found += [number] * length
    return found


def load_labels(folder):
    """The LabelResult that the worker left in a job folder."""
    import numpy

    with open(os.path.join(folder, "labels.json"), encoding="utf-8") as file:
        plain = json.load(file)
    with numpy.load(os.path.join(folder, "labels.npz"), allow_pickle=False) as arrays:
        return LabelResult(
            valid=plain["valid"],
            face_label={int(face): label for face, label in plain["face_label"].items()},
            edges={int(edge): tuple(fate) for edge, fate in plain["edges"].items()},
            **{name: arrays[name] for name in arrays.files},
        )


def load_count(folder):
    """The number of hexahedra that the worker left in a folder."""
    with open(os.path.join(folder, "count.json"), encoding="utf-8") as file:
        return json.load(file)["hexes"]


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
