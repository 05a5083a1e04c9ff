"""The panel's part that tells of a run: how far it is, in words; what came out, in a line; the mesher's log, folded away."""

import html
import re

from PySide import QtCore, QtGui

from .folding import Section
from .words import decimal, noop, tr

#: The mesher's stages, in the order of a mesh.
_STAGES = {
    "start": noop("Starting the mesher"),
    "cad": noop("Reading the part"),
    "tet": noop("Filling the part with tetrahedra"),
    "label": noop("Choosing axes of faces"),
    "deform": noop("Straightening the part into blocks"),
    "blocks": noop("Finding the blocks"),
    "quantize": noop("Choosing numbers of cells"),
    "hex": noop("Making hexahedra"),
    "pad": noop("Adding layers where faces meet"),
    "fit": noop("Moving nodes onto the CAD"),
    "fem": noop("Making elements"),
}
#: As backend/pipeline/search writes it: "plan 2, 'name', 3 fits done, best: 'name', 4 CAD edges lost, min SJ 0.31" or "..., no mesh yet"
_PLAN = re.compile(r"plan (\d+), '.*', \d+ fits done, (?:best: '.*', (\d+) CAD edges lost, min SJ (\S+)|no mesh yet)$")
#: Letters that can be read on a light and on a dark ground.
_ERROR = {False: "#b00020", True: "#ff8a80"}


def stage_words(stage):
    """What the mesher does in a stage, as users understand it."""
    return tr(_STAGES[stage]) if stage in _STAGES else stage


def is_dark(widget):
    """Whether letters are brighter than what they stand on."""
    palette = widget.palette()
    return palette.color(QtGui.QPalette.Text).lightness() > palette.color(QtGui.QPalette.Base).lightness()


class RunSection(QtGui.QWidget):
    """progress, time, `best` (a button), status, `tries` (buttons after a refusal): as far as there is something to tell. The panel places `log_fold`."""

    def __init__(self):
        super().__init__()
        self.progress = QtGui.QProgressBar()
        self.progress.setRange(0, 100)
        self.progress.setTextVisible(False)
        self.progress.setMinimumWidth(40)
        self.time = QtGui.QLabel("0.0 s")
        self.best = QtGui.QPushButton(tr("Take the best so far"))
        self.best.setToolTip(tr("Ends the search for a better mesh"))
        self.best.setVisible(False)
        self.status = QtGui.QLabel()
        self.status.setObjectName("status")
        self.status.setWordWrap(True)
        self.status.setTextFormat(QtCore.Qt.PlainText)  # names of objects may have what looks like HTML
        self.status.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        self.tries = QtGui.QWidget()
        self.tries.setVisible(False)
        QtGui.QVBoxLayout(self.tries).setContentsMargins(0, 0, 0, 0)
        self.log_fold = Section(tr("Log of the mesher"), "log_fold", is_open=False)
        self.log = QtGui.QPlainTextEdit()
        self.log.setReadOnly(True)
        self.log.setMinimumSize(60, 110)
        self.log_fold.body.addWidget(self.log)
        self._row = QtGui.QWidget()
        row = QtGui.QHBoxLayout(self._row)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.progress)
        row.addWidget(self.time)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        for widget in (self._row, self.status, self.tries, self.best):
            layout.addWidget(widget)
        self._row.setVisible(False)
        self.status.setVisible(False)
        self._layout_number, self._found = 0, ""
        self._typical = None

    def begin(self, words, typical=None):
        """`typical`: seconds that such a run takes, where that is known."""
        self.progress.setValue(0)
        self._layout_number, self._found = 0, ""
        self._typical = typical
        self._row.setVisible(True)
        self.offer([])
        self.tell(words)

    def show_time(self, seconds, ended=False):
        """Seconds since the beginning, and what is typical while it runs."""
        text = decimal(seconds, 1) + " s"
        if self._typical and not ended:
            text = tr("{} of about {:.0f} s").format(text, max(self._typical, 1))
        self.time.setText(text)

    def offer(self, ways):
        """What to try, as buttons: pairs of text and what a click does."""
        layout = self.tries.layout()
        while layout.count():
            button = layout.takeAt(0).widget()
            button.setParent(None)
            button.deleteLater()
        for text, work in ways:
            button = QtGui.QPushButton(text)
            button.clicked.connect(lambda *_, work=work: work())
            layout.addWidget(button)
        self.tries.setVisible(bool(ways))

    def tell(self, text, error=False):
        """The one line for the user."""
        self.status.setStyleSheet("color: {}".format(_ERROR[is_dark(self.log)]) if error else "")
        self.status.setText(text)
        self.status.setVisible(bool(text))

    def write(self, seconds, text, error=False):
        """A line of the log."""
        stamp = "{:.1f}: ".format(seconds) if seconds is not None else ""
        line = html.escape(stamp + text)
        self.log.appendHtml('<span style="color:{}">{}</span>'.format(_ERROR[is_dark(self.log)], line) if error else line)

    def show_progress(self, stage, fraction):
        self.progress.setValue(round(100 * fraction))
        words = stage_words(stage)
        if self._layout_number > 1 or self._found:
            words = tr("Layout {}: {}").format(self._layout_number, words)
        self.tell(words + " ..." + ("\n" + self._found if self._found else ""))

    def hear(self, line):
        """A line of the mesher's log: a new layout is tried, and there may be a mesh to take."""
        match = _PLAN.match(line)
        if not match:
            return
        number, lost, quality = match.groups()
        self._layout_number = int(number)
        if lost is not None:
            captured = tr("all CAD edges") if lost == "0" else tr("all but {} CAD edges").format(lost)
            self._found = tr("Best so far: valid, {}, worst cell {}").format(captured, decimal(float(quality), 2))
            self.best.setVisible(True)
            self.best.setEnabled(True)

    def end(self):
        self.best.setVisible(False)
