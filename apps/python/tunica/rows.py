# SPDX-License-Identifier: Apache-2.0
"""Tests, and mechanisms on readings, written in Python: functions of the rows of the data."""
import numpy

from . import _core
from .declarations import head, method_of, observables_of, parameters_of
from .library import library
from .material import MaterialInTest


class Rows(dict):
    """The prescribed columns of one prediction, {name: array}, "time" among them where the data have it. `channels` are
    the names that are to be predicted, `count` is the number of rows, and `stress_measure` that of the data: "cauchy",
    "first_piola_kirchhoff" or "second_piola_kirchhoff"."""

    def __init__(self, setup, columns):
        super().__init__(zip(setup["abscissae"], columns))
        if setup["time"]:
            self["time"] = numpy.array(setup["time"])
        self.channels, self.count, self.stress_measure = setup["channels"], setup["count"], setup["stress_measure"]


def _stacked(predicted, rows, name):
    """(c, n) from {channel: array}."""
    try:
        return numpy.stack([numpy.broadcast_to(numpy.asarray(predicted[channel], dtype=float), rows.count)
                            for channel in rows.channels])
    except KeyError as missing:
        raise KeyError(f"'{name}' predicts {', '.join(map(str, predicted)) or 'nothing'}; the data have "
                       f"{missing.args[0]!r} too") from None


class _Test:
    def __init__(self, name, setup, function):
        self._name, self._setup, self._function = name, setup, function

    def predict(self, material, columns, own):
        rows = Rows(self._setup, columns)
        return _stacked(self._function(MaterialInTest(material), rows, *own), rows, self._name)


class _Readings:
    def __init__(self, name, setup, function):
        self._name, self._setup, self._function = name, setup, function

    def readings(self, values, columns, own):
        rows = Rows(self._setup, columns)
        predicted = dict(zip(rows.channels, values))
        return _stacked({**predicted, **self._function(predicted, rows, *own)}, rows, self._name)


def test(name, observables, parameters=(), *, options=None, doc="", reference="", costly=False):
    """Defines a test: a function of a material, the Rows and the test's own parameters that returns {channel: array}.

        @tunica.test("balloon", {"stretch": ("1", "abscissa", "stretch"), "pressure": ("kPa",)},
                     {"thickness": ("1", 0.05, 0.01, 0.2)})
        def balloon(material, rows, thickness):
            stretch = rows["stretch"]
            sheet = numpy.stack([stretch, stretch, stretch**-2], axis=1)
            return {"pressure": 2 * thickness * stretch**-3 * material.axis_stress(sheet, free=2)[:, 0]}

    The material answers as tunica.Material does. Of a class, options go to __init__, and its method `predict` is the
    function. Derivatives are differences of whole predictions. Every row may depend on its own abscissae and on time.
    What the function raises is a failed evaluation.
    """
    def define(definition):
        _core.define_test(library(), {
            **head(name, definition, doc, reference, options), "observables": observables_of(observables),
            "parameters": parameters_of(parameters), "costly": costly,
            "make": lambda setup, **given: _Test(name, setup, method_of(definition, given, "predict"))})
        return definition
    return define


def readings_maker(name, definition):
    """What makes a mechanism on readings for the rows of a test."""
    return lambda setup, **given: _Readings(name, setup, method_of(definition, given, "readings"))
