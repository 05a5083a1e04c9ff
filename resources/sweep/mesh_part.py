"""One part of a sweep: mesh_part.py PROGRAM PART RESULT.json MESH.vtu TIME_LIMIT CPU_LIMIT [OPTIONS OF polycube mesh...].

Runs `polycube mesh` and writes what came out, whatever it was, as JSON: status 0 means that the result is there, not that there is a mesh. Without one
MESH.vtu is an empty file. Limits are in seconds, 0 for none. The program keeps the time limit itself; where it does not, it is killed. The result is written
last and at once, so an interrupted job leaves none.
"""

import json
import math
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

from table import write_at_once

# What a program that keeps its limit may take to end: it promises 2 s (backend/cli/supervise.cpp), the rest is a guess for a machine that is busy.
GRACE = 0.1  # of the time limit, and
GRACE_SECONDS = 5  # besides
WORDS = {0: "mesh", 1: "bad input", 2: "refused", 3: "out of time"}


def run(command, time_limit, cpu_limit):
    """(exit status, negative for a signal, None where it had to be killed; seconds; text on standard error)"""
    limits = (lambda: resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit, cpu_limit + GRACE_SECONDS))) if cpu_limit else None
    with tempfile.TemporaryFile() as errors:
        start = time.monotonic()
        try:
            status = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors, preexec_fn=limits,
                                    timeout=(1 + GRACE) * time_limit + GRACE_SECONDS if time_limit else None).returncode
        except subprocess.TimeoutExpired:
            status = None
        seconds = time.monotonic() - start
        errors.seek(0)
        return status, seconds, errors.read().decode(errors="replace")


def ended_by(number):
    """(word, what there is to say) of a program, or of its engine, that a signal ended."""
    if number == signal.SIGXCPU:
        return "no answer", "killed: more processor time than the limit"
    if number == signal.SIGKILL:
        return "no answer", "killed: from outside, or out of memory"
    return "crash", "crash: signal {} ({})".format(number, signal.strsignal(number))


def answer(status, last):
    """(word, exit status or None, what there is to say) by the exit status and the last line on standard error."""
    if status is None:
        return "no answer", None, "killed: it did not end at the time limit"
    if status < 0:
        word, reason = ended_by(-status)
        return word, None, reason
    engine = re.search(r"the engine ended by signal (\d+)", last)
    if engine:
        return ended_by(int(engine.group(1)))[0], status, last
    return WORDS.get(status, "crash"), status, last or "exit status {} without a word".format(status)


def main():
    program, part, result, mesh, time_limit, cpu_limit, *options = sys.argv[1:]
    time_limit, cpu_limit = float(time_limit), math.ceil(float(cpu_limit))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    report = result + ".report"
    for old in (mesh, report):
        if os.path.exists(old):
            os.remove(old)
    command = [program, "mesh", part, "-o", mesh, "--report", report, *options]
    if time_limit:
        command += ["--time-limit", repr(time_limit)]
    status, seconds, text = run(command, time_limit, cpu_limit)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = [line.removeprefix("polycube: ") for line in text.splitlines() if line.strip()]
    warnings = [line.removeprefix("warning: ") for line in said if line.startswith("warning: ")]
    said = [line for line in said if not line.startswith("warning: ")]
    word, code, reason = answer(status, said[-1] if said else "")
    row = {"part": os.path.basename(os.path.realpath(part)), "result": word, "exit": code, "seconds": seconds,
           "cpu_seconds": used.ru_utime + used.ru_stime, "memory_mb": used.ru_maxrss / 1024, "warnings": warnings, "reason": reason}
    if code == 0:
        with open(report, encoding="utf-8") as file:
            row["report"] = json.load(file)
        capture = row["report"]["cad"]
        lost = [kind for kind in ("faces", "edges", "vertices") if capture[kind]["captured"] < capture[kind]["total"]]
        row["result"] = "valid" if lost else "complete"
        row["reason"] = "; ".join(warnings)
    if os.path.exists(report):
        os.remove(report)
    if code != 0:
        with open(mesh, "w", encoding="utf-8"):
            pass
    write_at_once(result, json.dumps(row, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
