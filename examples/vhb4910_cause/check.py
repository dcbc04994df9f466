#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: viscoelasticity, not softening, makes the loop; three rates tell them apart by far, and show
that there are two relaxation times."""
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
gain, named = found["gain"], [cause["id"] for cause in found["causes"]]
branches = [cause["amplitude"]["value"] for cause in found["causes"] if cause["id"] == "viscoelasticity"]
assert branches, f"no viscoelasticity among {named}"
assert not [one for one in named if one.endswith("_fibres")], f"fibres in a rubber: {named}"
ranking = {one["id"]: one["gain"] for one in found["ranking"]}
rest = {name: gain["before"] - value for name, value in ranking.items() if value is not None}
assert gain["after"] < 0.1 * gain["before"], gain
if len(found["base"]["parameters"]) and len(found["noise"]) == 1:
    assert found["verdict"] == "named" and len(named) == 1, (found["verdict"], named)
else:
    assert len(branches) == 2, f"{len(branches)} relaxation times at three rates"
    assert gain["after"] < 0.1 * rest["viscoelasticity"], "a second relaxation time takes no more than a tenth"
    assert rest["stress_softening"] > 5 * gain["after"], "several rates do not tell softening from viscoelasticity"
print(f"vhb 4910, {len(found['noise'])} rates: {found['verdict']}, {' + '.join(named)}, g = {branches}, |r|² "
      f"{gain['before']:.0f} -> {gain['after']:.1f}; softening leaves {rest.get('stress_softening', float('nan')):.0f}")
