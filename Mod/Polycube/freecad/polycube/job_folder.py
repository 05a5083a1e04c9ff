"""Folders of jobs, of which none stays: one whose FreeCAD was killed is removed by the next job.

While its process lives a folder holds a file under a lock of flock(2); one whose lock is free belongs to nobody. backend/core/temporary_folder.cpp does the
same with the same file, so that each clears what the other left.
"""

import os
import shutil
import tempfile

try:
    import fcntl
except ImportError:  # no POSIX system: nothing is cleared
    fcntl = None

_PREFIX = "polycube-"
_OWNER = "polycube.owner"


class JobFolder:
    """A new folder in `parent`, None for the system's place for temporary files; close() removes it."""

    def __init__(self, parent=None):
        _clear_abandoned(parent or tempfile.gettempdir())
        self.path = tempfile.mkdtemp(prefix=_PREFIX + "job-", dir=parent)
        self._owner = _locked(self.path) if fcntl else None

    def close(self):
        shutil.rmtree(self.path, ignore_errors=True)
        if self._owner is not None:
            os.close(self._owner)
            self._owner = None


def _locked(folder):
    """A descriptor of the folder's locked file. It has its name only once it is locked, for others take a free lock for that of a dead process."""
    owner = os.path.join(folder, _OWNER)
    descriptor = os.open(owner + ".new", os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.rename(owner + ".new", owner)
    except OSError:  # a file system without locks
        os.close(descriptor)
        return None
    return descriptor


def _clear_abandoned(parent):
    if not fcntl:
        return
    for entry in os.scandir(parent):
        if not entry.name.startswith(_PREFIX):
            continue
        try:
            owner = os.open(os.path.join(entry.path, _OWNER), os.O_RDWR | os.O_NOFOLLOW)
        except OSError:  # somebody else's, or none of ours
            continue
        try:
            if os.fstat(owner).st_uid == os.geteuid():
                fcntl.flock(owner, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(entry.path, ignore_errors=True)
        except OSError:  # its process lives
            pass
        finally:
            os.close(owner)
