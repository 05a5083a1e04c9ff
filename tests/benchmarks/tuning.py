"""Which of the values in the stages' tuning.h matter: tuning.py PROGRAM PARTS -o PAGE.md [--entries NAME,...] [--list].

Meshes the parts of a folder (tests/corpus/generate.py makes some) with each entry lower and higher than it is, and compares with the mesh that comes without. The page has a line an entry: on how
many parts the mesh is another one, the largest change, and a verdict that says whether it rests on one family of parts. A verdict is about these parts: an entry that guards against what none of
them has changes nothing here.

Entries that are changed together and leave a mesh as it is, bit for bit, are taken to leave it so one by one; so halves of a group are tried only where the group changes something.
What was meshed stands in PAGE.md.trials, so that a run can be stopped and gone on with.
"""

import argparse
import collections
import concurrent.futures
import glob
import hashlib
import json
import math
import os
import re
import subprocess
import sys
import tempfile

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MARKS = ("Theory", "Measured", "Guess")
LOWER, HIGHER = 0.7, 1.4
# What counts: less than this is another mesh, not a better or a worse one (guess).
CHANGES = {"cells": 0.05, "min SJ": 0.02, "mean SJ": 0.01}
GROUP = 64  # entries that are changed together at first (measured: of those that left other parts as they were one in a hundred changes a simple part)
LIMIT = 300  # seconds that a mesh may take, which the simple parts meant here need a hundredth of

Entry = collections.namedtuple("Entry", "name value mark meaning header")


def headers():
    return sorted(glob.glob(os.path.join(REPO, "backend", "*", "tuning.h")) + glob.glob(os.path.join(REPO, "backend", "*", "*", "tuning.h")))


def read_header(path):
    """([Entry of a member of the header's struct], names that it lists as its entries)"""
    stage, found, comment = os.path.basename(os.path.dirname(path)), [], []
    with open(path, encoding="utf-8") as file:
        text = file.read()
    body = re.search(r"^struct \w+Tuning \{\n(.*?)^\};", text, re.M | re.S).group(1)
    for line in body.split("POLYCUBE_ENTRIES")[0].splitlines():
        member = re.match(r"  [\w:<>, ]+?\b(\w+)(?: = (.*)|\{(.*)\});", line)
        if line.startswith("  ///"):
            comment.append(line[5:].strip())
        elif member:
            meaning = " ".join(comment)
            marks = re.findall(r"(?:^|(?<=\. ))(Theory(?=: )|Measured(?=: )|Guess(?=\.$))", meaning)
            found.append(Entry(stage + "." + member.group(1), member.group(2) or member.group(3), marks[0].lower() if len(marks) == 1 else None, meaning,
                               os.path.relpath(path, REPO)))
            comment = []
    listed = re.search(r"POLYCUBE_ENTRIES\(([^)]*)\)", body).group(1)
    return found, re.split(r",\s*", listed.strip())


def other_values(value):
    """Lower and higher ones to try; whole numbers stay so, and above 0: none is a switch."""
    if isinstance(value, float):
        return value * LOWER, value * HIGHER
    return tuple(other for other in (min(value - 1, math.floor(value * LOWER)), max(value + 1, math.ceil(value * HIGHER))) if other > 0)


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def mesh(program, part, tuning, options):
    """What comes out: {"result": "complete", "valid" or why there is no mesh, ...}"""
    with tempfile.TemporaryDirectory() as folder:
        output, report = os.path.join(folder, "a.inp"), os.path.join(folder, "report.json")
        command = [program, "mesh", part, "-o", output, "--report", report, *options]
        try:
            run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, env={**os.environ, "POLYCUBE_TUNING": tuning})
        except subprocess.TimeoutExpired:
            return {"result": "no answer"}
        if run.returncode == 2:
            return {"result": "no mesh"}
        if run.returncode != 0:
            raise SystemExit("tuning.py: {} with {}: {}".format(part, tuning or "nothing changed", run.stderr.strip()))
        with open(report, encoding="utf-8") as file:
            found = json.load(file)
        lost = any(count["captured"] < count["total"] for count in (found["cad"][kind] for kind in ("faces", "edges", "vertices")))
        quality = found["quality"]
        return {"result": "valid" if lost else "complete", "cells": found["counts"]["hexes"], "min SJ": quality["min_scaled_jacobian"],
                "mean SJ": quality["mean_scaled_jacobian"], "mesh": digest(output)}


