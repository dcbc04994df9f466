#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_shards_test.py TUNICA: realisations of one experiment, and folders of diagnoses, in shards."""
import csv
import json
import pathlib
import shutil
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from laboratory import Program, expect, make_cohort, run_cases, small

executable = small(sys.argv[1], "ceres_lm", "channel_errors", "es", "gho", "record_errors", "uniaxial")
root = pathlib.Path(tempfile.mkdtemp(prefix="shards"))
CLOCK = ("time", "second", "date", "checksum")  # columns and keys that no two starts share


def laboratory(name):
    folder = root / name
    make_cohort(folder, 1)
    file = folder / "experiment.json"
    experiment = json.loads(file.read_text(encoding="utf-8"))
    experiment["optimizers"]["es"] = {"type": "es", "parents": 5, "offspring": 20}
    experiment["runs"] = [{"model": "gho", "optimizer": "es", "realisations": 5, "stop": {"max_evaluations": 2000}},
                          {"model": "gho", "optimizer": "lm", "realisations": 3}]
    experiment["analysis"] = {"bootstrap": {"draws": 40}}
    file.write_text(json.dumps(experiment), encoding="utf-8")
    return folder, Program(executable, folder)


def timeless(value):
    """JSON without what a clock says."""
    if isinstance(value, dict):
        return {key: timeless(one) for key, one in value.items() if not any(word in key for word in CLOCK)}
    return [timeless(one) for one in value] if isinstance(value, list) else value


def rows(file):
    """The cells of a table without columns of a clock, and without rows about one."""
    with open(file, encoding="utf-8") as stream:
        table = list(csv.reader(line for line in stream if not line.startswith("#")))
    kept = [k for k, title in enumerate(table[0]) if not any(word in title for word in CLOCK)]
    return [[row[k] for k in kept] for row in table if not any(word in cell for word in CLOCK for cell in row[:4])]


def expect_same_run(one, other):
    for file in sorted(one.glob("*.csv")):
        expect(rows(file) == rows(other / file.name), f"{file.name} differs")
    first, second = (timeless(json.loads((results / "result.json").read_text(encoding="utf-8"))) for results in (one, other))
    expect(first == second, "result.json differs by more than a clock")


def shards_of_any_number_merge_to_one_run():
    folder, tunica = laboratory("numbers")
    tunica("run", "experiment.json", "-o", "whole", "--quiet")
    for shards in (1, 2, 7):
        for part in range(shards, 0, -1):
            tunica("run", "experiment.json", "-o", f"of{shards}", "--shard", f"{part}/{shards}", "--quiet", "-j", "1")
        for _ in range(2):  # a merge may be repeated
            tunica("run", "experiment.json", "-o", f"of{shards}", "--merge", "--quiet")
            expect_same_run(folder / "whole", folder / f"of{shards}")


def a_shard_that_is_killed_goes_on():
    folder, tunica = laboratory("killed")
    tunica("run", "experiment.json", "-o", "whole", "--quiet")
    harmed = 0
    for attempt in range(4):
        process = tunica.start("run", "experiment.json", "-o", "r", "--shard", "1/2", "--quiet")
        journal = folder / "r/shards/1of2/evaluations.csv"
        before = journal.stat().st_size if journal.exists() else 0
        while process.poll() is None and (not journal.exists() or journal.stat().st_size <= before):
            time.sleep(0.002)
        if process.poll() is None:
            process.kill()
            harmed += 1
        process.communicate()
    expect(harmed > 0, "the shard was never killed")
    # Killed before its first checkpoint, a part leaves a folder that nothing can go on with.
    (folder / "r/shards/2of2").mkdir()
    (folder / "r/shards/2of2/evaluations.csv").write_text("id,run,real", encoding="utf-8")
    for part in ("1/2", "2/2"):
        tunica("run", "experiment.json", "-o", "r", "--shard", part, "--quiet")
    tunica("run", "experiment.json", "-o", "r", "--merge", "--quiet")
    expect_same_run(folder / "whole", folder / "r")


def what_is_missing_or_changed_is_said():
    folder, tunica = laboratory("missing")
    (folder / "empty").mkdir()
    said = tunica("run", "experiment.json", "-o", "empty", "--merge", code=2)
    expect("holds no part of a run" in said and "--shard k/N" in said, said)
    said = tunica("run", "experiment.json", "-o", "r", "--shard", "2/3", "--seed", "1", "--quiet")
    expect("tunica run experiment.json -o r --merge --seed 1" in said, said)
    shutil.rmtree(folder / "r")
    tunica("run", "experiment.json", "-o", "r", "--shard", "2/3", "--quiet")
    said = tunica("run", "experiment.json", "-o", "r", "--merge", code=2)
    expect("5 of 8 searches are not finished, the first is realisation 1 of gho/es" in said, said)
    said = tunica("run", "experiment.json", "--shard", "2/3", code=2)
    expect("name it with -o" in said, said)
    said = tunica("run", "experiment.json", "-o", "r", "--shard", "4/3", code=2)
    expect("1 ≤ k ≤ N" in said, said)
    for part in ("1/3", "3/3"):
        tunica("run", "experiment.json", "-o", "r", "--shard", part, "--quiet")
    said = tunica("run", "experiment.json", "-o", "r", "--merge", "--seed", "8", code=2)
    expect("seed" in said, said)
    tunica("run", "experiment.json", "-o", "r", "--merge", "--quiet")
    said = tunica("run", "experiment.json", "-o", "r", "--shard", "1/3", code=2)
    expect("parts are merged" in said, said)


def folders_of_diagnoses_are_shared_out():
    folder, tunica = laboratory("cases")
    for name in "abcde":
        shutil.copytree(folder / "data", folder / f"cases/{name}/data")
        shutil.copy(folder / "experiment.json", folder / f"cases/{name}/experiment.json")
    made = []
    for part in ("2/2", "1/2", "1/2"):
        tunica("diagnose", "--batch", "--quick", "cases", "--shard", part, "--quiet")
        made.append(sorted(file.parent.name for file in (folder / "cases").glob("*/result.json")))
    expect(made == [["b", "d"], list("abcde"), list("abcde")], made)
    said = tunica("diagnose", "experiment.json", "--shard", "1/2", code=2)
    expect("--batch" in said, said)


run_cases([shards_of_any_number_merge_to_one_run, a_shard_that_is_killed_goes_on, what_is_missing_or_changed_is_said,
           folders_of_diagnoses_are_shared_out])
shutil.rmtree(root, ignore_errors=True)
