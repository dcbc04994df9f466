# SPDX-License-Identifier: Apache-2.0
"""The table of mistakes: what is spoilt, in which base and tests."""
import typing

import numpy as np

from .spoils import (Spoil, appended, as_change, column_times, exchanged, held_angle, in_measure, in_strain, in_tubes, inside,
                     measured_strip, misread, opposite, prestretched, radii_times, tenth, times, total_force, wall_times, zeroed)


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