def text_of(change):
    return "{}={!r}".format(*change)


class Trials:
    """What was meshed before, in a file that only grows. Trials of a part count as long as its mesh without changes is the one that it was then."""

    def __init__(self, path, program, options):
        self.path, self.program, self.options, self.known, self.start = path, program, options, collections.defaultdict(dict), {}
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                for line in file:
                    try:
                        found = json.loads(line)
                    except ValueError:
                        continue  # the run was stopped in the middle of it
                    self.known[found["part"], found["options"], json.dumps(found["start"])][found["tuning"]] = found["found"]

    def begin(self, part):
        """The part's mesh without changes, which has to come before others."""
        self.start[part] = mesh(self.program, part, "", self.options)
        return self.start[part]

    def of(self, part):
        """What comes out by what was changed, as text."""
        return self.known[os.path.basename(part), " ".join(self.options), json.dumps(self.start[part])]

    def busy(self):
        """Changes, as texts, that make another mesh of some part: the likeliest to do so of the next."""
        return {tuning for (_, _, start), known in list(self.known.items()) for tuning, found in list(known.items()) if found != json.loads(start)}

    def __call__(self, part, changes):
        tuning = ",".join(map(text_of, changes))
        known = self.of(part)
        if tuning not in known:
            known[tuning] = mesh(self.program, part, tuning, self.options)
            with open(self.path, "a", encoding="utf-8") as file:
                file.write(json.dumps({"part": os.path.basename(part), "options": " ".join(self.options), "start": self.start[part], "tuning": tuning,
                                       "found": known[tuning]}) + "\n")
        return known[tuning]


