# SPDX-License-Identifier: Apache-2.0
"""One run of an experiment as functions of its parameters, for optimisers and samplers of others."""
from typing import NamedTuple, Optional

import numpy

from . import _core
from .errors import EvaluationError, InputError
from .library import read


class Evaluation(NamedTuple):
    """One point. `status` is "ok", "infeasible" (a constraint is violated by `violation`) or "failed"; of a failed
    point only the reason is there."""
    status: str
    reason: str
    violation: float = 0.0
    objective: float = numpy.inf
    per_test: Optional[dict] = None
    residuals: Optional[numpy.ndarray] = None
    jacobian: Optional[numpy.ndarray] = None


def _beyond(name, value, low, high, unit):
    return f"parameter '{name}' is {value:.17g}, outside its bounds {low:g} … {high:g}{'' if unit == '1' else ' ' + unit}"


class Problem:
    """minimise Σ_b w_b ρ_b(‖r_b(p)‖²) over the parameters p between their bounds.

    Functions take a vector of the parameters, in the order of `names`. Without more words they are values in base
    units; with coordinates="unit" they are those of the unit box that tunica's own optimisers search, in which a
    logarithmic parameter is a logarithm. Functions are pure and may be called from several threads.

        problem = tunica.Problem("experiment.json")
        scipy.optimize.least_squares(problem.residuals, problem.initial, problem.jacobian, bounds=problem.bounds)

    residuals() are scaled by the weights of their blocks, so that their sum of squares is the objective wherever the
    objective is a sum of squares ("standardised_quadratic" and "least_squares").

    Beyond a bound nothing is evaluated: evaluate() says "failed" and which parameter it was, objective() is infinite,
    log_likelihood() −infinity, and the other functions raise EvaluationError. No value is moved to its bound.
    """

    def __init__(self, experiment, run=None, *, base=None, coordinates="parameters"):
        if coordinates not in ("parameters", "unit"):
            raise ValueError(f"coordinates: found {coordinates!r}, expected 'parameters' or 'unit'")
        self._problem = _core.Problem(read(experiment, base)._loaded, run)
        self._unit = coordinates == "unit"
        self._about = self._problem.parameters
        self._weights = numpy.concatenate([numpy.full(block["size"], numpy.sqrt(block["weight"]))
                                           for block in self._problem.blocks] or [numpy.empty(0)])
        #: name of the run, "gho/lm"
        self.run = self._problem.label
        #: names of the tests
        self.tests = list(self._problem.tests)
        #: names of the free parameters: the order of every vector
        self.names = [about["name"] for about in self._about]
        #: their base units
        self.units = [about["unit"] for about in self._about]
        #: what was measured: dictionaries with test, channel, unit, measured, abscissa, fitted, offset, weight, and the
        #: noise of the fitted rows: sigma, its noise_origin, and correlation with the row before
        self.channels = self._problem.channels
        #: blocks of residuals: offset, size, weight and loss, "quadratic" or "root"
        self.blocks = self._problem.blocks
        #: whether derivatives are exact; else predictions are differenced
        self.exact = self._problem.exact

    def _vector(self, of):
        values = numpy.array([of(about) for about in self._about])
        return self._problem.to_unit(values) if self._unit else values

    @property
    def initial(self):
        """Where a search starts."""
        return self._vector(lambda about: about["initial"])

    @property
    def bounds(self):
        """(lower, upper), two vectors."""
        return self._vector(lambda about: about["min"]), self._vector(lambda about: about["max"])

    def values(self, x):
        """{name: value in base units} of a vector."""
        return dict(zip(self.names, self._parameters(x).tolist()))

    def vector(self, values):
        """The vector of {name: value}; parameters that are not named have their initial value."""
        known = dict(zip(self.names, (about["initial"] for about in self._about)))
        unknown = [name for name in values if name not in known]
        if unknown:
            raise KeyError(f"no free parameter is called {unknown[0]!r}; there are: {', '.join(self.names)}")
        free = numpy.array([float({**known, **values}[name]) for name in self.names])
        for about, value in zip(self._about, free):
            if not about["min"] <= value <= about["max"]:
                raise InputError(_beyond(about["name"], value, about["min"], about["max"], about["unit"]))
        return self._problem.to_unit(free) if self._unit else free

    def _outside(self, x):
        """Which parameter of a vector lies beyond its bounds, or is no number; "" where none does."""
        x = numpy.asarray(x, dtype=float)
        if x.shape != (len(self.names),):  # the core says so
            return ""
        for name, unit, value, low, high in zip(self.names, self.units, x, *self.bounds):
            if not low <= value <= high:
                return _beyond(name, value, low, high, "of the unit box" if self._unit else unit)
        return ""

    def _parameters(self, x):
        if outside := self._outside(x):
            raise EvaluationError(outside)
        return self._problem.from_unit(x) if self._unit else numpy.asarray(x, dtype=float)

    def _chained(self, jacobian, p):
        return jacobian * self._problem.unit_slopes(p) if self._unit else jacobian

    def evaluate(self, x, residuals=False, jacobian=False):
        """An Evaluation. A point that fails or lies beyond a bound raises no exception."""
        if outside := self._outside(x):
            return Evaluation("failed", outside)
        p = self._parameters(x)
        found = self._problem.evaluate(p, residuals, jacobian)
        if found["status"] == "failed":
            return Evaluation("failed", found["reason"])
        return Evaluation(found["status"], found["reason"], found["violation"], found["objective"],
                          dict(zip(self.tests, found["per_test"])),
                          found["residuals"] * self._weights if residuals else None,
                          self._chained(found["jacobian"] * self._weights[:, None], p) if jacobian else None)

    def _sound(self, found):
        if found.status == "failed":
            raise EvaluationError(found.reason)
        return found

    def objective(self, x):
        """The objective; infinity where the point fails or lies beyond a bound, as samplers and derivative-free
        optimisers want it."""
        return self.evaluate(x).objective

    def log_likelihood(self, x):
        """log L: the logarithm of the normal density of the fitted rows, all its constants included.

            log L = −½ Σ [r_k² + log 2π + 2 log σ_k + log(1 − φ_k²)],
            r_k = (e_k/σ_k − φ_k e_(k−1)/σ_(k−1))/√(1 − φ_k²),  e = prediction − measured

        σ is the noise that the fit weighs rows by, `channels[i]["sigma"]`: as the file states it, else estimated from
        the data before the search. It does not depend on x, and residuals do not widen it. φ is the stated correlation
        with the row before. Held-out rows and channels of weight 0 are left out; other weights, the objective, priors
        and constraints do not enter. With "least_squares", weights of 1 and no prior, log L + objective/2 is constant.
        −infinity where the point fails or lies beyond a bound."""
        if self._outside(x):
            return -numpy.inf
        found = self._problem.predict(self._parameters(x), False)
        if found["status"] == "failed":
            return -numpy.inf
        total = 0.0
        for channel in self.channels:
            fitted = channel["fitted"]
            if channel["weight"] == 0 or not numpy.any(fitted):
                continue
            rows = slice(channel["offset"], channel["offset"] + len(channel["measured"]))
            sigma, correlation = channel["sigma"][fitted], channel["correlation"][fitted]
            errors = (found["predictions"][rows] - channel["measured"])[fitted] / sigma
            before = numpy.concatenate([[0.0], errors[:-1]])
            left = 1 - correlation**2
            total -= 0.5 * numpy.sum((errors - correlation * before)**2 / left + numpy.log(2 * numpy.pi * sigma**2 * left))
        return float(total)

    def residuals(self, x):
        """The residuals, scaled by the root of their block's weight. Raises EvaluationError where the point fails."""
        return self._sound(self.evaluate(x, residuals=True)).residuals

    def jacobian(self, x):
        """∂residuals/∂x, row by row. Raises EvaluationError where the point fails."""
        return self._sound(self.evaluate(x, residuals=True, jacobian=True)).jacobian

    def gradient(self, x):
        """∂objective/∂x = Σ_b 2 w_b ρ_b′(‖r_b‖²) r_b·∂r_b/∂x, with ρ′ = 1 or, of norms, 1/(2 √(s + ε²)).

        Raises EvaluationError where the point fails."""
        found = self._sound(self.evaluate(x, residuals=True, jacobian=True))
        total = numpy.zeros(len(self.names))
        for block in self.blocks:
            rows = slice(block["offset"], block["offset"] + block["size"])
            residuals, jacobian = found.residuals[rows], found.jacobian[rows]  # with √w each
            slope = 1.0
            if block["loss"] == "root":
                slope = 0.5 / numpy.sqrt(residuals @ residuals / block["weight"] + _core.root_smoothing**2)
            total += 2 * slope * residuals @ jacobian
        return total

    def constraints(self, x):
        """c(x) ≤ 0, and ∂c/∂x."""
        p = self._parameters(x)
        found = self._problem.constraints(p, True)
        if found["status"] == "failed":
            raise EvaluationError(found["reason"])
        return found["values"], self._chained(found["jacobian"], p)

    def predict(self, x):
        """{(test, channel): predictions}, held-out rows included, in base units."""
        found = self._problem.predict(self._parameters(x), False)
        if found["status"] == "failed":
            raise EvaluationError(found["reason"])
        return {(channel["test"], channel["channel"]):
                found["predictions"][channel["offset"]:channel["offset"] + len(channel["measured"])]
                for channel in self.channels}

    def __repr__(self):
        return f"<tunica.Problem '{self.run}': {', '.join(self.names)}>"
