"""What all proxies share: a document keeps nothing of them, all is in properties."""


class Stateless:
    """A proxy that keeps nothing of its own in the document: all is in properties."""

    def dumps(self):
        return None

    def loads(self, state):
        return None

    # FreeCAD 0.20's names for dumps and loads
    __getstate__ = dumps
    __setstate__ = loads
