#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the two strips of this example from known parameters, independently of tunica: plain bisection of the
lateral equilibrium of the gho, in double precision. Parameters: x1 of Canales et al. 2023 (Mathematics 11:922)."""
import math
import pathlib

MU, KAPPA, K1, K2, THETA = 10.4, 0.27, 30.6, 3.94, math.radians(61.3)


def strip(stretch, circumferential):
    """Cauchy stress [kPa] and transverse stretch of a strip with free lateral faces."""
    s2 = math.sin(THETA) ** 2
    along = s2 if circumferential else 1 - s2
    c1 = stretch * stretch

    def state(u):
        c3 = 1 / (c1 * u)
        e = KAPPA * (c1 + u + c3) + (1 - 3 * KAPPA) * (along * c1 + (1 - along) * u) - 1
        first = 2 * K1 * e * math.exp(K2 * e * e) if e > 0 else 0  # both families
        a1, a2 = KAPPA + (1 - 3 * KAPPA) * along, KAPPA + (1 - 3 * KAPPA) * (1 - along)
        lateral = u * (MU / 2 + first * a2) - c3 * (MU / 2 + first * KAPPA)
        return lateral, 2 * (c1 * (MU / 2 + first * a1) - c3 * (MU / 2 + first * KAPPA))

    low, high = 0.05, 2.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (low, middle) if state(middle)[0] > 0 else (middle, high)
    return state(low)[1], math.sqrt(low)


def main():
    here = pathlib.Path(__file__).parent
    for name, circumferential in (("circumferential", True), ("axial", False)):
        with open(here / f"{name}.csv", "w", encoding="utf-8") as out:
            out.write(f"# Synthetic {name} strip, gho with mu=10.4 kPa, kappa=0.27, k1=30.6 kPa, k2=3.94, theta=61.3 deg.\n")
            out.write("# Written by generate.py (bisection, independent of tunica); no noise.\n")
            out.write("stretch [-],stress [kPa],transverse_stretch [-]\n")
            for i in range(41):
                stretch = 1 + 0.0125 * i
                stress, transverse = strip(stretch, circumferential)
                out.write(f"{stretch:.6g},{stress if i else 0:.12g},{transverse:.12g}\n")


main()
