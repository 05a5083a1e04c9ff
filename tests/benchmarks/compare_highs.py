#!/usr/bin/python3
"""Quantization against HiGHS on the paper's mixed-integer formulation.

Usage: compare_highs.py POLYCUBE MAPS_FOLDER [--scales 0.5,1,2,4,8,100] [--maps B0,pente,cup,S3] [--repeat 5] [--table]

POLYCUBE is the command-line program. For every map NAME of the folder (NAME.tet.mesh, NAME.labels, NAME.polycuboid.mesh) and every scale it
writes its problem and its solution; HiGHS (scipy.optimize.milp) solves the same problem with C2 as lazy constraints found by this
script's own walk over the block edges. Fails when an objective differs by more than 1e-6 or a proof of optimality is missing.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
from collections import deque

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import coo_array

OCTANTS = [(a, b, c) for a in (1, -1) for b in (1, -1) for c in (1, -1)]


class Milp:
    """min sum of weight * gap, gap >= |l_high - l_low - target|, l integer."""

    def __init__(self, problem):
        self.first = np.cumsum([0] + [len(a["charts"]) for a in problem["axes"]])
        self.terms = [(self.first[d] + low, self.first[d] + high, weight, target)
                      for d, axis in enumerate(problem["axes"]) for low, high, weight, target in axis["terms"]]
        self.integers = int(self.first[-1])
        self.variables = self.integers + len(self.terms)
        self.rows = []
        for k, (low, high, _, target) in enumerate(self.terms):
            gap = self.integers + k
            self.rows.append(({high: 1, low: -1, gap: 1}, target))
            self.rows.append(({high: -1, low: 1, gap: 1}, -target))
        for d, axis in enumerate(problem["axes"]):
            for low, high, at_least in axis["differences"]:
                self.rows.append(({self.first[d] + high: 1, self.first[d] + low: -1}, at_least))
        self.cost = np.zeros(self.variables)
        for k, term in enumerate(self.terms):
            self.cost[self.integers + k] = term[2]

    def solve(self):
        entries = [(r, c, v) for r, (row, _) in enumerate(self.rows) for c, v in row.items()]
        r, c, v = zip(*entries)
        matrix = coo_array((v, (r, c)), shape=(len(self.rows), self.variables)).tocsr()
        lower = np.full(self.variables, 0.0)
        upper = np.full(self.variables, np.inf)
        upper[:self.integers] = 1e5
        for begin, end in zip(self.first, self.first[1:]):  # a shift of an axis changes nothing
            if end > begin:
                lower[begin:end], upper[begin:end] = -1e5, 1e5
                lower[begin] = upper[begin] = 0
        integrality = np.zeros(self.variables)
        integrality[:self.integers] = 1
        result = milp(self.cost, constraints=LinearConstraint(matrix, [b for _, b in self.rows], np.inf), bounds=Bounds(lower, upper),
                      integrality=integrality, options={"mip_rel_gap": 0.0})
        if result.status != 0:
            raise RuntimeError(result.message)
        return np.rint(result.x[:self.integers]).astype(int)

    def objective(self, l):
        return sum(weight * abs(l[high] - l[low] - target) for low, high, weight, target in self.terms)


def violated(problem, first, l):
    """C2 constraints that l breaks: {unknown: coefficient} with sum >= 1, by walking zero-length edges in every octant."""
    unknowns, on_chart = problem["vertex_unknowns"], problem["vertex_on_chart"]
    steps = [[] for _ in unknowns]
    for axis, low, high, start, end in problem["edges"]:
        if l[first[axis] + low] == l[first[axis] + high]:
            steps[start].append((axis, 1, end))
            steps[end].append((axis, -1, start))
    found = {}
    for octant in OCTANTS:
        for source in range(len(unknowns)):
            if not on_chart[source]:
                continue
            seen, queue = {source}, deque([source])
            while queue:
                at = queue.popleft()
                for axis, sign, to in steps[at]:
                    if sign != octant[axis] or to in seen:
                        continue
                    seen.add(to)
                    queue.append(to)
                    both = on_chart[source] & on_chart[to]
                    if not any(both >> d & 1 and unknowns[source][d] != unknowns[to][d] for d in range(3)):
                        continue
                    row = {}
                    for d in range(3):
                        a, b = first[d] + unknowns[source][d], first[d] + unknowns[to][d]
                        if a != b:
                            row[int(b)] = octant[d]
                            row[int(a)] = -octant[d]
                    found[tuple(sorted(row.items()))] = row
    return list(found.values())


def highs(problem):
    model = Milp(problem)
    rounds = 0
    while True:
        rounds += 1
        l = model.solve()
        cuts = violated(problem, model.first, l)
        if not cuts:
            return model.objective(l), rounds, l
        model.rows += [(row, 1) for row in cuts]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("polycube")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scales", default="0.5,1,2,4,8,100")
    parser.add_argument("--maps", default="B0,pente,cup,S3")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--table", action="store_true", help="print the README's table: coarsest mesh of every map")
    options = parser.parse_args()
    failures = 0
    if options.table:
        print("| map | tets | charts | blocks | hexes | seconds | C2 rounds |\n|---|---|---|---|---|---|---|")
    else:
        print(f"{'map':8}{'scale':>7}{'blocks':>8}{'hexes':>8}{'objective':>14}{'HiGHS':>14}{'ms':>9}{'HiGHS ms':>10}{'times':>7}")
    with tempfile.TemporaryDirectory() as folder:
        out, report_path, problem_path = (pathlib.Path(folder) / n for n in ("out.mesh", "report.json", "problem.json"))
        for name in options.maps.split(","):
            base = options.folder / name
            for scale in ["0"] if options.table else options.scales.split(","):
                seconds = []
                for _ in range(options.repeat):
                    subprocess.run([options.polycube, "hex", "--tets", f"{base}.tet.mesh", "--labels", f"{base}.labels", "--map",
                                    f"{base}.polycuboid.mesh", "--scale", scale, "-o", out, "--report", report_path, "--problem",
                                    problem_path], check=True, stdout=subprocess.DEVNULL)
                    report = json.loads(report_path.read_text())
                    seconds.append(report["seconds"]["quantize"])
                if options.table:
                    total = sum(report["seconds"].values())
                    print(f"| {name} | {report['tets']} | {report['charts']} | {report['blocks']} | {report['hexes']} | {total:.2f} | "
                          f"{report['c2_rounds']} |")
                    continue
                problem = json.loads(problem_path.read_text())
                start = time.perf_counter()
                objective, _, _ = highs(problem)
                highs_ms = 1000 * (time.perf_counter() - start)
                ms = 1000 * statistics.median(seconds)
                same = abs(objective - report["objective"]) <= 1e-6 * max(1, abs(objective))
                proved = report["optimal"] and report["gap"] <= 1e-9
                failures += not (same and proved)
                print(f"{name:8}{scale:>7}{report['blocks']:8}{report['hexes']:8}{report['objective']:14.6f}{objective:14.6f}{ms:9.3f}"
                      f"{highs_ms:10.1f}{highs_ms / ms:7.0f}{'' if same else '  DIFFERENT'}{'' if proved else '  NOT PROVED'}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
