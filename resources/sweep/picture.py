"""Picture of a mesh on its part, or of a part without a mesh: picture.py PART RESULT.json MESH.vtu PICTURE.webp.

Two views from opposite corners. The mesh's boundary is coloured by the scaled Jacobian of its cells, from orange to red below BAD; cells inside that are bad are
dots, drawn over everything. CAD edges are black, those without mesh edges red. Where there is no mesh the CAD itself is drawn, with the faces and edges that the reason
names in red.
"""

import json
import re
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (after the choice of what draws)
from matplotlib.collections import PolyCollection  # noqa: E402

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"]
import FreeCAD  # noqa: E402, F401  (Part needs it)
import Part  # noqa: E402

from table import BAD  # noqa: E402

EYES = np.array([[1.0, -1.3, 0.9], [-1.0, 1.3, -0.9]])
PAPER, STEEL, RED, INK = (1, 1, 1), (0.72, 0.8, 0.88), (0.86, 0.08, 0.12), (0.08, 0.08, 0.08)


def read_mesh(path):
    """(points, corners of the hexes, their scaled Jacobians, corners of the boundary's quads, scaled Jacobians of their cells)"""
    import meshio

    mesh = meshio.read(path)
    found = [np.asarray(mesh.points)]
    for kind, corners in (("hexahedron", 8), ("quad", 4)):
        ((cells, quality),) = [(block.data[:, :corners], values) for block, values in zip(mesh.cells, mesh.cell_data["ScaledJacobian"]) if block.type.startswith(kind)]
        found += [cells, quality]
    return found


def quality_colours(values):
    """Those of steel at BAD and above, red at 0 and below."""
    share = np.clip(values / BAD, 0, 1)[:, None]
    colours = share * np.array([1, 0.75, 0.3]) + (1 - share) * np.array(RED)
    colours[values >= BAD] = STEEL
    return colours


class Scene:
    """Facets and lines with their colours, drawn from back to front."""

    def __init__(self, diagonal, outlines):
        self.facets, self.facet_colours, self.lines, self.line_colours, self.dots = [], [], [], [], []
        self.outlines = outlines  # of the facets
        self.diagonal = diagonal
        self.slack = 0.01 * diagonal  # lines lie on facets, so they are drawn as if they were nearer

    def draw(self, axes, eye):
        towards = eye / np.linalg.norm(eye)
        right = np.cross([0, 0, 1], towards)
        right /= np.linalg.norm(right)
        frame = np.array([right, np.cross(towards, right), towards])
        shapes, depths, fills, strokes, widths = [], [], [], [], []
        for points, colour in zip(self.facets, self.facet_colours):
            seen = points @ frame.T
            normal = sum(np.cross(seen[k] - seen[0], seen[k + 1] - seen[0]) for k in range(1, len(seen) - 1))
            size = np.linalg.norm(normal)
            if size == 0 or normal[2] < -0.02 * size:
                continue
            fill = np.array(colour) * (0.6 + 0.4 * max(normal[2], 0) / size)
            shapes.append(seen[:, :2])
            depths.append(seen[:, 2].mean())
            fills.append(fill)
            strokes.append(0.45 * fill if self.outlines else fill)
            widths.append(0.35)
        for points, colour in zip(self.lines, self.line_colours):
            seen = points @ frame.T
            shapes.append(seen[:, :2])
            # Red ones before everything: where a mesh leaves its CAD edges they may lie inside it.
            depths.append(seen[:, 2].mean() + (self.slack if colour == INK else self.diagonal))
            fills.append(colour)
            strokes.append(colour)
            widths.append(0.8 if colour == INK else 1.6)
        order = np.argsort(depths, kind="stable")
        axes.add_collection(PolyCollection([shapes[k] for k in order], facecolors=[fills[k] for k in order], edgecolors=[strokes[k] for k in order],
                                           linewidths=[widths[k] for k in order], closed=False))
        if self.dots:
            seen = np.array(self.dots) @ frame.T
            axes.plot(seen[:, 0], seen[:, 1], "o", color=RED, markeredgecolor="white", markersize=4, markeredgewidth=0.6)
        axes.autoscale_view()
        axes.set_aspect("equal")


