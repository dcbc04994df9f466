#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: where nothing is wrong nothing is discovered, and steps in a mean curve are no term of an energy."""
import json
import os
import pathlib
import subprocess
import sys

tunica = os.environ["TUNICA"].split(";")
results = pathlib.Path(sys.argv[1])
folder = results / "discovery"
subprocess.run([*tunica, "discover", results / "input.json", "-o", folder, "--quiet"], check=True)
found = json.loads((folder / "result.json").read_text(encoding="utf-8"))["discovery"]
if found["model"] == "hgo":  # experiment_short.json
    assert found["verdict"] == "nothing_detected" and not found["terms"], (found["verdict"], found["terms"])
else:
    assert found["verdict"] == "unknown", found["verdict"]
    assert "not_clean" in [reason["code"] for reason in found["reasons"]], found["reasons"]
print(f"lamb aorta, {found['model']}: {found['verdict']}, {found['reasons'][0]['text']}")
