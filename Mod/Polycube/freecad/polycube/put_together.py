"""The compound that several selected parts become for the panel: without a mesh nothing of it stays."""

import FreeCAD
from PySide import QtCore

from . import api, macro, objects, shapes
from .words import tr


class PutTogether:
    """`compound`: a new one of these parts, in an undo step of its own, for a mesh in `analysis`. Raises InvalidInput where no compound can be."""

    def __init__(self, parts, analysis=None):
        self._parts = [(part, part.ViewObject.Visibility) for part in parts]
        self._step = tr("Compound of the parts to mesh")
        self._is_recorded = False
        self._document_name = parts[0].Document.Name
        with api.transaction(parts[0].Document, self._step):
            self.compound = api.compound_of(parts, analysis)
        # While a command runs FreeCAD ends no step, nor after it where it has opened a panel: all to come would be part of this one.
        QtCore.QTimer.singleShot(0, self._end_step)

    def _end_step(self):
        if (FreeCAD.getActiveTransaction() or ("",))[0] == self._step:
            FreeCAD.closeActiveTransaction()

    def record(self):
        """There is a mesh: a macro makes the compound too."""
        if not self._is_recorded and shapes.exists(self.compound):
            self._is_recorded = True
            macro.put_together(self.compound, [part for part, _ in self._parts])

    def take_back(self):
        """The panel was closed: without a mesh of it, and where nothing else has come to refer to it, the compound goes with its undo step."""
        if self._document_name not in FreeCAD.listDocuments() or not shapes.exists(self.compound):
            return
        document = self.compound.Document
        if objects.meshes_of(self.compound) or any(not one.isDerivedFrom("App::Part") for one in self.compound.InList):
            return
        if document.UndoNames[:1] == [self._step]:
            document.undo()
        else:
            with api.transaction(document, tr("Delete")):
                for one in [self.compound, *filter(shapes.shown_by, self.compound.Links)]:
                    document.removeObject(one.Name)
        for part, was_shown in self._parts:
            if shapes.exists(part):
                part.ViewObject.Visibility = was_shown
