#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cohort_test.py TUNICA: `tunica discover` on a cohort from end to end, on rubbers that have a term in I2.

Their stresses are closed forms, drawn once with noise of 1 kPa (tests/references/experiments/make.py)."""
import csv
import json
import pathlib
import shutil
import sys
import tempfile

import jsonschema

sys.dont_write_bytecode = True
TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS / "cluster"))
from laboratory import Program, expect, run_cases

root = pathlib.Path(tempfile.mkdtemp(prefix="terms"))
SCHEMA = json.loads((TESTS.parent / "schemas/tunica-result.schema.json").read_text(encoding="utf-8"))
SECOND = {"a": 20.0, "b": 35.0, "c": 50.0, "d": 65.0}  # kPa, moduli of the term in I2, as make.py has them


def rubbers(name, missing=()):
    """The cohort of four in a folder of its own, without the files of `missing`."""
    folder = root / name
    shutil.copytree(TESTS / "references/experiments/rubbers", folder)
    for specimen in missing:
        for file in folder.glob(f"data/{specimen}_*.csv"):
            file.unlink()
    return folder, Program(sys.argv[1], folder)


def found_in(folder, results):
    """From a result.json that is as its schema says."""
    result = json.loads((folder / results / "result.json").read_text(encoding="utf-8"))
    faults = [error.message for error in jsonschema.Draft7Validator(SCHEMA).iter_errors(result)]
    expect(not faults, faults[:3])
    return result["discovery"]


def table(file):
    return list(csv.DictReader(file.read_text(encoding="utf-8").splitlines()))


def a_common_term_is_found_and_each_specimen_has_its_own_amplitude():
    folder, tunica = rubbers("whole")
    said = tunica("discover", "cohort.json", "-o", "r", "--quiet")
    found = found_in(folder, "r")
    expect(found["verdict"] == "discovered", said)
    expect([one["name"] for one in found["terms"]] == ["I2_linear"] and found["terms"][0]["seen"] == 4, said)
    expect("in 4 of 4 specimens" in said and "extended_cohort.json" in said, said)
    rows = table(folder / "r/terms.csv")
    expect([one["specimen"] for one in rows] == list(SECOND), rows)
    for one in rows:
        half = float(one["high"]) - float(one["value"])  # 95 %; 2.5 of them are 5 standard errors: 6e-7
        expect(abs(float(one["value"]) - SECOND[one["specimen"]]) < 2.5 * half, one)
    page = (folder / "r/report.html").read_text(encoding="utf-8")
    expect("dψ/dx" in page and "Specimens" in page, "report.html lacks the curves or the specimens")
    # The extended cohort is one, and finds the same amplitudes.
    tunica("cohort", "r/extended_cohort.json", "-o", "e", "--no-reports", "--quiet")
    again = {one["specimen"]: float(one["estimate"]) for one in table(folder / "e/parameters.csv")
             if one["parameter"].endswith("I2_linear.mu")}
    for one in rows:
        expect(abs(again[one["specimen"]] - float(one["value"])) < 1e-3 * float(one["value"]), (one, again))


def a_whole_energy_is_found_from_nothing():
    folder, tunica = rubbers("nothing")
    said = tunica("discover", "cohort.json", "--from-nothing", "-o", "r", "--quiet")
    expect([one["name"] for one in found_in(folder, "r")["terms"]] == ["I1_linear", "I2_linear"], said)
    tunica("cohort", "r/extended_cohort.json", "-o", "e", "--no-reports", "--quiet")
    names = {one["parameter"] for one in table(folder / "e/parameters.csv")}
    expect({"I1_linear_mu", "I2_linear_mu"} <= names, names)


def a_specimen_that_cannot_be_read_is_left_out_with_its_reason():
    folder, tunica = rubbers("missing", missing=("b",))
    said = tunica("discover", "cohort.json", "-o", "r", "--quiet")
    found = found_in(folder, "r")
    expect([one["specimen"] for one in found["specimens"]] == ["a", "c", "d"], said)
    expect([one["specimen"] for one in found["left_out"]] == ["b"], found["left_out"])
    expect("b_uniaxial.csv" in found["left_out"][0]["reason"] and "b_uniaxial.csv" in said, said)
    # What the file does not state is said in the report: here the noise.
    experiment = json.loads((folder / "experiment.json").read_text(encoding="utf-8"))
    for test in experiment["tests"].values():
        del test["data"]["noise"]
    (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
    tunica("discover", "cohort.json", "-o", "open", "--quiet")
    found_in(folder, "open")
    page = (folder / "open/report.html").read_text(encoding="utf-8")
    expect("no noise is stated" in page and "in 3 of 3 specimens" in page, "report.html lacks the warning")
    empty, program = rubbers("empty", missing=tuple(SECOND))
    refused = program("discover", "cohort.json", "-o", "r", "--quiet", code=2)
    expect("none of 4 specimens can be read" in refused and "a_uniaxial.csv" in refused, refused)
    expect(not (empty / "r").exists(), "a refused discovery leaves its folder")


run_cases([a_common_term_is_found_and_each_specimen_has_its_own_amplitude, a_whole_energy_is_found_from_nothing,
           a_specimen_that_cannot_be_read_is_left_out_with_its_reason])
shutil.rmtree(root, ignore_errors=True)
