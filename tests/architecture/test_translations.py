"""Translations of the workbench: up to date, whole, with the places for numbers and names of the texts that they stand for."""

import ast
import glob
import os
import re
import sys
import unittest

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(REPO, "resources", "translations"))

import update  # noqa: E402  its place is known only now

#: What shows text to users, by the name of the function or method.
SHOWN = {
    *("critical", "warning", "information", "question", "setToolTip", "setText", "setWindowTitle", "addItem", "addAction", "addRow", "setSpecialValueText"),
    *("QLabel", "QPushButton", "QCheckBox", "QProgressDialog", "setLabelText", "showMessage", "tell", "say", "transaction"),
    *("InvalidInput", "StageFailed", "SolverFailed", "Cancelled", "NoMesher", "PolycubeError", "PrintWarning"),
}
#: A sentence in what a function returns or yields, or adds to a list of lines.
SENTENCE = re.compile("[a-z]{2,}.* .*[a-z]{2,}")
#: What no user reads, or reads in any language: names for programs, FreeCAD's own words, what repr() says.
PLAIN = re.compile("<|CalculiX: $|start$|not valid$|node loads on shape|{}: face load|mean {} on|No mechanical|Neither constraint")
#: Languages without a gap; others may have texts that are not translated yet.
WHOLE = ["de"]


def name_of(call):
    """Of the function or method that a node calls; empty for other nodes."""
    return getattr(call.func, "attr", getattr(call.func, "id", "")) if isinstance(call, ast.Call) else ""


def untranslated(node):
    """Texts in an expression that go through no tr(); neither names of attributes nor keys."""
    if isinstance(node, ast.Constant):
        return [node.value] if isinstance(node.value, str) else []
    if name_of(node) in ("tr", "noop", "told", "getattr", "GetString", "GetInt", "GetBool", "ParamGet", "find_spec") or isinstance(node, (ast.Subscript, ast.Compare)):
        return []
    return [text for child in ast.iter_child_nodes(node) for text in untranslated(child)]


class Translations(unittest.TestCase):
    def test_texts_are_found(self):
        texts = update.texts()
        self.assertGreater(len(texts), 100)
        self.assertIn("Element size", texts)

    def test_they_are_up_to_date(self):
        for language in WHOLE:
            self.assertEqual([text for text in update.texts() if not update.read(language).get(text)], [], "python3 resources/translations/update.py")

    def test_what_is_shown_is_translated(self):
        """No words reach a widget, a message or the list of undo steps but through tr()."""
        found = []
        for path in glob.glob(os.path.join(update.WORKBENCH, "*.py")):
            with open(path, encoding="utf-8") as file:
                tree = ast.parse(file.read())
            for node in ast.walk(tree):
                name, texts = name_of(node), []
                if name in SHOWN:
                    texts = [text for one in node.args for text in untranslated(one) if re.search("[a-z]{2}", text)]
                elif name == "append" or isinstance(node, (ast.Return, ast.Yield)):
                    texts = [text for one in ast.iter_child_nodes(node) for text in untranslated(one) if SENTENCE.search(text)]
                found += ["{}, line {}: {}".format(os.path.basename(path), node.lineno, text) for text in texts if not PLAIN.match(text)]
        self.assertEqual(found, [])

    def test_places_stay(self):
        for language in WHOLE:
            for text, told in update.read(language).items():
                self.assertEqual(re.findall(r"\{[^}]*\}", text), re.findall(r"\{[^}]*\}", told), text)
                self.assertEqual(text[-1:] == " ", told[-1:] == " ", text)


if __name__ == "__main__":
    unittest.main()
