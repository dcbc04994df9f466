#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cohort_test.py TUNICA: `tunica discover` on a cohort from end to end, on rubbers that have a term in I2.

Stresses are closed forms, drawn once with noise of 1 kPa from the seed below."""
import csv
import json
import pathlib
import random
import shutil
import sys
import tempfile

import jsonschema

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cluster"))
from laboratory import Program, expect, run_cases

root = pathlib.Path(tempfile.mkdtemp(prefix="terms"))
SCHEMA = json.loads((pathlib.Path(__file__).resolve().parents[2] /
                     "schemas/tunica-result.schema.json").read_text(encoding="utf-8"))
SECOND = {"a": 20.0, "b": 35.0, "c": 50.0, "d": 65.0}  # kPa, moduli of the term in I2


def stress(protocol, stretch, first, second):
    """Cauchy stress of (mu_1/2)(I1 - 3) + (mu_2/2)(I2 - 3), incompressible."""
    if protocol == "uniaxial":
        return first * (stretch**2 - 1 / stretch) + second * (stretch - stretch**-2)
    return first * (stretch**2 - stretch**-4) + second * (stretch**4 - stretch**-2)


def rubbers(name, missing=()):
    """A cohort of four in a folder of its own, without the files of `missing`."""
    folder = root / name
    (folder / "data").mkdir(parents=True)
    draw = random.Random(7)
    for k, (specimen, second) in enumerate(SECOND.items()):
        for protocol in ("uniaxial", "equibiaxial"):
            lines = ["stretch [1],stress [kPa]"]
            for i in range(25):
                stretch = 1.1 + 0.05 * i
                value = stress(protocol, stretch, 200 + 30 * k, second) + draw.gauss(0, 1)
                lines.append(f"{stretch:.8g},{value:.8g}")
            if specimen not in missing:
                (folder / f"data/{specimen}_{protocol}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    data = {"columns": {"stretch": "stretch", "stress": "stress"}, "noise": {"absolute": "1 kPa"}}
    experiment = {
        "format": 1, "name": "rubber",
        "models": {"rubber": {"type": "neo_hooke", "parameters": {"mu": {"initial": "200 kPa"}}}},
        "tests": {
            "uniaxial": {"type": "uniaxial", "direction": "axial", "data": {"file": "data/a_uniaxial.csv", **data}},
            "equibiaxial": {"type": "biaxial", "protocol": "equibiaxial",
                            "data": {"file": "data/a_equibiaxial.csv", **data}}},
        "optimizers": {"lm": {"type": "ceres_lm"}},
        "runs": [{"model": "rubber", "optimizer": "lm"}]}
    cohort = {
        "format": 1, "name": "rubbers", "experiment": "experiment.json", "specimens": "specimens.csv",
        "bind": {"/tests/uniaxial/data/file": "data/{specimen}_uniaxial.csv",
                 "/tests/equibiaxial/data/file": "data/{specimen}_equibiaxial.csv"}}
    (folder / "experiment.json").write_text(json.dumps(experiment, indent=1), encoding="utf-8")
    (folder / "cohort.json").write_text(json.dumps(cohort, indent=1), encoding="utf-8")
    (folder / "specimens.csv").write_text("\n".join(["specimen", *SECOND]) + "\n", encoding="utf-8")
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
