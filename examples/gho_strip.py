# SPDX-License-Identifier: Apache-2.0
"""A strip of gho material with free lateral faces, independent of tunica: plain bisection of the lateral equilibrium, in
double precision. The synthetic data of the examples come from here."""
import math
import pathlib


def strip(parameters, stretch, circumferential):
    """Cauchy stress [kPa] and transverse stretch; parameters = (mu, kappa, k1, k2, theta [deg from the axis])."""
    mu, kappa, k1, k2, theta = parameters
    s2 = math.sin(math.radians(theta)) ** 2
    along = s2 if circumferential else 1 - s2
    c1 = stretch * stretch

    def state(u):
        c3 = 1 / (c1 * u)
        e = kappa * (c1 + u + c3) + (1 - 3 * kappa) * (along * c1 + (1 - along) * u) - 1
        first = 2 * k1 * e * math.exp(k2 * e * e) if e > 0 else 0  # both families
        a1, a2 = kappa + (1 - 3 * kappa) * along, kappa + (1 - 3 * kappa) * (1 - along)
        lateral = u * (mu / 2 + first * a2) - c3 * (mu / 2 + first * kappa)
        return lateral, 2 * (c1 * (mu / 2 + first * a1) - c3 * (mu / 2 + first * kappa))

    low, high = 0.05, 2.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (low, middle) if state(middle)[0] > 0 else (middle, high)
    return state(low)[1], math.sqrt(low)


def write_strips(folder, prefix, parameters, count):
    """<prefix>circumferential.csv and <prefix>axial.csv, stretch 1 … 1 + 0.0125 (count - 1)."""
    mu, kappa, k1, k2, theta = parameters
    for name, circumferential in (("circumferential", True), ("axial", False)):
        with open(pathlib.Path(folder) / f"{prefix}{name}.csv", "w", encoding="utf-8") as out:
            out.write(f"# Synthetic {name} strip, gho with mu={mu} kPa, kappa={kappa}, k1={k1} kPa, k2={k2}, theta={theta} deg.\n")
            out.write("# Written by generate.py (bisection, independent of tunica); no noise.\n")
            out.write("stretch [-],stress [kPa],transverse_stretch [-]\n")
            for i in range(count):
                stretch = 1 + 0.0125 * i
                stress, transverse = strip(parameters, stretch, circumferential)
                out.write(f"{stretch:.6g},{stress if i else 0:.12g},{transverse:.12g}\n")
