"""The task panel: options by task, the mesher in a child process, and what came out."""

import json
import time
import traceback

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import analyses, api, fem_mesh, fields, job, macro, objects, option_table, prediction, preferences, refinements, resources, shapes
from .analysis_box import AnalysisBox
from .axes_section import AxesSection
from .compat import print_error, qt_number
from .errors import Cancelled, InvalidInput, PolycubeError, StageFailed
from .folding import Section
from .refine_section import RefineSection
from .result_section import ResultSection
from .run import Run
from .run_section import RunSection
from .words import count, noop, tr

_TITLE = noop("Hexahedral mesh")
#: What may help where a stage fails, by the stage.
_TRY = {
    "label": noop("Try other axes of faces, or another frame."),
    "deform": noop("Try other axes of faces, or a finer size."),
    "quantize": noop("Try without one of the demands that are named."),
    "fit": noop("Try a finer size, more effort, or give up smooth edges (Feature angle)."),
}
_TRY_ELSE = noop("Try a finer size, more effort, or other axes of faces.")


def _exists(obj):
    """Whether the object is still in its document. One that was undone lives on for redo, without a name, and writing to it crashes FreeCAD."""
    try:
        return obj is not None and bool(obj.Name) and obj.Document.getObject(obj.Name) == obj
    except (ReferenceError, RuntimeError, AttributeError):  # deleted; out of its document; its document closed
        return False


