# SPDX-License-Identifier: Apache-2.0
"""What spoils a file: each changes the tables, or the entries, of the tests that it is told."""
import typing

import numpy as np

from .case import Case

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
