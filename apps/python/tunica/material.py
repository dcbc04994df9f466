# SPDX-License-Identifier: Apache-2.0
"""A model at given deformations, without any test."""
import json

import numpy

from . import _core
from .arguments import finite
from .errors import EvaluationError, InputError
from .library import library

# The order of the components of a symmetric tensor: t circumferential, z axial, r radial.
ROWS, COLUMNS = (0, 1, 2, 0, 1, 0), (0, 1, 2, 1, 2, 2)


def deformation(C=None, F=None, stretches=None):
    """The (6, n) array of right Cauchy–Green tensors from one of: C or F, (3, 3) or (n, 3, 3), or principal stretches
    along the axes, (3,) or (n, 3)."""
    given = [(name, value) for name, value in (("C", C), ("F", F), ("stretches", stretches)) if value is not None]
    if len(given) != 1:
        raise InputError("a deformation is one of C, F and stretches; found "
                         f"{' and '.join(name for name, _ in given) or 'none'}")
    name, value = given[0]
    value = numpy.asarray(value, dtype=float)
    shape = (3,) if name == "stretches" else (3, 3)
    if value.shape[-len(shape):] != shape or value.ndim > len(shape) + 1:
        raise InputError(f"{name}: found an array of shape {value.shape}, expected {shape} or (n, {str(shape)[1:]}")
    if not numpy.isfinite(value).all():
        raise InputError(f"{name}: found a number that is not finite, expected finite ones")
    value = value.reshape(-1, *shape)
    if name == "stretches":
        tensors = numpy.zeros((len(value), 3, 3))
        tensors[:, range(3), range(3)] = value**2
    else:
        tensors = numpy.einsum("nki,nkj->nij", value, value) if name == "F" else value
    if not numpy.allclose(tensors, tensors.transpose(0, 2, 1), rtol=1e-12, atol=0):
        raise InputError("C: found a tensor that is not symmetric; give F, or C = FᵀF")
    return numpy.ascontiguousarray(tensors[:, ROWS, COLUMNS].T)


def tensors(components):
    """(n, 3, 3) from (6, n)."""
    full = numpy.empty((components.shape[1], 3, 3))
    full[:, ROWS, COLUMNS] = full[:, COLUMNS, ROWS] = components.T
    return full


class Response:
    """What a material answers, whoever holds it. Units are base units: kPa, s. Axes are those of the material:
    circumferential, axial, radial. Stress has no pressure in it, which depends on the test; that of a compressible model is
    whole."""

    def _evaluate(self, C, F, stretches, time_step=None, tangent=False):
        points = deformation(C, F, stretches)
        steps = numpy.empty(0) if time_step is None else numpy.broadcast_to(
            numpy.asarray(time_step, dtype=float), points.shape[1:]).copy()
        found = self._answer(points, steps, tangent)
        if found["status"] != "ok":
            raise EvaluationError(found["reason"])
        return found

    def energy(self, *, C=None, F=None, stretches=None):
        """W per reference volume, kPa, (n,)."""
        return self._evaluate(C, F, stretches)["energy"]

    def stress(self, *, C=None, F=None, stretches=None, time_step=None):
        """Second Piola–Kirchhoff stress 2 ∂W/∂C without pressure, kPa, (n, 3, 3). Of a model with memory the points
        are the steps of one path from rest, `time_step` s apart; without time loading is infinitely slow."""
        return tensors(self._evaluate(C, F, stretches, time_step)["stress"])

    def tangent(self, *, C=None, F=None, stretches=None):
        """2 ∂S/∂C, kPa, (n, 6, 6) in the order tt, zz, rr, tz, zr, tr. Not of models with memory."""
        found = self._evaluate(C, F, stretches, tangent=True)["tangent"]
        return found.reshape(6, 6, -1).transpose(2, 0, 1)

    def cauchy(self, *, F=None, stretches=None, time_step=None):
        """Cauchy stress F S Fᵀ/J without pressure, kPa, (n, 3, 3). `C` does not say how the body has turned."""
        if (F is None) == (stretches is None):
            raise InputError("give either F or stretches")
        if F is None:
            F = numpy.asarray(stretches, dtype=float).reshape(-1, 3)[:, :, None] * numpy.eye(3)
        F = numpy.asarray(F, dtype=float).reshape(-1, 3, 3)
        S = self.stress(F=F, time_step=time_step)
        return numpy.einsum("nij,njk,nlk->nil", F, S, F) / numpy.linalg.det(F)[:, None, None]

    def axis_stress(self, stretches, free, time_step=None):
        """Cauchy stresses along the axes, kPa, (n, 3). Of an incompressible material the pressure is the one with which
        the axis `free` (0, 1 or 2) bears none, σ_a = λ_a² S_aa − λ_f² S_ff; of a compressible one σ_a = λ_a² S_aa/J."""
        stretches = numpy.asarray(stretches, dtype=float).reshape(-1, 3)
        found = self._evaluate(None, None, stretches, time_step)
        along = stretches**2 * found["stress"][:3].T
        return along - along[:, [free]] if found["keeps_volume"] else along / stretches.prod(axis=1)[:, None]


class Material(Response):
    """A model at parameters, as an entry of "models" in an experiment describes it.

        material = tunica.Material("gho", mu=10.0, k1=20.0)
        material = tunica.Material({"type": "ogden", "terms": 2, "mechanisms": [{"type": "viscoelasticity"}]})

    Parameters that are not given have their fixed or initial value, in base units.
    """

    def __init__(self, model, **parameters):
        entry = {"type": model} if isinstance(model, str) else model
        try:
            written = json.dumps(entry, indent=2, allow_nan=False)
        except ValueError:
            raise InputError("the model has a number that is not finite; expected finite ones") from None
        self._material = _core.Material(library(), written)
        self._about = self._material.parameters
        known = {about["name"]: about["initial"] for about in self._about}
        for name in parameters:
            if name not in known:
                raise InputError(f"the model '{self.type}' has no parameter '{name}'; it has: {', '.join(known)}")
        #: {name: value} in base units
        self.parameters = {**known, **{name: finite(value, f"the parameter '{name}'") for name, value in parameters.items()}}

    @property
    def type(self):
        return self._material.type

    @property
    def units(self):
        """{name: unit}."""
        return {about["name"]: about["unit"] for about in self._about}

    def _answer(self, points, steps, tangent):
        return self._material.evaluate(points, numpy.array(list(self.parameters.values())), steps, tangent)

    def __repr__(self):
        values = ", ".join(f"{name}={value:.6g}" for name, value in self.parameters.items())
        return f"<tunica.Material '{self.type}': {values}>"


class MaterialInTest(Response):
    """The material that a test written in Python is asked about, at the parameters of that evaluation. It is gone when
    the prediction has ended."""

    def __init__(self, material):
        self._material = material

    def _answer(self, points, steps, tangent):
        return self._material.evaluate(points, steps, tangent)
