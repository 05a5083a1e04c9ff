"""The page of a sweep, from the files in its folder: page.py FOLDER PAGE.(html|md). HTML holds the pictures and needs no other file; Markdown is the table only."""

import base64
import html
import json
import os
import sys

from table import BAD, HEAD, ORDER, cells, counts, families, outcome, read_row, write_at_once

STYLE = """body{font-family:sans-serif;margin:1em 2em}table{border-collapse:collapse;font-size:80%}td,th{border:1px solid #ccc;padding:2px 6px}td{vertical-align:top}
.complete{background:#e4f4e4}.valid{background:#fff6d8}.refused,.bad.input{background:#ffe6cc}.out.of.time,.no.answer{background:#ffd9d0}
.crash,.INVALID{background:#f6b8b8}
figure{display:inline-block;margin:8px;width:660px;vertical-align:top}img{width:100%}figcaption{font-size:85%}"""


def markdown_table(head, lines):
    first, *rest = ["| " + " | ".join(text.replace("|", "\\|") for text in texts) + " |\n" for texts in [head, *lines]]
    return first + "|" + "---|" * len(head) + "\n" + "".join(rest)


def markdown(rows, settings):
    text = counts(rows) + "\n\n" + markdown_table(HEAD, [cells(row) for row in rows])
    if families(rows):
        text += "\n" + markdown_table(["family", "parts", *ORDER], family_cells(rows))
    return text + "\nOptions: `{}`, time limit {:g} s, processor time limit {:g} s.\n".format(settings["options"], settings["time_limit"], settings["cpu_limit"])


def family_cells(rows):
    for name, members in families(rows):
        words = [outcome(row) for row in members]
        yield [name, str(len(members)), *[str(words.count(word) or "") for word in ORDER]]


def html_table(head, lines):
    """`lines`: (class, HTML of the cells)"""
    body = "".join("<tr class='{}'>{}</tr>\n".format(kind, "".join("<td>{}</td>".format(text) for text in texts)) for kind, texts in lines)
    return "<table><tr>{}</tr>\n{}</table>\n".format("".join("<th>{}</th>".format(name) for name in head), body)


def embedded(path):
    """A picture as an address that holds it."""
    with open(path, "rb") as file:
        return "data:image/{};base64,{}".format(os.path.splitext(path)[1][1:], base64.b64encode(file.read()).decode())


def figure(folder, row):
    image = embedded(os.path.join(folder, "pictures", row["key"] + ".webp"))
    texts = cells(row)
    return "<figure id='{}'><img src='{}' alt=''><figcaption class='{}'><b>{}</b>: {}. {}</figcaption></figure>\n".format(
        html.escape(row["key"], True), image, outcome(row), html.escape(row["part"]), html.escape(texts[1]), html.escape(row["reason"]))


def page(folder, rows, settings):
    lines = []
    for row in rows:
        texts = [html.escape(text) for text in cells(row)]
        texts[0] = "<a href='#{}'>{}</a>".format(html.escape(row["key"], True), texts[0])
        lines.append((outcome(row), texts))
    worst_first = sorted(rows, key=lambda row: (-ORDER.index(outcome(row)), row["part"]))
    tables = html_table(HEAD, lines)
    if families(rows):
        tables += "<h2>Families</h2>" + html_table(["family", "parts", *ORDER], [("", [html.escape(text) for text in texts]) for texts in family_cells(rows)])
    return ("<!DOCTYPE html><meta charset='utf-8'><title>Sweep</title><style>{}</style>\n<h1>Sweep</h1><p>{}</p>"
            "<p>Options of the mesher: <code>{}</code>; time limit {:g} s, processor time limit {:g} s.</p>\n{}"
            "<h2>Pictures</h2><p>Worst first. Cells of a scaled Jacobian below {} are orange to red, those inside are red dots; CAD edges without mesh edges are red. "
            "Without a mesh: the part, with what the reason names in red.</p>\n{}").format(
                STYLE, html.escape(counts(rows)), html.escape(settings["options"]), settings["time_limit"], settings["cpu_limit"], tables, BAD,
                "".join(figure(folder, row) for row in worst_first))


def main():
    folder, output = sys.argv[1:]
    with open(os.path.join(folder, "settings.json"), encoding="utf-8") as file:
        settings = json.load(file)
    rows = [read_row(folder, key, settings["judge"]) for key in sorted(settings["parts"])]
    write_at_once(output, markdown(rows, settings) if output.endswith(".md") else page(folder, rows, settings))
    return 0


if __name__ == "__main__":
    sys.exit(main())
