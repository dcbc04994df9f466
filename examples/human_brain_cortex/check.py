#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: one power of the stretches near -20 carries tension, compression and shear of brain tissue; nothing in
I1 and I2 alone could. Held out, shear is predicted. The curves are smooth means, so what is left is not noise, and that
is said too."""
import json
import os
import pathlib
import subprocess
import sys

tunica = os.environ["TUNICA"].split(";")
results = pathlib.Path(sys.argv[1])


def run(*words):
    """A call of tunica, and the result.json that it leaves in its last argument."""
    subprocess.run([*tunica, *map(str, words), "--quiet"], check=True)
    return json.loads((words[-1] / "result.json").read_text(encoding="utf-8"))


found = run("discover", results / "input.json", "-o", results / "discovery")["discovery"]
powers = [term["parameters"]["alpha"]["value"] for term in found["terms"] if term["invariant"] == "stretches"]
assert any(-28 < alpha < -15 for alpha in powers), found["terms"]
assert found["reasons"][0]["code"] in ("not_clean", "leads"), found["reasons"]  # what is left is no noise
best = run("run", results / "discovery" / "extended.json", "-o", results / "extended")["runs"][0]["best"]
r2 = {name: test["channels"][0]["r2"] for name, test in best["per_test"].items()}
assert best["stable"] is True and min(r2.values()) > 0.91, r2
print(f"{json.loads((results / 'input.json').read_text(encoding='utf-8'))['name']}: {found['verdict']}, powers "
      f"{', '.join(f'{alpha:.1f}' for alpha in powers)}; R² {', '.join(f'{name} {value:.4f}' for name, value in r2.items())}")
