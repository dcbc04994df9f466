# SPDX-License-Identifier: Apache-2.0
"""Tests, optimisers and mechanisms written in Python take part like those of plugins."""
import unittest

import numpy

import tunica
from support import TRELOAR, Case, of_treloar

try:
    import scipy.optimize
except ImportError:
    scipy = None


@tunica.test("py_uniaxial", {"stretch": ("1", "abscissa", "stretch"), "stress": ("kPa", "channel", "stress")})
def uniaxial(material, rows):
    """Uniaxial tension of an isotropic, incompressible strip: nominal stress."""
    stretch = rows["stretch"]
    sides = stretch**-0.5
    return {"stress": material.axis_stress(numpy.stack([stretch, sides, sides], axis=1), free=2)[:, 0] / stretch}


@tunica.test("py_scaled", {"stretch": ("1", "abscissa", "stretch"), "stress": ("kPa", "channel", "stress")},
             {"gain": ("1", 1.0, 0.5, 2.0)}, options={"shift": 0.0})
class Scaled:
    """The same behind an amplifier whose gain nobody knows."""

    def __init__(self, shift):
        self.shift = shift

    def predict(self, material, rows, gain):
        return {"stress": gain * uniaxial(material, rows)["stress"] + self.shift}


@tunica.mechanism("py_crosslinks", {"c": ("kPa", 0, 0, 500)}, acts_on="material", plausible=(0.1, 200))
def crosslinks(C, c):
    """Entanglements add a term in the second invariant."""
    return c * (C.I2 - 3)


@tunica.mechanism("py_offset", {"offset": ("kPa", 0, -500, 500)}, acts_on="readings", side="both", plausible=(1, 400))
def offset(predicted, rows, value):
    """The load cell shows a force at rest."""
    return {"stress": predicted["stress"] + value}


@tunica.optimizer("py_walk", needs=["random"], options={"step": 0.1})
def walk(search, step):
    """A random walk that keeps what is better."""
    generator = search.generator()
    best, least = search.start.copy(), search.objective(search.start)
    while not search.should_stop:
        x = numpy.clip(best + step * generator.normal(size=search.dimension), 0, 1)
        value = search.objective(x)
        if value < least:
            best, least = x, value


def one_test(kind, model=None, **entry):
    experiment = of_treloar(model or {"type": "neo_hooke"})
    uniaxial_test = experiment["tests"]["uniaxial"]
    if kind != "uniaxial":
        uniaxial_test.pop("direction")
    experiment["tests"] = {"strip": {**uniaxial_test, "type": kind, **entry}}
    return experiment


