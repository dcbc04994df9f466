#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: what the cohort of porcine dermis must show. The bounds are wide: they hold the findings, not their
digits."""
import json
import pathlib
import sys

results = pathlib.Path(sys.argv[1])
found = json.loads((results / "result.json").read_text(encoding="utf-8"))
specimens = found["cohort"]["specimens"]
assert [one["outcome"] for one in specimens] == ["fitted"] * 25, specimens
kinds = {one["kind"]: one["specimens"] for one in found["warning_details"]}
assert kinds["same_data"] == ["PA_Breast_Dermis7", "PA_Breast_Dermis7_33"], kinds
assert "few_animals" in kinds
population = found["cohort"]["populations"][0]
assert population["converged"] and population["animals"] == 2
stress = {one["factor"]: one for one in population["readings"]["effects"] if one["of"] == "stress at stretch 1.1"}
# Across the fibres, and at the breast, skin is softer.
for factor, level in (("direction", "Perpendicular"), ("location", "Breast")):
    effect = stress[factor]
    assert effect["level"] == level and effect["kind"] == "ratio", effect
    assert 0.3 < effect["value"] < 0.6 and effect["ci95"][1] < 0.9, effect
    assert effect["p_permutation"] < 0.02, effect
for name in ("parameters.csv", "specimens.csv", "population.csv", "shrunken.csv", "band_strip.csv"):
    assert (results / name).stat().st_size > 0, name
print("25 specimens, two effects, one measurement that was entered twice")
