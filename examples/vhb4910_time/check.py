#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: three rates by one set, within 3 % of the largest stress; the branches are tenfold apart; and the
moduli that they predict go from the slow slope to that of all branches."""
import csv
import json
import math
import pathlib
import sys

results = pathlib.Path(sys.argv[1])
run = json.loads((results / "result.json").read_text(encoding="utf-8"))["runs"][0]
found = {name: one["value"] for name, one in run["best"]["parameters"].items()}


def column(test, name):
    with open(results / f"fit_{test}.csv", encoding="utf-8") as lines:
        return [float(row[name]) for row in csv.DictReader(lines)]


for rate in ("at_0_01_per_s", "at_0_03_per_s", "at_0_05_per_s"):
    measured, computed = column(rate, "stress [kPa]"), column(rate, "stress.predicted [kPa]")
    rms = math.sqrt(sum((a - b) ** 2 for a, b in zip(measured, computed)) / len(measured))
    print(f"{rate}: {len(measured)} rows, off by {rms:.2f} kPa of {max(measured):.0f}")
    assert rms < 0.03 * max(measured), rate
assert found["slow.tau"] > 5 * found["fast.tau"], found
storage = column("oscillation", "storage_modulus.predicted [kPa]")
loss = column("oscillation", "loss_modulus.predicted [kPa]")
assert storage == sorted(storage) and storage[-1] / storage[0] > 2
peak = column("oscillation", "frequency [Hz]")[loss.index(max(loss))]
assert 0.1 < 2 * math.pi * found["fast.tau"] * peak < 3, (peak, found)
