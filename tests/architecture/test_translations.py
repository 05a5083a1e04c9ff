"""Translations of the workbench: up to date, whole, with the places for numbers and names of the texts that they stand for."""

import os
import re
import sys
import unittest

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(REPO, "resources", "translations"))

import update  # noqa: E402  its place is known only now

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

    def test_places_stay(self):
        for language in WHOLE:
            for text, told in update.read(language).items():
                self.assertEqual(re.findall(r"\{[^}]*\}", text), re.findall(r"\{[^}]*\}", told), text)
                self.assertEqual(text[-1:] == " ", told[-1:] == " ", text)


if __name__ == "__main__":
    unittest.main()
