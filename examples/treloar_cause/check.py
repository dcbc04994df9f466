#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: chains of finite length take most of what neo_hooke misses, by far more than any other
mechanism; what is left is more than the noise that is stated. A search for terms of the energy then takes the rest, and
the verdict says so."""
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


document = run("diagnose", results / "input.json", "-o", results / "diagnosis")
found, discovery = document["diagnosis"], document["discovery"]
first = max(found["ranking"], key=lambda one: one["gain"] or 0)
assert first["id"] == "chain_extensibility", first["id"]
before = found["base"]["squares"]
after = before - first["gain"]
assert after < 0.2 * before, (before, after)
# What is left is real (ogden with three terms reaches 81 where gent stays at 710): a name for all of it would be false.
assert found["verdict"] == "discovered" and not found["causes"], found["verdict"]
assert after > 5 * found["base"]["rows"], after
assert discovery["chi2_after"] <= 100 and discovery["p_after"] > 0.01, discovery["chi2_after"]
assert {term["invariant"] for term in discovery["terms"]} >= {"I1", "I2"}, discovery["terms"]
print(f"treloar: {first['id']}, |r|² {before:.0f} -> {after:.0f}; "
      f"terms in {' and '.join(term['invariant'] for term in discovery['terms'])} -> {discovery['chi2_after']:.0f}")
