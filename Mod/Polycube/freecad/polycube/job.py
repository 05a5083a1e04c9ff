"""One meshing job: a folder for the child process, its command, its messages, its result.

A child process keeps a crash of the CAD kernel or of the tetrahedral mesher out of FreeCAD and can be stopped at any moment.
The window drives a Job with QProcess, the API with run().
"""

import json
import math
import os
import queue
import re
import signal
import subprocess
import threading
import time

from . import engine, preferences, result
from .engine_words import told
from .errors import Cancelled, InvalidInput, PolycubeError, StageFailed
from .job_folder import JobFolder
from .words import tr

# From the time limit to the end by force, seconds: the child ends by itself, unless a query of the CAD kernel holds it. As on the command line
# (kGrace in backend/cli/supervise.cpp), within the 2 s after the limit that the contract gives.
_GRACE = 1.5
# Seconds between two calls of `idle`: a window that is asked so often does not look stuck.
_IDLE = 0.03
_KINDS = {"InvalidInput": InvalidInput, "Cancelled": Cancelled}
#: By what was asked for, what reads it from a folder.
_LOADERS = {"mesh": result.load, "labels": result.load_labels, "polycube": result.load_labels, "count": result.load_count}


class Job:
    """A folder with shape and options, ready to run; close() removes it. `what` is to be made of them: "mesh", "labels" or, for session.py, "session". `labels`:
    what the solids of the shape are called (shapes.solid_labels)."""

    def __init__(self, shape, options, what="mesh", labels=()):
        self.what = what
        #: of the child, as far as it has told
        self.stage = ""
        self.limit = options.get("time_limit")
        self._mesher = engine.find()
        self._folder = JobFolder(preferences.folder())
        self.folder = self._folder.path
        try:
            with open(os.path.join(self.folder, "shape.brep"), "w", encoding="ascii") as file:
                file.write(shape.exportBrepToString())
            with open(os.path.join(self.folder, "solids.json"), "w", encoding="ascii") as file:
                json.dump(labels, file)
            write_options(self.folder, options)
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._folder.close()

    def command(self):
        """Program and arguments of the child process."""
        return [*self._mesher.command, self.folder, self.what]

    def environment(self):
        return self._mesher.environment(self.folder)

    def ask_for_the_best(self):
        """Has the child end with the best mesh so far; cancelled where there is none yet, which its log tells."""
        with open(os.path.join(self.folder, "enough"), "w", encoding="ascii"):
            pass

    def out_of_time(self, seconds):
        """Whether a child that has run for so many seconds is to be killed: it has not ended by itself at the time limit."""
        limit = self.limit or 0  # one that is not positive the child refuses
        return limit > 0 and seconds > limit + _GRACE

    @staticmethod
    def parse(line):
        """("progress", (stage, fraction)), ("log", text) or, of a session, ("done", status) from one line of the child's standard output."""
        try:
            message = json.loads(line)
            if "done" in message:
                return "done", int(message["done"])
            if "progress" in message:
                stage, fraction = message["progress"]
                return "progress", (str(stage), float(fraction))
            return "log", str(message["log"])
        except (ValueError, KeyError, TypeError):
            return "log", line

    def finish(self, status, last_words=""):
        """The MeshResult or LabelResult of a child that ended with `status`, or one of the errors. `last_words`: end of its standard error."""
        return outcome(self.folder, self.what, status, last_words, self.stage)


def write_options(folder, options):
    """Leaves the options in a job's folder, with the threads of the preferences where none are given."""
    options = {**options, "threads": options.get("threads") or preferences.threads()}
    with open(os.path.join(folder, "options.json"), "w", encoding="utf-8") as file:
        json.dump({name: _json_value(value) for name, value in options.items()}, file)


def outcome(folder, what, status, last_words="", stage=""):
    """What a child left in a folder: the MeshResult or LabelResult, the number of cells, or one of the errors. `stage`: the last one that it spoke of."""
    try:
        return _left(folder, what, status, last_words, stage)
    except PolycubeError:
        raise
    except Exception as error:  # a program that is another mesher, or none, may leave anything
        reason = "{}: {}".format(type(error).__name__, error).splitlines()[0]
        raise StageFailed(tr("the mesher left nothing that can be read: {}").format(reason), stage or "start", []) from error


