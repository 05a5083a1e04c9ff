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
        self.addItem(tr("none"), "")
        for analysis in analyses.of(document):
            self.addItem(analysis.Label, analysis.Name)
        first = holding or given or analyses.active(document)
        self.setCurrentIndex(self.findData(first.Name) if first else 0)

    def chosen(self):
        """The analysis, None for none or for one that is gone."""
        name = self.itemData(self.currentIndex())
        if not name or self._document_name not in FreeCAD.listDocuments():
            return None
        return FreeCAD.getDocument(self._document_name).getObject(name)
