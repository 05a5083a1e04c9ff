"""The house rules that a machine can check."""

import os
import re
import subprocess
import sys
import unittest

REPO = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(REPO, "tests", "benchmarks"))
import tuning  # noqa: E402
BACKEND = os.path.join(REPO, "backend")
# What no stage may include but itself.
TOP = ["job", "cli", "python"]
THIRD_PARTY = {
    "OCCT": r"(BRep|TopoDS|TopExp|TopAbs|TopLoc|TopTools|Geom|gp_|Standard_|STEP|IFSelect|ShapeFix|Poly_|Bnd_|BOPAlgo|GProp|Shape[A-Z]\w+_|Handle)\w*\.hxx",
    "Gmsh": r"gmsh\w*\.h",
    "LEMON": r"lemon/",
    "pybind11": r"pybind11/",
    "Boost": r"boost/",
    "nlohmann": r"nlohmann/",
    "MED": r"med\w*\.h",
    "nanoflann": r"nanoflann",
}
MAX_LINES = 800


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def tracked():
    """Files under version control, or all but what is made where there is none (a source archive, a machine without git)."""
    try:
        run = subprocess.run(["git", "-C", REPO, "ls-files", "-z", "--cached", "--others", "--exclude-standard"], capture_output=True, text=True)
        names = [name for name in run.stdout.split("\0") if name] if run.returncode == 0 else None
    except FileNotFoundError:
        names = None
    if names is None:
        names = [os.path.relpath(os.path.join(folder, name), REPO) for folder, _, files in os.walk(REPO) for name in files]
        names = [name for name in names if not (name.startswith(("build", ".git" + os.sep)) or name.endswith((".so", ".pyc")))]
    return [name for name in names if os.path.isfile(os.path.join(REPO, name))]


def stages():
    """Stage -> stages it may use, as stages.cmake has it."""
    text = read(os.path.join(BACKEND, "stages.cmake"))
    uses = {}
    for name, arguments in re.findall(r"^polycube_stage\((\w+)([^)]*)\)", text, re.M):
        match = re.search(r"\bUSES((?: \w+)*?)(?= LINKS| PUBLIC_LINKS| SYSTEM|$)", arguments)
        uses[name] = match.group(1).split() if match else []
    return uses


def sources(stage, suffixes=(".h", ".cpp")):
    for folder, _, files in os.walk(os.path.join(BACKEND, stage)):
        for name in sorted(files):
            if name.endswith(suffixes):
                yield os.path.join(folder, name)


def includes(path, kind='"'):
    close = {'"': '"', "<": ">"}[kind]
    return re.findall(rf"^\s*#\s*include\s+{kind}([^{close}]+){close}", read(path), re.M)


class Stages(unittest.TestCase):
    uses = stages()

    def test_the_list_was_read(self):
        self.assertEqual(list(self.uses)[0], "core")
        self.assertEqual(list(self.uses)[-2:], ["pipeline", "job"])
        self.assertEqual(len(self.uses), 14)

    def test_stages_use_earlier_ones_only(self):
        order = list(self.uses)
        for stage, used in self.uses.items():
            for other in used:
                self.assertLess(order.index(other), order.index(stage), f"{stage} uses {other}")

    def test_includes_follow_the_list(self):
        seen = 0
        for stage, used in self.uses.items():
            allowed = {stage, *used}
            while True:  # what a used stage uses may come along in its headers
                more = allowed | {other for name in allowed for other in self.uses[name]}
                if more == allowed:
                    break
                allowed = more
            for path in sources(stage):
                for include in includes(path):
                    seen += 1
                    self.assertIn(include.split("/")[0], allowed, f"{os.path.relpath(path, REPO)} includes {include}")
        self.assertGreater(seen, 50)

    def test_nothing_includes_the_top(self):
        for stage in self.uses:
            for path in sources(stage):
                for include in includes(path):
                    top = include.split("/")[0]
                    self.assertFalse(top in TOP and top != stage, f"{os.path.relpath(path, REPO)} includes {include}")

    def test_every_folder_is_a_stage_with_a_page(self):
        folders = {name for name in os.listdir(BACKEND) if os.path.isdir(os.path.join(BACKEND, name))}
        self.assertEqual(folders, set(self.uses) | {"cli", "python"})
        for name in folders:
            self.assertTrue(os.path.exists(os.path.join(BACKEND, name, "README.md")), f"backend/{name} has no README.md")

    def test_pages_are_short(self):
        for name in tracked():
            if name.startswith("backend/") and name.endswith(".md"):
                with open(os.path.join(REPO, name), encoding="utf-8") as page:
                    self.assertLessEqual(len(page.read().split()), 1000, name)


