# SPDX-License-Identifier: Apache-2.0
"""Terms of the energy found in the field of the example `plate`, which CalculiX made with a Yeoh rubber.

Two frames and a coarse mesh keep it short. The laws are I1 linear with mu = 2 c10 = 120 kPa and quadratic with
k = 2 c20 = 16 kPa; the estimates lie within four standard errors, a chance of 6e-5 each where mesh and method bring no
bias. The search may take the cheaper method only, and its answer is that of finite elements."""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TRUTH = {"I1_linear": ("mu", 120), "I1_quadratic": ("k", 16)}

tunica, source = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
with tempfile.TemporaryDirectory() as folder:
    plate = Path(folder) / "plate"
    shutil.copytree(source / "examples/plate", plate)
    for frame in (plate / "dic").iterdir():
        if int(frame.stem.split("_")[-1]) not in (3, 5):
            frame.unlink()
    loads = (plate / "load.csv").read_text(encoding="utf-8").splitlines()
    (plate / "load.csv").write_text("\n".join([loads[1], loads[4], loads[6]]) + "\n", encoding="utf-8")
    text = (plate / "experiment.json").read_text(encoding="utf-8").replace('"0.8 mm"', '"1 mm"').replace(
        '"objective": "least_squares",',
        '"objective": "least_squares", "discovery": {"model": "neo_hooke", "from_nothing": true, "invariants": ["I1", "I2"],'
        ' "laws": ["linear", "quadratic"]},')
    (plate / "experiment.json").write_text(text, encoding="utf-8")
    subprocess.run([tunica, "discover", "experiment.json", "--quick", "--quiet", "-o", "found"], cwd=plate, check=True)
    found = json.loads((plate / "found/result.json").read_text(encoding="utf-8"))["discovery"]
    extended = json.loads((plate / "found/extended.json").read_text(encoding="utf-8"))

assert found["verdict"] == "discovered", found["verdict"]
assert {term["name"] for term in found["terms"]} == set(TRUTH), found["terms"]
for term in found["terms"]:
    name, value = TRUTH[term["name"]]
    estimate = term["parameters"][name]
    error = (estimate["high"] - estimate["low"]) / 2 / 1.96
    assert abs(estimate["value"] - value) < 4 * error, (term["name"], estimate)
assert any(reason["code"] == "searched_cheaper" for reason in found["reasons"]), found["reasons"]
assert extended["tests"]["plate"].get("method", "finite_elements") == "finite_elements", extended["tests"]["plate"]