def try_all(trials, part, changes):
    """(what comes out without changes, {change: what comes out} for those that make another mesh of the part)"""
    start = trials.begin(part)
    known = trials.of(part)
    settled = {text for tuning, found in known.items() if found == start for text in tuning.split(",")}
    found = {change: known[text_of(change)] for way in changes for change in way if known.get(text_of(change), start) != start}

    def split(some):
        some = [change for change in some if text_of(change) not in settled and change not in found]
        if not some:
            return {}
        out = trials(part, some)
        if out == start:
            return {}
        if len(some) == 1:
            return {some[0]: out}
        return {**split(some[:len(some) // 2]), **split(some[len(some) // 2:])}

    busy = trials.busy()
    for way in changes:
        for change in way:
            if text_of(change) in busy:
                found.update(split([change]))
        quiet = [change for change in way if text_of(change) not in busy]
        for first in range(0, len(quiet), GROUP):
            found.update(split(quiet[first:first + GROUP]))
    return start, found


def change_of(start, other):
    """(what changed most, as text; whether it counts)"""
    if start["result"] != other["result"]:
        return "{} -> {}".format(start["result"], other["result"]), True
    if "cells" not in start:
        return "", False
    size = {"cells": other["cells"] / start["cells"] - 1, "min SJ": other["min SJ"] - start["min SJ"], "mean SJ": other["mean SJ"] - start["mean SJ"]}
    most = max(size, key=lambda what: abs(size[what]) / CHANGES[what])
    text = "cells {:+.0%}".format(size[most]) if most == "cells" else "{} {:+.3f}".format(most, size[most])
    return text, abs(size[most]) > CHANGES[most]


def family(part):
    return re.sub(r"_\d+$", "", os.path.splitext(os.path.basename(part))[0])


def verdict(families):
    """`families`: for each that has another mesh whether the change counts. The verdict with each family left out has to be the same."""
    if not families:
        return "changes nothing"
    counting = sorted(name for name, counts in families.items() if counts)
    if len(counting) == 1:
        return "matters, for " + counting[0] + " only"
    return "matters" if counting else "other meshes, as good"


def weight(change):
    """For the largest of several changes, as change_of() gives them."""
    text, counts = change
    return counts, "->" in text, 0 if "->" in text or not text else abs(float(text.split(" ")[-1].rstrip("%")))


def told(part, start):
    quality = ", {} cells, min SJ {:.2f}".format(start["cells"], start["min SJ"]) if "cells" in start else ""
    return "{} ({}{})".format(os.path.splitext(os.path.basename(part))[0], start["result"], quality)


def row(entry, values, parts, results):
    """Texts of the entry's line."""
    names = [name for name in values if name == entry.name or name.startswith(entry.name + ".")]
    changed, families, largest = set(), {}, ("", False)
    for part in parts:
        start, found = results[part]
        for other in (other for (name, _), other in found.items() if name in names):
            change = change_of(start, other)
            changed.add(part)
            families[family(part)] = families.get(family(part), False) or change[1]
            largest = max(largest, change, key=weight)
    shown = ", ".join("{:.4g}".format(values[name]) for name in names)
    return [entry.name, shown, entry.mark, "{} of {}".format(len(changed), len(parts)), largest[0], verdict(families)]


def page(entries, values, parts, results, options):
    """results: {part: (start, {change: found})}"""
    rows = [row(entry, values, parts, results) for entry in entries]
    marks = collections.Counter(entry.mark for entry in entries)
    verdicts = collections.Counter(re.sub(", for .*", "", texts[-1]) for texts in rows)
    return """# Which tuning values matter

`sh resources/polycube bench --tuning FOLDER -o PAGE.md` makes this page: each entry of the stages' `tuning.h` at {} and {} of its value (whole numbers: one less and one more at least), with the
options `{}`, and the mesh compared with that of the values as they are. A change counts from {:.0%} of the cells, {} of the min or {} of the mean scaled Jacobian on, or where the result is another one.
A verdict that rests on one family of parts says so.

An entry that *changes nothing* does so on these parts. Many are there for what none of them has: a folded map, a turning point, a crowded vertex, an inverted cell, several solids, a number of
cells or a time limit asked for.

- Parts: {}.
- Of {} entries {}.
- {}.

| entry | value | mark | parts with another mesh | largest change | verdict |
|---|---|---|---|---|---|
{}
""".format(LOWER, HIGHER, " ".join(options), CHANGES["cells"], CHANGES["min SJ"], CHANGES["mean SJ"], ", ".join(told(part, results[part][0]) for part in parts), len(entries),
           ", ".join("{} have the mark {}".format(marks[mark.lower()], mark.lower()) for mark in MARKS),
           ", ".join("{}: {}".format(*item) for item in sorted(verdicts.items())), "\n".join("| " + " | ".join(texts) + " |" for texts in rows))


def main(words):
    parser = argparse.ArgumentParser(prog="bench --tuning", description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder", nargs="?", help="parts")
    parser.add_argument("-o", "--output", help="page, .md")
    parser.add_argument("--entries", default="", help="these only, such as pad.hopeless,label")
    parser.add_argument("--list", action="store_true", help="entries, values, marks and meanings, no more")
    parser.add_argument("--jobs", type=int, default=1, help="parts side by side")
    arguments = parser.parse_args(words)
    entries = [entry for path in headers() for entry in read_header(path)[0]]
    wanted = [name for name in arguments.entries.split(",") if name]
    for name in wanted:
        if not any(name in (entry.name, entry.name.split(".")[0]) for entry in entries):
            parser.error("there is no '{}'".format(name))
    entries = [entry for entry in entries if not wanted or entry.name in wanted or entry.name.split(".")[0] in wanted]
    if arguments.list:
        for entry in entries:
            print("{:32s} {:24s} {}".format(entry.name, entry.value, entry.meaning))
        return
    if not arguments.folder or not arguments.output:
        parser.error("a folder of parts and -o PAGE are needed")
    parts = sorted(path for path in glob.glob(os.path.join(arguments.folder, "*")) if path.lower().endswith((".step", ".stp", ".brep", ".brp")))
    if not parts:
        parser.error("{} has no parts".format(arguments.folder))
    values = json.loads(subprocess.run([arguments.program, "describe", "--tuning"], capture_output=True, text=True, check=True).stdout)
    entries = [entry for entry in entries if any(name == entry.name or name.startswith(entry.name + ".") for name in values)]  # the program may be older
    options = ["--threads", "1"]
    trials = Trials(arguments.output + ".trials", arguments.program, options)
    names = [name for entry in entries for name in values if name == entry.name or name.startswith(entry.name + ".")]
    changes = [[(name, other_values(values[name])[way]) for name in names if way < len(other_values(values[name]))] for way in range(2)]

    def results_of(part):
        start, found = try_all(trials, part, changes)
        print("{}: {} of {} values make another mesh".format(os.path.basename(part), len(found), sum(map(len, changes))), flush=True)
        return start, found

    results = {}
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        done = {pool.submit(results_of, part): part for part in parts}
        for future in concurrent.futures.as_completed(done):
            results[done[future]] = future.result()
            with open(arguments.output, "w", encoding="utf-8") as file:  # of the parts so far
                file.write(page(entries, values, sorted(results), results, options))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
