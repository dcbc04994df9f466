# SPDX-License-Identifier: Apache-2.0
"""The problem that optimisers and samplers of others see."""
import unittest

import numpy

import tunica
from support import EXAMPLES, TRELOAR, Case, of_treloar

try:
    import scipy.optimize
except ImportError:
    scipy = None


class Problems(Case):
    def test_objective_and_residuals_are_those_of_the_run(self):
        result = tunica.run(of_treloar({"type": "yeoh"}), self.folder / "run", base=TRELOAR)
        problem = tunica.Problem(of_treloar({"type": "yeoh"}), base=TRELOAR)
        x = problem.vector(result.parameters)
        self.assertEqual(result.best.objective, problem.objective(x))
        residuals = problem.residuals(x)
        self.assertAlmostEqual(1, residuals @ residuals / result.best.objective, 12)
        predicted = problem.predict(x)[("uniaxial", "stress")]
        numpy.testing.assert_array_equal(predicted, result.best.fit["uniaxial"]["stress.predicted"])

    def test_derivatives_are_those_of_central_differences(self):
        for coordinates in ("parameters", "unit"):
            problem = tunica.Problem(EXAMPLES / "lamb_aorta" / "experiment.json", coordinates=coordinates)
            x = problem.initial
            jacobian = problem.jacobian(x)
            self.assertTrue(problem.exact)
            for j in range(len(x)):
                step = numpy.zeros(len(x))
                step[j] = 1e-5 * max(abs(x[j]), 1e-2)
                column = (problem.residuals(x + step) - problem.residuals(x - step)) / (2 * step[j])
                numpy.testing.assert_allclose(jacobian[:, j], column, rtol=2e-6, atol=1e-6 * numpy.abs(column).max())
                slope = (problem.objective(x + step) - problem.objective(x - step)) / (2 * step[j])
                self.assertAlmostEqual(1, problem.gradient(x)[j] / slope, 5)

    def test_moduli_of_finite_cycles_are_those_that_a_strip_has_in_time(self):
        folder = EXAMPLES / "time_protocols"
        experiment = tunica.read(folder / "experiment.json").input
        experiment["runs"] = [{"model": "rubber", "optimizer": "lm", "tests": ["amplitudes"]}]
        problem = tunica.Problem(experiment, base=folder)
        truth = problem.vector({"mu": 20, "fast.g": 0.8, "fast.tau": 1, "slow.g": 0.5, "slow.tau": 30})
        # The 24 moduli are those of generate.py, with 1 % noise: chi squared has mean 24 and standard deviation 7.
        self.assertLess(abs(problem.objective(truth) - 24), 21)
        linear = {**experiment, "tests": {"amplitudes": {**experiment["tests"]["amplitudes"]}}}
        data = linear["tests"]["amplitudes"]["data"] = dict(linear["tests"]["amplitudes"]["data"])
        data["columns"] = {name: column for name, column in data["columns"].items() if name != "strain_amplitude"}
        self.assertGreater(tunica.Problem(linear, base=folder).objective(truth), 500)  # moduli of small oscillations

    @unittest.skipUnless(scipy, "python3-scipy is not installed")
    def test_scipy_finds_what_tunica_finds(self):
        for model in ("mooney_rivlin", "yeoh"):
            experiment = of_treloar({"type": model})
            result = tunica.run(experiment, self.folder / model, base=TRELOAR)
            for coordinates in ("parameters", "unit"):
                problem = tunica.Problem(experiment, base=TRELOAR, coordinates=coordinates)
                found = scipy.optimize.least_squares(problem.residuals, problem.initial, problem.jacobian,
                                                     bounds=problem.bounds, x_scale="jac", xtol=1e-14, ftol=1e-14,
                                                     gtol=1e-14, max_nfev=2000)
                self.assertAlmostEqual(1, 2 * found.cost / result.best.objective, 8)
                for name, value in problem.values(found.x).items():
                    self.assertAlmostEqual(1, value / result.parameters[name], 5)

    def test_a_point_that_fails_has_a_reason_and_no_number(self):
        experiment = of_treloar({"type": "gent", "parameters": {"Jm": {"min": 1, "max": 1000}}})
        problem = tunica.Problem(experiment, base=TRELOAR)
        x = problem.vector({"Jm": 2.0})
        found = problem.evaluate(x)
        self.assertEqual("failed", found.status)
        self.assertTrue(found.reason)
        self.assertEqual(numpy.inf, problem.objective(x))
        with self.assertRaises(tunica.EvaluationError):
            problem.residuals(x)

    def test_a_vector_of_another_length_is_refused(self):
        problem = tunica.Problem(of_treloar({"type": "yeoh"}), base=TRELOAR)
        for wrong in ([1.0], numpy.zeros((3, 3)), []):
            with self.assertRaises(tunica.InputError):
                problem.evaluate(wrong)
        with self.assertRaises(KeyError):
            problem.vector({"mu": 1})

    def test_constraints_come_with_their_derivatives(self):
        problem = tunica.Problem(EXAMPLES / "lamb_aorta_stable" / "experiment.json", "hgo/cma_es")
        x = problem.initial
        values, jacobian = problem.constraints(x)
        self.assertEqual((len(values), len(x)), jacobian.shape)
        self.assertGreater(len(values), 0)
        j = int(numpy.abs(jacobian).sum(axis=0).argmax())
        step = numpy.zeros(len(x))
        step[j] = 1e-5 * max(abs(x[j]), 1e-2)
        column = (problem.constraints(x + step)[0] - problem.constraints(x - step)[0]) / (2 * step[j])
        numpy.testing.assert_allclose(jacobian[:, j], column, rtol=1e-5, atol=1e-6 * numpy.abs(column).max())

    def test_a_sampler_finds_the_intervals_of_the_run(self):
        # 20000 steps of a random walk in two parameters, of which about 1500 are independent: the standard deviation is
        # known to 2 %, so that 10 % is five standard errors, a false alarm in a million seeds. Seed 11.
        experiment = of_treloar({"type": "mooney_rivlin"})
        tunica.simulate(experiment, "rubber", {"c10": 150.0, "c01": 12.0}, self.folder / "data", base=TRELOAR,
                        noise=0.02, seed=5)
        for test in experiment["tests"].values():
            test["data"]["noise"] = {"relative": 0.02}
        result = tunica.run(experiment, self.folder / "run", base=self.folder / "data")
        self.assertEqual(1, result.best.best["interval_factor"])
        problem = tunica.Problem(experiment, base=self.folder / "data")
        at = problem.vector(result.parameters)
        jacobian = problem.jacobian(at)
        step = numpy.linalg.cholesky(numpy.linalg.inv(jacobian.T @ jacobian)) * 2.4 / numpy.sqrt(2)
        generator = numpy.random.default_rng(11)
        half, samples = problem.objective(at) / 2, []  # −log of the density: residuals are in units of the noise
        for _ in range(20000):
            proposed = at + step @ generator.normal(size=2)
            other = problem.objective(proposed) / 2
            if generator.uniform() < numpy.exp(min(0.0, half - other)):
                at, half = proposed, other
            samples.append(at)
        spread = numpy.std(samples, axis=0)
        for j, name in enumerate(problem.names):
            low, high = result.parameters[name].ci95
            self.assertAlmostEqual(1, (high - low) / 2 / (1.96 * spread[j]), delta=0.1)