class Tests(Case):
    def test_a_test_in_python_predicts_what_the_plugin_predicts(self):
        for model in ({"type": "neo_hooke"}, {"type": "yeoh"}, {"type": "mooney_rivlin"}):
            mine = tunica.Problem(one_test("py_uniaxial", model), base=TRELOAR)
            theirs = tunica.Problem(one_test("uniaxial", model), base=TRELOAR)
            x = theirs.initial
            numpy.testing.assert_allclose(mine.residuals(x), theirs.residuals(x), rtol=1e-9, atol=1e-9)
            reference = theirs.jacobian(x)
            numpy.testing.assert_allclose(mine.jacobian(x), reference, rtol=1e-6,
                                          atol=1e-7 * numpy.abs(reference).max())

    def test_it_is_fitted_with_any_number_of_threads_to_the_same_bits(self):
        experiment = one_test("py_uniaxial", {"type": "mooney_rivlin"})
        experiment["runs"][0].update(realisations=3, initial="random")
        one = tunica.run(experiment, self.folder / "1", base=TRELOAR, threads=1)
        four = tunica.run(experiment, self.folder / "4", base=TRELOAR, threads=4)
        numpy.testing.assert_array_equal(one.evaluations["objective"], four.evaluations["objective"])
        plugin = tunica.run(one_test("uniaxial", {"type": "mooney_rivlin"}), self.folder / "plugin", base=TRELOAR)
        self.assertAlmostEqual(1, one.best.objective / plugin.best.objective, 8)

    def test_own_parameters_and_options_are_its_own(self):
        experiment = one_test("py_scaled", {"type": "neo_hooke", "parameters": {"mu": {"fixed": 400}}}, shift=3.0)
        result = tunica.run(experiment, self.folder / "run", base=TRELOAR)
        fit = result.best.fit["strip"]
        gain = result.parameters["strip.gain"]
        stretch = fit["stretch"]
        numpy.testing.assert_allclose(fit["stress.predicted"], gain * 400 * (stretch - stretch**-2) + 3, rtol=1e-9)
        self.assertEqual("1", tunica.describe("py_scaled")["parameters"][0]["unit"])

    def test_what_predict_raises_is_a_failed_evaluation(self):
        @tunica.test("py_faulty", {"stretch": ("1", "abscissa", "stretch"), "stress": ("kPa", "channel", "stress")})
        def faulty(material, rows):
            found = uniaxial(material, rows)
            if found["stress"].max() > 5000:
                raise ValueError("the strip is torn")
            return found
        experiment = one_test("py_faulty")
        experiment["optimizers"]["lm"] = {"type": "es"}
        experiment["stop"]["max_evaluations"] = 300
        result = tunica.run(experiment, self.folder / "run", base=TRELOAR)
        failed = result.evaluations["status"] == "failed"
        self.assertEqual(300, result.evaluations.rows)
        self.assertTrue(0 < failed.sum() < 300)
        self.assertIn("ValueError: the strip is torn (taking_part_test.py, line",
                      result.evaluations["reason"][failed][0])
        self.assertTrue(result.best.found)

    def test_wrong_answers_are_failures_that_say_what_was_expected(self):
        answers = {"py_empty": {}, "py_short": {"stress": numpy.zeros(3)}, "py_nan": {"stress": numpy.nan},
                   "py_text": {"stress": "much"}}
        expected = {"py_empty": "KeyError", "py_short": "ValueError", "py_nan": "nan", "py_text": "ValueError"}
        for name, answer in answers.items():
            tunica.test(name, {"stretch": ("1", "abscissa"), "stress": ("kPa", "channel", "stress")})(lambda material, rows: answer)
            found = tunica.Problem(one_test(name), base=TRELOAR).evaluate([100.0])
            self.assertEqual("failed", found.status)
            self.assertIn(expected[name], found.reason)

    def test_a_material_outlives_no_prediction(self):
        kept = []

        @tunica.test("py_keeping", {"stretch": ("1", "abscissa", "stretch"), "stress": ("kPa", "channel", "stress")})
        def keeping(material, rows):
            kept.append(material)
            return uniaxial(material, rows)
        tunica.Problem(one_test("py_keeping"), base=TRELOAR).evaluate([100.0])
        with self.assertRaisesRegex(tunica.InputError, "gone"):
            kept[0].energy(C=numpy.eye(3))


