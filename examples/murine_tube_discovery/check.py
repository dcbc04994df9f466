#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: terms beside hgo take the misfit of three inflations and predict each from the other two; what they are
functions of, these inflations do not tell."""
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
assert found["verdict"] == "indistinguishable" and len(found["ambiguity_set"]) > 1, found["verdict"]
assert found["p_after"] > 0.01 and found["chi2_after"] < 0.2 * found["chi2_before"], found["chi2_after"]
fibres = [one for one in found["ambiguity_set"] for term in one.get("terms", []) if term["invariant"] == "fibre"]
assert fibres, "no alternative has fibres"
for block in found["held_out"]:
    if block["block"].startswith("test"):
        assert block["after"] < 0.7 * block["before"], block
subprocess.run([*tunica, "run", folder / "extended.json", "-o", results / "extended", "--quiet"], check=True)
print(f"murine tube: {found['verdict']}, {len(found['ambiguity_set'])} alternatives, |r|² {found['chi2_before']:.0f} -> "
      f"{found['chi2_after']:.1f}")
