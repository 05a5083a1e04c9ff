"""Meshes a folder of parts: sweep.py PROGRAM FOLDER -o PAGE.(html|md) [...], see --help.

The jobs are rules of the Snakemake workflow beside this file. Their results stay in a folder beside the page, so that the same command goes on where it was
stopped, and redoes what another program, part or option would change.
"""

import argparse
import fcntl
import glob
import hashlib
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile

from table import FAULTS, SUFFIXES, counts, outcome, read_row

HERE = os.path.dirname(os.path.abspath(__file__))
DONE, BAD_INPUT, FAULTY, STOPPED = 0, 1, 2, 3


class BadInput(Exception):
    pass


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise BadInput(message)


def key_of(name):
    """`name` where a shell and Snakemake's wildcards take it as it is; otherwise something like it, and as unique."""
    plain = re.sub(r"[^A-Za-z0-9._+-]", "_", name)
    if plain == name:
        return name
    stem, suffix = os.path.splitext(plain)
    return "{}-{}{}".format(stem, hashlib.sha1(os.fsencode(name)).hexdigest()[:8], suffix)


def parts_in(folder):
    """Key -> path."""
    names = sorted(name for name in os.listdir(folder) if name.lower().endswith(SUFFIXES))
    if not names:
        raise BadInput("there is no part in {} ({})".format(folder, ", ".join(SUFFIXES)))
    return {key_of(name): os.path.abspath(os.path.join(folder, name)) for name in names}


def link_parts(parts, folder):
    """Links to the parts, by their keys; one that is right already stays, as it is what results are older or newer than."""
    os.makedirs(folder, exist_ok=True)
    for key, path in parts.items():
        link = os.path.join(folder, key)
        if os.path.islink(link) and os.readlink(link) == path:
            continue
        if os.path.lexists(link):
            os.remove(link)
        os.symlink(path, link)


def digest(*paths):
    found = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            found.update(file.read())
    return found.hexdigest()


def check_options(program, options):
    """Against the program itself: with good ones it complains of a part that is not there."""
    with tempfile.TemporaryDirectory() as folder:
        part = os.path.join(folder, "none.step")
        run = subprocess.run([program, "mesh", part, "-o", os.path.join(folder, "none.vtu"), *options], capture_output=True, text=True)
    if part not in run.stderr:
        raise BadInput(run.stderr.strip().removeprefix("polycube: ") or "`polycube mesh` does not take " + shlex.join(options))


def parse(arguments):
    parser = Parser(
        prog="polycube sweep", allow_abbrev=False, usage="polycube sweep FOLDER -o PAGE [--jobs N] [...] [options of polycube mesh, for every part]",
        description="Meshes every part in a folder; a page tells what came out. Stopped, it goes on where it was. Exit status 0: every part was answered for, "
        "1: bad arguments, 2: a crash or an invalid mesh among the answers, 3: stopped.")
    parser.add_argument("folder", help="with parts " + " ".join(SUFFIXES))
    parser.add_argument("-o", "--output", required=True, metavar="PAGE", help="table, pictures and reasons (.html), or the table only (.md); results go to a folder "
                        "beside it, PAGE without its suffix and with .sweep")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="parts at a time; default: as many as there are cores")
    parser.add_argument("--time-limit", type=float, default=120, metavar="S", help="seconds for a part; 0: none; default: %(default)g")
    parser.add_argument("--cpu-limit", type=float, default=0, metavar="S", help="the same in processor time, for machines that do other work; default: none")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="of the mesher for each part; default: %(default)d")
    parser.add_argument("--judge", default="", metavar="PATH", help="program that is called as PATH PART MESH --json for a verdict on every mesh")
    parser.add_argument("--profile", metavar="NAME", help="Snakemake's profile of a cluster, which then runs the jobs")
    if arguments[:1] not in (["-h"], ["--help"]) and (not arguments or arguments[0].startswith("-")):
        raise BadInput("the folder of the parts comes first, before all options")
    given, options = parser.parse_known_args(arguments)
    if given.jobs < 1 or given.threads < 1 or given.time_limit < 0 or given.cpu_limit < 0:
        raise BadInput("--jobs and --threads are 1 at least, limits 0 at least")
    if not os.path.isdir(given.folder):
        raise BadInput("there is no folder {}".format(given.folder))
    if not given.output.endswith((".html", ".md")):
        raise BadInput(given.output + ": the suffix must be .html or .md")
    if given.judge and not os.access(given.judge, os.X_OK):
        raise BadInput(given.judge + ": no program")
    return given, options


