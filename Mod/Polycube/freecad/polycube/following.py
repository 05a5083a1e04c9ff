"""Has the panel follow its document: what undo, redo, the tree, the property editor, macros and other panels do to what it shows."""

import FreeCAD
from PySide import QtCore

#: Milliseconds until it is tried again, while the panel is at work on a mesh (guess).
_LATER = 100
#: Properties that tell where something stands and how it is made.
_OF_SHAPE = ("Shape", "Placement")


class Follower(QtCore.QTimer):
    """Calls `panel.follow(shape_may_differ)` once things are at rest that have changed in the panel's document: not in the middle of undo or of a recompute."""

    def __init__(self, panel):
        super().__init__(panel.form)
        self._panel = panel
        self._shape_may_differ = False
        self.setSingleShot(True)
        self.timeout.connect(self._follow)
        self._observer = _Observer(panel.document_name, self.changed)
        FreeCAD.addDocumentObserver(self._observer)

    def end(self):
        FreeCAD.removeDocumentObserver(self._observer)
        self._observer.told = lambda _: None
        self.stop()

    def changed(self, shape_may_differ):
        """Something has changed."""
        self._shape_may_differ |= shape_may_differ
        self.start(0)

    def _follow(self):
        panel = self._panel
        if panel.form is None or not panel.document_is_open():
            return
        if panel.is_at_work() or FreeCAD.getDocument(panel.document_name).Recomputing:
            self.start(_LATER)
            return
        differs, self._shape_may_differ = self._shape_may_differ, False
        panel.follow(differs)


class _Observer:
    """What FreeCAD calls, by these names. `told(shape_may_differ)` for everything in the document."""

    def __init__(self, document_name, told):
        self._document_name, self.told = document_name, told

    def slotUndoDocument(self, document):
        if document.Name == self._document_name:
            self.told(True)

    slotRedoDocument = slotAbortTransaction = slotUndoDocument

    def slotCreatedObject(self, obj):
        if obj.Document.Name == self._document_name:
            self.told(False)

    def slotDeletedObject(self, obj):
        if obj.Document.Name == self._document_name:
            self.told(True)

    def slotChangedObject(self, obj, name):
        if obj.Document.Name == self._document_name:
            self.told(name in _OF_SHAPE)
