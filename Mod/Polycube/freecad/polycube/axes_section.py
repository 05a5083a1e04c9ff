"""The panel's section "Axes of faces": which direction each face takes in the blocks of the mesh, shown on the part and changed by clicks."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

from . import engine, label_view, shapes
from .errors import InvalidInput
from .fields import OptionForm
from .folding import Section
from .words import tr


class AxesSection(Section):
    """`labels`: axes set by hand, {"Face3": "+X"}. The panel runs the mesher: it calls `show` with what `panel.start_labels()` made."""

    def __init__(self, panel, frame_options):
        super().__init__(tr("Axes of faces"), "axes", is_open=False, tooltip=tr("The direction that each face takes in the block structure of the mesh"))
        self._panel = panel
        self.labels = {}
        self.shown = self.overlay = self.clicks = None
        self._automatic = {}  # labels of faces before they were set by hand, as far as is known
        self._is_old = False
        self._mesh_was_visible = False
        self._shape = None  # signature of what the labels are of that were asked for last
        self._fits = False  # whether the view is to take in what is drawn next
        self.preview = QtGui.QCheckBox(tr("Show on the part"))
        self.preview.setToolTip(tr("Paints each face by its axis; a click on a face gives it another one"))
        self.beside = QtGui.QCheckBox(tr("Polycube beside the part"))
        self.beside.setToolTip(tr("Draws what the axes straighten the part into; it takes some seconds more"))
        self.key = QtGui.QLabel(label_view.key())
        self.key.setWordWrap(True)
        self.key.setVisible(False)
        self.given = QtGui.QListWidget()
        self.given.setMaximumHeight(60)
        self.given.setMinimumWidth(60)
        self.given.setToolTip(tr("Axes set by hand"))
        self.given.setSelectionMode(QtGui.QAbstractItemView.ExtendedSelection)
        self.automatic = QtGui.QPushButton(tr("Automatic"))
        self.automatic.setToolTip(tr("Gives up the axes that are selected in the list, all if none is"))
        self.form = OptionForm(frame_options, self._frame_changed)
        row = QtGui.QHBoxLayout()
        row.addWidget(self.given)
        row.addWidget(self.automatic)
        for widget in (self.preview, self.beside, self.key, self.told):
            self.body.addWidget(widget)
        self.body.addLayout(row)
        self.body.addWidget(self.form)
        self.preview.toggled.connect(self._preview)
        self.beside.toggled.connect(self._beside)
        self.automatic.clicked.connect(self._give_up)

    def set_labels(self, labels):
        self.labels = dict(labels)
        self._list()
        if labels:
            self.set_open(True)

    # --- the preview -----------------------------------------------------------------------------------------------------

    def _preview(self, wanted):
        self.key.setVisible(wanted)
        if not wanted:
            self.beside.setChecked(False)
            self.say("")
            self.end()
            return
        panel = self._panel
        if not panel.part_exists():
            return
        panel.result.show_whole()
        self._mesh_was_visible = panel.mesh_exists() and panel.obj.ViewObject.isVisible()
        panel.show_part()
        if panel.mesh_exists():
            panel.obj.ViewObject.hide()
        beside = panel.beside()
        self.overlay = label_view.LabelOverlay(panel.part.Document, shapes.standing(beside) if beside else FreeCAD.Placement())
        self.clicks = label_view.FaceClicks(shapes.solid_object(panel.part), lambda face: self.face_clicked(face))
        self.update()

    def end(self):
        """Nothing of the preview stays; a mesh that it hid is shown again."""
        self._is_old = False
        if self.clicks:
            self.clicks.remove()
        if self.overlay and self._panel.document_is_open():
            self.overlay.remove()
        if self.overlay and self._mesh_was_visible and self._panel.mesh_exists():
            self._panel.show_mesh()
        self._mesh_was_visible = False
        self.clicks = self.overlay = self.shown = None

    def update(self):
        """Computes the labels anew, after what runs now."""
        self._is_old = True
        self._shape = self._signature()
        if not self._panel.process:
            self._is_old = False
            self._panel.start_labels(self.beside.isChecked())

    def _signature(self):
        try:
            return shapes.signature(shapes.shape_of(self._panel.part)) if self._panel.part_exists() else None
        except InvalidInput:
            return None

    def follow(self):
        """The part may be another: labels of what it was go."""
        if not self.preview.isChecked():
            return
        now = self._signature()
        if now is None:
            self.preview.setChecked(False)
        elif self._shape is not None and not shapes.same(self._shape, now):
            self.update()

    def _beside(self, wanted):
        """With the polycube, or without it again. It is drawn where the labels are."""
        self._fits = wanted
        if wanted and not self.preview.isChecked():
            self.preview.setChecked(True)
        elif self.preview.isChecked():
            self.update()

    def catch_up(self):
        """Something has ended: labels that are old are computed now."""
        if self._is_old and self.preview.isChecked():
            self.update()

    def show_labels(self, labels):
        """Shows a LabelResult; returns a line that says what came out, and whether it is good."""
        self.shown = labels
        if self.overlay:
            self.overlay.show(labels)
            if self._fits and labels.image is not None:
                self._fits = False
                FreeCADGui.SendMsgToActiveView("ViewFit")
        lost = sum(fate == "lost" for fate, _ in labels.edges.values())
        line = tr("{} charts, {}, {} turning points, {} CAD edges not captured.").format(
            labels.chart.max() + 1, tr("valid") if labels.valid else tr("not valid"), len(labels.turning_points), lost
        )
        if not labels.valid:
            line += " " + tr("No blocks can be made with these axes: give other faces other axes, or make some automatic again.")
        self.say(line)
        return line, labels.valid

    # --- clicks ----------------------------------------------------------------------------------------------------------

    def face_clicked(self, face):
        """The next of the axes that the face can have, or automatic again."""
        if not self.shown:
            return
        names = engine.description()["label_names"]
        name = "Face{}".format(face)
        possible = self.shown.possible(face)
        given = names.index(self.labels[name]) if name in self.labels else None
        if given is None:
            self._automatic[face] = self.shown.face_label[face]
        label = label_view.next_label(given, self._automatic.get(face), possible)
        if not possible:
            line = tr("{} turns too far for any one axis.").format(name)
            self.say(line)
            self._panel.tell(line, error=True)
            return
        if label is None:
            del self.labels[name]
        else:
            self.labels[name] = names[label]
        self._panel.log("{}: {}".format(name, tr("automatic") if label is None else names[label]))
        self._changed()

    def _give_up(self):
        chosen = [item.text().split("=")[0] for item in self.given.selectedItems()] or list(self.labels)
        for name in chosen:
            del self.labels[name]
        if chosen:
            self._changed()

    def _frame_changed(self):
        self._panel.changed()
        if self.preview.isChecked():
            self.update()

    def _changed(self):
        self._list()
        self._panel.changed()
        if self.preview.isChecked():
            self.update()

    def _list(self):
        self.given.clear()
        self.given.addItems(["{}={}".format(*item) for item in sorted(self.labels.items(), key=lambda item: int(item[0][4:]))])
