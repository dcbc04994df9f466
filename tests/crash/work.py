# SPDX-License-Identifier: Apache-2.0
"""Short pieces of work that can be cut off anywhere and gone on with: a calibration, a cohort's shard, diagnoses and
discoveries in a batch. What the tests of crashes and bench/kills.py share."""
import csv
import json
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cluster"))
from laboratory import make_cohort  # noqa: E402

CLOCK = ("time", "second", "date", "checksum")  # columns and keys that no two starts share


def timeless(value):
    """JSON without what a clock says."""
    if isinstance(value, dict):
        return {key: timeless(one) for key, one in value.items() if not any(word in key for word in CLOCK)}
    return [timeless(one) for one in value] if isinstance(value, list) else value


def rows(text):
    """The cells of a table without columns of a clock, and without rows about one."""
    table = list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
    if not table:
        return []
    kept = [k for k, title in enumerate(table[0]) if not any(word in title for word in CLOCK)]
    return [[row[k] for k in kept if k < len(row)] for row in table
            if not any(word in cell for word in CLOCK for cell in row[:4])]


def content(file):
    """What must be the same in two starts."""
    text = file.read_text(encoding="utf-8")
    if file.name == "evidence.json":
        return text.splitlines()
    if file.suffix == ".json":
        return timeless(json.loads(text))
    return rows(text) if file.suffix == ".csv" else text


class Work:
    """`start` and `go_on` are words of a command, run in a folder that prepare() has filled; results go to out/."""

    compared: tuple[str, ...] = ()
    messages = 1  # at most, where the disk fails
    keeps_ends = False  # whether results may say that lack of memory ended a search

    def __init__(self, length=1):
        self.length = length

    def results(self, folder):
        """Path below out/ -> content. Empty where the work is not finished."""
        out = pathlib.Path(folder) / "out"
        if not self.finished(out):
            return {}
        return {str(file.relative_to(out)): content(file) for pattern in self.compared for file in sorted(out.glob(pattern))}


class Calibration(Work):
    start = ["run", "experiment.json", "-o", "out", "--quiet", "-j", "2", "--no-certificate"]
    go_on = [*start, "--resume"]
    compared = ("*.csv", "result.json", "input.json")
    keeps_ends = True

    def prepare(self, folder):
        make_cohort(folder, 1)
        file = folder / "experiment.json"
        experiment = json.loads(file.read_text(encoding="utf-8"))
        experiment["optimizers"]["es"] = {"type": "es", "parents": 5, "offspring": 20}
        experiment["runs"] = [
            {"model": "gho", "optimizer": "es", "realisations": 3, "stop": {"max_evaluations": 300 * self.length}},
            {"model": "gho", "optimizer": "lm"}]
        file.write_text(json.dumps(experiment), encoding="utf-8")

    def finished(self, out):
        return (out / "result.json").exists()

    def results(self, folder):
        found = super().results(folder)
        found.pop("damaged_rows.csv", None)
        return found


class CohortShard(Work):
    start = go_on = ["cohort", "cohort.json", "-o", "out", "--shard", "1/1", "--no-reports", "--diagnose", "--quiet", "-j", "2"]
    compared = ("specimens/*/record.json", "specimens/*/evidence.json", "specimens/*/result.json", "specimens/*/*.csv")

    def prepare(self, folder):
        self.specimens = 2 * self.length
        make_cohort(folder, self.specimens)
        file = folder / "cohort.json"
        cohort = json.loads(file.read_text(encoding="utf-8"))
        cohort["diagnosis"] = {"quick": True}
        file.write_text(json.dumps(cohort), encoding="utf-8")

    def finished(self, out):
        return all(len(list(out.glob(f"specimens/*/{name}"))) == self.specimens for name in ("record.json", "evidence.json"))


class Batch(Work):
    compared = ("*/*.csv", "*/*.json")
    messages = 2  # one a case

    def __init__(self, verb, length=1):
        super().__init__(length)
        self.start = self.go_on = [verb, "--batch", "--quick", "cases", "-o", "out", "--quiet", "-j", "2"]

    def prepare(self, folder):
        for k in range(2 * self.length):
            make_cohort(folder / f"cases/{k}", 1, seed=k)

    def finished(self, out):
        return len(list(out.glob("*/result.json"))) == 2 * self.length


def work_of(kind, length=1):
    kinds = {"calibration": Calibration, "cohort": CohortShard, "diagnosis": lambda n: Batch("diagnose", n),
             "discovery": lambda n: Batch("discover", n)}
    return kinds[kind](length)


def program(executable, *words):
    return [str(pathlib.Path(executable).resolve()), "--allow-world-writable-plugins", *words]


def call(command, folder, environment=None, timeout=120):
    """Exit code (negative: a signal), stderr."""
    ended = subprocess.run(command, cwd=folder, env={**os.environ, **(environment or {})}, text=True, check=False,
                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=timeout, errors="replace")
    return ended.returncode, ended.stderr


def differing(one, other):
    """Names of files in which two results differ."""
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))
