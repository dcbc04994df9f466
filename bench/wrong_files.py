#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The blind benchmark of files that say what is not so: write honest data of a true base model into files with one
mistake, and honest files with a real effect; let tunica diagnose them, and count.

    bench/wrong_files.py OUT                   every mistake once, development seed 301
    bench/wrong_files.py OUT --draws 3         three specimens of each
    bench/wrong_files.py OUT --reduced         every fourth mistake
    bench/wrong_files.py OUT --only measure    mistakes whose name has this word
    bench/wrong_files.py OUT --unstated        nobody states the noise
    bench/wrong_files.py OUT --full            without --quick

A mistake is right where it, or one that the data cannot tell from it, is `named`, or `tied`: it stands in the verdict as
a question. `look-alike`: a cause in the rig that the catalogue lists as its look-alike is in the verdict. `false science`:
another cause, or a term, is the verdict and no question is asked. Two strips alone are counted by themselves, because they
often cannot tell a mistake from an effect; honest files with an error of the rig too, because the group `file` has such
errors. Nothing here links or calls tunica but to diagnose. Needs numpy and scipy."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import typing
import zlib

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np  # noqa: E402

from hidden_terms.bases import curves, draw  # noqa: E402
from hidden_terms.case_files import columns, model_entry, test_entry  # noqa: E402
from hidden_terms.generate import Spec, make  # noqa: E402
from hidden_terms.protocol import Curve, channel_slices, observe  # noqa: E402
from hidden_terms.tubes import inflation  # noqa: E402

DEVELOPMENT_SEED = 301
UNITS = {"time": "s", "pressure": "kPa", "outer_diameter": "mm", "axial_force": "mN"}
NOISE = 0.01  # of the range of every channel
BUILT = pathlib.Path(__file__).resolve().parents[1] / "build/release/bin/tunica"
PROGRAM = os.environ.get("TUNICA", str(BUILT))  # another program: TUNICA=/path/to/tunica
# Causes in the rig with the same effect as a mistake with an amplitude.
LOOK_ALIKES = {
    "displacement_offset": {"reference_length_error", "zeroed_at_preload", "force_offset"},
    "zeroed_at_preload": {"reference_length_error", "displacement_offset", "force_offset"},
    "machine_compliance": {"reference_length_error", "force_scale_error"},
    "sheet_prestretch": {"sheet_force_scale_error"}, "sheet_force_offset": {"outliers"},
    "sheet_force_scale_error": {"sheet_prestretch"}, "force_scale_error": {"reference_length_error"},
    "reference_length_error": {"force_scale_error", "displacement_offset"}}


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


Truth = typing.Tuple[str, typing.List[str]]  # the kind, and the tests that it is in
Spoil = typing.Callable[[Case, typing.List[str]], None]


def in_measure(power: int) -> Spoil:
    """Values of another measure: v λ^power."""
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            for stress in case.stresses(test):
                stretch = stress.replace("stress", "stretch")
                if stretch not in case.tables[test]:
                    continue
                case.tables[test][stress] = case.tables[test][stress] * case.tables[test][stretch]**power
    return spoil


def in_strain(shown: typing.Callable[[np.ndarray], np.ndarray], key: str = "stretch") -> Spoil:
    """What the column has of a stretch, under the name `key`."""
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            for name in case.stretches(test):
                case.tables[test][name] = shown(case.tables[test][name])
                named = case.tests[test]["data"]["columns"]
                case.tests[test]["data"]["columns"] = {
                    (k.replace("stretch", key) if k == name else k): v for k, v in named.items()}
    return spoil


def exchanged(what: str) -> Spoil:
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            if case.tests[test]["type"] == "uniaxial":
                other = {"circumferential": "axial", "axial": "circumferential"}
                case.tests[test]["direction"] = other[case.tests[test]["direction"]]
                continue
            table = case.tables[test]
            for word in ("stretch", "stress"):
                if what in (word, "both"):
                    one, two = f"{word}_circumferential", f"{word}_axial"
                    table[one], table[two] = table[two], table[one]
    return spoil


def times(factor: float, only: str = "stress") -> Spoil:
    """The file has 1/factor of the true value."""
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            for name in case.tables[test]:
                if "stress" in name and only in name:
                    case.tables[test][name] = case.tables[test][name] / factor
    return spoil


def opposite(stretches: bool, stresses: bool) -> Spoil:
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            for name in case.stretches(test) if stretches else []:
                case.tables[test][name] = 2 - case.tables[test][name]
            for name in case.stresses(test) if stresses else []:
                case.tables[test][name] = -case.tables[test][name]
    return spoil


