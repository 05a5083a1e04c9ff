"""Which cells a mesh object has, and those that it had: FreeCAD's undo, redo and abort take back its properties, but leave it the cells."""

import Fem

#: As many meshes are remembered for undo of an object: large ones take much memory (guess).
_KEPT = 4
#: nodes whose places stand for all
_PROBES = 7
#: {(document, object): [(fingerprint, Fem.FemMesh), ...]}, the oldest first
_remembered = {}


def fingerprint(mesh):
    """Text that tells a Fem.FemMesh from others: numbers of nodes, cells and groups, and places of some nodes. Empty of a mesh without cells."""
    if not mesh.VolumeCount:
        return ""
    count = mesh.NodeCount
    places = [mesh.getNodeById(1 + (count - 1) * k // (_PROBES - 1)) for k in range(_PROBES)]
    numbers = [count, mesh.VolumeCount, mesh.FaceCount, mesh.GroupCount, *(value for place in places for value in place)]
    return " ".join("{:.12g}".format(number) for number in numbers)


def remember(obj, mesh):
    """Keeps the cells that the object gets, and those that it has, for undo and redo, where its document has undo. Returns the fingerprint of what it gets."""
    mark = fingerprint(mesh)
    if obj.Document.UndoMode:
        kept = _remembered.setdefault((obj.Document.Name, obj.Name), [])
        before = fingerprint(obj.FemMesh)
        if before not in dict(kept):  # the last one that it got is there already
            kept.append((before, Fem.FemMesh(obj.FemMesh)))
        kept[:] = [pair for pair in kept if pair[0] != mark] + [(mark, mesh)]
        del kept[:-_KEPT]
    return mark


def put_back(obj):
    """Gives the object the cells that its properties speak of, where it has others and those are remembered."""
    if obj.MeshedCells == fingerprint(obj.FemMesh):
        return
    kept = dict(_remembered.get((obj.Document.Name, obj.Name), ()))
    if obj.MeshedCells in kept:
        obj.FemMesh = kept[obj.MeshedCells]


def forget(document):
    """Nothing is kept of a document that is closed."""
    for key in [key for key in _remembered if key[0] == document]:
        del _remembered[key]


def is_as_meshed(obj):
    """Whether the object has the cells that its properties speak of. Those of documents older than the fingerprint are taken to be."""
    if not obj.MeshedCells and obj.Hexahedra:
        return True
    return obj.MeshedCells == fingerprint(obj.FemMesh)
