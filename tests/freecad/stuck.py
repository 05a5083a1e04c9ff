"""A mesher that is stuck in the middle of its work, as in a query of the CAD kernel that does not end."""

import os
import tempfile
from contextlib import contextmanager
from unittest import mock


@contextmanager
def mesher():
    """Children that are started meanwhile stop where they begin with the tetrahedra, and notice no time limit."""
    with tempfile.TemporaryDirectory() as folder:
        worker = os.path.join(folder, "worker")
        with open(worker, "w", encoding="ascii") as file:
            file.write("#!/bin/sh\nkill -STOP $PPID\nsleep 60\n")
        os.chmod(worker, 0o700)
        with mock.patch.dict(os.environ, POLYCUBE_TET_WORKER=worker):
            yield
