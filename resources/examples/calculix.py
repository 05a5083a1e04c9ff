"""A static analysis of a steel part, solved by CalculiX; shared by the demo and the tests."""

import os

import FreeCAD
import ObjectsFem
from femtools import ccxtools

import ccx  # beside this file


class _Tools(ccxtools.FemToolsCcx):
    """FreeCAD's own, with the program that ccx.find names."""

    def setup_ccx(self, *_, **__):
        self.ccx_binary = ccx.find()
        self.ccx_binary_present = self.ccx_binary is not None


def make_analysis(part, fixed):
    """Analysis in the part's document with steel and fixed faces (names); returns (analysis, solver)."""
    document = part.Document
    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    # FreeCAD 1.x has a capital X
    make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    solver = analysis.addObject(make_solver(document, "Solver"))[0]
    solver.AnalysisType = "static"
    steel = analysis.addObject(ObjectsFem.makeMaterialSolid(document, "Steel"))[0]
    values = steel.Material
    values.update({"Name": "S235", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.30", "Density": "7850 kg/m^3"})
    steel.Material = values
    support = analysis.addObject(ObjectsFem.makeConstraintFixed(document, "Support"))[0]
    support.References = [(part, name) for name in fixed]
    return analysis, solver


def set_quantity(obj, name, value, unit):
    """Sets a load in N, MPa and so on. FreeCAD 0.20 has plain numbers for it; 1.x has quantities, and takes a plain number as mN or kPa."""
    plain = obj.getTypeIdOfProperty(name) == "App::PropertyFloat"
    setattr(obj, name, value if plain else FreeCAD.Units.Quantity("{} {}".format(value, unit)))


#: units of the plain numbers that FreeCAD 0.20 has for loads
UNITS = {
    "AmbientTemp": "K",
    "CFlux": "kg*mm^2/s^3",
    "DFlux": "W/m^2",
    "Diameter": "mm",
    "DissipationRate": "W/kg",
    "FilmCoef": "W/m^2/K",
    "Force": "N",
    "HeatSource": "W/kg",
    "Pressure": "MPa",
    "Temperature": "K",
    "initialTemperature": "K",
    "normalStiffness": "N/m",
    "tangentialStiffness": "N/m",
}


#: What FreeCAD 1.x does without: a direction that is neither free nor displaced is fixed.
FIXES = {axis + "Fix" for axis in "xyz"}


def add_constraint(analysis, kind, part, names, **values):
    """A constraint of FreeCAD's ("Force", "Pressure", ...) on entities of the part ("Face3", ...; none: on all of it).

    Values are named as in 0.20; those that UNITS lists are in those units.
    """
    obj = analysis.addObject(getattr(ObjectsFem, "makeConstraint" + kind)(analysis.Document, kind))[0]
    if names:
        obj.References = [(part, name) for name in names]
    for name, value in values.items():
        here = next((one for one in (name, name[0].upper() + name[1:]) if one in obj.PropertiesList), None)  # 1.x has some with a capital
        if here is None and name in FIXES:
            continue
        if name in UNITS:
            set_quantity(obj, here or name, value, UNITS[name])
        else:
            setattr(obj, here or name, value)
    return obj


def write(analysis, solver, folder):
    """Writes the input file into `folder`; returns FreeCAD's tools with its path, `inp_file_name`."""
    os.makedirs(folder, exist_ok=True)
    fea = _Tools(analysis, solver, test_mode=False)
    fea.update_objects()
    fea.setup_working_dir(folder)
    trouble = fea.check_prerequisites()
    if trouble:
        raise RuntimeError(trouble)
    fea.write_inp_file()
    return fea


def solve(analysis, solver, folder):
    """Writes the input file, runs CalculiX in `folder` and loads the results; returns (path of the input file, result object)."""
    if not ccx.find():
        raise RuntimeError(ccx.MISSING)
    fea = write(analysis, solver, folder)
    fea.setup_ccx()
    fea.ccx_run()
    fea.load_results()
    results = [obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemResultObject")]
    if not results:
        raise RuntimeError("CalculiX gave no result")
    return fea.inp_file_name, results[0]