def _left(folder, what, status, last_words, stage):
    if status == 0:
        return _LOADERS[what](folder)
    path = os.path.join(folder, "error.json")
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
        if found["kind"] == "StageFailed":
            raise StageFailed(told(found["message"]), found["stage"], found["entities"])
        # The engine writes options as on the command line, --time-limit; here they are time_limit.
        raise _KINDS[found["kind"]](told(re.sub(r"--([a-z][a-z-]*)", lambda option: _argument_name(option.group(1)), found["message"])))
    reason = last_words.strip().splitlines()[-1] if last_words.strip() else tr("no message")
    if status < 0:
        raise StageFailed(tr("the mesher was ended by {}: {}").format(_signal_name(-status), reason), stage or "start", [])
    raise StageFailed(tr("the mesher ended unexpectedly (status {}): {}").format(status, reason), stage or "start", [])


def _signal_name(number):
    try:
        return "signal {} ({})".format(number, signal.Signals(number).name)
    except ValueError:
        return "signal {}".format(number)


def run(job, progress=None, log=None, cancel=None, idle=None):
    """Runs the job here and now. `progress(stage, fraction)`, `log(line)`; `cancel()` true kills the child: raises Cancelled.

    `idle()` is called again and again from this thread, for a window that is to go on.
    """
    child = subprocess.Popen(
        job.command(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=job.environment(),
        text=True,
        errors="replace",
    )
    watcher = Watcher(child, cancel, job)
    stderr, stdout = Drain(child.stderr), Lines(child.stdout)
    try:
        for line in stdout.each(idle):
            kind, value = job.parse(line.rstrip("\n"))
            if kind == "progress":
                job.stage = value[0]
                if progress:
                    progress(*value)
            elif kind == "log" and log:
                log(value)
        status = child.wait()
    except BaseException:
        kill_tree(child.pid)
        child.wait()
        raise
    finally:
        watcher.end()
        last_words = stderr.text()
    if watcher.error:
        raise watcher.error
    if watcher.reason:
        raise Cancelled(tr(watcher.reason))
    return job.finish(status, last_words)


def _json_value(value):
    """JSON has no NaN and no infinity, which a property may hold; the engine refuses the text and names the option."""
    if isinstance(value, (list, tuple)):
        return [_json_value(one) for one in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _argument_name(flag):
    """The argument that an option of the command line is here: time_limit for time-limit. "--label" is given once for every face."""
    return "labels" if flag == "label" else flag.replace("-", "_")


def kill_tree(pid):
    """Kills the child and the processes it started: it leads a process group of its own where the system has such groups."""
    if pid <= 0:
        return
    try:
        if hasattr(os, "killpg") and os.getpgid(pid) == pid:
            os.killpg(pid, signal.SIGKILL)
        else:
            os.kill(pid, getattr(signal, "SIGKILL", signal.SIGTERM))
    except ProcessLookupError:
        pass


class Lines(threading.Thread):
    """Reads a pipe line by line."""

    def __init__(self, pipe):
        super().__init__(daemon=True)
        self._pipe, self._queue = pipe, queue.Queue()
        self.start()

    def run(self):
        try:
            for line in self._pipe:
                self._queue.put(line)
        finally:
            self._queue.put(None)

    def each(self, idle=None):
        """The lines as they come; `idle()` is called between them and while there is none."""
        while True:
            try:
                line = self._queue.get(timeout=_IDLE if idle else None)
            except queue.Empty:
                line = ""
            if line is None:
                return
            if line:
                yield line
            if idle:
                idle()


class Drain(threading.Thread):
    """Reads a pipe to its end, so that the child never blocks on it."""

    def __init__(self, pipe):
        super().__init__(daemon=True)
        self._pipe = pipe
        self._text = ""
        self.start()

    def run(self):
        self._text = self._pipe.read()

    def text(self):
        self.join()
        return self._text


class Watcher(threading.Thread):
    """Kills the child when `cancel` says so or the job is out of time; `reason` tells which. What `cancel` raises ends the job too; `error` is it."""

    def __init__(self, child, cancel, job):
        super().__init__(daemon=True)
        self.finished = threading.Event()
        self.reason = None
        self.error = None
        self._child, self._cancel, self._job = child, cancel, job
        self._start = time.monotonic()
        self.start()

    def run(self):
        while not self.finished.wait(0.1):
            try:
                if self._cancel and self._cancel():
                    self.reason = "cancelled"
            except Exception as error:
                self.error = error
            if self._job.out_of_time(time.monotonic() - self._start):
                self.reason = self.reason or "out of time"
            if self.reason or self.error:
                kill_tree(self._child.pid)
                return

    def end(self):
        """No more watching."""
        self.finished.set()
        self.join()
