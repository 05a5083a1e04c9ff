"""The task panel: parameters, the mesher in a child process with live log, and the quality of the mesh."""

import html
import json
import time
import traceback

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import api, engine, job, label_view, objects, option_table, quality_view, resources, shapes
from .compat import print_error, qt_number
from .errors import Cancelled, InvalidInput, PolycubeError, StageFailed
from .histogram import Histogram

_TITLE = "Hexahedral mesh"


def _exists(obj):
    """Whether the object is still in its document. One that was undone lives on for redo, without a name, and writing to it crashes FreeCAD."""
    try:
        return obj is not None and bool(obj.Name) and obj.Document.getObject(obj.Name) == obj
    except (ReferenceError, RuntimeError, AttributeError):  # deleted; out of its document; its document closed
        return False


def _load_form():
    """The form in a widget that is made here: PySide notices the end of such a widget and of what was laid out in it.

    Of the widget that FreeCAD's loader returns it does not notice it, and would take the next widget at that address for the old one.
    """
    form, loaded = QtGui.QWidget(), FreeCADGui.PySideUic.loadUi(resources.path("ui", "MeshPanel.ui"))
    form.setWindowTitle(loaded.windowTitle())
    layout = QtGui.QVBoxLayout(form)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.addWidget(loaded)
    vars(form).update(vars(loaded))
    return form


