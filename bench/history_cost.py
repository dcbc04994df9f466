#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""history_cost.py: what memory costs in a strip of 1000 and of 10 000 rows, beside the same test of its elastic base.
Times are processor times, the least of many calls of residuals with Jacobian, through the host. Needs the Python package on PYTHONPATH.
"""
import json
import math
import pathlib
import tempfile
import time

import tunica

VISCOUS = [{"type": "viscoelasticity"}]
TWO = [*VISCOUS, {"type": "viscoelasticity", "as": "slow", "parameters": {"tau": {"initial": "100 s"}}}]
CASES = [("elastic", []), ("one branch", VISCOUS), ("two branches", TWO),
         ("damage", [{"type": "damage"}]), ("softening", [{"type": "stress_softening"}])]


def path(rows):
    """Cycles of a stretch, and a stress that goes to and fro as far."""
    lines = ["time [s],stretch [1],stress [kPa]"]
    for k in range(rows):
        part = 0.5 - 0.5 * math.cos(2 * math.pi * 5 * k / rows)
        lines.append(f"{100 * k / rows:.9g},{1 + 0.4 * part:.9g},{20 * part:.9g}")
    return "\n".join(lines) + "\n"


def seconds(folder, test, model, mechanisms):
    """Of one call with Jacobian, in a search of all parameters."""
    columns = {"time": "time", "stretch": "stretch", "stress": "stress"}
    data = {"file": "rows.csv", "columns": columns, "order": "loading"}
    noise = {"absolute": "1 kPa" if test == "uniaxial" else 0.01}
    file = folder / "experiment.json"
    file.write_text(json.dumps({
        "format": 1, "models": {"m": {"type": model, "parameters": {"mu": {"initial": "20 kPa"}}, "mechanisms": mechanisms}},
        "tests": {"t": {"type": test, "direction": "axial", "data": {**data, "noise": noise}}},
        "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm"}},
        "runs": [{"model": "m", "optimizer": "lm"}]}))
    problem = tunica.Problem(str(file), "m/lm")
    best, until = math.inf, time.perf_counter() + 1
    while time.perf_counter() < until:
        start = time.process_time()
        problem.evaluate(problem.initial, residuals=True, jacobian=True)
        best = min(best, time.process_time() - start)
    return best


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for test in ["uniaxial", "creep"]:
        for model in ["neo_hooke", "gho"]:
            bare = {}
            for what, mechanisms in CASES:
                times = []
                for rows in (1000, 10000):
                    (folder / "rows.csv").write_text(path(rows))
                    times.append(seconds(folder, test, model, mechanisms))
                bare.setdefault("times", times)
                print(f"{test:9} {model:10} {what:13} 1000 rows {1e3 * times[0]:7.3f} ms, 10 000 rows {1e3 * times[1]:7.3f} ms "
                      f"({times[1] / times[0]:4.1f} times), {times[1] / bare['times'][1]:4.1f} of the elastic base", flush=True)
