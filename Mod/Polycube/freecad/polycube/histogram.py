"""A bar chart of cell quality, which is the legend of the colours too."""

from PySide import QtCore, QtGui

from . import quality_view
from .measures import BARS, MEASURES
from .words import count as told
from .words import decimal, short_count, tr

#: Pixels of the smallest letters that can be read.
_SMALLEST = 8


class Histogram(QtGui.QWidget):
    """Cells per bar, from bad to good; `counts` is a list of BARS numbers. `chosen`, a bar or None, changes by a click: `clicked(bar)` is called."""

    def __init__(self, clicked=None):
        super().__init__()
        self.counts = []
        self.measure = MEASURES[0]
        self.chosen = None
        self._clicked = clicked
        self.setMinimumSize(100, 90)
        self.setSizePolicy(QtGui.QSizePolicy.Expanding, QtGui.QSizePolicy.Fixed)
        self.setCursor(QtCore.Qt.PointingHandCursor)

    def sizeHint(self):
        return QtCore.QSize(200, 90)

    def set_counts(self, counts, measure=MEASURES[0]):
        self.counts, self.measure = list(counts), measure
        self.update()

    def choose(self, bar):
        self.chosen = bar
        self.update()

    def label(self, edge):
        """The measure's value at an end of bars, 0 to BARS."""
        value = self.measure.value(edge / BARS)
        return decimal(value, 1) if value < 1e6 else "\u221e"

    def bar_at(self, x):
        return min(max(int(BARS * x / max(self.width(), 1)), 0), BARS - 1)

    def mousePressEvent(self, event):
        bar = self.bar_at(event.pos().x())
        if not any(self.counts) or not self._clicked:
            return
        self.choose(None if bar == self.chosen else bar)
        self._clicked(self.chosen)

    def event(self, event):
        if event.type() == QtCore.QEvent.ToolTip and any(self.counts):
            bar = self.bar_at(event.pos().x())
            text = tr("{} cells with {} {} to {}. A click shows them alone.")
            text = text.format(told(self.counts[bar]), tr(self.measure.title), self.label(bar), self.label(bar + 1))
            QtGui.QToolTip.showText(event.globalPos(), text, self)
            return True
        return super().event(event)

    def paintEvent(self, event):
        del event
        painter = QtGui.QPainter(self)
        line = painter.fontMetrics().height()
        width, height = self.width(), self.height()
        floor = height - line - 2
        largest = max(self.counts, default=0)
        step = width / BARS
        ink = self.palette().color(QtGui.QPalette.WindowText)
        plain = painter.font()
        painter.setFont(self.count_font(plain, step))
        for bar, number in enumerate(self.counts if largest else []):
            tall = max(2, round((floor - line) * number / largest)) if number else 0
            place = QtCore.QRect(round(bar * step) + 1, floor - tall, max(round(step) - 2, 1), tall)
            colour = QtGui.QColor.fromRgbF(*quality_view.colour(bar))
            if self.chosen not in (None, bar):
                colour.setAlphaF(0.3)
            painter.fillRect(place, colour)
            painter.setPen(ink)
            if number:
                painter.drawText(QtCore.QRect(round(bar * step), floor - tall - line, round(step), line), QtCore.Qt.AlignCenter, short_count(number))
        painter.setFont(plain)
        painter.setPen(ink)
        painter.drawLine(0, floor, width, floor)
        for edge in range(0, BARS + 1, 2):
            place = min(max(round(edge * step) - 15, 0), width - 30)
            painter.drawText(QtCore.QRect(place, height - line, 30, line), QtCore.Qt.AlignCenter, self.label(edge))
        painter.end()

    def count_font(self, font, step):
        """The font in which the widest count fits over its bar."""
        font = QtGui.QFont(font)
        texts = [short_count(number) for number in self.counts]
        size = QtGui.QFontInfo(font).pixelSize()
        while size > _SMALLEST and max((self.text_width(font, text) for text in texts), default=0) > step - 1:
            size -= 1
            font.setPixelSize(size)
        return font

    @staticmethod
    def text_width(font, text):
        return QtGui.QFontMetrics(font).boundingRect(text).width()
