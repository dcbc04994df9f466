#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_data.py: writes the data of these examples anew, from closed forms and bisection, without tunica. Each file has
Gaussian noise with the seed and the standard deviation that its comment states."""
import math
import pathlib
import random

here = pathlib.Path(__file__).resolve().parent


def write(file, about, columns, rows, seed, noise):
    """Noise: standard deviation of each column, 0 for what is prescribed."""
    draw = random.Random(seed)
    told = ", ".join(f"{sd} {name.split('[')[1][:-1]} in {name.split(' [')[0]}" for name, sd in zip(columns, noise) if sd)
    with open(here / file, "w", encoding="utf-8") as out:
        out.write(f"# Synthetic: {about}. Noise of standard deviation {told}, seed {seed}.\n")
        out.write(",".join(columns) + "\n")
        for row in rows:
            out.write(",".join(f"{value + (draw.gauss(0, sd) if sd else 0):.6g}" for value, sd in zip(row, noise)) + "\n")


def steps(first, last, count):
    return [first + (last - first) * k / (count - 1) for k in range(count)]


def strip(law, stretch):
    """First Piola-Kirchhoff stress of an incompressible isotropic strip with dW/dI1 = law(I1)."""
    i1 = stretch**2 + 2 / stretch
    return 2 * law(i1) * (stretch - 1 / stretch**2)


def demiray():
    a, b = 12.0, 1.6
    rows = [(s, strip(lambda i1: a / 2 * math.exp(b * (i1 - 3)), s)) for s in steps(1.01, 1.6, 40)]
    write("demiray/strip.csv", f"Demiray's energy, a = {a} kPa, b = {b}", ["stretch [1]", "stress [kPa]"], rows, 1, [0, 0.1])


def fung():
    mu, c, a_t, a_z, a_tz = 15.0, 30.0, 2.0, 1.0, 0.3

    def cauchy(t, z):
        e_t, e_z = (t * t - 1) / 2, (z * z - 1) / 2
        factor = c * math.exp(a_t * e_t**2 + a_z * e_z**2 + 2 * a_tz * e_t * e_z)
        normal = mu / (t * z) ** 2
        return (t * t * (mu + factor * (a_t * e_t + a_tz * e_z)) - normal,
                z * z * (mu + factor * (a_z * e_z + a_tz * e_t)) - normal)

    paths = [(1.0, 1.0), (1.0, 0.5), (0.5, 1.0)]  # strains of both directions, as parts of the largest
    rows = [(1 + 0.4 * t * s, 1 + 0.4 * z * s) for t, z in paths for s in steps(0.05, 1, 20)]
    write("fung_exponential/sheet.csv",
          f"mu = {mu} kPa, c = {c} kPa, a_t = {a_t}, a_z = {a_z}, a_tz = {a_tz}, three ratios of strain",
          ["stretch_circumferential [1]", "stretch_axial [1]", "stress_circumferential [kPa]", "stress_axial [kPa]"],
          [(t, z, *cauchy(t, z)) for t, z in rows], 2, [0, 0, 0.2, 0.2])


def fibre_damage():
    mu, k1, k2, theta, d, psi_c, m = 8.0, 20.0, 0.8, 60.0, 0.6, 0.5, 4.0
    s2 = math.sin(math.radians(theta)) ** 2
    beta, rows = 0.0, []

    def psi(t2, z2):  # both families
        e = max(t2 * s2 + z2 * (1 - s2) - 1, 0)
        return k1 / k2 * (math.exp(k2 * e * e) - 1), 2 * k1 * e * math.exp(k2 * e * e)

    def stresses(t2, z2):  # Cauchy, circumferential and axial, the faces free
        energy, slope = psi(t2, z2)
        left = 1 - d * (1 - math.exp(-max(max(beta, energy) - psi_c, 0) / m))
        normal = mu / (t2 * z2)
        return (t2 * (mu + 2 * left * slope * s2) - normal, z2 * (mu + 2 * left * slope * (1 - s2)) - normal)

    path = steps(1.01, 1.2, 15) + steps(1.19, 1.02, 10) + steps(1.03, 1.4, 20) + steps(1.38, 1.02, 15) + steps(1.04, 1.5, 25)
    for stretch in path:
        low, high = 0.3, 1.5  # the axial stress grows with the axial stretch
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if stresses(stretch**2, middle)[1] < 0 else (low, middle)
        rows.append((stretch, stresses(stretch**2, low)[0]))
        beta = max(beta, psi(stretch**2, low)[0])
    write("fibre_damage/strip.csv",
          f"mu = {mu} kPa, k1 = {k1} kPa, k2 = {k2}, theta = {theta} deg, d = {d}, psi_c = {psi_c} kPa, m = {m} kPa; "
          "a circumferential strip, loaded and unloaded", ["stretch [1]", "stress [kPa]"], rows, 3, [0, 0.2])


def angular_fibres():
    mu, k1, k2, theta, b, count = 10.0, 30.0, 1.2, 50.0, 2.5, 720  # a finer sum than the plugin's

    mean = math.radians(theta)
    turns = [math.pi * k / count for k in range(count)]
    density = [math.exp(b * math.cos(2 * (at - mean))) + math.exp(b * math.cos(2 * (at + mean))) for at in turns]

    def cauchy(t, z):
        along = [mu - mu / (t * z) ** 2 / t**2, mu - mu / (t * z) ** 2 / z**2]
        for at, weight in zip(turns, density):
            s2, c2 = math.sin(at) ** 2, math.cos(at) ** 2
            e = t * t * s2 + z * z * c2 - 1
            if e > 0:
                slope = 2 * weight / sum(density) * k1 * e * math.exp(k2 * e * e)
                along = [along[0] + slope * s2, along[1] + slope * c2]
        return t * t * along[0], z * z * along[1]

    rows = [(1 + 0.3 * t * s, 1 + 0.3 * z * s) for t, z in [(1.0, 1.0), (1.0, 0.4), (0.4, 1.0)] for s in steps(0.05, 1, 20)]
    write("angular_fibres/sheet.csv",
          f"mu = {mu} kPa, k1 = {k1} kPa, k2 = {k2}, theta = {theta} deg, b = {b}, {count} angles, three ratios of strain",
          ["stretch_circumferential [1]", "stretch_axial [1]", "stress_circumferential [kPa]", "stress_axial [kPa]"],
          [(t, z, *cauchy(t, z)) for t, z in rows], 9, [0, 0, 0.2, 0.2])


def bulge():
    mu, radius, thickness = 400.0, 25.0, 1.5
    rows = []
    for height in steps(2, 22, 25):
        phi = 2 * math.atan(height / radius)
        stretch = phi / math.sin(phi)
        sigma = mu * (stretch**2 - stretch**-4)
        rows.append((height, 2 * sigma * thickness / stretch**2 * math.sin(phi) / radius))
    write("bulge/bulge.csv", f"neo-Hookean rubber, mu = {mu} kPa, radius {radius} mm, thickness {thickness} mm",
          ["height [mm]", "pressure [kPa]"], rows, 4, [0, 0.3])
    rows = [(s, strip(lambda i1: mu / 2, s)) for s in steps(1.02, 1.8, 20)]
    write("bulge/strip.csv", f"the same rubber, mu = {mu} kPa", ["stretch [1]", "stress [kPa]"], rows, 5, [0, 3])


def pattern_search():
    mu, jm = 300.0, 20.0
    rows = [(s, strip(lambda i1: mu / 2 * jm / (jm - i1 + 3), s)) for s in steps(1.05, 3.5, 40)]
    write("pattern_search/strip.csv", f"Gent's rubber, mu = {mu} kPa, Jm = {jm}", ["stretch [1]", "stress [kPa]"], rows, 6,
          [0, 2])


def grip_compliance():
    mu, compliance = 350.0, 1.5e-4
    law = lambda i1: mu / 2
    rows = [(s + compliance * strip(law, s), strip(law, s)) for s in steps(1.02, 2.2, 40)]
    write("grip_compliance/strip.csv", f"neo-Hookean rubber, mu = {mu} kPa, stretch of the crosshead, which is too large by "
          f"{compliance}/kPa times the stress", ["stretch [1]", "stress [kPa]"], rows, 7, [0, 1.5])
    rows = [(s, mu * (s - s**-5)) for s in steps(1.02, 1.6, 30)]
    write("grip_compliance/sheet.csv", f"the same rubber, mu = {mu} kPa, stretched equally both ways, stretch of marks on it",
          ["stretch [1]", "stress [kPa]"], rows, 8, [0, 1.5])


for make in (demiray, fung, fibre_damage, angular_fibres, bulge, pattern_search, grip_compliance):
    make()
