"""What the mesher says in FreeCAD's language: the table of its messages is that of the engine's sources, and every message comes through whole."""

import glob
import importlib
import os
import re
import sys
import types
import unittest
from unittest import mock

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(REPO, "resources", "translations"))

import update  # noqa: E402  its place is known only now

#: Sources whose messages no window shows: the command line, files that FreeCAD reads itself, output files, `polycube hex`, tuning by hand.
NOT_SHOWN = re.compile(
    r"cli/|python/|label/choice\.|tet/worker/|cad/(document|exchange|read|step)\.|fem/(inp|med|medit|unv|vtu|write)\.|job/npz\.|core/draft\.|pipeline/(hex_map|inspect|trial_tuning)\."
)
#: Statements that make a message, and those that only log or check what no part can bring about.
SAYS = re.compile(
    r"InvalidInput|StageFailed|Unusable|Standard_Failure|OutOfTime|\bfail\(|\badd\(|warnings\.|lines\.push_back|warn_of|thin_walls\.|coarse_circles\.|constraints\.push_back"
    r"|kNothingPasses|EdgeCapture|\.reason =|\.name =|string (text|line|start|name|bound) =|text \+=|faces \+=|return .*(Gmsh|wall)|char\* kind ="
)
SAYS_NOT = re.compile(r"monitor_?\.log|[Pp]lan\b.*name|\.name = \"(sharp|no) CAD|add\(\", (other|without) |\.meaning|arrays\.add|invalid_argument|std::cerr|faults|fit: cell at")
#: The engine's own slips, of which a user is told that there was one, in English.
SLIPS = re.compile(
    r"on its plane|the (quantization|block scales|structure|association|map does not put) |the map does not have one|a chart('s| refers| has)|a boundary triangle|a tetrahedron refers"
    r"|the boundary triangles are|the mesh has no tetrahedra|the scale of the quantization|a job is mesh|is no list of texts"
)
CALLS = {"--bias", "--interfaces"}  # of failed stages, which have them as on the command line


def texts_of_engine(all_there_are=False):
    """(file, piece of text of two words or more) of what the engine may say to a window, or of all texts in its sources."""
    for path in sorted(glob.glob(os.path.join(REPO, "backend", "**", "*.cpp"), recursive=True)):
        name = os.path.relpath(path, os.path.join(REPO, "backend"))
        if NOT_SHOWN.match(name) and not all_there_are:
            continue
        with open(path, encoding="utf-8") as file:
            source = re.sub(r'//[^"\n]*$|^#.*$', "", file.read(), flags=re.MULTILINE)
        for statement in re.split(r"[;{}]\s*\n", source):
            if all_there_are or (SAYS.search(statement) and not SAYS_NOT.search(statement)):
                for text in re.findall(r'"((?:[^"\\\n]|\\.)*)"', re.sub(r'"\s*\n\s*"', "", statement)):
                    yield from ((name, piece) for piece in pieces(text))


def pieces(text):
    for piece in re.split(r"%[-.\d]*[a-z]", text):
        piece = re.sub(r"--([a-z][a-z-]*)", lambda option: option.group() if option.group() in CALLS else option.group(1).replace("-", "_"), piece)
        piece = piece.strip(" :;,.'(")
        if len(re.findall("[A-Za-z]{2,}", piece)) > 1 and not SLIPS.match(piece):
            yield piece


