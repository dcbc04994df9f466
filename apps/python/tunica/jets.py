# SPDX-License-Identifier: Apache-2.0
"""Automatic differentiation for energies that are written in Python: numbers that carry their derivatives.

A Jet is a value at n points, its gradient by m variables, and its second derivatives by the first d of them and all m:
arrays of shape (n,), (m, n) and (d, m, n). Sums, products, powers and numpy's functions of one variable follow

    f(a)'  = f′ a′,      f(a)″ = f′ a″ + f″ a′ a′ᵀ,      (a b)″ = a b″ + b a″ + a′ b′ᵀ + b′ a′ᵀ.
"""
import numpy


def _constant(value):
    return not isinstance(value, Jet)


class Jet:
    """A value with its derivatives."""

    __slots__ = ("value", "first", "second")
    __array_priority__ = 1000

    def __init__(self, value, first, second):
        self.value, self.first, self.second = value, first, second

    def chained(self, value, d1, d2):
        """f of this jet, from f, f′ and f″ at its value."""
        d = self.second.shape[0]
        outer = self.first[:d, None] * self.first[None]
        return Jet(value, d1 * self.first, d1 * self.second + d2 * outer)

    def joined(self, other, value, da, db, daa, dab, dbb):
        """f of this jet a and another b, from the value and the partial derivatives of f."""
        d = self.second.shape[0]
        a, b, a_d, b_d = self.first[None], other.first[None], self.first[:d, None], other.first[:d, None]
        return Jet(value, da * self.first + db * other.first,
                   da * self.second + db * other.second + daa * a_d * a + dab * (a_d * b + b_d * a) + dbb * b_d * b)

    def __add__(self, other):
        if _constant(other):
            return Jet(self.value + other, self.first, self.second)
        return Jet(self.value + other.value, self.first + other.first, self.second + other.second)

    def __mul__(self, other):
        if _constant(other):
            return Jet(self.value * other, self.first * other, self.second * other)
        d = self.second.shape[0]
        cross = self.first[:d, None] * other.first[None] + other.first[:d, None] * self.first[None]
        return Jet(self.value * other.value, self.value * other.first + other.value * self.first,
                   self.value * other.second + other.value * self.second + cross)

    def __neg__(self):
        return self * -1.0

    def __pos__(self):
        return self

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    # Values are those of the same operation between numbers, bit for bit: with derivatives or without.
    def __truediv__(self, other):
        if _constant(other):
            return Jet(self.value / other, self.first / other, self.second / other)
        b, quotient = other.value, self.value / other.value
        return self.joined(other, quotient, 1 / b, -quotient / b, 0.0, -1 / b**2, 2 * quotient / b**2)

    def __rtruediv__(self, other):
        b, quotient = self.value, other / self.value
        return self.chained(quotient, -quotient / b, 2 * quotient / b**2)

    def __pow__(self, power):
        if not _constant(power):
            return self._to_a_jet(power)
        def term(k):  # the derivative of a constant is 0 at 0 too
            factor = numpy.prod([power - i for i in range(k)])
            return factor * self.value**(power - k) if factor else numpy.zeros_like(self.value)
        return self.chained(self.value**power, term(1), term(2))

    def _to_a_jet(self, power):
        """a^b: its limits at a = 0 are those of b > 2."""
        a, b = numpy.broadcast_arrays(self.value, power.value)
        value = a**b
        with numpy.errstate(divide="ignore"):
            logarithm = numpy.where(a == 0, 0.0, numpy.log(a))
        return self.joined(power, value, b * a**(b - 1), value * logarithm, b * (b - 1) * a**(b - 2),
                           a**(b - 1) * (1 + b * logarithm), value * logarithm**2)

    def __rpow__(self, base):
        value, logarithm = base**self.value, numpy.log(base)
        return self.chained(value, logarithm * value, logarithm**2 * value)

    def __abs__(self):
        return self * numpy.sign(self.value)

    __radd__, __rmul__ = __add__, __mul__

    # Comparisons are those of the values: numpy.where(x > 1, …) chooses branch by branch.
    def __lt__(self, other):
        return self.value < (other if _constant(other) else other.value)

    def __le__(self, other):
        return self.value <= (other if _constant(other) else other.value)

    def __gt__(self, other):
        return self.value > (other if _constant(other) else other.value)

    def __ge__(self, other):
        return self.value >= (other if _constant(other) else other.value)

    def __array_ufunc__(self, ufunc, method, *inputs, **keywords):
        if method != "__call__" or keywords:
            return NotImplemented
        if ufunc in BINARY:
            return BINARY[ufunc](*inputs)
        if ufunc in COMPARISONS:
            return ufunc(*(one if _constant(one) else one.value for one in inputs))
        if ufunc not in DERIVATIVES:
            raise TypeError(f"numpy.{ufunc.__name__} has no derivative here; there are: "
                            f"{', '.join(sorted(known.__name__ for known in DERIVATIVES))}, and + - * / **")
        value = ufunc(inputs[0].value)
        return inputs[0].chained(value, *DERIVATIVES[ufunc](inputs[0].value, value))

    def __array_function__(self, function, types, arguments, keywords):
        if function is numpy.where and len(arguments) == 3:
            return where(*arguments)
        return NotImplemented


