"""Writes the manual page, polycube.1.gz: `python3 manual.py PROGRAM OUT`. The options and the version are what the program says."""

import gzip
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def escaped(text):
    """As roff reads it: a line must not begin with a dot, and a hyphen is to be one that can be copied."""
    return text.replace("\\", "\\\\").replace("-", "\\-").replace("'", "\\(aq")


def option(entry):
    flag = "--" + ("label" if entry["name"] == "labels" else entry["name"].replace("_", "-"))
    value = "|".join(entry["choices"]) or entry["unit"] or {"labels": "Face3=+X", "frame": "X/Y"}.get(entry["type"], "VALUE")
    head = "\\fB{}\\fP".format(escaped(flag)) if entry["type"] == "bool" else "\\fB{}\\fP \\fI{}\\fP".format(escaped(flag), escaped(value))
    if entry["type"] == "bool" and entry["default"]:
        head += ", \\fB{}\\fP".format(escaped("--no-" + flag[2:]))
    return ".TP\n{}\n\\&{}\n".format(head, escaped(entry["meaning"]))


def main(program, out):
    def said(*arguments):
        return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout.strip()

    with open(os.path.join(HERE, "polycube.1.in"), encoding="utf-8") as file:
        page = file.read()
    options = "".join(option(entry) for entry in json.loads(said("describe"))["options"])
    page = page.replace("@VERSION@", said("--version")).replace("@OPTIONS@\n", options)
    with open(out, "wb") as file:
        file.write(gzip.compress(page.encode(), mtime=0))


if __name__ == "__main__":
    main(*sys.argv[1:])
