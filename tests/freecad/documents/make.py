"""Makes refined-VERSION.FCStd beside this file, for TestPolycubeVersions: `freecadcmd tests/freecad/documents/make.py` in each version of FreeCAD.

A plate with a bore, meshed with size 8, and a refinement of each kind, the local size among them suppressed.
"""

import os

import FreeCAD
import Part

from freecad import polycube

HERE = os.path.dirname(os.path.abspath(__file__))
#: kind, places, value
REFINEMENTS = [
    ("size", ["Face1"], "2 mm"),
    ("divisions", ["Edge4"], "8"),
    ("layers", ["Face3", "Face5"], "3"),
    ("bore", ["Face7"], "16.."),
    ("bias", ["Edge2"], 2),
    ("keep", ["Face3"], None),
    ("axis", ["Face1"], "-X"),
]

if __name__ in ("__main__", "make"):  # freecadcmd imports a file by its name
    document = FreeCAD.newDocument("Refined")
    plate = document.addObject("Part::Feature", "Plate")
    plate.Shape = Part.makeBox(60, 40, 10).cut(Part.makeCylinder(8, 10, FreeCAD.Vector(25, 20, 0)))
    mesh = polycube.create_fem_mesh(plate, size=8, order=1, only_object=True)
    made = [polycube.refine(mesh, *one) for one in REFINEMENTS]
    polycube.set_refinement(made[0], suppressed=True)
    polycube.update_fem_mesh(mesh)
    document.recompute()
    document.saveAs(os.path.join(HERE, "refined-{}.{}.FCStd".format(*FreeCAD.Version()[:2])))
