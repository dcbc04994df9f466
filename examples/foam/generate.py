#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the three tests of a foam that does not exist: closed forms of one term of hyperfoam, and seeded noise.

W = 2 mu/alpha^2 [l1^alpha + l2^alpha + l3^alpha - 3 + (J^(-alpha beta) - 1)/beta], beta = nu/(1 - 2 nu)
(Storakers, J. Mech. Phys. Solids 34:125, 1986). The Cauchy stress along axis a is 2 mu/(alpha J) (l_a^alpha -
J^(-alpha beta)); it vanishes across a free face. Nothing of tunica is used."""
import pathlib
import random

MU, ALPHA, NU = 25.0, 6.0, 0.18  # kPa
BETA = NU / (1 - 2 * NU)
STRESS_NOISE, STRETCH_NOISE, STEPS = 0.15, 0.001, 30  # kPa, 1, 1

here = pathlib.Path(__file__).parent
noise = random.Random(20260101)


def stress(stretch, volume):
    """Cauchy stress, kPa."""
    return 2 * MU / (ALPHA * volume) * (stretch**ALPHA - volume ** (-ALPHA * BETA))


def write(name, header, row, last, back=False):
    """From 1 to `last` in even steps, and back again where the load is taken off."""
    lines = [f"# Simulated by generate.py, no measurement: mu = {MU} kPa, alpha = {ALPHA}, nu = {NU}, with noise.", header]
    path = [1 + (last - 1) * step / STEPS for step in range(STEPS + 1)]
    for place in path + (path[-2::-1] if back else []):
        lines.append(",".join(f"{value:.5f}" for value in row(place)))
    (here / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def strip(stretch):
    """The lateral stretch is l^(-nu), the nominal stress sigma J/l."""
    lateral = stretch**-NU
    volume = stretch * lateral**2
    nominal = stress(stretch, volume) * volume / stretch
    return stretch, nominal + noise.gauss(0, STRESS_NOISE), lateral + noise.gauss(0, STRETCH_NOISE)


def chamber(stretch):
    """J = l; the section stays, so that nominal and Cauchy stress are the same."""
    return stretch, stress(stretch, stretch) + noise.gauss(0, STRESS_NOISE)


def fluid(volume):
    """All stretches are J^(1/3)."""
    return volume, -stress(volume ** (1 / 3), volume) + noise.gauss(0, STRESS_NOISE)


write("uniaxial.csv", "stretch,stress [kPa],lateral_stretch", strip, 0.4, back=True)
write("confined.csv", "stretch,stress [kPa]", chamber, 0.5)
write("volumetric.csv", "volume_ratio,pressure [kPa]", fluid, 0.7)
