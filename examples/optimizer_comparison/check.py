#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: the table of eight optimisers on three problems, from ranking.csv. What docs/optimizers.md concludes
from it must hold: what follows oblique valleys succeeds almost always, on every problem, and ISRES and the particle swarm
do not; a global search polished by least squares costs least where derivatives of the whole way are not trusted."""
import csv
import sys

OPTIMIZERS = ["es", "cma_es", "crs2", "isres", "de", "pso", "lm", "es_then_lm"]
PROBLEMS = {"gho_known": "known solution", "gho_aorta": "lamb aorta", "ogden": "Treloar"}

with open(sys.argv[1] + "/ranking.csv", encoding="utf-8") as file:
    rows = {(row["model"], row["optimizer"]): row for row in csv.DictReader(file)}
assert set(rows) == {(p, o) for p in PROBLEMS for o in OPTIMIZERS}, f"unexpected runs: {sorted(rows)}"
print("successes of 20 (expected evaluations for one)".rjust(52))
print("optimizer".ljust(12) + "".join(name.rjust(22) for name in PROBLEMS.values()))
for optimizer in OPTIMIZERS:
    cells = []
    for problem in PROBLEMS:
        row = rows[problem, optimizer]
        expected = row["expected_running_time"]
        cells.append(f"{row['successes']} ({float(expected):.0f})" if int(row["successes"]) else "0")
    print(optimizer.ljust(12) + "".join(cell.rjust(22) for cell in cells))
for problem in PROBLEMS:
    for optimizer in ("es", "cma_es", "lm", "es_then_lm"):
        # 20 of 20, es_then_lm 19 on the known solution, when this was written; the seeds are fixed.
        assert int(rows[problem, optimizer]["successes"]) >= 18, f"{optimizer} on {problem}"
for optimizer in ("isres", "pso"):
    assert int(rows["gho_known", optimizer]["successes"]) == 0, f"{optimizer} now follows the valley: say so in the docs"
