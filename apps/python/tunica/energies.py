# SPDX-License-Identifier: Apache-2.0
"""Models written in Python as an energy: all derivatives follow from it."""
import numpy

from . import _core
from .declarations import head, method_of, parameters_of
from .jets import Jet, variables
from .library import library


class Strain:
    """The right Cauchy–Green tensor C in material axes, as an energy sees it: numbers, or jets that carry derivatives.
    C[0, 0] is circumferential, C[1, 1] axial, C[2, 2] radial."""

    _PLACES = {(0, 0): 0, (1, 1): 1, (2, 2): 2, (0, 1): 3, (1, 2): 4, (0, 2): 5}

    def __init__(self, components):
        self._components = list(components) + [0.0] * (6 - len(components))

    def __getitem__(self, place):
        return self._components[self._PLACES[min(place), max(place)]]

    @property
    def I1(self):
        """tr C."""
        return self[0, 0] + self[1, 1] + self[2, 2]

    @property
    def I2(self):
        """½ (tr² C − tr C²)."""
        minors = ((0, 1), (1, 2), (0, 2))
        return sum(self[i, i] * self[j, j] - self[i, j] * self[i, j] for i, j in minors)

    @property
    def I3(self):
        """det C; of a model that is not compressible, tests keep it at 1."""
        a, b, c, d, e, f = self._components
        return a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f)

    @property
    def J(self):
        """√det C, the volume ratio."""
        return numpy.sqrt(self.I3)

    def along(self, degrees):
        """a·C a, the squared stretch of fibres in the plane of the wall, with their angle in degrees from the axial
        direction, as theta of the models of the plugins."""
        angle = numpy.radians(degrees)
        cosine, sine = numpy.cos(angle), numpy.sin(angle)
        return sine * sine * self[0, 0] + cosine * cosine * self[1, 1] + 2 * cosine * sine * self[0, 1]


class Energy:
    """An energy function W(C, parameters…) with the derivatives that the core asks for."""

    # W depends on C_tz through the two equal entries of the tensor: S_tz = 2 ∂W/∂C_tz = ∂W/∂x with x = C_tz = C_zt.
    _HALF = numpy.array([1, 1, 1, 0.5, 0.5, 0.5])
    _PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))

    def __init__(self, function):
        self._function = function

    def _at(self, points, parameters, by_parameters, twice):
        """The energy as a jet: by the components, and where wanted by the parameters and twice."""
        n, d = points.shape[1], len(points)
        count = len(parameters) if by_parameters else 0
        second = d if twice else 0
        components = variables(points, 0, d + count, second)
        own = variables(parameters[:, None], d, d + count, second) if by_parameters else parameters.tolist()
        with numpy.errstate(all="ignore"):  # a non-finite value is a failed evaluation, which names its place
            energy = self._function(Strain(components), *own)
        zero = components[0] * 0.0  # one value per point, whatever the energy depends on
        return zero + energy if not isinstance(energy, Jet) or energy.value.shape != (n,) else energy

    def evaluate(self, C, parameters, wanted):
        by_parameters, half = "stress_dp" in wanted, self._HALF
        jet = self._at(C, parameters, by_parameters, by_parameters or "tangent" in wanted)
        found = {"energy": jet.value}
        if "stress" in wanted:
            found["stress"] = 2 * half[:, None] * jet.first[:6]
        if "tangent" in wanted:
            found["tangent"] = 4 * half[:, None, None] * half[None, :, None] * jet.second[:, :6]
        if "stress_dp" in wanted:
            found["stress_dp"] = 2 * half[None, :, None] * jet.second[:, 6:].transpose(1, 0, 2)
        return found

    def evaluate_axes(self, c, parameters, wanted):
        by_parameters = "gradient_dp" in wanted or "energy_dp" in wanted
        jet = self._at(c, parameters, by_parameters, "hessian" in wanted or "gradient_dp" in wanted)
        found = {"energy": jet.value, "gradient": jet.first[:3], "energy_dp": jet.first[3:]}
        if "hessian" in wanted:
            found["hessian"] = numpy.stack([jet.second[a, b] for a, b in self._PAIRS])
        if "gradient_dp" in wanted:
            found["gradient_dp"] = jet.second[:, 3:].transpose(1, 0, 2)
        return found


def model(name, parameters, *, options=None, doc="", reference="", principal_axes=True, compressible=False):
    """Defines a model by its energy per reference volume, a function of a Strain and the parameters, written with
    + - * / ** and numpy's functions. All derivatives follow from it, exactly.

        @tunica.model("my_neo_hooke", {"mu": ("kPa", 400, 1, 1e4)})
        def energy(C, mu):
            return mu / 2 * (C.I1 - 3)

    Options are keywords of the function; of a class they are those of __init__, and its method `energy` is the
    function. Set principal_axes=False where stress and strain do not share their axes, as with a single oblique family
    of fibres. With compressible=True the volume may change: 2 ∂W/∂C is then the whole stress, which has to vanish at rest,
    and C.J is the volume ratio. A definition replaces an earlier one of the same name. What the function raises is a failed evaluation,
    whose reason is the last line of the traceback.
    """
    def define(definition):
        _core.define_model(library(), {
            **head(name, definition, doc, reference, options), "parameters": parameters_of(parameters),
            "principal_axes": principal_axes, "compressible": compressible,
            "make": lambda **given: Energy(method_of(definition, given, "energy"))})
        return definition
    return define
