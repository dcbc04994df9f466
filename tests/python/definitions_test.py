# SPDX-License-Identifier: Apache-2.0
"""Models written in Python take part like those of plugins."""
import warnings

import numpy

import tunica
from support import TRELOAR, Case, of_treloar


@tunica.model("py_neo_hooke", {"mu": ("kPa", 100, 1, 1e4, True)})
def neo_hooke(C, mu):
    """A rubber, for a test."""
    return mu / 2 * (C.I1 - 3)


@tunica.model("py_mooney_rivlin", {"c10": ("kPa", 100, 0, 1e4), "c01": ("kPa", 10, 0, 1e4)})
def mooney_rivlin(C, c10, c01):
    return c10 * (C.I1 - 3) + c01 * (C.I2 - 3)


@tunica.model("py_fibres", {"mu": ("kPa", 10, 1, 100), "k1": ("kPa", 20, 1, 100), "k2": ("1", 1, 0.1, 10),
                            "theta": ("deg", 40, 0, 90)})
def fibres(C, mu, k1, k2, theta):
    energy = mu / 2 * (C.I1 - 3)
    for angle in (theta, -theta):
        stretch = numpy.maximum(C.along(angle) - 1, 0.0)
        energy = energy + k1 / (2 * k2) * (numpy.exp(k2 * stretch**2) - 1)
    return energy


# 2μ/α² [Σ λ^α − 3 + (J^(−αβ) − 1)/β] with α = 2 and β = ν/(1 − 2ν), which hyperfoam has too.
@tunica.model("py_foam", {"mu": ("kPa", 20, 1, 1e3), "nu": ("1", 0.2, -0.4, 0.45)}, compressible=True)
def foam(C, mu, nu):
    beta = nu / (1 - 2 * nu)
    return mu / 2 * (C.I1 - 3 + (C.J ** (-2 * beta) - 1) / beta)


