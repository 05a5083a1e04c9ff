"""The ways a call can end without a mesh."""

import difflib

from .words import tr


class PolycubeError(Exception):
    """Base of all errors raised on purpose; the message is one line."""


class InvalidInput(PolycubeError, ValueError):
    """The caller's fault: a bad shape or option."""


class StageFailed(PolycubeError, RuntimeError):
    """No valid mesh could be made of valid input."""

    def __init__(self, message, stage="", entities=()):
        super().__init__(message)
        self.stage = stage
        self.entities = list(entities)

    def __str__(self):
        where = " ({})".format(", ".join(self.entities)) if self.entities else ""
        return (self.stage + ": " if self.stage else "") + super().__str__() + where


class NoMesher(PolycubeError, ImportError):
    """Neither the compiled module nor the program is there."""


class Cancelled(PolycubeError, RuntimeError):
    """The user cancelled, or the time limit passed."""


class SolverFailed(PolycubeError, RuntimeError):
    """CalculiX ended without results; the message has its own words."""


def did_you_mean(name, known, otherwise):
    """The end of a message about a wrong name: the one that is near to it, or `otherwise` and all that there are."""
    near = difflib.get_close_matches(str(name), known, 1)
    return tr("; did you mean '{}'?").format(near[0]) if near else otherwise + ", ".join(known)
