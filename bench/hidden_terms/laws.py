# SPDX-License-Identifier: Apache-2.0
"""How terms grow: ψ'(x) of every law of docs/composed.md, and of laws that none of them is.

x has any shape and no unit; ψ' has the shape of x, in kPa. Parameters come as a dictionary of numbers."""
import typing

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[typing.Any]
Values = typing.Dict[str, float]

# Parameters of every law; the first is the amplitude, in which ψ' is linear.
PARAMETERS: typing.Dict[str, typing.Tuple[str, ...]] = {
    "linear": ("mu",), "quadratic": ("k",), "cubic": ("k",), "power": ("k", "m"), "exponential": ("mu", "b"),
    "exponential_square": ("k1", "k2"), "gent": ("mu", "Jm"), "inverse_langevin": ("mu", "N"), "logarithm": ("mu",),
    # Outside every law: load from x0 on, a slope that changes at x0, no more growth from x0 on.
    "late": ("k", "x0"), "two_slopes": ("k", "x0", "ratio"), "saturating": ("k", "x0")}
KINKED = ("late", "two_slopes", "saturating")
OF_FIBRES = ("quadratic", "cubic", "power", "exponential_square")
OF_I1_AND_I2 = tuple(law for law in PARAMETERS if law not in KINKED)


def langevin(beta: Array) -> Array:
    """L(β) = coth β − 1/β for β ≥ 0; its series where the two terms cancel."""
    small = beta < 1e-2
    safe = np.where(small, 1.0, np.minimum(beta, 300.0))
    return np.where(small, beta / 3 - beta**3 / 45, 1 / np.tanh(safe) - 1 / np.where(small, 1.0, beta))


def inverse_langevin(y: Array) -> Array:
    """β with L(β) = y, 0 ≤ y < 1: Newton's method from Cohen's quotient (1991)."""
    y = np.minimum(np.asarray(y, float), 1 - 1e-9)
    beta: Array = y * (3 - y * y) / (1 - y * y)
    for _ in range(12):
        big = np.maximum(beta, 1e-2)
        slope = np.where(beta < 1e-2, 1 / 3 - beta**2 / 15, 1 / big**2 - 1 / np.sinh(np.minimum(big, 300.0))**2)
        beta = np.maximum(beta - (langevin(beta) - y) / slope, 0.0)
    return beta


def slope(law: str, x: Array, p: Values) -> Array:
    """ψ'(x). Below 0 it is that at 0, so that slack fibres carry nothing; beyond a limit of stretch, that just before."""
    return np.asarray(_slope(law, np.maximum(x, 0.0), p), float)


def _slope(law: str, x: Array, p: Values) -> typing.Any:
    if law == "linear":
        return np.full_like(x, p["mu"] / 2)
    if law == "quadratic":
        return p["k"] * x
    if law == "cubic":
        return p["k"] * x * x
    if law == "power":
        return p["k"] * x**(p["m"] - 1)
    if law == "exponential":
        return p["mu"] / 2 * np.exp(np.minimum(p["b"] * x, 100.0))
    if law == "exponential_square":
        return p["k1"] * x * np.exp(np.minimum(p["k2"] * x * x, 100.0))
    if law == "gent":
        return p["mu"] / 2 * p["Jm"] / (p["Jm"] - np.minimum(x, 0.9999 * p["Jm"]))
    if law == "inverse_langevin":
        y = np.sqrt((x + 3) / (3 * p["N"]))
        return p["mu"] * inverse_langevin(y) / (6 * y)
    if law == "logarithm":
        return p["mu"] / 2 / (1 + x / 3)
    if law == "late":
        return p["k"] * np.maximum(x - p["x0"], 0.0)
    if law == "two_slopes":
        return p["k"] * (x + (p["ratio"] - 1) * np.maximum(x - p["x0"], 0.0))
    if law == "saturating":
        return p["k"] * np.minimum(x, p["x0"])
    raise ValueError(f"unknown law '{law}'")


def draw(law: str, reach: float, random: np.random.Generator) -> Values:
    """Parameters with an amplitude of 1 kPa, and a shape that shows on 0 ≤ x ≤ reach and breaks nowhere in it."""
    values = {PARAMETERS[law][0]: 1.0}
    if law == "power":
        values["m"] = random.uniform(2.4, 5)
    elif law == "exponential":
        values["b"] = random.uniform(1, 3.5) / reach
    elif law == "exponential_square":
        values["k2"] = random.uniform(0.7, 3) / reach**2
    elif law == "gent":
        values["Jm"] = reach * random.uniform(1.1, 2)
    elif law == "inverse_langevin":
        values["N"] = 1 + reach / 3 * random.uniform(1.1, 2)
    elif law == "late":
        values["x0"] = reach * random.uniform(0.3, 0.55)
    elif law == "two_slopes":
        values.update(x0=reach * random.uniform(0.3, 0.55), ratio=random.uniform(5, 10))
    elif law == "saturating":
        values["x0"] = reach * random.uniform(0.15, 0.35)
    return values


def bounds(law: str, name: str, reach: float) -> typing.Tuple[float, float]:
    """Where a fit may look for a parameter: positive numbers, which a fit scales by their logarithm."""
    if name == PARAMETERS[law][0]:
        return 1e-6, 1e6
    return {"m": (2.0, 20.0), "b": (1e-3 / reach, 20 / reach), "k2": (1e-3 / reach**2, 20 / reach**2),
            "Jm": (1.02 * reach, 1e3 * reach), "N": (1 + 1.02 * reach / 3, 1 + 300 * reach),
            "x0": (0.02 * reach, 0.9 * reach), "ratio": (1.5, 50.0)}[name]
