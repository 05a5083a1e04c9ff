"""A call of the API in a window: the window goes on meanwhile, with a bar and a button that cancels."""

import threading

import FreeCADGui
from PySide import QtCore, QtGui

from . import job
from .words import tr

#: Milliseconds before the bar comes up: what is done sooner needs none.
_SOON = 1000


def run(work, progress=None, log=None, cancel=None):
    """job.run() with a window that goes on. Nothing in it can be clicked but Cancel, for the caller goes on with the document as it is now."""
    bar = QtGui.QProgressDialog(tr("Hexahedral mesh"), tr("Cancel"), 0, 100, FreeCADGui.getMainWindow())
    bar.setWindowModality(QtCore.Qt.ApplicationModal)
    bar.setMinimumDuration(_SOON)
    bar.setAutoReset(False)
    bar.setAutoClose(False)
    stopped = threading.Event()

    def heard(stage, fraction):
        bar.setValue(round(100 * fraction))
        if progress:
            progress(stage, fraction)

    def idle():
        QtGui.QApplication.processEvents()
        if bar.wasCanceled():
            stopped.set()

    try:
        return job.run(work, heard, log, lambda: stopped.is_set() or bool(cancel and cancel()), idle)
    finally:
        bar.close()
        bar.deleteLater()
