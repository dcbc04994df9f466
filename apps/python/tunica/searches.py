# SPDX-License-Identifier: Apache-2.0
"""Optimisers written in Python."""
import inspect

import numpy

from . import _core
from .declarations import head
from .errors import InputError, StopSearch
from .library import library


class Search:
    """The problem of one search in the unit box [0, 1]^dimension. The core counts, records and keeps the best point. It
    is gone when the search has ended.

    objective(), residuals() and the others raise StopSearch once the budget, the time or a person ends the search:
    leave it uncaught, and minimise() ends there.
    """

    def __init__(self, search):
        self._search = search
        self.dimension = search.dimension
        #: the initial point
        self.start = search.start
        #: blocks of residuals: dictionaries with offset, size, weight and loss
        self.blocks = search.blocks
        self.constraint_count = search.constraint_count

    @property
    def should_stop(self):
        """Whether to end: budget or time is used up, the target is reached, or a person interrupted the run."""
        return self._search.should_stop

    @property
    def evaluations(self):
        """Evaluations counted so far."""
        return self._search.evaluations

    @property
    def budget(self):
        """Evaluations that remain."""
        return self._search.budget

    def _go_on(self):
        if self._search.should_stop:
            raise StopSearch

    def objective(self, x):
        """The objective; infinity where the point fails. A point that violates a constraint has its objective."""
        self._go_on()
        return self._search.evaluate(x)[2]

    def evaluate(self, x):
        """(status, reason, objective), status "ok", "infeasible" or "failed"."""
        self._go_on()
        return self._search.evaluate(x)

    def evaluate_batch(self, xs):
        """The same for every row of `xs`, on as many threads as the run has."""
        self._go_on()
        return self._search.evaluate_batch(numpy.atleast_2d(xs))

    def linearise(self, x):
        """(objective, residuals, jacobian), rows scaled by the root of their weight; (infinity, None, None) where the
        point fails."""
        self._go_on()
        status, _, objective, residuals, jacobian = self._search.linearise(x)
        if status == "failed":
            return numpy.inf, None, None
        for block in self.blocks:
            rows = slice(block["offset"], block["offset"] + block["size"])
            residuals[rows] *= numpy.sqrt(block["weight"])
            jacobian[rows] *= numpy.sqrt(block["weight"])
        return objective, residuals, jacobian

    def constraints(self, x):
        """c(x) ≤ 0 and ∂c/∂x."""
        return self._search.constraints(x)[2:]

    def generator(self, purpose="search"):
        """A generator of random numbers that depends on the run's seed alone. Take every random number from one."""
        return numpy.random.default_rng(self._search.seed(purpose))

    def for_each_start(self, count, body):
        """Runs body(k, search) for k = 0 … count − 1, each with a problem of its own, side by side. The result is that
        of one after the other. Returns how many would have begun."""
        def ended(k, child):
            try:
                body(k, Search(child))
            except StopSearch:
                pass
        return self._search.for_each_start(count, ended)


class _Optimizer:
    def __init__(self, function):
        self._function = function

    def minimise(self, search):
        try:
            outcome = self._function(Search(search))
        except StopSearch:
            return False, ""
        if outcome is None:
            return False, ""
        converged, reason = outcome
        return bool(converged), str(reason)


NEEDS = ("residuals", "gradient", "constraints", "batch", "random", "infeasible")


def optimizer(name, *, needs=(), options=None, doc="", reference=""):
    """Defines an optimiser: a function of a Search, which minimises search.objective over the unit box and returns
    (converged, reason), or None.

        @tunica.optimizer("nelder_mead_of_scipy")
        def minimise(search):
            found = scipy.optimize.minimize(search.objective, search.start, method="Nelder-Mead",
                                            bounds=[(0, 1)] * search.dimension)
            return found.success, found.message

    needs: what it asks of a problem, of "residuals", "gradient", "constraints", "batch", "random" (other results with
    another seed) and "infeasible". Without "constraints" a run with constraints is refused. Options are keywords; of a
    class they are those of __init__, and its method `minimise` is the function. Equal seeds must give equal points:
    results are resumed by repeating the search.
    """
    for need in needs:
        if need not in NEEDS:
            raise InputError(f"needs: found {need!r}; expected some of {', '.join(NEEDS)}")

    def define(definition):
        def make(**given):
            if inspect.isclass(definition):
                return _Optimizer(definition(**given).minimise)
            return _Optimizer(lambda search: definition(search, **given))
        _core.define_optimizer(library(), {
            **head(name, definition, doc, reference, options), "needs": {need: need in needs for need in NEEDS},
            "make": make})
        return definition
    return define
