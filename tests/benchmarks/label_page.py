"""Pictures and a table of labelled parts: label_page.py PROGRAM FOLDER|PART... [-o PAGE.html|PAGE.png] [-- OPTIONS OF polycube label].

The table goes to standard output as Markdown. The page has the picture of every part; .html keeps each as large as it is and needs no other file,
.png is one sheet. Ends with status 1 where a part could not be labelled.
"""

import argparse
import collections
import glob
import html
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "resources", "sweep"))
from page import embedded, html_table, markdown_table  # noqa: E402
from table import SUFFIXES, write_at_once  # noqa: E402

HEAD = ["part", "faces", "valid", "turning points", "charts", "corners", "stray charts", "zigzags", "edges", "on boundaries", "feature charts", "not captured",
        "label s", "map s", "flipped / tets"]
Row = collections.namedtuple("Row", "name picture report error")


def parts_of(arguments):
    for argument in arguments:
        inside = sorted(glob.glob(os.path.join(argument, "*"))) if os.path.isdir(argument) else [argument]
        yield from (path for path in inside if path.lower().endswith(SUFFIXES))


def label(program, part, files, options):
    """`files`: path of what is written, without suffixes."""
    name = os.path.splitext(os.path.basename(part))[0]
    picture, report = files + ".png", files + ".json"
    run = subprocess.run([program, "label", part, "-o", picture, "--report", report, *options], capture_output=True, text=True)
    if run.returncode:
        return Row(name, None, None, run.stderr.strip())
    with open(report, encoding="utf-8") as file:
        return Row(name, picture, json.load(file), None)


def cells(row):
    """The row's texts under HEAD."""
    if row.error:
        return [row.name, row.error] + [""] * (len(HEAD) - 2)
    report, counts, edges = row.report, row.report["counts"], row.report["edges"]
    seconds = {stage["name"]: stage["seconds"] for stage in report["stages"]}
    faults = ["{} {}".format(count, kind.replace("_", " ")) for kind, count in report["violations"].items() if count and kind != "turning_points"]
    valid = ("yes" if report["valid"] else "no") + (": " + ", ".join(faults) if faults else "")
    flipped = "{} / {}".format(counts["flipped"], counts["tets"]) if report["map"] == "made" else report["map"]
    values = [row.name, counts["faces"], valid, report["violations"]["turning_points"], counts["charts"], counts["corners"], counts["stray_charts"],
              counts["zigzags"], edges["total"], edges["boundary"], edges["feature"], len(edges["lost"]),
              "{:.2f}".format(seconds["label"]), "{:.2f}".format(seconds["deform"]), flipped]
    return [str(value) for value in values]


def reasons(rows):
    """Why CAD edges are not captured, over all parts: [(reason, count)]."""
    found = collections.Counter(edge["reason"] for row in rows if row.report for edge in row.report["edges"]["lost"])
    return sorted(found.items(), key=lambda item: (-item[1], item[0]))


def summary(rows):
    good = [row.report for row in rows if row.report]
    edges = {kind: sum(report["edges"][kind] for report in good) for kind in ("total", "boundary", "feature")}
    return "{} parts: {} labelled, {} valid, {} valid and monotone; of {} CAD edges {} are chart boundaries, {} get feature charts".format(
        len(rows), len(good), sum(report["valid"] for report in good), sum(report["valid"] and report["monotone"] for report in good),
        edges["total"], edges["boundary"], edges["feature"])


def print_table(rows):
    print(markdown_table(HEAD, [cells(row) for row in rows]))
    print(summary(rows))
    for reason, count in reasons(rows):
        print("- {} not captured: {}".format(count, reason))


def write_html(path, rows):
    table = html_table(HEAD, [("", [html.escape(text) for text in cells(row)]) for row in rows])
    figures = []
    for row in rows:
        if row.picture:
            lost = ", ".join("{} ({})".format(edge["edge"], edge["reason"]) for edge in row.report["edges"]["lost"])
            figures.append('<h2>{}</h2><p>Not captured: {}</p><img src="{}">'.format(html.escape(row.name), html.escape(lost or "none"), embedded(row.picture)))
    write_at_once(path, "<!DOCTYPE html><meta charset='utf-8'><title>Labels</title><style>body{{font-family:sans-serif}}td,th{{border:1px solid #ccc;padding:2px 6px}}"
                  "table{{border-collapse:collapse;font-size:80%}}img{{max-width:100%}}</style>\n<h1>Labels</h1><p>{}</p>{}{}\n".format(
                      html.escape(summary(rows)), table, "\n".join(figures)))


def write_sheet(path, rows, columns=4, inches=7):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    lines = -(-len(rows) // columns)
    figure, axes = pyplot.subplots(lines, columns, figsize=(columns * inches, lines * 1.12 * inches), squeeze=False)
    for place in axes.flat:
        place.axis("off")
    for place, row in zip(axes.flat, rows):
        if row.error:
            place.set_title(row.name + ": " + row.error[:60], fontsize=14, color="red")
            continue
        text = cells(row)
        place.set_title("{}: valid {}, {} turning points, {} charts,\n{} of {} edges not captured".format(
            text[0], text[2][:40], text[3], text[4], text[11], text[8]), fontsize=14, color="black" if row.report["valid"] and row.report["monotone"] else "red")
        place.imshow(pyplot.imread(row.picture), interpolation="antialiased")
    figure.tight_layout()
    figure.savefig(path, dpi=70)


def main():
    arguments, options = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1:]
    parser = argparse.ArgumentParser(prog="polycube labels", description="Pictures and a table of labelled parts")
    parser.add_argument("program", help=argparse.SUPPRESS)
    parser.add_argument("parts", nargs="+", help="CAD parts, or folders of them")
    parser.add_argument("-o", "--output", help="page with the pictures, .html or .png")
    given = parser.parse_args(arguments)
    if given.output and not given.output.endswith((".html", ".png")):
        parser.error(given.output + ": the suffix must be .html or .png")
    with tempfile.TemporaryDirectory() as folder:
        rows = [label(given.program, part, os.path.join(folder, str(k)), options) for k, part in enumerate(parts_of(given.parts))]
        if not rows:
            parser.error("there is no part in " + ", ".join(given.parts))
        print_table(rows)
        if given.output:
            (write_html if given.output.endswith(".html") else write_sheet)(given.output, rows)
    return 1 if any(row.error for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
