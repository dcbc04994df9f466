#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""shear_forces.py TUNICA SOURCE FOLDER: forces and displacements of a sheared block of Ogden's material, made in closed
form, give its parameters back."""
import json
import math
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

program, _, scratch = sys.argv[1:]
folder = rig.fresh_folder(scratch)
MU, ALPHA, AREA, HEIGHT = 0.02654, 15.89, 100.0, 8.0  # kPa, 1, mm2, mm: of the size of a blood clot


def stresses(gamma):
    """Principal stretches L, 1/L, 1; the first axis is at the angle t to the plate, tan t = 1/L. Ogden (1972):
    s_i = mu L_i^alpha - p, and the face across is free."""
    stretch = gamma / 2 + math.sqrt(1 + gamma * gamma / 4)
    t = math.atan(1 / stretch)
    first, second, third = MU * stretch**ALPHA, MU * stretch**-ALPHA, MU
    shear = (first - second) * math.sin(t) * math.cos(t)
    return shear, first * math.sin(t)**2 + second * math.cos(t)**2 - third


SHEARS = [0.02 * k for k in range(-24, 25)]
with open(folder / "block.csv", "w", encoding="utf-8") as file:
    file.write("Strain,Way [mm],Fx [N],Fz [N]\n")
    for gamma in SHEARS:
        shear, normal = stresses(gamma)  # kPa mm2 = mN
        file.write(f"{gamma!r},{gamma * HEIGHT!r},{shear * AREA / 1000!r},{normal * AREA / 1000!r}\n")


def fit(name, columns, specimen, code=0):
    data = {"file": "block.csv", "columns": columns, "units": {"Strain": "1"}, "specimen": specimen, "order": "loading"}
    (folder / f"{name}.json").write_text(json.dumps({
        "format": 1, "models": {"ogden": {"type": "ogden", "terms": 1, "parameters": {
            "mu_1": {"initial": 0.05, "min": 0, "max": 10}, "alpha_1": {"initial": 10}}}},
        "tests": {"block": {"type": "simple_shear", "data": data}}, "objective": "least_squares",
        "optimizers": {"lm": {"type": "ceres_lm"}}, "runs": [{"model": "ogden", "optimizer": "lm"}]}), encoding="utf-8")
    output, errors = rig.tunica(program, "check" if code else "run", folder / f"{name}.json",
                                *([] if code else ["-o", folder / name]), code=code)
    return errors if code else rig.best_parameters(folder / name)


forces = {"shear_force": "Fx", "normal_force": "Fz"}
sides = {"width": "12.5 mm", "thickness": "8 mm"}
for name, columns, specimen in [
        ("shear", {"shear": "Strain", **forces}, sides),
        ("area", {"shear": "Strain", **forces}, {"area": "100 mm2"}),
        ("way", {"shear_displacement": "Way", **forces}, {**sides, "height": "8 mm"})]:
    best = fit(name, columns, specimen)
    assert abs(best["mu_1"] / MU - 1) < 1e-6, (name, best)
    assert abs(best["alpha_1"] / ALPHA - 1) < 1e-6, (name, best)

message = fit("no_height", {"shear_displacement": "Way", **forces}, sides, code=2)
assert '"height"' in message, message
message = fit("no_width", {"shear": "Strain", **forces}, {"thickness": "8 mm"}, code=2)
assert '"width"' in message, message
