"""A section of the panel that can be folded away."""

from PySide import QtCore, QtGui


class Section(QtGui.QWidget):
    """A heading with an arrow, by mouse or key, and `body` below it, a layout for the content."""

    def __init__(self, title, name, is_open=True, tooltip=""):
        super().__init__()
        self.setObjectName(name)
        self.heading = QtGui.QToolButton()
        self.heading.setText(title)
        self.heading.setToolTip(tooltip)
        self.heading.setCheckable(True)
        self.heading.setAutoRaise(True)
        self.heading.setToolButtonStyle(QtCore.Qt.ToolButtonTextBesideIcon)
        self.heading.setSizePolicy(QtGui.QSizePolicy.Expanding, QtGui.QSizePolicy.Fixed)
        font = self.heading.font()
        font.setBold(True)
        self.heading.setFont(font)
        self._content = QtGui.QWidget()
        self.body = QtGui.QVBoxLayout(self._content)
        self.body.setContentsMargins(8, 0, 0, 4)
        self.told = QtGui.QLabel()
        self.told.setWordWrap(True)
        self.told.setTextFormat(QtCore.Qt.PlainText)
        self.told.setVisible(False)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(2)
        layout.addWidget(self.heading)
        layout.addWidget(self._content)
        self.heading.toggled.connect(self._show)
        self.heading.setChecked(is_open)
        self._show(is_open)

    def say(self, text):
        """A line in the section itself, where `told` is placed in its body: what stands elsewhere in the panel may be out of sight."""
        self.told.setText(text)
        self.told.setVisible(bool(text))

    def is_open(self):
        return self.heading.isChecked()

    def set_open(self, wanted):
        self.heading.setChecked(wanted)

    def _show(self, wanted):
        self.heading.setArrowType(QtCore.Qt.DownArrow if wanted else QtCore.Qt.RightArrow)
        self._content.setVisible(wanted)
