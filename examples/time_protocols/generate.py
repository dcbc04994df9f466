#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""generate.py: relaxation, creep with recovery, and sweeps of frequency and amplitude of one rubber with two Maxwell
branches, without tunica. Relaxation and the frequency sweep are closed forms; creep is integrated in steps of 1/400 of a
row, finite cycles in steps of 1/2000 of a cycle. Noise: 1 %."""
import cmath
import math
import pathlib
import random

MU, BRANCHES = 20.0, [(0.8, 1.0), (0.5, 30.0)]  # kPa; g, tau in s
NOISE, HERE = 0.01, pathlib.Path(__file__).resolve().parent
noise = random.Random(20261128)


def measured(value):
    return value * (1 + noise.gauss(0, NOISE))


def relaxation(time, stretch=1.4):
    """P = μ (λ − λ⁻²) (1 + Σ g e^{−t/τ}) after a jump to λ."""
    return MU * (stretch - stretch**-2) * (1 + sum(g * math.exp(-time / tau) for g, tau in BRANCHES))


def modulus(frequency):
    """E* = 3 μ (1 + Σ g iωτ/(1 + iωτ)) about rest."""
    w = 2j * math.pi * frequency
    return 3 * MU * (1 + sum(g * w * tau / (1 + w * tau) for g, tau in BRANCHES))


def deviator(stretch):
    """S' of the base along the strip and across it, μ (1 − I1/(3 c))."""
    c1, c3 = stretch**2, 1 / stretch
    first = c1 + 2 * c3
    return MU * (1 - first / (3 * c1)), MU * (1 - first / (3 * c3))


class Creep:
    """Stretch under a nominal stress that is given in time, by steps of the convolution integral."""

    def __init__(self):
        self.stretch, self.h = 1.0, [(0.0, 0.0) for _ in BRANCHES]

    def overstress(self, stretch, dt):
        before, now = deviator(self.stretch), deviator(stretch)
        new = []
        for (g, tau), (h1, h3) in zip(BRANCHES, self.h):
            x = dt / tau
            decay, slope = math.exp(-x), g * (-math.expm1(-x) / x if x > 0 else 1)
            new.append((decay * h1 + slope * (now[0] - before[0]), decay * h3 + slope * (now[1] - before[1])))
        return new

    def nominal(self, stretch, dt):
        h = self.overstress(stretch, dt)
        s1, s3 = sum(one[0] for one in h), sum(one[1] for one in h)
        return MU * (stretch - stretch**-2) + stretch * s1 - s3 / stretch**2

    def step(self, nominal, dt):
        low, high = 0.2, 5.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if self.nominal(middle, dt) > nominal else (middle, high)
        self.h, self.stretch = self.overstress(low, dt), low


def harmonic(amplitude, frequency, cycles=20, parts=2000):
    """The first harmonic of the nominal stress over the last cycle of λ = 1 + a sin ωt, over a."""
    strip, total, dt = Creep(), 0, 1 / frequency / parts
    for k in range(cycles * parts):
        phase = 2 * math.pi * (k + 1) / parts
        stretch = 1 + amplitude * math.sin(phase)
        nominal = strip.nominal(stretch, dt)
        strip.h, strip.stretch = strip.overstress(stretch, dt), stretch
        if k >= (cycles - 1) * parts:
            total += nominal * cmath.exp(-1j * phase)
    return 2j * total / parts / amplitude


def write(name, head, rows):
    lines = [",".join(f"{value:.8g}" for value in row) for row in rows]
    (HERE / name).write_text("\n".join([head, *lines]) + "\n", encoding="utf-8")


times = [0.05 * 1.25**k for k in range(36)]
write("relaxation.csv", "time [s],stress [kPa]", [(t, measured(relaxation(t))) for t in times])
write("oscillation.csv", "frequency [Hz],storage [kPa],loss [kPa]",
      [(f, measured(modulus(f).real), measured(modulus(f).imag)) for f in (10 ** (-3 + k / 6) for k in range(25))])

# Loaded in 0.2 s, held for 100 s, unloaded in 0.2 s, left alone.
rows, creep, now = [], Creep(), 0.0
for start, load in ((0.0, 20.0), (100.0, 0.0)):
    before = 20.0 - load
    for t in [0.2, *(0.2 + x for x in (0.1 * 1.3**k for k in range(26)) if x < 99)]:
        end, parts = start + t, 400
        for k in range(parts):
            at = now + (end - now) * (k + 1) / parts
            part = min(1.0, (at - start) / 0.2)
            creep.step(before + part * (load - before), (end - now) / parts)
        now = end
        rows.append((now, before + min(1.0, t / 0.2) * (load - before), 1 + measured(creep.stretch - 1)))
    if start == 0.0:
        for k in range(400):
            creep.step(20.0, (100.0 - now) / 400)
        now = 100.0
        rows.append((now, 20.0, 1 + measured(creep.stretch - 1)))
write("creep.csv", "time [s],nominal_stress [kPa],stretch [1]", rows)

write("amplitude.csv", "strain [1],frequency [Hz],storage [kPa],loss [kPa]",
      [(a, f, measured(modulus.real), measured(modulus.imag)) for f in (0.02, 0.2) for a in (0.02, 0.05, 0.1, 0.2, 0.3, 0.4)
       for modulus in [harmonic(a, f, cycles=round(10 + 300 * f))]])
