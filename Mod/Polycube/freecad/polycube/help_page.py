"""The user guide with its pictures, in a window of FreeCAD."""

import os

from PySide import QtCore, QtGui

from .words import tr

#: The guide beside the package, in the repository and where the folder was copied.
GUIDE = os.path.normpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "README.md"))
#: Pixels between a picture and the window's border, for margins and the bar.
_BORDER = 60


class HelpPage(QtGui.QTextBrowser):
    """README.md of the workbench; its pictures are as wide as the window at most. Other pages open in the user's browser."""

    def __init__(self, parent):
        super().__init__(parent)
        self.setWindowFlags(QtCore.Qt.Window)
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.setObjectName("PolycubeHelp")
        self.setWindowTitle(tr("Polycube: guide"))
        self.setOpenExternalLinks(True)
        self.setSearchPaths([os.path.dirname(GUIDE)])
        self.resize(900, 800)
        with open(GUIDE, encoding="utf-8") as file:
            self.document().setMarkdown(file.read())
        self.moveCursor(QtGui.QTextCursor.Start)

    def loadResource(self, kind, url):
        """A picture in the width that there is."""
        if kind != QtGui.QTextDocument.ImageResource:
            return super().loadResource(kind, url)
        picture = QtGui.QImage(os.path.join(os.path.dirname(GUIDE), url.toString()))
        width = max(self.width() - _BORDER, 200)
        return picture.scaledToWidth(width, QtCore.Qt.SmoothTransformation) if picture.width() > width else picture
