"""The panel's section "Result": quality as numbers, bars and colours, the worst cells, cells by themselves, and what of the CAD model is not captured."""

import functools
import json

from PySide import QtCore, QtGui

from . import measures, objects, overlay, quality_view, shapes
from .cell_view import CellOverlay, Hidden, zoom
from .folding import Section
from .histogram import Histogram
from .measures import BARS, MEASURES, Cells
from .result import of_runs
from .words import count, decimal, noop, tr

#: Cells in the list of the worst.
_WORST = 20
#: Measures within a line.
_IN_A_LINE = {"edge_ratio": noop("edge ratio"), "skew": noop("skew"), "warpage": noop("warpage")}
_RED = (0.86, 0.08, 0.12)


class ResultSection(Section):
    """What there is to see of the mesh of `panel.obj`. Nothing here changes the document."""

    def __init__(self, panel):
        super().__init__(tr("Result"), "quality")
        self._panel = panel
        self._shown = None  # which mesh: see _state()
        self._cells = self._cells_of = None  # computed when they are first asked for, of that Report
        self._cell_overlay = self._hidden = self._lost_overlay = None
        self._updating = self._is_at_work = False
        self._waiting = []  # what is to be done on a large mesh, once each
        self.summary = QtGui.QLabel(tr("No mesh yet"))
        self.summary.setWordWrap(True)
        self.measure_box = QtGui.QComboBox()
        self.measure_box.addItems([tr(measure.title) for measure in MEASURES])
        self.measure_box.setToolTip(tr("What bars, colours, threshold and list judge the cells by"))
        self.histogram = Histogram(clicked=self._bar_clicked)
        self.colours = QtGui.QCheckBox(tr("Quality in colours"))
        self.colours.setToolTip(tr("Paints the mesh as the bars: blue is good, red is bad"))
        self.blocks = QtGui.QCheckBox(tr("Blocks in colours"))
        self.blocks.setToolTip(tr("Paints each block of the polycube that the cells divide; a cut shows those inside"))
        self.below = QtGui.QCheckBox(tr("Worse than"))
        self.below.setToolTip(tr("Shows the cells beyond this value alone"))
        self.threshold = QtGui.QDoubleSpinBox()
        self.threshold.setDecimals(2)
        self.threshold.setSingleStep(0.05)
        self.threshold.setMaximum(1e6)
        self.threshold.setMinimumWidth(50)
        self.cut = QtGui.QComboBox()
        self.cut.addItems([tr("No cut"), tr("Cut X"), tr("Cut Y"), tr("Cut Z")])
        self.cut.setToolTip(tr("Takes the cells on one side of a plane away, whole"))
        self.cut_place = QtGui.QSlider(QtCore.Qt.Horizontal)
        self.cut_place.setRange(0, 100)
        self.cut_place.setValue(50)
        self.lost = QtGui.QCheckBox(tr("Lost CAD edges"))
        self.lost.setToolTip(tr("Draws the CAD edges that have no mesh edges in red"))
        self.worst = QtGui.QTableWidget(0, 3)
        self.worst.setHorizontalHeaderLabels([tr("Cell"), tr("Quality"), tr("At")])
        self.worst.setMinimumSize(60, 120)
        self.worst.setToolTip(tr("The worst cells; a click marks one, a double click looks at it closely"))
        self.worst.setEditTriggers(QtGui.QAbstractItemView.NoEditTriggers)
        self.worst.setSelectionBehavior(QtGui.QAbstractItemView.SelectRows)
        self.worst.setSelectionMode(QtGui.QAbstractItemView.SingleSelection)
        self.worst.verticalHeader().setVisible(False)
        self.worst.horizontalHeader().setStretchLastSection(True)
        self._lay_out()
        self.measure_box.currentIndexChanged.connect(lambda _: self._soon(self._measure_changed))
        # One can be seen at a time.
        self.colours.toggled.connect(lambda on: on and self.blocks.setChecked(False))
        self.blocks.toggled.connect(lambda on: on and self.colours.setChecked(False))
        self.colours.toggled.connect(lambda _: self._soon(self._colour))
        self.blocks.toggled.connect(lambda _: self._soon(self._isolate))
        self.below.toggled.connect(lambda _: self._soon(self._isolate))
        self.threshold.valueChanged.connect(lambda _: self.below.isChecked() and self._soon(self._isolate))
        self.cut.currentIndexChanged.connect(lambda _: self._soon(self._isolate))
        self.cut_place.valueChanged.connect(lambda _: self.cut.currentIndex() and self._soon(self._isolate))
        self.lost.toggled.connect(self._show_lost)
        self.worst.itemSelectionChanged.connect(self._highlight)
        self.worst.itemDoubleClicked.connect(lambda item: self._soon(functools.partial(self._zoom, item.row())))

    def _lay_out(self):
        self._tools = QtGui.QWidget()
        tools = QtGui.QVBoxLayout(self._tools)
        tools.setContentsMargins(0, 0, 0, 0)
        rows = [[self.below, self.threshold], [self.cut, self.cut_place]]
        for widget in (self.measure_box, self.histogram, self.colours, self.blocks):
            tools.addWidget(widget)
        for row in rows:
            line = QtGui.QHBoxLayout()
            for widget in row:
                line.addWidget(widget)
            tools.addLayout(line)
        tools.addWidget(self.told)
        tools.addWidget(self.lost)
        tools.addWidget(self.worst)
        self.body.addWidget(self.summary)
        self.body.addWidget(self._tools)
        self._tools.setEnabled(False)
        for box in (self.measure_box, self.cut):
            box.setMinimumContentsLength(6)
            box.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLengthWithIcon)

    # --- what there is ---------------------------------------------------------------------------------------------------

    def show_mesh(self, result=None):
        """The numbers of the mesh as it is now; all marks of an earlier one go. `result`: the MeshResult that it was made of, where that is at hand."""
        obj = self._panel.obj
        if not obj or not obj.Report:
            return
        self._shown = self._state()
        if result:
            self._cells, self._cells_of = Cells.of_result(result, self._breathe), obj.Report
        self.clear()
        self._report = json.loads(obj.Report)
        self._tell()
        self._tools.setEnabled(True)
        self.blocks.setVisible(bool(obj.Blocks))  # documents of older versions have none
        edges = self._report["cad"]["edges"]
        missing = edges["lost"] + edges["ignored"]
        self.lost.setVisible(bool(missing))
        self.lost.setText(tr("{} lost CAD edges").format(len(missing)))
        self._judge()

    def _tell(self):
        """The mesh in numbers, and whether it is out of date."""
        obj, report = self._panel.obj, self._report
        quality, captured = report["quality"], report["cad"]
        lines = [tr("The mesh is out of date: press Apply.")] if obj.MeshState == objects.OUTDATED else []
        lines.append(tr("{} cells, {} nodes").format(count(obj.Hexahedra), count(obj.NodeCount)))
        lines.append(tr("Scaled Jacobian: min {}, mean {}").format(*(decimal(quality[of + "_scaled_jacobian"], 3) for of in ("min", "mean"))))
        others = [measure for measure in MEASURES[1:] if measure.name in quality]  # documents of older versions have none
        if others:
            lines.append(tr("Worst cells: ") + ", ".join("{} {}".format(tr(_IN_A_LINE[one.name]), decimal(quality[one.name]["max"], 2)) for one in others))
        captured_words = ("{captured}/{total} ".format(**captured[what]) + tr(what) for what in (noop("faces"), noop("edges"), noop("vertices")))
        lines.append(tr("Of the CAD model: ") + ", ".join(captured_words))
        self.summary.setText("\n".join(lines))

    def _state(self):
        """What tells the mesh that there is from others, None where there is none."""
        obj = self._panel.obj
        return (obj.Name, obj.MeshedCells, obj.Report) if self._panel.mesh_exists() and obj.Report else None

    def follow(self):
        """The mesh may be another, as after undo, out of date, or gone."""
        now = self._state()
        if now is None and self._shown:
            self._shown = None
            self.clear()
            self.summary.setText(tr("No mesh yet"))
            self.histogram.set_counts([0] * BARS, self.measure)
            self.worst.setRowCount(0)
            self.lost.setVisible(False)
            self._tools.setEnabled(False)
        elif now and now != self._shown:
            self.show_mesh()
        elif now:
            self._tell()

    def is_at_work(self):
        return self._is_at_work

    @property
    def measure(self):
        return MEASURES[self.measure_box.currentIndex()]

    def cells(self):
        """The cells of the mesh as arrays."""
        obj = self._panel.obj
        if self._cells is None or self._cells_of != obj.Report:
            self._cells, self._cells_of = Cells(obj.FemMesh, self._breathe), obj.Report
        return self._cells

    def _is_large(self):
        return self._panel.mesh_exists() and self._panel.obj.Hexahedra > measures.SLICE

    def _soon(self, work):
        """Does what a widget was clicked for: at once, of a large mesh when the click is over, for the window goes on then, and may close with its widgets."""
        if not self._is_large():
            work()
            return
        if work not in self._waiting:
            self._waiting.append(work)
        QtCore.QTimer.singleShot(0, self._work)

    def _work(self):
        if self._is_at_work:
            return
        self._is_at_work = True
        try:
            while self._waiting and self._panel.form is not None and self._panel.mesh_exists():
                self._waiting.pop(0)()
        except _Ended:
            pass
        finally:
            self._is_at_work = False

    def _breathe(self):
        """The window goes on, though nothing can be clicked. What is under way ends here if the panel is closed meanwhile, or the mesh goes."""
        if not self._is_at_work:
            return
        QtGui.QApplication.processEvents(QtCore.QEventLoop.ExcludeUserInputEvents)
        if self._panel.form is None or not self._panel.mesh_exists():
            raise _Ended

    def _measure_changed(self):
        self._judge()
        if self.colours.isChecked():
            self._colour()
        self._isolate()

    def _judge(self):
        """Bars and list by the chosen measure."""
        measure, worst = self.measure, self._report["worst_cells"]
        self._updating = True
        try:
            with busy():
                if measure is MEASURES[0]:
                    # as the mesher has counted them, at no cost
                    rows = [(cell["hex"], cell["scaled_jacobian"], cell["faces"]) for cell in worst]
                    self.histogram.set_counts(self._report["quality"]["histogram"], measure)
                else:
                    cells = self.cells()
                    values = cells.values(measure)
                    chosen = cells.worst(measure, _WORST)
                    at = faces_of(self._panel.obj.FemMesh, cells.nodes[chosen, :8])
                    rows = [(index, values[index], faces) for index, faces in zip(chosen.tolist(), at)]
                    self.histogram.set_counts(measure.histogram(values), measure)
                self.threshold.setValue(measure.value(0.3))
                self.worst.clearSelection()
                self.worst.setRowCount(len(rows))
                for row, (index, value, faces) in enumerate(rows):
                    for column, text in enumerate((str(index + 1), decimal(value, 3), ", ".join(faces) or tr("inside"))):
                        self.worst.setItem(row, column, QtGui.QTableWidgetItem(text))
                self.worst.resizeColumnsToContents()
        finally:
            self._updating = False

    # --- what there is to see --------------------------------------------------------------------------------------------

    def _highlight(self):
        """Marks the nodes of the cell selected in the list."""
        row = self.worst.currentRow()
        if self._updating or row < 0 or not self.worst.selectedItems() or not self._panel.mesh_exists():
            return
        cell = int(self.worst.item(row, 0).text())
        self._panel.obj.ViewObject.HighlightedNodes = list(self._panel.obj.FemMesh.getElementNodes(cell))

    def _zoom(self, row):
        """Looks closely at a cell of the list, alone."""
        if not self._panel.mesh_exists():
            return
        index = int(self.worst.item(row, 0).text()) - 1
        self._panel.axes.preview.setChecked(False)
        with busy():
            cells = self.cells()
            chosen = cells.numbers == index + 1
            self._draw(chosen)
            zoom(self._panel.obj.Document, shapes.standing(self._panel.obj), cells.corners(chosen)[0])

    def _bar_clicked(self, _bar):
        self._soon(self._isolate)

    def _isolate(self):
        """Shows the cells of the chosen bar, beyond the threshold, on one side of the cut; the mesh as it is where none of these is chosen, and no blocks."""
        if self._updating or not self._panel.mesh_exists():
            return
        bar, axis = self.histogram.chosen, self.cut.currentIndex() - 1
        if bar is None and axis < 0 and not self.below.isChecked() and not self.blocks.isChecked():
            self._end_cells()
            return
        self._panel.axes.preview.setChecked(False)  # it stands in the same place
        with busy():
            cells = self.cells()
            chosen = cells.numbers >= 0
            if bar is not None:
                chosen &= self.measure.bars(cells.values(self.measure)) == bar
            if self.below.isChecked():
                chosen &= self.measure.goodness(cells.values(self.measure)) < self.measure.goodness(self.threshold.value())
            if axis >= 0:
                places = cells.corners().mean(axis=1)[:, axis]
                least, most = places.min(), places.max()
                chosen &= places <= least + (most - least) * self.cut_place.value() / 100
            self._draw(chosen)

    def _draw(self, chosen):
        obj, cells = self._panel.obj, self.cells()
        if self._cell_overlay and self._cell_overlay.cells is not cells:
            self._end_cells()
        if not self._cell_overlay:
            self._cell_overlay = CellOverlay(obj.Document, shapes.standing(obj), cells)
            self._hidden = Hidden(obj.ViewObject)
        self._hidden.again()
        self._cell_overlay.show(chosen, self._cell_colours())
        shown = int(chosen.sum())
        self.say(tr("{} of {} cells shown").format(count(shown), count(len(chosen))) if shown else tr("No cell is like this: nothing is shown"))

    def _cell_colours(self):
        if self.blocks.isChecked():
            return quality_view.block_colours(of_runs(self._panel.obj.Blocks))
        if not self.colours.isChecked():
            return None
        import numpy

        palette = numpy.array([quality_view.colour(bar) for bar in range(BARS)])
        return palette[self.measure.bars(self.cells().values(self.measure))]

    def _end_cells(self):
        if self._cell_overlay and self._panel.document_is_open():
            self._cell_overlay.remove()
            self._hidden.end(self._panel.mesh_exists())
        self.say("")
        self._cell_overlay = self._hidden = None

    def _colour(self):
        """Paints the nodes by the worst of their cells."""
        if not self._panel.mesh_exists():
            return
        view = self._panel.obj.ViewObject
        if not self.colours.isChecked():
            view.resetNodeColor()
        else:
            with busy():
                quality_view.paint(view, self.cells(), self.measure)
        if self._cell_overlay:
            self._isolate()

    def _show_lost(self, wanted):
        """Draws the CAD edges that the mesh has no edges on."""
        if self._lost_overlay and self._panel.document_is_open():
            self._lost_overlay.remove()
        self._lost_overlay = None
        if not wanted or not self._panel.mesh_exists() or not self._panel.part_exists():
            return
        obj, captured = self._panel.obj, self._report["cad"]["edges"]
        shape = shapes.shape_of(self._panel.part, obj)
        chains = []
        for name in captured["lost"] + captured["ignored"]:
            edge = shape.getElement(name)
            chains.append(edge.discretize(Deflection=max(edge.Length / 200, 1e-6)))
        self._lost_overlay = overlay.Overlay(obj.Document, shapes.standing(obj))
        self._lost_overlay.draw(*overlay.lines(chains, _RED, 4))

    def clear(self):
        """No mark of the mesh is left in the 3D view."""
        self._updating = True
        self._end_cells()
        self._show_lost(False)
        if self._panel.mesh_exists():
            view = self._panel.obj.ViewObject
            if self.worst.selectedItems():
                view.HighlightedNodes = []
            if self.colours.isChecked():
                view.resetNodeColor()
        self.worst.clearSelection()
        self.lost.setChecked(False)
        self.colours.setChecked(False)
        self.show_whole()

    def show_whole(self):
        """No cells by themselves."""
        self._updating = True
        self.histogram.choose(None)
        self.blocks.setChecked(False)
        self.below.setChecked(False)
        self.cut.setCurrentIndex(0)
        self._updating = False
        self._waiting.clear()
        self._end_cells()


class _Ended(Exception):
    """What was looked at is there no more."""


class busy:
    """The cursor of a window that is at work, while it lasts."""

    def __enter__(self):
        QtGui.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)

    def __exit__(self, *_):
        QtGui.QApplication.restoreOverrideCursor()


def faces_of(mesh, cells):
    """For each row of corner nodes the names of the CAD faces that a side of this cell is on, by the mesh's groups."""
    wanted = {tuple(sorted(row)): [] for row in cells.tolist()}
    of_node = {}
    for row in wanted:
        for node in row:
            of_node.setdefault(node, set()).add(row)
    for group in mesh.Groups:
        name = mesh.getGroupName(group)
        if mesh.getGroupElementType(group) != "Face" or not name.startswith("Face"):
            continue
        for quad in mesh.getGroupElements(group):
            corners = mesh.getElementNodes(quad)[:4]
            for row in of_node.get(corners[0], ()):
                if name not in wanted[row] and set(corners) <= set(row):
                    wanted[row].append(name)
    return [sorted(wanted[tuple(sorted(row))], key=lambda name: int(name[4:])) for row in cells.tolist()]
