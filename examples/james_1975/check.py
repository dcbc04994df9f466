#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: one function of I1 and one power of the stretches, found in three biaxial series, predict the other
series and the uniaxial test; with all series the same two are found. An energy is the place: series that differ in the
stretch that is held are not the same strain."""
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
assert found["verdict"] in ("leading", "indistinguishable"), (found["verdict"], found["reasons"])
assert sorted(term["invariant"] for term in found["terms"]) == ["I1", "stretches"], found["terms"]
alpha = next(term["parameters"]["alpha"]["value"] for term in found["terms"] if term["invariant"] == "stretches")
assert 1.2 < alpha < 1.6, alpha
best = run("run", results / "discovery" / "extended.json", "-o", results / "extended")["runs"][0]["best"]
predicted, fitted = {}, {}
for name, test in best["per_test"].items():
    for channel in test["channels"]:
        (predicted if channel["held_out"] else fitted)[f"{name} {channel['channel']}"] = channel["r2"]
assert best["stable"] is True and min(fitted.values()) > 0.9, fitted
if predicted:
    assert len(predicted) == 8, predicted
    assert min(predicted.values()) > 0.85 and predicted["uniaxial stress"] > 0.99, predicted
    assert sorted(predicted.values())[1] > 0.93, predicted
print(f"james 1975: {found['verdict']}, {', '.join(t['invariant'] + ' ' + t['law'] for t in found['terms'])}, alpha "
      f"{alpha:.3f}; R² fitted from {min(fitted.values()):.3f}, predicted from {min(predicted.values(), default=float('nan')):.3f}")
