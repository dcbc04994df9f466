# SPDX-License-Identifier: Apache-2.0
"""Mechanisms written in Python: something that a simulation leaves out, with an amplitude that switches it off."""
from . import _core
from .arguments import finite
from .declarations import head, method_of, parameters_of
from .energies import Energy
from .errors import InputError
from .library import library
from .rows import readings_maker


def mechanism(name, parameters, *, acts_on, null=0.0, side="positive", plausible=None, applies_to=(), look_alikes=(),
              isolated_by="", directional=False, options=None, doc="", reference="", principal_axes=True):
    """Defines a mechanism. Its first parameter is the amplitude, and at the amplitude `null` nothing is changed.

    acts_on="material": the function gives an energy that is added to that of the model, as in tunica.model.

        @tunica.mechanism("crosslinks", {"c": ("kPa", 0, 0, 500)}, acts_on="material", plausible=(1, 200))
        def crosslinks(C, c):
            return c * (C.I2 - 3)

    acts_on="readings": the function changes what a test predicts; it returns the channels that differ.

        @tunica.mechanism("slack", {"offset": ("kPa", 0, -50, 50)}, acts_on="readings", side="both", plausible=(1, 20))
        def slack(predicted, rows, offset):
            return {"stress": predicted["stress"] + offset}

    plausible: the least and the largest amplitude, as a distance from the null; up to the bound unless given. side:
    "positive", "both", or "even" where both sides have the same effect. applies_to: types of tests, all unless given.
    Experiments name it under "mechanisms", and tunica.diagnose() considers it like any other.
    """
    if acts_on not in ("material", "readings"):
        raise InputError(f"acts_on: found {acts_on!r}, expected 'material' or 'readings'")
    if side not in ("positive", "both", "even"):
        raise InputError(f"side: found {side!r}, expected 'positive', 'both' or 'even'")
    declared = parameters_of(parameters)

    def define(definition):
        def energy(**given):
            return Energy(method_of(definition, given, "energy"))
        largest = declared[0]["max"] - null if declared else 0
        _core.define_mechanism(library(), {
            **head(name, definition, doc, reference, options), "parameters": declared, "null": finite(null, f"mechanism '{name}': null"),
            "side": side, "plausible": tuple(finite(amplitude, f"mechanism '{name}': plausible")
                                             for amplitude in plausible or (0.01 * largest, largest)),
            "applies_to": list(applies_to), "look_alikes": list(look_alikes), "isolated_by": isolated_by,
            "directional": directional, "principal_axes": principal_axes, "of_material": acts_on == "material",
            "make": energy if acts_on == "material" else readings_maker(name, definition)})
        return definition
    return define
