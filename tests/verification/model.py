"""A part in a FreeCAD document with its analysis, meshed and solved as a user does it; and the results at its nodes."""

import json
import os
import re
import subprocess
import sys
from unittest import mock

import FreeCAD
import numpy as np

import frd

from freecad import polycube
from freecad.polycube import ccx, solver

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(HERE)), "resources", "examples"))
import calculix  # noqa: E402

YOUNG, POISSON, DENSITY = 210000.0, 0.3, 7.85e-9  # N/mm2, -, t/mm3
#: a face is where it is asked for within this share of the part's size
NEAR = 1e-6


class Model:
    def __init__(self, shape, kind="static", **material):
        self.shape, self.document = shape, FreeCAD.newDocument()
        self.part = self.document.addObject("Part::Feature", "Part")
        self.part.Shape = shape
        self.analysis, self.solver = calculix.make_analysis(self.part, ["Face1"])
        self.document.removeObject("Support")
        self.solver.AnalysisType = kind
        self.solver.ThermoMechSteadyState = True
        steel = next(member for member in self.analysis.Group if member.TypeId == "App::MaterialObjectPython")
        heat = {"ThermalConductivity": "50 W/m/K", "ThermalExpansionCoefficient": "0 m/m/K", "SpecificHeat": "500 J/kg/K"}
        steel.Material = dict(steel.Material, **heat, **material)
        self.change = None  # of the input file: change(text, points)

    def close(self):
        FreeCAD.closeDocument(self.document.Name)

    def faces(self, value, at):
        """Names of the faces all of whose corners, edges and middles have value(x, y, z) == at."""
        near = NEAR * self.shape.BoundBox.DiagonalLength
        found = []
        for number, face in enumerate(self.shape.Faces, 1):
            points = [point for edge in face.Edges for point in edge.discretize(5)] + [face.valueAt(*self._middle(face))]
            if all(abs(value(*point) - at) < near for point in points):
                found.append("Face{}".format(number))
        if not found:
            raise ValueError("there is no such face")
        return found

    @staticmethod
    def _middle(face):
        low_u, high_u, low_v, high_v = face.ParameterRange
        return (low_u + high_u) / 2, (low_v + high_v) / 2

    def add(self, kind, names, **values):
        return calculix.add_constraint(self.analysis, kind, self.part, names, **values)

    def hold(self, names, axes):
        """No displacement along the axes, "xz" say."""
        self.add("Displacement", names, **{axis + end: end == "Fix" for axis in axes for end in ("Free", "Fix")})

    def pull(self, names, direction, newtons):
        """A force along the normal of a plane face, or against it."""
        self.add("Force", names, Force=abs(newtons), Direction=(self.part, direction), Reversed=newtons < 0)

    def mesh(self, size, order=2, **options):
        for obj in self.document.findObjects("Fem::FemMeshObject"):
            self.document.removeObject(obj.Name)
        return polycube.create_fem_mesh(self.part, size=size, order=order, analysis=self.analysis, **options).FemMesh

    def tets(self, nodes, folder):
        """Tetrahedra with ten nodes, as many nodes as asked for within 15 % if a size gives that; None where Gmsh fails."""
        shape, out = os.path.join(folder, "shape.brep"), os.path.join(folder, "tets.unv")
        self.shape.exportBrep(shape)
        for obj in self.document.findObjects("Fem::FemMeshObject"):
            self.document.removeObject(obj.Name)
        obj = self.document.addObject("Fem::FemMeshObject", "Tets")
        self.analysis.addObject(obj)
        size, best = 2.0 * (self.shape.Volume / nodes) ** (1 / 3), None
        import Fem

        for _ in range(6):
            run = subprocess.run([os.path.join(HERE, "tets.py"), shape, str(size), out], capture_output=True, check=False)
            if run.returncode:
                return None
            mesh = Fem.read(out)
            if best is None or abs(mesh.NodeCount - nodes) < abs(best.NodeCount - nodes):
                best = mesh
            if abs(best.NodeCount - nodes) < 0.15 * nodes:
                break
            size *= (mesh.NodeCount / nodes) ** (1 / 2.5)
        obj.FemMesh = best
        return best

    def solve(self, folder, element=None, improved=False):
        """A Field of the results. improved: with CalculiX's own recovery of stresses, ZZS, which FreeCAD does not read."""
        self.document.recompute()
        tools = solver.prepared(self.analysis, None, folder)
        solution = solver.write(tools, element)
        with open(solution.path, encoding="utf-8") as file:
            text = file.read()
        if self.change:
            text = self.change(text, {number: np.array(point[:]) for number, point in tools.mesh.FemMesh.Nodes.items()})
        if improved:
            text = re.sub(r"^(\*EL FILE.*\n).*", r"\1ZZS", text, flags=re.MULTILINE)
        with open(solution.path, "w", encoding="utf-8") as file:
            file.write(text)
        real = ccx.find()
        with mock.patch.dict(os.environ, POLYCUBE_MEASURED=real, POLYCUBE_CCX=os.path.join(HERE, "measured")):
            solver.run(solution)
        raw = Field(solution, self)
        solution.recovered = solution.recover and solution.recover()
        if not solution.recovered:
            return raw
        field = Field(solution, self)
        field.raw = raw
        return field


class Field:
    """Results at the nodes of a mesh, with the nodes of faces by a function of place. raw: a Field with CalculiX's stresses, where these are recovered."""

    def __init__(self, solution, model):
        self.solution, self.model, self.raw = solution, model, None
        base = os.path.splitext(solution.path)[0]
        with open(os.path.join(os.path.dirname(base), "measured.json"), encoding="ascii") as file:
            self.cost = json.load(file)
        if model.solver.AnalysisType == "frequency":
            self.frequencies = frd.frequencies(base + ".dat")
        else:
            self.__dict__.update(frd.read(base + ".frd"))

    def where(self, value, at):
        """Which nodes have value(x, y, z) == at, x, y, z arrays."""
        near = 1e-4 * self.model.shape.BoundBox.DiagonalLength
        found = np.abs(value(*self.points.T) - at) < near
        if not found.any():
            raise ValueError("there are no such nodes")
        return found

    def at(self, *place):
        """The node next to a place."""
        return int(np.argmin(np.linalg.norm(self.points - np.array(place), axis=1)))

    def radial(self, where):
        """(radial, hoop) stress round the z axis, and the radial displacement, at nodes."""
        x, y = self.points[where, 0], self.points[where, 1]
        c, s = x / np.hypot(x, y), y / np.hypot(x, y)
        xx, yy, _, xy, _, _ = self.stress[where].T
        u = self.displacement[where]
        return xx * c * c + yy * s * s + 2 * xy * s * c, xx * s * s + yy * c * c - 2 * xy * s * c, u[:, 0] * c + u[:, 1] * s


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))
