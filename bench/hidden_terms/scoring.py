# SPDX-License-Identifier: Apache-2.0
"""Opens the sealed truths, once every verdict is on disk, and counts how often the verdicts are right."""
import pathlib
import typing

import numpy as np

from . import case_files, verdict
from .figures import Figure, calibration_error, median, share
from .fitting import slope_error

Json = typing.Dict[str, typing.Any]
LAMBDAS = (25, 60, 150, 400)
WITHIN_NOISE = 3.0  # of |r|²: as much more than a fit of the true form as cannot be told from noise
SEPARABLE = 9.0  # least |r|² that a term of another invariant leaves, of data in which the two can be told apart


class NotYet(Exception):
    """A verdict is missing: truths stay sealed."""


class Judged(typing.NamedTuple):
    """A case: its truth, what was said of it, and of each hidden term that was found first: the ratio of its error of ψ' to
    the oracle's, whether its law is right or within noise of the right one, and the share of x at which the true ψ' lies
    in the stated band (of terms that the base cannot shift)."""
    name: str
    truth: Json
    said: verdict.Verdict
    ratios: typing.List[float]
    laws_right: typing.List[bool]
    covered: typing.List[float]

    @property
    def hidden(self) -> typing.Tuple[str, ...]:
        return tuple(sorted(term["invariant"] for term in self.truth["terms"]))

    @property
    def right_first(self) -> bool:
        """The likeliest explanation has a term that is missing."""
        return bool(set(self.hidden) & set(self.said.first.invariants()))

    @property
    def in_set(self) -> bool:
        return any(set(self.hidden) & set(one.invariants()) for one in self.said.explanations)

    @property
    def too_many(self) -> bool:
        return len(self.said.first.terms) > len(self.hidden)

    @property
    def separable(self) -> bool:
        return bool(self.truth["rivals"]) and min(self.truth["rivals"].values()) >= SEPARABLE


class Compared(typing.NamedTuple):
    """ratio: error of ψ' over that of the oracle; right: law right or within noise; covered: share of x in the band."""
    ratio: float
    right: bool
    covered: float


def compare(term: Json, found: typing.Sequence[verdict.Found]) -> Compared:
    """A hidden term and what was found in its invariant, over the x that both reach; terms of one invariant add up. What
    reaches less than half as far says nothing of ψ'."""
    grid, true = np.array(term["x"]), np.array(term["slope"])
    ends = [one.x[-1] for one in found if len(one.x)]
    inside = grid <= 1.001 * min(ends) if ends else np.ones(len(grid), bool)
    same = len(found) == 1 and found[0].law == term["law"]
    if np.count_nonzero(inside) < len(grid) / 2:
        return Compared(float("inf"), same, 0.0)
    grid, true = grid[inside], true[inside]
    total = np.asarray(sum(one.at(grid) for one in found))
    ratio = slope_error(total, true, term["free_level"]) / max(term["oracle_error"], 1e-12)
    if not all(len(one.x) for one in found):
        return Compared(ratio, same or ratio <= 2, float("nan"))
    low, high = (sum(np.interp(grid, one.x, side) for one, side in zip(found, sides)) for sides in (
        [one.low for one in found], [one.high for one in found]))
    level = float(np.mean(total - true)) if term["free_level"] else 0.0
    within = (true + level >= low) & (true + level <= high)
    return Compared(ratio, same or ratio <= 2 or bool(np.all(within)), float(np.mean(within)))


def judge(case: pathlib.Path, truths: pathlib.Path, results: pathlib.Path) -> Judged:
    truth = case_files.open_truth(case, truths)
    said = verdict.read_file(results / case.name / "result.json")
    # Only where the noise is stated is |r|² of both in the same unit.
    fits = bool(truth["stated"]) and said.chi2_after <= truth.get("oracle_chi2", 0.0) + WITHIN_NOISE and (
        len(said.terms) <= len(truth["terms"]))
    compared = []
    for term in truth["terms"]:
        found = [one for one in said.terms if one.invariant == term["invariant"]]
        if found and term["invariant"] in said.first.invariants():
            compared.append((term, compare(term, found)))
    return Judged(case.name, truth, said, [one.ratio for _, one in compared], [one.right or fits for _, one in compared],
                  [one.covered for term, one in compared if not term["free_level"] and np.isfinite(one.covered)])