def held_angle(shown: typing.Callable[[float], float]) -> Spoil:
    def spoil(case: Case, _: typing.List[str]) -> None:
        theta = case.model["parameters"]["theta"]["true"]
        case.model["parameters"]["theta"] = {"fixed": float(shown(theta))}
    return spoil


def in_tubes(change: typing.Callable[[Case, str], None]) -> Spoil:
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            change(case, test)
    return spoil


def column_times(name: str, factor: float) -> Spoil:
    def change(case: Case, test: str) -> None:
        case.tables[test][name] = case.tables[test][name] * factor
    return in_tubes(change)


def inside(case: Case, test: str) -> None:
    case.tables[test]["outer_diameter"] = case.inner[test]


def as_change(case: Case, test: str) -> None:
    case.tables[test]["outer_diameter"] = case.tables[test]["outer_diameter"] - 2 * case.tests[test]["outer_radius"]


def total_force(case: Case, test: str) -> None:
    table = case.tables[test]
    table["axial_force"] = table["axial_force"] + table["pressure"] * np.pi / 4 * case.inner[test]**2


def tenth(case: Case, tests: typing.List[str]) -> None:
    """Strains of a tenth of what they are: millimetres for centimetres."""
    in_strain(lambda l: 1 + (l - 1) / 10)(case, tests)


def radii_times(inner: float, outer: float) -> Spoil:
    def change(case: Case, test: str) -> None:
        case.tests[test]["inner_radius"] *= inner
        case.tests[test]["outer_radius"] *= outer
    return in_tubes(change)


def wall_times(factor: float) -> Spoil:
    def change(case: Case, test: str) -> None:
        inner, outer = case.tests[test]["inner_radius"], case.tests[test]["outer_radius"]
        case.tests[test]["outer_radius"] = inner + factor * (outer - inner)
    return in_tubes(change)


def measured_strip(recorded: typing.Callable[[np.ndarray, np.ndarray], typing.Tuple[np.ndarray, np.ndarray]]) -> Spoil:
    """Stretch and force over unloaded area as they are recorded, of the true ones. Stress is Cauchy's, from both."""
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            table = case.tables[test]
            if "stretch" not in table:
                continue
            nominal = case.tests[test]["data"].get("stress_measure") == "first_piola_kirchhoff"
            stretch, force = recorded(table["stretch"], table["stress"] / (1 if nominal else table["stretch"]))
            case.tables[test] = {"stretch": stretch, "stress": force * (1 if nominal else stretch)}
    return spoil


def zeroed(share: float) -> Spoil:
    """Force and length at this share of the largest stretch, less 1, are the zeros; rows before it are not there."""
    def recorded(stretch: np.ndarray, force: np.ndarray) -> typing.Tuple[np.ndarray, np.ndarray]:
        first = int(np.searchsorted(stretch, 1 + share * (np.max(stretch) - 1)))
        return stretch[first:] / stretch[first], force[first:] - force[first]
    return measured_strip(recorded)


def prestretched(names: typing.Sequence[str], amount: float) -> Spoil:
    """Recorded stretches of a sheet are true ones over 1 + amount; stress is Cauchy's, from force and recorded stretch."""
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            for name in names if test.startswith("sheet") else ():
                case.tables[test][f"stretch_{name}"] = case.tables[test][f"stretch_{name}"] / (1 + amount)
                case.tables[test][f"stress_{name}"] = case.tables[test][f"stress_{name}"] / (1 + amount)
    return spoil


def misread(names: typing.Sequence[str], gain: float, offset: float, sort: str = "sheet") -> Spoil:
    """`offset` is a share of the range."""
    def spoil(case: Case, tests: typing.List[str]) -> None:
        for test in tests:
            for name in names if sort in test else ():
                y = case.tables[test][name]
                case.tables[test][name] = (1 + gain) * y + offset * float(np.ptp(y))
    return spoil


def appended(case: Case, tests: typing.List[str]) -> None:
    case.appended.update(tests)


class Mistake(typing.NamedTuple):
    name: str
    base: str
    kind: str
    tests: typing.List[str]  # empty: all
    spoil: Spoil
    only: typing.List[str] = []  # tests that the file has; empty: all
    mechanism: str = ""  # of a mistake with an amplitude


