#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""physics_test.py BENCH: laws, stresses and errors of the rig against closed forms and against tensors."""
import sys
import unittest

import numpy as np
from scipy.optimize import brentq

sys.path.insert(0, sys.argv.pop())
from hidden_terms import complete_laws, laws  # noqa: E402
from hidden_terms.deformation import Part, free_strip, shear_stress, stress  # noqa: E402
from hidden_terms.protocol import Curve, RigError, channel_slices, observe, reach, tissue  # noqa: E402

# ψ as docs/composed.md has it. The eight-chain energy is not here: its slope is held against the Langevin function.
ENERGIES = {
    "linear": lambda x, p: p["mu"] / 2 * x, "quadratic": lambda x, p: p["k"] / 2 * x**2,
    "cubic": lambda x, p: p["k"] / 3 * x**3, "power": lambda x, p: p["k"] / p["m"] * x**p["m"],
    "exponential": lambda x, p: p["mu"] / (2 * p["b"]) * (np.exp(p["b"] * x) - 1),
    "exponential_square": lambda x, p: p["k1"] / (2 * p["k2"]) * (np.exp(p["k2"] * x**2) - 1),
    "gent": lambda x, p: -p["mu"] * p["Jm"] / 2 * np.log(1 - x / p["Jm"]),
    "logarithm": lambda x, p: 1.5 * p["mu"] * np.log(1 + x / 3)}
GHO = [Part("I1", "linear", {"mu": 12.0}),
       Part("diagonal", "exponential_square", {"k1": 20.0, "k2": 1.5, "theta": 40.0, "kappa": 0.15})]
MOONEY = [Part("I1", "linear", {"mu": 300.0}), Part("I2", "linear", {"mu": 60.0})]
EVERYTHING = [*GHO, Part("I2", "gent", {"mu": 5.0, "Jm": 9.0}), Part("axial", "power", {"k": 4.0, "m": 3.3}),
              Part("circumferential", "cubic", {"k": 7.0}), Part("product", "", {"k": 2.0}),
              Part("stretches", "", {"mu": -3.0, "alpha": -1.7})]
STRETCH = np.linspace(1, 1.4, 9)


class Laws(unittest.TestCase):
    def test_a_slope_is_the_derivative_of_its_energy(self):
        x, h = np.linspace(0.1, 2, 20), 1e-5
        for law, energy in ENERGIES.items():
            p = laws.draw(law, 2.5, np.random.default_rng(3))
            central = (energy(x + h, p) - energy(x - h, p)) / (2 * h)
            np.testing.assert_allclose(laws.slope(law, x, p), central, rtol=1e-7, err_msg=law)

    def test_the_inverse_langevin_function_inverts_it(self):
        y = np.array([0, 1e-4, 0.1, 0.5, 0.9, 0.99])
        np.testing.assert_allclose(laws.langevin(laws.inverse_langevin(y)), y, atol=1e-10)

    def test_eight_long_chains_are_neo_hookean(self):
        x = np.linspace(0, 2, 5)
        found = laws.slope("inverse_langevin", x, {"mu": 10.0, "N": 1e5})
        np.testing.assert_allclose(found, 5.0, rtol=1e-4)

    def test_kinks_are_where_they_are_said_to_be(self):
        x = np.array([0.2, 0.5, 0.6, 1.0])
        np.testing.assert_allclose(laws.slope("late", x, {"k": 2.0, "x0": 0.5}), [0, 0, 0.2, 1.0])
        np.testing.assert_allclose(laws.slope("saturating", x, {"k": 2.0, "x0": 0.5}), [0.4, 1, 1, 1])
        np.testing.assert_allclose(laws.slope("two_slopes", x, {"k": 2.0, "x0": 0.5, "ratio": 3.0}), [0.4, 1, 1.6, 4])

    def test_every_draw_holds_over_its_reach(self):
        random = np.random.default_rng(5)
        for law in laws.PARAMETERS:
            for span in (0.3, 8.0):
                slopes = laws.slope(law, np.linspace(0, span, 30), laws.draw(law, span, random))
                self.assertTrue(np.all(np.isfinite(slopes)) and slopes[-1] > 0, law)
                steps = np.diff(slopes)
                self.assertTrue(np.all(steps <= 0) if law == "logarithm" else np.all(steps >= -1e-12), law)