def numbers_in(text, kind):
    """Of the CAD entities of a kind that a text names: 3 and 12 for "Face3, Face12"."""
    return {int(number) for number in re.findall(kind + r"(\d+)\b", text)}


def add_edges(scene, shape, lost, diagonal):
    for number, edge in enumerate(shape.Edges, 1):
        if edge.Degenerated:
            continue
        try:
            points = np.array([tuple(p) for p in edge.discretize(max(2, min(200, int(120 * edge.Length / diagonal) + 2)))])
        except Part.OCCError:  # shorter than OpenCASCADE's tolerance: Boolean operations leave such edges
            continue
        colour = RED if number in lost else INK
        scene.lines += [points[k:k + 2] for k in range(len(points) - 1)]
        scene.line_colours += [colour] * (len(points) - 1)


def read_shape(part):
    """None where FreeCAD's Part does not read it: a document, a file that is none."""
    shape = Part.Shape()
    try:
        shape.read(part)
    except (OSError, RuntimeError, Part.OCCError):
        return None
    return shape if shape.Faces else None


def mesh_scene(shape, mesh, row):
    points, hexes, quality, quads, quad_quality = read_mesh(mesh)
    scene = Scene(np.linalg.norm(np.ptp(points[hexes], axis=(0, 1))), outlines=True)
    scene.facets, scene.facet_colours = list(points[quads]), list(quality_colours(quad_quality))
    # A quad whose four nodes are a cell's is its side.
    scene.dots = [points[cell].mean(axis=0) for cell in hexes[quality < BAD] if not np.isin(quads, cell).all(axis=1).any()]
    if shape:
        add_edges(scene, shape, numbers_in(" ".join(row["report"]["cad"]["edges"]["lost"]), "Edge"), scene.diagonal)
    return scene


def split(triangles, longest):
    """Triangles, (n, 3, 3), bisected until no side is longer: those drawn from back to front must be small."""
    done = []
    while len(triangles):
        sides = np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=2)
        small = sides.max(axis=1) <= longest
        done.append(triangles[small])
        rest = triangles[~small]
        # Turned so that the longest side is the first.
        rest = np.take_along_axis(rest, ((sides[~small].argmax(axis=1)[:, None] + np.arange(3)) % 3)[:, :, None], axis=1)
        middle = (rest[:, 0] + rest[:, 1]) / 2
        triangles = np.concatenate([np.stack([rest[:, 0], middle, rest[:, 2]], axis=1), np.stack([middle, rest[:, 1], rest[:, 2]], axis=1)])
    return np.concatenate(done)


def cad_scene(shape, reason=""):
    diagonal = shape.BoundBox.DiagonalLength
    scene = Scene(diagonal, outlines=False)
    faces = numbers_in(reason, "Face")
    for number, face in enumerate(shape.Faces, 1):
        points, triangles = face.tessellate(0.002 * diagonal)
        if not triangles:
            continue
        facets = split(np.array([tuple(p) for p in points])[np.array(triangles)], 0.04 * diagonal)
        scene.facets += list(facets)
        scene.facet_colours += [RED if number in faces else STEEL] * len(facets)
    add_edges(scene, shape, numbers_in(reason, "Edge"), diagonal)
    return scene


def main():
    part, result, mesh, picture = sys.argv[1:]
    with open(result, encoding="utf-8") as file:
        row = json.load(file)
    shape = read_shape(part)
    scene = mesh_scene(shape, mesh, row) if "report" in row else cad_scene(shape, row["reason"]) if shape else None
    figure, axes = pyplot.subplots(1, 2, figsize=(11, 5.5))
    for place, eye in zip(axes, EYES):
        place.axis("off")
        if scene:
            scene.draw(place, eye)
    figure.subplots_adjust(0, 0, 1, 1, 0, 0)
    figure.savefig(picture, dpi=90, pil_kwargs={"quality": 70})
    return 0


if __name__ == "__main__":
    sys.exit(main())
