"""What scripts call. No window needed."""

import functools
import threading
from contextlib import contextmanager

import FreeCAD

from . import likeness, shapes
from .errors import InvalidInput
from .words import tr


#: What the calls that change documents return at once while the window records them: see echo().
_done = None


@contextmanager
def echo(obj):
    """Within it the calls that change documents do nothing and return `obj`.

    The window has done what they do, watched and without waiting; FreeCAD's doCommand, by which it records them in macros, runs what it records.
    """
    global _done
    _done = obj
    try:
        yield
    finally:
        _done = None


def _recorded(call):
    """A call that the window records."""

    return _on_what_is_there(functools.wraps(call)(lambda *arguments, **named: call(*arguments, **named) if _done is None else _done))


def _on_what_is_there(call):
    """A call that says so where an object that it is given, or its document, is gone, before it or meanwhile."""

    @functools.wraps(call)
    def called(*arguments, **named):
        try:
            return call(*arguments, **named)
        except ReferenceError as error:
            raise InvalidInput(tr("an object that is needed, or its document, is gone: {}").format(error)) from None

    return called


def options():
    """The mesher's options: list of dicts with name, unit, meaning, type, default, min, max, choices, advanced.

    >>> [option["unit"] for option in polycube.options() if option["name"] == "size"]
    ['mm']
    """
    from . import option_table

    return option_table.table()


def mesh(shape_or_object, size=None, order=2, progress=None, log=None, cancel=None, **more):
    """All-hexahedral mesh of one solid or several.

    shape_or_object: Part.Shape, or a document object that has one, meshed where it stands in the 3D view; or a list of these.
    size: edge length in mm or as a FreeCAD.Units.Quantity; None leaves it to the part, the bounding box's diagonal / 20 where nothing asks for less.
    order: 1 or 2. `more`: see options().
    progress(stage, fraction), log(line): called while the work runs. cancel(): asked every 0.1 s, true stops the work.
    Returns a MeshResult (arrays and report). Raises InvalidInput, StageFailed, Cancelled.

    >>> result = polycube.mesh(part, size="20 mm", order=1)
    >>> result.hexes.shape
    (27, 8)
    >>> sorted(result.groups)[:2]
    ['Edge1', 'Edge10']
    """
    return _run("mesh", shape_or_object, shapes.shape_of(shape_or_object), _given(size=size, order=order, **more), progress, log, cancel)


def prepare(shape_or_object, **options):
    """A Session on one solid or several, for meshes that differ in counts, sizes, divisions or order: `session.mesh(size=3)` as mesh(), several times.

    The first mesh makes tetrahedra, labels, map and blocks, those after it go on from there; so do session.labels() and session.count(), the number of cells
    that a mesh would have. The session is a process of its own; session.close(), or a with block, ends it.

    >>> with polycube.prepare(part, order=1) as session:
    ...     session.count(size=10), len(session.mesh(size=20).hexes)
    (72, 27)
    """
    from .session import Session

    shape = shapes.shape_of(shape_or_object)
    shapes.check_solid(shape)
    return Session(shape.copy(), _given(**options), shapes.solid_labels(shape_or_object))


def labels(shape_or_object, progress=None, log=None, cancel=None, **more):
    """The labels that mesh() would start from, to look at: a LabelResult. Takes a second or two where the mesh takes minutes.

    Arguments and errors as for mesh(). `labels={"Face12": "+X"}` sets the axis of CAD faces, `frame=((1, 0, 0), (0, 1, 0))` the directions of X and Y.

    >>> found = polycube.labels(part)
    >>> found.valid, len(found.face_label)
    (True, 6)
    """
    return _run("labels", shape_or_object, shapes.shape_of(shape_or_object), _given(**more), progress, log, cancel)


def _run(what, part, shape, given, progress, log, cancel):
    from . import job

    shapes.check_solid(shape)
    run = job.run
    if FreeCAD.GuiUp and threading.current_thread() is threading.main_thread():
        from .waiting import run
    with job.Job(shape, given, what, shapes.solid_labels(part)) as work:
        return run(work, progress, log, cancel)


