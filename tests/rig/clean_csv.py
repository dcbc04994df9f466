#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clean_csv.py TUNICA SOURCES FOLDER: a file with six header lines, a row of units, decimal commas, semicolons, N and mm,
five cycles of preconditioning. Its last loading fits exactly as the clean CSV of it does; without "cycle" the warning
stands first; bad input is refused with its place."""
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

np = rig.numpy()
program, _, out = sys.argv[1:4]
folder = rig.fresh_folder(out)

WIDTH, THICKNESS, GAUGE = 5.0, 1.25, 20.0
generator = np.random.default_rng(17)
rows = []
for cycle in range(6):
    way = np.concatenate([np.arange(0, 41), np.arange(39, 0, -1)]) / 40 * 8.0
    if cycle == 5:
        way = way[:41]
    stretch = 1 + way / GAUGE
    softened = 1 + 0.2 * (5 - cycle)  # every cycle is softer than the one before
    force = softened * 0.05 * (stretch - stretch ** -2) * np.exp(4 * (stretch - 1)) * WIDTH * THICKNESS
    rows += list(zip(way, np.round(force + generator.normal(0, 1e-3, way.size), 5)))


def comma(value):
    return f"{value:.5f}".replace(".", ",")


raw = folder / "strip 3.txt"
raw.write_text("Test machine;ZX 2,5\nMethod;strip, preconditioned\nDate;12.03.2021\nOperator;K. L.\nSpecimen;3\n\n"
               "Time;Standard travel;Standard force\ns;mm;N\n" +
               "".join(f"{comma(0.1 * k)};{comma(way)};{comma(force)}\n" for k, (way, force) in enumerate(rows)),
               encoding="utf-8")
last = np.array(rows[-41:])
clean = folder / "clean.csv"
clean.write_text("stretch [-],stress [kPa]\n" + "".join(
    f"{1 + float(f'{way:.5f}') / GAUGE!r},{1000 * force / (WIDTH * THICKNESS)!r}\n" for way, force in last.tolist()))

block = {"file": raw.name, "columns": {"displacement": "Standard travel", "force": "Standard force"},
         "specimen": {"width": "5 mm", "thickness": "1.25 mm", "gauge_length": "2 cm"},
         "stress_measure": "first_piola_kirchhoff"}
models = {"yeoh": {"type": "yeoh"}, "neo_hooke": {"type": "neo_hooke"}}
last_loading = rig.write_experiment(folder / "raw.json", {**block, "cycle": "last", "branch": "loading"}, models=models)
of_clean = rig.write_experiment(folder / "of_clean.json", {
    "file": clean.name, "columns": {"stretch": "stretch", "stress": "stress"},
    "stress_measure": "first_piola_kirchhoff"}, models=models)
for name, experiment in (("raw", last_loading), ("of_clean", of_clean)):
    printed, _ = rig.tunica(program, "check", experiment)
    assert "warning" not in printed, printed
    rig.tunica(program, "run", experiment, "-o", folder / f"{name}.out")
curves = [rig.fitted_curve(folder / f"{name}.out") for name in ("raw", "of_clean")]
for column in ("stretch", "stress", "stress.predicted"):
    a, b = (np.array(curve[column]) for curve in curves)
    assert a.size == b.size == 82, (column, a.size, b.size)
    assert np.max(np.abs(a - b) / np.maximum(np.abs(b), 1)) < 1e-10, column
a, b = (rig.best_parameters(folder / f"{name}.out") for name in ("raw", "of_clean"))
for name in b:
    assert abs(a[name] - b[name]) <= 1e-10 * max(1, abs(b[name])), (name, a[name], b[name])

# Without "cycle", the first thing said is that six cycles are one curve.
printed, _ = rig.tunica(program, "check", rig.write_experiment(folder / "all.json", block))
warning = printed.index("  ! ")
assert printed.count("\n", 0, warning) == 1, f"the warning does not stand first:\n{printed}"
said = " ".join(printed[warning:].split())
assert "the rows go through 6 cycles of 'stretch' and are read as one curve" in said, printed

# Bad input: what is wrong, where, exit code 2, and nothing is written.
REFUSED = [
    ({"columns": {"displacement": "Standard travel", "force": "Standard forse"}}, "Did you mean 'Standard force'?"),
    ({"specimen": {"width": 5, "thickness": "-1.25 mm", "gauge_length": 20}}, "the thickness is -1.25 mm"),
    ({"specimen": {"width": 5, "thickness": 1.25, "gauge_length": 0}}, "the gauge length is 0 mm"),
    ({"cycle": 9}, "there is no cycle 9. Cycles found from the turning points: 1, 2, 3, 4, 5, 6."),
    ({"preload": "9 kN", "cycle": "last"}, "is not reached"),
    ({"skip_lines": 4000}, "no table follows"),
    ({"units": {"Standard force": "mm"}}, "cannot be converted to 'mN'"),
]
for change, expected in REFUSED:
    bad = rig.write_experiment(folder / "bad.json", {**block, **change})
    _, message = rig.tunica(program, "run", bad, "-o", folder / "bad.out", code=2)
    assert expected in " ".join(message.split()), f"{change}: {message}"
    assert not (folder / "bad.out").exists()
print("the last loading of the raw file fits as the clean CSV does")
