# SPDX-License-Identifier: Apache-2.0
"""What is measured: curves of a specimen, their rows, and errors of the rig that take part in them.

A curve has n rows and one or two channels in kPa. What a protocol measures is one vector: curve after curve, channel
after channel, row after row."""
import typing

import numpy as np

from .deformation import Material, Part, free_strip, invariant_of, shear_stress, stress
from .laws import Array


class Curve(typing.NamedTuple):
    """kind: uniaxial (along `axis`), equibiaxial, pure_shear (axis 1, stretch 2 held), sheet or simple_shear. `load` has
    the recorded stretch or shear of each row; of a sheet it is the share of `most`, the largest strains (1 and 2)."""
    name: str
    kind: str
    load: Array
    axis: int = 1
    most: typing.Tuple[float, float] = (0.0, 0.0)

    @property
    def channels(self) -> int:
        return 2 if self.kind == "sheet" else 1

    @property
    def nominal(self) -> bool:
        return self.kind in ("uniaxial_nominal", "equibiaxial", "pure_shear")


class RigError(typing.NamedTuple):
    """What is wrong with one curve: force_offset (kPa), force_scale (share), thickness (share, all channels),
    reference_length (true over recorded stretch, less 1), stretch_offset (true less recorded), drift (kPa at the last
    row) or gain_drift (share at the last row). `channel` counts from 0; −1 is all of them."""
    kind: str
    curve: int
    channel: int
    amount: float


def stretches(curve: Curve, scale: float = 1, offset: float = 0) -> typing.Tuple[Array, Array]:
    """True λ1 and λ2 of the rows that prescribe both; scale and offset turn recorded into true stretches."""
    def true(recorded: Array) -> Array:
        return recorded * scale + offset

    if curve.kind == "sheet":
        return true(1 + curve.load * curve.most[0]), true(1 + curve.load * curve.most[1])
    pulled = true(curve.load)
    return pulled, pulled if curve.kind == "equibiaxial" else np.ones_like(pulled)


def measured(curve: Curve, material: Material) -> Array:
    """Channels (1 or 2 rows) by n rows."""
    return _measured([(curve, 1.0, 0.0)], material)[0]


def _measured(curves: typing.Sequence[typing.Tuple[Curve, float, float]], material: Material) -> typing.List[Array]:
    """Of curves with scale and offset of their stretches; all but shear in one go, because calls cost more than rows."""
    sheared = {k: shear_stress(material, curve.load * scale + offset) for k, (curve, scale, offset) in enumerate(curves)
               if curve.kind == "simple_shear"}
    plane = [k for k in range(len(curves)) if k not in sheared]
    strips = [k for k in plane if curves[k][0].kind.startswith("uniaxial")]
    loads = {k: stretches(*curves[k]) for k in plane}
    if strips:
        pulled = np.concatenate([loads[k][0] for k in strips])
        axes = np.concatenate([np.full(len(loads[k][0]), curves[k][0].axis) for k in strips])
        ends = np.cumsum([len(loads[k][0]) for k in strips])[:-1]
        for k, l1, l2 in zip(strips, *(np.split(one, ends) for one in free_strip(material, pulled, axes))):
            loads[k] = l1, l2
    if plane:
        ends = np.cumsum([len(loads[k][0]) for k in plane])[:-1]
        both = stress(material, *(np.concatenate([loads[k][i] for k in plane]) for i in (0, 1)))
        cauchy = dict(zip(plane, zip(*(np.split(one, ends) for one in both))))
    found = []
    for k, (curve, _, _) in enumerate(curves):
        if k in sheared:
            found.append(np.array([sheared[k]]))
        elif curve.kind == "sheet":
            found.append(np.array(cauchy[k]))
        else:
            along = curve.axis - 1
            found.append(np.array([cauchy[k][along] / loads[k][along] if curve.nominal else cauchy[k][along]]))
    return found