class Optimizers(Case):
    def fit(self, optimizer, folder, model="mooney_rivlin", evaluations=600, threads=1, **options):
        return tunica.run(of_treloar({"type": model}, {"type": optimizer, **options}, evaluations),
                          self.folder / folder, base=TRELOAR, threads=threads)

    def test_a_walk_comes_near_and_is_the_same_with_any_number_of_threads(self):
        best = self.fit("ceres_lm", "lm").best.objective
        one, four = self.fit("py_walk", "1"), self.fit("py_walk", "4", threads=4)
        numpy.testing.assert_array_equal(one.evaluations["objective"], four.evaluations["objective"])
        self.assertEqual(600, one.evaluations.rows)
        self.assertLess(one.best.objective, 1.2 * best)
        self.assertEqual("max_evaluations", one.best.json["stop_reason"])

    @unittest.skipUnless(scipy, "python3-scipy is not installed")
    def test_scipy_as_an_optimiser_of_tunica(self):
        @tunica.optimizer("py_least_squares", needs=["residuals", "gradient"])
        def least_squares(search):
            def residuals(x):
                return search.linearise(x)[1]
            found = scipy.optimize.least_squares(residuals, search.start, lambda x: search.linearise(x)[2],
                                                 bounds=(0, 1), xtol=1e-12, ftol=1e-12, gtol=1e-12)
            return found.success, found.message
        result = self.fit("py_least_squares", "scipy")
        self.assertAlmostEqual(1, result.best.objective / self.fit("ceres_lm", "lm").best.objective, 8)
        self.assertTrue(result.best.converged)

    def test_batches_and_starts_run_side_by_side_in_order(self):
        @tunica.optimizer("py_batch", needs=["batch"])
        def batch(search):
            grid = numpy.stack(numpy.meshgrid(*[numpy.linspace(0, 1, 12)] * search.dimension), -1)
            told = search.evaluate_batch(grid.reshape(-1, search.dimension))
            return True, f"{len(told)} points"

        @tunica.optimizer("py_starts", needs=["random"])
        def starts(search):
            def body(k, child):
                generator = child.generator(f"start {k}")
                for _ in range(5):
                    child.objective(generator.uniform(size=child.dimension))
            begun = search.for_each_start(10, body)
            return begun == 10, f"{begun} starts"
        for name in ("py_batch", "py_starts"):
            tables = [self.fit(name, f"{name}-{n}", threads=n).evaluations["objective"] for n in (1, 4)]
            numpy.testing.assert_array_equal(*tables)
        self.assertEqual(144, len(tunica.open(self.folder / "py_batch-4").evaluations["objective"]))
        self.assertEqual(50, len(tunica.open(self.folder / "py_starts-4").evaluations["objective"]))

    def test_what_it_raises_ends_the_search_and_the_best_point_stays(self):
        @tunica.optimizer("py_giving_up")
        def giving_up(search):
            search.objective(search.start)
            raise RuntimeError("no idea where to go")
        result = self.fit("py_giving_up", "run")
        self.assertEqual("optimizer_failure", result.best.json["stop_reason"])
        self.assertEqual(1, result.evaluations.rows)
        self.assertIn("RuntimeError: no idea where to go", (self.folder / "run" / "run.log").read_text())