class PublicHeaders(unittest.TestCase):
    """A stage's public headers are those that other folders include."""

    def public(self):
        found = set()
        for folder in sorted(os.listdir(BACKEND)):
            if not os.path.isdir(os.path.join(BACKEND, folder)):
                continue
            for path in sources(folder):
                found |= {include for include in includes(path) if not include.startswith(folder + "/")}
        return sorted(found)

    def test_no_third_party_types(self):
        headers = self.public()
        self.assertGreater(len(headers), 12)
        for header in headers:
            path = os.path.join(BACKEND, header)
            for include in includes(path, "<") + includes(path, '"'):
                for library, pattern in THIRD_PARTY.items():
                    self.assertIsNone(re.match(pattern, include), f"{header} includes {library}'s {include}")

    def test_no_two_types_share_a_name(self):
        """All stages share one namespace: of two types of one name the linker takes one's functions for both, and it takes no note of it."""
        where = {}
        for folder in sorted(os.listdir(BACKEND)):
            for path in sources(folder, (".h", ".cpp")):
                named = re.sub(r"^namespace \{$.*?^\}  // namespace$", "", read(path), flags=re.M | re.S)
                for name in re.findall(r"^(?:template <.*>\s*)?(?:struct|class|enum class) (\w+)\b(?!::)[^;()]*?\{", named, flags=re.M):
                    where.setdefault(name, set()).add(os.path.relpath(path, BACKEND))
        self.assertGreater(len(where), 100)
        self.assertEqual({name: paths for name, paths in where.items() if len(paths) > 1}, {})

    def test_pragma_once(self):
        for folder in sorted(os.listdir(BACKEND)):
            for path in sources(folder, (".h",)):
                self.assertIn("#pragma once", read(path), path)


class Files(unittest.TestCase):
    SOURCE = (".h", ".cpp", ".py", ".cmake", ".sh", ".ui")

    def test_no_file_is_too_long(self):
        for name in tracked():
            if name.endswith(self.SOURCE) or name.startswith("resources/polycube"):
                self.assertLessEqual(read(os.path.join(REPO, name)).count("\n"), MAX_LINES, name)

    def test_no_paths_of_one_machine(self):
        # Spelt so that this file does not match itself.
        pattern = re.compile("/" + r"(work|home/\w+|root|tmp/\w+)/|" + "/" + r"tmp/[\w-]+")
        for name in tracked():
            try:
                text = read(os.path.join(REPO, name))
            except UnicodeDecodeError:
                continue
            match = pattern.search(text)
            self.assertIsNone(match, f"{name}: {match and match.group()}")

    def test_no_notes_to_self(self):
        pattern = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X|HA" + r"CK)\b")
        for name in tracked():
            if name.endswith(self.SOURCE):
                self.assertIsNone(pattern.search(read(os.path.join(REPO, name))), name)

    def test_compounds_are_made_by_the_class(self):
        """Part.makeCompound of FreeCAD 1.0 is a crash in a Python that FreeCAD has not started, Part.Compound is not."""
        outside = [name for name in tracked() if name.endswith(".py") and not name.startswith(("Mod/", "tests/freecad/"))]
        for needed in ("tests/python/support.py", "tests/corpus/families/tools.py", "resources/sweep/picture.py"):
            self.assertIn(needed, outside)
        for name in outside:
            self.assertNotIn("Part.make" + "Compound(", read(os.path.join(REPO, name)), name)

    def test_the_solver_is_found_by_everything_that_runs_it(self):
        """By ccx.find() of resources/examples."""
        for name in tracked():
            if name.endswith(".py"):
                self.assertNotRegex(read(os.path.join(REPO, name)), r"""\[["']ccx["'],""", name)

    def test_the_compiled_module_stays_out_of_freecad(self):
        """Only the child process imports it: FreeCAD's Python may be another one, and its CAD kernel too."""
        seen = 0
        for name in tracked():
            if name.startswith("Mod/") and name.endswith(".py"):
                seen += 1
                if os.path.basename(name) != "worker.py":
                    self.assertNotRegex(read(os.path.join(REPO, name)), r"import _polycube|from _polycube|import_module\((?!.femsolver)", name)
        self.assertGreater(seen, 10)

    def test_the_version_stands_in_one_place(self):
        """In package.xml, where FreeCAD's Addon Manager wants it; CMake and the workbench read it there."""
        version = re.search("<version>(.*)</version>", read(os.path.join(REPO, "Mod", "Polycube", "package.xml"))).group(1)
        pattern = re.compile(rf"(?<![\d.]){re.escape(version)}(?![\d.])")
        for name in tracked():
            if name.endswith(self.SOURCE + (".txt", ".json", ".in")) and not name.startswith("tests/corpus"):
                self.assertIsNone(pattern.search(read(os.path.join(REPO, name))), name)

    def test_no_randomness_without_a_seed(self):
        pattern = re.compile(r"\b(random_device|srand|std::rand|time\(nullptr\))")
        for stage in Stages.uses:
            for path in sources(stage):
                self.assertIsNone(pattern.search(read(path)), path)