@_recorded
def create_fem_mesh(part, size=None, order=2, analysis=None, name="PolycubeMesh", progress=None, log=None, cancel=None, only_object=False, **more):
    """Meshes the document object `part` and returns a new FEM mesh object in its document, in one undo step.

    Of a list of objects a Part::Compound is made, which is the mesh object's part then.
    The mesh object joins `analysis` if one is given. `only_object`: it has no cells yet, so that refine() can ask for something before update_fem_mesh().
    Raises like mesh(); the document is then unchanged.

    >>> obj = polycube.create_fem_mesh(part, size=20, analysis=analysis)
    >>> obj.Hexahedra, obj.MeshState
    (12, 'Up to date')
    """
    from . import objects, option_table

    parts = list(part) if isinstance(part, (list, tuple)) else [part]
    for one in parts or [None]:
        _check_object(one)
    document = parts[0].Document
    if any(one.Document != document for one in parts):
        raise InvalidInput(tr("the parts are in different documents"))
    parts = shapes.distinct(parts)
    part = parts if len(parts) > 1 else parts[0]
    if not isinstance(name, str) or not name:
        raise InvalidInput(tr("name: not a name but {!r}").format(name))
    _check_analysis(analysis, parts[0])
    given = _given(size=size, order=order, **more)
    shape = shapes.shape_of(part, beside=analysis)
    if only_object:
        shapes.check_solid(shape)
        with transaction(document, tr("Hexahedral mesh from shape")):
            obj = objects.make(document, part if len(parts) == 1 else compound_of(parts, analysis), name)
            if analysis:
                analysis.addObject(obj)
            option_table.write(obj, given)
        return obj
    meshed = shapes.signature(shape)
    _tell_uncaptured(part, analysis)
    result = _run("mesh", part, shape, with_constraints(given, part, analysis), progress, log, cancel)
    for one in parts:
        _check_object(one)
    with transaction(document, tr("Hexahedral mesh from shape")):
        obj = objects.make(document, part if len(parts) == 1 else compound_of(parts, analysis), name)
        if analysis:
            analysis.addObject(obj)
        _warn(obj, objects.set_mesh(obj, result, given, meshed))
    return obj


@_recorded
def compound_of(parts, analysis=None):
    """A new Part::Compound of document objects, which stands where they stand and follows them. Raises InvalidInput where no compound can.

    Of objects in one App::Part it is in there too; of others in containers it has likenesses, objects that show these
    where they stand. `analysis`: that the mesh of it is to be in.

    >>> len(polycube.compound_of([part, other]).Shape.Solids)
    2
    """
    parts = shapes.distinct(parts)
    document = parts[0].Document
    around = [shapes.container_of(part) for part in parts]
    shared = around[0] if around[0] and around[0].isDerivedFrom("App::Part") and all(one == around[0] for one in around) else None
    shown = [part for part, container in zip(parts, around) if container and not shared]
    if analysis and any(shapes.selection_path(part)[0] in analysis.InListRecursive for part in shown):
        raise InvalidInput(tr("{} is in a container of some of the parts; move it out of there").format(analysis.Label))
    compound = document.addObject("Part::Compound", "MeshedParts")
    if shared:
        shared.addObject(compound)
    compound.Links = [likeness.make(part) if part in shown else part for part in parts]
    compound.recompute()
    if not shapes.same(shapes.signature(shapes.shape_of(compound)), shapes.signature(shapes.shape_of(parts))):
        raise InvalidInput(tr("the parts are in containers that move them; put them into one App::Part and take that"))
    return compound


def stands_for(member, part):
    """Whether the member of a compound_of() some objects is there for this one: it itself, or what shows it where it stands."""
    return part in (member, shapes.shown_by(member))


