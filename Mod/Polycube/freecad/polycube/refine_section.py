"""The panel's section "Refine": what is asked of the mesh at places of the part, as objects in the tree, made from the selection in the 3D view."""

import FreeCADGui
from PySide import QtCore, QtGui

from . import api, macro, option_table, prediction, refinements, shapes
from .errors import InvalidInput
from .fields import OptionForm
from .folding import Section
from .words import tr

_WHAT, _WHERE, _VALUE = range(3)


class _ValueEditor(QtGui.QStyledItemDelegate):
    """Edits values in the table: a choice where there are few, a number within its bounds where they are known, else text."""

    def __init__(self, section):
        super().__init__(section.table)
        self._section = section

    def createEditor(self, parent, option, index):
        obj = self._section.of_row(index.row())
        if obj is None:
            return None
        kind_of_property, _, default, _ = refinements.kind_of(obj).value
        if kind_of_property == "App::PropertyEnumeration":
            editor = QtGui.QComboBox(parent)
            editor.addItems(default)
            return editor
        if kind_of_property == "App::PropertyIntegerConstraint":
            editor = QtGui.QSpinBox(parent)
            editor.setRange(*default[1:3])
            return editor
        return super().createEditor(parent, option, index)


class RefineSection(Section):
    """A table of the refinements of `panel.obj`: on or off, where, how much. Below it the same as text, for what objects cannot say."""

    def __init__(self, panel, options):
        tooltip = tr("Other sizes and numbers of cells at places of the part")
        super().__init__(tr("Refine"), "refine_section", is_open=False, tooltip=tooltip)
        self._panel = panel
        self._filling = False
        self._objects, self._shown = [], []  # what the table's rows show
        self.table = QtGui.QTableWidget(0, 3)
        self.table.setHorizontalHeaderLabels([tr("What"), tr("Where"), tr("Value")])
        self.table.setMinimumSize(60, 90)
        self.table.setMaximumHeight(140)
        self.table.setToolTip(tr("A tick has the mesh obey; a double click changes the value; the chosen row's places are selected in the 3D view"))
        self.table.setSelectionBehavior(QtGui.QAbstractItemView.SelectRows)
        self.table.setSelectionMode(QtGui.QAbstractItemView.SingleSelection)
        self.table.verticalHeader().setVisible(False)
        for column in (_WHAT, _WHERE):  # the value is to be seen in a narrow dock; tooltips have the rest
            self.table.horizontalHeader().setSectionResizeMode(column, QtGui.QHeaderView.Stretch)
        self.table.horizontalHeader().setSectionResizeMode(_VALUE, QtGui.QHeaderView.ResizeToContents)
        self.table.setItemDelegateForColumn(_VALUE, _ValueEditor(self))
        self.add_button = QtGui.QToolButton()
        self.add_button.setText(tr("Add"))
        self.add_button.setToolTip(tr("At the faces, edges or vertices that are selected in the 3D view, or solids in the tree"))
        self.add_button.setPopupMode(QtGui.QToolButton.InstantPopup)
        menu = QtGui.QMenu(self.add_button)
        for kind in refinements.KINDS.values():
            action = menu.addAction(tr(kind.title))
            action.setToolTip(tr(kind.meaning))
            action.setObjectName(kind.name)
            action.triggered.connect(lambda *_, name=kind.name: self.add(name))
        menu.aboutToShow.connect(self._offer)
        self.add_button.setMenu(menu)
        self.remove_button = QtGui.QToolButton()
        self.remove_button.setText(tr("Remove"))
        self.as_objects = QtGui.QToolButton()
        self.as_objects.setText(tr("From text"))
        self.as_objects.setToolTip(tr("Makes objects of the text below, as documents of older versions have it"))
        buttons = QtGui.QHBoxLayout()
        for button in (self.add_button, self.remove_button, self.as_objects):
            buttons.addWidget(button)
        buttons.addStretch()
        self.form = OptionForm(options, panel.changed)
        self.body.addWidget(self.table)
        self.body.addLayout(buttons)
        self.body.addWidget(self.told)
        self.body.addWidget(self.form)
        self.table.itemChanged.connect(self._edited)
        self.table.itemSelectionChanged.connect(self._show_places)
        self.remove_button.clicked.connect(self._remove)
        self.as_objects.clicked.connect(self._text_to_objects)

    def show_refinements(self, chosen=None):
        """The table anew; the row of the object `chosen` is chosen."""
        found = self._objects = self.refinements()
        self._shown = self._state()
        self._filling = True
        self.table.setRowCount(len(found))
        for row, obj in enumerate(found):
            what = QtGui.QTableWidgetItem(obj.Label)
            what.setFlags(QtCore.Qt.ItemIsEnabled | QtCore.Qt.ItemIsSelectable | QtCore.Qt.ItemIsUserCheckable)
            what.setCheckState(QtCore.Qt.Unchecked if obj.Suppressed else QtCore.Qt.Checked)
            where = QtGui.QTableWidgetItem(", ".join(refinements.places_of(obj)))
            where.setFlags(QtCore.Qt.ItemIsEnabled | QtCore.Qt.ItemIsSelectable)
            value = QtGui.QTableWidgetItem(refinements.value_of(obj))
            if not refinements.kind_of(obj).value:
                value.setFlags(QtCore.Qt.ItemIsEnabled | QtCore.Qt.ItemIsSelectable)
            wrong = refinements.fault(obj)
            for column, item in enumerate((what, where, value)):
                item.setToolTip(wrong or item.text())
                if wrong:
                    item.setIcon(self.style().standardIcon(QtGui.QStyle.SP_MessageBoxWarning) if column == _WHAT else QtGui.QIcon())
                self.table.setItem(row, column, item)
        self._filling = False
        if chosen in found:
            self.set_open(True)
            self.table.selectRow(found.index(chosen))

    def follow(self):
        """Refinements came, went, or ask for something else: the table anew, where it is not as they are."""
        if self._shown != self._state():
            chosen = self._chosen()
            self.show_refinements()
            if chosen in self._objects:
                self._filling = True  # it was chosen before, its places are selected already
                self.table.selectRow(self._objects.index(chosen))
                self._filling = False

    def _state(self):
        return [
            (obj.Name, obj.Label, obj.Suppressed, refinements.places_of(obj), refinements.value_of(obj), refinements.fault(obj)) for obj in self.refinements()
        ]

    def _chosen(self):
        """The refinement of the row that is chosen, or None."""
        row = self.table.currentRow()
        return self.of_row(row) if row >= 0 and self.table.selectedItems() else None

    def of_row(self, row):
        """The refinement that a row of the table shows, None of one that is gone."""
        obj = self._objects[row] if row < len(self._objects) else None
        return obj if shapes.exists(obj) else None

    def refinements(self):
        return [obj for obj in self._panel.obj.Refinements if refinements.is_refinement(obj)] if self._panel.mesh_exists() else []

    # --- changes: each is done and recorded ------------------------------------------------------------------------------

    def selected_places(self):
        """Names of faces, edges and vertices of the part that are selected in the 3D view, and of solids whose object is, where the part has several."""
        solid = shapes.solid_object(self._panel.part)
        owners = {solid.Name, self._panel.part.Name}
        body = solid.getParentGeoFeatureGroup()
        if body is not None and body.isDerivedFrom("PartDesign::Body"):
            owners.add(body.Name)
        chosen, several = [], len(shapes.numbered_shape(self._panel.part).Solids) > 1
        for selection in FreeCADGui.Selection.getSelectionEx():
            if selection.DocumentName == solid.Document.Name and selection.ObjectName in owners:
                chosen += [name for name in selection.SubElementNames if name not in chosen]
            if several and not selection.SubElementNames:
                chosen += ["Solid{}".format(number) for number in shapes.solids_in(self._panel.part, selection.Object, ())]
        return list(dict.fromkeys(chosen))

    def _offer(self):
        """Kinds that can be at what is selected."""
        places = self.selected_places() if self._panel.part_exists() else []
        self.say("")
        if not places:
            self._panel.show_part_alone()
            self.say(tr("Select faces, edges or vertices of the part in the 3D view, then press Add."))
        for action in self.add_button.menu().actions():
            kind = refinements.KINDS[action.objectName()]
            count = sum(name.startswith(kind.takes) for name in places)
            action.setEnabled(count == kind.count if kind.count else count > 0)

    def _refuse(self, error):
        self._panel.tell(str(error), error=True)
        self.say(str(error))

    def add(self, kind):
        """A refinement at what is selected, with a value to begin with; a mesh object without cells is made where there is none."""
        panel, takes = self._panel, refinements.KINDS[kind].takes
        if not panel.part_exists() or panel.process:
            return
        places = [name for name in self.selected_places() if name.startswith(takes)]
        try:
            with api.transaction(panel.part.Document, tr("Refinement")):
                panel.make_object()
                obj = api.refine(panel.obj, kind, places, self._first_value(kind))
        except InvalidInput as error:
            self._refuse(error)
            return
        macro.refined(obj, panel.obj)
        self.show_refinements(obj)
        panel.changed()

    def _first_value(self, kind):
        if kind == "size":
            shape = shapes.shape_of(self._panel.part)
            return float("{:.2g}".format(prediction.size_of(shape, self._panel.size_form.values()) / 2))
        return {"levels": 1, "divisions": "4", "layers": "3..", "bore": "16", "bias": 2.0, "axis": "+X"}.get(kind)

    def _edited(self, item):
        if self._filling:
            return
        obj = self.of_row(item.row())
        self.say("")
        if obj is None:
            self.show_refinements()
            return
        try:
            if item.column() == _WHAT:
                suppressed = item.checkState() == QtCore.Qt.Unchecked
                api.set_refinement(obj, suppressed=suppressed)
                macro.set_refinement(obj, suppressed=suppressed)
            elif item.column() == _VALUE:
                api.set_refinement(obj, item.text())
                macro.set_refinement(obj, value=item.text())
        except InvalidInput as error:
            self._refuse(error)
        self.show_refinements(obj)
        self._panel.changed()

    def _remove(self):
        obj = self._chosen()
        if obj is None:
            return
        with api.transaction(obj.Document, tr("Delete refinement")):
            FreeCADGui.doCommand("{}.removeObject({!r})".format(macro.document(obj.Document), obj.Name))
        self.show_refinements()
        self._panel.changed()

    def _show_places(self):
        obj = None if self._filling or self._panel.axes.clicks else self._chosen()
        if obj is not None:
            self._panel.select(refinements.places_of(obj))

    def _text_to_objects(self):
        """What faces and edges of the text stand for becomes objects; the rest stays text."""
        panel = self._panel
        if not panel.part_exists() or panel.process:
            return
        rest, made = {}, []
        try:
            with api.transaction(panel.part.Document, tr("Refinements of text")):
                panel.make_object()
                before = option_table.read(panel.obj)
                for name, text in self.form.values().items():
                    left = []
                    for item in text.split(","):
                        asked = _as_refinement(name, item)
                        if asked:
                            made.append(api.refine(panel.obj, *asked))
                        else:
                            left.append(item)
                    rest[name] = ",".join(left)
                now = option_table.without_defaults({**before, **rest})
                option_table.write(panel.obj, now)
            panel.note()
        except InvalidInput as error:
            self._refuse(error)
            return
        for obj in made:
            macro.refined(obj, panel.obj)
        macro.set_options(panel.obj, before, now)
        self.form.set_values({**self.form.values(), **rest})
        self.show_refinements()
        panel.changed()


def _as_refinement(option, item):
    """Kind, places and value for an item of an option's text; None for what no object can say, as a size along an axis."""
    what, _, value = item.partition("=")
    names = what.split("-")
    if option == "keep_faces":
        return "keep", [item], None
    if option == "sizes" and what.startswith(("Face", "Solid")):
        return "size", [what], value
    if option == "refine" and what.startswith(refinements.KINDS["levels"].takes):
        return "levels", [what], value
    if option in ("divisions", "bias") and what.startswith("Edge"):
        return option, [what], value
    if option == "divisions" and len(names) == 2:
        return "layers", names, value
    return None
