"""One shape meshed several times by one child process, which keeps what does not depend on counts and sizes."""

import os
import subprocess
import threading

from . import job
from .errors import Cancelled, InvalidInput
from .words import tr

#: Of these only one can say how fine a mesh is.
_FINENESS = ("size", "hexes", "coarsest")


class Session:
    """Made by polycube.prepare(); close() ends it, as does the end of a with block. A mesh that was cancelled takes the child with it: the next one starts anew."""

    def __init__(self, shape, options, labels=()):
        self._shape, self._options, self._labels = shape, options, labels
        self._job = self._child = None
        self._meshes = 0
        self._at_work = threading.Lock()
        self._closed = False

    def mesh(self, progress=None, log=None, cancel=None, **options):
        """As polycube.mesh(), with the options of prepare() where they are not given here."""
        return self._make("mesh", options, progress, log, cancel)

    def labels(self, progress=None, log=None, cancel=None, **options):
        """As polycube.labels(), with the options of prepare() where they are not given here, on the tetrahedra of this session."""
        return self._make("labels", options, progress, log, cancel)

    def count(self, progress=None, log=None, cancel=None, **options):
        """How many hexahedra mesh() would make, without making them; most often in a fraction of its time.

        It is told by the first of the ways that mesh() goes, whose cells are not fitted to the part. Where that one is not good, mesh() goes on to others.
        """
        return self._make("count", options, progress, log, cancel)

    def close(self):
        """Ends the session: the child goes, and its folder."""
        self._closed = True
        self._end()

    def _end(self):
        if self._child:
            job.kill_tree(self._child.pid)
            self._child.wait()
            self._child.stdin.close()
            self._job.close()
        self._job = self._child = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __del__(self):
        self._end()

    def _start(self):
        self._job = job.Job(self._shape, self._options, "session", self._labels)
        self._child = subprocess.Popen(
            self._job.command(),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=self._job.environment(),
            text=True,
            errors="replace",
        )
        self._stderr, self._stdout = job.Drain(self._child.stderr), job.Lines(self._child.stdout)

    def _make(self, what, options, progress, log, cancel):
        if not self._at_work.acquire(blocking=False):
            raise InvalidInput(tr("the session is at work in another thread"))
        try:
            return self._made(what, options, progress, log, cancel)
        finally:
            self._at_work.release()

    def _made(self, what, options, progress, log, cancel):
        from . import option_table

        if self._closed:
            raise InvalidInput(tr("the session is closed"))
        more = option_table.plain(options)
        given = {name: value for name, value in self._options.items() if not (name in _FINENESS and set(more) & set(_FINENESS))}
        options = {**given, **more}
        if not self._child or self._child.poll() is not None:
            self._end()
            self._start()
        self._meshes += 1
        name = str(self._meshes)
        folder = os.path.join(self._job.folder, name)
        os.mkdir(folder)
        job.write_options(folder, options)
        self._job.limit = options.get("time_limit")
        watcher = job.Watcher(self._child, cancel, self._job)
        status = None
        try:
            self._child.stdin.write(request(name, what))
            self._child.stdin.flush()
            for line in self._stdout.each():
                kind, value = self._job.parse(line.rstrip("\n"))
                if kind == "done":
                    status = value
                    break
                if kind == "progress":
                    self._job.stage = value[0]
                    if progress:
                        progress(*value)
                elif kind == "log" and log:
                    log(value)
        except BrokenPipeError:
            pass  # it has died; its last words are below
        except BaseException:
            watcher.end()
            self._end()
            raise
        watcher.end()
        if status is None:
            last_words = "" if watcher.reason or watcher.error else self._stderr.text()
            status, stage = self._child.wait(), self._job.stage
            self._end()
            if watcher.error:
                raise watcher.error
            if watcher.reason:
                raise Cancelled(tr(watcher.reason))
            return job.outcome(folder, what, status or 1, last_words, stage)
        return job.outcome(folder, what, status)


def request(name, what):
    """The line by which a session's child is asked for something, in a folder inside its own that has the options."""
    return "{} {}\n".format(name, what)
