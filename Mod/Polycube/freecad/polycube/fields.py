"""Editors of the mesher's options, made from its table: an option that the table gets is in the panel without a line of code."""

import FreeCADGui
from PySide import QtCore, QtGui

from . import option_table
from .words import noop, tr

#: Names of options in the panel where the plain words of the option's name would not be those of the field.
_TITLES = {
    "size": noop("Element size"),
    "hexes": noop("Target cells"),
    "order": noop("Element order"),
    "min_layers": noop("Layers in walls"),
    "per_circle": noop("Round circles"),
    "max_size": noop("Largest size"),
    "sew": noop("Sew faces"),
    "frame": noop("Directions of X, Y"),
    "sizes": noop("Local sizes"),
    "refine": noop("Local refinement"),
}
_ORDERS = [noop("1st"), noop("2nd")]
_UNITS = {"mm": "mm", "degrees": "deg"}
#: Only one of them can say how fine the mesh is; the engine refuses more.
FINENESS = ("size", "hexes", "coarsest")
_MOST = 2**31 - 1


def is_of_places(option):
    """Whether an option names places on the part, in text of its own form."""
    return option["type"] not in ("bool", "int", "double", "string")


def title(option):
    name = option["name"]
    return tr(_TITLES.get(name) or name.replace("_", " ").capitalize())


def field(option, changed):
    """The Field for an option; `changed()` is called when the user has changed it."""
    if option["type"] == "bool":
        return _Truth(option, changed)
    if option["choices"]:
        return _Choice(option, changed)
    if option["type"] == "double" and option["unit"] in _UNITS:
        return _Quantity(option, changed)
    return {"double": _Number, "int": _Whole}.get(option["type"], _Text)(option, changed)


class Field:
    """One option's widget: title, tooltip, bounds and unit of the table. `value` is in the option's unit, the default where it was not touched."""

    def __init__(self, option, widget):
        self.option, self.widget = option, widget
        widget.setObjectName(option["name"])
        widget.setToolTip(self._tooltip())
        # a dock may be 280 pixels wide
        widget.setMinimumWidth(60)
        widget.setSizePolicy(QtGui.QSizePolicy.Expanding, QtGui.QSizePolicy.Fixed)

    def _tooltip(self):
        option = self.option
        text = tr(option["meaning"])
        if option["type"] in ("int", "double") and option["max"] > option["min"] and not option["choices"]:
            text += " " + tr("From {} to {}{}.").format(_short(option["min"]), _short(option["max"]), " " + option["unit"] if option["unit"] else "")
        return "<p>{}</p><p><i>{}</i></p>".format(text, option_table.property_name(option))


def _short(number):
    return "{:g}".format(number)


class _Quantity(Field):
    """A length or an angle, with FreeCAD's units and expressions."""

    def __init__(self, option, changed):
        super().__init__(option, FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox"))
        self.widget.setProperty("unit", _UNITS[option["unit"]])
        self.widget.setProperty("minimum", option["min"])
        self.widget.setProperty("maximum", option["max"])
        QtCore.QObject.connect(self.widget, QtCore.SIGNAL("valueChanged(double)"), lambda _: changed())
        QtCore.QObject.connect(self.widget, QtCore.SIGNAL("editingFinished()"), self._show_what_is_meant)

    def _show_what_is_meant(self):
        """FreeCAD reads 5,5 as 55 where the comma groups digits, and goes on showing 5,5."""
        if QtCore.QLocale().groupSeparator() in self.widget.findChild(QtGui.QLineEdit).text():
            self.value = self.value

    @property
    def value(self):
        return float(self.widget.property("rawValue"))

    @value.setter
    def value(self, value):
        self.widget.setProperty("rawValue", float(value))


class _Spin(Field):
    """A number in a spin box."""

    @property
    def value(self):
        return self.widget.value()

    @value.setter
    def value(self, value):
        self.widget.setValue(value)


class _Number(_Spin):
    def __init__(self, option, changed):
        super().__init__(option, QtGui.QDoubleSpinBox())
        self.widget.setRange(option["min"], option["max"])
        self.widget.setDecimals(3)
        self.widget.setSuffix(" " + option["unit"] if option["unit"] else "")
        if option["default"] == option["min"] == 0:
            self.widget.setSpecialValueText(tr("none"))
        self.widget.valueChanged.connect(lambda _: changed())


class _Whole(_Spin):
    def __init__(self, option, changed):
        super().__init__(option, QtGui.QSpinBox())
        self.widget.setRange(int(option["min"]), int(min(option["max"], _MOST)))
        if option["max"] > 100000:
            self.widget.setSingleStep(500)
        if option["default"] == option["min"] == 0:
            self.widget.setSpecialValueText(tr("automatic"))
        self.widget.valueChanged.connect(lambda _: changed())


class _Choice(Field):
    def __init__(self, option, changed):
        super().__init__(option, QtGui.QComboBox())
        self._values = [int(choice) if option["type"] == "int" else choice for choice in option["choices"]]
        self.widget.addItems([tr(choice) for choice in (_ORDERS if option["name"] == "order" else option["choices"])])
        self.widget.currentIndexChanged.connect(lambda _: changed())

    @property
    def value(self):
        return self._values[self.widget.currentIndex()]

    @value.setter
    def value(self, value):
        self.widget.setCurrentIndex(self._values.index(value))


class _Truth(Field):
    def __init__(self, option, changed):
        super().__init__(option, QtGui.QCheckBox())
        self.widget.toggled.connect(lambda _: changed())

    @property
    def value(self):
        return self.widget.isChecked()

    @value.setter
    def value(self, value):
        self.widget.setChecked(value)


class _Text(Field):
    """Places on the part with what is wanted there, as on the command line."""

    def __init__(self, option, changed):
        super().__init__(option, QtGui.QLineEdit())
        self.widget.setClearButtonEnabled(True)
        self.widget.editingFinished.connect(changed)

    @property
    def value(self):
        return option_table.from_text(self.option, self.widget.text())

    @value.setter
    def value(self, value):
        self.widget.setText(option_table.as_text(self.option, value))


class OptionForm(QtGui.QWidget):
    """Fields for some options below each other: title on the left where there is room, above the field otherwise."""

    def __init__(self, options, changed):
        super().__init__()
        layout = QtGui.QFormLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setRowWrapPolicy(QtGui.QFormLayout.DontWrapRows)
        layout.setFieldGrowthPolicy(QtGui.QFormLayout.AllNonFixedFieldsGrow)
        self.fields = {}
        for option in options:
            made = field(option, changed)
            self.fields[option["name"]] = made
            label = QtGui.QLabel(title(option))
            label.setToolTip(made.widget.toolTip())
            layout.addRow(label, made.widget)

    def values(self):
        """{name: value} of what is not at its default."""
        found = {}
        for name, one in self.fields.items():
            value = one.value
            if value != one.option["default"] and value not in ({}, [], ""):
                found[name] = value
        return found

    def set_values(self, options):
        for name, one in self.fields.items():
            one.value = options.get(name, one.option["default"])
