"""Which mesher is taken, and a FreeCAD from which the compiled module is hidden."""

import os
import subprocess
import tempfile
import unittest
from unittest import mock

import FreeCAD
import hidden
import Part

from freecad import polycube
from freecad.polycube import engine

HERE = os.path.dirname(os.path.abspath(__file__))
ANSWERS = '#!/bin/sh\n[ "$1 $2" = "{}" ] || exit 2\necho {}\n'


class FolderTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name


class Order(FolderTest):
    """Programs stand in for meshers; what is found by one test is found by no other, as each has a PATH of its own."""

    def setUp(self):
        super().setUp()
        self.preferences = FreeCAD.ParamGet(engine.PREFERENCES)
        before = self.preferences.GetString("Mesher", "")
        self.addCleanup(lambda: self.preferences.SetString("Mesher", before) if before else self.preferences.RemString("Mesher"))
        self.preferences.RemString("Mesher")
        self.path = os.path.join(self.folder, "bin")
        os.mkdir(self.path)
        for patch in (mock.patch.dict(os.environ, PATH=self.path), mock.patch.object(engine, "_module_folder", return_value="")):
            patch.start()
            self.addCleanup(patch.stop)

    def program(self, name, text=ANSWERS.format("serve-job --version", "7.8.9")):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(path, 0o755)
        return path

    def none(self):
        with self.assertRaises(polycube.NoMesher) as caught:
            engine.find()
        self.assertNotIn("\n", str(caught.exception))
        self.assertIsInstance(caught.exception, ImportError)
        return str(caught.exception)

    def test_whatever_a_stranger_does(self):
        """Programs that say a version and then are no mesher: one line, and no wait without end."""
        answers = '#!/bin/sh\n[ "$2" = --version ] && { echo 0.0.9; exit; }\n'
        for number, does in enumerate(
            (
                "exit 0",
                "printf 'a\\377\\376b\\n'; printf 'c\\377' >&2; exit 1",
                'echo rubbish > "$2/result.npz"; exit 0',
                'echo "{}" > "$2/error.json"; exit 1',
                'echo "{" > "$2/error.json"; exit 1',
            )
        ):
            with self.subTest(does=does):
                self.preferences.SetString("Mesher", self.program("stranger{}".format(number), answers + does + "\n"))
                with self.assertRaises(polycube.StageFailed) as caught:
                    polycube.mesh(Part.makeBox(1, 1, 1))
                self.assertNotIn("\n", str(caught.exception))

    def test_one_that_was_removed(self):
        path = self.program("here")
        self.preferences.SetString("Mesher", path)
        self.assertEqual(engine.find().command[0], path)
        os.remove(path)
        self.assertIn(path, self.none())

    def test_nothing_is_there(self):
        self.assertIn("no program polycube on PATH", self.none())
        with self.assertRaises(polycube.NoMesher):
            polycube.mesh(Part.makeBox(1, 1, 1))
        # options need no mesher
        self.assertGreater(len(polycube.options()), 10)

    def test_a_mesher_that_comes_later_is_found(self):
        self.none()
        program = self.program("bin/polycube")
        self.assertEqual(engine.find().command, (program, "serve-job"))

    def test_a_program_of_that_name_that_is_another(self):
        for text in (ANSWERS.format("--version ", "polycube 7"), "#!/bin/sh\necho hello\n", "#!/bin/sh\nexit 1\n", "#!/nowhere/sh\n"):
            self.program("bin/polycube", text)
            self.none()

    def test_the_preference_comes_before_path(self):
        self.program("bin/polycube")
        mine = self.program("mine")
        self.preferences.SetString("Mesher", mine)
        self.assertEqual(engine.find().command, (mine, "serve-job"))

    def test_the_preference_may_be_a_python(self):
        worker = os.path.join(engine.HERE, "worker.py")
        python = self.program("python", ANSWERS.format(worker + " --version", "7.8.9"))
        self.preferences.SetString("Mesher", python)
        self.assertEqual(engine.find().command, (python, worker))

    def test_a_preference_that_is_wrong_is_named(self):
        self.program("bin/polycube")
        for name in (os.path.join(self.folder, "missing"), self.program("other", "#!/bin/sh\nexit 1\n")):
            self.preferences.SetString("Mesher", name)
            self.assertTrue(self.none().endswith(": " + name))

    def test_the_module_comes_first(self):
        mine = self.program("mine")
        self.preferences.SetString("Mesher", mine)
        engine._module_folder.return_value = hidden.MODULE_FOLDER
        engine._find.cache_clear()
        self.addCleanup(engine._find.cache_clear)
        self.assertEqual(engine.find().command[1], os.path.join(engine.HERE, "worker.py"))
        self.assertNotEqual(engine.find().command[0], mine)

    def test_a_module_that_does_not_load_is_passed_over(self):
        """One for another Python or of other libraries: here it ends the Python that loads it."""
        broken = os.path.join(self.folder, "module")
        os.mkdir(broken)
        with open(os.path.join(broken, "_polycube.py"), "w", encoding="utf-8") as file:
            file.write("import os\nos.abort()\n")
        engine._module_folder.return_value = broken
        program = self.program("bin/polycube")
        self.assertEqual(engine.find().command, (program, "serve-job"))

    def test_a_bundle_keeps_its_libraries_to_itself(self):
        bundle = os.path.join(self.folder, "usr")
        given = os.pathsep.join([bundle + "/lib", "/opt/lib"])
        with mock.patch.object(engine.sys, "base_exec_prefix", bundle), mock.patch.dict(os.environ, LD_LIBRARY_PATH=given, PYTHONPATH=bundle, PYTHONHOME=bundle):
            stranger = engine.Mesher(("polycube", "serve-job")).environment(self.folder)
            own = engine.Mesher(("python3", "worker.py"), "/module").environment(self.folder)
        self.assertEqual(stranger["LD_LIBRARY_PATH"], "/opt/lib")
        self.assertNotIn("PYTHONPATH", stranger)
        self.assertEqual(own["LD_LIBRARY_PATH"], given)
        self.assertEqual(own["PYTHONPATH"], os.pathsep.join(["/module", bundle]))
        for environment in (stranger, own):
            self.assertNotIn("PYTHONHOME", environment)
            self.assertEqual(environment["TMPDIR"], self.folder)


class Hidden(FolderTest):
    """Each in a FreeCAD of its own."""

    def succeeds(self, command):
        run = subprocess.run(command, env=hidden.environment(self.folder), capture_output=True, text=True, timeout=600)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertRegex(run.stdout + run.stderr, r"Ran [1-9]\d* tests")

    def test_api(self):
        self.succeeds(["freecadcmd", "-P", HERE, "-t", "hidden_api"])

    def test_panel(self):
        out = os.environ.get("POLYCUBE_GUI_OUT") or os.path.join(self.folder, "out")
        self.succeeds(["sh", os.path.join(HERE, "gui.sh"), out, "gui_hidden"])
        self.assertGreater(os.path.getsize(os.path.join(out, "panel-without-the-module.png")), 10000)
