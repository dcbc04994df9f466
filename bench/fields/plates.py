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


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("source", type=Path, help="a folder with nodes.csv, elements.csv, displacements.csv, forces.csv")
    arguments.add_argument("out", type=Path)
    arguments.add_argument("--noise", default="1e-4 mm")
    given = arguments.parse_args()
    convert(given.source, given.out)
    neo_hooke = {"type": "neo_hooke", "mechanisms": [{"type": "compressibility", "invariants": "isochoric", "law": "quadratic"}]}
    (given.out / "experiment.json").write_text(json.dumps(experiment(given.noise, neo_hooke), indent=1))
