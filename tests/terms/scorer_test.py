#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scorer_test.py BENCH: made-up verdicts give the figures that were counted by hand."""
import json
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, sys.argv.pop())
from hidden_terms import case_files, complete_laws, figures, laws, scoring, verdict  # noqa: E402
from hidden_terms.bases import Form  # noqa: E402
from hidden_terms.deformation import Part  # noqa: E402
from hidden_terms.protocol import Curve, observe  # noqa: E402

GRID = np.linspace(0, 2, 41)
FIBRES = ("axial", "circumferential", "diagonal")


def truth_of(what, target=0, terms=(), stated=True, rivals=None):
    """Terms are (invariant, law, parameters); the oracle errs by 0.5 kPa."""
    return {"what": what, "base": "gho", "lambda": target, "noise": "white", "stated": stated, "rig": None, "oracle_chi2": 0,
            "rivals": rivals or {}, "terms": [
                {"invariant": invariant, "law": law, "parameters": values, "free_level": invariant == "I1",
                 "x": list(GRID), "slope": list(laws.slope(law, GRID, values)), "oracle_error": 0.5}
                for invariant, law, values in terms]}


def named(invariant, law):
    entry = {"invariant": "fibre" if invariant in FIBRES else invariant, "law": law}
    return {**entry, "family": invariant} if invariant in FIBRES else entry


def term_of(invariant, law, slope, band=0.1, parameters=None):
    return {**named(invariant, law), "name": "t", "parameters": parameters or {}, "curve": {
        "x": list(GRID), "slope": list(slope), "low": list(slope - band), "high": list(slope + band), "reach": [0, 2]}}


def said(name, sets=(), terms=()):
    """The sets hold (invariant, law) pairs or the names of rig errors."""
    entries = [{"rig": list(one), "probability": 0.5} if isinstance(one[0], str) else
               {"terms": [named(*term) for term in one], "probability": 0.9 / (k + 1)} for k, one in enumerate(sets)]
    return {"discovery": {"verdict": name, "terms": list(terms), "ambiguity_set": entries, "chi2_after": 10, "p_after": 0.5}}


NOTHING = said("nothing_detected")
CUBIC = ("I2", "cubic", {"k": 3.0})
CUBIC_SLOPE = 3 * GRID**2


