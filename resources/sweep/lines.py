"""What Snakemake's log becomes on the terminal: a line for every part. Snakemake imports this file by itself (--log-handler-script) and calls log_handler."""

import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from table import line, read_row  # noqa: E402

_jobs = {}  # number -> (rule, key)
_waiting = []  # lines of jobs that are done, for the share of all that is told next


def _judged():
    with open("settings.json", encoding="utf-8") as file:
        return bool(json.load(file)["judge"])


def log_handler(message):
    level = message["level"]
    if level == "job_info":
        _jobs[message["jobid"]] = (message["name"], dict(message["wildcards"]).get("key"))
    elif level == "progress":
        for text in _waiting:
            print("{:3.0f} %  {}".format(100 * message["done"] / max(message["total"], 1), text), flush=True)
        _waiting.clear()
    elif level == "job_finished":
        rule, key = _jobs.get(message["jobid"], (None, None))
        judged = _judged()
        if rule == ("judge" if judged else "mesh"):  # after which a part's line is known
            _waiting.append(line(read_row(".", key, judged)))
