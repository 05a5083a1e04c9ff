"""One part of a sweep: mesh_part.py PROGRAM PART RESULT.json MESH.vtu TIME_LIMIT CPU_LIMIT [OPTIONS OF polycube mesh...].

Runs `polycube mesh` and writes what came out, whatever it was, as JSON: status 0 means that the result is there, not that there is a mesh. Without one
MESH.vtu is an empty file. Limits are in seconds, 0 for none. The program keeps the time limit itself; where it does not, it is killed. The result is written
last and at once, so an interrupted job leaves none.
"""

import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time

GRACE = 0.1  # of the time limit, and
GRACE_SECONDS = 5  # besides: what a program that keeps its limit may take to end
WORDS = {1: "bad input", 2: "refused", 3: "out of time"}


def run(command, time_limit, cpu_limit):
    """(wait status, seconds, resources used, killed, text on standard error)"""
    with tempfile.TemporaryFile() as errors:
        start = time.monotonic()
        limits = (lambda: resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit, cpu_limit + GRACE_SECONDS))) if cpu_limit else None
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors, start_new_session=True, preexec_fn=limits)
        late = threading.Event()

        def end(*_):
            late.set()
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer((1 + GRACE) * time_limit + GRACE_SECONDS, end)
        if time_limit:
            timer.start()
        try:
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = status  # it was waited for
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
        finally:
            timer.cancel()
        seconds = time.monotonic() - start
        errors.seek(0)
        return status, seconds, used, late.is_set(), errors.read().decode(errors="replace")


def answer(status, late):
    """(word, exit status or None, what there is to say where the program said nothing)"""
    if late:
        return "no answer", None, "killed: it did not end at the time limit"
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        if number in (signal.SIGXCPU, signal.SIGKILL):
            return "no answer", None, "killed: " + ("more processor time than the limit" if number == signal.SIGXCPU else "from outside, or out of memory")
        return "crash", None, "crash: " + signal.Signals(number).name
    code = os.WEXITSTATUS(status)
    return WORDS.get(code, "mesh" if code == 0 else "crash"), code, "" if code == 0 else "exit status {} without a word".format(code)


def main():
    program, part, result, mesh, time_limit, cpu_limit, *options = sys.argv[1:]
    time_limit, cpu_limit = float(time_limit), int(float(cpu_limit))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    report = result + ".report"
    for old in (mesh, report):
        if os.path.exists(old):
            os.remove(old)
    command = [program, "mesh", part, "-o", mesh, "--report", report, *options]
    if time_limit:
        command += ["--time-limit", repr(time_limit)]
    status, seconds, used, late, text = run(command, time_limit, cpu_limit)
    word, code, reason = answer(status, late)
    said = [line.removeprefix("polycube: ") for line in text.splitlines() if line.strip()]
    warnings = [line.removeprefix("warning: ") for line in said if line.startswith("warning: ")]
    said = [line for line in said if not line.startswith("warning: ")]
    row = {"part": os.path.basename(os.path.realpath(part)), "result": word, "exit": code, "seconds": seconds,
           "cpu_seconds": used.ru_utime + used.ru_stime, "memory_mb": used.ru_maxrss / 1024, "warnings": warnings,
           "reason": (said[-1] if said and word not in ("crash", "no answer") else reason)}
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
    with open(result + ".new", "w", encoding="utf-8") as file:
        json.dump(row, file, indent=1)
    os.replace(result + ".new", result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
