#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dermis.py TUNICA SOURCES FOLDER: 25 strips of porcine dermis as the rig wrote them (public repository
tajtac/node_damage), untouched. `tunica import` proposes a block for each, `tunica check` accepts them, and curve and fit
are those of a script with numpy to 1e-10."""
import csv
import json
import os
import pathlib
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

np = rig.numpy()
program, sources, out = sys.argv[1:4]
data = pathlib.Path(os.environ.get("TUNICA_DATA_DIR", pathlib.Path(sources).resolve().parent / "shared" / "data"))
data = data / "real" / "dermis"
if not data.is_dir():
    print(f"skipped: no raw files in {data}; TUNICA_DATA_DIR names the folder that has real/dermis")
    sys.exit(77)
folder = rig.fresh_folder(out)
TO = 1e-10
with open(data / "specimens.csv", encoding="utf-8") as stream:
    SPECIMENS = list(csv.DictReader(stream))


def curve(specimen):
    """Last loading to the first stretch: λ = 1 + displacement/size without displacement, P = F/(width·thickness) in kPa.
    The loading of cycle 5 goes from the last row of the valley before its peak to the first row of the peak."""
    with open(data / f"{specimen['Specimen']}.csv", encoding="utf-8") as stream:
        rows = [row for row in csv.DictReader(stream) if row["SetName"] == "Stretch3"]
    cycle = np.array([int(row["Cycle"].split("-")[0]) for row in rows])
    size, way, force = (np.array([float(row[key]) for row in rows]) for key in ("Size_mm", "Displacement_mm", "Force_N"))
    before = np.flatnonzero(cycle == 4)[0] + int(np.argmax(way[cycle == 4]))
    peak = np.flatnonzero(cycle == 5)[0] + int(np.argmax(way[cycle == 5]))
    valley = before + np.flatnonzero(way[before:peak] == way[before:peak].min())[-1]
    used = slice(max(valley, np.flatnonzero(cycle == 5)[0]), peak + 1)
    gauge = round(float(np.median(size - way)), 3)
    area = float(specimen["Width"]) * float(specimen["Thickness"])
    return 1 + way[used] / gauge, 1000 * force[used] / area


def close(a, b):
    a, b = np.asarray(a), np.asarray(b)
    return a.shape == b.shape and np.max(np.abs(a - b) / np.maximum(np.abs(b), 1)) < TO


files = [data / f"{specimen['Specimen']}.csv" for specimen in SPECIMENS]
raw = folder / "raw.json"
printed, _ = rig.tunica(program, "import", *files, "--specimens", data / "specimens.csv", "--model", "yeoh", "-o", raw)
assert "gauge length" in printed and "last loading is taken" in " ".join(printed.split()), printed
printed, _ = rig.tunica(program, "check", raw)
assert "read as one curve" not in " ".join(printed.split()), printed

# The same tests, their data blocks replaced by clean files.
experiment = json.loads(raw.read_text())
experiment["models"]["yeoh"]["parameters"] = {
    "c10": {"min": 0.01, "max": 1e4}, "c20": {"min": -1e5, "max": 1e5}, "c30": {"min": -1e6, "max": 1e6}}
experiment["optimizers"]["lm"]["starts"] = 1
raw.write_text(json.dumps(experiment, indent=1))
curves = {}
for specimen in SPECIMENS:
    name = specimen["Specimen"]
    stretch, stress = curves[name] = curve(specimen)
    (folder / f"{name}.csv").write_text("stretch [-],stress [kPa]\n" + "".join(
        f"{x!r},{y!r}\n" for x, y in zip(stretch.tolist(), stress.tolist())))
    experiment["tests"][name]["data"] = {"file": f"{name}.csv", "columns": {"stretch": "stretch", "stress": "stress"},
                                         "stress_measure": "first_piola_kirchhoff", "order": "loading"}
clean = folder / "clean.json"
clean.write_text(json.dumps(experiment, indent=1))
for file in (raw, clean):
    rig.tunica(program, "run", file, "-o", file.with_suffix(".out"))
best = [json.loads((folder / f"{kind}.out" / "result.json").read_text())["runs"] for kind in ("raw", "clean")]
assert len(best[0]) == 25
for of_raw, of_clean in zip(*best):
    a, b = ({key: entry["value"] for key, entry in run["best"]["parameters"].items()} for run in (of_raw, of_clean))
    assert all(abs(a[key] - b[key]) <= TO * max(1, abs(b[key])) for key in b), (of_raw["tests"], a, b)
for name, (stretch, stress) in curves.items():
    fitted, of_clean = (rig.fitted_curve(folder / f"{kind}.out", name) for kind in ("raw", "clean"))
    assert close(fitted["stretch"], stretch) and close(fitted["stress"], stress), name
    assert close(fitted["stress.predicted"], of_clean["stress.predicted"]), name
print(f"{len(curves)} specimens: curves and fits agree to {TO:g}")
