"""The cases of tests/verification at their coarsest size: results of CalculiX on our meshes are as near to the exact ones as they were. Tetrahedra and
convergence are for `sh resources/polycube verify`.
"""

import os
import sys
import unittest

import TestPolycubeSolver as solver_tests

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "verification"))
import cases  # noqa: E402
import page  # noqa: E402
import verify  # noqa: E402


@solver_tests.needs_calculix
class Coarse(unittest.TestCase):
    pass


def _check(case):
    def test(self):
        rows = {row["element"]: row for row in verify.measure(case, case.sizes[0], "hexes") if row["series"] == "hexes"}
        default = rows[page.default(case)]
        for quantity, error in zip(case.quantities, default["errors"]):
            self.assertLess(error, quantity.coarse, quantity.name)

    test.__doc__ = case.title
    return test


for _case in cases.CASES:
    setattr(Coarse, "test_" + _case.name.replace(" ", "_"), _check(_case))


class Page(unittest.TestCase):
    """What the page makes of rows."""

    def test_rate_is_the_exponent_of_the_size_of_the_cells(self):
        curve = [(nodes, 50.0 / nodes, 1.0, 1.0) for nodes in (1000, 8000, 27000)]
        self.assertAlmostEqual(page.rate(curve), 3)
        self.assertIsNone(page.rate([(nodes, 1e-7, 1.0, 1.0) for nodes in (1000, 8000)]))

    def test_seconds_at_an_error(self):
        curve = [(1000, 0.1, 1.0, 1.0), (8000, 0.001, 4.0, 1.0)]
        self.assertAlmostEqual(page.seconds_at(curve, 0.01), 2)
        self.assertEqual(page.seconds_at(curve, 0.2), 1.0)
        self.assertIsNone(page.seconds_at(curve, 1e-4))

    def test_remarks(self):
        case = next(case for case in cases.CASES if case.name == "LE1")
        rows = [
            {"case": "LE1", "series": series, "element": element, "size": size, "nodes": nodes, "seconds": 1.0, "megabytes": 9.0, "errors": [error]}
            for series, element, errors in (("hexes", "C3D20R", (0.2, 0.05, 0.03)), ("tets", "C3D10", (0.2, 0.1, 0.04)))
            for size, nodes, error in zip(case.sizes, (1000, 2000, 4000), errors)
        ]
        rows.append({"case": "LE1", "series": "linear", "size": 100, "failed": "no cells"})
        found = page.curves(rows, case, 0)
        self.assertEqual(page.verdict(case, case.quantities[0], found), "above 0.02, 0.75 of tet10's error")
        text = page.markdown(rows)
        self.assertIn("| NAFEMS LE1, elliptic membrane | hoop stress at D | C3D20R | 1000 2000 4000 | 0.2 0.05 0.03 |", text)
        self.assertIn("Failed: LE1 linear at 100: no cells.", text)
        self.assertIn("in 1 of 1: LE1", text)
