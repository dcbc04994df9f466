#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what a camera would see of a rubber plate with a hole that does not exist: CalculiX simulates it.

Twenty-node bricks of one layer, nearly incompressible Yeoh rubber, both ends clamped. A quarter is simulated; its nodes in
the middle part of the plate, mirrored, are the points of the camera. Displacements get noise, forces too, and some
points are lost. Nothing of tunica is used."""
import pathlib
import random
import sys
import tempfile

here = pathlib.Path(__file__).parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(here / "../../tests/plane_specimen"))
import ccx_plate

C10, C20, BULK = 60.0, 8.0, 1e6  # kPa
LENGTH, WIDTH, HOLE, THICKNESS = 40.0, 20.0, 4.0, 1.5  # mm
STRETCHES = [1.05, 1.1, 1.2, 1.3, 1.4]  # of the grips
HALF_SEEN, SPACING = 12.0, 0.75  # mm
NOISE, FORCE_NOISE, LOST = 0.004, 0.003, 0.01  # mm, of the force, of the points

noise = random.Random(20260401)
mesh = ccx_plate.Quarter(24, 16, ccx_plate.plate_with_hole(LENGTH, WIDTH, HOLE))
card = f"*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, YEOH\n{C10}, {C20}, 0, {2 / BULK}, {2 / BULK}, {2 / BULK}\n"


def seen_nodes():
    """Nodes of the mid-plane that lie a spacing apart and half a subset from every edge."""
    kept = []
    for number, (x, y, z) in mesh.nodes.items():
        inside = x <= HALF_SEEN + 0.6 and y <= WIDTH / 2 - 0.4 and (x * x + y * y) ** 0.5 >= HOLE + 0.4
        if z == 0 and inside and all((x - a) ** 2 + (y - b) ** 2 >= SPACING**2 for _, a, b in kept):
            kept.append((number, x, y))
    return kept


def main():
    points = seen_nodes()
    with tempfile.TemporaryDirectory() as folder:
        forces, fields = ccx_plate.run(folder, mesh, LENGTH, card, STRETCHES, [number for number, _, _ in points], 0.1)
    (here / "dic").mkdir(exist_ok=True)
    title = "# Simulated by generate.py, no measurement"
    lines = [title, "frame,load [N]"]
    for frame, (force, field) in enumerate(zip(forces, fields), 1):
        lines.append(f"{frame},{force * THICKNESS / 1000 * (1 + noise.gauss(0, FORCE_NOISE)):.5f}")
        rows = [title, "X [mm],Y [mm],U [mm],V [mm],SIGMA"]
        for number, x, y in points:
            u, v, _ = field[number]
            for sx, sy in sorted({(1, 1), (1, -1 if y else 1), (-1 if x else 1, 1), (-1 if x else 1, -1 if y else 1)}):
                if abs(x) > HALF_SEEN:
                    continue
                if noise.random() < LOST:
                    rows.append(f"{sx * x:.4f},{sy * y:.4f},0,0,-1")
                    continue
                rows.append(f"{sx * x:.4f},{sy * y:.4f},{sx * u + noise.gauss(0, NOISE):.5f},"
                            f"{sy * v + noise.gauss(0, NOISE):.5f},{0.01 + 0.004 * noise.random():.4f}")
        (here / f"dic/frame_{frame:02}.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    (here / "load.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
