"""What is installed, by CMake and as a Debian package, works without the build it comes from; and the package's description for FreeCAD."""

import glob
import os
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ET

from support import BUILD, REPO, FolderTest, FreeCAD, box

import _polycube

TARGETS = ["polycube", "polycube-tet", "_polycube", "manual", "polycube_shared"]
#: Nothing of the build or of the caller's Python.
CLEAN = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONDONTWRITEBYTECODE", "POLYCUBE_TET_WORKER")}
PACKAGE_XML = os.path.join(REPO, "Mod", "Polycube", "package.xml")


class InstallTest(FolderTest):
    def succeeds(self, *command, **settings):
        run = subprocess.run(command, capture_output=True, text=True, timeout=600, **{"env": CLEAN, **settings})
        self.assertEqual(run.returncode, 0, " ".join(command) + "\n" + run.stdout + run.stderr)
        return run.stdout

    def files(self, root):
        return {os.path.relpath(os.path.join(folder, name), root) for folder, folders, names in os.walk(root) for name in folders + names}

    def check_programs(self, prefix):
        """The program and the module mesh, with the prefix's own helper: they do not know where they were built."""
        for name in glob.glob(prefix + "/**/*", recursive=True):
            if os.path.isfile(name):
                with open(name, "rb") as file:
                    self.assertNotIn(BUILD.encode(), file.read(), name)
        part, program = self.save(box()), os.path.join(prefix, "bin", "polycube")
        self.assertEqual(self.succeeds(program, "--version").strip(), _polycube.__version__)
        self.succeeds(program, "mesh", part, "-o", self.path("box.inp"), "--size", "1")
        (module,) = glob.glob(prefix + "/lib/python3*/*-packages/_polycube*.so")
        code = "import _polycube, sys; assert _polycube.__file__ == sys.argv[1]; print(len(_polycube.mesh(path=sys.argv[2], size=1).hexes))"
        environment = dict(CLEAN, PYTHONPATH=os.path.dirname(module))
        self.assertEqual(int(self.succeeds(sys.executable, "-c", code, module, part, env=environment)), 32)


class ByCMake(InstallTest):
    def test_a_prefix_and_a_consumer(self):
        self.succeeds("cmake", "--build", BUILD, "--target", *TARGETS)
        prefix = self.path("prefix")
        self.succeeds("cmake", "--install", BUILD, "--prefix", prefix)
        self.check_programs(prefix)
        self.succeeds("cmake", "-S", os.path.join(REPO, "tests", "consumer"), "-B", self.path("consumer"), "-G", "Ninja", "-DCMAKE_PREFIX_PATH=" + prefix)
        # A prefix that has moved is as good.
        os.rename(prefix, self.path("moved"))
        self.succeeds("cmake", "-DCMAKE_PREFIX_PATH=" + self.path("moved"), "-UPolycube_DIR", self.path("consumer"))
        self.succeeds("cmake", "--build", self.path("consumer"))
        self.assertEqual(self.succeeds(self.path("consumer/consumer"), self.save(box())), "32 hexahedra\n")


class AsDebianPackage(InstallTest):
    def dpkg(self, *arguments):
        """In a root of its own; what the package depends on is there in this one."""
        forced = ["--force-depends", "--force-script-chrootless", "--force-not-root"]
        path = os.pathsep.join([CLEAN["PATH"], "/usr/sbin", "/sbin"])
        self.succeeds("dpkg", "--root=" + self.root, "--log=/dev/null", *forced, *arguments, env=dict(CLEAN, PATH=path))

    def installed(self):
        """But for what dpkg notes."""
        return {name for name in self.files(self.root) if not name.startswith("var/lib/dpkg")}

    def test_works_and_is_removed_without_a_trace(self):
        (deb,) = self.succeeds("sh", os.path.join(REPO, "resources", "polycube"), "package", self.path("made")).splitlines()
        self.root = self.path("root")
        for name in ("info", "updates"):
            os.makedirs(os.path.join(self.root, "var/lib/dpkg", name))
        for name in ("status", "available"):
            open(os.path.join(self.root, "var/lib/dpkg", name), "w", encoding="ascii").close()
        before = self.installed()

        self.dpkg("--install", deb)
        self.check_programs(os.path.join(self.root, "usr"))
        page = self.succeeds("gzip", "-dc", os.path.join(self.root, "usr/share/man/man1/polycube.1.gz"))
        for option in _polycube.options():
            flag = "--label" if option["name"] == "labels" else "--" + option["name"].replace("_", "-")
            self.assertIn("\\fB{}\\fP".format(flag.replace("-", "\\-")), page)
        self.check_workbench()

        self.dpkg("--remove", "polycube")
        self.assertEqual(self.installed(), before)

    def check_workbench(self):
        """API and panel in a FreeCAD that has this workbench and finds this program; the tests are those for a module that is hidden."""
        workbench = os.path.join(self.root, "usr/share/freecad/Mod/Polycube")
        mods = self.path("data/FreeCAD/Mod")
        os.makedirs(mods)
        os.symlink(workbench, os.path.join(mods, "Polycube"))
        programs = os.path.join(self.root, "usr/bin")
        environment = dict(CLEAN, XDG_DATA_HOME=self.path("data"), XDG_CONFIG_HOME=self.path("config"), POLYCUBE_HIDDEN=self.folder, build=programs)
        environment["PATH"] = programs + os.pathsep + CLEAN["PATH"]
        tests = os.path.join(REPO, "tests", "freecad")
        self.succeeds("freecadcmd", "-P", tests, "-t", "hidden_api.HiddenApi.test_mesh_object_and_labels", env=environment)
        self.succeeds("sh", os.path.join(tests, "gui.sh"), self.path("pictures"), "gui_hidden", env=environment)
        # so that its removal means something
        self.assertTrue(os.path.isdir(os.path.join(workbench, "freecad/polycube/__pycache__")))