class MeshPanel:
    """Apply runs the mesher, Cancel stops it, OK is refused while it runs.

    The document changes once, when the mesh is there; without a mesh object, one is made then. The widgets are made here, not by FreeCAD's loader: PySide
    does not notice the end of those, and would take the next widget at that address for the old one.
    """

    _running = None  # the one panel that meshes at present: FreeCAD shows one task panel at a time
    _form = None
    shown_refinement = None  # name of the refinement that the next panel is to show

    def __init__(self, part, obj=None, analysis=None):
        self.part, self.obj = part, obj
        self.document_name = part.Document.Name if part else obj.Document.Name
        self.process = None  # the Run, while there is one
        self.started = 0.0
        self._taking = False
        self._filling = True
        self._meshed_options, self._asked, self._meshed_shape, self._before = {}, {}, [], {}
        self.options = option_table.read(obj) if obj else preferences.panel_defaults()
        self.analysis_box = AnalysisBox(FreeCAD.getDocument(self.document_name), objects.analysis_of(obj) if obj else None, analysis)
        self.analysis = self.analysis_box.chosen()  # that of the mesh that is made
        self.form = self._make_form()
        self._show_parameters()
        self._filling = False
        self.result.show_mesh()
        self.changed()
        FreeCAD.addDocumentObserver(self)
        QtCore.QTimer.singleShot(0, _narrow_buttons)

    def _make_form(self):
        form = QtGui.QWidget()
        form.setWindowTitle(tr(_TITLE))
        form.setWindowIcon(QtGui.QIcon(resources.icon("Polycube_MeshFromShape")))
        options = option_table.document_options()
        advanced = [option for option in options if option["advanced"] and not fields.is_of_places(option)]
        places = [option for option in options if fields.is_of_places(option) and option["type"] not in ("labels", "frame")]
        plain = [option for option in options if not option["advanced"] and not fields.is_of_places(option)]
        form.parameters = QtGui.QWidget()
        form.part = QtGui.QLabel()
        form.part.setWordWrap(True)
        size = Section(tr("Size"), "size_section")
        self.size_form = fields.OptionForm(plain, self.changed)
        form.size_hint = QtGui.QLabel()
        form.size_hint.setWordWrap(True)
        size.body.addWidget(self.size_form)
        size.body.addWidget(form.size_hint)
        self.axes = AxesSection(self, [option for option in options if option["type"] == "frame"])
        self.refine = RefineSection(self, places)
        self.advanced = Section(tr("Advanced"), "advanced_section", is_open=False)
        self.advanced_form = fields.OptionForm(advanced, self.changed)
        self.advanced.body.addWidget(self.advanced_form)
        self._forms = (self.size_form, self.axes.form, self.refine.form, self.advanced_form)
        head = QtGui.QFormLayout()
        head.addRow(QtGui.QLabel(tr("Part:")), form.part)
        head.addRow(QtGui.QLabel(tr("Analysis:")), self.analysis_box)
        parameters = QtGui.QVBoxLayout(form.parameters)
        parameters.setContentsMargins(0, 0, 0, 0)
        parameters.addLayout(head)
        for section in (size, self.axes, self.refine, self.advanced):
            parameters.addWidget(section)
        form.run = RunSection()
        form.run.best.clicked.connect(self.take_the_best)
        form.log, form.status, form.progress, form.time = form.run.log, form.run.status, form.run.progress, form.run.time
        self.result = ResultSection(self)
        layout = QtGui.QVBoxLayout(form)
        layout.setContentsMargins(0, 0, 0, 0)
        for widget in (form.parameters, form.run, self.result):
            layout.addWidget(widget)
        return form

    @classmethod
    def is_meshing(cls, obj):
        return cls._running is not None and cls._running.obj == obj

    def field(self, name):
        """The editor of an option."""
        return next(form.fields[name] for form in self._forms if name in form.fields)

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
        if self.process or self._taking:
            self.tell(tr("The mesher is running: wait, or stop it with Cancel."), error=True)
            return False
        if self.mesh_exists():
            try:
                self._keep_parameters()
            except InvalidInput as error:
                self.tell(str(error), error=True)
                return False
        return self._close()

    def _keep_parameters(self):
        """The mesh object gets options and analysis of the panel, without being meshed, where they are others."""
        options, before = self._parameters(), option_table.read(self.obj)
        analysis, held_by = self.analysis_box.chosen(), objects.analysis_of(self.obj)
        if options == before and analysis == held_by:
            return
        with api.transaction(self.obj.Document, tr("Mesh parameters")):
            option_table.write(self.obj, options)
            analyses.move(self.obj, analysis)
        macro.set_options(self.obj, before, options)
        if analysis != held_by:
            macro.set_analysis(self.obj, analysis)

    def reject(self):
        if self.process:
            self.cancel()
            return False
        return not self._taking and self._close()

    # --- running the mesher -------------------------------------------------------------------------------------------------

    def apply(self):
        """Starts the mesher with the panel's parameters."""
        if self.process or self._taking:
            self.tell(tr("The mesher is running already."), error=True)
            return
        self.form.log.clear()
        self.obj = self.obj if self.mesh_exists() else None
        self.analysis = self.analysis_box.chosen()
        try:
            self._meshed_options = self._parameters()
            self._asked = refinements.with_refinements(self._meshed_options, self.obj)
            self._before = option_table.read(self.obj) if self.obj else {}
        except InvalidInput as error:
            self.tell(str(error), error=True)
            return
        if not self._may_go_on():
            return
        options = self._asked
        if self.part_exists():
            options = api.with_constraints(options, self.part, self.analysis)
        self._start("mesh", options, tr("Meshing"))

    def _may_go_on(self):
        """Asks where the count of cells or the analysis would be a surprise."""
        expected = self._prediction(self._asked)
        if expected and expected.is_startling():
            question = tr("Local sizes make about {} cells of {}: the grid goes through the whole part. Make the mesh?")
            if not _agreed(question.format(count(round(expected.cells)), count(round(expected.plain)))):
                return False
        if not self.analysis:
            return True
        others = analyses.other_meshes(self.analysis, self.obj)
        if not others:
            return True
        names = ", ".join(mesh.Label for mesh in others)
        return _agreed(tr("{} holds the mesh {} already. Put the new mesh in its place? The old one stays in the document.").format(self.analysis.Label, names))

    def start_labels(self):
        """Computes the labels for the preview."""
        try:
            self._start("labels", refinements.with_refinements(self._parameters(), self.obj if self.mesh_exists() else None), tr("Labelling"))
        except InvalidInput as error:
            self.tell(str(error), error=True)

    def _start(self, what, options, words):
        """Starts the child process that makes "mesh" or "labels"; _finished takes what it made."""
        self.started = time.monotonic()
        work = None
        try:
            if not self.part_exists():
                raise PolycubeError(tr("there is no part to mesh"))
            shape = shapes.shape_of(self.part, self.beside())
            shapes.check_solid(shape)
            self._meshed_shape = shapes.signature(shape)
            work = job.Job(shape, options, what)
            self.process = Run(work, self._heard, self._show_time, self._finished)
        except (PolycubeError, OSError) as error:
            if work:
                work.close()
            self._fail(error)
            return
        MeshPanel._running = self
        self.form.parameters.setEnabled(False)
        self.form.run.begin("{} {} ...".format(words, self.part.Label))
        self.log("{} {} ...".format(words, self.part.Label))
        self.process.start()

    @property
    def job(self):
        """The job that runs, or None."""
        return self.process.job if self.process else None

    def cancel(self):
        """Kills the mesher; the panel stays."""
        if self.process:
            self.process.kill("cancelled")

    def take_the_best(self):
        """Ends the search for a better mesh."""
        if self.process:
            self.form.run.best.setEnabled(False)
            self.process.take_the_best()

    def _heard(self, kind, value):
        if kind == "progress":
            self.form.run.show_progress(*value)
        else:
            self.form.run.hear(value)
            self.log(value)

    def _show_time(self, seconds):
        self.form.time.setText("{:.1f} s".format(seconds))

    def _finished(self, made, error):
        what, self.process = self.process.job.what, None
        MeshPanel._running = None
        if self._form is None:  # closed meanwhile
            return
        self._show_time(time.monotonic() - self.started)
        self.form.run.end()
        self.form.parameters.setEnabled(True)
        try:
            if error:
                raise error
            (self._take if what == "mesh" else self._show_labels)(made)
        except PolycubeError as failure:
            self._fail(failure)
        if self._form is not None:
            self.axes.catch_up()

    def _fail(self, error):
        """Says what went wrong, where, and what may help."""
        text = str(error)
        self.log(text, error=True)
        if isinstance(error, Cancelled):
            text = text[0].upper() + text[1:] + "."
        elif isinstance(error, StageFailed):
            text = tr("Refused: {}.").format(text) + " " + tr(_TRY.get(error.stage, _TRY_ELSE))
            self.select(error.entities)
        self.form.run.tell(text, error=True)

    def _take(self, result):
        """Puts the mesh into the document, in one undo step."""
        self._taking = True
        QtGui.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)
        try:
            mesh = fem_mesh.build(result, self._breathe)
            if self._form is None:
                return
            if not self.part_exists():
                raise PolycubeError(tr("the part is gone"))
            self.axes.preview.setChecked(False)
            self.result.clear()
            warnings = self._put(result, mesh)
            self.show_mesh()
            self.result.show_mesh(result)
            self.result.set_open(True)
        finally:
            QtGui.QApplication.restoreOverrideCursor()
            self._taking = False
        self.form.progress.setValue(100)
        for line in warnings:
            self.log(tr("Warning: ") + line, error=True)
        text = tr("Meshed: {} cells, {} nodes, worst cell {:.2f}.").format(count(len(result.hexes)), count(len(result.nodes)), self.obj.MinScaledJacobian)
        if warnings:
            text += " " + (warnings[0] if len(warnings) == 1 else tr("{} warnings, see the log: {} ...").format(len(warnings), warnings[0]))
        self.tell(text)
        self._show_hint()

    def _put(self, result, mesh):
        """Object, mesh and place in the analysis; returns warnings."""
        document = FreeCAD.getDocument(self.document_name)
        self.obj = self.obj if self.mesh_exists() else None
        analysis = self.analysis if _exists(self.analysis) else None
        is_new = self.obj is None
        with api.transaction(document, tr("Hexahedral mesh from shape") if is_new else tr(_TITLE)):
            if is_new:
                self.obj = objects.make(document, self.part)
            held_by = objects.analysis_of(self.obj)
            for other in analyses.other_meshes(analysis, self.obj) if analysis else []:
                analysis.removeObject(other)
                other.ViewObject.hide()
            analyses.move(self.obj, analysis)
            warnings = objects.set_mesh(self.obj, result, self._meshed_options, self._meshed_shape, mesh, self._asked)
        if is_new:
            macro.created(self.obj, self._meshed_options)
        else:
            macro.updated(self.obj, self._before, self._meshed_options)
        if analysis != held_by:
            macro.set_analysis(self.obj, analysis)
        return warnings

    def _breathe(self, fraction):
        """The window goes on while a large mesh is taken; nothing can be clicked."""
        if self._form is not None:
            self.form.run.show_progress(tr("Taking the mesh"), fraction)
        QtGui.QApplication.processEvents(QtCore.QEventLoop.ExcludeUserInputEvents)

    def _show_labels(self, labels):
        line, good = self.axes.show_labels(labels)
        self.form.progress.setValue(100)
        self.tell(line, error=not good)

    def _end(self):
        """Nothing goes on that the panel has begun, and its marks go."""
        FreeCAD.removeDocumentObserver(self)
        if self.process:
            process = self.process
            self.cancel()
            process.wait()  # it was killed; _finished is called here
        self.axes.end()
        self.result.clear()

    def _close(self):
        gui_document = FreeCADGui.getDocument(self.document_name) if self.document_is_open() else None
        if gui_document and gui_document.getInEdit():
            gui_document.resetEdit()
        else:
            FreeCADGui.Control.closeDialog()
        return True

    # --- what sections ask ---------------------------------------------------------------------------------------------------

    def part_exists(self):
        return _exists(self.part)

    def mesh_exists(self):
        return _exists(self.obj)

    def document_is_open(self):
        return self.document_name in FreeCAD.listDocuments()

    def beside(self):
        """What the mesh will be beside: its object or its analysis, as far as there are any."""
        return next(filter(_exists, (self.obj, self.analysis_box.chosen())), None)

    def make_object(self):
        """A mesh object without cells, for refinements before the first mesh. Call inside a transaction."""
        if self.mesh_exists():
            return
        self.obj = objects.make(self.part.Document, self.part)
        analysis = self.analysis_box.chosen()
        if analysis and not analyses.other_meshes(analysis):
            analyses.move(self.obj, analysis)
        macro.made_empty(self.obj)

    def show_part(self):
        for obj in (self.part, shapes.solid_object(self.part)):
            obj.ViewObject.show()

    def show_part_alone(self):
        """For clicks on the part: the mesh stands where it does."""
        if self.part_exists():
            self.show_part()
        if self.mesh_exists():
            self.obj.ViewObject.hide()

    def show_mesh(self):
        """The mesh in place of the part."""
        self.obj.ViewObject.show()
        if self.part_exists():
            shapes.solid_object(self.part).ViewObject.hide()  # not its container, the mesh may be in that too

    def select(self, entities):
        """Shows CAD entities in the 3D view."""
        if entities and self.part_exists():
            self.show_part()
            FreeCADGui.Selection.clearSelection()
            top, path = shapes.selection_path(shapes.solid_object(self.part))
            for name in entities:
                FreeCADGui.Selection.addSelection(top, path + name)

    # --- what the panel shows -----------------------------------------------------------------------------------------------

    def tell(self, text, error=False):
        """The one line about what happened; it is in the log too."""
        self.form.run.tell(text, error)
        self.log(text, error)

    def log(self, text, error=False):
        self.form.run.write(time.monotonic() - self.started if self.started else None, text, error)
        (print_error if error else FreeCAD.Console.PrintLog)("Polycube: {}\n".format(text))

    def changed(self):
        """The user has changed an option."""
        if self._filling:
            return
        fineness = [self.field(name) for name in fields.FINENESS]
        used = [one for one in fineness if one.value != one.option["default"]]
        for one in fineness:
            one.widget.setEnabled(not used or one in used)
        self._show_hint()

    def _show_parameters(self):
        self.form.part.setText(self.part.Label if self.part else tr("none"))
        for form in self._forms:
            form.set_values(self.options)
        self.axes.set_labels(self.options.get("labels", {}))
        self.refine.set_open(bool(self.refine.form.values() or self.refine.refinements()))
        chosen, MeshPanel.shown_refinement = MeshPanel.shown_refinement, None
        self.refine.show_refinements(chosen and self.obj and self.obj.Document.getObject(chosen))

    def _show_hint(self):
        """What automatic is, and how many cells there will be."""
        try:
            shape = shapes.shape_of(self.part)
            if shape.isNull():
                return
            automatic = FreeCAD.Units.Quantity(prediction.size_of(shape, {}), FreeCAD.Units.Length).UserString
            lines = [tr("0 is automatic: near to {}").format(automatic)]
            expected = self._prediction(refinements.with_refinements(self._parameters(), self.obj if self.mesh_exists() else None))
        except InvalidInput:  # Apply tells
            return
        if expected:
            cells = tr("about {} cells").format(count(_rounded(expected.cells)))
            if expected.cells > 1.5 * expected.plain:
                cells = tr("up to {}, {} without local sizes").format(cells, count(_rounded(expected.plain)))
            lines.append(cells)
        self.form.size_hint.setText("\n".join(lines))

    def _prediction(self, options):
        if not self.part_exists():
            return None
        try:
            shape = shapes.shape_of(self.part)
        except InvalidInput:
            return None
        if self.mesh_exists() and self.obj.Hexahedra and objects.shape_is_meshed(self.obj):
            return prediction.predict_again(shape, options, json.loads(self.obj.MeshedOptions), self.obj.Hexahedra)
        return prediction.predict(shape, options)

    def _parameters(self):
        """The options as the panel shows them, without defaults. InvalidInput for what cannot be read."""
        found = {"labels": dict(self.axes.labels)} if self.axes.labels else {}
        for form in self._forms:
            found.update(form.values())
        return found


def _narrow_buttons():
    """OK, Cancel and Apply of FreeCAD's width, with icons, are wider than the dock as it opens it: they may shrink to their text.

    FreeCAD would hand the box to `modifyStandardButtons`, but as what PySide does not notice the end of; see MeshPanel.
    """
    for box in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox):
        if not box.isVisible() or not box.button(QtGui.QDialogButtonBox.Apply):
            continue
        for button in box.buttons():
            button.setIcon(QtGui.QIcon())
            button.setMinimumWidth(QtGui.QFontMetrics(button.font()).boundingRect(button.text()).width() + 16)
            button.setSizePolicy(QtGui.QSizePolicy.Preferred, QtGui.QSizePolicy.Fixed)


def _rounded(number):
    """Two digits are known of a prediction, not more."""
    number = round(number)
    return round(number, 2 - len(str(number)))


def _agreed(question):
    buttons = QtGui.QMessageBox.Yes | QtGui.QMessageBox.No
    return QtGui.QMessageBox.question(FreeCADGui.getMainWindow(), tr(_TITLE), question, buttons, QtGui.QMessageBox.No) == QtGui.QMessageBox.Yes
