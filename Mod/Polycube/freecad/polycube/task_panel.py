"""The task panel: options by task, the mesher in a child process, and what came out."""

import json
import time
import traceback

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import analyses, api, fem_mesh, fields, job, macro, objects, option_table, prediction, preferences, refinements, resources, shapes, typical, uncaptured
from .analysis_box import AnalysisBox
from .axes_section import AxesSection
from .cell_view import zoom
from .compat import print_error, qt_number
from .errors import Cancelled, InvalidInput, PolycubeError, StageFailed
from .folding import Section
from .following import Follower
from .refine_section import RefineSection
from .result_section import ResultSection
from .run import LiveSession, Run
from .run_section import RunSection, stage_words
from .size_hint import SizeHint
from .solving_section import SolvingSection
from .words import count, decimal, noop, tr

_TITLE = noop("Hexahedral mesh")
#: What may help where a stage fails, by the stage; what a button does is added below the line.
_TRY = {
    "label": noop("Try other axes of faces, or another frame."),
    "deform": noop("Try other axes of faces, or a finer size."),
    "quantize": noop("Try without one of the demands that are named."),
    "fit": noop("Try a finer size, more effort, or give up smooth edges (Feature angle)."),
}
_TRY_ELSE = noop("Try a finer size, more effort, or other axes of faces.")
_WAYS = {"label": ("axes",), "deform": ("axes", "finer"), "quantize": (), "fit": ("finer", "effort", "smooth")}
_WAYS_ELSE = ("finer", "effort", "axes")
#: Of a size that was too coarse, and degrees of edges that are given up; the guide advises 10 to 20.
_FINER, _SMOOTH = 0.7, 15.0
#: FreeCAD's themes have paddings with which numbers and buttons are cut off in a dock of 280 pixels.
_CLOSER = """
QAbstractSpinBox, QComboBox { padding-left: 1px; padding-right: 1px; margin-left: 0px; margin-right: 0px; }
QAbstractSpinBox > QLineEdit { padding: 0px; margin: 0px; border: 0px; }
"""
_CLOSER_BUTTON = "padding-left: 2px; padding-right: 2px; margin-left: 1px; margin-right: 1px; min-width: 0px;"
#: Lines that the panel has room for of what the mesh will not have.
_LISTED = 6


