"""What help(polycube) shows: every call, each with an example that does what it says."""

import doctest

import ObjectsFem
import Part
import TestPolycubeSolve as solve_tests
import TestPolycubeSolver as solver_tests

from freecad import polycube
from freecad.polycube import errors

#: Calls that need CalculiX.
_SOLVING = {"solve", "converge"}


class Checker(doctest.OutputChecker):
    """FreeCAD's writer of CalculiX' input prints what it makes of materials."""

    def check_output(self, want, got, flags):
        said = [line for line in got.splitlines(keepends=True) if "ccx_elset" not in line]
        return super().check_output(want, "".join(said), flags)


class Examples(solve_tests.SolveTest):
    __unittest_skip__ = False  # but for its solving half

    def names(self, example):
        """What the example uses: a block, a mesh of it, an analysis."""
        part = self.part(Part.makeBox(60, 40, 20))
        other = self.document.addObject("Part::Feature", "Other")
        other.Shape = Part.makeBox(60, 40, 20, solve_tests.Vector(0, 0, 20))
        return {
            "polycube": polycube,
            "part": part,
            "other": other,
            "mesh": polycube.create_fem_mesh(part, size=20) if "(mesh" in example else None,
            "analysis": ObjectsFem.makeAnalysis(self.document, "Analysis"),
        }

    def check(self, calls):
        for name in sorted(calls):
            call = getattr(polycube, name)
            (example,) = doctest.DocTestFinder(recurse=False).find(call, name, globs=self.names(call.__doc__))
            self.assertTrue(example.examples, "{} has no example".format(name))
            if name in _SOLVING:
                example.globs["loaded"] = self.loaded()
            told = []
            with self.subTest(call=name):
                self.assertEqual(doctest.DocTestRunner(Checker(), verbose=False).run(example, out=told.append).failed, 0, "".join(told))

    def loaded(self):
        part = self.part(Part.makeBox(60, 40, 20))
        analysis = self.analysis(part, ("Face1",))
        self.add(analysis, "Force", part, "Face2", Force=1000, Direction=(part, ["Face6"]))
        polycube.create_fem_mesh(part, size=20, analysis=analysis)
        self.document.recompute()
        return analysis

    def test_of_meshing(self):
        public = [getattr(polycube, name) for name in polycube.__all__]
        errors_of = {call.__name__ for call in public if isinstance(call, type) and issubclass(call, errors.PolycubeError)}
        self.assertEqual({call.__name__ for call in public if not call.__doc__}, set())
        self.check(set(polycube.__all__) - errors_of - _SOLVING)

    @solver_tests.needs_calculix
    def test_of_solving(self):
        self.check(_SOLVING)


class WrongNames(solve_tests.SolveTest):
    __unittest_skip__ = False

    def test_of_refinements(self):
        mesh = polycube.create_fem_mesh(self.part(Part.makeBox(60, 40, 20)), only_object=True)
        for wrong, right in (("layer", "layers"), ("divison", "divisions"), ("axes", "axis")):
            with self.assertRaisesRegex(polycube.InvalidInput, "did you mean '{}'".format(right)):
                polycube.refine(mesh, wrong, ["Face1"])
        with self.assertRaisesRegex(polycube.InvalidInput, "there are size, levels"):
            polycube.refine(mesh, "colour", ["Face1"])
