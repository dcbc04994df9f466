#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bad_input_test.py TUNICA: what is wrong with one specimen is said, with where and what to do, and the rest goes on."""
import json
import pathlib
import re
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cluster"))
from laboratory import Program, expect, make_cohort, run_cases

root = pathlib.Path(tempfile.mkdtemp(prefix="cohort"))


def laboratory(name, specimens=6):
    folder = root / name
    make_cohort(folder, specimens)
    return folder, Program(sys.argv[1], folder)


def fitted(folder, tunica):
    """What it prints, on one line, and the outcomes by specimen."""
    said = tunica("cohort", "cohort.json", "-o", "r", "--no-reports", "--quiet")
    result = json.loads((folder / "r/result.json").read_text(encoding="utf-8"))
    expect(result["cohort"]["populations"][0]["specimens"] >= 2, said)
    return re.sub(r"\s+", " ", said), {one["id"]: one["outcome"] for one in result["cohort"]["specimens"]}, result


def has(said, *parts):
    for part in parts:
        expect(part in said, f"'{part}' is not in\n{said}")


def a_missing_file():
    folder, tunica = laboratory("missing")
    (folder / "data/s2_c.csv").unlink()
    said, outcomes, _ = fitted(folder, tunica)
    has(said, "5 of 6 specimens fitted", "the data file 'data/s2_c.csv' does not exist", "Did you mean 's0_c.csv'?")
    expect([name for name, outcome in outcomes.items() if outcome != "fitted"] == ["s2"], outcomes)


def an_id_that_stands_twice():
    folder, tunica = laboratory("twice")
    with open(folder / "specimens.csv", "a", encoding="utf-8") as table:
        table.write("s3,control\n")
    said, outcomes, _ = fitted(folder, tunica)
    has(said, "the id 's3' stands in lines 5 and 8 of specimens.csv", "Give each specimen an id of its own")
    expect(sorted(name for name, outcome in outcomes.items() if outcome == "fitted") == ["s0", "s1", "s2", "s4", "s5"],
           outcomes)


def a_factor_with_one_level():
    folder, tunica = laboratory("level")
    table = folder / "specimens.csv"
    table.write_text(table.read_text(encoding="utf-8").replace("treated", "control"), encoding="utf-8")
    said, _, result = fitted(folder, tunica)
    has(said, "6 of 6 specimens fitted", "the factor 'treatment' has one level, 'control'")
    expect(not result["cohort"]["populations"][0]["parameters"]["effects"], result)


def two_specimens():
    folder, tunica = laboratory("two", specimens=2)
    said, _, result = fitted(folder, tunica)
    has(said, "2 specimens were fitted: what they have in common is hardly known", "Measure more")
    expect("few_specimens" in [one["kind"] for one in result["warning_details"]], result["warning_details"])


def units_that_differ():
    folder, tunica = laboratory("unit")
    for name, header, factor in (("s1_c", "stress [Pa]", 1000), ("s2_c", "stress [mm]", 1),
                                 ("s3_c", "stress [kPa]", 1000), ("s3_a", "stress [kPa]", 1000)):
        file = folder / f"data/{name}.csv"
        rows = [line.split(",") for line in file.read_text(encoding="utf-8").splitlines()[1:]]
        lines = ["stretch," + header] + [f"{stretch},{factor * float(stress)!r}" for stretch, stress in rows]
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    said, outcomes, result = fitted(folder, tunica)
    # A unit that the header states is converted; one that cannot be is an error; one that is wrong is suspected.
    has(said, "data/s2_c.csv, line 1, column 2 ('stress'): the unit 'mm' cannot be converted to 'kPa'",
        "s3: stress of 'a' reaches", "Is the unit of its column right?", "lies at a bound in 1 of 5 specimens (s3)")
    expect([name for name, outcome in outcomes.items() if outcome != "fitted"] == ["s2"], outcomes)
    far_off = [one["specimens"] for one in result["warning_details"] if one["kind"] == "far_off"]
    expect(far_off and all(one == ["s3"] for one in far_off), far_off)


def a_column_and_a_table_that_are_not_there():
    folder, tunica = laboratory("column")
    cohort = folder / "cohort.json"
    cohort.write_text(cohort.read_text(encoding="utf-8").replace("{id}_c", "{nam}_c"), encoding="utf-8")
    has(tunica("cohort", "cohort.json", "-o", "r", code=2), "has no column 'nam'. Known: id, treatment.", "line 8")
    (folder / "specimens.csv").unlink()
    has(tunica("cohort", "cohort.json", "-o", "r", code=2), "specimens.csv: there is no such file")


run_cases([a_missing_file, an_id_that_stands_twice, a_factor_with_one_level, two_specimens, units_that_differ,
           a_column_and_a_table_that_are_not_there])
shutil.rmtree(root, ignore_errors=True)
