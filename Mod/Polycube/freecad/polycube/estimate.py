"""How far stresses can be trusted: CalculiX's own estimate, how much they differ at a node from cell to cell, and the CAD faces where that is worst.

On the Lame tube it is 1 to 3 times the error with C3D20, 2 to 6 times with C3D20R.
"""

import os

from .words import tr

#: how many faces are named
WORST = 3


class StressError:
    """percent: {node: largest difference of the stress between its cells, over the stress}; faces: the worst, (name, MPa, percent at the worst node)."""

    def __init__(self, percent, faces):
        self.percent, self.faces = percent, faces

    def line(self):
        """One line for the log; "" where no face has a stress."""
        named = ["{} ({} MPa, {} %)".format(name, _two_digits(stress), _two_digits(percent)) for name, stress, percent in self.faces]
        return tr("stresses differ most from cell to cell, and a finer mesh changes them most, on {}").format(", ".join(named)) if named else ""


def _two_digits(value):
    """As people write it, "130" and not "1.3e+02"."""
    return "{:.0f}".format(value) if value >= 10 else "{:.2g}".format(value)


def stress_error(path, result, mesh):
    """The StressError of a run, from the result file beside the input file; None if CalculiX gives none. Adds `StressError`, % by node, to the result object.

    mesh: a GroupedMesh.
    """
    percent = _read(os.path.splitext(path)[0] + ".frd")
    if not percent or not result.vonMises:
        return None
    if not hasattr(result, "StressError"):
        result.addProperty("App::PropertyFloatList", "StressError", "NodeData", "Largest difference of the stress between the cells at a node, %")
    result.StressError = [percent.get(node, 0.0) for node in result.NodeNumbers]
    wrong = {node: percent.get(node, 0.0) / 100 * stress for node, stress in zip(result.NodeNumbers, result.vonMises)}
    faces = []
    for number, face in enumerate(mesh.faces, 1):
        elements = mesh.elements(face, "Face")
        if elements:
            weights = mesh.lumped_weights(elements)
            # by the mean over the face: one node at a sharp corner, where stresses have no limit, does not make a face the worst
            mean = sum(wrong.get(node, 0.0) * weight for node, weight in weights.items()) / sum(weights.values())
            faces.append(("Face{}".format(number), mean, max(percent.get(node, 0.0) for node in weights)))
    faces = sorted((face for face in faces if face[1] > 0), key=lambda face: -face[1])
    return StressError(percent, faces[:WORST])


def _read(path):
    """{node: %} of the last step."""
    found, reading = {}, False
    with open(path, encoding="ascii", errors="replace") as file:
        for line in file:
            if line.startswith(" -4"):
                reading = line[5:10] == "ERROR"
            elif reading and line.startswith(" -1"):
                found[int(line[3:13])] = float(line[13:25])
            elif line.startswith(" -3"):
                reading = False
    return found
