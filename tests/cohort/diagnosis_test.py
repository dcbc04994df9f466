#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""diagnosis_test.py TUNICA: `tunica cohort --diagnose` from end to end, on strips of which half have a force offset.

Data are drawn once, from the seeds below; a cohort in which nothing is wrong raises an alarm with probability 0.05 per
seed, and these do not."""
import csv
import json
import pathlib
import shutil
import sys
import tempfile

import jsonschema

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cluster"))
from laboratory import Program, expect, expect_same, make_cohort, run_cases

root = pathlib.Path(tempfile.mkdtemp(prefix="cohort"))
SCHEMA = json.loads((pathlib.Path(__file__).resolve().parents[2] /
                     "schemas/tunica-cohort-result.schema.json").read_text(encoding="utf-8"))
OFFSET = 0.6  # kPa, on stresses up to some hundred


def shifted(file, offset):
    rows = list(csv.reader(file.read_text(encoding="utf-8").splitlines()))
    lines = [",".join(rows[0])] + [f"{stretch},{float(stress) + offset:.8g}" for stretch, stress in rows[1:]]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def edit(file, change):
    content = json.loads(file.read_text(encoding="utf-8"))
    change(content)
    file.write_text(json.dumps(content, indent=1), encoding="utf-8")


def laboratory(name, specimens=8, offset=0.0, seed=5):
    """A cohort in a folder of its own. The stresses of axial strips of treated specimens are `offset` too large."""
    folder = root / name
    make_cohort(folder, specimens, seed=seed)

    def state_noise(experiment):
        for test in experiment["tests"].values():
            test["data"]["noise"] = {"relative": "2 %", "absolute": "0.05 kPa"}
    edit(folder / "experiment.json", state_noise)
    for k in range(1, specimens, 2):
        shifted(folder / f"data/s{k}_a.csv", offset)
    return folder, Program(sys.argv[1], folder)


def verdict_of(folder, results):
    """From a result.json that is as its schema says."""
    result = json.loads((folder / results / "result.json").read_text(encoding="utf-8"))
    faults = [error.message for error in jsonschema.Draft7Validator(SCHEMA).iter_errors(result)]
    expect(not faults, faults[:3])
    return result["diagnosis"]


def a_cohort_in_which_nothing_is_wrong_has_no_verdict_but_that():
    folder, tunica = laboratory("well")
    said = tunica("cohort", "cohort.json", "-o", "r", "--diagnose", "--no-reports", "--quiet")
    found = verdict_of(folder, "r")
    expect(found["verdict"] == "nothing_detected" and not found["alarm"], said)
    expect("NOTHING DETECTED" in said and not (folder / "r/extended.json").exists(), said)
    # Without the option nothing is diagnosed, and nothing of the earlier diagnosis stays.
    expect((folder / "r/mechanisms.csv").exists(), said)
    plain = tunica("cohort", "cohort.json", "-o", "r", "--no-reports", "--quiet")
    result = json.loads((folder / "r/result.json").read_text(encoding="utf-8"))
    expect("diagnosis" not in result and "what the model gets wrong" not in plain, plain)
    expect(not (folder / "r/mechanisms.csv").exists(), plain)


def an_effect_of_one_group_is_named_and_placed():
    folder, tunica = laboratory("offset", offset=OFFSET)
    said = tunica("cohort", "cohort.json", "-o", "r", "--diagnose", "--no-reports", "--quiet")
    found = verdict_of(folder, "r")
    expect("force_offset" in found["ambiguity_set"], said)
    best = found["explanations"][0]
    expect(best["mechanisms"] == ["force_offset"], said)
    factor = found["factors"][0]
    expect(factor["factor"] == "treatment" and factor["only_in"] == "treated", said)
    mean = found["amplitudes"][0]
    expect(mean["low"] < OFFSET < mean["high"], mean)
    gains = found["left_out"]
    expect(len(gains) == 4 and all(one["own"] <= one["foretold"] < one["without"] for one in gains), gains)
    rows = list(csv.DictReader((folder / "r/mechanisms.csv").read_text(encoding="utf-8").splitlines()))
    expect({one["treatment"] for one in rows} == {"control", "treated"}, rows[0])
    of_cause = [one for one in rows if one["mechanism"] == "force_offset"]
    expect(len(of_cause) == 8, of_cause)
    # The extended cohort is one, and its amplitude is the offset of the treated, and none of the others.
    extended = tunica("cohort", "r/extended_cohort.json", "-o", "e", "--no-reports", "--quiet")
    offsets = {"control": [], "treated": []}
    for one in csv.DictReader((folder / "e/parameters.csv").read_text(encoding="utf-8").splitlines()):
        if "force_offset" in one["parameter"]:
            offsets[one["treatment"]].append(float(one["estimate"]))
    expect(offsets["control"] and offsets["treated"], extended)
    mean_of = {group: sum(values) / len(values) for group, values in offsets.items()}
    expect(abs(mean_of["treated"] - OFFSET) < 0.5 and abs(mean_of["control"]) < 0.5, mean_of)


def shards_give_the_same_verdict_as_one_start():
    folder, tunica = laboratory("shards", offset=OFFSET)
    edit(folder / "cohort.json", lambda cohort: cohort.update(diagnosis={"quick": True, "alpha": 0.05}))
    tunica("cohort", "cohort.json", "-o", "whole", "--no-reports", "--quiet")
    for part in ("3/3", "1/3"):
        tunica("cohort", "cohort.json", "-o", "parts", "--shard", part, "--no-reports", "--quiet")
    shard = tunica("cohort", "cohort.json", "-o", "told", "--shard", "1/8", "--diagnose", "--no-reports", "--quiet")
    expect("tunica cohort merge cohort.json -o told --diagnose" in shard, shard)
    # Fits that are there without evidence are not done.
    said = tunica("cohort", "merge", "cohort.json", "-o", "parts", code=2)
    expect("have no result yet" in said, said)
    (folder / "parts/specimens/s0/evidence.json").unlink()
    for part in ("2/3", "1/3"):
        tunica("cohort", "cohort.json", "-o", "parts", "--shard", part, "--no-reports", "--quiet", "--threads", "1")
    tunica("cohort", "merge", "cohort.json", "-o", "parts", "--quiet")
    expect_same(folder / "whole", folder / "parts", "three shards")
    damaged = folder / "parts/specimens/s3/evidence.json"
    text = damaged.read_text(encoding="utf-8")
    damaged.write_text(text[:len(text) // 2], encoding="utf-8")
    said = tunica("cohort", "merge", "cohort.json", "-o", "parts", code=2)
    expect("the first is 's3'" in said, said)
    said = tunica("cohort", "cohort.json", "-o", "parts", "--shard", "1/1", "--no-reports", "--quiet")
    expect("s3/evidence.json: its checksum does not fit" in " ".join(said.split()), said)
    expect(damaged.read_text(encoding="utf-8") == text, "what was made again differs")


def a_specimen_without_diagnosis_harms_no_other():
    folder, tunica = laboratory("missing", offset=OFFSET)
    (folder / "data/s2_c.csv").unlink()
    said = tunica("cohort", "cohort.json", "-o", "r", "--diagnose", "--no-reports", "--quiet")
    found = verdict_of(folder, "r")
    expect([one["specimen"] for one in found["not_diagnosed"]] == ["s2"], said)
    # It is said once, among the specimens that cannot be read.
    expect("s2 was not diagnosed" not in said and "s2_c.csv" in said, said)
    expect(found["factors"][0]["only_in"] == "treated" and len(found["specimens"]) == 7, said)


def a_wrong_key_is_answered():
    folder, tunica = laboratory("wrong")
    edit(folder / "cohort.json", lambda cohort: cohort.update(diagnosis={"quik": True}))
    said = tunica("cohort", "cohort.json", "-o", "r", code=2)
    expect("quik" in said and "quick" in said, said)
    edit(folder / "cohort.json", lambda cohort: cohort.update(diagnosis={"alpha": 2}))
    said = tunica("cohort", "cohort.json", "-o", "r", code=2)
    expect("between 0 and 1" in said, said)


run_cases([a_cohort_in_which_nothing_is_wrong_has_no_verdict_but_that, an_effect_of_one_group_is_named_and_placed,
           shards_give_the_same_verdict_as_one_start, a_specimen_without_diagnosis_harms_no_other,
           a_wrong_key_is_answered])
shutil.rmtree(root, ignore_errors=True)
