"""The verdict of another program on a part of a sweep: judge_part.py JUDGE PART RESULT.json MESH.vtu VERDICT.json.

Runs `JUDGE PART MESH --json`, whose output is a JSON object: "verdict" is taken as it is, or else told from "valid" (true, false) and the shares that the mesh has of the
CAD's "vertices", "sharp_edges" (by length) and "faces". The verdict of a part without a mesh is empty.
"""

import json
import subprocess
import sys

from table import write_at_once

FULL = {"vertices": 0.999, "sharp_edges": 0.998, "faces": 0.999}  # shares that count as all: sums of lengths are rounded
LIMIT = 900  # seconds, a guess; there is one because OpenCASCADE's fine tessellations, which a judge may ask for, do not all end


def verdict(found):
    if "verdict" in found:
        return str(found["verdict"])
    if not found["valid"]:
        return "INVALID"
    return "complete" if all(found.get(key, 1) > share for key, share in FULL.items()) else "valid"


def ask(judge, part, mesh):
    try:
        run = subprocess.run([judge, part, mesh, "--json"], capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return {"verdict": "none: no end after {} s".format(LIMIT)}
    try:
        found = json.loads(run.stdout)
        return {**found, "verdict": verdict(found)}
    except (ValueError, KeyError, TypeError):
        return {"verdict": "none: " + ((run.stderr or run.stdout).strip().splitlines() or ["no output"])[-1]}


def main():
    judge, part, result, mesh, output = sys.argv[1:]
    with open(result, encoding="utf-8") as file:
        row = json.load(file)
    found = ask(judge, part, mesh) if "report" in row else {"verdict": ""}
    write_at_once(output, json.dumps(found, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
