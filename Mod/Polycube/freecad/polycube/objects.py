"""The document object: a FEM mesh linked to the shape it was made from."""

import json

import FreeCAD

from . import cells, compat, fem_mesh, load_sets, option_table, refinements, shapes, stresses
from .compat import part_of, set_part
from .engine_words import told
from .errors import InvalidInput
from .result import as_runs
from .stateless import Stateless
from .words import tr

EMPTY, CURRENT, OUTDATED = "Empty", "Up to date", "Out of date"

#: type, name, group, meaning; all written by the mesher, none by the user
_RESULTS = [
    ("App::PropertyString", "MeshState", "Polycube Result", "Whether the mesh fits shape and options; recompute marks it, Apply meshes"),
    ("App::PropertyInteger", "Hexahedra", "Polycube Result", "Number of cells"),
    ("App::PropertyInteger", "NodeCount", "Polycube Result", "Number of nodes"),
    ("App::PropertyFloat", "MinScaledJacobian", "Polycube Result", "Worst cell's quality: 1 is a cube, 0 is degenerate"),
    ("App::PropertyFloat", "MeanScaledJacobian", "Polycube Result", "Mean quality of the cells"),
    ("App::PropertyVolume", "MeshVolume", "Polycube Result", "Volume of the mesh"),
    ("App::PropertyString", "Report", "Polycube Result", "The mesher's report, JSON"),
    ("App::PropertyString", "Blocks", "Polycube Result", "Block of the polycube that each cell is part of, and how many after it: 3x5,7x2"),
    ("App::PropertyString", "MeshedOptions", "Polycube Result", "Options of the present mesh, JSON"),
    ("App::PropertyString", "MeshedCells", "Polycube Result", "Fingerprint of the cells of the present mesh"),
    ("App::PropertyFloatList", "MeshedShape", "Polycube Result", "Signature of the shape of the present mesh"),
]
ELEMENT, STRESSES = "SolverElement", "SolverStresses"
#: what polycube.solve solves the mesh with: the default, or one of deck.TYPES; and which stresses it gives. The first of each is what a new mesh has.
SOLVING = {ELEMENT: ["Default", "C3D20R", "C3D20", "C3D8I", "C3D8"], STRESSES: list(stresses.KINDS)}
#: property that documents do not have which are older than the bounds on counts
_BOUND = "MeshSizeFromCurvature"
_HIDDEN = ("Report", "Blocks", "MeshedOptions", "MeshedCells", "MeshedShape")


def make(document, part, name="PolycubeMesh"):
    """A new mesh object without cells, linked to the document object `part`."""
    obj = document.addObject(compat.mesh_type(document), name)
    PolycubeMesh(obj)
    set_part(obj, part)
    if FreeCAD.GuiUp:
        from .view import PolycubeMeshView

        PolycubeMeshView(obj.ViewObject)
    return obj


def element_of(obj):
    """The element type that the mesh object asks for, or None."""
    element = solving_of(obj)[ELEMENT]
    return None if element == SOLVING[ELEMENT][0] else element


def stresses_of(obj):
    """Which stresses the mesh object asks for."""
    return solving_of(obj)[STRESSES]


def solving_of(obj):
    """{property in SOLVING: its value} of a mesh object; of None those of a new one."""
    return {name: getattr(obj, name, choices[0]) for name, choices in SOLVING.items()}


def set_solving(obj, values):
    """Gives a mesh object those of solving_of that are others, and returns them. Call inside a transaction."""
    before = solving_of(obj)
    changed = {name: value for name, value in values.items() if value != before[name]}
    for name, value in changed.items():
        setattr(obj, name, value)
    return changed


def is_polycube(obj):
    return getattr(getattr(obj, "Proxy", None), "Type", None) == PolycubeMesh.Type


def meshes_of(part):
    """The mesh objects of ours that are made of the document object `part`, in its document."""
    return [obj for obj in part.Document.findObjects("Fem::FemMeshObject") if is_polycube(obj) and part_of(obj) == part]


