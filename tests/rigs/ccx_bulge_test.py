#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ccx_bulge_test.py TUNICA: a clamped rubber disc that CalculiX inflates as an axisymmetric solid. Ends with 77 where
there is no ccx."""
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

tunica = str(pathlib.Path(sys.argv[1]).resolve())
RADIUS, THICKNESS, MU, BULK = 10.0, 0.1, 100.0, 1e5
ELEMENTS = 150
PRESSURES = [0.2, 0.6, 1.0, 1.3]


def disc():
    """Quadratic axisymmetric elements in one layer, graded towards the clamp; nodes of all edges."""
    edges = [RADIUS * (1 - (1 - k / ELEMENTS) ** 2) for k in range(ELEMENTS + 1)]
    along = [x for a, b in zip(edges, edges[1:]) for x in (a, (a + b) / 2)] + [RADIUS]
    nodes, number = [], {}
    for i, r in enumerate(along):
        for j in range(3):
            if i % 2 == 0 or j != 1:
                number[i, j] = len(nodes) + 1
                nodes.append((r, (j - 1) * THICKNESS / 2))
    elements = []
    for e in range(ELEMENTS):
        i = 2 * e
        corners = [(i, 0), (i + 2, 0), (i + 2, 2), (i, 2), (i + 1, 0), (i + 2, 1), (i + 1, 2), (i, 1)]
        elements.append([number[c] for c in corners])
    clamp = [number[2 * ELEMENTS, j] for j in range(3)]
    axis = [number[0, j] for j in range(3)]
    return nodes, elements, axis, clamp


def solve(folder):
    nodes, elements, axis, clamp = disc()
    lines = ["*NODE, NSET=ALL"] + [f"{k + 1}, {r:.12g}, {z:.12g}, 0" for k, (r, z) in enumerate(nodes)]
    lines += ["*ELEMENT, TYPE=CAX8R, ELSET=DISC"] + [f"{k + 1}, " + ", ".join(map(str, e)) for k, e in enumerate(elements)]
    lines += ["*NSET, NSET=AXIS", ", ".join(map(str, axis)), "*NSET, NSET=CLAMP", ", ".join(map(str, clamp)),
              "*MATERIAL, NAME=RUBBER", "*HYPERELASTIC, NEO HOOKE", f"{MU / 2}, {2 / BULK}",
              "*SOLID SECTION, ELSET=DISC, MATERIAL=RUBBER",
              "*BOUNDARY", "AXIS, 1, 1", "CLAMP, 1, 2"]
    for pressure in PRESSURES:
        lines += ["*STEP, NLGEOM, INC=1000", "*STATIC", "0.05, 1, 1e-6, 0.25", "*DLOAD", f"DISC, P1, {pressure}",
                  "*NODE PRINT, NSET=AXIS, FREQUENCY=1000", "U", "*END STEP"]
    pathlib.Path(folder, "disc.inp").write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = subprocess.run(["ccx", "-i", "disc"], cwd=folder, capture_output=True, text=True, check=False)
    text = pathlib.Path(folder, "disc.dat").read_text(encoding="utf-8")
    heights = []
    for block in re.split(r"displacements", text)[1:]:
        rows = [line.split() for line in block.splitlines() if re.match(r"\s+\d+\s", line)]
        heights.append(sum(float(row[2]) for row in rows) / len(rows))
    if len(heights) != len(PRESSURES):
        raise RuntimeError(done.stdout[-2000:])
    return heights


class Disc(unittest.TestCase):
    def test_a_thin_disc_is_a_membrane(self):
        with tempfile.TemporaryDirectory() as scratch:
            heights = solve(scratch)
            folder = pathlib.Path(scratch)
            (folder / "rows.csv").write_text("height [mm],pressure [kPa]\n" + "".join(f"{h},0\n" for h in heights),
                                             encoding="utf-8")
            test = {"type": "bulge", "radius": f"{RADIUS} mm", "thickness": f"{THICKNESS} mm",
                    "data": {"file": "rows.csv", "columns": {"height": "height", "pressure": "pressure"}}}
            experiment = {"format": 1, "models": {"m": {"type": "neo_hooke", "parameters": {"mu": {"fixed": MU}}}},
                          "tests": {"disc": test}}
            (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
            ended = subprocess.run([tunica, "simulate", "experiment.json", "-o", "out"], cwd=folder,
                                   capture_output=True, text=True, check=False)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            with open(folder / "out/disc.csv", newline="", encoding="utf-8") as file:
                rows = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
        for pressure, row in zip(PRESSURES, rows):
            print(f"height {row[0]:.4f} mm: CalculiX {pressure} kPa, membrane {row[1]:.5f} kPa")
            # The solid bends beside its clamp and is a hundredth of its radius thick.
            self.assertLess(abs(row[1] / pressure - 1), 5e-3)


if not shutil.which("ccx"):
    print("no ccx here (Debian: calculix-ccx)")
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
