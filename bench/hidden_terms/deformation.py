# SPDX-License-Identifier: Apache-2.0
"""Stress of an incompressible sum of terms: in a sheet with stretches along its axes, in a free strip, in simple shear.

Index 1 is circumferential, 2 axial, 3 across the sheet. Stretches and shears are arrays of n rows; stress is in kPa."""
import typing

import numpy as np

from .laws import Array, Values, slope


class Part(typing.NamedTuple):
    """A term ψ(x). `invariant`: I1, I2, axial, circumferential, diagonal (two families at ±theta degrees from the axis),
    product ((I1 − 3)(I2 − 3)) or stretches (Ogden). `values` holds the law's parameters, and theta and kappa of fibres."""
    invariant: str
    law: str
    values: Values


Material = typing.Sequence[Part]


def _first(l1: Array, l2: Array) -> typing.Tuple[Array, Array, Array]:
    """x = I1 − 3 and ∂x/∂ln λ_i at constant volume, i = 1, 2."""
    a, b, c = l1 * l1, l2 * l2, (l1 * l2)**-2.0
    return a + b + c - 3, 2 * (a - c), 2 * (b - c)


def _second(l1: Array, l2: Array) -> typing.Tuple[Array, Array, Array]:
    """x = I2 − 3 and its derivatives, as of _first."""
    a, b, c = l1**-2.0, l2**-2.0, (l1 * l2)**2
    return a + b + c - 3, 2 * (c - a), 2 * (c - b)


def direction(part: Part) -> typing.Tuple[float, float]:
    """cos² and sin² of the family's angle from the axis."""
    angle = {"axial": 0.0, "circumferential": 90.0}.get(part.invariant, part.values.get("theta", 0.0))
    return float(np.cos(np.radians(angle)))**2, float(np.sin(np.radians(angle)))**2


def invariant_of(part: Part, l1: Array, l2: Array) -> typing.Tuple[Array, Array, Array]:
    """x and ∂x/∂ln λ_i at constant volume, i = 1, 2: three arrays of n rows."""
    if part.invariant == "I1":
        return _first(l1, l2)
    if part.invariant == "I2":
        return _second(l1, l2)
    along, around = direction(part)
    x, d1, d2 = around * l1**2 + along * l2**2 - 1, 2 * around * l1**2, 2 * along * l2**2
    kappa = part.values.get("kappa", 0.0)
    if kappa > 0:
        i, g1, g2 = _first(l1, l2)
        x, d1, d2 = kappa * (i + 3) + (1 - 3 * kappa) * (x + 1) - 1, kappa * g1 + (1 - 3 * kappa) * d1, kappa * g2 + (
            1 - 3 * kappa) * d2
    return x, d1, d2


def stress(material: Material, l1: Array, l2: Array) -> typing.Tuple[Array, Array]:
    """Cauchy stresses σ1, σ2 of a sheet that nothing presses on (σ3 = 0)."""
    s1, s2 = np.zeros_like(l1), np.zeros_like(l1)
    for part in material:
        if part.invariant == "product":
            x, a1, a2 = _first(l1, l2)
            y, b1, b2 = _second(l1, l2)
            s1, s2 = s1 + part.values["k"] * (y * a1 + x * b1), s2 + part.values["k"] * (y * a2 + x * b2)
        elif part.invariant == "stretches":
            mu, alpha = part.values["mu"], part.values["alpha"]
            across = (l1 * l2)**-alpha
            s1, s2 = s1 + mu * (l1**alpha - across), s2 + mu * (l2**alpha - across)
        else:
            x, d1, d2 = invariant_of(part, l1, l2)
            pull = (2 if part.invariant == "diagonal" else 1) * slope(part.law, x, part.values)
            s1, s2 = s1 + pull * d1, s2 + pull * d2
    return s1, s2


def is_isotropic(material: Material) -> bool:
    return all(part.invariant in ("I1", "I2", "product", "stretches") for part in material)


def free_strip(material: Material, stretch: Array, along: typing.Union[int, Array]) -> typing.Tuple[Array, Array]:
    """λ1 and λ2 of strips that are pulled along axis 1 or 2 (each row's), their sides free: root of the other stress in
    ln λ, by Chandrupatla's method (1997) at all rows at once."""
    around = np.broadcast_to(np.asarray(along) == 1, stretch.shape)

    def placed(side: Array) -> typing.Tuple[Array, Array]:
        return np.where(around, stretch, side), np.where(around, side, stretch)

    if is_isotropic(material):
        return placed(stretch**-0.5)
    pulled = np.log(stretch)

    def other(log_side: Array) -> Array:
        s1, s2 = stress(material, *placed(np.exp(log_side)))
        return np.where(around, s2, s1)

    a, b = -2.5 * np.abs(pulled) - 0.02, 0.6 * np.abs(pulled) + 0.02
    fa, fb = other(a), other(b)
    if not np.all(fa < 0) or not np.all(fb > 0):
        raise ArithmeticError("no transverse stretch balances the strip")
    c, fc, t = a, fa, np.full_like(a, 0.5)
    for _ in range(60):
        x = a + t * (b - a)
        fx = other(x)
        same = np.sign(fx) == np.sign(fa)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        best = np.abs(fa) < np.abs(fb)
        root = np.where(best, a, b)
        # Rows at rest, where every bound is a root within rounding, end with the others.
        if np.all((np.abs(b - a) < 1e-11) | (fa == 0)):
            break
        with np.errstate(all="ignore"):
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            inverse = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
            smooth = (phi**2 < xi) & ((1 - phi)**2 < 1 - xi) & np.isfinite(inverse)
            margin = np.minimum(2e-12 / np.maximum(np.abs(b - a), 1e-300), 0.5)
        t = np.clip(np.where(smooth, inverse, 0.5), margin, 1 - margin)
    return placed(np.exp(root))


def shear_stress(material: Material, gamma: Array) -> Array:
    """dW/dγ of simple shear: the circumferential plate slides, its normal is axial."""
    total = np.zeros_like(gamma)
    for part in material:
        if part.invariant == "product":
            total += part.values["k"] * 4 * gamma**3
        elif part.invariant == "stretches":
            root = np.sqrt(1 + gamma**2 / 4)
            stretch, alpha = gamma / 2 + root, part.values["alpha"]
            total += part.values["mu"] * (stretch**alpha - stretch**-alpha) / (2 * root)
        elif part.invariant in ("I1", "I2"):
            total += slope(part.law, gamma**2, part.values) * 2 * gamma
        else:
            along, around = direction(part)
            cross = np.sqrt(along * around)
            for sign in (1, -1) if part.invariant == "diagonal" else (1,):
                x = 2 * sign * cross * gamma + along * gamma**2
                dx = 2 * sign * cross + 2 * along * gamma
                kappa = part.values.get("kappa", 0.0)
                x, dx = kappa * gamma**2 + (1 - 3 * kappa) * x, kappa * 2 * gamma + (1 - 3 * kappa) * dx
                total += slope(part.law, x, part.values) * dx
    return total