def observe(protocol: typing.Sequence[Curve], material: Material, error: typing.Optional[RigError] = None) -> Array:
    """All readings of a protocol, as one vector."""
    plain = [(curve, 1.0, 0.0) for curve in protocol]
    if error is not None and error.kind in ("reference_length", "stretch_offset"):
        scale, offset = (1 + error.amount, 0.0) if error.kind == "reference_length" else (1.0, error.amount)
        plain[error.curve] = protocol[error.curve], scale, offset
    found = _measured(plain, material)
    if error is not None:
        y = found[error.curve]
        rows = slice(None) if error.channel < 0 else slice(error.channel, error.channel + 1)
        gone = np.linspace(0, 1, y.shape[1])
        if error.kind == "force_offset":
            y[rows] += error.amount
        elif error.kind in ("force_scale", "thickness"):
            y[rows] *= 1 + error.amount
        elif error.kind == "drift":
            y[rows] += error.amount * gone
        elif error.kind == "gain_drift":
            y[rows] *= 1 + error.amount * gone
    return np.concatenate([y.ravel() for y in found])


def channel_slices(protocol: typing.Sequence[Curve]) -> typing.List[slice]:
    """Where each channel stands in the vector."""
    found, at = [], 0
    for curve in protocol:
        for _ in range(curve.channels):
            found.append(slice(at, at + len(curve.load)))
            at += len(curve.load)
    return found


def reach(protocol: typing.Sequence[Curve], material: Material, part: Part) -> float:
    """Largest x of a term's invariant over all rows; of a sheared family, that of the family which is stretched."""
    most = 0.0
    for curve in protocol:
        if curve.kind == "simple_shear":
            g = float(np.max(curve.load))
            if part.invariant in ("I1", "I2"):
                most = max(most, g * g)
            elif part.invariant in ("axial", "circumferential", "diagonal"):
                along = {"axial": 1.0, "circumferential": 0.0}.get(
                    part.invariant, np.cos(np.radians(part.values.get("theta", 45.0)))**2)
                most = max(most, 2 * np.sqrt(along * (1 - along)) * g + along * g * g)
            continue
        if curve.kind.startswith("uniaxial"):
            l1, l2 = free_strip(material, curve.load, curve.axis)
        else:
            l1, l2 = stretches(curve)
        most = max(most, float(np.max(invariant_of(part, l1, l2)[0])))
    return float(most)


def rubber(random: np.random.Generator, rows: int = 20) -> typing.List[Curve]:
    """Up to stretches before which natural rubber begins to crystallise (Treloar 1944)."""
    def path(most: float, start: float = 1.0) -> Array:
        return np.round(np.linspace(start, most, rows), 4)

    return [Curve("uniaxial", "uniaxial_nominal", path(random.uniform(2.4, 3.4))),
            Curve("equibiaxial", "equibiaxial", path(random.uniform(1.8, 2.6))),
            Curve("pure_shear", "pure_shear", path(random.uniform(2.2, 3.2))),
            Curve("simple_shear", "simple_shear", path(random.uniform(1.0, 2.0), 0.0))]


RATIOS = ((1.0, 1.0), (1.0, 0.75), (0.75, 1.0), (1.0, 0.4), (0.4, 1.0))  # Sacks, J. Elasticity 61:199 (2000)


def tissue(material: Material, random: np.random.Generator) -> typing.List[Curve]:
    """Two strips up to 150 kPa or a stretch of 1.6; sheets of five ratios up to 120 kPa or a strain of 0.5."""
    protocol = []
    bearable = random.uniform(100, 150)
    for name, axis in (("circumferential_strip", 1), ("axial_strip", 2)):
        probe = Curve(name, "uniaxial", np.round(np.arange(1.1, 1.605, 0.01), 4), axis)
        ok = np.concatenate([[True], measured(probe, material)[0] < bearable])[1:]
        last = int(np.argmin(ok)) if not ok.all() else len(ok)
        protocol.append(probe._replace(load=np.round(np.linspace(1, probe.load[max(last - 1, 0)], 24), 4)))
    share = np.round(np.linspace(0, 1, 14), 4)
    for index, (around, along) in enumerate(RATIOS):
        strains = np.arange(0.08, 0.505, 0.01)
        l1, l2 = 1 + around * strains, 1 + along * strains
        ok = np.maximum(*stress(material, l1, l2)) < 0.8 * bearable
        last = int(np.argmin(ok)) if not ok.all() else len(ok)
        most = float(strains[max(last - 1, 0)])
        protocol.append(Curve(f"sheet_{index + 1}", "sheet", share, most=(round(around * most, 4), round(along * most, 4))))
    return protocol

