# SPDX-License-Identifier: Apache-2.0
"""Arguments that are looked at before the core sees them."""
import math
import operator
import os

from .errors import InputError


def finite(value, what):
    """The number, or None. NaN and infinity are refused: every comparison with them would pass in silence."""
    if value is None:
        return None
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{what}: found {value!r}, expected a number") from None
    if not math.isfinite(number):
        raise InputError(f"{what}: found {number}, expected a finite number")
    return number


def port_number(value):
    """The number of a port; 0 is any that is free."""
    try:
        return operator.index(value)
    except TypeError:
        raise InputError(f"port: found {value!r}, expected a whole number; give one, or 0 for any port that is "
                         "free") from None


def text(value, what):
    """The text of a name or a path. A NUL would end it in the middle."""
    plain = os.fspath(value) if isinstance(value, os.PathLike) else value
    if not isinstance(plain, str):
        raise InputError(f"{what}: found {value!r}, expected a text")
    if "\0" in plain:
        raise InputError(f"{what}: found a NUL character in {plain!r}; take it out")
    return plain


def path(value, what):
    """A path as text, or None."""
    return None if value is None else text(value, what)


def texts(values, what):
    return [text(value, what) for value in values]
