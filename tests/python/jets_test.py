# SPDX-License-Identifier: Apache-2.0
"""Automatic differentiation against central differences, at random points: seed 7, 40 points a function."""
import unittest

import numpy

from tunica.jets import DERIVATIVES, Jet, variables

FUNCTIONS = {
    "sum": lambda x, y: 2 + x - 3 * y + y,
    "product": lambda x, y: x * y * x,
    "quotient": lambda x, y: (x + 1) / (y * y) + 2 / x,
    "power": lambda x, y: x**3 + y**2.5 + x**-1 + (x * y)**0.5,
    "power of a jet": lambda x, y: x**y + 2.5**y,
    "negative": lambda x, y: -x + +y - abs(y - 1),
    "where": lambda x, y: numpy.where(x > y, x * x, y**3),
    "maximum": lambda x, y: numpy.maximum(x - y, 0.0)**2 + numpy.maximum(1.0, y) + numpy.maximum(x, y)**2,
    "numpy on the left": lambda x, y: numpy.float64(2) * x + numpy.float64(1) / y + numpy.float64(2)**x,
    "energy": lambda x, y: 3 / (2 * y) * (numpy.exp(y * (x - 1)**2) - 1),
}
FUNCTIONS.update({known.__name__: lambda x, y, known=known: known(x * y / 3) for known in DERIVATIVES})


class Jets(unittest.TestCase):
    def setUp(self):
        self.points = numpy.random.default_rng(7).uniform(0.5, 2.0, (2, 40))

    def numbers(self, function, points):
        return numpy.broadcast_to(function(*points), points.shape[1:])

    def test_every_function_has_its_derivatives(self):
        h = 1e-5
        for name, function in FUNCTIONS.items():
            with self.subTest(name):
                jet = function(*variables(self.points, 0, 2, 2))
                numpy.testing.assert_array_equal(jet.value, self.numbers(function, self.points))
                for j in range(2):
                    step = numpy.zeros((2, 1))
                    step[j] = h
                    ahead, behind = self.points + step, self.points - step
                    slope = (self.numbers(function, ahead) - self.numbers(function, behind)) / (2 * h)
                    numpy.testing.assert_allclose(jet.first[j], slope, rtol=1e-7, atol=1e-7)
                    first = [function(*variables(points, 0, 2, 0)).first for points in (ahead, behind)]
                    numpy.testing.assert_allclose(jet.second[:, j], (first[0] - first[1]) / (2 * h), rtol=1e-6, atol=1e-6)

    def test_powers_at_rest_are_finite(self):
        x, n = variables(numpy.array([[0.0, 0.0], [2.0, 3.0]]), 0, 2, 2)
        for jet in (x**2, x**3, x**n):
            for values in (jet.value, jet.first, jet.second):
                self.assertTrue(numpy.isfinite(values).all())

    def test_one_value_stands_for_all_points(self):
        x = variables(self.points[:1], 0, 2, 1)[0]
        p = variables(numpy.array([[1.5]]), 1, 2, 1)[0]
        for jet in (x * p, p * x, x + p, x / p, p / x, x**p, numpy.exp(p) * x):
            self.assertEqual(((40,), (2, 40), (1, 2, 40)), (jet.value.shape, jet.first.shape, jet.second.shape))
        self.assertTrue(p > 1)

    def test_a_function_without_derivative_is_named(self):
        x = variables(self.points, 0, 2, 2)[0]
        with self.assertRaisesRegex(TypeError, "numpy.floor has no derivative here"):
            numpy.floor(x)
        self.assertIsInstance(numpy.sqrt(x), Jet)


if __name__ == "__main__":
    unittest.main()
