"""The pictures of the user guide, run by pictures.sh inside FreeCAD: the bracket of the demo, meshed in the panel, refined, judged, solved."""

import os
import sys
import time
import traceback

import FreeCAD
import FreeCADGui

FreeCADGui.showMainWindow()

import FemGui  # noqa: E402  needs the window
import ObjectsFem  # noqa: E402
from PySide import QtCore, QtGui  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "examples"))

import bracket  # noqa: E402
import calculix  # noqa: E402
import ccx  # noqa: E402
from freecad import polycube  # noqa: E402
from freecad.polycube import macro, task_panel  # noqa: E402

OUT = os.environ["POLYCUBE_GUIDE_OUT"]
SIZE, FORCE = 4.0, 4000.0  # mm, N
PATIENCE = 600  # seconds for one mesh


def wait(condition, seconds):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise RuntimeError("the window does not come to an end")
        QtGui.QApplication.processEvents(QtCore.QEventLoop.AllEvents, 50)


def rest(seconds=0.5):
    """Lets the window draw what there is."""
    end = time.monotonic() + seconds
    wait(lambda: time.monotonic() > end, 2 * seconds)


def picture(name):
    """The whole window."""
    rest()
    QtGui.QApplication.primaryScreen().grabWindow(0).save(os.path.join(OUT, name + ".png"))


def set_up(document):
    """The bracket in an analysis, fixed at its bottom and pulled at two bores."""
    part = document.addObject("Part::Feature", "Bracket")
    part.Shape = bracket.make_bracket()
    named = bracket.faces(part.Shape)
    analysis, _ = calculix.make_analysis(part, named["bottom"])
    force = analysis.addObject(ObjectsFem.makeConstraintForce(document, "Pull"))[0]
    force.References = [(part, name) for name in named["loads"]]
    calculix.set_quantity(force, "Force", FORCE, "N")
    force.Direction = (part, [named["back"][0]])
    force.Reversed = True
    document.recompute()
    for obj in analysis.Group:
        if hasattr(obj.ViewObject, "Visibility"):
            obj.ViewObject.hide()
    FemGui.setActiveAnalysis(analysis)
    return part, analysis, named


def open_panel(part, analysis):
    macro.begin()
    panel = task_panel.MeshPanel(part, analysis=analysis)
    FreeCADGui.Control.showDialog(panel)
    rest()
    return panel


def scroll_to(panel, widget):
    area = next(one for one in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea) if one.isAncestorOf(panel.form))
    rest(0.2)
    area.verticalScrollBar().setValue(widget.mapTo(area.widget(), QtCore.QPoint(0, 0)).y() - 10)


def apply(panel):
    panel.apply()
    wait(lambda: not panel.process and not panel._taking, PATIENCE)
    if not panel.obj or not panel.obj.Hexahedra:
        raise RuntimeError(panel.form.status.text())


def arrange():
    window = FreeCADGui.getMainWindow()
    window.showMaximized()
    FreeCADGui.activateWorkbench("PolycubeWorkbench")
    for dock in window.findChildren(QtGui.QDockWidget):
        if dock.objectName() in ("Combo View", "Tasks"):
            window.resizeDocks([dock], [320], QtCore.Qt.Horizontal)
        elif dock.objectName() in ("Report view", "Python console"):
            dock.hide()


def plain_ground():
    """Of the 3D view, which keeps the pictures small."""
    view = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/View")
    view.SetBool("Gradient", False)
    view.SetBool("RadialGradient", False)
    view.SetBool("Simple", True)
    view.SetUnsigned("BackgroundColor", 0xFFFFFFFF)
    view.SetBool("ShowNaviCube", False)


def main():
    plain_ground()
    document = FreeCAD.newDocument("Guide")
    arrange()
    part, analysis, named = set_up(document)
    view = FreeCADGui.activeDocument().activeView()
    view.setCameraOrientation(FreeCAD.Rotation(0.4247, 0.1759, 0.3399, 0.8205).Q)  # from the front, where the rib is
    view.fitAll()
    panel = open_panel(part, analysis)
    panel.field("size").value = SIZE
    apply(panel)
    view.fitAll()
    picture("first-mesh")

    panel.axes.set_open(True)
    panel.axes.beside.setChecked(True)
    wait(lambda: panel.axes.shown and not panel.process, PATIENCE)
    scroll_to(panel, panel.axes)
    picture("axes")
    panel.axes.preview.setChecked(False)
    panel.axes.set_open(False)
    view.fitAll()

    panel.show_part_alone()
    for name in named["loads"]:
        FreeCADGui.Selection.addSelection(document.Name, part.Name, name)
    panel.refine.add("bore")
    panel.show_part_alone()
    panel.refine._show_places()
    scroll_to(panel, panel.refine)
    picture("refinements")
    apply(panel)

    panel.result.colours.setChecked(True)
    panel.result.cut.setCurrentIndex(1)
    panel.result.cut_place.setValue(78)
    scroll_to(panel, panel.result)
    picture("quality")
    panel.result.clear()
    panel.result.blocks.setChecked(True)
    picture("blocks")
    panel.accept()

    if ccx.find():
        result = polycube.solve(analysis).result
        for obj in document.Objects:
            obj.ViewObject.hide()
        pipeline = document.addObject("Fem::FemPostPipeline", "Stress")
        pipeline.load(result)
        document.recompute()
        pipeline.ViewObject.show()
        pipeline.ViewObject.DisplayMode = "Surface"
        pipeline.ViewObject.Field = next(name for name in pipeline.ViewObject.getEnumerationsOfProperty("Field") if "Mises" in name)
        pipeline.ViewObject.Transparency = 0
        view.fitAll()
        picture("stress")


try:
    main()
except Exception:
    with open(os.path.join(OUT, "failed"), "w", encoding="utf-8") as file:
        traceback.print_exc(file=file)
sys.stdout.flush()
os._exit(0)
