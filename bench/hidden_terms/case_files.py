# SPDX-License-Identifier: Apache-2.0
"""A case on disk: experiment.json and its tables in one folder, the truth in another, sealed by its SHA-256.

CASES/NAME has what the program may see, and truth.sha256; TRUTHS/NAME.json has what was hidden."""
import hashlib
import json
import pathlib
import typing

import numpy as np

from .bases import BOUNDS
from .laws import Array
from .protocol import Curve, channel_slices

SEAL = "truth.sha256"


class Tampered(Exception):
    """A truth is not the one that was sealed."""


class Noise(typing.NamedTuple):
    """Standard deviation of channel k: √(absolute[k]² + (relative[k] y)²); kPa and a share."""
    absolute: typing.List[float]
    relative: typing.List[float]

    def sd(self, protocol: typing.Sequence[Curve], y: Array) -> Array:
        """Of readings y without noise: n numbers."""
        sd = np.empty_like(y)
        for rows, a, b in zip(channel_slices(protocol), self.absolute, self.relative):
            sd[rows] = np.hypot(a, b * y[rows])
        return sd


def significant(value: float, digits: int = 3) -> float:
    return float(f"{value:.{digits - 1}e}")


def draw_noise(kind: str, protocol: typing.Sequence[Curve], y: Array, random: np.random.Generator) -> Noise:
    """1 to 2 % of what each channel spans: everywhere (white), or half of it and the rest in proportion (relative)."""
    absolute, relative = [], []
    for rows in channel_slices(protocol):
        span = float(np.ptp(y[rows]))
        sd = significant(random.uniform(0.01, 0.02) * span)
        absolute.append(sd if kind == "white" else significant(0.5 * sd))
        relative.append(0.0 if kind == "white" else significant(0.87 * sd / float(np.max(np.abs(y[rows])))))
    return Noise(absolute, relative)


def seal(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def open_truth(case: pathlib.Path, truths: pathlib.Path) -> typing.Dict[str, typing.Any]:
    """What was hidden in a case. Raises Tampered where the truth is missing or does not fit its seal."""
    file = truths / f"{case.name}.json"
    if not file.exists():
        raise Tampered(f"{file} is missing")
    text = file.read_text()
    if seal(text) != (case / SEAL).read_text().strip():
        raise Tampered(f"{file} does not fit the seal {case / SEAL}")
    truth: typing.Dict[str, typing.Any] = json.loads(text)
    return truth


def columns(curve: Curve) -> typing.List[typing.Tuple[str, str]]:
    """Observable and unit of each column of a table."""
    if curve.kind == "sheet":
        return [("stretch_circumferential", "-"), ("stretch_axial", "-"), ("stress_circumferential", "kPa"),
                ("stress_axial", "kPa")]
    if curve.kind == "simple_shear":
        return [("shear", "-"), ("shear_stress", "kPa")]
    return [("stretch", "-"), ("stress", "kPa")]


def table(curve: Curve, readings: Array) -> str:
    """Text of a table: prescribed columns, then the channels (channels by n rows, kPa)."""
    prescribed = [curve.load]
    if curve.kind == "sheet":
        prescribed = [1 + curve.load * most for most in curve.most]
    lines = [",".join(f"{name} [{unit}]" for name, unit in columns(curve))]
    for row in np.column_stack([*prescribed, *readings]):
        lines.append(",".join(f"{value:.7g}" for value in row))
    return "\n".join(lines) + "\n"


def test_entry(curve: Curve, noise: typing.Optional[typing.List[typing.Tuple[float, float]]]) -> typing.Dict[str, typing.Any]:
    """A test of the experiment file; `noise` has (absolute, relative) of each channel, None leaves it out."""
    axis = "circumferential" if curve.axis == 1 else "axial"
    entry: typing.Dict[str, typing.Any] = {
        "uniaxial": {"type": "uniaxial", "direction": axis}, "uniaxial_nominal": {"type": "uniaxial", "direction": axis},
        "sheet": {"type": "biaxial"}, "equibiaxial": {"type": "biaxial", "protocol": "equibiaxial"},
        "pure_shear": {"type": "biaxial", "protocol": "pure_shear", "direction": axis},
        "simple_shear": {"type": "simple_shear", "direction": "circumferential", "normal": "axial"}}[curve.kind]
    names = [name for name, _ in columns(curve)]
    data: typing.Dict[str, typing.Any] = {"file": f"{curve.name}.csv", "columns": {name: name for name in names},
                                          "order": "loading"}
    if curve.nominal:
        data["stress_measure"] = "first_piola_kirchhoff"
    if noise is not None:
        data["noise"] = {name: {key: value for key, value in (("absolute", a), ("relative", b)) if value > 0}
                         for name, (a, b) in zip(names[-curve.channels:], noise)}
    return {**entry, "data": data}


def model_entry(base: str) -> typing.Dict[str, typing.Any]:
    if base in ("gho", "hgo"):
        return {"type": base, "parameters": {
            name: {"min": low, "max": high, **({"scale": "log"} if name in ("mu", "k1", "k2") else {})}
            for name, (low, high) in BOUNDS.items() if base == "gho" or name != "kappa"}}
    return {"type": base}


def write_case(cases: pathlib.Path, truths: pathlib.Path, name: str, base: str,
               protocol: typing.Sequence[Curve], readings: Array, noise: typing.Optional[Noise],
               truth: typing.Dict[str, typing.Any], from_nothing: bool = False) -> pathlib.Path:
    """Writes a case and seals its truth; the seal comes last, so that a folder with a seal is whole. From nothing, `base`
    only says whether the material has directions. `noise` None: not stated."""
    folder = cases / name
    folder.mkdir(parents=True, exist_ok=True)
    truths.mkdir(parents=True, exist_ok=True)
    slices, tests = channel_slices(protocol), {}
    at = 0
    for curve in protocol:
        own = range(at, at + curve.channels)
        at += curve.channels
        (folder / f"{curve.name}.csv").write_text(table(curve, np.array([readings[slices[k]] for k in own])))
        stated = None if noise is None else [(noise.absolute[k], noise.relative[k]) for k in own]
        tests[curve.name] = test_entry(curve, stated)
    experiment: typing.Dict[str, typing.Any] = {
        "format": 1, "name": name, "seed": 1, "models": {base: model_entry(base)}, "tests": tests,
        "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm", "starts": 10}},
        "runs": [{"model": base, "optimizer": "lm"}]}
    if from_nothing:
        experiment["discovery"] = {"from_nothing": True}
    (folder / "experiment.json").write_text(json.dumps(experiment, indent=1) + "\n")
    text = json.dumps(truth, indent=1) + "\n"
    (truths / f"{name}.json").write_text(text)
    (folder / SEAL).write_text(seal(text) + "\n")
    return folder