class Tuning(unittest.TestCase):
    """What somebody chose stands in the stages' tuning.h, with a reason (backend/README.md)."""

    # Constants of a number elsewhere that nobody can choose otherwise: facts, kinds and tables, formats, limits of what is taken and told, shares of work.
    OTHERS = {
        "core": {"kSquare", "kSteepest", "kMostHexes", "kMostLevels", "kWorstCells", "kInnerPoints"},
        "cad": {"kMostDeflated", "kLargest", "kSmallest", "kTail", "kHead", "kFaults"},
        "tet": {"kMagic", "kEnd", "kCannotWrite", "kNamed"},
        "label": {"kDegree", "kForbidden", "kLongest"},
        "deform": {"kChunk"},
        "quantize": {"kWeightSum", "kUnlimited", "kNone", "kLayers", "kStructure"},
        "pad": {"kIgnored", "kWanted", "kOutside", "kInside", "kUnknown"},
        "refine": {"kFar"},  # a place in a grid of thirds
        "fit": {"kChunk"},
        "fem": {"kChunk", "kSolverPoints", "kPoints", "kPerLine", "kWidth", "kNodes", "kElements", "kQuad", "kHexahedron", "kQuadraticQuad", "kQuadraticHexahedron"},
        "pipeline": {"kTold", "kNamed", "kCountMiss", "kOnFace", "kMost"},
        "job": {"kAlignment"},
    }

    def test_every_entry_has_a_mark_and_is_listed(self):
        names = []
        self.assertGreater(len(tuning.headers()), 11)
        for path in tuning.headers():
            entries, listed = tuning.read_header(path)
            self.assertEqual([entry.name.split(".")[1] for entry in entries], listed, path)
            for entry in entries:
                self.assertIsNotNone(entry.mark, "{} in {}: one of Theory: ..., Measured: ..., Guess. at the end".format(entry.name, entry.header))
                if entry.mark == "theory" or entry.mark == "measured":
                    self.assertGreater(len(entry.meaning.split(entry.mark.capitalize() + ": ")[1]), 15, entry.name)
            names += [entry.name for entry in entries]
        self.assertGreater(len(names), 200)
        self.assertEqual(len(names), len(set(names)))

    def test_entries_can_be_set(self):
        """pipeline/trial_tuning.cpp knows every header."""
        text = read(os.path.join(BACKEND, "pipeline", "trial_tuning.cpp"))
        for path in tuning.headers():
            self.assertIn(os.path.relpath(path, BACKEND), includes(os.path.join(BACKEND, "pipeline", "trial_tuning.cpp")))
            self.assertIn("add_stage<" + re.search(r"struct (\w+Tuning)", read(path)).group(1) + ">", text)

    def test_entries_are_read(self):
        for path in tuning.headers():
            stage = os.path.relpath(os.path.dirname(path), BACKEND).split(os.sep)[0]
            name = re.search(r"& (k\w+Tuning) =", read(path)).group(1)
            text = "".join(read(other) for other in sources(stage))
            for entry in tuning.read_header(path)[1]:
                self.assertRegex(text, r"\b{}\.{}\b".format(name, entry), path)

    def test_no_number_is_chosen_elsewhere(self):
        kinds = r"(?:double|float|int|long|std::size_t|std::u?int\d+_t|std::streamoff|std::streamsize|std::ptrdiff_t|Eigen::Index|FlowInt|zip_uint64_t|char)"
        constant = re.compile(r"^\s*(?:inline |static )*const(?:expr)? {} (k[A-Z]\w*) ?[={{](.*);".format(kinds), re.M)
        fact = re.compile(r" ?std::(numbers::pi|numeric_limits<\w+>::\w+\(\))")
        for stage in Stages.uses:
            found = set()
            for path in sources(stage):
                if os.path.basename(path) != "tuning.h":
                    for first, rest in constant.findall(read(path)):
                        found |= set() if fact.fullmatch(rest) else {first, *re.findall(r", (k[A-Z]\w*) = ", rest)}
            self.assertEqual(found, self.OTHERS.get(stage, set()), "a number that was chosen belongs into {}/tuning.h, with its reason".format(stage))


if __name__ == "__main__":
    unittest.main()