class Description(unittest.TestCase):
    """package.xml by the rules of https://wiki.freecad.org/Package_Metadata."""

    NAMESPACE = "{https://wiki.freecad.org/Package_Metadata}"
    SEMANTIC = r"\d+\.\d+(\.\d+)?"
    PATH = r"[^/\\][^\\]*"
    #: element: how many at least and at most, attributes that it has to have and may have, what its text looks like
    ELEMENTS = {
        "name": (1, 1, (), (), r'[^/\\?%*:|"<>]+'),
        "version": (1, 1, (), (), r"\d+\.\d+\.\d+"),
        "date": (1, 1, (), (), r"\d{4}-\d\d-\d\d"),
        "description": (1, 1, (), (), r"[^<>]+"),
        "maintainer": (1, 99, ("email",), (), r".+"),
        "license": (1, 99, (), ("file",), r"[A-Za-z0-9.+-]+"),
        "icon": (1, 1, (), (), PATH),
        "content": (1, 1, (), (), r"\s*"),
        "url": (1, 99, ("type",), ("branch",), r"https://\S+"),
        "author": (0, 99, (), ("email",), r".+"),
        "depend": (0, 99, (), ("type", "optional", "condition", *("version_" + kind for kind in ("lt", "lte", "eq", "gte", "gt"))), r"\S+"),
        "conflict": (0, 99, (), (), r"\S+"),
        "replace": (0, 99, (), (), r"\S+"),
        "tag": (0, 99, (), (), r".+"),
        "freecadmin": (0, 1, (), (), SEMANTIC),
        "freecadmax": (0, 1, (), (), SEMANTIC),
        "pythonmin": (0, 1, (), (), r"3\.\d+"),
    }
    WORKBENCH = {
        **{name: (0, *rule[1:]) for name, rule in ELEMENTS.items() if name != "content"},
        "classname": (1, 1, (), (), r"[A-Za-z_]\w*"),
        "subdirectory": (0, 1, (), (), r"\./|" + PATH),
        "file": (0, 99, (), (), PATH),
        "icon": (1, 1, (), (), PATH),
    }
    URLS = {"website", "bugtracker", "repository", "readme", "documentation", "discussion"}

    def check(self, element, rules):
        found = [child.tag.removeprefix(self.NAMESPACE) for child in element]
        self.assertLessEqual(set(found), set(rules))
        for name, (least, most, needed, allowed, pattern) in rules.items():
            self.assertTrue(least <= found.count(name) <= most, name)
            for child in element.findall(self.NAMESPACE + name):
                self.assertLessEqual(set(needed), set(child.keys()), name)
                self.assertLessEqual(set(child.keys()), {*needed, *allowed}, name)
                self.assertRegex(child.text or "", r"\A(" + pattern + r")\Z", name)

    def setUp(self):
        self.package = ET.parse(PACKAGE_XML).getroot()

    def test_elements(self):
        self.assertEqual(self.package.tag, self.NAMESPACE + "package")
        self.assertEqual(self.package.attrib, {"format": "1"})
        self.check(self.package, self.ELEMENTS)
        (content,) = self.package.findall(self.NAMESPACE + "content")
        (workbench,) = content
        self.assertEqual(workbench.tag, self.NAMESPACE + "workbench")
        self.check(workbench, self.WORKBENCH)
        urls = {url.get("type"): url for url in self.package.findall(self.NAMESPACE + "url")}
        self.assertLessEqual(set(urls), self.URLS)
        self.assertLessEqual({"repository", "readme"}, set(urls))
        self.assertTrue(urls["repository"].get("branch"))
        for depend in self.package.findall(self.NAMESPACE + "depend"):
            self.assertIn(depend.get("type"), ("automatic", "addon", "internal", "python"))

    def test_what_it_names_is_there(self):
        folder = os.path.dirname(PACKAGE_XML)
        licence = self.package.find(self.NAMESPACE + "license")
        self.assertTrue(os.path.isfile(os.path.join(folder, licence.get("file"))))
        icon = self.package.find(self.NAMESPACE + "icon").text
        # where an installation puts them
        self.assertTrue(os.path.isfile(os.path.join(REPO, "resources", icon.removeprefix("freecad/polycube/resources/"))), icon)
        name = self.package.find(".//" + self.NAMESPACE + "classname").text
        with open(os.path.join(folder, "freecad", "polycube", "init_gui.py"), encoding="utf-8") as file:
            self.assertRegex(file.read(), r"(?m)^class {}\(".format(re.escape(name)))

    def test_freecad_reads_it(self):
        read = FreeCAD.Metadata(PACKAGE_XML)
        self.assertEqual(read.Name, "Polycube")
        self.assertEqual(read.Version, _polycube.__version__)
        self.assertEqual(read.Content["workbench"][0].Classname, "PolycubeWorkbench")


if __name__ == "__main__":
    unittest.main()