def mistakes() -> typing.List[Mistake]:
    found: typing.List[Mistake] = []
    strip, sheet = ["axial_strip"], ["sheet_2"]
    sheets = [f"sheet_{k}" for k in range(1, 6)]
    pulled = ["uniaxial", "equibiaxial", "pure_shear"]

    def add(name: str, kind: str, spoil: Spoil, base: str, tests: typing.List[str], mechanism: str = "",
            only: typing.Sequence[str] = ()) -> None:
        found.append(Mistake(f"{name}-{base}-{'all' if len(tests) != 1 else tests[0]}", base, kind, tests, spoil, list(only),
                             mechanism))

    tissue = ["circumferential_strip", "axial_strip", *sheets]
    everywhere = {"gho": tissue, "hgo": tissue, "mooney_rivlin": pulled}
    one = {"gho": strip, "hgo": sheet, "mooney_rivlin": ["pure_shear"]}
    for base in ("gho", "hgo", "mooney_rivlin"):
        rubber = base == "mooney_rivlin"
        for scope in (everywhere[base], one[base]):
            for power, name in ((1, "cauchy"), (-1, "second")) if rubber else ((-1, "nominal"), (-2, "second")):
                add(f"measure-{name}", "stress_measure", in_measure(power), base, scope)
            add("strain-hencky", "strain_definition", in_strain(lambda l: 1 + np.log(l)), base, scope)
            add("strain-green", "strain_definition", in_strain(lambda l: 1 + (l * l - 1) / 2), base, scope)
            add("strain-declared", "strain_definition", in_strain(np.log, "strain"), base, scope)
            add("strain-reverse", "strain_definition", in_strain(lambda l: l - 1, "green_strain"), base, scope)
        add("strain-squared", "strain_definition", in_strain(np.square), base, one[base])
        for factor in (1000, 9.80665, 10, 7.500617, 6.894757, 4.448222, 4, 2):
            add(f"unit-{factor:.4g}", "unit", times(factor), base, one[base])
        for factor in (9.80665, 4, 2):
            add(f"unit-by-{factor:.4g}", "unit", times(1 / factor), base, one[base])
        add("unit-1000", "unit", times(1000), base, everywhere[base])
    for base in ("gho", "hgo"):
        add("unit-direction-4", "unit", times(4, "stress_axial"), base, ["sheet_4"])
        add("exchange-stretch", "exchange", exchanged("stretch"), base, ["sheet_4"])
        add("exchange-stress", "exchange", exchanged("stress"), base, ["sheet_5"])
        add("exchange-both", "exchange", exchanged("both"), base, ["sheet_2"])
        add("exchange-stretch", "exchange", exchanged("stretch"), base, sheets)
        add("exchange-strip", "exchange", exchanged("both"), base, strip)
        add("angle-other", "angle", held_angle(lambda a: 90 - a), base, [])
        add("angle-radians", "angle", held_angle(np.radians), base, [])
        add("sign-stress", "sign", opposite(False, True), base, strip)
    tubes = ["tube_110", "tube_125", "tube_140"]
    for scope in (tubes, tubes[:1]):
        for name, kind, spoil in (
                ("tube-inside", "geometry", in_tubes(inside)), ("tube-radius", "geometry", column_times("outer_diameter", 0.5)),
                ("tube-change", "geometry", in_tubes(as_change)), ("tube-total-force", "geometry", in_tubes(total_force)),
                ("tube-mmHg", "unit", column_times("pressure", 7.500617)), ("tube-gf", "unit", column_times("axial_force", 1 / 9.80665)),
                ("tube-psi", "unit", column_times("pressure", 1 / 6.894757)),
                ("tube-mbar", "unit", column_times("pressure", 10)),
                ("tube-cmH2O", "unit", column_times("pressure", 10.19716)),
                ("tube-lbf", "unit", column_times("axial_force", 1 / 4.448222)),
                ("tube-N", "unit", column_times("axial_force", 1e-3)),
                ("tube-radii-diameters", "geometry", radii_times(2, 2)),
                ("tube-radii-half", "geometry", radii_times(0.5, 0.5)),
                ("tube-wall-double", "geometry", wall_times(2)), ("tube-wall-half", "geometry", wall_times(0.5))):
            add(name, kind, spoil, "hgo", scope)

    for base in ("gho", "hgo", "mooney_rivlin"):
        for factor in (1000, 10, 7.500617, 6.894757, 4.448222, 1.35951, 4 / np.pi):
            add(f"unit-by-{factor:.4g}", "unit", times(1 / factor), base, one[base])
        for factor in (1.35951, 4 / np.pi):
            add(f"unit-{factor:.4g}", "unit", times(factor), base, one[base])
        add("strain-tenth", "strain_definition", tenth, base, one[base])
    strips = ["circumferential_strip", "axial_strip"]
    both = ["circumferential", "axial"]
    for base in ("gho", "hgo"):
        add("unit-direction-1000", "unit", times(1000, "stress_axial"), base, ["sheet_3"])
        add("unit-direction-9.807", "unit", times(9.80665, "stress_circumferential"), base, ["sheet_1"])
        add("exchange-stress", "exchange", exchanged("stress"), base, sheets)
        add("sign-stretch", "sign", opposite(True, False), base, strip)
        add("sign-both", "sign", opposite(True, True), base, strip)
        for scope in (strip, strips):
            add("zero-stretch", "calibration", measured_strip(lambda l, p: (l - 0.03, p)), base, scope, "displacement_offset")
            add("zero-slack", "calibration", measured_strip(lambda l, p: (l + 0.04, p)), base, scope, "displacement_offset")
            add("zero-preload", "calibration", zeroed(0.3), base, scope, "zeroed_at_preload")
            add("machine", "calibration", measured_strip(lambda l, p: (l + 0.05 * p / np.max(p), p)), base, scope,
                "machine_compliance")
        add("strips-gain", "calibration", misread(["stress"], 0.2, 0, "strip"), base, strips, "force_scale_error")
        add("strips-length", "calibration", measured_strip(lambda l, p: (l / 1.05, p)), base, strips, "reference_length_error")
        for scope in (sheet, sheets):
            add("sheet-prestretch", "calibration", prestretched(["axial"], 0.05), base, scope, "sheet_prestretch")
            add("sheet-prestretches", "calibration", prestretched(both, 0.04), base, scope, "sheet_prestretch")
            add("sheet-offset", "calibration", misread(["stress_axial"], 0, 0.1), base, scope, "sheet_force_offset")
            add("sheet-gain", "calibration", misread(["stress_circumferential"], 0.2, 0), base, scope, "sheet_force_scale_error")
        add("appended", "inspection", appended, base, sheet)
    # Two strips and nothing else.
    for base in ("gho", "hgo"):
        for name, kind, spoil, mechanism in (
                ("nominal", "stress_measure", in_measure(-1), ""), ("hencky", "strain_definition", in_strain(lambda l: 1 + np.log(l)), ""),
                ("green", "strain_definition", in_strain(lambda l: 1 + (l * l - 1) / 2), ""),
                ("9.807", "unit", times(9.80665), ""), ("1000", "unit", times(1000), ""), ("4", "unit", times(4), ""),
                ("sign", "sign", opposite(False, True), ""), ("preload", "calibration", zeroed(0.3), "zeroed_at_preload"),
                ("machine", "calibration", measured_strip(lambda l, p: (l + 0.05 * p / np.max(p), p)), "machine_compliance"),
                ("zero", "calibration", measured_strip(lambda l, p: (l - 0.03, p)), "displacement_offset")):
            for scope in (strips, strip):
                add(f"two-strips-{name}", kind, spoil, base, scope, mechanism, strips)
        add("two-strips-exchange", "exchange", exchanged("both"), base, strips, "", strips)
    return found


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