@_recorded
def update_fem_mesh(obj, progress=None, log=None, cancel=None, **more):
    """Meshes again with the object's own shape and options, in one undo step. Raises like mesh(); the object is then unchanged.

    `more`: options that are to be others from now on; one that is given its default, as options() has it, goes back to that.

    >>> polycube.update_fem_mesh(mesh, size=10).Hexahedra
    48
    """
    from . import objects, option_table, refinements

    _check_mesh(obj)
    part = objects.part_of(obj)
    if part is None:
        raise InvalidInput(tr("the part that {} was made of is gone").format(obj.Label))
    given = option_table.without_defaults({**option_table.read(obj), **_given(**more)})
    shape = shapes.shape_of(part, beside=obj)
    meshed = shapes.signature(shape)
    _tell_uncaptured(part, objects.analysis_of(obj))
    wanted = with_constraints(refinements.with_refinements(given, obj), part, objects.analysis_of(obj))
    result = _run("mesh", part, shape, wanted, progress, log, cancel)
    _check_mesh(obj)
    with transaction(obj.Document, tr("Hexahedral mesh")):
        _warn(obj, objects.set_mesh(obj, result, given, meshed))
    return obj


@_recorded
def set_options(obj, **more):
    """Gives a mesh object other options, without meshing, in one undo step. An option that is given its default, as options() has it, goes back to that.

    >>> polycube.set_options(mesh, order=1).MeshState
    'Out of date'
    """
    from . import option_table

    _check_mesh(obj)
    given = option_table.without_defaults({**option_table.read(obj), **_given(**more)})
    with transaction(obj.Document, tr("Mesh parameters")):
        option_table.write(obj, given)
    return obj


@_recorded
def refine(obj, kind, places, value=None):
    """Asks something of the mesh object at places of its part, by an object below it in the tree; in one undo step. Returns the new object.

    kind, places and value: "size", faces, edges or solids, a length; "levels", faces, edges, vertices or solids, times that their elements are divided by
    three, 1 to 6; "divisions", edges, elements; "layers", two faces, elements; "bore", cylindrical faces, elements round
    each; "bias", edges, last element over first; "keep", faces none of whose edges is ignored; "axis", faces, an axis as "+X". Elements are 6, "3.." (at least), "..4", "2..5". Faces may be numbers.
    The next update_fem_mesh() obeys it. Raises InvalidInput.

    >>> layers = polycube.refine(mesh, "layers", ["Face5", "Face6"], 5)
    >>> polycube.update_fem_mesh(mesh).Hexahedra
    30
    """
    from . import refinements

    _check_mesh(obj)
    with transaction(obj.Document, tr("Refinement")):
        return refinements.make(obj, kind, [place if isinstance(place, str) else "Face{}".format(place) for place in places], value)


@_recorded
def set_refinement(obj, value=None, suppressed=None):
    """Changes what a refinement asks for, or whether the mesh does without it; in one undo step. Raises InvalidInput.

    >>> layers = polycube.refine(mesh, "layers", ["Face5", "Face6"], 5)
    >>> polycube.set_refinement(layers, "3..").Elements
    '3..'
    """
    from . import refinements

    if not refinements.is_refinement(obj):
        raise InvalidInput(tr("{} is no refinement").format(getattr(obj, "Label", obj)))
    with transaction(obj.Document, tr("Refinement")):
        if value is not None:
            refinements.set_value(obj, value)
        if suppressed is not None:
            obj.Suppressed = bool(suppressed)
    return obj


@_recorded
def set_analysis(obj, analysis):
    """Has the mesh object be the mesh of this analysis, in place of any other, or of none where it is None; in one undo step. Returns the mesh object.

    >>> polycube.set_analysis(mesh, analysis) in analysis.Group
    True
    """
    from . import analyses

    _check_mesh(obj)
    _check_analysis(analysis, obj)
    with transaction(obj.Document, tr("Mesh of the analysis")):
        analyses.move(obj, analysis)
        for other in analyses.other_meshes(analysis, obj) if analysis else []:
            analysis.removeObject(other)
    return obj


