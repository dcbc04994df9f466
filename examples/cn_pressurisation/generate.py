#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes strips and tubes of the sets S (stabilised) and U (not stabilised) of Canales et al. 2023 (Mathematics 11:922,
Table 6): a reconstruction of the measurements of group CN, which are not public. TUNICA names the program."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).parent
sys.path.append(str(here.parent))
from gho_strip import write_strips  # noqa: E402

SETS = {"s": (18.668, 0.1367, 24.905, 0.2912, 46.44), "u": (10.015, 5.1799e-3, 20.315, 0.17086, 45.83)}

with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    shutil.copy(here / "generate.json", folder)
    (folder / "rows.csv").write_text("pressure [mmHg],outer_diameter_stretch [-]\n" + "".join(f"{5 * k},{1 + 0.01 * k}\n" for k in range(35)))
    tunica = os.environ.get("TUNICA", "tunica").split(";")
    for name, parameters in SETS.items():
        write_strips(here, f"{name}_", parameters, 49)
        out = folder / name
        subprocess.run([*tunica, "simulate", str(folder / "generate.json"), "--model", name, "-o", str(out)], check=True)
        for test, file, mesh in (("tube", f"{name}_tube.csv", "24 x 50 nine-node"), ("own", f"{name}_tube_25x50.csv", "25 x 50 four-node")):
            if (name, test) == ("u", "own"):
                continue
            lines = [line for line in (out / f"{test}.csv").read_text().splitlines() if not line.startswith("#")]
            mu, kappa, k1, k2, theta = parameters
            (here / file).write_text(
                f"# Reconstructed tube of set {name.upper()}, gho with mu={mu} kPa, kappa={kappa}, k1={k1} kPa, k2={k2}, theta={theta} deg:\n"
                "# inner radius 3.71 mm, thickness 2.06 mm, length 14 mm, clamped, axial stretch 1.2; no noise.\n"
                f"# Written by generate.py with fe_pressurisation, {mesh} elements.\n" + "\n".join(lines) + "\n")
