# SPDX-License-Identifier: Apache-2.0
"""A long thick tube under pressure at a held axial stretch: incompressible, no residual stress, closed by integrals."""
import typing

import numpy as np

from .deformation import Material, stress
from .laws import Array

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)


def loads(material: Material, radii: typing.Tuple[float, float], inner: float, axial: float) -> typing.Tuple[float, float]:
    """Pressure in kPa and reduced axial force in mN of a tube with unloaded radii in mm, at a loaded inner radius:
    P = ∫ (σθ − σr) / r dr and F = π ∫ (2 σz − σθ − σr) r dr."""
    outer = outer_radius(radii, inner, axial)
    r = inner + (outer - inner) * (_NODES + 1) / 2
    weights = _WEIGHTS * (outer - inner) / 2
    unloaded = np.sqrt(radii[0]**2 + axial * (r**2 - inner**2))
    around, along = stress(material, r / unloaded, np.full_like(r, axial))
    return float(np.sum(weights * around / r)), float(np.pi * np.sum(weights * (2 * along - around) * r))


def outer_radius(radii: typing.Tuple[float, float], inner: float, axial: float) -> float:
    return float(np.sqrt(inner**2 + (radii[1]**2 - radii[0]**2) / axial))


def inflation(material: Material, radii: typing.Tuple[float, float], axial: float, pressures: Array) -> typing.Dict[str, Array]:
    """Pressure, outer and inner diameter and reduced force of every row."""
    found: typing.Dict[str, typing.List[float]] = {"outer_diameter": [], "inner_diameter": [], "axial_force": []}
    for pressure in pressures:
        low, high = 0.3 * radii[0], 4 * radii[0]
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if loads(material, radii, middle, axial)[0] < pressure else (low, middle)
        found["outer_diameter"].append(2 * outer_radius(radii, low, axial))
        found["inner_diameter"].append(2 * low)
        found["axial_force"].append(loads(material, radii, low, axial)[1])
    return {"pressure": pressures, **{name: np.array(values) for name, values in found.items()}}
