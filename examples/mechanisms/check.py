#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: the hidden effects are recovered by name. Tolerances are about four standard errors of the noise
(0.05 kPa, 2 × 73 rows) plus the rows' own time discretisation."""
import json
import sys

TRUTH = {"mu": (15, 0.6), "k1": (25, 1.5), "k2": (0.8, 0.05), "theta": (50, 0.7),
         "fibre_dispersion.kappa": (0.15, 0.01), "viscoelasticity.g": (0.4, 0.01), "viscoelasticity.tau": (4, 0.15),
         "circumferential_strip.force_offset.value": (1.5, 0.1), "axial_strip.force_offset.value": (-0.8, 0.1)}

result = json.load(open(sys.argv[1] + "/result.json", encoding="utf-8"))
found = {name: entry["value"] for name, entry in result["runs"][0]["best"]["parameters"].items()}
assert set(found) == set(TRUTH), f"parameters {sorted(found)}, expected {sorted(TRUTH)}"
for name, (value, tolerance) in TRUTH.items():
    assert abs(found[name] - value) <= tolerance, f"{name} = {found[name]}, hidden was {value}"
print("three mechanisms recovered:", ", ".join(f"{name} {found[name]:.4g}" for name in TRUTH))
