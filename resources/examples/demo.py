"""The demo, run by resources/demo inside FreeCAD: mesh a bracket, solve it with CalculiX where that is installed, take pictures.

The bottom is fixed; the two upper bores carry 4 kN towards the front, the top of the wall 2 MPa. Lines for the user go to descriptor 8.
"""

import json
import os
import shutil
import sys
import time
import traceback

import FreeCAD
import FreeCADGui
import ObjectsFem

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bracket  # noqa: E402  (beside this file)
import calculix  # noqa: E402
import ccx  # noqa: E402
from freecad import polycube  # noqa: E402

OUT = os.environ["POLYCUBE_DEMO_OUT"]
SIZE, FORCE, PRESSURE = 3.0, 4000.0, 2.0  # mm, N, MPa


def say(text):
    os.write(8, (text + "\n").encode())


def set_up(document):
    """The bracket with its analysis; returns (part, analysis, solver)."""
    part = document.addObject("Part::Feature", "Bracket")
    part.Shape = bracket.make_bracket()
    named = bracket.faces(part.Shape)
    say("Part: {} CAD faces, {:.1f} cm3".format(len(part.Shape.Faces), part.Shape.Volume / 1000))

    analysis, solver = calculix.make_analysis(part, named["bottom"])
    force = analysis.addObject(ObjectsFem.makeConstraintForce(document, "Pull"))[0]
    force.References = [(part, name) for name in named["loads"]]
    calculix.set_quantity(force, "Force", FORCE, "N")
    force.Direction = (part, [named["back"][0]])
    force.Reversed = True
    pressure = analysis.addObject(ObjectsFem.makeConstraintPressure(document, "Pressure"))[0]
    pressure.References = [(part, name) for name in named["top"]]
    calculix.set_quantity(pressure, "Pressure", PRESSURE, "MPa")
    document.recompute()
    return part, analysis, solver


def fit(view):
    """Fits the view and leaves room at the right for the colour scale."""
    import pivy.coin  # FreeCAD 1.x hands out a camera only then; without a window the import crashes

    del pivy
    view.fitAll()
    camera = view.getCameraNode()
    height = camera.height.getValue() * 1.15
    camera.height.setValue(height)
    right = view.getCameraOrientation().multVec(FreeCAD.Vector(1, 0, 0)) * (0.12 * height)
    camera.position.setValue(*(FreeCAD.Vector(*camera.position.getValue().getValue()) + right))


def hide_all(document):
    for obj in document.Objects:
        obj.ViewObject.hide()


def take_picture(document, mesh):
    """mesh.png"""
    FreeCADGui.activateWorkbench("FemWorkbench")
    view = FreeCADGui.getDocument(document.Name).activeView()
    view.setAnimationEnabled(False)  # FreeCAD 1.x turns the camera by and by
    hide_all(document)
    # from the front, where the rib is
    view.setCameraOrientation(FreeCAD.Rotation(0.4247, 0.1759, 0.3399, 0.8205).Q)
    mesh.ViewObject.show()
    mesh.ViewObject.ShapeColor = (0.62, 0.78, 0.92)
    view.fitAll()
    view.saveImage(os.path.join(OUT, "mesh.png"), 1600, 1200, "White")
    return view


def take_picture_of_stress(document, view, result):
    """stress.png: von Mises stress on the deformed bracket."""
    hide_all(document)
    pipeline = document.addObject("Fem::FemPostPipeline", "Stress")
    pipeline.load(result)
    document.recompute()
    pipeline.ViewObject.show()
    pipeline.ViewObject.DisplayMode = "Surface"
    fields = pipeline.ViewObject.getEnumerationsOfProperty("Field")
    pipeline.ViewObject.Field = next(name for name in fields if "Mises" in name)
    pipeline.ViewObject.Transparency = 0
    fit(view)
    for _ in range(10):
        FreeCADGui.updateGui()
    view.saveImage(os.path.join(OUT, "stress.png"), 1600, 1200, "White")


def solve(analysis, solver):
    """Runs CalculiX; returns (path of the input file, result object, figures for the report)."""
    path, result = calculix.solve(analysis, solver, os.path.join(OUT, "calculix"))
    displacement, stress = max(result.DisplacementLengths), max(result.vonMises)
    say("CalculiX: maximum displacement {:.4f} mm, maximum von Mises stress {:.1f} MPa".format(displacement, stress))
    return path, result, {"max_displacement_mm": displacement, "max_von_mises_mpa": stress, "force_n": FORCE, "pressure_mpa": PRESSURE}


def main():
    solver_there = ccx.find() is not None
    FreeCADGui.showMainWindow()
    document = FreeCAD.newDocument("PolycubeDemo")
    part, analysis, solver = set_up(document)

    began = time.monotonic()
    mesh = polycube.create_fem_mesh(part, size=SIZE, order=2, analysis=analysis, name="HexMesh")
    seconds = time.monotonic() - began
    report = json.loads(mesh.Report)
    quality, captured = report["quality"], report["cad"]
    say("Mesh: {} second-order hexahedra, {} nodes, {:.1f} s".format(mesh.Hexahedra, mesh.NodeCount, seconds))
    say("Quality: scaled Jacobian min {:.3f}, mean {:.3f}".format(quality["min_scaled_jacobian"], quality["mean_scaled_jacobian"]))
    worst = ", ".join("{} {:.2f}".format(name.replace("_", " "), quality[name]["max"]) for name in ("edge_ratio", "skew", "warpage"))
    say("Worst cells: " + worst)
    say("CAD captured: " + ", ".join("{captured}/{total} ".format(**captured[what]) + what for what in ("faces", "edges", "vertices")))
    say("Volume: mesh {:.0f} mm3, CAD {:.0f} mm3".format(report["volume"]["mesh"], report["volume"]["cad"]))

    written = ["bracket.FCStd", "bracket.inp", "report.json", "mesh.png"]
    view = take_picture(document, mesh)
    if solver_there:
        path, result, report["analysis"] = solve(analysis, solver)
        take_picture_of_stress(document, view, result)
        written.append("stress.png")
    else:
        say("Not solved: " + ccx.MISSING)
        path = calculix.write(analysis, solver, os.path.join(OUT, "calculix")).inp_file_name
    shutil.copy(path, os.path.join(OUT, "bracket.inp"))
    with open(os.path.join(OUT, "report.json"), "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
        file.write("\n")
    document.saveAs(os.path.join(OUT, "bracket.FCStd"))
    say("Written to {}: {}".format(OUT, ", ".join(written)))


try:
    main()
    STATUS = 0
except polycube.PolycubeError as error:
    say("No mesh: {}".format(error))
    STATUS = 2
except Exception as error:  # whatever FreeCAD throws: the log has the place, the user gets the line
    traceback.print_exc()
    say("Error: {}".format(error))
    STATUS = 1
with open(os.path.join(OUT, "status"), "w", encoding="ascii") as file:
    file.write(str(STATUS))
sys.stdout.flush()
os._exit(STATUS)
