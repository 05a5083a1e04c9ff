"""The page *Edit > Preferences > Polycube*: resources/ui/Preferences.ui in FreeCAD's language."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

from . import preferences, resources
from .words import tr


class PreferencesPage:
    """What FreeCAD makes for its dialog, and asks to load and to save. Each widget with a `prefEntry` holds the entry of that name."""

    def __init__(self):
        self.form = FreeCADGui.PySideUic.loadUi(resources.path("ui", "Preferences.ui"))
        self.form.setWindowTitle(tr(self.form.windowTitle()))
        for widget in self.form.findChildren(QtGui.QWidget):
            widget.setToolTip(tr(widget.toolTip()))
            if isinstance(widget, QtGui.QLabel):
                widget.setText(tr(widget.text()))
            elif isinstance(widget, QtGui.QGroupBox):
                widget.setTitle(tr(widget.title()))
            elif isinstance(widget, QtGui.QSpinBox):
                widget.setSpecialValueText(tr(widget.specialValueText()))
            elif isinstance(widget, QtGui.QComboBox):
                for index in range(widget.count()):
                    widget.setItemText(index, tr(widget.itemText(index)))

    def _entries(self):
        """(name of an entry, name of the property that shows it, widget)"""
        for widget in self.form.findChildren(QtGui.QWidget):
            name = widget.property("prefEntry")
            if name:
                shown = "value" if isinstance(widget, QtGui.QSpinBox) else "currentIndex" if isinstance(widget, QtGui.QComboBox) else "fileName"
                yield bytes(name).decode("ascii") if not isinstance(name, str) else name, shown, widget

    def loadSettings(self):
        group = FreeCAD.ParamGet(preferences.GROUP)
        for name, shown, widget in self._entries():
            kept = group.GetString if shown == "fileName" else group.GetInt
            widget.setProperty(shown, kept(name, widget.property(shown)))

    def saveSettings(self):
        group = FreeCAD.ParamGet(preferences.GROUP)
        for name, shown, widget in self._entries():
            keep = group.SetString if shown == "fileName" else group.SetInt
            keep(name, widget.property(shown))
