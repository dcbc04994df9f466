#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: loading differs from unloading, so no term of the energy is offered, and the reason is said."""
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
assert found["verdict"] == "unknown", found["verdict"]
assert "not_an_energy" in [reason["code"] for reason in found["reasons"]], found["reasons"]
assert not found["terms"] and not (folder / "extended.json").exists(), found["terms"]
paths = found["path_dependence"]
assert paths["p_value"] < 1e-6 and paths["share"] > 0.5 and "loading and unloading" in paths["where"], paths
# Whatever the terms, an energy takes no more than a fifth: 8777 of 10 835 stay with any single curve.
assert found["chi2_after"] > 8777, found["chi2_after"]
print(f"vhb 4910: {found['reasons'][0]['text']}")
