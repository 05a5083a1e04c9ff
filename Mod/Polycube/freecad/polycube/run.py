"""One run of the mesher under a window: a child process that is watched without waiting for it."""

import time

from PySide import QtCore

from . import job
from .errors import Cancelled, PolycubeError

#: milliseconds between two looks at the clock
_WATCH = 100


class Run:
    """A Job in a child process. The job's folder goes with the run.

    heard(kind, value): what the child says, as Job.parse has it. tick(seconds): ten times a second. done(made, error): once, at the end; of what was made and
    the PolycubeError one is None.
    """

    def __init__(self, work, heard, tick, done):
        self.job = work
        self._heard, self._tick, self._done = heard, tick, done
        self._out, self._err = "", ""
        self._reason = None  # why the process was killed
        self._ended = False
        self._began = time.monotonic()
        self._timer = QtCore.QTimer()
        self._timer.setInterval(_WATCH)
        self._timer.timeout.connect(self._watch)
        self._process = QtCore.QProcess()
        variables = QtCore.QProcessEnvironment()
        for name, value in work.environment().items():
            variables.insert(name, value)
        self._process.setProcessEnvironment(variables)
        self._process.readyReadStandardOutput.connect(self._read_output)
        self._process.readyReadStandardError.connect(self._read_error)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)

    def start(self):
        self._timer.start()
        program, *arguments = self.job.command()
        self._process.start(program, arguments)

    def processId(self):
        return int(self._process.processId())

    def kill(self, reason):
        """Ends the run; the error says why."""
        self._reason = reason
        job.kill_tree(self.processId())

    def take_the_best(self):
        """Asks the mesher to end with the best mesh so far; it says in the log if there is none yet."""
        self.job.ask_for_the_best()

    def wait(self):
        """Until the end; for a run that was killed."""
        self._process.waitForFinished()

    def _watch(self):
        seconds = time.monotonic() - self._began
        self._tick(seconds)
        if not self._reason and self.job.out_of_time(seconds):
            self.kill("out of time")

    def _read_output(self):
        self._out += bytes(self._process.readAllStandardOutput()).decode("utf-8", "replace")
        *lines, self._out = self._out.split("\n")
        for line in lines:
            kind, value = job.Job.parse(line)
            if kind == "progress":
                self.job.stage = value[0]
            self._heard(kind, value)

    def _read_error(self):
        self._err = (self._err + bytes(self._process.readAllStandardError()).decode("utf-8", "replace"))[-4000:]

    def _failed(self, error):
        if error == QtCore.QProcess.FailedToStart:
            self._finished(-1, None)

    def _finished(self, status, exit_status):
        if self._ended:
            return
        self._ended = True
        self._timer.stop()
        self._read_output()
        self._read_error()
        self._process.deleteLater()
        made = error = None
        try:
            if self._reason:
                raise Cancelled(self._reason)
            made = self.job.finish(-max(status, 1) if exit_status == QtCore.QProcess.CrashExit else status, self._err)
        except PolycubeError as caught:
            error = caught
        finally:
            self.job.close()
        self._done(made, error)