class Stress(unittest.TestCase):
    def test_rubber_against_closed_forms(self):
        l, c10, c01 = np.linspace(1, 3, 7), 150.0, 30.0
        curves = [Curve("u", "uniaxial_nominal", l), Curve("e", "equibiaxial", l), Curve("p", "pure_shear", l),
                  Curve("s", "simple_shear", l - 1)]
        closed = [2 * (l - l**-2) * (c10 + c01 / l), 2 * (l - l**-5) * (c10 + c01 * l**2),
                  2 * (l - l**-3) * (c10 + c01), 2 * (c10 + c01) * (l - 1)]
        np.testing.assert_allclose(observe(curves, MOONEY), np.concatenate(closed), atol=1e-9)

    def test_stress_is_the_derivative_of_the_energy(self):
        around, along, h = 1 + 0.3 * np.linspace(0.1, 1, 6), 1 + 0.2 * np.linspace(0.1, 1, 6), 1e-5

        def energy(log_around, log_along):
            return complete_laws.energy(EVERYTHING, np.exp(log_around), np.exp(log_along))

        a, b = np.log(around), np.log(along)
        found = stress(EVERYTHING, around, along)
        np.testing.assert_allclose(found[0], (energy(a + h, b) - energy(a - h, b)) / (2 * h), rtol=1e-6)
        np.testing.assert_allclose(found[1], (energy(a, b + h) - energy(a, b - h)) / (2 * h), rtol=1e-6)

    def test_shear_against_tensors(self):
        """τ = dW/dγ with the invariants of C = FᵀF as matrices, for x of every kind."""
        nodes, weights = np.polynomial.legendre.leggauss(40)

        def energy(gamma):
            F = np.eye(3)
            F[0, 1] = gamma
            C = F.T @ F
            i1, i2 = np.trace(C), 0.5 * (np.trace(C)**2 - np.trace(C @ C))
            total = 0.0
            for part in EVERYTHING:
                if part.invariant == "product":
                    total += part.values["k"] * (i1 - 3) * (i2 - 3)
                    continue
                if part.invariant == "stretches":
                    roots = np.linalg.eigvalsh(C)
                    total += part.values["mu"] / part.values["alpha"] * (np.sum(roots**(part.values["alpha"] / 2)) - 3)
                    continue
                angles = {"axial": [0.0], "circumferential": [90.0]}.get(part.invariant, [
                    part.values.get("theta", 0.0), -part.values.get("theta", 0.0)])
                kappa = part.values.get("kappa", 0.0)
                for angle in angles:
                    fibre = np.array([np.sin(np.radians(angle)), np.cos(np.radians(angle)), 0])
                    x = {"I1": i1 - 3, "I2": i2 - 3}.get(
                        part.invariant, kappa * i1 + (1 - 3 * kappa) * fibre @ C @ fibre - 1)
                    at = 0.5 * max(x, 0) * (1 + nodes)
                    total += 0.5 * max(x, 0) * weights @ laws.slope(part.law, at, part.values)
                    if part.invariant in ("I1", "I2"):
                        break
            return total

        gamma, h = np.array([0.1, 0.4, 0.9]), 1e-5
        central = [(energy(g + h) - energy(g - h)) / (2 * h) for g in gamma]
        np.testing.assert_allclose(shear_stress(EVERYTHING, gamma), central, rtol=1e-6)

    def test_nothing_pulls_at_the_side_of_a_strip(self):
        for material in (GHO, EVERYTHING):
            for axis in (1, 2):
                l1, l2 = free_strip(material, STRETCH, axis)
                np.testing.assert_allclose((l1, l2)[axis - 1], STRETCH)
                self.assertLess(np.max(np.abs(stress(material, l1, l2)[2 - axis])), 1e-7)

    def test_the_side_is_where_brent_finds_it(self):
        l1, l2 = free_strip(GHO, STRETCH[1:], 1)
        for pulled, side in zip(l1, l2):
            root = brentq(lambda b: stress(GHO, np.array([pulled]), np.array([b]))[1][0], 0.4, 1.2, xtol=1e-13)
            self.assertAlmostEqual(side, root, 9)

    def test_reach_is_the_largest_invariant(self):
        curves = [Curve("u", "uniaxial_nominal", np.array([1.0, 2.0])), Curve("s", "simple_shear", np.array([0.0, 1.0]))]
        self.assertAlmostEqual(reach(curves, MOONEY, Part("I1", "linear", {})), 4 + 1 - 3)
        self.assertAlmostEqual(reach(curves, MOONEY, Part("I2", "linear", {})), 0.25 + 4 - 3)
        sheared = [Curve("s", "simple_shear", np.array([0.0, 0.6]))]
        for family, values, most in (("axial", {}, 0.36), ("circumferential", {}, 0.0),
                                     ("diagonal", {"theta": 45.0}, 0.6 + 0.18)):
            self.assertAlmostEqual(reach(sheared, GHO, Part(family, "quadratic", values)), most)
        sheets = [Curve("b", "sheet", np.array([0.0, 1.0]), most=(0.2, 0.1))]
        self.assertAlmostEqual(reach(sheets, GHO, Part("axial", "quadratic", {})), 1.21 - 1)

    def test_tissue_is_not_pulled_further_than_it_bears(self):
        curves = tissue(GHO, np.random.default_rng(2))
        y = observe(curves, GHO)
        self.assertLess(max(y), 150)
        self.assertGreater(max(y), 60)
        self.assertEqual(len(y), sum(rows.stop - rows.start for rows in channel_slices(curves)))


class Rig(unittest.TestCase):
    curves = [Curve("u", "uniaxial", STRETCH), Curve("b", "sheet", np.linspace(0, 1, 4), most=(0.3, 0.2))]

    def changed(self, *error):
        return observe(self.curves, GHO, RigError(*error)) - observe(self.curves, GHO)

    def test_what_each_error_does(self):
        y = observe(self.curves, GHO)
        np.testing.assert_allclose(self.changed("force_offset", 0, 0, 2.5), [2.5] * 9 + [0] * 8)
        np.testing.assert_allclose(self.changed("force_scale", 1, 1, 0.1), np.r_[np.zeros(13), 0.1 * y[13:]])
        np.testing.assert_allclose(self.changed("thickness", 1, -1, 0.1), np.r_[np.zeros(9), 0.1 * y[9:]])
        np.testing.assert_allclose(self.changed("drift", 0, 0, 4.0)[:9], np.linspace(0, 4, 9))
        np.testing.assert_allclose(self.changed("gain_drift", 0, 0, 0.2)[8], 0.2 * y[8])
        self.assertAlmostEqual(self.changed("gain_drift", 0, 0, 0.2)[0], 0)

    def test_wrong_stretches_are_those_of_another_length(self):
        for error, stretch in (("reference_length", STRETCH * 1.05), ("stretch_offset", STRETCH + 0.05)):
            true = observe([Curve("u", "uniaxial", stretch)], GHO)
            np.testing.assert_allclose(observe(self.curves, GHO, RigError(error, 0, 0, 0.05))[:9], true)
            self.assertEqual(np.max(np.abs(self.changed(error, 0, 0, 0.05)[9:])), 0)


unittest.main()
