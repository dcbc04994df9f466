#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: every run must have found the parameters that the data were made from, to 0.1 %."""
import json
import sys

TRUTH = {"mu": 10.4, "kappa": 0.27, "k1": 30.6, "k2": 3.94, "theta": 61.3}

result = json.load(open(sys.argv[1] + "/result.json", encoding="utf-8"))
assert len(result["runs"]) == 2, "expected two runs"
for run in result["runs"]:
    for name, value in TRUTH.items():
        found = run["best"]["parameters"][name]["value"]
        assert abs(found / value - 1) <= 1e-3, f"{run['optimizer']}: {name} = {found}, the data were made with {value}"
print("known solution found by", ", ".join(run["optimizer"] for run in result["runs"]))
