#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: what the loops of porcine dermis must show. The bounds are wide: they hold the findings, not their
digits."""
import csv
import json
import pathlib
import statistics
import sys

results = pathlib.Path(sys.argv[1])
found = json.loads((results / "result.json").read_text(encoding="utf-8"))
diagnosis = found["diagnosis"]
# No cause of the catalogue explains smooth loops to within their scatter, and the verdict says so.
assert diagnosis["alarm"] and diagnosis["verdict"] == "unknown", diagnosis["sentences"]
assert len(diagnosis["specimens"]) == 25 and not diagnosis["not_diagnosed"], diagnosis["not_diagnosed"]
# What comes closest remembers the past: each for itself is far ahead of every elastic one and every error of the rig.
sums = {row["mechanism"]: sum(row["log_evidence"]) for row in diagnosis["matrix"]}
memory = ["permanent_set", "viscoelasticity", "stress_softening"]
others = [value for name, value in sums.items() if name not in memory]
assert min(sums[name] for name in memory) > 3 * max(others), sums
# Added to the model, viscoelasticity is worth more than a thousand in AIC, and halves the unexplained share at least.
aic = {one["model"]: one["aic"] for one in found["cohort"]["populations"]}
assert aic["ogden"] - aic["viscoelastic"] > 1000, aic
unexplained = {}
with open(results / "specimens.csv", encoding="utf-8") as stream:
    for row in csv.DictReader(stream):
        unexplained.setdefault(row["run"].split("/")[0], []).append(1 - float(row["least_r2"]))
assert statistics.median(unexplained["viscoelastic"]) < 0.5 * statistics.median(unexplained["ogden"]), unexplained
print("25 loops: an elastic model misses the past of the tissue")