@_on_what_is_there
def solve(analysis, element=None, solver=None, folder=None, log=None, cancel=None, stresses=None):
    """Solves an analysis by CalculiX, with all its loads, and loads the results into it: see solver.solve, which this is. Returns a Solution.

    >>> solution = polycube.solve(loaded)
    >>> max(solution.result.DisplacementLengths) > 0
    True
    """
    from . import solver as solving

    return solving.solve(analysis, element, solver, folder, log, cancel, stresses)


@_on_what_is_there
def converge(analysis, sizes=3, quantity="max displacement", **more):
    """The analysis on meshes finer and finer, and how far a result is from its limit: see convergence.converge, which this is. Returns a Convergence.

    >>> series = polycube.converge(loaded, sizes=[20, 15, 10])
    >>> len(series.rows)
    3
    """
    from . import convergence

    return convergence.converge(analysis, sizes, quantity, **more)


def with_constraints(options, part, analysis):
    """The options, with the faces that carry constraints of the analysis among those to keep."""
    from . import fem_mesh

    kept = options.get("keep_faces") or []
    if isinstance(kept, str):
        kept = [name for name in kept.replace(" ", "").split(",") if name]
    names = list(kept)
    names += [name for name in fem_mesh.constrained_faces(part, analysis) if name not in names]
    return {**options, "keep_faces": ",".join(names)} if names else options


@contextmanager
def transaction(document, name):
    """One undo step, taken back on an error; part of the caller's step where one is open already. Without undo in the document what is new in it goes."""
    # A document reports a transaction only once it has changed something; the application knows of it at once.
    if document.HasPendingTransaction or FreeCAD.getActiveTransaction():
        yield
        return
    with _active(document):
        before = {obj.Name for obj in document.Objects}
        document.openTransaction(name)
        try:
            yield
        except BaseException:
            document.abortTransaction()
            FreeCAD.closeActiveTransaction(True)
            if not document.UndoMode:
                for new in [obj.Name for obj in document.Objects if obj.Name not in before]:
                    document.removeObject(new)
            raise
        document.commitTransaction()
        FreeCAD.closeActiveTransaction()


@contextmanager
def _active(document):
    """Has the document be the active one: when another document changes FreeCAD makes an undo step in the active one too."""
    before = FreeCAD.ActiveDocument
    if before is None or before.Name == document.Name:
        yield
        return
    FreeCAD.setActiveDocument(document.Name)
    try:
        yield
    finally:
        if before.Name in FreeCAD.listDocuments():
            FreeCAD.setActiveDocument(before.Name)


def _given(**values):
    from . import option_table

    return option_table.plain(values)


def _check_object(part):
    if part is None or not hasattr(part, "Document"):
        raise InvalidInput(tr("a document object with a shape is needed"))
    _check_exists(part)


def _check_analysis(analysis, beside):
    if analysis is not None and not (hasattr(analysis, "isDerivedFrom") and analysis.isDerivedFrom("Fem::FemAnalysis")):
        raise InvalidInput(tr("analysis is not an analysis object"))
    if analysis is not None and analysis.Document != beside.Document:
        raise InvalidInput(tr("{} is in another document than {}").format(analysis.Label, beside.Label))


def _check_mesh(obj):
    from . import objects

    if not objects.is_polycube(obj):
        raise InvalidInput(tr("{} is no mesh of Polycube").format(getattr(obj, "Label", obj)))
    _check_exists(obj)


def _check_exists(obj):
    if not shapes.exists(obj):
        raise InvalidInput(tr("an object that is needed, or its document, is gone"))


def _tell_uncaptured(part, analysis):
    """Warns of what the mesh will have no places for, before it is made."""
    from . import uncaptured

    for line in uncaptured.lines(part, analysis):
        FreeCAD.Console.PrintWarning(line + "\n")


def _warn(obj, warnings):
    for line in warnings:
        FreeCAD.Console.PrintWarning("{}: {}\n".format(obj.Label, line))
