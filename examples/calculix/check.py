#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: the parameters that made strip.csv and tube.csv are found through CalculiX within 1e-3, with at most
12 Jacobians differenced: three runs each beside the one of every evaluation."""
import json
import pathlib
import sys

run = json.loads((pathlib.Path(sys.argv[1]) / "result.json").read_text())["runs"][0]
truth = {"c10": 170, "c20": -8, "c30": 1.2}
for name, value in truth.items():
    found = run["best"]["parameters"][name]["value"]
    if abs(found / value - 1) > 1e-3:
        sys.exit(f"{name} is {found}, not {value}")
for test, counted in run["efforts"].items():
    differenced = (counted["solver_runs"] - run["evaluations"]) / 3
    if differenced > 12:
        sys.exit(f"{test}: {differenced} Jacobians")
