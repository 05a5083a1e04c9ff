"""The panel's line about how many cells there will be: an estimate from the shape at once, the number with its labels and blocks once they are made."""

import FreeCAD
from PySide import QtCore, QtGui

from . import fields, prediction, shapes
from .errors import Cancelled, InvalidInput, PolycubeError
from .words import count, tr

#: Milliseconds from the last change of an option to a new count, a guess: who types a number is not done with the first digit.
_PAUSE = 400


class SizeHint(QtGui.QWidget):
    """`label` and a button. From its click on, or once the panel has shown labels, the panel's session counts the cells anew with every change."""

    def __init__(self, panel):
        super().__init__()
        self._panel = panel
        self._request = None
        self.counts = False  #: with every change
        self.label = QtGui.QLabel()
        self.label.setWordWrap(True)
        self.count_button = QtGui.QPushButton(tr("Count cells"))
        self.count_button.setToolTip(tr("Finds axes of faces and blocks, but makes no mesh, and says how many cells there will be"))
        self.count_button.clicked.connect(self.begin)
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(_PAUSE)
        self._timer.timeout.connect(self._ask)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.label)
        layout.addWidget(self.count_button)

    def begin(self, *_):
        """Cells are counted from now on."""
        self.counts = True
        self.show_estimate()

    def show_estimate(self):
        """What automatic is, and about how many cells there will be; a count follows where they are counted."""
        self.stop()
        panel = self._panel
        if not panel.part_exists():  # Apply tells
            return
        try:
            shape = shapes.shape_of(panel.part)
            if shape.isNull():
                return
            self.count_button.setVisible(not self.counts and len(shape.Solids) == 1)
            automatic = FreeCAD.Units.Quantity(prediction.size_of(shape, {}), FreeCAD.Units.Length).UserString
            lines = [tr("0 is automatic: near to {}").format(automatic)]
            options = panel.asked()
            expected = panel.prediction(options)
        except InvalidInput:  # Apply tells
            return
        if expected:
            cells = tr("about {} cells").format(count(_rounded(expected.cells)))
            if not panel.is_meshed_as_is() and not any(options.get(name) for name in fields.FINENESS):
                cells = tr("{} or more, where edges are short").format(cells)
            if expected.cells > 1.5 * expected.plain:
                cells = tr("up to {}, {} without local sizes").format(cells, count(_rounded(expected.plain)))
            lines.append(cells)
        self.label.setText("\n".join(lines))
        if self.counts and len(shape.Solids) == 1 and not panel.is_meshed_with(options):
            self._timer.start()

    def stop(self):
        """No count goes on."""
        self._timer.stop()
        asked, self._request = self._request, None
        if asked:
            asked.kill("cancelled")

    def _ask(self):
        panel = self._panel
        if panel.form is None or panel.process or not panel.part_exists():
            return
        try:
            options = panel.wanted()
            self._request = panel.live_session(options).ask("count", options, lambda *_: None, lambda _: None, self._counted)
        except (PolycubeError, OSError):  # Apply tells
            return
        self._add(tr("Counting ..."))

    def _counted(self, cells, error):
        if self._panel.form is None or isinstance(error, Cancelled):
            return
        self._request = None
        self._add(str(error) if error else tr("{} cells with these axes and sizes").format(count(cells)))

    def _add(self, line):
        """The line in place of the estimate."""
        self.label.setText("\n".join([self.label.text().split("\n")[0], line]))


def _rounded(number):
    """Two digits are known of a prediction, not more."""
    number = round(number)
    return round(number, 2 - len(str(number)))
