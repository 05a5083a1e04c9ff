"""Rows of a sweep as texts: what its lines, its table and its page show."""

import collections
import json
import os
import re

HEAD = ["part", "result", "judge", "exit", "s", "cpu s", "MB", "hexes", "min SJ", "mean SJ", "faces", "edges", "reason"]
# From good to bad; what a judge calls INVALID is worse than any answer without a mesh.
ORDER = ["complete", "valid", "refused", "bad input", "out of time", "no answer", "crash", "INVALID"]
FAULTS = {"crash", "INVALID"}
SUFFIXES = (".step", ".stp", ".brep", ".brp", ".iges", ".igs", ".fcstd")  # of parts, in small letters
BAD = 0.2  # scaled Jacobian below which a cell is marked: good_scaled_jacobian of backend/pipeline/search/tuning.h, a guess


def read_row(folder, key, judged):
    """What is known of a part; with the verdict where the sweep has a judge: an earlier sweep may have left one."""
    with open(os.path.join(folder, "results", key + ".json"), encoding="utf-8") as file:
        row = json.load(file)
    row["key"] = key
    if judged:
        with open(os.path.join(folder, "verdicts", key + ".json"), encoding="utf-8") as file:
            row["verdict"] = json.load(file)["verdict"]
    return row


def write_at_once(path, text):
    """Whoever reads the file finds it whole, or as it was."""
    with open(path + ".new", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".new", path)


def outcome(row):
    """One word of ORDER: the judge's, where it has one."""
    return row["verdict"] if row.get("verdict") in ORDER else row["result"]


def cells(row):
    """The row's texts under HEAD."""
    report = row.get("report")
    texts = [row["part"], row["result"], row.get("verdict", ""), "-" if row["exit"] is None else str(row["exit"]),
             "{:.1f}".format(row["seconds"]), "{:.1f}".format(row["cpu_seconds"]), "{:.0f}".format(row["memory_mb"])]
    if report:
        quality, cad = report["quality"], report["cad"]
        texts += [str(report["counts"]["hexes"]), "{:.3f}".format(quality["min_scaled_jacobian"]), "{:.3f}".format(quality["mean_scaled_jacobian"]),
                  *["{}/{}".format(cad[kind]["captured"], cad[kind]["total"]) for kind in ("faces", "edges")]]
    else:
        texts += [""] * 5
    return [*texts, row["reason"]]


def line(row):
    """The row for a terminal."""
    part, result, judge, _, seconds, _, memory, hexes, least, mean, faces, edges, reason = cells(row)
    rest = ["{:>6s} hexes  SJ {} {}  faces {} edges {}".format(hexes, least, mean, faces, edges) if hexes else "",
            "judge: " + judge if judge not in ("", result) else "", reason[:140]]
    return "{:28s} {:10s} {:>7s} s {:>6s} MB  {}".format(part, result, seconds, memory, "  ".join(text for text in rest if text)).rstrip()


def counts(rows):
    found = collections.Counter(outcome(row) for row in rows)
    return "{} parts: {}".format(len(rows), ", ".join("{} {}".format(found[word], word) for word in ORDER if found[word]))


def families(rows):
    """[(name without the number at its end, rows)], where there are several of one name."""
    found = collections.defaultdict(list)
    for row in rows:
        found[re.sub(r"[-_ ]?\d+$", "", os.path.splitext(row["part"])[0])].append(row)
    return sorted(found.items()) if any(len(members) > 1 for members in found.values()) else []
