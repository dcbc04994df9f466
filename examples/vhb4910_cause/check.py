#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: viscoelasticity, not softening, makes the loop; three rates tell them apart by far, and show
that one relaxation time is not all of it."""
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


found = run("diagnose", results / "input.json", "-o", results / "diagnosis")["diagnosis"]
first, gain = found["causes"][0], found["gain"]
assert first["id"] == "viscoelasticity", first["id"]
ranking = {one["id"]: one["gain"] for one in found["ranking"]}
rest = {name: gain["before"] - value for name, value in ranking.items() if value is not None}
assert gain["after"] < 0.1 * gain["before"], gain
if len(found["base"]["parameters"]) and len(found["noise"]) == 1:
    assert found["verdict"] == "named", found["verdict"]
else:
    assert rest["stress_softening"] > 5 * gain["after"], "several rates do not tell softening from viscoelasticity"
print(f"vhb 4910, {len(found['noise'])} rates: {found['verdict']}, {first['id']}, g = {first['amplitude']['value']:.2f}, |r|² "
      f"{gain['before']:.0f} -> {gain['after']:.1f}; softening leaves {rest.get('stress_softening', float('nan')):.0f}")
