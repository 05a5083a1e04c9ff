"""Solves an analysis by CalculiX: FreeCAD's writer makes the input file, what it leaves out of it on hexahedra is added, FreeCAD loads the results."""

import collections
import importlib
import os
import queue
import re
import subprocess
import threading
import time

import FreeCAD

from . import analyses, api, balance, ccx, cells, compat, deck, estimate, fem_mesh, job, objects, shapes, special_loads, ties
from . import stresses as stresses_of
from .errors import Cancelled, InvalidInput, SolverFailed
from .load_sets import GroupedMesh, loss, not_captured
from .words import tr

#: node set of all that holds the part
SUPPORTS = "POLYCUBE_SUPPORTS"
#: kinds of analysis whose reactions are printed
_WITH_REACTIONS = ("static", "thermomech")
#: Theory: eigenvalue below which a motion of the whole part is not held, by the mean over what is; edges of a thousandth of the part's size have 1e-7 in it
_HELD = 1e-12
#: seconds between two questions whether to stop
_PATIENCE = 0.1


class Solution:
    """What a solve gave: `results`, FreeCAD's result objects; `path` of the input file; `element`; `notes`, lines; `seconds` that CalculiX took.

    `stress_error`: how much stresses differ from cell to cell, and where most (estimate.StressError).
    `recovered`: the stresses that results have in place of CalculiX's (stresses.Recovered), `energy_error`: how far those are from the cells' own
    (estimate.EnergyError); None where results have CalculiX's stresses.
    `balance`: whether the reactions carry the loads (balance.Balance); None where that is not known, of frequencies and large displacements among others.
    """

    def __init__(self, path, element, notes):
        self.path, self.element, self.notes = path, element, notes
        self.results, self.seconds, self.balance, self.stress_error = [], 0.0, None, None
        self.recovered, self.energy_error = None, None
        # for what is to be done after the run: a GroupedMesh; whether there are springs; what makes the balance, and the stresses; MPa of the cells
        self.mesh, self.springs, self.weigh, self.recover, self.stiffness = None, False, None, None, None
        self.ties = []  # FreeCAD's entries of them

    @property
    def result(self):
        """The last result object: of a load that grows the whole load."""
        return self.results[-1]


