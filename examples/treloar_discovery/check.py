#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: the terms that are found explain Treloar's three tests better than the six parameters of ogden
(|r|² 81) and than a network fitted to the same figures (R² 0.9986, 0.9826, 0.9960: Linka, Kuhl 2023). The
equibiaxial test held out is predicted from the other two; they reach 6 % of its I2 - 3."""
import json
import os
import pathlib
import subprocess
import sys

tunica = os.environ["TUNICA"].split(";")
results = pathlib.Path(sys.argv[1])


def run(*words):
    """A call of tunica, and the result.json that it leaves in its last argument."""
    subprocess.run([*tunica, *map(str, words), "--quiet"], check=True)
    return json.loads((words[-1] / "result.json").read_text(encoding="utf-8"))


asked = json.loads((results / "input.json").read_text(encoding="utf-8"))
held_out = [name for name, test in asked["tests"].items() if test.get("hold_out")]
found = run("discover", results / "input.json", "-o", results / "discovery")["discovery"]
best = run("run", results / "discovery" / "extended.json", "-o", results / "extended")["runs"][0]["best"]
r2 = {name: test["channels"][0]["r2"] for name, test in best["per_test"].items()}
terms = [(term["invariant"], term["law"]) for term in found["terms"]]
parameters = sum(len(term["parameters"]) for term in found["terms"])

assert found["verdict"] in ("discovered", "indistinguishable"), found["verdict"]
assert found["p_after"] > 0.01, f"what {terms} leave is not noise: p = {found['p_after']}"
assert best["stable"] is True, best["stability"]
assert "I1" in [invariant for invariant, _ in terms], terms
if held_out:
    assert r2["uniaxial"] > 0.998 and r2["pure_shear"] > 0.998, r2
    assert r2["equibiaxial"] > 0.94, f"equibiaxial predicted with R² {r2['equibiaxial']:.4f}"
else:
    assert found["chi2_after"] < 50, found["chi2_after"]
    assert parameters <= 6, f"{parameters} parameters: {terms}"
    assert r2["uniaxial"] > 0.9986 and r2["equibiaxial"] > 0.9826 and r2["pure_shear"] > 0.9960, r2
    before = found["chi2_before"]
    assert before is None or found["chi2_after"] < 0.05 * before, (before, found["chi2_after"])
print(f"treloar: {found['verdict']}, {' + '.join(' '.join(term) for term in terms)}, {parameters} parameters, |r|² "
      f"{found['chi2_after']:.1f}; R² {', '.join(f'{name} {value:.4f}' for name, value in r2.items())}; held out: {held_out}")