class MeshPanel:
    """Apply runs the mesher, Cancel stops it, OK is refused while it runs.

    The document changes once, when the mesh is there; without a mesh object, one is made then. The widgets are made here, not by FreeCAD's loader: PySide
    does not notice the end of those, and would take the next widget at that address for the old one.
    """

    _running = None  # the one panel that meshes at present: FreeCAD shows one task panel at a time
    _form = None
    shown_refinement = None  # name of the refinement that the next panel is to show

    def __init__(self, part, obj=None, analysis=None, together=None):
        self.part, self.obj = part, obj
        self._together = together  # the PutTogether of a part that was made for this panel
        self.document_name = part.Document.Name if part else obj.Document.Name
        self.process = None  # the Run or Request, while there is one
        self._session = None  # the LiveSession, once labels or a count were asked for
        self.started = 0.0
        self._shown_before = None  # what show_mesh_alone() has changed: whether the mesh was shown, and the meshes of results that were
        self._taking = self._apply_next = False
        self._filling = True
        self._seen = {}  # what of the document the panel has taken note of, see follow()
        self._meshed_options, self._asked, self._meshed_shape, self._before = {}, {}, [], {}
        self.options = option_table.read(obj) if obj else preferences.panel_defaults()
        self.analysis_box = AnalysisBox(FreeCAD.getDocument(self.document_name), objects.analysis_of(obj) if obj else None, analysis)
        self.analysis = self.analysis_box.chosen()  # that of the mesh that is made
        self.form = self._make_form()
        self.show_uncaptured()
        self._show_parameters()
        self._filling = False
        self.result.show_mesh()
        self.changed()
        self.note()
        FreeCAD.addDocumentObserver(self)
        self._follower = Follower(self)
        QtCore.QTimer.singleShot(0, _prepare_buttons)

    def _make_form(self):
        form = QtGui.QWidget()
        if QtGui.QApplication.instance().styleSheet():
            form.setStyleSheet(_CLOSER)
        form.setWindowTitle(tr(_TITLE))
        form.setWindowIcon(QtGui.QIcon(resources.icon("Polycube_MeshFromShape")))
        options = option_table.document_options()
        advanced = [option for option in options if option["advanced"] and not fields.is_of_places(option)]
        places = [option for option in options if fields.is_of_places(option) and option["type"] not in ("labels", "frame")]
        plain = [option for option in options if not option["advanced"] and not fields.is_of_places(option)]
        form.parameters = QtGui.QWidget()
        form.part = QtGui.QLabel()
        form.part.setWordWrap(True)
        form.part.setTextFormat(QtCore.Qt.PlainText)
        size = Section(tr("Size"), "size_section")
        self.size_form = fields.OptionForm(plain, self.changed)
        self.hint = SizeHint(self)
        form.size_hint = self.hint.label
        size.body.addWidget(self.size_form)
        size.body.addWidget(self.hint)
        self.axes = AxesSection(self, [option for option in options if option["type"] == "frame"])
        self.refine = RefineSection(self, places)
        self.advanced = Section(tr("Advanced"), "advanced_section", is_open=False)
        self.advanced_form = fields.OptionForm(advanced, self.changed)
        self.advanced.body.addWidget(self.advanced_form)
        self.solving = SolvingSection(objects.solving_of(self.obj))
        self._forms = (self.size_form, self.axes.form, self.refine.form, self.advanced_form)
        head = QtGui.QFormLayout()
        head.addRow(QtGui.QLabel(tr("Part:")), form.part)
        head.addRow(QtGui.QLabel(tr("Analysis:")), self.analysis_box)
        form.uncaptured = QtGui.QLabel()
        form.uncaptured.setWordWrap(True)
        form.uncaptured.setTextFormat(QtCore.Qt.PlainText)
        head.addRow(form.uncaptured)
        self.analysis_box.currentIndexChanged.connect(lambda _: self.show_uncaptured())
        parameters = QtGui.QVBoxLayout(form.parameters)
        parameters.setContentsMargins(0, 0, 0, 0)
        parameters.addLayout(head)
        for section in (size, self.axes, self.refine, self.advanced, self.solving):
            parameters.addWidget(section)
        form.run = RunSection()
        form.run.best.clicked.connect(self.take_the_best)
        form.log, form.status, form.progress, form.time = form.run.log, form.run.status, form.run.progress, form.run.time
        self.result = ResultSection(self)
        layout = QtGui.QVBoxLayout(form)
        layout.setContentsMargins(0, 0, 0, 0)
        for widget in (form.run, form.parameters, self.result, form.run.log_fold):
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
        """The mesh object gets options, analysis and way of solving of the panel, without being meshed, where they are others."""
        options, before = self._parameters(), option_table.read(self.obj)
        analysis, held_by = self.analysis_box.chosen(), objects.analysis_of(self.obj)
        if options == before and analysis == held_by and self.solving.values() == objects.solving_of(self.obj):
            return
        with api.transaction(self.obj.Document, tr("Mesh parameters")):
            option_table.write(self.obj, options)
            analyses.move(self.obj, analysis)
            solving = objects.set_solving(self.obj, self.solving.values())
        macro.set_options(self.obj, before, options)
        macro.set_solving(self.obj, solving)
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
        if self.process and self.process.what != "mesh":
            self._apply_next = True  # a preview is no reason to wait
            self.cancel()
            return
        if self.process or self._taking:
            self.tell(tr("The mesher is running already."), error=True)
            return
        self.form.log.clear()
        self.show_uncaptured()
        self.obj = self.obj if self.mesh_exists() else None
        self.analysis = self.analysis_box.chosen()
        try:
            self._meshed_options = self._parameters()
            self._asked = self.asked()
            self._before = option_table.read(self.obj) if self.obj else {}
        except InvalidInput as error:
            self.tell(str(error), error=True)
            self._show_run()
            return
        if self._nothing_has_changed():
            self._keep_parameters()
            self.note()
            self.tell(tr("Nothing has changed since this mesh was made."))
            return
        if not self._may_go_on():
            return
        self._start("mesh", self._asked, tr("Meshing"))

    def _nothing_has_changed(self):
        """Whether the mesher would make the mesh that there is. Of one whose search was ended early it might make another, of several materials other groups."""
        if not self.is_meshed_with(self._asked) or self.obj.MeshState != objects.CURRENT or self.analysis != objects.analysis_of(self.obj):
            return False
        report = json.loads(self.obj.Report)
        kept = report.get("options", {}).get("keep_faces", "")
        same_faces = set(kept.split(",")) == set((self.wanted().get("keep_faces") or "").split(","))
        materials = [member for member in self.analysis.Group if member.isDerivedFrom("App::MaterialObject")] if self.analysis else []
        groups_fit = not self.analysis or (objects.GROUPS_ARE_ASKED and len(materials) < 2)
        return same_faces and groups_fit and not report.get("search", {}).get("out_of_time", True)

    def _may_go_on(self):
        """Asks where the count of cells or the analysis would be a surprise."""
        expected = self.prediction(self._asked)
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

    def start_labels(self, with_polycube=False):
        """Computes the labels for the preview."""
        try:
            self._start("polycube" if with_polycube else "labels", self.asked(), tr("Labelling"))
        except InvalidInput as error:
            self.tell(str(error), error=True)

    def _start(self, what, options, words):
        """Starts the child process that makes "mesh", "labels" or "polycube"; _finished takes what it made."""
        self.started = time.monotonic()
        self.hint.stop()
        work = None
        try:
            if not self.part_exists():
                raise PolycubeError(tr("there is no part to mesh"))
            options = api.with_constraints(options, self.part, self.analysis_box.chosen())
            shape = shapes.shape_of(self.part, self.beside())
            shapes.check_solid(shape)
            if what == "mesh":
                self._meshed_shape = shapes.signature(shape)
                work = job.Job(shape, options, what, shapes.solid_labels(self.part))
                self.process = Run(work, self._heard, self._show_time, self._finished)
            else:
                self.process = self.live_session(options).ask(what, options, self._heard, self._show_time, self._finished)
        except (PolycubeError, OSError) as error:
            if work:
                work.close()
            self._fail(error)
            return
        MeshPanel._running = self
        if what == "mesh":
            self._show_run()
        self.form.parameters.setEnabled(False)
        self.form.run.begin("{} {} ...".format(words, self.part.Label), typical.seconds(self.obj, shape) if what == "mesh" else None)
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
        self.form.run.show_time(seconds)

    def _finished(self, made, error):
        what, self.process = self.process.what, None
        MeshPanel._running = None
        apply_next, self._apply_next = self._apply_next, False
        if self._form is None:  # closed meanwhile
            return
        taken = time.monotonic() - self.started
        self.form.run.show_time(taken, ended=True)
        self.form.run.end()
        self.form.parameters.setEnabled(True)
        if apply_next and what != "mesh":
            self.apply()
            return
        try:
            if error:
                raise error
            if what == "mesh" and self.part_exists():
                typical.learn(shapes.shape_of(self.part), taken)
            (self._take if what == "mesh" else self._show_labels)(made)
        except PolycubeError as failure:
            self._fail(failure)
        if self._form is not None:
            self.axes.catch_up()
            if not self.process:
                self.hint.show_estimate()

    def _fail(self, error):
        """Says what went wrong, where, and what may help."""
        text = str(error)
        if isinstance(error, StageFailed) and text.startswith(error.stage + ": "):
            text = stage_words(error.stage) + text[len(error.stage) :]
        self.log(text, error=True)
        if isinstance(error, Cancelled):
            text = text[0].upper() + text[1:] + "."
        elif isinstance(error, StageFailed):
            text = tr("Refused: {}.").format(text) + " " + tr(_TRY.get(error.stage, _TRY_ELSE))
            self.select(error.entities)
            self.look_at(error.entities)
            if self.part_exists():
                self.form.run.offer(self._ways_out(error.stage))
        self.form.run.tell(text, error=True)
        self._show_run()

    def _ways_out(self, stage):
        """Buttons for what may help: each sets an option and meshes again, the axes are shown to be clicked at."""
        shape, effort, angle = shapes.shape_of(self.part), self.field("effort"), self.field("feature_angle")

        def finer():
            hexes, size = self.field("hexes"), self.field("size")
            if hexes.value:
                hexes.value = round(hexes.value / _FINER**3)
            else:
                self.field("coarsest").value = False
                size.value = float("{:.2g}".format(_FINER * prediction.size_of(shape, self._parameters())))

        def more_effort():
            effort.value = effort.option["choices"][-1]

        def without_smooth_edges():
            angle.value = _SMOOTH

        def axes():
            self.axes.set_open(True)
            self.axes.preview.setChecked(True)

        def again(change):
            change()
            self.apply()

        ways = {"finer": (tr("A finer size"), lambda: again(finer)), "axes": (tr("Other axes of faces"), axes)}
        if effort.value != effort.option["choices"][-1]:
            ways["effort"] = (tr("More effort"), lambda: again(more_effort))
        if angle.value < _SMOOTH:
            ways["smooth"] = (tr("Smooth edges given up"), lambda: again(without_smooth_edges))
        return [ways[way] for way in _WAYS.get(stage, _WAYS_ELSE) if way in ways]

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
            self._shown_before = None
            warnings = self._put(result, mesh)
            self._breathe(1.0)
            if not self.mesh_exists() or self._form is None:
                return
            self.show_mesh()
            self.result.show_mesh(result)
            self.result.set_open(True)
        finally:
            QtGui.QApplication.restoreOverrideCursor()
            self._taking = False
        self.form.progress.setValue(100)
        for line in warnings:
            self._write(tr("Warning: ") + line, error=True)
        text = tr("Meshed: {} cells, {} nodes, worst cell {}.").format(count(len(result.hexes)), count(len(result.nodes)), decimal(self.obj.MinScaledJacobian, 2))
        if warnings:
            text += " " + (warnings[0] if len(warnings) == 1 else tr("{} warnings, see the log: {} ...").format(len(warnings), warnings[0]))
        self.form.run.tell(text)
        self._write(text)
        FreeCAD.Console.PrintMessage("Polycube: {}\n".format(text))

    def _put(self, result, mesh):
        """Object, mesh and place in the analysis; returns warnings."""
        document = FreeCAD.getDocument(self.document_name)
        self.obj = self.obj if self.mesh_exists() else None
        analysis = self.analysis if shapes.exists(self.analysis) else None
        is_new = self.obj is None
        with api.transaction(document, tr("Hexahedral mesh from shape") if is_new else tr(_TITLE)):
            if is_new:
                self.obj = objects.make(document, self.part)
            held_by = objects.analysis_of(self.obj)
            for other in analyses.other_meshes(analysis, self.obj) if analysis else []:
                analysis.removeObject(other)
                other.ViewObject.hide()
            analyses.move(self.obj, analysis)
            solving = objects.set_solving(self.obj, self.solving.values())
            warnings = objects.set_mesh(self.obj, result, self._meshed_options, self._meshed_shape, mesh, self._asked)
        self.note()
        if is_new:
            self._record_part()
            macro.created(self.obj, self._meshed_options)
        else:
            macro.updated(self.obj, self._before, self._meshed_options)
        macro.set_solving(self.obj, solving)
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
        self.hint.counts = True  # what a count takes longest for is there
        self.show_uncaptured()
        self.form.progress.setValue(100)
        self.tell(line, error=not good)

    def _end(self):
        """Nothing goes on that the panel has begun, and its marks go."""
        FreeCAD.removeDocumentObserver(self)
        self._follower.end()
        if self.process:
            process = self.process
            self.cancel()
            process.wait()  # it was killed; _finished is called here
        self.hint.stop()
        if self._session:
            self._session.close()
        self.axes.end()
        self.result.clear()
        self._show_as_before()

    def _close(self):
        gui_document = FreeCADGui.getDocument(self.document_name) if self.document_is_open() else None
        if gui_document and gui_document.getInEdit():
            gui_document.resetEdit()
        else:
            FreeCADGui.Control.closeDialog()
        if self._together:
            QtCore.QTimer.singleShot(0, self._together.take_back)
        return True

    # --- the document changes meanwhile --------------------------------------------------------------------------------------

    def is_at_work(self):
        """Whether the panel changes the document itself just now, or is in the middle of showing cells."""
        return self._taking or self.result.is_at_work()

    def _state(self):
        """What of the document the panel shows, but for what its sections compare themselves."""
        has_mesh = self.mesh_exists()
        try:
            options = option_table.read(self.obj) if has_mesh else None
        except InvalidInput:  # Apply tells
            options = None
        return {
            "options": options,
            "analysis": objects.analysis_of(self.obj) if has_mesh else None,
            "solving": objects.solving_of(self.obj) if has_mesh else None,
            "part": self.part.Label if self.part_exists() else tr("none"),
        }

    def note(self):
        """What the document holds now is what the panel has given it: nothing to be followed."""
        self._seen = self._state()

    def follow(self, shape_may_differ):
        """Undo, the tree, the property editor or a macro has changed something: what is shown of it is shown anew. What the user has typed meanwhile stays."""
        now, before = self._state(), self._seen
        self._seen = now
        self.form.part.setText(now["part"])
        self._filling = True
        if now["options"] is not None and now["options"] != before["options"]:
            self._follow_options(before["options"] or {}, now["options"])
        self._filling = False
        if now["solving"] and now["solving"] != before["solving"]:
            self.solving.show_values(now["solving"])
        self.analysis_box.follow(now["analysis"], now["analysis"] != before["analysis"])
        self.refine.follow()
        self.result.follow()
        if not self.process:
            self.show_uncaptured()
            if now != before or shape_may_differ:
                self.changed()
        if shape_may_differ:
            self.axes.follow()

    def _follow_options(self, before, now):
        """Fields of options that the object has others of than before."""
        for form in self._forms:
            for name, one in form.fields.items():
                if now.get(name) != before.get(name):
                    one.value = now.get(name, one.option["default"])
        if now.get("labels", {}) != before.get("labels", {}):
            self.axes.set_labels(now.get("labels", {}))

    # --- what sections ask ---------------------------------------------------------------------------------------------------

    def part_exists(self):
        return shapes.exists(self.part)

    def mesh_exists(self):
        return shapes.exists(self.obj)

    def document_is_open(self):
        return self.document_name in FreeCAD.listDocuments()

    def beside(self):
        """What the mesh will be beside: its object or its analysis, as far as there are any."""
        return next(filter(shapes.exists, (self.obj, self.analysis_box.chosen())), None)

    def live_session(self, options):
        """The session of the part as it is now, begun with these options where there is none yet. It is a process of its own until the panel is closed."""
        shape = shapes.shape_of(self.part, self.beside())
        shapes.check_solid(shape)
        key = (shapes.signature(shape), options.get("sew", True))
        if self._session and (self._session.has_ended() or self._session.key != key):
            self._session.close()
            self._session = None
        if not self._session:
            self._session = LiveSession(shape.copy(), options, key)
        return self._session

    def make_object(self):
        """A mesh object without cells, for refinements before the first mesh. Call inside a transaction."""
        if self.mesh_exists():
            return
        self.obj = objects.make(self.part.Document, self.part)
        analysis = self.analysis_box.chosen()
        if analysis and not analyses.other_meshes(analysis):
            analyses.move(self.obj, analysis)
        self._record_part()
        macro.made_empty(self.obj)

    def _record_part(self):
        if self._together:
            self._together.record()

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

    def show_mesh_alone(self):
        """The mesh, without results that stand in the same place, until the panel is closed without a new mesh."""
        if self._form is None or not self.mesh_exists():
            return
        analysis = objects.analysis_of(self.obj)
        results = [obj for obj in analyses.shown_results(analysis) if obj.ViewObject.isVisible()] if analysis else []
        self._shown_before = self.obj.ViewObject.isVisible(), results
        for obj in results:
            obj.ViewObject.hide()
        self.obj.ViewObject.show()

    def _show_as_before(self):
        if not self._shown_before or not self.document_is_open() or not self.mesh_exists():
            return
        was_shown, results = self._shown_before
        if not was_shown:
            self.obj.ViewObject.hide()
        for obj in filter(shapes.exists, results):
            obj.ViewObject.show()

    def select(self, entities):
        """Shows CAD entities in the 3D view, by themselves: the mesh stands where they do."""
        if entities and self.part_exists():
            self.show_part_alone()
            FreeCADGui.Selection.clearSelection()
            top, path = shapes.selection_path(shapes.solid_object(self.part))
            for name in entities:
                FreeCADGui.Selection.addSelection(top, path + name)

    def look_at(self, entities):
        """Has the 3D view look at CAD entities from near."""
        found = [name for name in entities if self.part_exists() and fem_mesh.exists(shapes.shape_of(self.part), name)]
        if found:
            shape = shapes.shape_of(self.part)
            boxes = [shape.getElement(name).BoundBox for name in found]
            zoom(self.part.Document, FreeCAD.Placement(), [box.getPoint(corner) for box in boxes for corner in range(8)], room=0)

    # --- what the panel shows -----------------------------------------------------------------------------------------------

    def tell(self, text, error=False):
        """The one line about what happened; it is in the log too."""
        self.form.run.tell(text, error)
        self.log(text, error)

    def _show_run(self):
        """Scrolls to what tells of the run, at the top of the panel, once it has its place."""
        QtCore.QTimer.singleShot(0, lambda: self._form and _scroll_up(self._form.run))

    def _write(self, text, error=False):
        self.form.run.write(time.monotonic() - self.started if self.started else None, text, error)

    def log(self, text, error=False):
        """A line in the panel's log; an error is one in FreeCAD's report view too."""
        self._write(text, error)
        (print_error if error else FreeCAD.Console.PrintLog)("Polycube: {}\n".format(text))

    def changed(self):
        """The user has changed an option."""
        if self._filling:
            return
        fineness = [self.field(name) for name in fields.FINENESS]
        used = [one for one in fineness if one.value != one.option["default"]]
        for one in fineness:
            one.widget.setEnabled(not used or one in used)
        self.hint.show_estimate()

    def show_uncaptured(self):
        """Lists what of the analysis the mesh will have no places for."""
        found = uncaptured.lines(self.part, self.analysis_box.chosen(), self.axes.shown) if self.part_exists() else []
        told = [tr("The mesh will not have:")] + found[:_LISTED] + ([tr("{} more").format(len(found) - _LISTED)] if len(found) > _LISTED else [])
        self.form.uncaptured.setText("\n\u2022 ".join(told))
        self.form.uncaptured.setToolTip("\n".join(found))
        self.form.uncaptured.setVisible(bool(found))

    def _show_parameters(self):
        self.form.part.setText(self.part.Label if self.part else tr("none"))
        for form in self._forms:
            form.set_values(self.options)
        self.axes.set_labels(self.options.get("labels", {}))
        self.refine.set_open(bool(self.refine.form.values() or self.refine.refinements()))
        chosen, MeshPanel.shown_refinement = MeshPanel.shown_refinement, None
        self.refine.show_refinements(chosen and self.obj and self.obj.Document.getObject(chosen))

    def prediction(self, options):
        """The prediction.Prediction of a mesh with these options, or None."""
        if not self.part_exists():
            return None
        try:
            shape = shapes.shape_of(self.part)
        except InvalidInput:
            return None
        if self.is_meshed_as_is():
            return prediction.predict_again(shape, options, json.loads(self.obj.MeshedOptions), self.obj.Hexahedra)
        return prediction.predict(shape, options)

    def is_meshed_as_is(self):
        """Whether the mesh there is is one of the part as it is now, with whatever options."""
        return self.mesh_exists() and bool(self.obj.Hexahedra) and objects.shape_is_meshed(self.obj)

    def is_meshed_with(self, options):
        """Whether the mesh there is is one of the part as it is now with these options."""
        return self.is_meshed_as_is() and json.loads(self.obj.MeshedOptions) == json.loads(json.dumps(options))

    def asked(self):
        """The options as the panel shows them, with what the refinements ask for. InvalidInput for what cannot be read."""
        return refinements.with_refinements(self._parameters(), self.obj if self.mesh_exists() else None)

    def wanted(self):
        """These with the faces that carry constraints, as the mesher gets them."""
        return api.with_constraints(self.asked(), self.part, self.analysis_box.chosen())

    def _parameters(self):
        """The options as the panel shows them, without defaults. InvalidInput for what cannot be read."""
        found = {"labels": dict(self.axes.labels)} if self.axes.labels else {}
        for form in self._forms:
            found.update(form.values())
        return found


