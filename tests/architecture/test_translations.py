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
}
#: Languages without a gap; others may have texts that are not translated yet.
WHOLE = ["de"]


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
        for path in glob.glob(os.path.join(update.WORKBENCH, "*.py")):
            with open(path, encoding="utf-8") as file:
                tree = ast.parse(file.read())
            for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
                if getattr(call.func, "attr", getattr(call.func, "id", "")) in SHOWN:
                    words = [one.value for one in call.args if isinstance(one, ast.Constant) and re.search("[a-z]{2}", str(one.value))]
                    self.assertEqual(words, [], "{}, line {}".format(os.path.basename(path), call.lineno))

    def test_places_stay(self):
        for language in WHOLE:
            for text, told in update.read(language).items():
                self.assertEqual(re.findall(r"\{[^}]*\}", text), re.findall(r"\{[^}]*\}", told), text)
                self.assertEqual(text[-1:] == " ", told[-1:] == " ", text)


if __name__ == "__main__":
    unittest.main()
