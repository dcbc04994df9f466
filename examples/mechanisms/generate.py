#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes two strips of a dispersed, viscoelastic wall, measured with a load cell that is off zero: load, hold, unload.
Independent of tunica: explicit midpoint-decay steps fifty times finer than the rows, lateral equilibrium by bisection."""
import math
import pathlib
import random

MU, K1, K2, THETA, KAPPA = 15.0, 25.0, 0.8, math.radians(50), 0.15
G, TAU = 0.4, 4.0
OFFSET = {"circumferential": 1.5, "axial": -0.8}
NOISE, SEED = 0.05, 11


def extra_stress(c, circumferential):
    """S without pressure and its deviator in principal axes (pulled, transverse, normal)."""
    s2 = math.sin(THETA) ** 2
    along = s2 if circumferential else 1 - s2
    slope = [KAPPA + (1 - 3 * KAPPA) * along, KAPPA + (1 - 3 * KAPPA) * (1 - along), KAPPA]
    e = sum(a * b for a, b in zip(slope, c)) - 1
    first = 2 * K1 * e * math.exp(K2 * e * e) if e > 0 else 0.0  # both families
    stress = [MU + 2 * first * a for a in slope]
    mean = sum(s * b for s, b in zip(stress, c)) / 3
    return stress, [s - mean / b for s, b in zip(stress, c)]


def stretch_at(t):
    """1 to 1.5 in 5 s, a hold of 20 s, back to 1.2 in 3 s."""
    return 1 + 0.1 * t if t <= 5 else 1.5 if t <= 25 else 1.5 - 0.1 * (t - 25)


def simulate(circumferential):
    rows = [0.25 * i for i in range(21)] + [5 + 0.5 * i for i in range(1, 41)] + [25 + 0.25 * i for i in range(1, 13)]
    h, old, t, u = [0.0] * 3, [0.0] * 3, 0.0, 1.0
    out = [(0.0, 1.0, 0.0)]
    for row in rows[1:]:
        steps = 50
        dt = (row - t) / steps
        for k in range(1, steps + 1):
            stretch = stretch_at(t + k * dt)
            c1 = stretch * stretch

            def state(trial):
                c = [c1, trial, 1 / (c1 * trial)]
                stress, deviator = extra_stress(c, circumferential)
                over = [math.exp(-dt / TAU) * a + G * math.exp(-dt / (2 * TAU)) * (b - d)
                        for a, b, d in zip(h, deviator, old)]
                total = [s + o for s, o in zip(stress, over)]
                return c[1] * total[1] - c[2] * total[2], c[0] * total[0] - c[2] * total[2], over, deviator

            low, high = 0.2, 2.0
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (low, middle) if state(middle)[0] > 0 else (middle, high)
            u = low
            _, sigma, h, old = state(u)
        t = row
        out.append((t, stretch_at(t), sigma))
    return out


def main():
    here = pathlib.Path(__file__).parent
    noise = random.Random(SEED)
    for name, offset in OFFSET.items():
        with open(here / f"{name}.csv", "w", encoding="utf-8") as out:
            out.write(f"# Synthetic {name} strip: hgo mu=15, k1=25, k2=0.8, theta=50 deg; hidden: dispersion 0.15, viscoelasticity\n")
            out.write(f"# g=0.4, tau=4 s, load cell {offset:+g} kPa; white noise 0.05 kPa (seed {SEED}). Written by generate.py.\n")
            out.write("time [s],stretch [-],stress [kPa]\n")
            for t, stretch, sigma in simulate(name == "circumferential"):
                out.write(f"{t:g},{stretch:.6g},{sigma + offset + noise.gauss(0, NOISE):.6f}\n")


main()
