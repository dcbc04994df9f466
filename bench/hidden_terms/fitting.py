# SPDX-License-Identifier: Apache-2.0
"""Refits: what a base model leaves of a hidden effect (Λ), how large the effect has to be, and what an oracle finds."""
import typing
import warnings

import numpy as np
from scipy.optimize import least_squares

from . import laws
from .bases import Form, with_term
from .deformation import Material, Part
from .laws import Array
from .protocol import Curve, observe, reach


class Fit(typing.NamedTuple):
    """Unknowns as the form sees them (p), their material, χ², and the Jacobian of the whitened readings (n × p)."""
    unknowns: Array
    material: Material
    chi2: float
    jacobian: Array


class Unreachable(Exception):
    """No plausible amplitude gives the Λ that was asked for."""


def refit(form: Form, protocol: typing.Sequence[Curve], y: Array, sd: Array, start: typing.Optional[Array] = None) -> Fit:
    """The form's least-squares fit to readings y with standard deviations sd (n numbers each)."""
    low, high = form.limits()
    begin = np.clip(form.start() if start is None else start, low + 1e-6 * (high - low), high - 1e-6 * (high - low))

    def left(unknowns: Array) -> Array:
        try:
            r = (observe(protocol, form.at(unknowns)) - y) / sd
        except ArithmeticError:
            return np.full_like(y, 1e3)
        return np.clip(np.nan_to_num(r, nan=1e4, posinf=1e4, neginf=-1e4), -1e4, 1e4)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # overflow far from the minimum
        found = least_squares(left, begin, bounds=(low, high), x_scale="jac", xtol=1e-8, ftol=1e-7, max_nfev=60)
    return Fit(found.x, form.at(found.x), 2 * found.cost, found.jac)


def best_of(form: Form, protocol: typing.Sequence[Curve], y: Array, sd: Array, starts: typing.Sequence[Array]) -> Fit:
    """The best refit of several starts."""
    return min((refit(form, protocol, y, sd, start) for start in starts), key=lambda fit: fit.chi2)


def other_starts(form: Form, random: np.random.Generator, count: int) -> typing.List[Array]:
    """The form's own start, and `count` that lie about it."""
    here = form.start()
    spread = np.array([0.7 if f.log else 0.2 * max(abs(h), 0.05) for f, h in zip(form.free, here)])
    return [here, *(here + spread * random.standard_normal(len(here)) for _ in range(count))]


def misfit(form: Form, protocol: typing.Sequence[Curve], y: Array, sd: Array, random: np.random.Generator) -> float:
    """Λ of readings without noise: |r|² of the refitted base in noise units, the best of three starts."""
    return best_of(form, protocol, y, sd, other_starts(form, random, 2)).chi2


def dial(readings: typing.Callable[[float], Array], noise: typing.Callable[[Array], Array], form: Form,
         protocol: typing.Sequence[Curve], target: float, most: float, random: np.random.Generator) -> float:
    """The amplitude at which Λ is `target` within 3 %: bisection in its logarithm, steps by Λ ∝ amplitude² first.

    `most` bounds it, as a factor on the amplitude that the caller starts from; readings(a) are without noise. Refits
    start from the last one; what ends the search is checked from other starts."""
    last = form.start()

    def at(amplitude: float) -> float:
        nonlocal last
        y = readings(amplitude)
        found = refit(form, protocol, y, noise(y), last)
        last = found.unknowns
        return found.chi2

    if at(most) < target:
        raise Unreachable
    low, high = 0.0, most
    amplitude, last = most / 4, form.start()
    for _ in range(40):
        found = at(amplitude)
        if abs(found / target - 1) < 0.03:
            y = readings(amplitude)
            found = min(found, misfit(form, protocol, y, noise(y), random))
            if abs(found / target - 1) < 0.03:
                return amplitude
        low, high = (amplitude, high) if found < target else (low, amplitude)
        guess = amplitude * np.sqrt(target / max(found, 1e-6))
        inside = low < guess < high
        amplitude = float(guess) if inside else float(np.sqrt(max(low, high * 1e-3) * high))
    raise Unreachable


FLEXIBLE = {"I1": ("exponential", "power"), "I2": ("exponential", "power"), "axial": ("exponential_square",),
            "circumferential": ("exponential_square",), "diagonal": ("exponential_square",)}


def rivals(form: Form, protocol: typing.Sequence[Curve], y: Array, sd: Array, truth: Part,
           invariants: typing.Sequence[str]) -> typing.Dict[str, float]:
    """|r|² that one term of another invariant leaves of readings without noise: how far the data can tell them apart."""
    left = {}
    for invariant in invariants:
        if invariant == truth.invariant:
            continue
        found = []
        for law in FLEXIBLE[invariant]:
            part = Part(invariant, law, {"theta": 45.0} if invariant == "diagonal" else {})
            span = reach(protocol, form.material, part)
            shape = laws.draw(law, span, np.random.default_rng(0))
            end = float(laws.slope(law, np.array([span]), shape)[0])
            shape[laws.PARAMETERS[law][0]] = 0.1 * float(np.max(np.abs(y))) / max(end, 1e-9)
            rival = with_term(form, part._replace(values={**part.values, **shape}), span)
            # A diagonal family within 15° of an axis would be the family along that axis.
            free = [f._replace(low=15.0, high=75.0) if f.part == len(form.material) and f.name == "theta" else f
                    for f in rival.free]
            rival = rival._replace(free=tuple(free))
            starts = [rival.start()]
            if invariant == "diagonal" and "kappa" in form.material[1].values:
                starts.append(_changed_places(rival))
            found.append(best_of(rival, protocol, y, sd, starts).chi2)
        left[invariant] = round(min(found), 2)
    return left


def _changed_places(rival: Form) -> Array:
    """A start at which the added family is that of the base, and the base's own is scattered into a matrix."""
    base, added = rival.material[1], rival.material[-1]
    swapped = [*rival.material]
    swapped[1] = base._replace(values={**base.values, "k1": 0.3 * base.values["k1"], "kappa": 0.32})
    swapped[-1] = added._replace(values={name: base.values[name] for name in added.values})
    return rival._replace(material=tuple(swapped)).start()


def slope_error(found: Array, true: Array, free_level: bool) -> float:
    """Root of the mean square of ψ' found less ψ' true, on one grid of x. With a free level their constant difference
    does not count: the base has a term that is linear in the same invariant, which takes or gives it."""
    difference = np.asarray(found) - np.asarray(true)
    if free_level:
        difference = difference - np.mean(difference)
    return float(np.sqrt(np.mean(difference**2)))