class EngineWords(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        # The package needs FreeCAD, these two modules of it do not.
        package = types.ModuleType("polycube_words")
        package.__path__ = [update.WORKBENCH]
        self.enterContext(mock.patch.dict(sys.modules, {"polycube_words": package}))
        self.words = importlib.import_module("polycube_words.words")
        self.engine_words = importlib.import_module("polycube_words.engine_words")
        self.enterContext(mock.patch.object(self.words, "_language", lambda: "de"))

    def test_the_table_has_what_the_engine_says(self):
        said = list(texts_of_engine())
        self.assertGreater(len(said), 150)
        # what a text has to look like is a place of its own in the table
        said = [(file, re.sub("(is not of the form|leaves no room for) .*", r"\1", piece)) for file, piece in said]
        self.assertEqual([one for one in said if not any(one[1] in text for text in self.engine_words.MESSAGES)], [])

    def test_the_engine_says_what_the_table_has(self):
        """A message that the engine has no more leaves the table."""
        said = [text for _, text in texts_of_engine(all_there_are=True)]
        for text in self.engine_words.MESSAGES:
            for piece in pieces(text.replace("{}", "%s")):
                self.assertTrue(any(piece in one or one in piece for one in said), text)

    def test_every_message_is_told(self):
        """With what stands in its places as it was, and as that message, not as another that it fits too."""
        german = update.read("de")
        for text in self.engine_words.MESSAGES:
            places = text.count("{}")
            for filled in (["Face12", "+X", "1e-07"], ["3", "Edge4=6", "Solid1"]):
                line = text.format(*filled[:places])
                self.assertEqual(self.engine_words.told(line), german[text].format(*filled[:places]), line)

    def test_lines_of_several_messages(self):
        for line, told in (
            ("sizes: 'Face3=0,5' has a comma where a point is wanted, as in 0.5", "sizes: 'Face3=0,5' hat ein Komma, wo ein Punkt stehen muss, wie in 0.5"),
            ("size must be greater than 0, not -1", "size muss größer als 0 sein, nicht -1"),
            ("order must be at most 2, not 3", "order darf höchstens 2 sein, nicht 3"),
            ("hexes: 'viele' is not a whole number", "hexes: 'viele' ist nicht eine ganze Zahl"),
            ("labels: Face99 does not exist, the part has 6 faces", "labels: Face99 gibt es nicht, das Bauteil hat 6 Flächen"),
            ("labels: Face1 cannot be +X, it does not face that way; it can be -X", "labels: Face1 kann nicht +X sein, sie zeigt nicht dorthin; möglich ist -X"),
            ("Solid2: the solid has no volume", "Solid2: der Körper hat kein Volumen"),
            ("no valid mesh satisfies 'Face5: 12 elements round the bore', 'Edge4=6'", "kein gültiges Netz erfüllt 'Face5: 12 Elemente um die Bohrung', 'Edge4=6'"),
            ("Bolt, Plate: 12 cells stay inverted; --interfaces separate meshes each solid by itself", "Bolt, Plate: 12 Zellen bleiben umgestülpt; --interfaces separate vernetzt jeden Körper für sich"),
            ("charts touch, the boundary of the blocks is not a manifold: charts 3, 17, with Face2=+X set by hand", "Felder berühren sich, der Rand der Blöcke ist keine Mannigfaltigkeit: Felder 3, 17, mit Face2=+X von Hand gesetzt"),
            ("Face2-Face7+Face8: 1 element through the wall, not 3", "Face2-Face7+Face8: 1 Element durch die Wand, nicht 3"),
            ("left out beside the solid: 2 loose faces, 1 loose edge", "neben dem Körper weggelassen: 2 lose Flächen, 1 lose Kante"),
            ("OpenCASCADE cannot join the solids: BRep_API: command not done", "OpenCASCADE kann die Körper nicht verbinden: BRep_API: command not done"),
        ):
            self.assertEqual(self.engine_words.told(line), told)

    def test_what_is_not_known_stays(self):
        for line in ("", "Block is out of sorts", "faces", "Face3: 7 of 9", "*ERROR in calinput: no bone"):
            self.assertEqual(self.engine_words.told(line), line)

    def test_english_stays_english(self):
        with mock.patch.object(self.words, "_language", lambda: "en"):
            for text in self.engine_words.MESSAGES:
                self.assertEqual(self.engine_words.told(text), text)


if __name__ == "__main__":
    unittest.main()
