#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: the hidden effects are recovered by name, each within twice its 95 % interval (about four standard
errors; the data and the seed are fixed, so the outcome is the same on every run), and every interval is tight enough
to say something: below 20 % of the hidden value."""
import json
import sys

TRUTH = {"mu": 15, "k1": 25, "k2": 0.8, "theta": 50, "fibre_dispersion.kappa": 0.15, "viscoelasticity.g": 0.4,
         "viscoelasticity.tau": 4, "circumferential_strip.force_offset.value": 1.5, "axial_strip.force_offset.value": -0.8}

result = json.load(open(sys.argv[1] + "/result.json", encoding="utf-8"))
found = result["runs"][0]["best"]["parameters"]
assert set(found) == set(TRUTH), f"parameters {sorted(found)}, expected {sorted(TRUTH)}"
for name, value in TRUTH.items():
    low, high = found[name]["ci95"]
    half = (high - low) / 2
    assert half < 0.2 * abs(value), f"{name}: the interval {low} to {high} says little"
    assert abs(found[name]["value"] - value) <= 2 * half, f"{name} = {found[name]['value']} ± {half}, hidden was {value}"
print("three mechanisms recovered:", ", ".join(f"{name} {found[name]['value']:.4g}" for name in TRUTH))
