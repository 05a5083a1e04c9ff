"""Runs of the mesher under a window: child processes that are watched without waiting for them."""

import os
import time

from PySide import QtCore

from . import job
from .errors import Cancelled, PolycubeError
from .session import request
from .words import tr

#: milliseconds between two looks at the clock
_WATCH = 100
#: Seconds that a session has to give up what it does, before it is ended by force: with the kill it is below a second.
_PATIENCE = 0.7


class Child:
    """A Job's process. The job's folder goes with it. What it says comes to `_hear(kind, value)`, as Job.parse has it, its end to `_end(status)`."""

    def __init__(self, work):
        self.job = work
        self._out, self._err = "", ""
        self._ended = False
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

    def wait(self):
        """Until the end; of a process that was killed."""
        if not self._ended:
            self._process.waitForFinished()

    def last_words(self):
        return self._err

    def _kill(self):
        if not self._ended:  # the QProcess goes with its end
            job.kill_tree(self.processId())

    def _read_output(self):
        self._out += bytes(self._process.readAllStandardOutput()).decode("utf-8", "replace")
        *lines, self._out = self._out.split("\n")
        for line in lines:
            kind, value = job.Job.parse(line)
            if kind == "progress":
                self.job.stage = value[0]
            self._hear(kind, value)

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
        self._end(-max(status, 1) if exit_status == QtCore.QProcess.CrashExit else status)


class Run(Child):
    """One mesh, or what else a job makes.

    heard(kind, value): what the child says. tick(seconds): ten times a second. done(made, error): once, at the end; of what was made and the PolycubeError one
    is None.
    """

    def __init__(self, work, heard, tick, done):
        super().__init__(work)
        self.what = work.what
        self._hear, self._tick, self._done = heard, tick, done
        self._reason = None  # why the process was killed
        self._began = time.monotonic()

    def kill(self, reason):
        """Ends the run; the error says why."""
        self._reason = reason
        self._kill()

    def take_the_best(self):
        """Asks the mesher to end with the best mesh so far; it says in the log if there is none yet."""
        self.job.ask_for_the_best()

    def _watch(self):
        seconds = time.monotonic() - self._began
        self._tick(seconds)
        if not self._reason and self.job.out_of_time(seconds):
            self.kill("out of time")

    def _end(self, status):
        made = error = None
        try:
            if self._reason:
                raise Cancelled(tr(self._reason))
            made = self.job.finish(status, self.last_words())
        except PolycubeError as caught:
            error = caught
        finally:
            self.job.close()
        self._done(made, error)


class LiveSession(Child):
    """A session's process under a window: labels of a part and numbers of its cells, one after the other, on one set of tetrahedra.

    `key`: what tells this part from another, and from itself after a change.
    """

    def __init__(self, shape, options, key):
        super().__init__(job.Job(shape, options, "session"))
        self.key = key
        self._now, self._waiting, self._number = None, [], 0
        self._given_up = 0.0  # when the present one was killed
        self.start()

    def has_ended(self):
        return self._ended

    def ask(self, what, options, heard, tick, done):
        """A Request for "labels", "polycube" or "count", which begins when those before it have ended; the callables are as of a Run."""
        asked = Request(self, what, options, heard, tick, done)
        self._waiting.append(asked)
        self._go_on()
        return asked

    def close(self):
        """Ends the process; what was asked for ends as cancelled."""
        for asked in filter(None, [*self._waiting, self._now]):
            asked.reason = asked.reason or "cancelled"
        self._kill()
        self.wait()

    def give_up(self, asked):
        """What a Request does when it is killed."""
        if asked in self._waiting:
            self._waiting.remove(asked)
            asked.end(None, Cancelled(tr(asked.reason)))
        elif asked is self._now:
            self._given_up = time.monotonic()
            with open(os.path.join(asked.folder, "enough"), "w", encoding="ascii"):
                pass

    def _go_on(self):
        if self._now or not self._waiting or self._ended:
            return
        self._now = self._waiting.pop(0)
        self._number += 1
        self._now.begin(os.path.join(self.job.folder, str(self._number)))
        self.job.limit = self._now.options.get("time_limit")
        self._process.write(request(self._number, self._now.what).encode("ascii"))

    def _hear(self, kind, value):
        if kind == "done":
            self._deliver(value)
            self._go_on()
        elif self._now:
            self._now.heard(kind, value)

    def _deliver(self, status):
        asked, self._now = self._now, None
        made = error = None
        try:
            if asked.reason:
                raise Cancelled(tr(asked.reason))
            made = job.outcome(asked.folder, asked.what, status, self.last_words(), self.job.stage)
        except PolycubeError as caught:
            error = caught
        asked.end(made, error)

    def _watch(self):
        if not self._now:
            return
        seconds = time.monotonic() - self._now.began
        self._now.tick(seconds)
        if self._now.reason:
            # While it cannot be reached, as when the CAD kernel reads the part, others can wait.
            if not self._waiting and time.monotonic() - self._given_up > _PATIENCE:
                self._kill()
        elif self.job.out_of_time(seconds):
            self._now.reason = "out of time"
            self._kill()

    def _end(self, status):
        if self._now:
            self._deliver(status or 1)
        self.job.close()
        while self._waiting:
            asked = self._waiting.pop(0)
            asked.end(None, Cancelled(tr(asked.reason or "cancelled")))


class Request:
    """One thing that a LiveSession makes; to the panel it is like a Run."""

    def __init__(self, session, what, options, heard, tick, done):
        self._session, self._done = session, done
        self.what, self.options, self.heard, self.tick = what, options, heard, tick
        self.folder, self.began, self.reason = "", time.monotonic(), None
        self.job = session.job

    def start(self):
        """It was put in line when it was made."""

    def processId(self):
        return self._session.processId()

    def begin(self, folder):
        """Its turn has come."""
        self.folder, self.began = folder, time.monotonic()
        os.mkdir(folder)
        job.write_options(folder, self.options)

    def kill(self, reason):
        """Gives it up; the session goes on, where it can."""
        self.reason = self.reason or reason
        self._session.give_up(self)

    def wait(self):
        """Until the end of the session."""
        self._session.close()

    def end(self, made, error):
        self._done(made, error)
