#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cases_test.py BENCH: that cases hide what their truths say, as strongly as they say, behind seals that hold."""
import json
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

sys.path.insert(0, sys.argv.pop())
from hidden_terms import bases, case_files, complete_laws, generate, laws  # noqa: E402
from hidden_terms.deformation import Part  # noqa: E402
from hidden_terms.fitting import dial, misfit, refit  # noqa: E402
from hidden_terms.generate import Spec  # noqa: E402
from hidden_terms.protocol import Curve, RigError, observe, stretches  # noqa: E402

SEED = 11


def table(file):
    return np.genfromtxt(file, delimiter=",", skip_header=1)


class Case(unittest.TestCase):
    """One case of each kind, made once."""

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.place.name)
        cls.specs = {"null": Spec("null", "gho", 0, 0, "white", True),
                     "single": Spec("single", "neo_hooke", 150, 0, "relative", True),
                     "tissue": Spec("single", "hgo", 60, 1, "white", False),
                     "pair": Spec("pair", "mooney_rivlin", 400, 0, "white", True),
                     "kinked": Spec("kinked", "neo_hooke", 60, 0, "white", True),
                     "rig": Spec("rig", "mooney_rivlin", 60, 1, "white", True)}
        cls.names = {what: generate.make(spec, SEED, cls.out) for what, spec in cls.specs.items()}

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def truth(self, what):
        return case_files.open_truth(self.out / "cases" / self.names[what], self.out / "truths")

    def experiment(self, what):
        return json.loads((self.out / "cases" / self.names[what] / "experiment.json").read_text())

    def rebuilt(self, what):
        """Form, protocol, readings and noise of a case, from its files alone; the hidden part from its truth."""
        truth, experiment = self.truth(what), self.experiment(what)
        random = np.random.default_rng([SEED, generate.zlib.crc32(f"{self.specs[what].what} {truth['base']}".encode()),
                                        int(truth["lambda"]), truth["index"], truth["attempts"] - 1])
        form = bases.draw(truth["base"], random)
        protocol = bases.curves(truth["base"], form, random)
        self.assertEqual([[p.invariant, p.law, p.values] for p in form.material], truth["base_parameters"])
        self.assertEqual([curve.name for curve in protocol], list(experiment["tests"]))
        hidden = [Part(term["invariant"], term["law"], term["parameters"]) for term in truth["terms"]]
        rig = truth["rig"]
        error = None if rig is None else RigError(
            rig["kind"], [curve.name for curve in protocol].index(rig["curve"]), rig["channel"], rig["amount"])
        clean = observe(protocol, [*form.material, *hidden], error)
        columns = [list(test["data"].get("noise", {}).values()) for test in experiment["tests"].values()]
        noise = case_files.Noise([channel.get("absolute", 0) for test in columns for channel in test],
                                 [channel.get("relative", 0) for test in columns for channel in test])
        recorded = [table(self.out / "cases" / self.names[what] / f"{curve.name}.csv")[:, -curve.channels:].T
                    for curve in protocol]
        return form, protocol, clean, noise, np.concatenate([one.ravel() for one in recorded])

    def test_the_misfit_is_what_was_asked_for(self):
        for what in ("single", "kinked", "rig"):
            form, protocol, clean, noise, _ = self.rebuilt(what)
            found = misfit(form, protocol, clean, noise.sd(protocol, clean), np.random.default_rng(1))
            self.assertAlmostEqual(found / self.truth(what)["lambda"], 1, delta=0.05, msg=what)

    def test_readings_scatter_as_stated_about_the_truth(self):
        for what in ("null", "single", "pair", "rig"):
            _, protocol, clean, noise, recorded = self.rebuilt(what)
            chi2, n = float(np.sum(((recorded - clean) / noise.sd(protocol, clean))**2)), len(clean)
            self.assertLess(abs(chi2 - n), 4 * np.sqrt(2 * n), what)

    def test_noise_that_is_not_stated_is_not_in_the_file(self):
        self.assertNotIn("noise", json.dumps(self.experiment("tissue")["tests"]))
        self.assertIn("noise", json.dumps(self.experiment("null")["tests"]))

    def test_the_oracle_that_knows_the_form_fits_within_noise(self):
        for what in ("single", "pair", "kinked"):
            truth = self.truth(what)
            n = truth["rows"]
            self.assertLess(truth["oracle_chi2"], n + 4 * np.sqrt(2 * n))
            for term in truth["terms"]:
                self.assertGreater(term["oracle_error"], 0)
                self.assertLess(term["oracle_error"], max(term["slope"]))

    def test_curves_of_the_truth_are_those_of_its_law(self):
        for what in ("single", "tissue", "pair", "kinked"):
            for term in self.truth(what)["terms"]:
                np.testing.assert_allclose(
                    term["slope"], laws.slope(term["law"], np.array(term["x"]), term["parameters"]), rtol=1e-4, atol=1e-4)

    def test_two_terms_are_both_needed(self):
        form, protocol, clean, noise, _ = self.rebuilt("pair")
        terms = self.truth("pair")["terms"]
        self.assertNotEqual(terms[0]["invariant"], terms[1]["invariant"])
        for term in terms:
            known = bases.with_term(form, Part(term["invariant"], term["law"], term["parameters"]), term["x"][-1])
            self.assertGreater(refit(known, protocol, clean, noise.sd(protocol, clean)).chi2, 20)

    def test_a_pair_of_which_one_term_would_do_is_drawn_again(self):
        draw = [SEED, generate.zlib.crc32(b"pair mooney_rivlin"), 400, 0, self.truth("pair")["attempts"] - 1]
        for left, refused in ((24.9, True), (25.1, False)):
            with unittest.mock.patch.object(generate, "misfit", return_value=left):
                if refused:
                    with self.assertRaises(generate.Unreachable):
                        generate.hide(self.specs["pair"], np.random.default_rng(draw))
                else:
                    self.assertEqual(len(generate.hide(self.specs["pair"], np.random.default_rng(draw))[4]), 2)

    def test_files_give_nothing_away(self):
        for what in self.names:
            folder = self.out / "cases" / self.names[what]
            text = (folder / "experiment.json").read_text()
            for word in (*laws.PARAMETERS, *generate.RIG_ERRORS, "null", "single", "lambda"):
                self.assertNotIn(f'"{word}"', text)
            self.assertEqual(sorted(file.suffix for file in folder.iterdir() if file.suffix != ".csv"),
                             [".json", ".sha256"])

    def test_an_opened_truth_fits_its_seal(self):
        with tempfile.TemporaryDirectory() as place:
            out = pathlib.Path(place)
            name = generate.make(self.specs["null"], SEED, out)
            self.assertEqual(case_files.open_truth(out / "cases" / name, out / "truths")["what"], "null")
            truth = out / "truths" / f"{name}.json"
            truth.write_text(truth.read_text().replace('"null"', '"rig"'))
            with self.assertRaises(case_files.Tampered):
                case_files.open_truth(out / "cases" / name, out / "truths")
            truth.unlink()
            with self.assertRaises(case_files.Tampered):
                case_files.open_truth(out / "cases" / name, out / "truths")

    def test_a_seed_gives_the_same_bytes_and_another_seed_others(self):
        with tempfile.TemporaryDirectory() as place:
            out = pathlib.Path(place)
            name = generate.make(self.specs["rig"], SEED, out)
            self.assertEqual(name, self.names["rig"])
            for file in (self.out / "cases" / name).iterdir():
                self.assertEqual(file.read_bytes(), (out / "cases" / name / file.name).read_bytes())
            self.assertNotEqual(generate.make(self.specs["rig"], SEED + 1, out), name)

    def test_a_case_that_is_there_stays(self):
        marked = self.out / "cases" / self.names["null"] / "experiment.json"
        text = marked.read_text()
        marked.write_text("marked")
        generate.make(self.specs["null"], SEED, self.out)
        self.assertEqual(marked.read_text(), "marked")
        marked.write_text(text)


