"""clang-tidy over the backend by its .clang-tidy, cheaply: most of its time goes into the headers of Eigen, OpenCASCADE and the standard library.

So many sources are read as one, with these headers once. Sources that use one name each for something of its own stay apart.
"""

import hashlib
import json
import multiprocessing.pool
import os
import re
import shlex
import subprocess

from test_architecture import REPO, tracked

VERSION = 14
#: What clang does not know of GCC's warnings it would tell; those that both know are the compiler's task.
OPTIONS = r"-(D|I|isystem|std=)"


def tool():
    """clang-tidy of the version that .clang-tidy is for, or None."""
    for name in ("clang-tidy-{}".format(VERSION), "clang-tidy"):
        try:
            version = subprocess.run([name, "--version"], capture_output=True, text=True).stdout
        except FileNotFoundError:
            continue
        if re.search(r"version {}\.".format(VERSION), version):
            return name
    return None


def sources():
    return [os.path.join(REPO, name) for name in tracked() if name.startswith("backend/") and name.endswith(".cpp")]


def names(text):
    """What a source declares outside classes; clang-format has put that, and only that, at the start of a line."""
    text = re.sub(r"^(template <.*?>|\[\[.*?\]\])\s+", "", text, flags=re.M)
    found = set()
    for line in re.findall(r"^(?!namespace|static_assert)[A-Za-z][^(={;[\n]*", text, flags=re.M):
        found |= set(re.findall(r"(?<![:\w])(\w+)\s*$", line))
    found |= set(re.findall(r"^\w[^(\n]*, (\w+) = ", text, flags=re.M))  # the second of two constants
    return found


def own_names(text):
    """Those of them that no other source knows."""
    return names("\n".join(re.findall(r"^namespace \{$.*?^\}  // namespace$", text, flags=re.M | re.S)))


def _with_headers(path, found):
    """{path: text} of a source and the headers of ours that it includes."""
    if path not in found:
        with open(path, encoding="utf-8") as file:
            found[path] = file.read()
        for header in re.findall(r'^#include "(.*)"', found[path], flags=re.M):
            _with_headers(os.path.join(REPO, "backend", header), found)
    return found


def groups(paths, least):
    """The sources in as few groups as their names allow, at least so many, each about as long as the others."""
    texts = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            texts[path] = file.read()
    all_names = {path: names("\n".join(_with_headers(path, {}).values())) for path in paths}
    own = {path: own_names(text) for path, text in texts.items()}
    clashes = {path: {other for other in paths if other != path and (own[path] & all_names[other] or own[other] & all_names[path])} for path in paths}
    made = [[] for _ in range(least)]
    for path in sorted(paths, key=lambda path: (-len(clashes[path]), path)):  # those with the least choice first
        free = [group for group in made if not clashes[path].intersection(group)]
        if not free:
            made.append([])
            free = made[-1:]
        min(free, key=lambda group: sum(len(texts[other]) for other in group)).append(path)
    return [sorted(group) for group in made if group]


def options(build):
    """What the compiler is told of headers, of all sources of the backend together."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = [entry["command"] for entry in json.load(file) if entry["file"].startswith(os.path.join(REPO, "backend"))]
    found = {}
    for command in commands:
        words = iter(shlex.split(command))
        for word in words:
            if re.match(OPTIONS, word):
                found[(word, next(words)) if word == "-isystem" else (word,)] = None
    return [word for option in found for word in option]


def findings(clang_tidy, folder, paths, flags):
    """What clang-tidy has to say of the sources, as text; empty if nothing. `folder`: for what is made on the way."""
    os.makedirs(folder, exist_ok=True)

    def check(numbered):
        number, group = numbered
        unit = os.path.join(folder, "unit{}.cpp".format(number))
        with open(unit, "w", encoding="utf-8") as file:
            file.writelines('#include "{}"  // NOLINT\n'.format(path) for path in group)
        command = [clang_tidy, "--quiet", "--config-file=" + os.path.join(REPO, ".clang-tidy"), unit, "--", *flags]
        run = subprocess.run(command, cwd=REPO, capture_output=True, text=True)
        return run.stdout + (run.stderr if run.returncode else "")

    units = list(enumerate(groups(paths, len(os.sched_getaffinity(0)))))
    with multiprocessing.pool.ThreadPool(len(os.sched_getaffinity(0))) as pool:
        return "".join(pool.map(check, units, 1))


def of_backend(clang_tidy, build):
    """findings() of the backend; at once where nothing has changed since there were none."""
    folder = os.path.join(build, "tidy")
    flags = options(build)
    known = hashlib.sha256(repr((clang_tidy, flags)).encode())
    for name in [".clang-tidy", "tests/architecture/tidy.py"] + [name for name in tracked() if name.startswith("backend/") and name.endswith((".cpp", ".h"))]:
        with open(os.path.join(REPO, name), "rb") as file:
            known.update(name.encode() + b"\0" + file.read() + b"\0")
    stamp = os.path.join(folder, "nothing-found-in")
    if os.path.exists(stamp):
        with open(stamp, encoding="ascii") as file:
            if file.read() == known.hexdigest():
                return ""
    text = findings(clang_tidy, folder, sources(), flags)
    if not text:
        with open(stamp, "w", encoding="ascii") as file:
            file.write(known.hexdigest())
    return text
