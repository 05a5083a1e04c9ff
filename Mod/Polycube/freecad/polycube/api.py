"""What scripts call. No window needed."""

from contextlib import contextmanager

from . import shapes
from .errors import InvalidInput


def options():
    """The mesher's options: list of dicts with name, unit, meaning, type, default, min, max, choices, advanced."""
    from . import option_table

    return option_table.table()


def mesh(shape_or_object, size=None, order=2, progress=None, log=None, cancel=None, **more):
    """All-hexahedral mesh of one solid.

    shape_or_object: Part.Shape, or a document object that has one, meshed where it stands in the 3D view.
    size: edge length in mm or as a FreeCAD.Units.Quantity; None is the bounding box's diagonal / 30. order: 1 or 2. `more`: see options().
    progress(stage, fraction), log(line): called while the work runs. cancel(): asked every 0.1 s, true stops the work.
    Returns a MeshResult (arrays and report). Raises InvalidInput, StageFailed, Cancelled.
    """
    return _run("mesh", shapes.shape_of(shape_or_object), _given(size=size, order=order, **more), progress, log, cancel)


def labels(shape_or_object, progress=None, log=None, cancel=None, **more):
    """The labels that mesh() would start from, to look at: a LabelResult. Takes a second or two where the mesh takes minutes.

    Arguments and errors as for mesh(). `labels={"Face12": "+X"}` sets the axis of CAD faces, `frame=((1, 0, 0), (0, 1, 0))` the directions of X and Y.
    """
    return _run("labels", shapes.shape_of(shape_or_object), _given(**more), progress, log, cancel)


def _run(what, shape, given, progress, log, cancel):
    from . import job

    shapes.check_solid(shape)
    with job.Job(shape, given, what) as work:
        return job.run(work, progress, log, cancel)


def create_fem_mesh(part, size=None, order=2, analysis=None, name="PolycubeMesh", progress=None, log=None, cancel=None, **more):
    """Meshes the document object `part` and returns a new FEM mesh object in its document, in one undo step.

    The mesh object joins `analysis` if one is given. Raises like mesh(); the document is then unchanged.
    """
    from . import objects

    _check_object(part)
    if analysis is not None and not (hasattr(analysis, "isDerivedFrom") and analysis.isDerivedFrom("Fem::FemAnalysis")):
        raise InvalidInput("analysis is not an analysis object")
    if analysis is not None and analysis.Document != part.Document:
        raise InvalidInput("{} is in another document than {}".format(analysis.Label, part.Label))
    given = _given(size=size, order=order, **more)
    shape = shapes.shape_of(part, beside=analysis)
    meshed = shapes.signature(shape)
    result = _run("mesh", shape, with_constraints(given, part, analysis), progress, log, cancel)
    with transaction(part.Document, "Hexahedral mesh from shape"):
        obj = objects.make(part.Document, part, name)
        if analysis:
            analysis.addObject(obj)
        _warn(obj, objects.set_mesh(obj, result, given, meshed))
    return obj


def update_fem_mesh(obj, progress=None, log=None, cancel=None):
    """Meshes again with the object's own shape and options, in one undo step. Raises like mesh(); the object is then unchanged."""
    from . import objects, option_table

    part = objects.part_of(obj)
    _check_object(part)
    given = option_table.read(obj)
    shape = shapes.shape_of(part, beside=obj)
    meshed = shapes.signature(shape)
    result = _run("mesh", shape, with_constraints(given, part, objects.analysis_of(obj)), progress, log, cancel)
    with transaction(obj.Document, "Hexahedral mesh"):
        _warn(obj, objects.set_mesh(obj, result, given, meshed))
    return obj


def solve(analysis, element=None, solver=None, folder=None, log=None, cancel=None):
    """Solves an analysis by CalculiX, with all its loads, and loads the results into it: see solver.solve, which this is. Returns a Solution."""
    from . import solver as solving

    return solving.solve(analysis, element, solver, folder, log, cancel)


def converge(analysis, sizes=3, quantity="max displacement", **more):
    """The analysis on meshes finer and finer, and how far a result is from its limit: see convergence.converge, which this is. Returns a Convergence."""
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
    """One undo step, taken back on an error; part of the caller's step where one is open already."""
    import FreeCAD

    # A document reports a transaction only once it has changed something; the application knows of it at once.
    own = not (document.HasPendingTransaction or FreeCAD.getActiveTransaction())
    if own:
        document.openTransaction(name)
    try:
        yield
    except BaseException:
        if own:
            document.abortTransaction()
            FreeCAD.closeActiveTransaction(True)
        raise
    if own:
        document.commitTransaction()
        FreeCAD.closeActiveTransaction()


def _given(**values):
    from . import option_table

    return option_table.plain(values)


def _check_object(part):
    if part is None or not hasattr(part, "Document"):
        raise InvalidInput("a document object with a shape is needed")


def _warn(obj, warnings):
    import FreeCAD

    for line in warnings:
        FreeCAD.Console.PrintWarning("{}: {}\n".format(obj.Label, line))
