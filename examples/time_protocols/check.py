#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: two relaxation times from each protocol alone and from all, and the same ones."""
import json
import pathlib
import sys

TRUE = {"mu": 20, "fast.g": 0.8, "fast.tau": 1, "slow.g": 0.5, "slow.tau": 30}

runs = json.loads((pathlib.Path(sys.argv[1]) / "result.json").read_text(encoding="utf-8"))["runs"]
width = {}
for name, run in zip(["relaxation", "creep", "oscillation", "all"], runs):
    found = run["best"]["parameters"]
    print(f"{name:11}", ", ".join(f"{key} {found[key]['value']:.4g}" for key in TRUE))
    for key, true in TRUE.items():
        assert abs(found[key]["value"] / true - 1) < 0.15, f"{name}: {key} is {found[key]['value']}, truly {true}"
    low, high = found["slow.tau"]["ci95"]
    width[name] = high - low
assert width["all"] < min(width[name] for name in ("relaxation", "creep", "oscillation")), width
