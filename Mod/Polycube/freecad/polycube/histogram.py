"""A bar chart of cell quality."""

from PySide import QtCore, QtGui

from . import quality_view


class Histogram(QtGui.QWidget):
    """Cells per tenth of scaled Jacobian; `counts` is a list of ten numbers."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.counts = []
        self.setMinimumHeight(90)
        self.setToolTip("Cells per tenth of scaled Jacobian: 1 is a cube, 0 is degenerate")

    def set_counts(self, counts):
        self.counts = list(counts)
        self.update()

    def paintEvent(self, event):
        del event
        painter = QtGui.QPainter(self)
        text = painter.fontMetrics().height()
        width, height = self.width(), self.height()
        bars = height - 2 * text - 2
        largest = max(self.counts, default=0)
        painter.setPen(self.palette().color(QtGui.QPalette.WindowText))
        step = width / 10
        for i, count in enumerate(self.counts if largest else []):
            tall = max(2, round(bars * count / largest)) if count else 0
            bar = QtCore.QRect(round(i * step) + 1, text + bars - tall, round(step) - 2, tall)
            painter.fillRect(bar, QtGui.QColor.fromRgbF(*quality_view.colour(i)))
            if count:
                painter.drawText(QtCore.QRect(round(i * step), text + bars - tall - text, round(step), text), QtCore.Qt.AlignCenter, str(count))
        painter.drawLine(0, text + bars, width, text + bars)
        for i in range(0, 11, 2):
            place = min(max(round(i * step) - 15, 0), width - 30)
            painter.drawText(QtCore.QRect(place, height - text, 30, text), QtCore.Qt.AlignCenter, "{:.1f}".format(i / 10))
        painter.end()
