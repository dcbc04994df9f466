#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""fake_slurm.py COMMAND WORDS...: what tunica uses of sbatch, squeue, sacct, scancel and scontrol, as far as a test needs
it. Jobs stand in the folder FAKE_SLURM; nothing runs unless the test runs it. A command whose name is in the file
`broken` fails as if the controller were down; "merge" there is the sbatch of a job that waits for others."""
import fcntl
import json
import os
import pathlib
import sys

FOLDER = pathlib.Path(os.environ["FAKE_SLURM"])
ALIVE = ("PENDING", "RUNNING", "COMPLETING")


def members(array):
    for part in array.split(","):
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)


class Jobs:
    """Tasks as a list of objects, read and written under a lock."""

    def __enter__(self):
        self.file = open(FOLDER / "jobs.json", "a+", encoding="utf-8")
        fcntl.flock(self.file, fcntl.LOCK_EX)
        self.file.seek(0)
        self.tasks = json.loads(self.file.read() or "[]")
        return self.tasks

    def __exit__(self, *_):
        self.file.truncate(0)
        self.file.write(json.dumps(self.tasks, indent=1))
        self.file.close()


def command(name, words):
    options = dict(word[2:].partition("=")[::2] for word in words if word.startswith("--"))
    broken = FOLDER / "broken"
    names = (name, "merge") if "dependency" in options else (name,)
    if broken.exists() and set(names) & set(broken.read_text(encoding="utf-8").split()):
        sys.exit(f"{name}: error: Unable to contact slurm controller (connect failure)")
    with open(FOLDER / "calls.txt", "a", encoding="utf-8") as calls:
        calls.write(json.dumps([name, *words]) + "\n")
    with Jobs() as tasks:
        if name == "sbatch":
            number = str(max([100, *(int(task["job"]) for task in tasks)]) + 1)
            for part in members(options["array"]) if "array" in options else [None]:
                tasks.append({"job": number, "part": part, "name": options["job-name"], "state": "PENDING",
                              "reason": "Dependency" if "dependency" in options else "Resources", "script": words[-1],
                              "log": options["output"], "forgotten": False})
            print(number)
        elif name == "squeue":
            for task in tasks:
                if task["name"] in options["name"].split(",") and not task["forgotten"]:
                    part = "N/A" if task["part"] is None else task["part"]
                    print("|".join(map(str, (task["job"], part, task["name"], task["state"], task["reason"], ""))))
        elif name == "sacct":
            for task in tasks:
                if task["job"] in options["jobs"].split(","):
                    number = task["job"] + ("" if task["part"] is None else f"_{task['part']}")
                    print("|".join((number, task["name"], task["state"], "n1")))
        elif name == "scancel":
            for task in tasks:
                if task["job"] in words and task["state"] in ALIVE:
                    task["state"] = "CANCELLED"
        elif name == "scontrol":
            print("Configuration data as of today\nMaxArraySize            = 11\nMaxJobCount             = 10000")


if __name__ == "__main__":
    command(sys.argv[1], sys.argv[2:])