class Draws(unittest.TestCase):
    def test_no_hidden_term_is_one_that_the_base_has(self):
        random, seen = np.random.default_rng(4), set()
        for base in bases.BASES:
            form = bases.draw(base, random)
            protocol = bases.curves(base, form, random)
            for k in range(150):
                part = generate.draw_term(base, form, protocol, random, "kinked" if k % 10 == 0 else "single")
                seen.add((base, part.invariant, part.law))
                strange = generate.draw_term(base, form, protocol, random, "unusual")
                self.assertIn((strange.invariant, strange.law), [("I1", "logarithm"), ("I2", "inverse_langevin")])
        self.assertFalse({(base, "I1", "linear") for base in bases.BASES} & seen)
        self.assertFalse({("mooney_rivlin", "I2", "linear"), ("hgo", "diagonal", "exponential_square")} & seen)
        self.assertFalse({(base, *strange) for base in bases.BASES
                          for strange in (("I1", "logarithm"), ("I2", "inverse_langevin"))} & seen)
        self.assertIn(("neo_hooke", "I2", "linear"), seen)
        self.assertIn(("gho", "diagonal", "exponential_square"), seen)
        self.assertTrue({law for _, _, law in seen} >= set(laws.PARAMETERS) - {"linear"})
        self.assertTrue({invariant for base, invariant, _ in seen if base == "gho"} == set(generate.OF_TISSUE))

    def test_an_effect_that_does_not_grow_in_proportion_is_dialled_too(self):
        form = bases.Form((Part("I1", "linear", {"mu": 100.0}),), (bases.Free(0, "mu", 0.1, 1e4, True),))
        protocol = [Curve("u", "uniaxial_nominal", np.linspace(1, 2, 15)), Curve("e", "equibiaxial", np.linspace(1, 2, 15))]
        bare, sd = observe(protocol, form.material), np.full(30, 2.0)

        def readings(amount):
            return bare + observe(protocol, [Part("I2", "cubic", {"k": amount**3})])

        for target in (25, 400):
            amount = dial(readings, lambda y: sd, form, protocol, target, 10.0, np.random.default_rng(1))
            found = misfit(form, protocol, readings(amount), sd, np.random.default_rng(2))
            self.assertAlmostEqual(found / target, 1, delta=0.031)
        with self.assertRaises(generate.Unreachable):
            dial(readings, lambda y: sd, form, protocol, 400, 0.1, np.random.default_rng(1))

    def test_a_rig_error_is_of_a_channel_that_there_is(self):
        random, kinds = np.random.default_rng(6), set()
        form = bases.draw("gho", random)
        protocol = bases.curves("gho", form, random)
        y = observe(protocol, form.material)
        for _ in range(200):
            error = generate.draw_rig_error(protocol, y, random)
            kinds.add(error.kind)
            self.assertLess(error.channel, protocol[error.curve].channels)
            self.assertGreater(np.max(np.abs(observe(protocol, form.material, error) - y)), 0)
        self.assertEqual(kinds, set(generate.RIG_ERRORS))