def _heed_interrupts():
    """What a shell starts in the background ignores them, and so would all that it starts."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _stop(*_):
    raise KeyboardInterrupt


def snakemake(given, work, lock):
    """Runs the workflow to its end and returns its exit status, or None where the user stopped it."""
    command = [sys.executable, "-m", "snakemake", "--snakefile", os.path.join(HERE, "Snakefile"), "--directory", work,
               "--configfile", os.path.join(work, "settings.json"),
               "--log-handler-script", os.path.join(HERE, "lines.py"), "--keep-going", "--rerun-incomplete", "--rerun-triggers", "mtime", "params", "input",
               "--scheduler", "greedy", "--nolock"]
    command += ["--profile", given.profile, "--jobs", str(given.jobs)] if given.profile else ["--cores", str(given.jobs * given.threads)]
    with open(os.path.join(work, "snakemake.log"), "a", encoding="utf-8") as log:
        # In a session of its own, and told of the end by us alone: Snakemake lets jobs that run come to their end, a stopped sweep does not wait for them.
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=log, start_new_session=True, pass_fds=[lock], preexec_fn=_heed_interrupts)
        try:
            return process.wait()
        except KeyboardInterrupt:
            os.killpg(process.pid, signal.SIGINT)
            process.wait()
            return None


def sweep(program, given, options):
    program, page = os.path.abspath(program), os.path.abspath(given.output)
    parts = parts_in(given.folder)
    options = [*options, "--threads", str(given.threads)]
    check_options(program, options)
    work = os.path.splitext(page)[0] + ".sweep"
    try:
        os.makedirs(work, exist_ok=True)
        lock = os.open(os.path.join(work, "lock"), os.O_RDWR | os.O_CREAT)
    except OSError as error:
        raise BadInput("cannot write {}: {}".format(error.filename, error.strerror)) from error
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise BadInput("a sweep in {} is running".format(work)) from None
    helpers = sorted(glob.glob(glob.escape(program) + "-*"))
    settings = {"here": HERE, "python": sys.executable, "program": program, "digest": digest(program, *helpers), "options": shlex.join(options),
                "threads": given.threads, "time_limit": given.time_limit, "cpu_limit": given.cpu_limit, "judge": os.path.abspath(given.judge) if given.judge else "",
                "judge_digest": digest(given.judge) if given.judge else "", "page": page, "parts": list(parts)}
    link_parts(parts, os.path.join(work, "parts"))
    with open(os.path.join(work, "settings.json"), "w", encoding="utf-8") as file:
        json.dump(settings, file, indent=1)
    status = snakemake(given, work, lock)
    if status is None:
        print("polycube: stopped; the same command goes on from here", file=sys.stderr)
        return STOPPED
    if status:
        raise BadInput("the workflow broke off, see {}".format(os.path.join(work, "snakemake.log")))
    rows = [read_row(work, key, settings["judge"]) for key in parts]
    print("{}: {}".format(given.output, counts(rows)))
    return FAULTY if any(outcome(row) in FAULTS for row in rows) else DONE


def main():
    signal.signal(signal.SIGTERM, _stop)
    try:
        given, options = parse(sys.argv[2:])
        return sweep(sys.argv[1], given, options)
    except BadInput as error:
        print("polycube: {}".format(error), file=sys.stderr)
        return BAD_INPUT
    except KeyboardInterrupt:
        return STOPPED


if __name__ == "__main__":
    sys.exit(main())
