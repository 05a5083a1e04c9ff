#!/usr/bin/python3
"""Quantization against HiGHS on the paper's mixed-integer formulation.

Usage: compare_highs.py POLYCUBE MAPS_FOLDER [--scales 0.5,1,2,4,8,100] [--maps NAME,NAME...] [--repeat 5]

POLYCUBE is the command-line program. For every map NAME of the folder (NAME.tet.mesh, NAME.labels, NAME.polycuboid.mesh) and every scale it
writes its problem and its solution; HiGHS (scipy.optimize.milp) solves the same problem with C2 as lazy constraints found by this
script's own walk over the block edges. The mesh is checked here as well, from its file: conforming, with the Euler characteristic of the
tetrahedra and with all charts. Fails when an objective differs by more than 1e-6, a proof of optimality is missing or a mesh has a fault.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter, deque

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


def medit(path):
    """{keyword: array of rows} of a Medit file; entities with their reference."""
    columns = {"Vertices": 4, "Quadrilaterals": 5, "Tetrahedra": 5, "Hexahedra": 9}
    words = path.read_text().split()
    found, at = {}, 0
    while at < len(words):
        width = columns.get(words[at])
        if width is None:
            at += 1
            continue
        count = int(words[at + 1])
        found[words[at]] = np.array(words[at + 2:at + 2 + count * width], dtype=float).reshape(count, width)
        at += 2 + count * width
    return found


def surface_euler(faces):
    faces = [tuple(f) for f in faces]
    edges = {frozenset((f[k], f[(k + 1) % len(f)])) for f in faces for k in range(len(f))}
    return len({n for f in faces for n in f}) - len(edges) + len(faces)


def faults(path, tets_path, report):
    mesh = medit(path)
    hexes, quads = mesh["Hexahedra"][:, :8].astype(int), mesh["Quadrilaterals"].astype(int)
    sides = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]]
    count = Counter(frozenset(h) for side in sides for h in hexes[:, side].tolist())
    free = {f for f, n in count.items() if n == 1}
    listed = [frozenset(q) for q in quads[:, :4].tolist()]
    tets = medit(tets_path)["Tetrahedra"][:, :4].astype(int)
    facets = Counter(tuple(sorted(t)) for drop in range(4) for t in np.delete(tets, drop, axis=1).tolist())
    edges = Counter(frozenset((q[k], q[(k + 1) % 4])) for q in quads[:, :4].tolist() for k in range(4))
    return [text for wrong, text in (
        (max(count.values()) > 2, "a face of three cells"),
        (any(len(set(h)) < 8 for h in hexes.tolist()), "a cell with a node twice"),
        (set(listed) != free or len(listed) != len(free), "boundary quads that are not the free faces"),
        (set(edges.values()) != {2}, "a boundary that is no manifold"),
        (surface_euler(quads[:, :4].tolist()) != surface_euler([f for f, n in facets.items() if n == 1]), "another Euler characteristic"),
        # A chart whose image has no net area, a label that the given map folds away, has nothing to be kept.
        (set(quads[:, 4].tolist()) | {c + 1 for c in report["collapsed_charts"]} != set(range(1, report["charts"] + 1)), "a chart lost"),
    ) if wrong]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("polycube")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scales", default="0.5,1,2,4,8,100")
    parser.add_argument("--maps", help="names; default: all")
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    failures = 0
    print(f"{'map':8}{'scale':>7}{'blocks':>8}{'hexes':>8}{'objective':>14}{'HiGHS':>14}{'ms':>9}{'HiGHS ms':>10}{'times':>7}")
    with tempfile.TemporaryDirectory() as folder:
        out, report_path, problem_path = (pathlib.Path(folder) / n for n in ("out.mesh", "report.json", "problem.json"))
        names = sorted(path.name.removesuffix(".tet.mesh") for path in options.folder.glob("*.tet.mesh"))
        for name in options.maps.split(",") if options.maps else names:
            base = options.folder / name
            for scale in options.scales.split(","):
                seconds = []
                for _ in range(options.repeat):
                    subprocess.run([options.polycube, "hex", "--tets", f"{base}.tet.mesh", "--labels", f"{base}.labels", "--map",
                                    f"{base}.polycuboid.mesh", "--scale", scale, "-o", out, "--report", report_path, "--problem",
                                    problem_path], check=True, stdout=subprocess.DEVNULL)
                    report = json.loads(report_path.read_text())
                    seconds.append(report["seconds"]["quantize"])
                problem = json.loads(problem_path.read_text())
                start = time.perf_counter()
                objective, _, _ = highs(problem)
                highs_ms = 1000 * (time.perf_counter() - start)
                ms = 1000 * statistics.median(seconds)
                same = abs(objective - report["objective"]) <= 1e-6 * max(1, abs(objective))
                proved = report["optimal"] and report["gap"] <= 1e-9
                wrong = faults(out, pathlib.Path(f"{base}.tet.mesh"), report)
                failures += not same or not proved or bool(wrong)
                print(f"{name:8}{scale:>7}{report['blocks']:8}{report['hexes']:8}{report['objective']:14.6f}{objective:14.6f}{ms:9.3f}"
                      f"{highs_ms:10.1f}{highs_ms / ms:7.0f}{'' if same else '  DIFFERENT'}{'' if proved else '  NOT PROVED'}"
                      + "".join("  " + text.upper() for text in wrong), flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
