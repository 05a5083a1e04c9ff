"""Icons that read at 16 pixels, where trees and menus have them."""

import glob
import os
import re
import unittest
from xml.etree import ElementTree

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ICONS = os.path.join(REPO, "resources", "icons")
#: Units of 64 that a line is wide at least: three quarters of a pixel of 16. Narrower ones wash out to a grey that shows no cells (looked at: 1.5 to 4).
LEAST_WIDTH = 3


class Icons(unittest.TestCase):
    def test_lines_are_wide_enough_at_16_pixels(self):
        paths = sorted(glob.glob(os.path.join(ICONS, "*.svg")))
        self.assertGreater(len(paths), 5)
        for path in paths:
            root = ElementTree.parse(path).getroot()
            self.assertEqual(root.get("viewBox"), "0 0 64 64", path)
            widths = [float(one.get("stroke-width")) for one in root.iter() if one.get("stroke-width")]
            self.assertGreaterEqual(min(widths, default=LEAST_WIDTH), LEAST_WIDTH, path)

    def test_each_is_used(self):
        named = set()
        for path in glob.glob(os.path.join(REPO, "Mod", "Polycube", "**", "*.py"), recursive=True):
            with open(path, encoding="utf-8") as file:
                named.update(re.findall(r'"(Polycube_[A-Z]\w+)"', file.read()))
        there = {os.path.splitext(os.path.basename(path))[0] for path in glob.glob(os.path.join(ICONS, "*.svg"))}
        self.assertEqual(there - named, set())


if __name__ == "__main__":
    unittest.main()
