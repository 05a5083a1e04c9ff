"""The child process: meshes or labels one job folder and exits. Run as `python3 worker.py FOLDER mesh|labels`, without FreeCAD.

The folder holds shape.brep and options.json; afterwards result.npz and report.json, or labels.npz and labels.json, or error.json. Standard output carries one JSON object per
line: {"progress": [stage, fraction]} or {"log": line}. Exit status: 0 done, 1 invalid input, 2 a stage failed, 3 cancelled.
"""

import json
import os
import re
import sys

import numpy

import engine


def say(**message):
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write_json(path, value):
    with open(path, "w", encoding="utf-8") as file:
        json.dump(value, file)


def argument_name(flag):
    """The argument that an option of the command line is here: time_limit for time-limit. "--label" is given once for every face."""
    return "labels" if flag == "label" else flag.replace("-", "_")


def flatten(mesh):
    """Arrays of the mesh by name; groups as "group/<name>/<what>"."""
    arrays = {
        key: mesh[key]
        for key in (
            *("nodes", "hexes", "hex_block", "quads", "quad_face", "quad_hex", "segments", "segment_edge"),
            *("scaled_jacobian", "edge_ratio", "skew", "warpage"),
        )
    }
    for name, parts in mesh["groups"].items():
        for what, indices in parts.items():
            arrays["group/{}/{}".format(name, what)] = indices
    return arrays


def save_mesh(folder, mesh):
    mesh = mesh.to_dict()
    write_json(os.path.join(folder, "report.json"), mesh["report"])
    numpy.savez(os.path.join(folder, "result.npz"), **flatten(mesh))


def save_labels(folder, labels):
    plain = {name: labels.pop(name) for name in ("valid", "face_label", "edges")}
    write_json(os.path.join(folder, "labels.json"), plain)
    numpy.savez(os.path.join(folder, "labels.npz"), **labels)


def run(folder, what):
    polycube = engine.load()
    parent = os.getppid()
    work, save = {"mesh": (polycube.mesh, save_mesh), "labels": (polycube.labels, save_labels)}[what]
    try:
        made = work(
            brep=read(os.path.join(folder, "shape.brep")),
            progress=lambda stage, fraction: say(progress=[stage, fraction]),
            log=lambda line: say(log=line),
            cancel=lambda: os.getppid() != parent,  # nobody waits for the mesh of a FreeCAD that is gone
            **json.loads(read(os.path.join(folder, "options.json"))),
        )
    except polycube.InvalidInput as error:
        # The engine writes options as on the command line, --time-limit; here they are time_limit.
        message = re.sub(r"--([a-z][a-z-]*)", lambda option: argument_name(option.group(1)), str(error))
        write_json(os.path.join(folder, "error.json"), {"kind": "InvalidInput", "message": message})
        return 1
    except polycube.StageFailed as error:
        found = {"kind": "StageFailed", "message": str(error), "stage": error.stage, "entities": list(error.entities)}
        write_json(os.path.join(folder, "error.json"), found)
        return 2
    except polycube.Cancelled as error:
        write_json(os.path.join(folder, "error.json"), {"kind": "Cancelled", "message": str(error)})
        return 3
    save(folder, made)
    return 0


if __name__ == "__main__":
    if hasattr(os, "setsid"):
        os.setsid()  # a group of its own, so that one kill reaches the processes started from here
    sys.exit(run(*sys.argv[1:]))
