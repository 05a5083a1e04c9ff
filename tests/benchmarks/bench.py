"""Seconds per stage of `polycube mesh`: bench.py PROGRAM [PART...]. Without parts: the example part and a few simple solids."""

import json
import os
import subprocess
import sys
import tempfile

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SIZES = (1 / 20, 1 / 40)  # of the bounding-box diagonal


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


def main():
    program, parts = sys.argv[1], sys.argv[2:]
    freecad, part_module = load_freecad()
    with tempfile.TemporaryDirectory() as folder:
        for path in parts or list(example_parts(freecad, part_module, folder)):
            shape = part_module.Shape()
            shape.read(path)
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
