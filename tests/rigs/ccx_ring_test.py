#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ccx_ring_test.py TUNICA: a rubber ring that a pin pulls straight in CalculiX, by contact without friction. Ends with
77 where there is no ccx.

The length of the test lets the wall on the pins stretch as the legs do. There the pin presses on it with T/(w a), T the
force of a leg, so that the radial stress is half of that on average: the wall needs h/(2 a + h) more tension for the same
stretch. With the share f of the centreline on the pins, the legs are stretched less, and bear up to f h/(2 a + h) less."""
import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

tunica = str(pathlib.Path(sys.argv[1]).resolve())
INNER, WALL, PIN, WIDTH = 6.0, 0.6, 2.0, 5.0  # mm
MU, BULK = 100.0, 1e5  # kPa
SLICE = 0.05  # mm, half of what is simulated of the width; beside the wall it is a membrane
DISTANCES = [16.0, 19.0]  # of the pins, mm
AROUND, ACROSS = 90, 6


def sector(first, inner, outer, angles, across, centre):
    """Nodes and elements of a part of a ring about (0, centre), numbered from `first`; at[i, j, k] has the nodes."""
    at, nodes, elements = {}, [], []
    for k in range(2):
        for j, angle in enumerate(angles):
            for i in range(across + 1):
                r = inner + (outer - inner) * i / across
                at[i, j, k] = first + len(nodes)
                nodes.append((at[i, j, k], r * math.cos(angle), centre + r * math.sin(angle), k * SLICE))
    for j in range(len(angles) - 1):
        for i in range(across):
            elements.append([at[a, b, k] for k in range(2) for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))])
    return at, nodes, elements


def solve(folder):
    """A quarter of the ring with half of a pin above; mN on a pin at every distance."""
    grid = [math.pi / 2 * k / AROUND for k in range(AROUND + 1)]
    ring, nodes, elements = sector(1, INNER, INNER + WALL, grid, ACROSS, 0)
    begin = INNER - PIN
    arc = [math.radians(-30 + 120 * k / 60) for k in range(61)]
    pin, more, solid = sector(len(nodes) + 1, PIN / 2, PIN, arc, 1, begin)
    number = len(elements)
    sets = {"LEG": [n for (_, j, _), n in ring.items() if j == 0], "TOP": [n for (_, j, _), n in ring.items() if j == AROUND],
            "MIDDLE": [n for (_, _, k), n in ring.items() if k == 0], "PIN": list(pin.values())}
    lines = ["*NODE, NSET=ALL"] + [f"{n}, {x:.12g}, {y:.12g}, {z:.12g}" for n, x, y, z in nodes + more]
    for name, first, some in (("RING", 1, elements), ("STEEL", number + 1, solid)):
        lines += [f"*ELEMENT, TYPE=C3D8, ELSET={name}"] + [f"{first + k}, " + ", ".join(map(str, e)) for k, e in enumerate(some)]
    for name, members in sets.items():
        lines += [f"*NSET, NSET={name}"] + [f"{n}," for n in members]
    lines += ["*SURFACE, NAME=INSIDE"] + [f"{j * ACROSS + 1}, S6" for j in range(AROUND)]
    lines += ["*SURFACE, NAME=OUTSIDE"] + [f"{number + 1 + k}, S4" for k in range(len(solid))]
    lines += ["*MATERIAL, NAME=RUBBER", "*HYPERELASTIC, NEO HOOKE", f"{MU / 2}, {2 / BULK}",
              "*MATERIAL, NAME=HARD", "*ELASTIC", "1e6, 0.3",
              "*SOLID SECTION, ELSET=RING, MATERIAL=RUBBER", "*SOLID SECTION, ELSET=STEEL, MATERIAL=HARD",
              "*SURFACE INTERACTION, NAME=SLIP", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", "1e4",
              "*CONTACT PAIR, INTERACTION=SLIP, TYPE=SURFACE TO SURFACE", "INSIDE, OUTSIDE",
              "*BOUNDARY", "LEG, 2, 2", "TOP, 1, 1", "MIDDLE, 3, 3", "PIN, 1, 1", "PIN, 3, 3"]
    for distance in DISTANCES:
        lines += ["*STEP, NLGEOM, INC=1000", "*STATIC", "0.02, 1, 1e-6, 0.05", "*BOUNDARY",
                  f"PIN, 2, 2, {distance / 2 - begin:.12g}", "*NODE PRINT, NSET=LEG, TOTALS=ONLY, FREQUENCY=1000", "RF", "*END STEP"]
    pathlib.Path(folder, "ring.inp").write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = subprocess.run(["ccx", "-i", "ring"], cwd=folder, capture_output=True, text=True, check=False)
    text = pathlib.Path(folder, "ring.dat").read_text(encoding="utf-8")
    found = [float(block.split()[1]) for block in re.findall(r"total force.*?\n\s*\n(.*)\n", text)]
    if len(found) != len(DISTANCES):
        raise RuntimeError(done.stdout[-2000:])
    return [-2 * one * WIDTH / SLICE for one in found]


class Ring(unittest.TestCase):
    def test_a_pin_pulls_it_straight(self):
        with tempfile.TemporaryDirectory() as scratch:
            forces = solve(scratch)
            folder = pathlib.Path(scratch)
            (folder / "rows.csv").write_text("distance [mm],force [mN],stretch\n" + "".join(f"{d},0,1\n" for d in DISTANCES),
                                             encoding="utf-8")
            test = {"type": "ring", "inner_radius": f"{INNER} mm", "thickness": f"{WALL} mm", "width": f"{WIDTH} mm",
                    "pin_radius": f"{PIN} mm", "data": {"file": "rows.csv", "columns": {"pin_distance": "distance", "force": "force", "stretch": "stretch"}}}
            experiment = {"format": 1, "models": {"m": {"type": "neo_hooke", "parameters": {"mu": {"fixed": MU}}}},
                          "tests": {"ring": {**test, "wall": "straightened"}}}
            (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
            ended = subprocess.run([tunica, "simulate", "experiment.json", "-o", "out"], cwd=folder, capture_output=True, text=True,
                                   check=False)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            with open(folder / "out/ring.csv", newline="", encoding="utf-8") as file:
                rows = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
        for force, (distance, ours, stretch) in zip(forces, rows):
            wall = WALL / math.sqrt(stretch)
            on_pins = 2 * math.pi * (PIN + wall / 2)
            most = on_pins / (2 * distance + on_pins) * wall / (2 * PIN + wall)
            print(f"{distance} mm, stretch {stretch:.3f}: CalculiX {force:.2f} mN, {100 * (1 - force / ours):.2f} % below "
                  f"{ours:.2f} mN; at most {100 * most:.2f} %")
            self.assertLess(force, ours)
            self.assertLess(1 - force / ours, most)


if not shutil.which("ccx"):
    print("no ccx here (Debian: calculix-ccx)")
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