def _scroll_up(widget):
    """Shows the top of the panel with this widget. Looked for from above: PySide takes a widget for gone when the parent goes that it was asked for, though that is but a name for what lives on."""
    for area in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea):
        if area.isAncestorOf(widget):
            area.verticalScrollBar().setValue(0)


def _prepare_buttons():
    """OK, Cancel and Apply of FreeCAD's width, with icons, are wider than the dock as it opens it: they may shrink to their text.

    Enter presses Apply, not OK, which would close the panel over a size that was just typed.

    FreeCAD would hand the box to `modifyStandardButtons`, but as what PySide does not notice the end of; see MeshPanel.
    """
    for box in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox):
        if not box.isVisible() or not box.button(QtGui.QDialogButtonBox.Apply):
            continue
        for button in box.buttons():
            button.setIcon(QtGui.QIcon())
            if QtGui.QApplication.instance().styleSheet():
                button.setStyleSheet(_CLOSER_BUTTON)
            button.setMinimumWidth(QtGui.QFontMetrics(button.font()).boundingRect(button.text()).width() + 16)
            button.setSizePolicy(QtGui.QSizePolicy.Preferred, QtGui.QSizePolicy.Fixed)
            button.setDefault(button is box.button(QtGui.QDialogButtonBox.Apply))


def _agreed(question):
    buttons = QtGui.QMessageBox.Yes | QtGui.QMessageBox.No
    return QtGui.QMessageBox.question(FreeCADGui.getMainWindow(), tr(_TITLE), question, buttons, QtGui.QMessageBox.No) == QtGui.QMessageBox.Yes
