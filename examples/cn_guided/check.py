#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A guide leads two optimisers to the optimum of the clamped tube with at most 25 simulations each."""
import json
import pathlib
import sys

SET_S = dict(mu=18.668, kappa=0.1367, k1=24.905, k2=0.2912, theta=46.44)
# ceres_lm and cma_es without a guide agree on this objective to four digits, see ../cn_pressurisation.
STABLE_U = 0.0025569

runs = json.loads((pathlib.Path(sys.argv[1]) / "result.json").read_text())["runs"]
assert len(runs) == 4, len(runs)
for run in runs:
    counts = run["full_simulations"]
    assert 0 < counts["count"] <= 25 and counts["guide_evaluations"] > 100, (run["run"], counts)
    assert run["best"]["status"] == "ok" and run["best"]["stable"] is True, run["run"]
for run in runs[:2]:
    for name, truth in SET_S.items():
        found = run["best"]["parameters"][name]["value"]
        assert abs(found / truth - 1) < 0.01, (run["run"], name, found)
for run in runs[2:]:
    assert abs(run["best"]["objective"] / STABLE_U - 1) < 0.001, (run["run"], run["best"]["objective"])
print("; ".join(f"{run['run']}: {run['full_simulations']['count']} simulations, {run['best']['objective']:.4g}" for run in runs))
