"""Seconds per stage of `polycube mesh`: bench.py PROGRAM [PART...]. Without parts: the example part and a few simple solids.

bench.py PROGRAM --labels [PART...]: seconds of labelling and of the map on one thread, on tet meshes from the coarsest to the finest that the pipeline uses, and the
exponents of their growth with the number of tets.

bench.py PROGRAM --tuning FOLDER -o PAGE.md [...]: which of the values in the stages' tuning.h matter (tuning.py).
"""

import json
import math
import os
import subprocess
import sys
import tempfile

import tuning

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SIZES = (1 / 20, 1 / 40)  # of the bounding-box diagonal
TET_SIZES = (1 / 30, 1 / 34, 1 / 42, 1 / 50)  # the pipeline's range


def load_freecad():
    sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib", os.path.join(REPO, "resources", "examples")]
    import FreeCAD
    import Part
    return FreeCAD, Part


def example_parts(freecad, part_module, folder):
    box = part_module.makeBox(20, 16, 4)
    shapes = {
        "cylinder": part_module.makeCylinder(5, 10),
        "plate": box.cut(part_module.makeCylinder(4, 4, freecad.Vector(10, 8, 0))),
        "ball": part_module.makeSphere(5),
    }
    import bracket
    shapes["bracket"] = bracket.make_bracket()
    for name, shape in shapes.items():
        path = os.path.join(folder, name + ".brep")
        shape.exportBrep(path)
        yield path


def run(program, part, size, folder):
    report = os.path.join(folder, "report.json")
    command = [program, "mesh", part, "-o", os.path.join(folder, "out.inp"), "--size", repr(size), "--report", report]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        return done.stderr.strip()
    with open(report) as file:
        return json.load(file)


def exponent(sizes, seconds):
    """Slope of log seconds over log sizes, by least squares."""
    x, y = [math.log(size) for size in sizes], [math.log(max(second, 1e-3)) for second in seconds]
    x_mean, y_mean = sum(x) / len(x), sum(y) / len(y)
    return sum((a - x_mean) * (b - y_mean) for a, b in zip(x, y)) / sum((a - x_mean) ** 2 for a in x)


def growth(program, part, diagonal, folder):
    rows = []
    for share in TET_SIZES:
        report = os.path.join(folder, "label.json")
        done = subprocess.run([program, "label", part, "--size", repr(share * diagonal), "--threads", "1", "--report", report], capture_output=True, text=True)
        if done.returncode != 0:
            return done.stderr.strip()
        with open(report) as file:
            found = json.load(file)
        seconds = {stage["name"]: stage["seconds"] for stage in found["stages"]}
        rows.append((found["counts"]["tets"], seconds["label"], seconds["deform"]))
    tets, label, deform = zip(*rows)
    runs = "  ".join("{} tets {:.2f} + {:.2f} s".format(*row) for row in rows)
    return "{}  growth: label {:.2f}, map {:.2f}, both {:.2f}".format(
        runs, exponent(tets, label), exponent(tets, deform), exponent(tets, [a + b for a, b in zip(label, deform)]))


def main():
    program, parts = sys.argv[1], sys.argv[2:]
    if parts[:1] == ["--tuning"]:
        tuning.main([program, *parts[1:]])
        return
    labels_only = "--labels" in parts
    parts = [part for part in parts if part != "--labels"]
    freecad, part_module = load_freecad()
    with tempfile.TemporaryDirectory() as folder:
        for path in parts or list(example_parts(freecad, part_module, folder)):
            shape = part_module.Shape()
            shape.read(path)
            if labels_only:
                print(f"{os.path.basename(path):24s} {growth(program, path, shape.BoundBox.DiagonalLength, folder)}", flush=True)
                continue
            for share in SIZES:
                size = share * shape.BoundBox.DiagonalLength
                result = run(program, path, size, folder)
                head = f"{os.path.basename(path):24s} size {size:8.3g}"
                if isinstance(result, str):
                    print(head, result)
                    continue
                stages = "  ".join(f"{stage['name']} {stage['seconds']:.2f}" for stage in result["stages"])
                print(f"{head} {result['counts']['hexes']:7d} hexes {result['seconds']:7.2f} s {result['peak_memory_mb']:6.0f} MB  {stages}", flush=True)


if __name__ == "__main__":
    main()
