"""Parts by script: generate.py FOLDER [--families NAME...] [--per-family 8] [--seed N] [--hard] [--list].

Writes FOLDER/<family>_<number>.step: one valid closed solid each, of random dimensions in a random pose. Equal arguments write equal bytes.
Runs under Debian's /usr/bin/python3 with the package freecad-python3.
"""

import argparse
import math
import os
import re
import sys
import tempfile

from families import FAMILIES, HARD
from families.registry import QUICK_CHECK, Draw
from families.tools import FreeCAD, Part, Unsuitable

ATTEMPTS = 60  # a family whose draws fail so often is wrong
STAMP = (re.compile(r"'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d'"), "'2000-01-01T00:00:00'"), (re.compile(r"translator ([\d.]+) \d+"), r"translator \1")


def fault(shape, quick=False):
    """Why the shape is not one valid closed solid, or None. `quick` leaves out the search for faces that meet one another."""
    if len(shape.Solids) != 1:
        return "{} solids".format(len(shape.Solids))
    solid = shape.Solids[0]
    if len(shape.Faces) != len(solid.Faces) or len(shape.Edges) != len(solid.Edges):
        return "something beside the solid"
    if not solid.isValid():
        return "not valid"
    if not all(shell.isClosed() for shell in solid.Shells):
        return "not closed"
    if solid.Volume <= 0 or any(face.Area <= 0 for face in solid.Faces):
        return "no volume, or a face without area"
    if quick:
        return None
    try:
        solid.check(True)
    except ValueError as error:
        # A sweep along a helix has kinks in its parametrization, which are no fault of the solid.
        found = {line.strip() for line in str(error).splitlines()[1:] if line.strip() and "GeomAbs_C0" not in line}
        return ", ".join(sorted(found)) or None
    return None


def pose(draw):
    """A rotation, each equally likely (Shoemake's quaternion of three uniform numbers), and a translation."""
    u, v, w = draw.real(0, 1), draw.real(0, 2 * math.pi), draw.real(0, 2 * math.pi)
    rotation = FreeCAD.Rotation(math.sqrt(1 - u) * math.sin(v), math.sqrt(1 - u) * math.cos(v), math.sqrt(u) * math.sin(w), math.sqrt(u) * math.cos(w))
    return FreeCAD.Placement(FreeCAD.Vector(*[draw.length(-100, 100) for _ in range(3)]), rotation)


def step_text(solid):
    """As OpenCASCADE writes it, without the time and the count of files that it puts in."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "part.step")
        solid.exportStep(path)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        read = Part.Shape()
        read.read(path)
    for pattern, constant in STAMP:
        text = pattern.sub(constant, text)
    return text, read


def draw_part(name, index, seed, attempt):
    """(text of the file, its solid), or the reason why the draw is no part."""
    draw = Draw(seed, name, index, attempt)
    try:
        shape = {**FAMILIES, **HARD}[name](draw)
    except (Unsuitable, Part.OCCError, ValueError) as error:
        return str(error).strip()
    reason = fault(shape, name in QUICK_CHECK)
    if reason:
        return reason
    solid = shape.Solids[0].copy()
    solid.Placement = pose(draw).multiply(solid.Placement)
    text, read = step_text(solid)
    reason = fault(read, quick=True)
    return "as a file: " + reason if reason else (text, read.Solids[0])


def make(name, index, seed):
    """Part number `index` of a family, as the text of its file and as a solid, and why earlier draws were no part."""
    reasons = []
    for attempt in range(ATTEMPTS):
        drawn = draw_part(name, index, seed, attempt)
        if not isinstance(drawn, str):
            return (*drawn, reasons)
        reasons.append(drawn)
    raise SystemExit("generate: {} {}: no valid part in {} draws: {}".format(name, index, ATTEMPTS, "; ".join(sorted(set(reasons)))))


def main():
    parser = argparse.ArgumentParser(prog="generate.py", description="Machine parts of random dimensions, as STEP files")
    parser.add_argument("folder", nargs="?")
    parser.add_argument("--families", nargs="+", metavar="NAME", help="these only; default: all that are not hard")
    parser.add_argument("--hard", action="store_true", help="the hard families instead")
    parser.add_argument("--per-family", type=int, default=8, metavar="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--list", action="store_true", help="print the families and end")
    given = parser.parse_args()
    if given.list:
        for name, function in [*FAMILIES.items(), *HARD.items()]:
            print("{:16s}{} {}".format(name, "hard:" if name in HARD else "     ", function.__doc__.splitlines()[0]))
        return 0
    names = given.families or list(HARD if given.hard else FAMILIES)
    unknown = [name for name in names if name not in FAMILIES and name not in HARD]
    if unknown or not given.folder or given.per_family < 1:
        parser.error("no family " + ", ".join(unknown) if unknown else "a folder and at least one part per family are needed")
    os.makedirs(given.folder, exist_ok=True)
    for name in names:
        for index in range(given.per_family):
            text, solid, reasons = make(name, index, given.seed)
            path = os.path.join(given.folder, "{}_{:02d}.step".format(name, index))
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            print("{}: {} faces, {:.0f} mm across{}".format(path, len(solid.Faces), solid.BoundBox.DiagonalLength,
                                                            ", {} draws before".format(len(reasons)) if reasons else ""), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