class Mechanisms(Case):

    def test_an_added_energy_is_the_model_with_that_term(self):
        entry = {"type": "neo_hooke", "mechanisms": [{"type": "py_crosslinks"}]}
        mine = tunica.Problem(of_treloar(entry), base=TRELOAR)
        theirs = tunica.Problem(of_treloar({"type": "mooney_rivlin"}), base=TRELOAR)
        x = mine.vector({"mu": 300.0, "py_crosslinks.c": 12.0})
        y = theirs.vector({"c10": 150.0, "c01": 12.0})
        numpy.testing.assert_allclose(mine.residuals(x), theirs.residuals(y), rtol=1e-8, atol=1e-9)
        scale = numpy.array([0.5, 1.0])  # mu = 2 c10
        numpy.testing.assert_allclose(mine.jacobian(x), theirs.jacobian(y) * scale, rtol=1e-7, atol=1e-8)

    def test_at_the_null_the_base_answers_bit_for_bit(self):
        bare = tunica.Problem(of_treloar({"type": "neo_hooke"}), base=TRELOAR)
        experiment = of_treloar({"type": "neo_hooke", "mechanisms": [{"type": "py_crosslinks"}]})
        for test in experiment["tests"].values():
            test["mechanisms"] = [{"type": "py_offset"}]
        changed = tunica.Problem(experiment, base=TRELOAR)
        x = changed.vector({"mu": 321.0, "py_crosslinks.c": 0.0})
        numpy.testing.assert_array_equal(bare.residuals([321.0]), changed.residuals(x))

    def test_readings_have_the_derivatives_of_their_formula(self):
        experiment = of_treloar({"type": "neo_hooke"})
        experiment["tests"]["uniaxial"]["mechanisms"] = [{"type": "py_offset"}]
        problem = tunica.Problem(experiment, base=TRELOAR)
        bare = tunica.Problem(of_treloar({"type": "neo_hooke"}), base=TRELOAR)
        for value in (0.0, 25.0):
            x = problem.vector({"mu": 321.0, "uniaxial.py_offset.offset": value})
            place = problem.names.index("mu")
            numpy.testing.assert_allclose(problem.jacobian(x)[:, place], bare.jacobian([321.0])[:, 0], rtol=1e-7,
                                          atol=1e-9)
            shift = problem.predict(x)[("uniaxial", "stress")] - bare.predict([321.0])[("uniaxial", "stress")]
            numpy.testing.assert_allclose(shift, value, atol=1e-9)

    def test_what_a_mechanism_raises_is_a_failed_evaluation(self):
        @tunica.mechanism("py_broken", {"a": ("kPa", 0, -1, 1)}, acts_on="readings", side="both")
        def broken(predicted, rows, a):
            return {"stress": predicted["stres"] + a}
        experiment = of_treloar({"type": "neo_hooke"})
        experiment["tests"]["uniaxial"]["mechanisms"] = [{"type": "py_broken"}]
        problem = tunica.Problem(experiment, base=TRELOAR)
        found = problem.evaluate(problem.vector({"uniaxial.py_broken.a": 0.5}))
        self.assertEqual("failed", found.status)
        self.assertIn("mechanism 'py_broken': KeyError: 'stres' (taking_part_test.py, line", found.reason)
        self.assertEqual("ok", problem.evaluate(problem.vector({"uniaxial.py_broken.a": 0.0})).status)

    def test_a_diagnosis_considers_it_and_names_it(self):
        data = of_treloar({"type": "mooney_rivlin"})
        tunica.simulate(data, "rubber", {"c10": 150.0, "c01": 12.0}, self.folder / "data", base=TRELOAR, noise=0.005,
                        seed=5)
        asked = of_treloar({"type": "neo_hooke"})
        for test in asked["tests"].values():
            test["data"]["noise"] = {"relative": 0.005}
            test["data"]["order"] = "loading"
        found = tunica.diagnose(asked, self.folder / "diagnosis", base=self.folder / "data", threads=2,
                                mechanisms=["py_crosslinks", "py_offset", "chain_extensibility"])
        self.assertEqual("py_crosslinks", found.causes[0]["id"])
        amplitude = found.causes[0]["amplitude"]
        self.assertTrue(amplitude["ci95"][0] < 12.0 < amplitude["ci95"][1], amplitude)
        extended = tunica.run(found.extended, self.folder / "extended", certificate=False)
        self.assertAlmostEqual(1, extended.parameters["py_crosslinks.c"] / amplitude["value"], 3)


class Declarations(Case):
    def test_what_is_declared_wrongly_is_refused_by_name(self):
        for wrong in (lambda: tunica.mechanism("py_a", {"c": ("kPa", 0, 0, 1)}, acts_on="nothing"),
                      lambda: tunica.mechanism("py_a", {"c": ("kPa", 0, 0, 1)}, acts_on="material", side="left"),
                      lambda: tunica.mechanism("py_a", {}, acts_on="material")(lambda C: C.I1),
                      lambda: tunica.optimizer("py_b", needs=["hessian"]),
                      lambda: tunica.test("py_c", {"stretch": ("1", "abscissa")})(lambda material, rows: {})):
            with self.assertRaises(tunica.InputError):
                wrong()

    def test_what_the_making_of_a_definition_raises_is_an_input_error(self):
        @tunica.model("py_unmade", {"mu": ("kPa", 1, 0.1, 10)}, options={"terms": 2})
        class Unmade:
            def __init__(self, terms):
                raise ValueError(f"{terms} terms are too many for me")
        with self.assertRaisesRegex(tunica.InputError, "ValueError: 2 terms are too many for me"):
            tunica.Material("py_unmade")
        with self.assertRaisesRegex(tunica.InputError, "ValueError: 2 terms are too many for me"):
            tunica.run(of_treloar({"type": "py_unmade"}), self.folder / "run", base=TRELOAR)
        self.assertFalse((self.folder / "run").exists())

    def test_definitions_are_in_the_schema(self):
        text = str(tunica.schema())
        for name in ("py_uniaxial", "py_walk", "py_crosslinks", "py_offset"):
            self.assertIn(name, text)