class Definitions(Case):
    def test_ten_lines_of_python_fit_treloar(self):
        built_in = tunica.run(of_treloar({"type": "neo_hooke"}), self.folder / "a", base=TRELOAR)
        found = tunica.run(of_treloar({"type": "py_neo_hooke"}), self.folder / "b", base=TRELOAR, threads=2)
        self.assertAlmostEqual(1, found.parameters["mu"] / built_in.parameters["mu"], 8)
        self.assertAlmostEqual(1, found.best.objective / built_in.best.objective, 10)
        self.assertIn("py_neo_hooke (Python)", found.json["provenance"]["plugins"])
        self.assertEqual("A rubber, for a test.", tunica.names()["models"]["py_neo_hooke"])
        self.assertEqual("mu", tunica.describe("py_neo_hooke")["parameters"][0]["name"])

    def test_results_do_not_depend_on_the_number_of_threads(self):
        experiment = of_treloar({"type": "py_mooney_rivlin"}, {"type": "es"}, 400)
        experiment["runs"][0]["realisations"] = 3
        one = tunica.run(experiment, self.folder / "1", base=TRELOAR, threads=1)
        four = tunica.run(experiment, self.folder / "4", base=TRELOAR, threads=4)
        numpy.testing.assert_array_equal(one.evaluations["objective"], four.evaluations["objective"])

    def test_derivatives_are_those_of_the_plugin_with_the_same_energy(self):
        generator = numpy.random.default_rng(3)
        F = numpy.eye(3) + 0.2 * generator.uniform(-1, 1, (30, 3, 3))
        mine = tunica.Material("py_mooney_rivlin", c10=30.0, c01=7.0)
        theirs = tunica.Material("mooney_rivlin", c10=30.0, c01=7.0)
        for method in ("energy", "stress", "tangent"):
            numpy.testing.assert_allclose(getattr(mine, method)(F=F), getattr(theirs, method)(F=F), rtol=1e-11,
                                          atol=1e-10, err_msg=method)
        problem = tunica.Problem(of_treloar({"type": "py_mooney_rivlin"}), base=TRELOAR)
        other = tunica.Problem(of_treloar({"type": "mooney_rivlin"}), base=TRELOAR)
        x = [150.0, 12.0]
        numpy.testing.assert_allclose(problem.jacobian(x), other.jacobian(x), rtol=1e-8, atol=1e-10)

    def test_fibres_are_those_of_gho(self):
        known = {"mu": 12.0, "k1": 25.0, "k2": 1.5, "theta": 35.0}
        mine, theirs = tunica.Material("py_fibres", **known), tunica.Material("gho", kappa=0.0, **known)
        stretches = numpy.array([[1.3, 1.1, 1 / 1.43], [0.9, 1.25, 1 / 1.125], [1.1, 0.8, 1 / 0.88]])
        numpy.testing.assert_allclose(mine.stress(stretches=stretches)[:, [0, 1, 2], [0, 1, 2]],
                                      theirs.stress(stretches=stretches)[:, [0, 1, 2], [0, 1, 2]], rtol=1e-10)

    def test_an_exception_is_a_failed_evaluation_and_nothing_is_lost(self):
        @tunica.model("py_touchy", {"mu": ("kPa", 100, 1, 1e4)})
        def touchy(C, mu):
            if mu > 500:
                raise ZeroDivisionError("mu is too large for me")
            return mu / 2 * (C.I1 - 3)

        problem = tunica.Problem(of_treloar({"type": "py_touchy"}), base=TRELOAR)
        found = problem.evaluate([600.0])
        self.assertEqual("failed", found.status)
        self.assertIn("ZeroDivisionError: mu is too large for me (definitions_test.py, line", found.reason)
        result = tunica.run(of_treloar({"type": "py_touchy"}, {"type": "es"}, 300), self.folder / "run", base=TRELOAR)
        table = result.evaluations
        failed = table["status"] == "failed"
        self.assertEqual(300, table.rows)
        self.assertTrue(0 < failed.sum() < 300)
        self.assertTrue((table["mu"][failed] > 500).all())
        self.assertIn("ZeroDivisionError: mu is too large for me", table["reason"][failed][0])
        self.assertAlmostEqual(1, result.parameters["mu"] / 404.37141701523916, 2)

    def test_a_definition_replaces_an_earlier_one_and_no_plugin(self):
        for factor in (1.0, 2.0):
            tunica.model("py_changing", {"mu": ("kPa", 1, 0.1, 10)})(lambda C, mu: factor * mu * (C.I1 - 3))
            energy = tunica.Material("py_changing").energy(stretches=[1.5, 1, 1])[0]  # 1.5² − 1 = 1.25
            self.assertAlmostEqual(factor * 1.25, energy, 12)
        tunica.model("neo_hooke", {"mu": ("kPa", 1, 0.1, 10)})(lambda C, mu: mu * C.I1)
        try:
            with self.assertRaisesRegex(tunica.InputError, "already provided by plugin"):
                tunica.names()
        finally:
            tunica.forget("neo_hooke")
        tunica.names()

    def test_options_reach_the_class(self):
        @tunica.model("py_power", {"c": ("kPa", 1, 0.1, 10)}, options={"power": (2, "Of the invariant.")})
        class Power:
            def __init__(self, power):
                self.power = power

            def energy(self, C, c):
                return c * (C.I1 - 3) ** self.power
        C = numpy.diag([2.0, 1.0, 1.0])
        self.assertEqual(1, tunica.Material({"type": "py_power"}, c=1.0).energy(C=C)[0])
        self.assertEqual(8, tunica.Material({"type": "py_power", "power": 3}, c=8.0).energy(C=C)[0])
        with self.assertRaisesRegex(tunica.InputError, "'power'"):
            tunica.Material({"type": "py_power", "powr": 3})

    def test_a_declaration_that_makes_no_sense_is_refused(self):
        with self.assertRaisesRegex(tunica.InputError, "min ≤ initial ≤ max"):
            tunica.model("py_wrong", {"mu": ("kPa", 1, 2, 3)})(lambda C, mu: mu)

    def test_a_fresh_process_certifies_what_a_module_defines(self):
        module = tunica.run(of_treloar({"type": "py_neo_hooke"}), self.folder / "module", base=TRELOAR)
        self.assertTrue(module.best.best["certificate"]["fresh_process"])
        neo_hooke.__module__, kept = "__main__", neo_hooke.__module__
        try:
            tunica.model("py_loose", {"mu": ("kPa", 100, 1, 1e4, True)})(neo_hooke)
        finally:
            neo_hooke.__module__ = kept
        loose = tunica.run(of_treloar({"type": "py_loose"}), self.folder / "loose", base=TRELOAR)
        self.assertFalse(loose.best.best["certificate"]["fresh_process"])
        self.assertIn("'py_loose' is defined in a notebook or a script", str(loose.best.best["certificate"]))

    def test_what_is_not_finite_is_a_failed_evaluation_without_a_warning(self):
        experiment = of_treloar({"type": "py_fibres", "parameters": {"k2": {"max": 1e6}}})
        problem = tunica.Problem(experiment, base=TRELOAR)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = problem.evaluate(problem.vector({"k2": 1e5}), jacobian=True)
        self.assertEqual("failed", found.status)
        self.assertRegex(found.reason, "uniaxial")

    def test_memory_comes_from_mechanisms_around_it(self):
        entry = {"mechanisms": [{"type": "viscoelasticity"}]}
        path = numpy.repeat([[1.1, 1 / 1.1, 1.0], [1.5, 1 / 1.5, 1.0]], 3, axis=0)
        found = []
        for kind, mu in (("py_neo_hooke", "mu"), ("neo_hooke", "mu")):
            material = tunica.Material({"type": kind, **entry}, mu=30.0)
            material.parameters.update(zip(list(material.parameters)[1:], (0.5, 2.0)))
            found.append(material.stress(stretches=path, time_step=[0, 1, 1, 1, 1, 1]))
        numpy.testing.assert_allclose(*found, rtol=1e-10, atol=1e-10)
        self.assertFalse(numpy.allclose(found[0][0], found[0][1]), "nothing relaxes")
        with self.assertRaises(tunica.InputError):
            tunica.Material({"type": "py_neo_hooke", "mechanisms": [{"type": "matrix_stiffening"}]})

    def test_an_energy_may_let_the_volume_change(self):
        mine = tunica.Material("py_foam", mu=25.0, nu=0.18)
        theirs = tunica.Material("hyperfoam", mu_1=25.0, alpha_1=2.0, nu=0.18)
        F = numpy.eye(3) + 0.2 * numpy.random.default_rng(5).uniform(-1, 1, (20, 3, 3))
        for method in ("stress", "tangent"):
            numpy.testing.assert_allclose(getattr(mine, method)(F=F), getattr(theirs, method)(F=F), rtol=1e-10,
                                          atol=1e-10, err_msg=method)
        numpy.testing.assert_allclose(mine.stress(F=numpy.eye(3)[None]), 0, atol=1e-13)
        values = {"stretch": [0.6, 0.8, 1.0, 1.3], "stress": [-60.0, -15.0, 0.0, 20.0],
                  "lateral": [1.1, 1.04, 1.0, 0.95]}
        rows = "stretch,stress [kPa],lateral\n" + "".join(
            f"{a},{b},{c}\n" for a, b, c in zip(*values.values()))
        (self.folder / "strip.csv").write_text(rows)
        found = []
        for kind in ({"type": "py_foam"}, {"type": "hyperfoam", "parameters": {"alpha_1": {"fixed": 2}}}):
            experiment = {"format": 1, "name": "foam", "models": {"foam": kind}, "objective": "least_squares",
                          "tests": {"strip": {"type": "uniaxial", "direction": "axial", "data": {
                              "file": "strip.csv", "noise": {"stress": {"absolute": "1 kPa"},
                                                             "transverse_stretch": {"absolute": 0.01}},
                              "columns": {"stretch": "stretch", "stress": "stress",
                                          "transverse_stretch": "lateral"}}}},
                          "optimizers": {"lm": {"type": "ceres_lm"}}, "runs": [{"model": "foam", "optimizer": "lm"}]}
            found.append(tunica.Problem(experiment, base=self.folder).jacobian([25.0, 0.18]))
        numpy.testing.assert_allclose(*found, rtol=1e-8, atol=1e-8)
