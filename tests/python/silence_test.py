# SPDX-License-Identifier: Apache-2.0
"""Nothing wrong in silence: what is read is what was given, and what cannot be meant is refused."""
import copy
import json
import pickle
import unittest

import numpy

import tunica
from support import TRELOAR, Case, of_treloar

try:
    import scipy.stats
except ImportError:
    scipy = None


def written(experiment, folder):
    """The experiment as a file in a folder of its own, with the data beside it."""
    folder.mkdir()
    for test in experiment["tests"].values():
        name = test["data"]["file"]
        (folder / name).write_bytes((TRELOAR / name).read_bytes())
    (folder / "treloar.json").write_text("// a comment\n" + json.dumps(experiment))
    return folder / "treloar.json"


class Input(Case):
    def test_what_was_read_is_the_file(self):
        experiment = of_treloar({"type": "neo_hooke"})
        read = tunica.read(written(experiment, self.folder / "one"))
        self.assertEqual(experiment, read.input)
        self.assertEqual(json.dumps(experiment), json.dumps(read.input))
        self.assertEqual(experiment["tests"], tunica.read(experiment, TRELOAR).input["tests"])

    def test_runs_that_are_replaced_keep_what_stands_above_them(self):
        experiment = of_treloar({"type": "neo_hooke"})
        experiment["runs"][0]["objective"] = "standardised_quadratic"
        experiment["stop"] = {"max_evaluations": 7}
        file = written(experiment, self.folder / "one")
        right = tunica.run(of_treloar({"type": "neo_hooke"}), self.folder / "right", base=TRELOAR).best.objective
        for k, change in enumerate((lambda given: {**given, "runs": [{"model": "rubber", "optimizer": "lm"}]},
                                    copy.deepcopy, lambda given: pickle.loads(pickle.dumps(given)))):
            changed = change(tunica.read(file).input)
            changed["runs"] = [{"model": "rubber", "optimizer": "lm"}]
            self.assertEqual(right, tunica.Problem(changed).objective(
                tunica.Problem(changed).vector(tunica.open(self.folder / "right").parameters)))
            result = tunica.run(changed, self.folder / f"changed{k}")
            kept = json.loads((result.directory / "input.json").read_text())["runs"][0]
            self.assertEqual("least_squares", kept["objective"])
            self.assertLessEqual(result.best.json["evaluations"], 7)

    def test_input_json_of_a_result_has_above_the_runs_what_they_share(self):
        tunica.run(of_treloar({"type": "neo_hooke"}), self.folder / "run", base=TRELOAR)
        kept = json.loads((self.folder / "run" / "input.json").read_text())
        self.assertEqual("least_squares", kept["objective"])
        self.assertEqual(2000, kept["stop"]["max_evaluations"])

    def test_names_of_two_folders_are_asked_about(self):
        one, two = (tunica.read(written(of_treloar({"type": "neo_hooke"}), self.folder / name)).input
                    for name in ("one", "two"))
        one["tests"]["uniaxial"] = two["tests"]["uniaxial"]
        with self.assertRaisesRegex(tunica.InputError, "several folders"):
            tunica.check(one)


class NoResult(Case):
    def test_a_calibration_without_a_result_raises_with_the_reason(self):
        @tunica.model("py_fails", {"mu": ("kPa", 1, 0.1, 10)})
        def fails(C, mu):
            raise ValueError("never")
        experiment = of_treloar({"type": "py_fails"}, evaluations=20)
        with self.assertRaisesRegex(tunica.EvaluationError, "no run has a result.*ValueError: never") as raised:
            tunica.run(experiment, self.folder / "run", base=TRELOAR, certificate=False)
        self.assertEqual(str(self.folder / "run"), raised.exception.directory)
        hollow = tunica.open(self.folder / "run")
        for ask in (lambda: hollow.parameters, lambda: hollow.best, lambda: hollow.runs["rubber/lm"].fit,
                    lambda: hollow.runs["rubber/lm"].objective, lambda: hollow.runs["rubber/lm"].card("abaqus")):
            with self.assertRaisesRegex(tunica.EvaluationError, "never"):
                ask()


class Units(Case):
    def test_units_that_are_unknown_or_do_not_fit_are_refused(self):
        def predict(material, rows):
            return {}

        def energy(C, mu):
            return mu * C.I1
        for said, call in (
                ("unknown unit 'kPaa'. Did you mean 'kPa'", lambda: tunica.model("py_u", {"mu": ("kPaa",)})(energy)),
                ("unknown unit 'milimeter'", lambda: tunica.test("py_u", {"value": ("milimeter",)})(predict)),
                ("the unit 'MPa' for a stress", lambda: tunica.test("py_u", {"s": ("MPa", "channel", "stress")})(predict)),
                ("the unit '%' for a stretch", lambda: tunica.test(
                    "py_u", {"l": ("%", "abscissa", "stretch"), "p": ("kPa",)})(predict)),
                ("the unit 'min' for a time", lambda: tunica.test("py_u", {"t": ("min", "time"), "p": ("kPa",)})(predict)),
                ("role: found 'abscisa'", lambda: tunica.test("py_u", {"l": ("1", "abscisa"), "p": ("kPa",)})(predict)),
                ("unknown unit 'kPaa'", lambda: tunica.mechanism(
                    "py_u", {"c": ("kPaa", 0, 0, 1)}, acts_on="material")(energy))):
            with self.assertRaisesRegex(tunica.InputError, said.replace(".", r"\.")):
                call()
        self.assertNotIn("py_u", str(tunica.names()))