def judge_all(cases: pathlib.Path, truths: pathlib.Path, results: pathlib.Path) -> typing.List[Judged]:
    """Raises NotYet while a verdict is missing, case_files.Tampered where a truth does not fit its seal."""
    folders = sorted(seal.parent for seal in cases.glob(f"*/{case_files.SEAL}"))
    missing = [case.name for case in folders if not (results / case.name / "result.json").exists()]
    if missing:
        raise NotYet(f"{len(missing)} of {len(folders)} cases have no verdict yet, {missing[0]} among them")
    return [judge(case, truths, results) for case in folders]


def figures(all_cases: typing.Sequence[Judged]) -> typing.List[Figure]:
    """The rows of the table."""
    def of(what: str, target: float = 0) -> typing.List[Judged]:
        return [one for one in all_cases if one.truth["what"] == what and target in (0, one.truth["lambda"])]

    def terms_said(one: Judged) -> bool:
        return one.said.says_terms

    def alarms(chosen: typing.Sequence[Judged]) -> str:
        return (f"verdict `discovered` {sum(one.said.name == 'discovered' for one in chosen)}, any alarm "
                f"{sum(one.said.detected for one in chosen)}")

    def split(name: str, chosen: typing.Sequence[Judged], yes: typing.Callable[[Judged], bool]) -> typing.List[Figure]:
        return [share(f"{name}, noise {'stated' if stated else 'not stated'}",
                      (yes(one) for one in chosen if one.truth["stated"] == stated)) for stated in (True, False)]

    nulls, main, rig = of("null"), of("single", 150), of("rig")
    found = [one for one in main if one.right_first]
    ratios = [ratio for one in found for ratio in one.ratios]
    rows = [share("something discovered under nothing", (terms_said(one) for one in nulls), 0.05, False,
                  alarms(nulls)),
            *split("something discovered under nothing", nulls, terms_said),
            share("invariant right first, Λ 150", (one.right_first for one in main), 0.90),
            share("invariant right in the set, Λ 150", (one.in_set for one in main), 0.97,
                  note=f"mean size of the set {np.mean([len(one.said.explanations) for one in main]):.2f}" if main else ""),
            share("law right or within noise of it, Λ 150, where the invariant is right",
                  (all(one.laws_right) for one in found if one.laws_right), 0.85,
                  note=f"the same law {exact(found)} of {len(found)}"),
            median("error of ψ' over the oracle's, median, Λ 150", ratios, 2.0,
                   note=f"at most twice the oracle's in {sum(r <= 2 for r in ratios)} of {len(ratios)}"),
            share("a false second term, Λ 150", (one.too_many for one in main if one.said.detected), 0.05, False),
            share("an error of the rig called a term", (terms_said(one) for one in rig), 0.03, False,
                  alarms(rig)),
            share("invariant right first where ψ' has a kink", (one.right_first for one in of("kinked"))),
            share("invariant right first where the law is of the other invariant", (one.right_first for one in of("unusual"))),
            share("two terms: both invariants right, no other", (one.said.first.invariants() == one.hidden for one in of("pair"))),
            share("two terms: one of them right first", (one.right_first for one in of("pair")))]
    for target in LAMBDAS:
        here = of("single", target)
        rows += [share(f"detected, Λ {target}", (one.said.detected for one in here)),
                 share(f"invariant right first, Λ {target}, where data can tell invariants apart",
                       (one.right_first for one in here if one.separable))]
        if target != 150:
            rows += [share(f"invariant right first, Λ {target}", (one.right_first for one in here)),
                     share(f"invariant right in the set, Λ {target}", (one.in_set for one in here))]
    rows += split("invariant right first, Λ 150", main, lambda one: one.right_first)
    detected = [one for target in LAMBDAS for one in of("single", target) if one.said.first.terms]
    if detected:
        stated = [sum(each.probability for each in one.said.explanations
                      if each.invariants() == one.said.first.invariants()) for one in detected]
        error = calibration_error(stated, [one.said.first.invariants() == one.hidden for one in detected])
        rows.append(Figure("calibration error of the probability of the invariants", error, error, error, len(detected),
                           note=f"mean stated {np.mean(stated):.2f}"))
    covered = [value for target in LAMBDAS for one in of("single", target) for value in one.covered]
    if covered:
        rows.append(Figure("true ψ' in the stated band, mean share of x", float(np.mean(covered)), float(np.min(covered)),
                           float(np.max(covered)), len(covered), note="least and most in brackets"))
    rows.append(share("no answer", (one.said.name == "failed" for one in all_cases), 0.0, False))
    return rows


def exact(found: typing.Sequence[Judged]) -> int:
    """Cases in which each hidden term is named with the law that it has."""
    return sum({(term["invariant"], term["law"]) for term in one.truth["terms"]} <= set(one.said.first.terms)
               for one in found)
