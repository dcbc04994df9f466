# SPDX-License-Identifier: Apache-2.0
"""Experiment files for the public plates with a hole.

The data are those of EUCLID (Thakolkaran et al., J. Mech. Phys. Solids 169:105076, 2022): a quarter of a plate with a
hole in plane strain, displacements of its nodes and forces on its sides. They are read where they lie and not copied.

Displacements come from a fine mesh, forces from the coarse mesh of linear triangles on which the displacements are
given: with the true parameters, both are reproduced to 3e-4 and to all digits. The coarse mesh is stiffer by 0.2 to
1.4 % as the load grows, so that forces are taken to be known to 1 %.
"""

import argparse
import csv
import json
import subprocess
import time
from pathlib import Path


def read(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def convert(source, out):
    """Writes field.csv and steps.csv; lengths in mm, forces in mN at a thickness of 1 mm and moduli in kPa."""
    out.mkdir(parents=True, exist_ok=True)
    nodes = [(row["x [-]"], row["y [-]"]) for row in read(source / "nodes.csv")]
    with open(out / "field.csv", "w", encoding="utf-8") as file:
        file.write("step,x [mm],y [mm],ux [mm],uy [mm]\n")
        for row in read(source / "displacements.csv"):
            x, y = nodes[int(row["node [-]"]) - 1]
            file.write(f"{row['step [-]']},{x},{y},{row['ux [-]']},{row['uy [-]']}\n")
    with open(out / "steps.csv", "w", encoding="utf-8") as file:
        file.write("step,force_right [mN],force_top [mN]\n")
        for row in read(source / "forces.csv"):
            file.write(f"{row['step [-]']},{row['force_2 [-]']},{row['force_4 [-]']}\n")


def experiment(noise, model, size="0.06 mm"):
    """One fit of a model to the plate; `noise` of the displacements in mm."""
    return {
        "format": 1, "seed": 1,
        "models": {"material": model},
        "tests": {
            "plate": {
                "type": "full_field",
                "thickness": "1 mm",
                "state": "plane_strain",
                "material_angle": "90 deg",
                "shape": {"rectangle": ["1 mm", "1 mm"], "holes": [{"centre": [0, 0], "radius": "0.1 mm"}]},
                "mesh": {"size": size},
                "boundary": {"left": {"x": "fixed"}, "right": {"x": "uniform"}, "bottom": {"y": "fixed"},
                             "top": {"y": "uniform"}},
                "data": [
                    {"file": "field.csv", "columns": {"step": "step", "x": "x", "y": "y", "ux": "ux", "uy": "uy"},
                     "noise": {"absolute": noise}},
                    {"file": "steps.csv",
                     "columns": {"step": "step", "force_right": "force_right", "force_top": "force_top"},
                     "noise": {"relative": 0.01}},
                ],
            }
        },
        "objective": "least_squares",
        "optimizers": {"lm": {"type": "ceres_lm", "starts": 2}},
        "runs": [{"model": "material", "tests": ["plate"], "optimizer": "lm"}],
    }


VOLUME = {"type": "compressibility", "invariants": "isochoric", "law": "quadratic"}
# Plate: model, and what its parameters are in the data.
PLATES = {
    "neohookean": ({"type": "neo_hooke", "mechanisms": [VOLUME]}, {"mu": 1, "compressibility.compliance": 1 / 3}),
    "isihara": ({"type": "composed", "mechanisms": [VOLUME],
                 "terms": [{"name": "first", "invariant": "I1", "law": "linear"},
                           {"name": "second", "invariant": "I2", "law": "linear"},
                           {"name": "square", "invariant": "I1", "law": "quadratic"}]},
                {"first_mu": 1, "second_mu": 2, "square_k": 2, "compressibility.compliance": 1 / 3}),
    "holzapfel": ({"type": "hgo", "fibre_switch": "none", "mechanisms": [VOLUME],
                   "parameters": {"theta": {"min": 5, "max": 85, "initial": 45}}},
                  {"mu": 1, "k1": 0.9, "k2": 0.8, "theta": 30, "compressibility.compliance": 0.5}),
}


def thinned(file, folder, every=7):
    """Every seventh point of each step and a coarser mesh, with an isotropic base."""
    title, *rows = (folder / "field.csv").read_text(encoding="utf-8").splitlines()
    steps = {}
    for row in rows:
        steps.setdefault(row.split(",")[0], []).append(row)
    kept = [row for step in steps.values() for row in step[::every]]
    (folder / "field.csv").write_text("\n".join([title, *kept]) + "\n", encoding="utf-8")
    file["models"]["material"] = {"type": "neo_hooke", "mechanisms": [VOLUME]}
    file["tests"]["plate"]["mesh"]["size"] = "0.12 mm"


def diagnose(tunica, folder, name):
    """Prints what leads where an isotropic base is fitted."""
    subprocess.run([tunica, "diagnose", folder / "experiment.json", "--quick", "-o", folder / "causes", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    found = json.loads((folder / "causes/result.json").read_text(encoding="utf-8"))["diagnosis"]
    print(f"{name:16} {found['verdict']}: {'; '.join(found['reasons'])}", flush=True)


def discover(tunica, folder, name):
    """Prints the terms that are found from nothing, and how long it took."""
    begin = time.monotonic()
    subprocess.run([tunica, "discover", folder / "experiment.json", "--from-nothing", "--quick", "-o", folder / "terms",
                    "--quiet"], check=True, stdout=subprocess.DEVNULL)
    found = json.loads((folder / "terms/result.json").read_text(encoding="utf-8"))["discovery"]
    for term in found.get("terms", []):
        values = ", ".join(f"{parameter} {one['value']:.4g} ({one['low']:.4g} .. {one['high']:.4g})"
                           for parameter, one in term["parameters"].items())
        print(f"{name:16} {term['name']}: {values}", flush=True)
    print(f"{name:16} {found['verdict']} after {time.monotonic() - begin:.0f} s", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("tunica", help="the program")
    arguments.add_argument("data", type=Path, help="the folder with neohookean_low, isihara_low, ...")
    arguments.add_argument("out", type=Path, help="a new folder")
    arguments.add_argument("--only", nargs="*", help="plates such as neohookean_low")
    arguments.add_argument("--discover", action="store_true", help="look for the terms instead, from nothing")
    arguments.add_argument("--diagnose", action="store_true", help="look for what an isotropic base misses instead")
    given = arguments.parse_args()
    for name in given.only or [f"{plate}_{level}" for plate in PLATES for level in ("low", "high")]:
        plate, level = name.split("_")
        model, truth = PLATES[plate]
        folder = given.out / name
        convert(given.data / name, folder)
        file = experiment("1e-4 mm" if level == "low" else "1e-3 mm", model)
        if given.diagnose:
            thinned(file, folder)
        (folder / "experiment.json").write_text(json.dumps(file, indent=1), encoding="utf-8")
        if given.diagnose:
            diagnose(given.tunica, folder, name)
            continue
        if given.discover:
            discover(given.tunica, folder, name)
            continue
        subprocess.run([given.tunica, "run", folder / "experiment.json", "-o", folder / "results", "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
        result = json.loads((folder / "results/result.json").read_text(encoding="utf-8"))
        found = result["runs"][0]["best"]["parameters"]
        for parameter, value in truth.items():
            low, high = found[parameter]["ci95"]
            off = 100 * (found[parameter]["value"] / value - 1)
            print(f"{name:16} {parameter:28} {value:8.4g} {found[parameter]['value']:9.5g} ({low:.5g} .. {high:.5g}) {off:+.2f} %",
                  flush=True)


if __name__ == "__main__":
    main()