class Beyond(Case):
    def test_beyond_a_bound_nothing_is_evaluated_in_silence(self):
        for coordinates in ("parameters", "unit"):
            problem = tunica.Problem(of_treloar({"type": "neo_hooke"}), base=TRELOAR, coordinates=coordinates)
            for bound, sign in zip(problem.bounds, (-1, 1)):
                self.assertEqual("ok", problem.evaluate(bound).status)
                for beyond in (bound + sign * 1e-3, numpy.array([numpy.nan])):
                    found = problem.evaluate(beyond)
                    self.assertEqual("failed", found.status)
                    self.assertIn("parameter 'mu' is", found.reason)
                    self.assertIn("outside its bounds", found.reason)
                    self.assertEqual((numpy.inf, -numpy.inf), (problem.objective(beyond), problem.log_likelihood(beyond)))
                    for function in (problem.residuals, problem.jacobian, problem.predict, problem.constraints,
                                     problem.values):
                        with self.assertRaisesRegex(tunica.EvaluationError, "outside its bounds"):
                            function(beyond)
            for value in (-1.0, 1e12, float("nan")):
                with self.assertRaisesRegex(tunica.InputError, "outside its bounds"):
                    problem.vector({"mu": value})


class Likelihood(Case):
    def test_differences_are_half_those_of_the_least_squares(self):
        problem = tunica.Problem(of_treloar({"type": "mooney_rivlin"}), base=TRELOAR)
        one, two = problem.vector({"c10": 150.0, "c01": 12.0}), problem.vector({"c10": 180.0, "c01": 5.0})
        half = (problem.objective(two) - problem.objective(one)) / 2
        self.assertAlmostEqual(1, (problem.log_likelihood(one) - problem.log_likelihood(two)) / half, 10)

    @unittest.skipUnless(scipy, "python3-scipy is not installed")
    def test_it_is_the_density_of_scipy_with_its_constants(self):
        for objective in ("least_squares", "sum_of_norms"):
            experiment = of_treloar({"type": "neo_hooke", "parameters": {"mu": {"prior": {"mean": 400, "sd": 5}}}})
            experiment["objective"] = objective
            tests = experiment["tests"]
            tests["uniaxial"]["data"]["noise"] = {"absolute": "0.02 MPa", "relative": "2 %", "correlation": 0.6}
            tests["uniaxial"]["data"]["order"] = "loading"
            tests["equibiaxial"]["weight"] = 3
            tests["pure_shear"]["hold_out"] = True
            problem = tunica.Problem(experiment, base=TRELOAR)
            x = problem.vector({"mu": 350.0})
            predicted, expected = problem.predict(x), 0.0
            for channel in problem.channels:
                if channel["test"] == "pure_shear":
                    continue
                measured, values = channel["measured"], predicted[channel["test"], channel["channel"]]
                sigma = numpy.hypot(20.0, 0.02 * measured)  # kPa
                numpy.testing.assert_allclose(channel["sigma"], sigma, rtol=1e-9)
                self.assertEqual("stated", channel["noise_origin"])
                rows = numpy.arange(len(measured))
                correlation = 0.6 if channel["test"] == "uniaxial" else 0.0
                covariance = sigma[:, None] * sigma * correlation**abs(rows[:, None] - rows)
                expected += scipy.stats.multivariate_normal(measured, covariance).logpdf(values)
            self.assertAlmostEqual(1, problem.log_likelihood(x) / expected, 9)


class Arguments(Case):
    def test_numbers_that_are_not_finite_are_refused(self):
        experiment = of_treloar({"type": "neo_hooke"})
        for value in (float("nan"), float("inf")):
            for call in (lambda v: tunica.diagnose(experiment, self.folder / "d", base=TRELOAR, alpha=v),
                         lambda v: tunica.discover(experiment, self.folder / "d", base=TRELOAR, alpha=v),
                         lambda v: tunica.simulate(experiment, noise=v, base=TRELOAR),
                         lambda v: tunica.simulate(experiment, parameters={"mu": v}, base=TRELOAR),
                         lambda v: tunica.Material("neo_hooke", mu=v),
                         lambda v: tunica.Material("neo_hooke").stress(stretches=[v, 1, 1]),
                         lambda v: tunica.mechanism("py_v", {"c": ("kPa", 0, 0, 1)}, acts_on="material", null=v)(
                             lambda C, c: c)):
                with self.assertRaisesRegex(tunica.InputError, "finite"):
                    call(value)
        result = tunica.run(experiment, self.folder / "run", base=TRELOAR)
        for words in ({"bulk_ratio": float("nan")}, {"density": float("inf")}):
            with self.assertRaisesRegex(tunica.InputError, "finite"):
                result.best.card("febio", **words)

    def test_a_nul_character_ends_no_name(self):
        experiment = of_treloar({"type": "neo_hooke"})
        file = self.folder / "experiment.json"
        file.write_text(json.dumps(experiment))
        nul = copy.deepcopy(experiment)
        nul["tests"]["uniaxial"]["data"]["file"] = "uniaxial.csv\0.txt"
        for call in (lambda: tunica.read(f"{file}\0x"), lambda: tunica.open(f"{self.folder}\0x"),
                     lambda: tunica.run(experiment, f"{self.folder}/run\0x", base=TRELOAR),
                     lambda: tunica.check(experiment, base=f"{TRELOAR}\0x"),
                     lambda: tunica.simulate(experiment, "rubber\0x", base=TRELOAR),
                     lambda: tunica.check(nul, base=TRELOAR)):
            with self.assertRaisesRegex(tunica.InputError, "NUL character"):
                call()
