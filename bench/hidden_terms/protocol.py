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


def measured(curve: Curve, material: Material, scale: float = 1, offset: float = 0) -> Array:
    """Channels (1 or 2 rows) by n rows, before the load cell errs."""
    if curve.kind == "simple_shear":
        return np.array([shear_stress(material, curve.load * scale + offset)])
    if curve.kind.startswith("uniaxial"):
        pulled = curve.load * scale + offset
        l1, l2 = free_strip(material, pulled, curve.axis)
        found = stress(material, l1, l2)[curve.axis - 1]
        return np.array([found / pulled if curve.nominal else found])
    l1, l2 = stretches(curve, scale, offset)
    both = stress(material, l1, l2)
    if curve.kind == "sheet":
        return np.array(both)
    return np.array([both[0] / l1])


def observe(protocol: typing.Sequence[Curve], material: Material, error: typing.Optional[RigError] = None) -> Array:
    """All readings of a protocol, as one vector."""
    parts = []
    for index, curve in enumerate(protocol):
        wrong = error if error is not None and error.curve == index else None
        scale = 1 + wrong.amount if wrong is not None and wrong.kind == "reference_length" else 1.0
        offset = wrong.amount if wrong is not None and wrong.kind == "stretch_offset" else 0.0
        y = measured(curve, material, scale, offset)
        if wrong is not None:
            rows = slice(None) if wrong.channel < 0 else slice(wrong.channel, wrong.channel + 1)
            gone = np.linspace(0, 1, y.shape[1])
            if wrong.kind == "force_offset":
                y[rows] += wrong.amount
            elif wrong.kind in ("force_scale", "thickness"):
                y[rows] *= 1 + wrong.amount
            elif wrong.kind == "drift":
                y[rows] += wrong.amount * gone
            elif wrong.kind == "gain_drift":
                y[rows] *= 1 + wrong.amount * gone
        parts.append(y.ravel())
    return np.concatenate(parts)


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