class Folder(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.out = pathlib.Path(self.place.name)

    def tearDown(self):
        self.place.cleanup()

    def add(self, truth, answer, count=1):
        for _ in range(count):
            name = f"case{len(list((self.out / 'cases').glob('*'))) if (self.out / 'cases').exists() else 0:03d}"
            protocol = [Curve("u", "uniaxial_nominal", np.linspace(1, 2, 4))]
            y = observe(protocol, Form((Part("I1", "linear", {"mu": 10.0}),), ()).material)
            case_files.write_case(self.out / "cases", self.out / "truths", name, "neo_hooke", protocol, y, None, truth)
            if answer is not None:
                (self.out / "results" / name).mkdir(parents=True)
                (self.out / "results" / name / "result.json").write_text(json.dumps(answer))

    def judged(self):
        return scoring.judge_all(self.out / "cases", self.out / "truths", self.out / "results")

    def figure(self, name):
        found = [one for one in scoring.figures(self.judged()) if one.name == name]
        self.assertEqual(len(found), 1, name)
        return found[0]


class Figures(Folder):
    def test_truths_stay_sealed_until_every_verdict_is_there(self):
        self.add(truth_of("null"), NOTHING)
        self.add(truth_of("null"), None)
        for truth in (self.out / "truths").iterdir():
            truth.unlink()  # opening one would fail
        with self.assertRaises(scoring.NotYet):
            self.judged()

    def test_a_truth_that_was_changed_is_refused(self):
        self.add(truth_of("null"), NOTHING)
        truth = next((self.out / "truths").iterdir())
        truth.write_text(truth.read_text() + " ")
        with self.assertRaises(case_files.Tampered):
            self.judged()

    def test_nothing_and_rig(self):
        self.add(truth_of("null"), NOTHING, 6)
        self.add(truth_of("null"), said("discovered", [[("I2", "linear")]]), 2)
        self.add(truth_of("null"), said("unknown"))
        self.add(truth_of("null", stated=False), said("discovered", [[("I2", "linear")]]))
        self.add(truth_of("rig", 60), said("named", [["force_offset"]]), 3)
        self.add(truth_of("rig", 60), said("discovered", [[("axial", "cubic")]]))
        false = self.figure("something discovered under nothing")
        self.assertEqual((false.value, false.cases, false.passed()), (0.3, 10, False))
        self.assertIn("any alarm 4", false.note)
        self.assertEqual(self.figure("something discovered under nothing, noise not stated").value, 1)
        rig = self.figure("an error of the rig called a term")
        self.assertEqual((rig.value, rig.cases, rig.passed()), (0.25, 4, False))

    def test_invariants_first_in_the_set_and_too_many(self):
        hidden = truth_of("single", 150, [CUBIC], rivals={"I1": 50.0})
        close = truth_of("single", 150, [CUBIC], rivals={"I1": 2.0})
        self.add(hidden, said("discovered", [[("I2", "power")]]), 5)
        self.add(hidden, said("discovered", [[("I2", "cubic"), ("axial", "cubic")]]))
        self.add(close, said("indistinguishable", [[("I1", "cubic")], [("I2", "cubic")]]), 2)
        self.add(close, said("unknown", [[("axial", "cubic")]]))
        self.add(hidden, NOTHING)
        self.assertEqual(self.figure("invariant right first, Λ 150").value, 0.6)
        self.assertEqual(self.figure("invariant right in the set, Λ 150").value, 0.8)
        apart = self.figure("invariant right first, Λ 150, where data can tell invariants apart")
        self.assertAlmostEqual(apart.value, 6 / 7)
        self.assertAlmostEqual(self.figure("a false second term, Λ 150").value, 1 / 9)
        self.assertEqual(self.figure("detected, Λ 150").value, 0.9)
        self.assertEqual(self.figure("detected, Λ 60").cases, 0)

    def test_laws_and_slopes_against_the_oracle(self):
        hidden = truth_of("single", 150, [CUBIC])
        for law, slope, band, count in (("cubic", CUBIC_SLOPE + 3, 0.1, 1),     # the law itself, far off: ratio 6
                                        ("power", CUBIC_SLOPE + 0.75, 0.1, 2),  # within twice the oracle's error: 1.5
                                        ("power", CUBIC_SLOPE + 2, 2.5, 1),     # within its own band: 4
                                        ("power", CUBIC_SLOPE + 2, 0.1, 1)):    # wrong
            self.add(hidden, said("discovered", [[("I2", law)]], [term_of("I2", law, slope, band)]), count)
        right = self.figure("law right or within noise of it, Λ 150, where the invariant is right")
        self.assertEqual((right.value, right.cases), (0.8, 5))
        self.assertIn("the same law 1 of 5", right.note)
        ratio = self.figure("error of ψ' over the oracle's, median, Λ 150")
        self.assertAlmostEqual(ratio.value, 4)
        self.assertFalse(ratio.passed())
        self.assertIn("at most twice the oracle's in 2 of 5", ratio.note)

    def test_a_law_that_fits_as_well_as_the_true_form_is_within_noise(self):
        wrong = said("discovered", [[("I2", "power")]], [term_of("I2", "power", CUBIC_SLOPE + 2)])  # |r|² 10
        for stated, oracle in ((True, 7.5), (True, 6.5), (False, 7.5)):
            self.add({**truth_of("single", 150, [CUBIC], stated), "oracle_chi2": oracle}, wrong)
        self.assertEqual([one.laws_right for one in self.judged()], [[True], [False], [False]])

    def test_two_terms_and_kinks(self):
        both = truth_of("pair", 400, [CUBIC, ("axial", "quadratic", {"k": 2.0})])
        self.add(both, said("discovered", [[("axial", "power"), ("I2", "power")]]), 2)
        self.add(both, said("discovered", [[("axial", "power")]]))
        self.add(both, said("discovered", [[("I1", "power"), ("diagonal", "power")]]))
        kinked = truth_of("kinked", 60, [("axial", "late", {"k": 5.0, "x0": 1.0})])
        self.add(kinked, said("discovered", [[("axial", "spline")]]), 3)
        self.add(kinked, said("discovered", [[("I1", "power")]]))
        self.assertEqual(self.figure("two terms: both invariants right, no other").value, 0.5)
        self.assertEqual(self.figure("two terms: one of them right first").value, 0.75)
        self.assertEqual(self.figure("invariant right first where ψ' has a kink").value, 0.75)

    def test_no_answer_is_counted_and_misses_its_bar(self):
        self.add(truth_of("null"), NOTHING)
        self.add(truth_of("null"), {})
        failed = self.figure("no answer")
        self.assertEqual((failed.value, failed.passed()), (0.5, False))


class Comparison(unittest.TestCase):
    def found(self, invariant, law, slope):
        return verdict.read(json.dumps(said("discovered", [[(invariant, law)]], [term_of(invariant, law, slope)]))).terms

    def test_a_level_that_the_base_can_take_does_not_count(self):
        entry = truth_of("single", 150, [("I1", "cubic", {"k": 3.0})])["terms"][0]
        ratio, right, _ = scoring.compare(entry, self.found("I1", "power", CUBIC_SLOPE + 40))
        self.assertAlmostEqual(ratio, 0)
        self.assertTrue(right)
        entry["free_level"] = False
        self.assertAlmostEqual(scoring.compare(entry, self.found("I1", "power", CUBIC_SLOPE + 40))[0], 80)

    def test_terms_of_one_invariant_add_up(self):
        entry = truth_of("single", 150, [CUBIC])["terms"][0]
        halves = self.found("I2", "power", 0.25 * CUBIC_SLOPE) + self.found("I2", "gent", 0.75 * CUBIC_SLOPE)
        self.assertAlmostEqual(scoring.compare(entry, halves)[0], 0)

    def test_beyond_the_found_curve_nothing_is_compared(self):
        entry = truth_of("single", 150, [CUBIC])["terms"][0]
        found = self.found("I2", "power", CUBIC_SLOPE)
        for points, ratio in ((31, 0), (11, np.inf)):
            slope = CUBIC_SLOPE[:points]
            short = [found[0]._replace(x=GRID[:points], slope=slope, low=slope, high=slope)]
            self.assertAlmostEqual(scoring.compare(entry, short).ratio, ratio)
        self.assertFalse(scoring.compare(entry, short).right)

    def test_the_share_of_x_in_the_band(self):
        entry = truth_of("single", 150, [CUBIC])["terms"][0]
        off = np.where(GRID < 1, 0.05, 0.5)  # 20 of 41 points lie within the band of 0.1
        self.assertAlmostEqual(scoring.compare(entry, self.found("I2", "power", CUBIC_SLOPE + off)).covered, 20 / 41)

    def test_a_band_is_shifted_with_the_level_that_the_base_can_take(self):
        entry = truth_of("single", 150, [("I1", "cubic", {"k": 3.0})])["terms"][0]
        found = self.found("I1", "power", CUBIC_SLOPE + 40)
        self.assertEqual(scoring.compare(entry, found).covered, 1)
        entry["free_level"] = False
        self.assertEqual(scoring.compare(entry, found).covered, 0)


class Verdicts(unittest.TestCase):
    def test_a_diagonal_family_near_an_axis_is_along_it(self):
        for theta, family in ((4, "axial"), (45, "diagonal"), (86, "circumferential")):
            term = term_of("diagonal", "cubic", CUBIC_SLOPE, parameters={"theta": {"value": theta, "unit": "deg"}})
            read = verdict.read(json.dumps(said("discovered", [[("diagonal", "cubic")]], [term])))
            self.assertEqual(read.first.invariants(), (family,))

    def test_a_name_of_the_catalogue_that_is_a_term_comes_first(self):
        answer = said("named", [[("I2", "linear")]])
        answer["discovery"].update(reasons=[{"code": "name_explains", "text": ""}],
                                   name_of_the_catalogue={"id": "axial_fibres", "chi2": 80})
        self.assertEqual(verdict.read(json.dumps(answer)).first.terms, (("axial", "exponential_square"),))
        answer["discovery"]["verdict"] = "discovered"
        self.assertEqual(verdict.read(json.dumps(answer)).first.terms, (("I2", "linear"),))

    def test_whether_the_energy_is_said_to_lack_terms(self):
        term, rig = [("I2", "linear")], ["force_offset"]
        for answer, says in ((said("discovered", [term]), True), (said("indistinguishable", [term, [("I1", "cubic")]]), True),
                             (said("indistinguishable", [term, rig]), False), (said("named", [rig]), False),
                             (said("unknown", [term]), False), (NOTHING, False)):
            self.assertEqual(verdict.read(json.dumps(answer)).says_terms, says)
        drift = said("indistinguishable", [term])
        drift["discovery"]["ambiguity_set"].append({"memory": ["signal_drift"], "probability": 0.1})
        self.assertFalse(verdict.read(json.dumps(drift)).says_terms)

    def test_the_likeliest_comes_first_whatever_the_order_in_the_file(self):
        answer = said("named", [[("I2", "linear")], ["force_offset"]])
        answer["discovery"]["ambiguity_set"][0]["probability"] = 0.1
        self.assertEqual(verdict.read(json.dumps(answer)).first.rig, ("force_offset",))
        self.assertFalse(verdict.read(json.dumps(answer)).says_terms)
        several = said("indistinguishable", [[("axial", "cubic")], [("I2", "linear")], [("I2", "gent")]])
        for entry, probability in zip(several["discovery"]["ambiguity_set"], (0.4, 0.3, 0.3)):
            entry["probability"] = probability
        self.assertEqual(verdict.read(json.dumps(several)).first.terms, (("I2", "linear"),))

    def test_terms_that_are_offered_come_before_likelier_ones(self):
        answer = said("discovered", [[("I2", "gent")], [("I2", "linear")]], [term_of("I2", "linear", CUBIC_SLOPE)])
        read = verdict.read(json.dumps(answer))
        self.assertEqual(read.first.terms, (("I2", "linear"),))
        self.assertEqual(len(read.explanations), 2)

    def test_no_discovery_is_no_answer(self):
        self.assertEqual(verdict.read("{}").name, "failed")
        self.assertFalse(verdict.read("{}").detected)


class Shares(unittest.TestCase):
    def test_wilson(self):
        np.testing.assert_allclose(figures.wilson(8, 10), (0.4902, 0.9433), atol=1e-4)
        self.assertEqual(figures.wilson(0, 0), (0.0, 1.0))
        self.assertEqual((figures.wilson(0, 6)[0], figures.wilson(6, 6)[1]), (0.0, 1.0))

    def test_bars_and_chance(self):
        few, many = figures.share("", [True] * 8 + [False] * 2, 0.9), figures.share("", [True] * 80 + [False] * 20, 0.9)
        self.assertEqual([one.passed() for one in (few, many)], [False, False])
        self.assertEqual([one.missed_by_more_than_chance() for one in (few, many)], [False, True])
        self.assertTrue(figures.share("", [], 0.9).passed())
        self.assertIn("| 0.800 (0.711–0.867) | ≥ 0.9 ✗ | 100 |", many.row())

    def test_a_table_has_what_was_counted_and_what_has_a_bar(self):
        text = figures.table("head", [figures.share("counted", [True]), figures.share("not counted", []),
                                      figures.share("bar", [], 0.9)])
        self.assertIn("| counted | 1.000", text)
        self.assertNotIn("not counted", text)
        self.assertIn("| bar | – | – | 0 |", text)

    def test_a_median_and_its_interval(self):
        found = figures.median("", range(1, 101), 2)
        self.assertEqual(found.value, 50.5)
        self.assertEqual((found.low, found.high), (41, 60))

    def test_stated_probabilities_that_are_too_high(self):
        self.assertAlmostEqual(figures.calibration_error([0.9] * 10, [True] * 5 + [False] * 5, 1), 0.4)
        self.assertAlmostEqual(figures.calibration_error([0.5] * 10, [True] * 5 + [False] * 5, 1), 0)


class CompleteLaws(unittest.TestCase):
    def setUp(self):
        self.l1, self.l2 = np.linspace(1.1, 1.5, 5), np.ones(5)
        parts = [Part("I1", "linear", {"mu": 10.0}), Part("diagonal", "exponential_square",
                                                          {"k1": 5.0, "k2": 1.0, "theta": 40.0})]
        self.truth = {"law": "Holzapfel", "noise": 0.01, "oracle_error": 0.004,
                      "terms": [{"invariant": p.invariant, "law": p.law, "parameters": p.values} for p in parts],
                      "path": {"circumferential": list(self.l1), "axial": list(self.l2),
                               "energy": list(complete_laws.energy(parts, self.l1, self.l2))}}

    def judge(self, *terms):
        answer = {"discovery": {"verdict": "discovered", "terms": [
            {**named(invariant, law), "parameters": {key: {"value": value} for key, value in values.items()}}
            for invariant, law, values in terms]}}
        return complete_laws.judge(self.truth, verdict.read(json.dumps(answer)))

    def test_the_law_itself(self):
        found = self.judge(("diagonal", "exponential_square", {"k1": 5.0, "k2": 1.0, "theta": 40.0}),
                           ("I1", "linear", {"mu": 10.0}))
        self.assertEqual((found.exact, found.invariants), (True, True))
        self.assertLess(found.error, 1e-12)

    def test_another_law_of_the_same_invariants(self):
        found = self.judge(("I1", "linear", {"mu": 11.0}), ("diagonal", "cubic", {"k": 6.0, "theta": 40.0}))
        self.assertEqual((found.exact, found.invariants), (False, True))
        self.assertGreater(found.error, 0.03)

    def test_a_modulus_that_is_a_tenth_too_large(self):
        found = self.judge(("I1", "linear", {"mu": 11.0}), ("diagonal", "exponential_square",
                                                           {"k1": 5.5, "k2": 1.0, "theta": 40.0}))
        self.assertAlmostEqual(found.error, 0.1)

    def test_nothing_found_is_no_energy(self):
        found = self.judge()
        self.assertEqual((found.exact, found.invariants, found.error), (False, False, np.inf))
        self.assertIn("| Holzapfel | 1% | 1 | 0.00", complete_laws.table("", [found]))
        self.assertIn("| inf% | 0.4% |", complete_laws.table("", [found]))


unittest.main()
