"""Brings the translations up to date with the workbench: python3 resources/translations/update.py [LANGUAGE...], a new language by its code, as fr.

Texts are what tr() and noop() are called with, noop() with tuples of texts too, what the forms in resources/ui hold, and names and meanings of the mesher's
options. What is there stays; what is new is marked unfinished; what no text stands for any more goes. Without a language all that there are.
"""

import ast
import glob
import json
import os
import sys
from xml.etree import ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
WORKBENCH = os.path.join(HERE, "..", "..", "Mod", "Polycube", "freecad", "polycube")


def texts():
    """All texts of the window, each once, in the order of files and lines."""
    found = {}
    for path in sorted(glob.glob(os.path.join(WORKBENCH, "*.py"))):
        with open(path, encoding="utf-8") as file:
            tree = ast.parse(file.read())
        calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("tr", "noop")]
        for call in sorted(calls, key=lambda call: (call.lineno, call.col_offset)):
            # a text, or a tuple of texts
            found.update((one.value, None) for one in getattr(call.args[0], "elts", call.args[:1]) if isinstance(one, ast.Constant))
    for path in sorted(glob.glob(os.path.join(HERE, "..", "ui", "*.ui"))):
        found.update((string.text, None) for string in ElementTree.parse(path).iter("string") if not string.get("notr"))
    with open(os.path.join(WORKBENCH, "engine.json"), encoding="utf-8") as file:
        for option in json.load(file)["options"]:
            found[option["name"].replace("_", " ").capitalize()] = None
            found[option["meaning"]] = None
            found.update((choice, None) for choice in option["choices"] if choice.islower())  # words; the others are names and numbers
    return list(found)


def path_of(language):
    return os.path.join(HERE, "polycube_{}.ts".format(language))


def read(language):
    """{text: translation}"""
    if not os.path.exists(path_of(language)):
        return {}
    messages = ElementTree.parse(path_of(language)).iter("message")
    return {message.findtext("source"): message.findtext("translation") or "" for message in messages}


def write(language, translations):
    """The file anew; texts without a translation are unfinished."""
    root = ElementTree.Element("TS", version="2.1", language=language, sourcelanguage="en")
    context = ElementTree.SubElement(root, "context")
    ElementTree.SubElement(context, "name").text = "Polycube"
    for text in texts():
        message = ElementTree.SubElement(context, "message")
        ElementTree.SubElement(message, "source").text = text
        told = translations.get(text, "")
        ElementTree.SubElement(message, "translation", {} if told else {"type": "unfinished"}).text = told
    ElementTree.indent(root)
    with open(path_of(language), "w", encoding="utf-8") as file:
        file.write('<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n' + ElementTree.tostring(root, encoding="unicode") + "\n")


def main(languages):
    for language in languages or [os.path.basename(path)[9:-3] for path in glob.glob(path_of("*"))]:
        before = read(language)
        write(language, before)
        missing = sum(not before.get(text) for text in texts())
        print("{}: {} texts, {} without a translation".format(language, len(texts()), missing))


if __name__ == "__main__":
    main(sys.argv[1:])
