#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Recovered parameters of two strips and a tube simulated by finite elements, with and without the stability criterion."""
import json
import pathlib
import sys

SETS = {"s": dict(mu=18.668, kappa=0.1367, k1=24.905, k2=0.2912, theta=46.44), "u": dict(mu=10.015, kappa=5.1799e-3, k1=20.315, k2=0.17086, theta=45.83)}
runs = json.loads((pathlib.Path(sys.argv[1]) / "result.json").read_text())["runs"]
assert len(runs) == 5, len(runs)
known, s, es, u, stable = (run["best"] for run in runs)


def worst(best, truth):
    got = {name: p["value"] for name, p in best["parameters"].items()}
    return max(abs(got[name] - value) / abs(value) for name, value in truth.items() if name in got)


# The mesh's own curve, the angle known: exact but for rounding. The tubes of the others come from a finer mesh.
assert worst(known, SETS["s"]) < 1e-4, known
assert runs[0]["evaluations"] <= 20, runs[0]["evaluations"]
for found in (s, es):
    assert worst(found, SETS["s"]) < 0.01, found
    assert found["stable"] is True
assert worst(u, SETS["u"]) < 0.01, u
assert u["stable"] is False
assert stable["status"] == "ok" and stable["stable"] is True, stable["status"]
# Stability has its price on these data: ceres_lm and cma_es agree on it to four digits, see docs/results.md.
assert 0.0025 < stable["objective"] < 0.0026, stable["objective"]
print(f"known angle {worst(known, SETS['s']):.1e}; S {worst(s, SETS['s']):.1e} by lm, {worst(es, SETS['s']):.1e} by es; U {worst(u, SETS['u']):.1e}; with the criterion {stable['objective']:.3g}")