class MeshPanel:
    """Apply runs the mesher, Cancel stops it, OK is refused while it runs.

    The document changes once, when the mesh is there; without a mesh object, one is made then.
    """

    _running = None  # the one panel that meshes at present: FreeCAD shows one task panel at a time
    _form = None

    def __init__(self, part, obj=None, analysis=None):
        self.part, self.obj = part, obj
        self.analysis = objects.analysis_of(obj) if obj else analysis
        self.document_name = part.Document.Name if part else obj.Document.Name
        self.form = _load_form()
        self.form.setWindowIcon(QtGui.QIcon(resources.icon("Polycube_MeshFromShape")))
        self.histogram = Histogram()
        self.form.quality_layout.insertWidget(1, self.histogram)
        self.form.worst.itemSelectionChanged.connect(self._highlight)
        self.form.colours.toggled.connect(self._colour)
        self.timer = QtCore.QTimer()
        self.timer.setInterval(100)
        self.timer.timeout.connect(self._watch)
        self.process = self.job = self.reason = None  # the reason why the process was killed
        self.started = self.process_started = 0.0
        self.options = option_table.read(obj) if obj else {}
        self.labels = dict(self.options.get("labels", {}))  # set by hand: {"Face3": "+X"}
        self.overlay = self.clicks = self.shown_labels = None
        self._automatic_labels = {}  # of faces before they were set by hand, as far as is known
        self._labels_are_old = False
        self._meshed_options, self._meshed_shape = {}, []
        self.form.label_key.setText(label_view.key())
        self.form.preview.toggled.connect(self._preview)
        self.form.automatic.clicked.connect(self._automatic)
        self._show_parameters()
        self._show_quality()
        FreeCAD.addDocumentObserver(self)

    @classmethod
    def is_meshing(cls, obj):
        return cls._running is not None and cls._running.obj == obj

    # --- what FreeCAD calls -------------------------------------------------------------------------------------------------

    @property
    def form(self):
        """The widgets, None once the panel is closed."""
        return self._form

    @form.setter
    def form(self, form):
        """FreeCAD sets None just before it deletes the widgets, in whatever way the panel is closed.

        Their signal `destroyed` must not be used for that: it hands out what is half deleted, and PySide takes the next widget at that address for it.
        """
        if form is None and self._form is not None:
            try:
                self._end()
            except Exception:  # FreeCAD is in a destructor, an error would end it
                FreeCAD.Console.PrintError("Polycube: {}\n".format(traceback.format_exc()))
        self._form = form

    def slotDeletedDocument(self, document):
        """FreeCAD leaves a panel open whose document is closed."""
        if document.Name == self.document_name and self._form is not None:
            self.obj = None  # it is in the document still, but shown no more
            FreeCADGui.Control.closeDialog()

    def getStandardButtons(self):
        return qt_number(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Apply | QtGui.QDialogButtonBox.Cancel)

    def clicked(self, button):
        if qt_number(button) == qt_number(QtGui.QDialogButtonBox.Apply):
            self.apply()

    def accept(self):
        if self.process:
            self.log("The mesher is running: wait, or stop it with Cancel.", error=True)
            return False
        if _exists(self.obj) and self._parameters() != option_table.read(self.obj):
            with api.transaction(self.obj.Document, "Mesh parameters"):
                option_table.write(self.obj, self._parameters())
        return self._close()

    def reject(self):
        if self.process:
            self.cancel()
            return False
        return self._close()

    # --- running the mesher -------------------------------------------------------------------------------------------------

    def apply(self):
        """Starts the mesher with the panel's parameters."""
        if self.process:
            self.log("The mesher is running already.", error=True)
            return
        self.form.log.clear()
        self.obj = self.obj if _exists(self.obj) else None
        self._meshed_options = self._parameters()
        options = self._meshed_options
        if _exists(self.part):
            options = api.with_constraints(options, self.part, self.analysis if _exists(self.analysis) else None)
        self._start("mesh", options, "Meshing")

    def _start(self, what, options, message):
        """Starts the child process that makes "mesh" or "labels"; _finished takes what it made."""
        self.started = time.monotonic()
        try:
            if not _exists(self.part):
                raise PolycubeError("there is no part to mesh")
            shape = shapes.shape_of(self.part, self._beside())
            shapes.check_solid(shape)
            self._meshed_shape = shapes.signature(shape)
            self.job = job.Job(shape, options, what)
            program, *arguments = self.job.command()
            environment = self.job.environment()
        except (PolycubeError, OSError) as error:
            self._close_job()
            self.log(str(error), error=True)
            return
        self.reason = None
        self._out, self._err = "", ""
        variables = QtCore.QProcessEnvironment()
        for name, value in environment.items():
            variables.insert(name, value)
        self.process = QtCore.QProcess()
        self.process.setProcessEnvironment(variables)
        self.process.readyReadStandardOutput.connect(self._read_output)
        self.process.readyReadStandardError.connect(self._read_error)
        self.process.finished.connect(self._finished)
        self.process.errorOccurred.connect(self._not_started)
        MeshPanel._running = self
        self.form.parameters.setEnabled(False)
        self.log("{} {} ...".format(message, self.part.Label))
        self.timer.start()
        self.process_started = time.monotonic()
        self.process.start(program, arguments)

    def _beside(self):
        """What the mesh will be beside: its object or its analysis, as far as there are any."""
        return next(filter(_exists, (self.obj, self.analysis)), None)

    def cancel(self):
        """Kills the mesher; the panel stays."""
        if self.process:
            self._kill("cancelled")

    def _kill(self, reason):
        self.reason = reason
        job.kill_tree(int(self.process.processId()))

    def _watch(self):
        """Ten times a second while the mesher runs."""
        self._show_time()
        if not self.reason and self.job.out_of_time(time.monotonic() - self.process_started):
            self._kill("out of time")

    def _read_output(self):
        self._out += bytes(self.process.readAllStandardOutput()).decode("utf-8", "replace")
        *lines, self._out = self._out.split("\n")
        for line in lines:
            kind, value = job.Job.parse(line)
            if kind == "progress":
                self.form.progress.setValue(round(100 * value[1]))
                self.form.progress.setFormat(value[0] + " %p%")
            else:
                self.log(value)

    def _read_error(self):
        self._err = (self._err + bytes(self.process.readAllStandardError()).decode("utf-8", "replace"))[-4000:]

    def _not_started(self, error):
        if error == QtCore.QProcess.FailedToStart:
            self._finished(-1, None)

    def _finished(self, status, exit_status):
        if not self.process:
            return
        if exit_status == QtCore.QProcess.CrashExit:
            status = -1
        self._read_output()
        self._read_error()
        process, self.process = self.process, None
        process.deleteLater()
        MeshPanel._running = None
        self.timer.stop()
        self._show_time()
        self.form.parameters.setEnabled(True)
        try:
            if self.reason:
                raise Cancelled(self.reason)
            made = self.job.finish(status, self._err)
            (self._take if self.job.what == "mesh" else self._show_labels)(made)
        except StageFailed as error:
            self.log(str(error), error=True)
            self._select(error.entities)
        except PolycubeError as error:
            self.log(str(error), error=True)
        finally:
            self._close_job()
        self.form.progress.setFormat("%p%")
        if self._labels_are_old and self.form.preview.isChecked():
            self._update_labels()

    def _take(self, result):
        """Puts the mesh into the document, in one undo step."""
        if not _exists(self.part):
            raise PolycubeError("the part is gone")
        self.obj = self.obj if _exists(self.obj) else None
        document = FreeCAD.getDocument(self.document_name)
        QtGui.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)
        try:
            with api.transaction(document, _TITLE if self.obj else "Hexahedral mesh from shape"):
                if not self.obj:
                    self.obj = objects.make(document, self.part)
                    if _exists(self.analysis):
                        self.analysis.addObject(self.obj)
                warnings = objects.set_mesh(self.obj, result, self._meshed_options, self._meshed_shape)
        finally:
            QtGui.QApplication.restoreOverrideCursor()
        self.form.preview.setChecked(False)
        self.form.colours.setChecked(False)
        self.form.progress.setValue(100)
        for line in warnings:
            self.log("Warning: " + line, error=True)
        self.log("{} cells, {} nodes.".format(len(result.hexes), len(result.nodes)))
        self.obj.ViewObject.show()
        shapes.solid_object(self.part).ViewObject.hide()  # not its container, the mesh may be in that too
        self._show_quality()

    def _close_job(self):
        if self.job:
            self.job.close()
            self.job = None

    def _end(self):
        """Nothing goes on that the panel has begun, and its marks go."""
        FreeCAD.removeDocumentObserver(self)
        self._labels_are_old = False
        if self.process:
            self.cancel()
            self.process.waitForFinished()  # it was killed; _finished is called here
        self._end_preview()
        self._clear_marks()

    def _close(self):
        gui_document = FreeCADGui.getDocument(self.document_name) if self.document_name in FreeCAD.listDocuments() else None
        if gui_document and gui_document.getInEdit():
            gui_document.resetEdit()
        else:
            FreeCADGui.Control.closeDialog()
        return True

    # --- axes of faces -------------------------------------------------------------------------------------------------------

    def _preview(self, wanted):
        """Begins or ends to show the labels on the part."""
        self.form.label_key.setVisible(wanted)
        if not wanted:
            self._end_preview()
        elif _exists(self.part):
            self._show_part()
            if _exists(self.obj):
                self.obj.ViewObject.hide()
            beside = self._beside()
            self.overlay = label_view.LabelOverlay(self.part.Document, shapes.standing(beside) if beside else FreeCAD.Placement())
            self.clicks = label_view.FaceClicks(shapes.solid_object(self.part), self.face_clicked)
            self._update_labels()

    def _end_preview(self):
        if self.clicks:
            self.clicks.remove()
        if self.overlay and self.document_name in FreeCAD.listDocuments():
            self.overlay.remove()
        self.clicks = self.overlay = self.shown_labels = None

    def _update_labels(self):
        """Computes the labels anew, after what runs now."""
        self._labels_are_old = True
        if not self.process:
            self._labels_are_old = False
            self._start("labels", self._parameters(), "Labelling")

    def _show_labels(self, labels):
        self.shown_labels = labels
        self.form.progress.setValue(100)
        if self.overlay:
            self.overlay.show(labels)
        lost = sum(fate == "lost" for fate, _ in labels.edges.values())
        self.log(
            "{} charts, {}, {} turning points, {} CAD edges not captured.".format(
                labels.chart.max() + 1, "valid" if labels.valid else "not valid", len(labels.turning_points), lost
            )
        )

    def face_clicked(self, face):
        """The next of the axes that the face can have, or automatic again."""
        if not self.shown_labels:
            return
        names = engine.description()["label_names"]
        name = "Face{}".format(face)
        possible = self.shown_labels.possible(face)
        given = names.index(self.labels[name]) if name in self.labels else None
        if given is None:
            self._automatic_labels[face] = self.shown_labels.face_label[face]
        label = label_view.next_label(given, self._automatic_labels.get(face), possible)
        if not possible:
            self.log("{} turns too far for any one axis.".format(name), error=True)
            return
        if label is None:
            del self.labels[name]
        else:
            self.labels[name] = names[label]
        self.log("{}: {}".format(name, "automatic" if label is None else names[label]))
        self._labels_changed()

    def _automatic(self):
        chosen = [item.text().split("=")[0] for item in self.form.given_labels.selectedItems()] or list(self.labels)
        for name in chosen:
            del self.labels[name]
        if chosen:
            self._labels_changed()

    def _labels_changed(self):
        self._list_labels()
        if self.form.preview.isChecked():
            self._update_labels()

    def _list_labels(self):
        self.form.given_labels.clear()
        self.form.given_labels.addItems(["{}={}".format(*item) for item in sorted(self.labels.items(), key=lambda item: int(item[0][4:]))])

    # --- what the panel shows -----------------------------------------------------------------------------------------------

    def log(self, text, error=False):
        stamp = "{:.1f}: ".format(time.monotonic() - self.started) if self.started else ""
        line = html.escape(stamp + text)
        self.form.log.appendHtml('<span style="color:#c02020">{}</span>'.format(line) if error else line)
        (print_error if error else FreeCAD.Console.PrintLog)("Polycube: {}\n".format(text))

    def _show_time(self):
        self.form.time.setText("{:.1f} s".format(time.monotonic() - self.started))

    def _show_parameters(self):
        self.form.part.setText(self.part.Label if self.part else "none")
        self.form.element_size.setProperty("unit", "mm")
        self.form.element_size.setProperty("rawValue", self.options.get("size", 0.0))
        self.form.hexes.setValue(self.options.get("hexes", 0))
        self.form.order.setCurrentIndex(self.options.get("order", 2) - 1)
        self._list_labels()
        try:
            shape = shapes.shape_of(self.part)
        except InvalidInput:  # Apply tells
            return
        if shape.isNull():
            return
        length = FreeCAD.Units.Quantity(shape.BoundBox.DiagonalLength / 30, FreeCAD.Units.Length).UserString
        self.form.size_hint.setText("0 is automatic: {}".format(length))

    def _parameters(self):
        """The options as the panel shows them, without defaults; the advanced ones come from the object's properties."""
        options = dict(option_table.read(self.obj) if self.obj else self.options)
        shown = {
            "size": float(self.form.element_size.property("rawValue")),
            "hexes": self.form.hexes.value(),
            "order": self.form.order.currentIndex() + 1,
            "labels": dict(self.labels),
        }
        defaults = {option["name"]: option["default"] for option in option_table.table()}
        for name, value in shown.items():
            options.pop(name, None)
            if value != defaults[name]:
                options[name] = value
        return options

    def _show_quality(self):
        if not self.obj or not self.obj.Report:
            return
        report = json.loads(self.obj.Report)
        quality, captured = report["quality"], report["cad"]
        self.histogram.set_counts(quality["histogram"])
        outdated = self.obj.MeshState == objects.OUTDATED
        self.form.summary.setText(
            ("The mesh is out of date: press Apply.\n" if outdated else "")
            + "{} cells, {} nodes\nScaled Jacobian: min {:.3f}, mean {:.3f}\n{}Of the CAD model: {}".format(
                self.obj.Hexahedra,
                self.obj.NodeCount,
                quality["min_scaled_jacobian"],
                quality["mean_scaled_jacobian"],
                _shape_line(quality),
                ", ".join("{captured}/{total} ".format(**captured[what]) + what for what in ("faces", "edges", "vertices")),
            )
        )
        self.form.colours.setEnabled(True)
        worst = report["worst_cells"]
        self.form.worst.setRowCount(len(worst))
        for row, cell in enumerate(worst):
            place = ", ".join(cell["faces"]) or "inside"
            for column, text in enumerate((str(cell["hex"] + 1), "{:.3f}".format(cell["scaled_jacobian"]), place)):
                self.form.worst.setItem(row, column, QtGui.QTableWidgetItem(text))
        self.form.worst.resizeColumnsToContents()

    def _highlight(self):
        """Marks the nodes of the cell selected in the list."""
        rows = self.form.worst.selectionModel().selectedRows()
        if not rows or not _exists(self.obj):
            return
        cell = int(self.form.worst.item(rows[0].row(), 0).text())
        self.obj.ViewObject.HighlightedNodes = list(self.obj.FemMesh.getElementNodes(cell))

    def _colour(self, wanted):
        """Paints the nodes by the worst of their cells."""
        if not _exists(self.obj):
            return
        if not wanted:
            self.obj.ViewObject.resetNodeColor()
            return
        quality_view.paint(self.obj.ViewObject, self.obj.FemMesh)

    def _clear_marks(self):
        if not _exists(self.obj):
            return
        if self.form.worst.selectionModel().hasSelection():
            self.obj.ViewObject.HighlightedNodes = []
        if self.form.colours.isChecked():
            self.obj.ViewObject.resetNodeColor()

    def _show_part(self):
        for obj in (self.part, shapes.solid_object(self.part)):
            obj.ViewObject.show()

    def _select(self, entities):
        """Shows the CAD entities at fault in the 3D view."""
        if entities:
            self._show_part()
            FreeCADGui.Selection.clearSelection()
            top, path = shapes.selection_path(shapes.solid_object(self.part))
            for name in entities:
                FreeCADGui.Selection.addSelection(top, path + name)


def _shape_line(quality):
    """The worst of the other measures; documents of older versions have none."""
    names = ("edge_ratio", "skew", "warpage")
    if not all(name in quality for name in names):
        return ""
    return "Worst cells: " + ", ".join("{} {:.2f}".format(name.replace("_", " "), quality[name]["max"]) for name in names) + "\n"
