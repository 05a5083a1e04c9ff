"""The engine runs in a process of its own: whatever happens to it, the user gets a status, one line, and no files.

A stand-in for the program that makes tetrahedra does to the engine what a bug would do.
"""

import os
import resource
import signal
import stat
import subprocess
import tempfile
import time
import unittest

from support import PROGRAM, FolderTest, box


class EngineProcess(FolderTest):
    def start(self, deed, *arguments):
        """Meshes a box; the engine suffers the deed, a line of shell, in the stage tet."""
        self.temporary = tempfile.mkdtemp(dir=self.folder)
        worker = self.path("worker")
        with open(worker, "w") as file:
            file.write("#!/bin/sh\n{}\nwhile kill -0 $PPID 2> {}; do sleep 0.1; done\n".format(deed, os.devnull))
        os.chmod(worker, os.stat(worker).st_mode | stat.S_IXUSR)
        part = self.save(box())
        self.before = set(os.listdir(self.folder))
        environment = dict(os.environ, POLYCUBE_TET_WORKER=worker, TMPDIR=self.temporary)
        command = [PROGRAM, "mesh", part, "-o", self.path("a.inp"), "--report", self.path("r.json"), *arguments]
        # Under nohup the signal is ignored, and that is inherited.
        heeding = dict(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL))
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment, **heeding)

    def wait_for(self, process, name):
        """Until the deed has made the file."""
        while not os.path.exists(self.path(name)) and process.poll() is None:
            time.sleep(0.01)
        self.assertIsNone(process.poll(), "the program ended by itself")

    def ends(self, process, status, line):
        out, error = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out), (status, ""), error)
        self.assertRegex(error, r"\Apolycube: " + line + r"\n\Z")
        self.assertEqual(set(os.listdir(self.folder)), self.before, "something was written")
        self.assertEqual(os.listdir(self.temporary), [], "temporary files are left")

    def test_a_crash_names_its_stage(self):
        for name in ("SEGV", "ABRT", "FPE"):
            number = getattr(signal, "SIG" + name)
            with self.subTest(name):
                self.ends(self.start("kill -{} $PPID".format(name)), 2, r"stage tet: the engine ended by signal {} \(.+\)".format(int(number)))

    def test_want_of_memory(self):
        self.ends(self.start("kill -KILL $PPID"), 2, r"stage tet: the engine ended by signal 9 \(.+\), perhaps for want of memory")

    def test_an_engine_that_is_stuck_keeps_the_time_limit(self):
        self.ends(self.start("kill -STOP $PPID", "--time-limit", "1"), 3, "out of time")

    def test_a_second_interrupt_ends_an_engine_that_is_stuck(self):
        process = self.start("kill -STOP $PPID; touch {}".format(self.path("stuck")))
        self.wait_for(process, "stuck")
        os.remove(self.path("stuck"))
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        self.ends(process, 3, "cancelled")

    def test_signals_of_keyboards_and_batch_systems_cancel(self):
        for name in ("INT", "QUIT", "HUP", "TERM", "USR1", "USR2", "XCPU", "ALRM"):
            with self.subTest(name):
                process = self.start("touch {}".format(self.path("begun")))
                self.wait_for(process, "begun")
                os.remove(self.path("begun"))
                process.send_signal(getattr(signal, "SIG" + name))
                self.ends(process, 3, "cancelled")

    def test_a_full_temporary_folder_is_told_at_once(self):
        """The limit on the size of files stands for the space: the part is below it, the tetrahedra are not."""
        part = self.save(box())
        limit = 50000
        self.assertLess(os.path.getsize(part), limit)
        run = subprocess.run(
            [PROGRAM, "mesh", part, "-o", self.path("a.inp"), "--size", "0.5"],
            capture_output=True,
            text=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
        )
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertRegex(run.stderr, r"\Apolycube: stage tet: the tetrahedra cannot be written: the folder for temporary files \(TMPDIR\)[^\n]*\n\Z")
        self.assertFalse(os.path.exists(self.path("a.inp")))

    def test_the_engine_ends_with_a_parent_that_is_killed(self):
        process = self.start("echo $PPID > {0}.new; mv {0}.new {0}".format(self.path("pid")))
        self.wait_for(process, "pid")
        with open(self.path("pid")) as file:
            engine = int(file.read())
        process.kill()
        process.communicate()
        for _ in range(1000):
            if not os.path.exists("/proc/{}".format(engine)):
                break
            time.sleep(0.01)
        else:
            self.fail("the engine goes on")
        self.assertEqual(len(os.listdir(self.temporary)), 1)
        # The next run removes what it left, and nothing else.
        others = {name: os.path.join(self.temporary, name) for name in ("polycube-meshes", "other")}
        for path in others.values():
            os.mkdir(path)
        run = subprocess.run([PROGRAM, "mesh", self.save(box()), "-o", self.path("a.inp")], env=dict(os.environ, TMPDIR=self.temporary))
        self.assertEqual(run.returncode, 0)
        self.assertEqual(set(os.listdir(self.temporary)), set(others))


if __name__ == "__main__":
    unittest.main()
