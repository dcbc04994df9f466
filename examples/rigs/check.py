#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: all rigs together, and bulge, ring and torsion each alone, find the rubber that generate.py has. A
neo-Hookean rubber cannot follow all of them; its shear modulus from the indentation alone is right."""
import json
import pathlib
import sys

TRUTH = {"c10": 60.0, "c01": 15.0}
runs = json.loads((pathlib.Path(sys.argv[1]) / "result.json").read_text(encoding="utf-8"))["runs"]
together, simple, *alone, pressed = (run["best"] for run in runs)

for best in (together, *alone):
    for name, value in TRUTH.items():
        low, high = best["parameters"][name]["ci95"]
        # Four standard errors: one of these eight lies farther off once in 1400 seeds of the noise.
        assert abs(best["parameters"][name]["value"] - value) < high - low, (name, low, high)
    assert not best["misfit"]["contradicts_noise"], best["misfit"]
low, high = together["parameters"]["c10"]["ci95"]
assert high - low < 1.5, (low, high)
assert simple["misfit"]["contradicts_noise"], simple["misfit"]
mu = pressed["parameters"]["mu"]
assert abs(mu["value"] / (2 * sum(TRUTH.values())) - 1) < 0.02, mu
print(f"rigs: c10 {together['parameters']['c10']['value']:.2f} kPa and c01 {together['parameters']['c01']['value']:.2f} kPa "
      f"of five rigs, made with 60 and 15; the sphere sees a shear modulus of {mu['value']:.1f} kPa, made with 150")