def analysis_of(obj):
    """The analysis that holds the object, or None."""
    return next((parent for parent in obj.InList if parent.isDerivedFrom("Fem::FemAnalysis")), None)


def set_mesh(obj, result, options, meshed_shape, mesh=None, asked=None):
    """Gives the object its mesh. `meshed_shape`: signature of the shape that was meshed. Call inside a transaction. Returns warnings, one line each.

    `mesh`: what fem_mesh.build() made of the result, where that is done already. `asked`: the options with what the refinements asked for when the mesher
    was started, where that may be a while ago.
    """
    mesh = mesh or fem_mesh.build(result)
    warnings = [told(line) for line in result.report.get("warnings", [])]
    obj.MeshedShape = meshed_shape
    analysis = analysis_of(obj)
    if not shape_is_meshed(obj):
        warnings.append(tr("the part has changed while it was meshed: make the mesh again"))
    elif analysis:
        warnings += fem_mesh.add_constraint_groups(mesh, result, part_of(obj), analysis, GROUPS_ARE_ASKED)
    option_table.write(obj, options)
    quality = result.report["quality"]
    obj.MeshedCells = cells.remember(obj, mesh)
    obj.FemMesh = mesh
    obj.Hexahedra = len(result.hexes)
    obj.NodeCount = len(result.nodes)
    obj.MinScaledJacobian = quality["min_scaled_jacobian"]
    obj.MeanScaledJacobian = quality["mean_scaled_jacobian"]
    obj.MeshVolume = result.report["volume"]["mesh"]
    obj.Report = json.dumps(result.report)
    obj.Blocks = as_runs(result.hex_block.tolist())
    obj.MeshedOptions = json.dumps(asked, sort_keys=True) if asked is not None else _options_text(obj)
    obj.MeshState = state(obj)
    obj.purgeTouched()  # it is as it is to be; FreeCAD's mark would hide the icon of the state
    return warnings


def state(obj):
    """EMPTY, CURRENT or OUTDATED, from the object's properties and its shape as they are now."""
    if not obj.FemMesh.VolumeCount:
        return EMPTY
    if not cells.is_as_meshed(obj):
        return OUTDATED
    try:
        same_options = obj.MeshedOptions == _options_text(obj)
    except InvalidInput:  # options that cannot be read
        return OUTDATED
    return CURRENT if same_options and shape_is_meshed(obj) else OUTDATED


def _options_text(obj):
    """The object's options and what its refinements ask for, as MeshedOptions keeps them."""
    return json.dumps(refinements.with_refinements(option_table.read(obj), obj), sort_keys=True)


def shape_is_meshed(obj):
    """Whether the mesh is one of its part as this is now."""
    try:
        shape = shapes.shape_of(part_of(obj), obj)
    except InvalidInput:  # there is none
        return False
    return shapes.same(list(obj.MeshedShape), shapes.signature(shape))


def _grouped_shape(obj):
    """For load_sets: the shape whose faces a mesh has groups for; None of meshes that are not ours or whose part has changed, with a warning then."""
    if not is_polycube(obj):
        return None
    if not cells.is_as_meshed(obj) or not shape_is_meshed(obj):
        FreeCAD.Console.PrintWarning(tr("{}: the part has changed since it was meshed, loads may get lost: make the mesh again").format(obj.Label) + "\n")
        return None
    return shapes.numbered_shape(part_of(obj))


