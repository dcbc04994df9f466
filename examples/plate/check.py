#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: Yeoh's energy finds the parameters that generate.py gave to CalculiX, to 1 % at the stated noise.
Neo-Hooke's misses the field. The card of the fit holds what was found."""
import json
import os
import pathlib
import subprocess
import sys

results = pathlib.Path(sys.argv[1])
tunica = os.environ["TUNICA"].split(";")
TRUTH = {"c10": 60.0, "c20": 8.0}

runs = {run["model"]: run["best"] for run in json.loads((results / "result.json").read_text(encoding="utf-8"))["runs"]}
best = runs["yeoh"]
for name, value in TRUTH.items():
    found = best["parameters"][name]
    assert abs(found["value"] / value - 1) < 0.01, f"{name}: {found}, the data were made with {value}"
assert not best["misfit"]["contradicts_noise"], best["misfit"]
assert runs["neo_hooke"]["misfit"]["contradicts_noise"], runs["neo_hooke"]["misfit"]
card = subprocess.run([*tunica, "export", results, "--run", "yeoh/lm", "--to", "calculix"], check=True,
                      capture_output=True, text=True).stdout
assert "*HYPERELASTIC" in card, card
found = ", ".join(f"{name} {best['parameters'][name]['value']:.2f} kPa" for name in TRUTH)
print(f"plate: {found}")
