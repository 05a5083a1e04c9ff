"""The panel's part that says how Solve with CalculiX solves the mesh: by which element, with which stresses."""

from PySide import QtGui

from . import objects
from .folding import Section
from .words import noop, tr

#: Names of the properties, and of what they may be where that is not the name of an element.
_NAMES = {objects.ELEMENT: noop("Element"), objects.STRESSES: noop("Stresses")}
_CHOICES = {"Default": noop("Default"), "recovered": noop("Recovered from the integration points"), "calculix": noop("CalculiX's own")}
_MEANINGS = {
    objects.ELEMENT: noop("By default C3D20R, with C3D20 where hourglassing threatens or temperatures are looked for; of first order C3D8I"),
    objects.STRESSES: noop("Recovered ones are closer to the truth, of meshes of second order and linear analyses"),
}


class SolvingSection(Section):
    """`boxes`: by the name of the mesh object's property."""

    def __init__(self, values):
        super().__init__(tr("Solve with CalculiX"), "solving_section", is_open=False)
        form = QtGui.QFormLayout()
        self.boxes = {}
        for name, choices in objects.SOLVING.items():
            box = self.boxes[name] = QtGui.QComboBox()
            box.setMinimumWidth(60)
            box.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLengthWithIcon)
            box.setSizePolicy(QtGui.QSizePolicy.Expanding, QtGui.QSizePolicy.Fixed)
            box.setToolTip(tr(_MEANINGS[name]))
            for choice in choices:
                box.addItem(tr(_CHOICES[choice]) if choice in _CHOICES else choice, choice)
            form.addRow(QtGui.QLabel(tr(_NAMES[name])), box)
        self.body.addLayout(form)
        self.show_values(values)

    def show_values(self, values):
        for name, box in self.boxes.items():
            box.setCurrentIndex(box.findData(values[name]))

    def values(self):
        return {name: box.itemData(box.currentIndex()) for name, box in self.boxes.items()}
