#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: hyperfoam finds the parameters that generate.py has, from all three tests and from the strip alone,
at the stated noise. An incompressible model follows the stress of the strip to a few per cent and its lateral stretch
not at all. `tunica diagnose diagnosis.json` says why."""
import json
import os
import pathlib
import subprocess
import sys

here, results = pathlib.Path(__file__).parent, pathlib.Path(sys.argv[1])
tunica = os.environ["TUNICA"].split(";")
TRUTH = {"mu_1": 25.0, "alpha_1": 6.0, "nu": 0.18}

runs = json.loads((results / "result.json").read_text(encoding="utf-8"))["runs"]
foams, rubbers = ([run for run in runs if run["model"] == model] for model in ("hyperfoam", "ogden"))
assert len(foams) == 2 and len(rubbers) == 1, [run["run"] for run in runs]
for run in foams:
    best = run["best"]
    assert not best["misfit"]["contradicts_noise"], f"{run['run']}: {best['misfit']}"
    for name, value in TRUTH.items():
        found = best["parameters"][name]
        low, high = found["ci95"]
        assert low <= value <= high, f"{run['run']}: {name} from {low} to {high}, the data were made with {value}"
        assert high - low < 0.04 * value, f"{run['run']}: {name} from {low} to {high}, which says little"

best = rubbers[0]["best"]
stress, lateral = (one["r2"] for one in best["per_test"]["strip"]["channels"])
assert best["misfit"]["contradicts_noise"] and 0.95 < stress < 0.99 and lateral < 0, (stress, lateral)

folder = results / "diagnosis"
subprocess.run([*tunica, "diagnose", here / "diagnosis.json", "-o", folder, "--quiet"], check=True)
found = json.loads((folder / "result.json").read_text(encoding="utf-8"))["diagnosis"]
lead = found["budget"]["steps"][0]
assert found["verdict"] == "leading" and found["budget"]["lead"]["id"] == lead["id"] == "compressibility", found["reasons"]
assert lead["share"] > 0.9, lead
print(f"foam: parameters found again; without change of volume R² {stress:.3f} and {lateral:.1f}; "
      f"compressibility takes {100 * lead['share']:.0f} % of that misfit")
