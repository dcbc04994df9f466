#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: the diagnosis names fibres that are taken up late (truth: 1.1925), and the extension that it
writes, run as it stands, has the misfit that it promises. The base model had made up for them with soft fibres: k1 = 0.93
kPa instead of 5.89."""
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
assert found["verdict"] == "named", found["verdict"]
cause = found["causes"][0]
assert cause["id"] == "fibre_recruitment", cause["id"]
low, high = cause["amplitude"]["ci95"]
assert low < 1.1925 < high, cause["amplitude"]
assert cause["probability"] > 0.95, cause["probability"]
shift = {one["parameter"]: one for one in cause["parameter_shifts"]}["k1"]
assert shift["without"] < 1.5 < 4 < shift["with"] < 8, shift
extended = run("run", results / "diagnosis" / "extended.json", "-o", results / "extended")
after = extended["runs"][0]["best"]["objective"]
assert abs(after / found["gain"]["after"] - 1) < 1e-4, (after, found["gain"])
print(f"hidden effect: {cause['id']} = {cause['amplitude']['value']:.4f} ({low:.4f} … {high:.4f}), "
      f"|r|² {found['gain']['before']:.1f} -> {after:.1f} when the extension is run")