def solve(analysis, element=None, solver=None, folder=None, log=None, cancel=None, stresses=None):
    """Solves the analysis, loads the results into it in one undo step and returns a Solution.

    element: "C3D20R" (the default), "C3D20" of a mesh of second order; "C3D8I" (the default), "C3D8" of one of first; None is what the mesh object's property
    SolverElement says. By default C3D20R becomes C3D20 in cells where hourglassing threatens, and everywhere where temperatures are looked for; an element that
    is asked for is taken everywhere. Meshes of other meshers keep FreeCAD's elements.
    stresses: "recovered" (the default) from the integration points by fitted polynomials, of linear runs on meshes of second order; "calculix", which CalculiX
    extrapolates. None is what the mesh object's property SolverStresses says.
    solver: the analysis' solver object, if it has several. folder: for the files, which stay; the default is the one that FreeCAD's preferences name.
    log(line): CalculiX's output and notes.
    cancel(): asked every 0.1 s, true stops the work.
    Raises InvalidInput, SolverFailed with CalculiX's own words, Cancelled; the analysis is then as it was.
    """
    tools = prepared(analysis, solver, folder)
    solution = write(tools, element, stresses)
    for line in solution.notes:
        _tell(analysis, line, log, is_warning=True)
    run(solution, log, cancel)
    if solution.springs:
        _without_springs(solution.path, tools.mesh.FemMesh)
    if solution.recover:
        solution.recovered = solution.recover()
        _tell(analysis, solution.recovered.line() if solution.recovered else "", log)
    for line in ties.not_tied(solution.path, solution.ties, solution.mesh):
        solution.notes.append(line)
        _tell(analysis, line, log, is_warning=True)
    if solution.weigh:
        solution.balance = solution.weigh()
    if solution.balance:
        line = solution.balance.line()
        solution.notes += [] if solution.balance.holds else [line]
        _tell(analysis, line, log, is_warning=not solution.balance.holds)
    before = set(analysis.Group)
    with api.transaction(analysis.Document, tr("Solve with CalculiX")):
        if not FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Fem/General").GetBool("KeepResultsOnReRun", False):
            before -= {member for member in before if member.isDerivedFrom("Fem::FemResultObject")}
            tools.purge_results()
        tools.load_results()
        solution.results = [obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemResultObject") and obj not in before]
        if not solution.results and tools.solver.AnalysisType != "check":
            raise SolverFailed(tr("CalculiX wrote no results"))
        if solution.results and solution.mesh and tools.solver.AnalysisType in _WITH_REACTIONS:
            solution.stress_error = estimate.stress_error(solution.path, solution.result, solution.mesh)
            stresses_of.mark(solution.results, solution.recovered)
            if solution.recovered:
                solution.energy_error = estimate.energy_error(solution.recovered, solution.stiffness)
                solution.energy_error.find_faces(solution.mesh)
                solution.energy_error.show_in(solution.result)
    for error in filter(None, (solution.stress_error, solution.energy_error)):
        _tell(analysis, error.line(), log)
    return solution


def _tell(analysis, line, log, is_warning=False):
    """To FreeCAD's report and the log of the caller; nothing where the line is empty."""
    if not line:
        return
    (FreeCAD.Console.PrintWarning if is_warning else FreeCAD.Console.PrintMessage)("{}: {}\n".format(analysis.Label, line))
    if log:
        log(line)


def prepared(analysis, solver, folder):
    """FreeCAD's tools for CalculiX, with everything there that a run needs; InvalidInput says what is not."""
    if not (hasattr(analysis, "isDerivedFrom") and analysis.isDerivedFrom("Fem::FemAnalysis")):
        raise InvalidInput(tr("an analysis is needed"))
    try:
        there = ccx.find()
    except RuntimeError:
        raise InvalidInput(tr(ccx.NAMES_NONE).format(os.environ["POLYCUBE_CCX"])) from None
    if not there:
        raise InvalidInput(tr(ccx.MISSING))
    solvers = [member for member in analysis.Group if member.isDerivedFrom("Fem::FemSolverObject")]
    ours = [member for member in solvers if getattr(getattr(member, "Proxy", None), "Type", "") == "Fem::SolverCcxTools"]
    if solver is None:
        if len(ours) != 1:
            raise InvalidInput(tr("{} has {} solvers of the kind CalculiX Standard; one is needed").format(analysis.Label, len(ours) or tr("no")))
        (solver,) = ours
    elif solver not in ours:
        raise InvalidInput(tr("{} is no solver of the kind CalculiX Standard in {}").format(getattr(solver, "Label", solver), analysis.Label))
    meshes = analyses.other_meshes(analysis)
    if len(meshes) > 1:
        raise InvalidInput(tr("{} has several meshes, one is needed: {}").format(analysis.Label, ", ".join(mesh.Label for mesh in meshes)))
    _check_references(analysis)
    from femtools import ccxtools

    tools = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
    tools.update_objects()
    if folder is None:
        tools.setup_working_dir()
    else:
        try:
            os.makedirs(folder, exist_ok=True)
        except (OSError, TypeError) as error:
            raise InvalidInput(tr("no folder for CalculiX' files: {}").format(error)) from None
        tools.setup_working_dir(folder)
    trouble = [line for line in tools.check_prerequisites().splitlines() if line.strip()]
    if any(kind in ("bearing", "spring") for kind, _ in _special(analysis)):
        trouble = [line for line in trouble if not compat.says_that_nothing_holds(line)]  # these hold it too
    if trouble:
        if os.path.basename(tools.working_dir.rstrip("/")).startswith("fcfem_"):  # a new one that FreeCAD makes for every run
            os.rmdir(tools.working_dir)
        raise InvalidInput(" ".join(" ".join(trouble).split()))
    return tools


def write(tools, element=None, stresses=None):
    """Writes the input file of FreeCAD's tools, completes it and returns a Solution without results. element, stresses: as for solve()."""
    from femmesh import meshsetsgetter
    from femsolver.calculix import writer
    from femtools import membertools

    if stresses not in (None, *stresses_of.KINDS):
        raise InvalidInput(tr("stresses are {} or {}, not {}").format(*stresses_of.KINDS, stresses))
    getter = meshsetsgetter.MeshSetsGetter(tools.analysis, tools.solver, tools.mesh, membertools.AnalysisMember(tools.analysis))
    mesh = getter.femmesh if isinstance(getter.femmesh, GroupedMesh) else None
    special = _special(tools.analysis) if mesh else []
    for kind, _ in special:  # this FreeCAD may know how to write one
        if hasattr(getter.member, "cons_" + kind):
            setattr(getter.member, "cons_" + kind, [])
    if objects.is_polycube(tools.mesh) and not cells.is_as_meshed(tools.mesh):
        raise InvalidInput(tr("{}: its cells are not those of its properties; make it again").format(tools.mesh.Label))
    if mesh:
        _check_captured(tools.analysis, mesh.owner)
    getter.get_mesh_sets()
    notes = _not_written(tools.analysis, tools.solver.AnalysisType, getter.member, special, mesh)
    entries = {name[5:]: getattr(getter.member, name) for name in vars(getter.member) if name.startswith("cons_")}
    _check_found(entries)
    cards = _cards(tools, mesh, getter.member, entries, special)
    if mesh and tools.solver.AnalysisType in _WITH_REACTIONS:
        notes += _free(mesh, entries, special, cards.held)
    files = writer.FemInputWriterCcx(tools.analysis, tools.solver, tools.mesh, getter.member, tools.working_dir, getter.mat_geo_sets)
    tools.inp_file_name = path = files.write_solver_input()
    if not path:
        raise SolverFailed(tr("FreeCAD could not write the input file"))
    chosen, recovers = "", False
    if mesh:
        element = element or objects.element_of(mesh.owner)
        order = 2 if len(mesh.getElementNodes(mesh.Volumes[0])) == 20 else 1
        chosen, others, line = deck.choose(element, order, mesh, _points(tools.analysis, mesh), tools.solver.AnalysisType == "thermomech")
        notes += [line] if line else []
        recovers = order == 2 and _recovers(tools, getter.member, stresses or objects.stresses_of(mesh.owner))
        _change(files.femmesh_file, lambda text: deck.set_types(text, chosen, others))
    elif element:
        raise InvalidInput(tr("{}: elements can be chosen for meshes of Polycube only").format(tools.mesh.Label))
    elif stresses == stresses_of.RECOVERED:
        raise InvalidInput(tr("{}: stresses are recovered on meshes of Polycube only").format(tools.mesh.Label))
    cards.step += stresses_of.CARDS if recovers else ()
    _change(path, lambda text: deck.add_cards(text, cards.model, cards.step))
    solution = Solution(path, chosen, notes)
    solution.mesh, solution.springs = mesh, any(kind == "spring" for kind, _ in special)
    if solution.springs:
        _change(path, lambda text: deck.outputs_of(text, files.ccx_nall))
    if mesh and getter.member.cons_tie:
        solution.ties = getter.member.cons_tie
        _change(path, lambda text: _noted(ties.with_reaches(text, solution.ties, mesh), notes))
    if mesh and tools.solver.AnalysisType in _WITH_REACTIONS and tools.solver.GeometricalNonlinearity != "nonlinear":
        solution.weigh = lambda: balance.check(mesh, getter.member, cards.loads, cards.supports, path, SUPPORTS)
    if recovers:
        materials = [cells for _, cells in _materials(getter.member) if cells]
        solution.recover = lambda: stresses_of.recover(path, mesh, materials)
        solution.stiffness = _stiffness(getter.member, mesh)
    return solution


def _stiffness(member, mesh):
    """(Young's modulus, Poisson's ratio) of each cell."""
    found = dict.fromkeys(mesh.Volumes, (1.0, 0.0))
    for entry in member.mats_linear:
        found.update(dict.fromkeys(entry.get("FEMElements") or mesh.Volumes, compat.elasticity(entry["Object"])))
    return [found[volume] for volume in mesh.Volumes]


def _recovers(tools, member, stresses):
    """Whether stresses are recovered: of linear runs that have some."""
    linear = tools.solver.GeometricalNonlinearity != "nonlinear" and not member.mats_nonlinear
    return stresses == stresses_of.RECOVERED and linear and tools.solver.AnalysisType in _WITH_REACTIONS


def _without_springs(path, mesh):
    """Has the result file beside the input file tell of the part alone."""
    cells = collections.Counter(node for volume in mesh.Volumes for node in mesh.getElementNodes(volume))
    with open(path, encoding="utf-8") as file:
        text = file.read()
    _change(os.path.splitext(path)[0] + ".frd", lambda frd: deck.undiluted(deck.without_others(frd, max(mesh.Nodes), max(mesh.Volumes)), text, cells))


def _noted(changed, notes):
    """Of (text, lines) the text; the lines are added to notes."""
    text, lines = changed
    notes += lines
    return text


def _change(path, change):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(change(text))


def _special(analysis):
    """(kind, constraint) of those in the analysis that special_loads writes."""
    found = [(fem_mesh.special_kind(member), member) for member in analysis.Group]
    return [(kind, member) for kind, member in found if kind]


def _not_written(analysis, kind_of_analysis, member, special, mesh):
    """Lines on members of the analysis that have no effect on this run."""
    written = {entry["Object"].Name for name in vars(member) if name.startswith("cons_") for entry in getattr(member, name)}
    written |= {constraint.Name for _, constraint in special}
    notes = []
    for constraint in analysis.Group:
        if constraint.isDerivedFrom("Fem::Constraint") and constraint.Name not in written:
            kind = fem_mesh.special_kind(constraint)
            notes.append("{}: {}".format(constraint.Label, tr("is written for meshes of Polycube only") if kind and not mesh else tr("means nothing to CalculiX")))
    for name in sorted(vars(member)):
        if name.startswith("cons_") and getattr(member, name):
            try:
                analyses = importlib.import_module("femsolver.calculix.write_constraint_" + name[5:]).get_analysis_types()
            except (ImportError, AttributeError):
                continue
            if analyses != "all" and kind_of_analysis not in analyses:
                notes += [tr("{}: has no effect in an analysis of type {}").format(entry["Object"].Label, kind_of_analysis) for entry in getattr(member, name)]
    for kind, constraint in special:
        if kind_of_analysis not in special_loads.ANALYSES.get(kind, (kind_of_analysis,)):
            notes.append(tr("{}: has no effect in an analysis of type {}").format(constraint.Label, kind_of_analysis))
    return notes


def _check_references(analysis):
    """Raises InvalidInput where a constraint refers to what its part does not have, or to an edge without length: FreeCAD's searches end in errors of Python there."""
    for constraint in analysis.Group:
        if not constraint.isDerivedFrom("Fem::Constraint"):
            continue
        if constraint.isDerivedFrom("Fem::ConstraintForce"):
            kinds = {name.rstrip("0123456789") for _, names in constraint.References for name in names}
            if len(kinds) > 1 or not kinds <= {"Face", "Edge", "Vertex"}:
                raise InvalidInput(tr("{}: a force is on faces, on edges or on vertices").format(constraint.Label))
        for obj, names in getattr(constraint, "References", []):
            for name in filter(None, names):  # no name is the whole part
                shape = getattr(obj, "Shape", None)
                if not shape or not fem_mesh.exists(shape, name):
                    raise InvalidInput(tr("{}: {} has no {}").format(constraint.Label, obj.Label, name))
                if name.startswith("Edge") and shape.getElement(name).Length < 1e-7:  # OpenCASCADE's Precision::Confusion
                    raise InvalidInput(tr("{}: {} of {} is a point").format(constraint.Label, name, obj.Label))
                if name.startswith("Edge") and shapes.is_seam(shape, shape.getElement(name)):
                    raise InvalidInput(tr("{}: {} of {} is {}").format(constraint.Label, name, obj.Label, tr(shapes.SEAM)))


def _check_captured(analysis, obj):
    """Raises InvalidInput where a constraint is on faces, edges or vertices that the mesh object does not have as they are: part of the load would be lost."""
    for constraint in analysis.Group:
        if constraint.isDerivedFrom("Fem::Constraint"):
            found = not_captured(constraint, obj)
            if found:
                raise InvalidInput(tr("{}: the mesh does not capture {}; make it again").format(constraint.Label, ", ".join(found)))


def _check_found(entries):
    """Raises InvalidInput where a constraint, or part of its load, finds nothing in the mesh: it would be lost without a word."""
    for entry in (entry for same in entries.values() for entry in same):
        lost = loss(entry)
        if lost:
            raise InvalidInput("{}: {}".format(entry["Object"].Label, lost))


def _free(mesh, entries, special, held):
    """A line where supports leave one solid free to move as a whole: CalculiX often ends without an error there, and moves it by some amount."""
    import numpy

    others = any(entries.get(kind) for kind in ("contact", "tie", "transform")) or any(kind in ("bearing", "spring") for kind, _ in special)
    rows = [(node, axis - 1) for node, axes in held.items() for axis in sorted(axes)]
    if others or not rows or len(mesh.solids()) != 1:
        return []
    places = mesh.Nodes
    everywhere = numpy.array([place[:] for place in places.values()])
    centre, size = everywhere.mean(axis=0), numpy.ptp(everywhere, axis=0).max()
    at = (numpy.array([places[node][:] for node, _ in rows]) - centre) / size
    along = numpy.eye(3)[[axis for _, axis in rows]]
    # the motion of a point at r is t + w x r; along an axis e that is e t + (r x e) w
    motions = numpy.hstack([along, numpy.cross(at, along)])
    free = 6 - numpy.linalg.matrix_rank(motions.T @ motions / len(rows), tol=_HELD)
    if not free:
        return []
    return [tr("the supports leave the part free to move as a whole in {} of 6 ways: displacements mean nothing").format(free)]


def _cards(tools, mesh, member, entries, special):
    """The cards of what FreeCAD does not write, and the print of the reactions."""
    held, all_directions = {}, {1, 2, 3}
    supports = set()
    for entry in entries.get("fixed", []):
        held.update(dict.fromkeys(entry["Nodes"], all_directions))
    for entry in entries.get("displacement", []):
        obj = entry["Object"]
        directions = {along for along, free in enumerate((obj.xFree, obj.yFree, obj.zFree), 1) if not free}
        for node in entry["Nodes"]:
            held[node] = held.get(node, set()) | directions
    supports.update(held)
    # MPCs of their own; a second one for the same displacement CalculiX refuses.
    for entry in (entry for kind in ("planerotation", "rigidbody") for entry in entries.get(kind, [])):
        held.update(dict.fromkeys(entry["Nodes"], all_directions))
    turned = {node for entry in entries.get("transform", []) for node in entry["Nodes"]}
    femmesh = tools.mesh.FemMesh
    # FreeCAD 1.x numbers two nodes of a rigid body by its place in the analysis.
    first_node = max(femmesh.Nodes) + 2 * len(tools.analysis.Group) + 3
    cards = special_loads.Cards(first_node, max(femmesh.Volumes, default=0) + 1, held, _materials(member))
    for kind, constraint in special:
        if tools.solver.AnalysisType not in special_loads.ANALYSES.get(kind, (tools.solver.AnalysisType,)):
            continue
        before = len(cards.step)
        special_loads.write(kind, mesh, constraint, cards)
        on = {int(line.split(",")[0]) for line in cards.step[before:] if not line.startswith("*")} if kind in ("gear", "pulley") else set()
        if turned & (on | (cards.supports if kind == "bearing" else set())):
            raise InvalidInput(tr("{}: shares nodes with a transform constraint").format(constraint.Label))
    cards.supports |= supports
    if cards.supports and tools.solver.AnalysisType in _WITH_REACTIONS:
        cards.model += ["*NSET,NSET=" + SUPPORTS, *("{},".format(node) for node in sorted(cards.supports))]
        cards.step += ["*NODE PRINT, NSET={}, TOTALS=ONLY, GLOBAL=YES".format(SUPPORTS), "RF"]
    return cards


def _materials(member):
    """(density in t/mm3, its cells) of the materials; None for all cells."""
    return [(compat.density(entry["Object"]), entry.get("FEMElements")) for entry in member.mats_linear]


def _points(analysis, mesh):
    """Nodes that a constraint takes hold of one by one."""
    found = set()
    for constraint in analysis.Group:
        if constraint.isDerivedFrom("Fem::Constraint"):
            for obj, names in getattr(constraint, "References", []):
                for name in names:
                    if name.startswith("Vertex"):
                        found.update(mesh.getNodesByVertex(obj.Shape.getElement(name)))
    return found


def run(solution, log=None, cancel=None):
    """Runs CalculiX on the input file, with as many threads as FreeCAD's preferences say. Raises SolverFailed and Cancelled."""
    started = time.monotonic()
    threads = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Fem/Ccx").GetInt("AnalysisNumCPUs", 1)
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads if threads > 1 else os.cpu_count() or 1))
    folder, name = os.path.split(os.path.splitext(solution.path)[0])
    for ending in (".frd", ".dat", ties.MISSED):  # those of an earlier run are no results of this one
        if os.path.exists(os.path.join(folder, name + ending)):
            os.remove(os.path.join(folder, name + ending))
    child = subprocess.Popen(
        [ccx.find(), "-i", name],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        lines = list(_lines(child, log, cancel))
    except BaseException:
        job.kill_tree(child.pid)
        child.wait()
        raise
    status = child.wait()
    solution.seconds = time.monotonic() - started
    words = _error(lines)
    if words or status:
        raise SolverFailed("CalculiX: " + (words or tr("it ended with status {}").format(status)))


def _lines(child, log, cancel):
    """The child's lines, each told to log(line). cancel() is asked here, in the caller's thread: it may keep a window alive. Raises Cancelled."""
    waiting = queue.Queue()

    def read():
        for line in child.stdout:
            waiting.put(line.rstrip("\n"))
        waiting.put(None)

    threading.Thread(target=read, daemon=True).start()
    asked = time.monotonic()
    while True:
        try:
            line = waiting.get(timeout=_PATIENCE)
        except queue.Empty:
            line = ""
        if cancel and time.monotonic() - asked >= _PATIENCE:
            asked = time.monotonic()
            if cancel():
                raise Cancelled(tr("cancelled"))
        if line is None:
            return
        if line:
            if log:
                log(line)
            yield line


def _error(lines):
    """CalculiX's first error in one line: "*ERROR ..." and the indented lines that go on with it."""
    for i, line in enumerate(lines):
        if line.lstrip().startswith("*ERROR"):
            words = [line.strip()]
            for more in lines[i + 1 : i + 6]:
                if not re.match(r"^ {5,}\S", more):
                    break
                words.append(more.strip())
            return " ".join(words)
    return ""
