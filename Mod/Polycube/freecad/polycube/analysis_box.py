"""The panel's choice of the analysis that the mesh is for."""

import FreeCAD
from PySide import QtGui

from . import analyses
from .words import tr


class AnalysisBox(QtGui.QComboBox):
    """The analyses of a document and "none". Chosen is at first the one that holds the mesh, then the one that the user works on."""

    def __init__(self, document, holding, given):
        super().__init__()
        self.setObjectName("analysis")
        self.setMinimumWidth(60)
        self.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        self.setSizePolicy(QtGui.QSizePolicy.Expanding, QtGui.QSizePolicy.Fixed)
        self.setToolTip(tr("The analysis that the mesh is for"))
        self._document_name = document.Name
        self._fill()
        self._choose(holding or given or analyses.active(document))

    def _fill(self):
        self.addItem(tr("none"), "")
        for analysis in analyses.of(FreeCAD.getDocument(self._document_name)):
            self.addItem(analysis.Label, analysis.Name)

    def _choose(self, analysis):
        self.setCurrentIndex(max(self.findData(analysis.Name), 0) if analysis else 0)

    def _items(self):
        return [(self.itemText(index), self.itemData(index)) for index in range(self.count())]

    def follow(self, holding, has_moved):
        """Analyses came, went or have other names. The choice stays; but where the mesh got into another it is that, and a new one takes what had none."""
        document = FreeCAD.getDocument(self._document_name)
        known, chosen = self._items(), self.itemData(self.currentIndex())
        blocked = self.blockSignals(True)
        self.clear()
        self._fill()
        if has_moved:
            self._choose(holding)
        elif chosen:
            self._choose(document.getObject(chosen))
        else:
            active = analyses.active(document)
            self._choose(active if active and active.Name not in [name for _, name in known] else None)
        self.blockSignals(blocked)

    def chosen(self):
        """The analysis, None for none or for one that is gone."""
        name = self.itemData(self.currentIndex())
        if not name or self._document_name not in FreeCAD.listDocuments():
            return None
        return FreeCAD.getDocument(self._document_name).getObject(name)
