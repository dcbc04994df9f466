#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dermis.py TUNICA SOURCES FOLDER: 25 strips of porcine dermis as the rig wrote them (public repository
tajtac/node_damage). The stretch–stress curve that tunica fits is that of numpy to 1e-10, and so is the fit."""
import csv
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
MODEL = {"yeoh": {"type": "yeoh", "parameters": {
    "c10": {"min": 0.01, "max": 1e4}, "c20": {"min": -1e5, "max": 1e5}, "c30": {"min": -1e6, "max": 1e6}}}}


def specimens():
    with open(data / "specimens.csv", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def curve(name, width, thickness):
    """Last loading to the first stretch: λ = size/size without displacement, P = F/(width·thickness) in kPa."""
    with open(data / f"{name}.csv", encoding="utf-8") as stream:
        rows = [row for row in csv.DictReader(stream) if row["SetName"] == "Stretch3" and row["Cycle"] == "5-Stretch"]
    size = np.array([float(row["Size_mm"]) for row in rows])
    way = np.array([float(row["Displacement_mm"]) for row in rows])
    gauge = float(f"{np.median(size - way):.3f}")
    force = np.array([float(row["Force_N"]) for row in rows])
    return gauge, 1 + way / gauge, 1000 * force / (width * thickness)


def close(a, b):
    return np.max(np.abs(np.asarray(a) - np.asarray(b)) / np.maximum(np.abs(b), 1)) < TO


for row in specimens():
    name = row["Specimen"]
    gauge, stretch, stress = curve(name, float(row["Width"]), float(row["Thickness"]))
    block = {"file": str(data / f"{name}.csv"), "columns": {"displacement": "Displacement_mm", "force": "Force_N"},
             "units": {"Displacement_mm": "mm", "Force_N": "N"}, "where": {"SetName": "Stretch3", "Cycle": "5-Stretch"},
             "specimen": {"width": f"{row['Width']} mm", "thickness": f"{row['Thickness']} mm",
                          "gauge_length": f"{gauge} mm"},
             "stress_measure": "first_piola_kirchhoff"}
    raw = rig.write_experiment(folder / f"{name}.json", block, models=MODEL)
    rig.tunica(program, "check", raw)
    rig.tunica(program, "run", raw, "-o", folder / f"{name}.raw")
    (folder / f"{name}.csv").write_text("stretch [-],stress [kPa]\n" + "".join(
        f"{x!r},{y!r}\n" for x, y in zip(stretch.tolist(), stress.tolist())))
    clean = rig.write_experiment(folder / f"{name}_clean.json", {
        "file": f"{name}.csv", "columns": {"stretch": "stretch", "stress": "stress"},
        "stress_measure": "first_piola_kirchhoff"}, models=MODEL)
    rig.tunica(program, "run", clean, "-o", folder / f"{name}.clean")
    fitted = rig.fitted_curve(folder / f"{name}.raw")
    assert close(fitted["stretch"], stretch) and close(fitted["stress"], stress), name
    of_clean = rig.fitted_curve(folder / f"{name}.clean")
    assert close(fitted["stress.predicted"], of_clean["stress.predicted"]), name
    a, b = (rig.best_parameters(folder / f"{name}.{kind}") for kind in ("raw", "clean"))
    assert all(abs(a[key] - b[key]) <= TO * max(1, abs(b[key])) for key in b), (name, a, b)
print(f"{len(specimens())} specimens: curves and fits agree to {TO:g}")
