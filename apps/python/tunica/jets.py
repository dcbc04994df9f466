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

    def reciprocal(self):
        inverse = 1 / self.value
        return self.chained(inverse, -inverse**2, 2 * inverse**3)

    def __truediv__(self, other):
        return self * (1 / other if _constant(other) else other.reciprocal())

    def __rtruediv__(self, other):
        return self.reciprocal() * other

    def __pow__(self, power):
        if not _constant(power):
            return numpy.exp(power * numpy.log(self))
        def term(k):  # the derivative of a constant is 0 at 0 too
            factor = numpy.prod([power - i for i in range(k)])
            return factor * self.value**(power - k) if factor else numpy.zeros_like(self.value)
        return self.chained(self.value**power, term(1), term(2))

    def __rpow__(self, base):
        return numpy.exp(self * numpy.log(base))

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


def variables(values, second):
    """One jet for each row of `values`, (m, n), with second derivatives by the first `second` of them."""
    m, n = values.shape
    jets = []
    for j in range(m):
        first = numpy.zeros((m, n))
        first[j] = 1
        jets.append(Jet(values[j].copy(), first, numpy.zeros((second, m, n))))
    return jets