class CompleteLaws(unittest.TestCase):
    def test_every_law_makes_a_case_from_nothing(self):
        with tempfile.TemporaryDirectory() as place:
            out = pathlib.Path(place)
            for law in complete_laws.LAWS:
                name = complete_laws.make(law, 0.03, 0, SEED, out)
                experiment = json.loads((out / "cases" / name / "experiment.json").read_text())
                self.assertEqual(experiment["discovery"], {"from_nothing": True})
                model = "hgo" if law in ("Holzapfel", "axial and circumferential") else "neo_hooke"
                self.assertEqual(list(experiment["models"]), [model])
                truth = case_files.open_truth(out / "cases" / name, out / "truths")
                self.assertTrue(np.all(np.diff(truth["path"]["energy"][:15]) > 0), law)
                self.assertTrue(0 < truth["oracle_error"] < 0.1, law)
                for test, entry in experiment["tests"].items():
                    for channel, noise in entry["data"]["noise"].items():
                        names = list(entry["data"]["columns"])
                        column = table(out / "cases" / name / f"{test}.csv")[:, names.index(channel)]
                        self.assertGreater(noise["absolute"], 0.02 * np.max(np.abs(column)), law)

    def test_the_path_that_is_judged_was_never_shown(self):
        rubber = complete_laws.curves("Isihara", [Part("I1", "linear", {"mu": 1.0})], np.random.default_rng(1))
        l1, l2 = complete_laws.unseen(rubber)
        self.assertTrue(np.all(l2 == 1) and np.all(l1 > 1))
        fibres = [Part("axial", "quadratic", {"k": 1.0})]
        shown = complete_laws.curves("axial and circumferential", fibres, np.random.default_rng(1))
        ratios = (complete_laws.unseen(shown)[0] - 1) / (complete_laws.unseen(shown)[1] - 1)
        for curve in (one for one in shown if one.kind == "sheet"):
            a, b = stretches(Curve("", "sheet", curve.load[1:], most=curve.most))
            self.assertGreater(np.min(np.abs(ratios - (a[-1] - 1) / (b[-1] - 1))), 0.1)


unittest.main()
