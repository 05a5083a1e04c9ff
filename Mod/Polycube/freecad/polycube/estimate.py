"""How far stresses can be trusted: CalculiX's own estimate, how much they differ at a node from cell to cell, and the CAD faces where that is worst.

On the Lame tube it is 1 to 3 times the error with C3D20, 2 to 6 times with C3D20R. Where stresses are recovered Zienkiewicz and Zhu's estimate too: the energy
of the difference between recovered stresses and those of the cells.
"""

import itertools
import os

from . import recovery, serendipity
from .words import tr

#: how many faces are named
WORST = 3
#: mean strain of a part without stress. Theory: CalculiX's solver leaves 1e-16 or so, loads that are meant bring 1e-7
_STRAIN = 1e-10


class StressError:
    """percent: {node: largest difference of the stress between its cells, over the stress}; faces: the worst, (name, MPa, percent at the worst node)."""

    def __init__(self, percent, faces):
        self.percent, self.faces = percent, faces

    def line(self):
        """One line for the log; "" where no face has a stress."""
        named = ["{} ({} MPa, {} %)".format(name, _two_digits(stress), _two_digits(percent)) for name, stress, percent in self.faces]
        return tr("stresses differ most from cell to cell, and a finer mesh changes them most, on {}").format(", ".join(named)) if named else ""


class EnergyError:
    """share: estimated error of the stresses in the energy norm, of the whole part; of_cells (m,): the error of each cell over the mean stress of the part, both
    by the energy in a volume; faces: the worst, (name, percent, percent at the worst node), once `find_faces` was asked.
    """

    def __init__(self, share, of_cells, recovered):
        self.share, self.of_cells, self.faces, self._recovered = share, of_cells, [], recovered

    def line(self):
        """One line for the log."""
        share = _two_digits(100 * self.share)
        if not self.faces:
            return tr("stresses inside the cells are off by about {} % in energy, by the estimate of Zienkiewicz and Zhu").format(share)
        named = [tr("{} ({} %, {} % at its worst node)").format(name, _two_digits(mean), _two_digits(most)) for name, mean, most in self.faces]
        text = tr("stresses inside the cells are off by about {} % in energy, by the estimate of Zienkiewicz and Zhu; most, against the mean stress of the part, on {}")
        return text.format(share, ", ".join(named))

    def of_nodes(self):
        """{node: %}, the largest of its cells."""
        import numpy

        worst = numpy.zeros(len(self._recovered.nodes))
        numpy.maximum.at(worst, self._recovered.cells, 100 * self.of_cells[:, None])
        return dict(zip(self._recovered.nodes.tolist(), worst.tolist()))

    def find_faces(self, mesh):
        """Finds the CAD faces where the error is largest. mesh: a GroupedMesh."""
        percent = self.of_nodes()
        self.faces = _worst_faces(mesh, percent, percent)

    def show_in(self, result):
        """Adds `EnergyError`, % by node, the largest of its cells, to the result object."""
        percent = self.of_nodes()
        if not hasattr(result, "EnergyError"):
            result.addProperty("App::PropertyFloatList", "EnergyError", "NodeData", "Zienkiewicz-Zhu: largest error of the cells at a node, over the mean stress, %")
        result.EnergyError = [percent.get(node, 0.0) for node in result.NodeNumbers]


def energy_error(recovered, stiffness):
    """The EnergyError of a stresses.Recovered. stiffness: (Young's modulus, Poisson's ratio) of each cell."""
    import numpy

    terms = list(itertools.product(range(2), repeat=3))
    corners = numpy.array([[numpy.prod(at ** numpy.array(term)) for term in terms] for at in recovery.gauss(2)[0]])
    young, poisson = numpy.array(stiffness).T
    error, energy, volumes = (numpy.zeros(len(recovered.cells)) for _ in range(3))
    # at these points, not at those of the samples: there both are alike
    for at, weight in zip(*recovery.gauss(3)):
        shape, slopes = serendipity.shape_functions(20, at)
        volume = weight * numpy.abs(numpy.linalg.det(numpy.einsum("nk,mnd->mkd", slopes, recovered.points[recovered.cells])))
        to_here = numpy.array([numpy.prod(at ** numpy.array(term)) for term in terms]) @ numpy.linalg.inv(corners)
        own, better = numpy.einsum("p,mps->ms", to_here, recovered.samples), numpy.einsum("n,mns->ms", shape, recovered.of_cells)
        error += volume * _energy(better - own, young, poisson)
        energy += volume * _energy(own, young, poisson)
        volumes += volume
    total = energy.sum() + error.sum()
    if total <= _STRAIN**2 * (young * volumes).sum():
        return EnergyError(0.0, 0 * error, recovered)
    return EnergyError(float(numpy.sqrt(error.sum() / total)), numpy.sqrt(error / volumes * volumes.sum() / total), recovered)


def _energy(stresses, young, poisson):
    """Twice the energy in a volume of stresses (m, 6)."""
    direct, shear = stresses[:, :3], stresses[:, 3:]
    return ((1 + poisson) * ((direct**2).sum(axis=1) + 2 * (shear**2).sum(axis=1)) - poisson * direct.sum(axis=1) ** 2) / young


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
    return StressError(percent, _worst_faces(mesh, wrong, percent))


def _worst_faces(mesh, wrong, percent):
    """[(name, mean of `wrong`, largest `percent`)] of the CAD faces where the mean is largest. wrong, percent: by node."""
    faces = []
    for number, face in enumerate(mesh.faces, 1):
        elements = mesh.elements(face, "Face")
        if elements:
            weights = mesh.lumped_weights(elements)
            # by the mean over the face: one node at a sharp corner, where stresses have no limit, does not make a face the worst
            mean = sum(wrong.get(node, 0.0) * weight for node, weight in weights.items()) / sum(weights.values())
            faces.append(("Face{}".format(number), mean, max(percent.get(node, 0.0) for node in weights)))
    return sorted((face for face in faces if face[1] > 0), key=lambda face: -face[1])[:WORST]


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