class PolycubeMesh(Stateless):
    """Proxy of the mesh object. Recompute never meshes: it marks the mesh as out of date."""

    Type = "Fem::FemMeshPolycube"

    def __init__(self, obj):
        obj.Proxy = self
        self._add_properties(obj)

    def _add_properties(self, obj):
        if compat.needs_part_property(obj):
            obj.addProperty("App::PropertyLinkGlobal", "Part", "FEM Mesh", "Geometry object, the mesh is made from")
        option_table.add_properties(obj)
        if not hasattr(obj, "Refinements"):
            obj.addProperty("App::PropertyLinkListGlobal", "Refinements", "Polycube", "What is asked of the mesh at places of the part")
        if not hasattr(obj, ELEMENT):
            meaning = "Element that polycube.solve takes: by default C3D20R with C3D20 where hourglassing threatens, and C3D8I of first order"
            obj.addProperty("App::PropertyEnumeration", ELEMENT, "Polycube", meaning)
            setattr(obj, ELEMENT, SOLVING[ELEMENT])
        if not hasattr(obj, STRESSES):
            meaning = "Stresses that polycube.solve gives: recovered from the integration points, of second order, or extrapolated by CalculiX"
            obj.addProperty("App::PropertyEnumeration", STRESSES, "Polycube", meaning)
            setattr(obj, STRESSES, SOLVING[STRESSES])
        for kind, name, group, meaning in _RESULTS:
            if not hasattr(obj, name):
                obj.addProperty(kind, name, group, meaning)
                if name == "MeshState":
                    obj.MeshState = EMPTY
            # 1 read-only, 2 hidden
            obj.setEditorMode(name, 2 if name in _HIDDEN else 1)

    def execute(self, obj):
        now = state(obj)
        if obj.MeshState != now:
            obj.MeshState = now

    def onChanged(self, obj, name):
        if "Restore" in obj.State or not hasattr(obj, "MeshedShape"):
            return
        if name in ("Part", "Shape", "Refinements") or name in option_table.property_names():
            self.execute(obj)

    def onDocumentRestored(self, obj):
        try:
            before_bounds, was_current = not hasattr(obj, _BOUND), obj.MeshState == CURRENT
            self._add_properties(obj)
            if before_bounds:
                _without_bounds(obj, was_current)
        except ImportError as error:
            FreeCAD.Console.PrintWarning("{}: {}\n".format(obj.Label, error))


def _without_bounds(obj, was_current):
    """Has an object of a document that is older than the bounds round circles and through walls mean what it meant: the size alone decides."""
    setattr(obj, _BOUND, 0)
    if obj.Report and not (obj.CharacteristicLengthMax.Value or obj.Hexes or obj.Coarsest):
        obj.CharacteristicLengthMax = json.loads(obj.Report)["size"]  # it was a share of the diagonal
    if was_current:
        obj.MeshedOptions, obj.MeshState = _options_text(obj), CURRENT


class _Watcher:
    """Marks meshes whose part is moved by a container around it, or gets into another: FreeCAD recomputes what is linked to the container only. And has
    meshes follow undo, redo and abort, which leave them their cells."""

    def slotUndoDocument(self, document):
        for obj in document.findObjects("Fem::FemMeshObject"):
            if is_polycube(obj):
                cells.put_back(obj)
                obj.Proxy.execute(obj)
                obj.purgeTouched()

    slotRedoDocument = slotAbortTransaction = slotUndoDocument

    def slotDeletedDocument(self, document):
        cells.forget(document.Name)

    def slotChangedObject(self, obj, name):
        if obj.Document.Restoring:
            return
        if name == "Placement" and shapes.is_container(obj):
            self._mark(FreeCAD.listDocuments().values(), lambda mesh: _is_inside(mesh, obj) or _is_inside(part_of(mesh), obj))
        elif name == "ElementList" or (name == "Group" and shapes.is_container(obj)):
            # What has left it is inside no more, and a group without links is no container any more. FreeCAD tells this of a deleted one too.
            self._mark([obj.Document], lambda mesh: True)

    @staticmethod
    def _mark(documents, concerns):
        for document in documents:
            for obj in document.findObjects("Fem::FemMeshObject"):
                if not is_polycube(obj) or not concerns(obj):
                    continue
                if not document.Recomputing:
                    obj.touch()
                else:
                    obj.Proxy.execute(obj)  # its turn may be over


def _is_inside(obj, container):
    return obj is not None and container in obj.InListRecursive


#: whether the solver writers of this FreeCAD ask the groups of our meshes
GROUPS_ARE_ASKED = load_sets.install(_grouped_shape)
FreeCAD.addDocumentObserver(_Watcher())
