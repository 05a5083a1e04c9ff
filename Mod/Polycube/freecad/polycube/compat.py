"""What FreeCAD 0.20 and 1.x, and their Qt, do differently, as functions; what they name differently in menus and toolbars is in init_gui."""

import os
import sys
from contextlib import contextmanager

import FreeCAD

#: Types of a FEM mesh object with a proxy: FreeCAD 1.x, 0.20
_MESH_TYPES = ("Fem::FemMeshShapeBaseObjectPython", "Fem::FemMeshObjectPython")


def mesh_type(document):
    """The type for a new FEM mesh object."""
    import Fem  # makes the types known

    del Fem
    known = document.supportedTypes()
    return next(kind for kind in _MESH_TYPES if kind in known)


def needs_part_property(obj):
    """Whether the link to the part is for us to add: 1.x brings its own, `Shape`; objects of 0.20 have ours, `Part`, also when opened in 1.x."""
    return "Part" not in obj.PropertiesList and not obj.isDerivedFrom("Fem::FemMeshShapeBaseObject")


def part_of(obj):
    """The document object that the mesh is made from."""
    return obj.Part if "Part" in obj.PropertiesList else obj.Shape


def set_part(obj, part):
    if "Part" in obj.PropertiesList:
        obj.Part = part
    else:
        obj.Shape = part


def newtons(force):
    """A force constraint's force in N, as the writers for solvers take loads of nodes: a plain number in 0.20, in 1.x a quantity without a unit.

    There the property is a quantity, which FreeCAD holds in mN.
    """
    value = force.Force
    return FreeCAD.Units.Quantity(value.getValueAs("N")) if isinstance(value, FreeCAD.Units.Quantity) else value


def plain(value, unit, factor=1.0):
    """A property as number in a unit: of quantities, as 1.x has them, their value in it; of the plain numbers of 0.20 what they are, times a factor."""
    return value.getValueAs(unit).Value if isinstance(value, FreeCAD.Units.Quantity) else value * factor


def density(material):
    """Of a material object, in t/mm3; 0 if it has none."""
    value = material.Material.get("Density")
    return FreeCAD.Units.Quantity(value).getValueAs("t/mm^3").Value if value else 0.0


def elasticity(material):
    """(Young's modulus in MPa, Poisson's ratio) of a material object."""
    values = material.Material
    return FreeCAD.Units.Quantity(values["YoungsModulus"]).getValueAs("MPa").Value, float(values["PoissonRatio"])


def gravity(weight):
    """The acceleration that FreeCAD's writer takes a self weight for, mm/s2: 0.20 has a direction only, and 9806 mm/s2 in its writer."""
    if hasattr(weight, "GravityDirection"):
        direction, size = FreeCAD.Vector(weight.GravityDirection), weight.GravityAcceleration.getValueAs("mm/s^2").Value
    else:
        direction, size = FreeCAD.Vector(weight.Gravity_x, weight.Gravity_y, weight.Gravity_z), 9806.0
    return direction.normalize() * size if direction.Length else direction


def says_that_nothing_holds(line):
    """Whether FreeCAD refuses an analysis with this line because it knows no support in it."""
    return any(words in line for words in ("Neither constraint fixed nor", "No mechanical boundary conditions"))  # 0.20; 1.x


def qt_number(flag):
    """A Qt flag as int: PySide6 keeps it in `value`, PySide2 is one already."""
    return int(getattr(flag, "value", flag))


def print_error(text):
    """To the report view only: 1.x opens a balloon for every other error, also for what the panel shows already."""
    getattr(FreeCAD.Console, "PrintDeveloperError", FreeCAD.Console.PrintError)(text)


@contextmanager
def quiet():
    """Nothing reaches standard output: FreeCAD prints two lines for every group that is added to a FEM mesh, from C++."""
    try:
        sys.stdout.flush()
        kept = os.dup(1)
    except (AttributeError, OSError):  # there is none
        yield
        return
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.close(null)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
