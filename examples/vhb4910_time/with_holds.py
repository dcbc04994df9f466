#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""with_holds.py FOLDER: the three rates and four holds of VHB 4910 by one set: Yeoh's energy, five Maxwell branches, and
the area of the holds, which was assumed where they were measured. Writes experiment and results into FOLDER and prints a
table. The holds may not be passed on: TUNICA_DATA_DIR names the folder with real_causes/vhb_relaxation__yeoh.
TUNICA is the program."""
import csv
import json
import math
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
holds = pathlib.Path(os.environ.get("TUNICA_DATA_DIR", "data")) / "real_causes/vhb_relaxation__yeoh"
if not holds.is_dir():
    sys.exit(f"skipped: no {holds}; TUNICA_DATA_DIR names the folder that has real_causes")
folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
tunica = os.environ.get("TUNICA", "tunica").split(";")
NOISE = {"absolute": "0.5 kPa", "relative": "5 %"}
SCALE = 0.4  # to within what the gain of a force may be; `area` finds the rest

one = json.loads("\n".join(line for line in (HERE / "experiment.json").read_text(encoding="utf-8").splitlines()
                           if not line.lstrip().startswith("//")))
tests = {name: test for name, test in one["tests"].items() if name.startswith("at_")}
for test in tests.values():
    test["data"] |= {"file": str(HERE.parent / "vhb4910_cause/load_unload.csv"), "noise": NOISE}
for name in ("hold_1d5", "hold_2d0", "hold_2d5", "hold_3d0"):
    head, *rows = (holds / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    scaled = [",".join([*row.split(",")[:2], repr(SCALE * float(row.split(",")[2]))]) for row in rows]
    (folder / f"{name}.csv").write_text("\n".join([head, *scaled]) + "\n", encoding="utf-8")
    tests[name] = {"type": "uniaxial", "direction": "circumferential",
                   "data": {"file": f"{name}.csv", "rows": "1:", "noise": NOISE,
                            "columns": {"time": "time", "stretch": "stretch", "stress": "stress"},
                            "stress_measure": "first_piola_kirchhoff"},
                   "mechanisms": [{"type": "force_scale_error", "parameters": {"gain": {"share": "area"}}}]}
branches = [{"type": "viscoelasticity", "as": f"branch_{k + 1}",
             "parameters": {"g": {"max": 100}, "tau": {"initial": tau, "min": tau / 3, "max": tau * 3}}}
            for k, tau in enumerate([0.3, 3, 30, 300, 3000])]
one["models"]["yeoh"]["mechanisms"] = branches
one |= {"name": "vhb4910-rates-and-holds", "tests": tests}
del one["$schema"]
(folder / "experiment.json").write_text(json.dumps(one, indent=1), encoding="utf-8")
subprocess.run([*tunica, "run", folder / "experiment.json", "-o", folder / "results", "--quiet"], check=True,
               stdout=subprocess.DEVNULL)

run = json.loads((folder / "results/result.json").read_text(encoding="utf-8"))["runs"][0]
found = {name: one["value"] for name, one in run["best"]["parameters"].items()}
print(", ".join(f"{name} {value:.4g}" for name, value in found.items()))
print(f"gain of the holds over the assumed area: {(1 + found['area']) / SCALE:.3g}")
for test in tests:
    with open(folder / f"results/fit_{test}.csv", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    off = [float(row["stress.predicted [kPa]"]) - float(row["stress [kPa]"]) for row in rows]
    largest = max(float(row["stress [kPa]"]) for row in rows)
    rms = math.sqrt(sum(x * x for x in off) / len(off))
    print(f"| {test} | {len(rows)} | {largest:.1f} | {rms:.2f} | {100 * rms / largest:.1f} % |")
print(f"chi2 {run['best']['objective']:.0f}")
