#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: S found again from its strips and stable; U found again and flagged with its first unstable stretch;
with the constraint every optimiser ends feasible and stable. `tunica stability` judges the four sets of the paper."""
import json
import os
import pathlib
import subprocess
import sys

SETS = {"S": {"mu": 18.668, "kappa": 0.1367, "k1": 24.905, "k2": 0.2912, "theta": 46.44},
        "U": {"mu": 10.015, "kappa": 5.1799e-3, "k1": 20.315, "k2": 0.17086, "theta": 45.83}}

result = json.load(open(sys.argv[1] + "/result.json", encoding="utf-8"))
for run in result["runs"]:
    best, of = run["best"], "S" if run["tests"][0].startswith("s_") else "U"
    stability = best["stability"]
    circumferential = stability["transverse"][0]
    if stability["imposed"] is None:
        for name, value in SETS[of].items():
            found = best["parameters"][name]["value"]
            assert abs(found / value - 1) <= 1e-4, f"{run['run']}: {name} = {found}, the data were made with {value}"
        assert best["stable"] is (of == "S"), f"{run['run']}: stable is {best['stable']}"
        if of == "U":
            assert abs(circumferential["first_unstable"] - 1.166) < 1e-3, circumferential
    else:
        assert best["status"] == "ok" and best["stable"] is True, f"{run['run']}: {best['status']} {best['reason']}"
constrained = [run for run in result["runs"] if run["best"]["stability"]["imposed"] == "h = 0.7"]
assert len(constrained) == 11

experiment = pathlib.Path(__file__).parent / "experiment.json"
tunica = os.environ["TUNICA"].split(";")
for model, stable in (("set_s", True), ("set_u", False), ("x1", True), ("x2", False)):
    said = subprocess.run([*tunica, "stability", experiment, "--model", model, "--json"], check=True, text=True,
                          capture_output=True).stdout
    assert json.loads(said)["stable"] is stable, f"{model}: {said}"
print(f"S stable, U unstable from 1.166; {len(constrained)} optimisers feasible at h = 0.7")
