#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes five tests of a rubber that does not exist, W = c10 (I1 - 3) + c01 (I2 - 3), with seeded noise. Nothing of tunica
is used: closed forms of Rivlin (1948, 1949), Hertz (1882) and Mahutga et al. (2021), and the meridian of an inflated
membrane (Adkins, Rivlin 1952) as an initial-value problem from its pole."""
import math
import pathlib
import random

C10, C01 = 60.0, 15.0  # kPa
NOISE = 0.01  # of each value
BULGE_RADIUS, BULGE_THICKNESS = 12.0, 0.6  # mm
RING_INNER, RING_THICKNESS, RING_WIDTH, PIN = 6.0, 1.2, 5.0, 1.5  # mm
CYLINDER = 4.0  # mm
SPHERE = 3.0  # mm

here = pathlib.Path(__file__).parent
noise = random.Random(20260202)


def write(name, header, rows):
    lines = [f"# Simulated by generate.py, no measurement: c10 = {C10} kPa, c01 = {C01} kPa, with noise of 1 %.", header]
    for prescribed, measured in rows:
        lines.append(",".join([f"{x:.5f}" for x in prescribed] + [f"{y * (1 + noise.gauss(0, NOISE)):.6g}" for y in measured]))
    (here / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def nominal(stretch):
    """Of a strip."""
    return 2 * (stretch - stretch**-2) * (C10 + C01 / stretch)


def tension(along, across):
    """Of a membrane, over its deformed length."""
    return 2 * BULGE_THICKNESS * (along / across - (along * across) ** -3) * (C10 + C01 * across**2)


def stretch_at(force, across, guess):
    """The stretch along, where the tension is `force`."""
    along = guess
    for _ in range(5):
        slope = (tension(along * 1.000001, across) - tension(along, across)) / (along * 1e-6)
        along -= (tension(along, across) - force) / slope
    return along


def meridian(pole, pressure, steps=100):
    """Radius and height of a membrane of this stretch at the pole, by Runge and Kutta."""
    h, first = BULGE_RADIUS / steps, tension(pole, pole)
    y = [pole * h, pressure / (4 * first) * (pole * h) ** 2, pressure / (2 * first) * pole * h, first]

    def slope(R, at):
        r, _, phi, force = at
        across = r / R
        along = stretch_at(force, across, pole)
        other = tension(across, along)
        return [along * math.cos(phi), along * math.sin(phi), along * (pressure - other * math.sin(phi) / r) / force,
                (other - force) * along * math.cos(phi) / r]

    def moved(at, k, by):
        return [a + by * b for a, b in zip(at, k)]

    for i in range(1, steps):
        R = h * i
        if not (y[3] > 0 and y[0] > 0 and y[2] < math.pi):
            return 0.0, 0.0  # it has turned back to the axis
        k1 = slope(R, y)
        k2 = slope(R + h / 2, moved(y, k1, h / 2))
        k3 = slope(R + h / 2, moved(y, k2, h / 2))
        k4 = slope(R + h, moved(y, k3, h))
        y = [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4)]
    return y[0], y[1]


def bulge(pole):
    """(height, pressure): the pressure at which the meridian ends at the clamp."""
    low, high = 0.0, 2 * tension(pole, pole) / BULGE_RADIUS * 2
    for _ in range(26):
        middle = (low + high) / 2
        if meridian(pole, middle)[0] > BULGE_RADIUS:
            low = middle
        else:
            high = middle
    return meridian(pole, low)[1], low


def ring(distance):
    """(force, stretch of the centreline): the wall thins to x = 1/sqrt(stretch) of its thickness around the pins."""
    around = 2 * math.pi * (RING_INNER + RING_THICKNESS / 2)
    stretch = 1.0
    for _ in range(60):
        stretch = (2 * distance + 2 * math.pi * (PIN + RING_THICKNESS / 2 / math.sqrt(stretch))) / around
    return 2 * RING_WIDTH * RING_THICKNESS * nominal(stretch), stretch


def twisted(twist):
    """(torque, axial force) of a solid cylinder at its unloaded length."""
    phi = math.radians(twist)
    return math.pi * CYLINDER**4 * phi * (C10 + C01), -0.5 * math.pi * CYLINDER**4 * phi**2 * (C10 + 2 * C01)


strip = [1 + 0.05 * k for k in range(1, 21)]
write("strip.csv", "stretch,stress [kPa]", [([x], [nominal(x)]) for x in strip])
heights = [(pole, *bulge(pole)) for pole in (1.08 + 0.12 * k for k in range(10))]
write("bulge.csv", "height [mm],pressure [kPa],apex_stretch", [([h], [p, pole]) for pole, h, p in heights])
taut = math.pi * (RING_INNER - PIN)
write("ring.csv", "distance [mm],force [mN],stretch", [([taut + k], list(ring(taut + k))) for k in range(1, 16)])
write("torsion.csv", "twist [deg/mm],torque [mN.mm],force [mN]", [([0.4 * k], list(twisted(0.4 * k))) for k in range(1, 16)])
write("indentation.csv", "depth [mm],force [mN]",
      [([d], [16 / 3 * 2 * (C10 + C01) * math.sqrt(SPHERE * d) * d]) for d in (0.02 * k for k in range(1, 15))])
