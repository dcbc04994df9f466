# SPDX-License-Identifier: Apache-2.0
"""What `tunica discover` said of a case, in the words of the generator.

An invariant is I1, I2, axial, circumferential, diagonal or another word of the program."""
import json
import pathlib
import typing

import numpy as np

from . import laws
from .laws import Array

Json = typing.Dict[str, typing.Any]

# Mechanisms of the catalogue that are terms of an energy: a verdict `named` may use their names, which come first then.
CATALOGUE = {"axial_fibres": ("axial", "exponential_square"), "second_invariant": ("I2", "linear"),
             "circumferential_fibres": ("circumferential", "exponential_square"),
             "matrix_stiffening": ("I1", "exponential"), "chain_extensibility": ("I1", "gent")}
NEAR_AN_AXIS = 10.0  # degrees


class Found(typing.NamedTuple):
    """A term: invariant, law, parameters, and its curve: x, ψ' and the band about it, k numbers each (kPa)."""
    invariant: str
    law: str
    parameters: typing.Dict[str, float]
    x: Array
    slope: Array
    low: Array
    high: Array

    def at(self, x: Array) -> Array:
        """ψ' at x: from the curve, or from the law where no curve was written."""
        if len(self.x):
            return np.asarray(np.interp(x, self.x, self.slope))
        return self.law_at(x)

    def law_at(self, x: Array) -> Array:
        """ψ' at x from the law."""
        return laws.slope(self.law, x, self.parameters)


class Explanation(typing.NamedTuple):
    """One member of the ambiguity set: its terms as (invariant, law), errors of the rig or what remembers the past, and
    its probability."""
    terms: typing.Tuple[typing.Tuple[str, str], ...]
    rig: typing.Tuple[str, ...]
    probability: float

    def invariants(self) -> typing.Tuple[str, ...]:
        return tuple(sorted(invariant for invariant, _ in self.terms))


class Verdict(typing.NamedTuple):
    """`explanations`: first what the program offers, where it offers terms, then the likeliest. `by_its_name`: the catalogue
    has a name for the term. `name` is `failed` where the program gave no answer."""
    name: str
    terms: typing.List[Found]
    explanations: typing.List[Explanation]
    chi2_after: float
    p_after: float
    by_its_name: bool = False

    @property
    def detected(self) -> bool:
        return self.name not in ("nothing_detected", "failed")

    @property
    def says_terms(self) -> bool:
        """Whether the energy is said to lack terms: nothing else is in the set, and at most the terms are open."""
        only_terms = bool(self.explanations) and all(one.terms and not one.rig for one in self.explanations)
        return self.name == "discovered" or (self.name == "indistinguishable" and only_terms) or (
            self.name == "named" and self.by_its_name)

    @property
    def first(self) -> Explanation:
        return self.explanations[0] if self.explanations else Explanation((), (), 0.0)


def invariant_of(entry: Json) -> str:
    """A diagonal family whose fitted angle is close to an axis is the family along that axis."""
    if entry["invariant"] != "fibre":
        return str(entry["invariant"])
    family = str(entry.get("family", "fibre"))
    theta = entry.get("parameters", {}).get("theta")
    if family == "diagonal" and theta is not None:
        angle = number(theta)
        return "axial" if angle <= NEAR_AN_AXIS else "circumferential" if angle >= 90 - NEAR_AN_AXIS else family
    return family


def number(entry: typing.Any) -> float:
    return float(entry["value"] if isinstance(entry, dict) else entry)


def _term(entry: Json) -> Found:
    curve = entry.get("curve") or {}
    x, slope = (np.array(curve.get(key) or [], float) for key in ("x", "slope"))
    low, high = (np.array(curve[key], float) if curve.get(key) else slope for key in ("low", "high"))
    values = {name: number(value) for name, value in (entry.get("parameters") or {}).items()}
    return Found(invariant_of(entry), str(entry.get("law", "")), values, x, slope, low, high)


def _explanation(entry: Json) -> Explanation:
    terms = [(invariant_of(term), str(term.get("law", ""))) for term in entry.get("terms") or []]
    rig = [*(entry.get("rig") or []), *(entry.get("memory") or [])]
    return Explanation(tuple(terms), tuple(rig), float(entry.get("probability") or 0.0))


def ordered(explanations: typing.List[Explanation]) -> typing.List[Explanation]:
    """Likeliest first: what the terms are functions of counts, whatever their laws, or which errors of the rig."""
    def kind(one: Explanation) -> typing.Tuple[typing.Tuple[str, ...], ...]:
        return one.invariants(), one.rig

    weight: typing.Dict[typing.Tuple[typing.Tuple[str, ...], ...], float] = {}
    for one in explanations:
        weight[kind(one)] = weight.get(kind(one), 0.0) + one.probability
    return sorted(explanations, key=lambda one: -weight[kind(one)])


def read(text: str) -> Verdict:
    """The answer in a result.json."""
    said: Json = json.loads(text)
    if "discovery" not in said:
        return Verdict("failed", [], [], float("nan"), float("nan"))
    said = said["discovery"]
    name = str(said["verdict"])
    terms = [_term(entry) for entry in said.get("terms") or []]
    explanations = [_explanation(entry) for entry in said.get("ambiguity_set") or []]
    offered = tuple((term.invariant, term.law) for term in terms)
    for k, one in enumerate(explanations):
        if terms and sorted(law for _, law in one.terms) == sorted(law for _, law in offered):
            explanations[k] = one._replace(terms=offered)  # members of the set have no angles; the terms have
            break
    explanations = ordered(explanations)
    if name == "discovered" and terms:
        own = next((one for one in explanations if one.terms == offered), Explanation(offered, (), 0.0))
        explanations = [own, *(one for one in explanations if one is not own)]
    mechanism = str((said.get("name_of_the_catalogue") or {}).get("id", ""))
    by_its_name = name == "named" and mechanism in CATALOGUE and any(
        reason["code"] == "name_explains" for reason in said.get("reasons") or [])
    if by_its_name:
        explanations.insert(0, Explanation((CATALOGUE[mechanism],), (), 0.0))
    after = [float("nan") if said.get(key) is None else float(said[key]) for key in ("chi2_after", "p_after")]
    return Verdict(name, terms, explanations, after[0], after[1], by_its_name)


def read_file(file: pathlib.Path) -> Verdict:
    return read(file.read_text())