def where(condition, chosen, otherwise):
    """numpy.where of jets, point by point."""
    like = chosen if not _constant(chosen) else otherwise
    if _constant(like):
        return numpy.where(condition, chosen, otherwise)
    def full(one):
        zero = like * 0.0
        return one if not _constant(one) else Jet(zero.value + one, zero.first, zero.second)
    a, b = full(chosen), full(otherwise)
    return Jet(*(numpy.where(condition, x, y) for x, y in zip((a.value, a.first, a.second),
                                                             (b.value, b.first, b.second))))


def _maximum(a, b):
    return where(a > b, a, b) if not _constant(a) else where(b >= a, b, a)


# f′ and f″ from x and f(x).
DERIVATIVES = {
    numpy.exp: lambda x, f: (f, f),
    numpy.expm1: lambda x, f: (f + 1, f + 1),
    numpy.log: lambda x, f: (1 / x, -1 / x**2),
    numpy.log1p: lambda x, f: (1 / (1 + x), -1 / (1 + x)**2),
    numpy.sqrt: lambda x, f: (0.5 / f, -0.25 / f**3),
    numpy.square: lambda x, f: (2 * x, 2 * numpy.ones_like(x)),
    numpy.sin: lambda x, f: (numpy.cos(x), -f),
    numpy.cos: lambda x, f: (-numpy.sin(x), -f),
    numpy.tan: lambda x, f: (1 + f**2, 2 * f * (1 + f**2)),
    numpy.sinh: lambda x, f: (numpy.cosh(x), f),
    numpy.cosh: lambda x, f: (numpy.sinh(x), f),
    numpy.tanh: lambda x, f: (1 - f**2, -2 * f * (1 - f**2)),
    numpy.arctan: lambda x, f: (1 / (1 + x**2), -2 * x / (1 + x**2)**2),
    numpy.radians: lambda x, f: (numpy.full_like(x, numpy.pi / 180), numpy.zeros_like(x)),
    numpy.deg2rad: lambda x, f: (numpy.full_like(x, numpy.pi / 180), numpy.zeros_like(x)),
}
BINARY = {
    numpy.add: lambda a, b: b + a if _constant(a) else a + b,
    numpy.subtract: lambda a, b: b.__rsub__(a) if _constant(a) else a - b,
    numpy.multiply: lambda a, b: b * a if _constant(a) else a * b,
    numpy.divide: lambda a, b: b.__rtruediv__(a) if _constant(a) else a / b,
    numpy.power: lambda a, b: b.__rpow__(a) if _constant(a) else a**b,
    numpy.maximum: _maximum,
    numpy.negative: lambda a: -a,
    numpy.absolute: abs,
}
COMPARISONS = {numpy.less, numpy.less_equal, numpy.greater, numpy.greater_equal}


def variables(values, at, m, second):
    """A jet for each row of `values`, which are variables at, at + 1, … of m. `second` is d. Rows of one value stand for
    all points: they broadcast."""
    jets = []
    for k, row in enumerate(values):
        first = numpy.zeros((m, len(row)))
        first[at + k] = 1
        jets.append(Jet(row.copy(), first, numpy.zeros((second, m, len(row)))))
    return jets
