# SPDX-License-Identifier: Apache-2.0
"""An honest experiment of a true base model, and its files."""
import json
import pathlib
import typing
import zlib

import numpy as np

from hidden_terms.bases import curves, draw
from hidden_terms.case_files import columns, model_entry, test_entry
from hidden_terms.protocol import Curve, channel_slices, observe
from hidden_terms.tubes import inflation

UNITS = {"time": "s", "pressure": "kPa", "outer_diameter": "mm", "axial_force": "mN"}
NOISE = 0.01  # of the range of every channel


class Case:
    """An experiment file and its tables without noise, to be spoilt. Noise belongs to the numbers of the file."""

    def __init__(self, base: str, protocol: typing.Sequence[Curve], readings: np.ndarray, random: np.random.Generator):
        self.random = random
        self.inner: typing.Dict[str, np.ndarray] = {}
        self.appended: typing.Set[str] = set()  # tests whose last two thirds stand in their file twice
        self.base, self.model = base, model_entry(base)
        self.tests: typing.Dict[str, typing.Dict[str, typing.Any]] = {}
        self.tables: typing.Dict[str, typing.Dict[str, np.ndarray]] = {}
        slices, at = channel_slices(protocol), 0
        for curve in protocol:
            own = range(at, at + curve.channels)
            at += curve.channels
            prescribed = [1 + curve.load * m for m in curve.most] if curve.kind == "sheet" else [curve.load]
            names = [name for name, _ in columns(curve)]
            self.tables[curve.name] = dict(zip(names, [*prescribed, *(readings[slices[k]] for k in own)]))
            self.tests[curve.name] = test_entry(curve, [(1.0, 0.0) for _ in own])

    def add_tubes(self, material: typing.Any) -> None:
        """Three inflations of one tube, outer diameter and reduced force."""
        for axial in (1.1, 1.25, 1.4):
            name, radii = f"tube_{round(100 * axial)}", (3.5, 4.6)
            rows = inflation(material, radii, axial, np.linspace(1, 16, 12))
            self.tables[name] = {key: rows[key] for key in ("pressure", "outer_diameter", "axial_force")}
            self.inner[name] = rows["inner_diameter"]
            self.tests[name] = {"type": "thick_wall_pressurisation", "inner_radius": radii[0], "outer_radius": radii[1],
                                "axial_stretch": axial, "data": {
                                    "file": f"{name}.csv", "order": "loading", "columns": {key: key for key in self.tables[name]},
                                    "noise": {key: {"absolute": 1.0} for key in ("outer_diameter", "axial_force")}}}

    def stretches(self, test: str) -> typing.List[str]:
        return [name for name in self.tables[test] if name.startswith("stretch")]

    def stresses(self, test: str) -> typing.List[str]:
        return [name for name in self.tables[test] if name.startswith("stress")]

    def keep(self, tests: typing.Sequence[str]) -> None:
        for name in [name for name in self.tests if name not in tests]:
            del self.tests[name], self.tables[name]

    def write(self, folder: pathlib.Path, share: float = NOISE, stated: bool = True) -> None:
        """`share`: noise, of the range of every channel."""
        folder.mkdir(parents=True, exist_ok=True)
        for name, table in self.tables.items():
            for channel, noise in self.tests[name]["data"]["noise"].items():
                noise["absolute"] = share * float(np.ptp(table[channel]))
                table[channel] = table[channel] + noise["absolute"] * self.random.standard_normal(len(table[channel]))
            units = {column: UNITS.get(column, "kPa" if "stress" in column else "-") for column in table}
            lines = [",".join(f"{column} [{units[column]}]" for column in table)]
            lines += [",".join(f"{value:.7g}" for value in row) for row in np.column_stack(list(table.values()))]
            lines += lines[1 + len(lines) // 3:] if name in self.appended else []
            (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")
            if not stated:
                del self.tests[name]["data"]["noise"]
        (folder / "experiment.json").write_text(json.dumps({
            "format": 1, "name": folder.name, "seed": 1, "models": {self.base: self.model}, "tests": self.tests,
            "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm", "starts": 10}},
            "runs": [{"model": self.base, "optimizer": "lm"}]}, indent=1) + "\n")


def honest(base: str, seed: int, held: bool, tubes: bool = False) -> Case:
    random = np.random.default_rng([seed, zlib.crc32(base.encode())])
    while True:
        form = draw(base, random)
        try:
            protocol = curves(base, form, random)
            clean = observe(protocol, form.material)
            break
        except ArithmeticError:
            continue
    case = Case(base, protocol, clean, random)
    if tubes:
        for name in [name for name in case.tests if name.startswith("sheet")]:
            del case.tests[name], case.tables[name]
        case.add_tubes(form.material)
    if held:
        case.model["parameters"]["theta"] = {"true": next(p.values["theta"] for p in form.material if "theta" in p.values)}
    return case
