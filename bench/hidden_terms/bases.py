# SPDX-License-Identifier: Apache-2.0
"""Base models: their terms, what a fit may change in them, and parameters drawn from published ranges."""
import typing

import numpy as np

from . import laws, protocol
from .deformation import Material, Part
from .laws import Array


class Free(typing.NamedTuple):
    """A parameter that a fit changes: which part, which value, bounds, and whether the fit sees its logarithm."""
    part: int
    name: str
    low: float
    high: float
    log: bool


class Form(typing.NamedTuple):
    """A material and what of it is unknown: p entries of `free` are the unknowns of a fit."""
    material: typing.Tuple[Part, ...]
    free: typing.Tuple[Free, ...]

    def at(self, unknowns: Array) -> Material:
        """The material with unknowns (p numbers, as the fit sees them) in their places."""
        values = [dict(part.values) for part in self.material]
        for free, number in zip(self.free, unknowns):
            values[free.part][free.name] = float(np.exp(number)) if free.log else float(number)
        return [part._replace(values=own) for part, own in zip(self.material, values)]

    def start(self) -> Array:
        """The unknowns of the material as it is, just inside their bounds."""
        seen = np.array([self.material[f.part].values[f.name] for f in self.free])
        return np.array([self._seen(f, np.clip(v, f.low, f.high)) for f, v in zip(self.free, seen)])

    def limits(self) -> typing.Tuple[Array, Array]:
        return (np.array([self._seen(f, f.low) for f in self.free]), np.array([self._seen(f, f.high) for f in self.free]))

    @staticmethod
    def _seen(free: Free, value: float) -> float:
        return float(np.log(value)) if free.log else float(value)


def with_term(form: Form, part: Part, reach: float) -> Form:
    """The form with one more term, all of whose parameters are unknown."""
    index = len(form.material)
    free = [Free(index, name, *laws.bounds(part.law, name, reach), True) for name in laws.PARAMETERS[part.law]]
    if part.invariant == "diagonal":
        free.append(Free(index, "theta", 1.0, 89.0, False))
    return Form((*form.material, part), (*form.free, *free))


BOUNDS = {"mu": (0.1, 500.0), "k1": (0.01, 1000.0), "k2": (0.001, 100.0), "theta": (0.0, 90.0), "kappa": (0.0, 1 / 3)}
BASES = ("neo_hooke", "mooney_rivlin", "gho", "hgo")
RUBBERS = ("neo_hooke", "mooney_rivlin")


def between_log(random: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def draw(base: str, random: np.random.Generator) -> Form:
    """Rubber: moduli of unfilled and filled vulcanisates (Treloar 1944; Mooney 1940), c01 a twentieth to a third of c10.
    Arteries: Holzapfel, Gasser, Ogden 2000, table 1; Gasser, Ogden, Holzapfel 2006; Canales et al. 2023, table 6."""
    if base in RUBBERS:
        first = Part("I1", "linear", {"mu": round(between_log(random, 150, 700), 1)})
        if base == "neo_hooke":
            return Form((first,), (Free(0, "mu", 0.1, 1e5, True),))
        second = Part("I2", "linear", {"mu": round(first.values["mu"] * between_log(random, 0.05, 0.33), 1)})
        return Form((first, second), (Free(0, "mu", 0.0, 2e4, False), Free(1, "mu", 0.0, 2e4, False)))
    matrix = Part("I1", "linear", {"mu": round(between_log(random, 5, 30), 2)})
    values = {"k1": round(between_log(random, 5, 50), 2), "k2": round(between_log(random, 0.2, 3), 3),
              "theta": round(random.uniform(35, 55), 1)}
    if base == "gho":
        values["kappa"] = round(random.uniform(0.05, 0.23), 3)
    free = [Free(0, "mu", *BOUNDS["mu"], True)]
    free += [Free(1, name, *BOUNDS[name], name in ("k1", "k2")) for name in values]
    return Form((matrix, Part("diagonal", "exponential_square", values)), tuple(free))


def curves(base: str, form: Form, random: np.random.Generator) -> typing.List[protocol.Curve]:
    return protocol.rubber(random) if base in RUBBERS else protocol.tissue(form.material, random)
