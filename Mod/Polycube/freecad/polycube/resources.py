"""Icons and forms: beside this file where the workbench was copied, in the repository where it is linked."""

import os

HERE = os.path.dirname(os.path.realpath(__file__))
_ROOTS = [os.path.join(HERE, "resources"), os.path.join(HERE, "..", "..", "..", "..", "resources")]


def path(*parts):
    """Full path of a file like ("icons", "Polycube_Workbench.svg")."""
    for root in _ROOTS:
        candidate = os.path.normpath(os.path.join(root, *parts))
        if os.path.exists(candidate):
            return candidate
    raise FileNotFoundError(os.path.join(*parts))


def icon(name):
    return path("icons", name + ".svg")