def diagnosed(folder: pathlib.Path, full: bool = False) -> typing.Tuple[typing.Dict[str, typing.Any], float]:
    """The diagnosis of a folder, and CPU seconds."""
    out = folder / "out"
    if not (out / "result.json").exists():
        told = subprocess.run(
            ["/usr/bin/time", "-f", "%U", PROGRAM, "diagnose", *([] if full else ["--quick"]), "--quiet", str(folder / "experiment.json"), "-o",
             str(out)], capture_output=True, text=True, check=False)
        if told.returncode in (126, 127):
            raise SystemExit(f"{PROGRAM} cannot be run; build it, or set TUNICA")
        (folder / "said.txt").write_text(told.stdout + told.stderr)
    if not (out / "result.json").exists():
        return {}, 0
    seconds = float((folder / "said.txt").read_text().strip().splitlines()[-1])
    return json.loads((out / "result.json").read_text())["diagnosis"], seconds


def judged(d: typing.Dict[str, typing.Any], mistake: Mistake, tests: typing.List[str], everything: typing.List[str]) -> str:
    """What the diagnosis makes of a file with this mistake. A mistake in some tests is the reverse one in all others."""
    if not d:
        return "refused"
    file = d.get("file", {"standing": "not_looked_for", "causes": []})
    if mistake.kind == "inspection" and file.get("suspect"):
        return "named"
    if d["verdict"] == "nothing_detected":
        return "silent"
    mirror = sorted(set(everything) - set(tests))
    if file["standing"] in ("near", "ahead"):
        alike = {mistake.mechanism, *LOOK_ALIKES.get(mistake.mechanism, ())}
        for cause in file["causes"]:
            if cause["near"] and cause["kind"] == mistake.kind and cause.get("mechanism", "") in alike and (
                    sorted(cause["tests"]) in (sorted(tests), mirror) or mistake.kind == "angle"):
                return "named" if file["standing"] == "ahead" else "tied"
        if any(cause["near"] for cause in file["causes"]):
            return "other mistake"
    targets = [(cause["id"], cause["target"] or {}) for cause in d.get("causes", [])]
    claimed = {name for name, at in targets if sorted(at.get("tests", [at.get("test", "")])) in (sorted(tests), mirror)}
    # A gain of a strip is also the area that its force was divided by.
    alike = {"force_scale_error"} if mistake.kind == "unit" else LOOK_ALIKES.get(mistake.mechanism, set())
    if claimed & alike:
        return "look-alike"
    return "false science" if d["verdict"] in ("named", "discovered", "indistinguishable", "leading") else d["verdict"]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--draws", type=int, default=1)
    parser.add_argument("--reduced", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=DEVELOPMENT_SEED)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--unstated", action="store_true", help="nobody states the noise")
    parser.add_argument("--full", action="store_true", help="without --quick")
    parser.add_argument("--stride", type=int, default=1, help="every so many mistakes")
    parser.add_argument("--effects", type=int, default=4, help="honest files with a real effect, of each base and size")
    told = parser.parse_args()
    chosen = [one for one in mistakes() if told.only in one.name][::4 if told.reduced else told.stride]
    jobs: typing.List[typing.Tuple[pathlib.Path, typing.Optional[Mistake], typing.List[str]]] = []
    for mistake in chosen:
        for k in range(told.draws):
            case = honest(mistake.base, told.seed + k, mistake.kind == "angle", mistake.name.startswith("tube"))
            if mistake.only:
                case.keep(mistake.only)
            everything = list(case.tests)
            mistake.spoil(case, mistake.tests or everything)
            group = "two strips alone" if mistake.only else "calibration" if mistake.mechanism else "mistakes"
            folder = told.out / group.replace(" ", "_") / f"{mistake.name}-{k}"
            case.write(folder, stated=not told.unstated)
            jobs.append((folder, mistake, everything))
    for base in ("gho", "hgo", "mooney_rivlin") if not told.only else ():
        for target in (60, 150):
            for k in range(told.effects):
                for what, folder in (("single", "effects"), ("rig", "rig_errors")):
                    name = make(Spec(what, base, target, k, "white", not told.unstated), told.seed, told.out / folder)
                    jobs.append((told.out / folder / "cases" / name, None, []))
        for k in range(told.effects):
            folder = told.out / "honest" / f"{base}-{k}"
            honest(base, told.seed + 1000 + k, False).write(folder, stated=not told.unstated)
            jobs.append((folder, None, []))
    with concurrent.futures.ThreadPoolExecutor(told.jobs) as pool:
        found = list(pool.map(lambda job: diagnosed(job[0], told.full), jobs))
    counts: typing.Dict[str, typing.List[str]] = {}
    for (folder, mistake, everything), (d, seconds) in zip(jobs, found):
        file = d.get("file", {})
        group = folder.relative_to(told.out).parts[0].replace("_", " ")
        if mistake is None:
            word = f"file {file.get('standing')}" if d.get("verdict") != "nothing_detected" else "silent"
        else:
            word = judged(d, mistake, mistake.tests or everything, everything)
        counts.setdefault(group, []).append(word)
        first = file["causes"][0] if file.get("causes") else {}
        print(f"{word:14} {folder.name:44} {seconds:6.1f} s {d.get('verdict')}; {file.get('standing')}, lead "
              f"{file.get('lead') if file.get('lead') is None else round(file['lead'], 1)}, p {first.get('p_after', 0):.3f}: {first.get('sentence', '')}")
    for group, words in counts.items():
        rates = ", ".join(f"{word} {words.count(word)}" for word in sorted(set(words)))
        print(f"{group}: {len(words)} files: {rates}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
