#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: calibrated at the in-vivo stretch alone every model follows its diameters and misses the forces 4 %
above and below, and the warnings say so; calibrated on everything hgo and gho still miss the forces, and four_fibre is
within what inflation and force-length tests disagree by where they meet, which is measured here again. Of the clamped
tube: its calibration fits the inflations better than that of a long one, with other parameters."""
import csv
import json
import math
import sys

RESULTS = sys.argv[1]
result = json.load(open(RESULTS + "/result.json", encoding="utf-8"))
if result["name"] == "murine-tube-clamped":
    assert [run["run"] for run in result["runs"]] == ["four_fibre/lm", "four_fibre/lm#2"], "expected two runs"
    long, clamped = (run["best"] for run in result["runs"])
    assert abs(long["objective"] / 21.987 - 1) < 2e-3, f"long tube: {long['objective']}"
    assert abs(clamped["objective"] / 15.22 - 1) < 0.01, f"clamped tube: {clamped['objective']}"
    for best in (long, clamped):
        assert not best["certificate"]["neighbours"]["better"], best["certificate"]["verdict"]
    k2 = [best["parameters"]["k2"] for best in (long, clamped)]
    assert k2[1]["value"] < 0.75 * k2[0]["value"] and all(k["ci95"] for k in k2), f"k2 {k2}"
    print(f"murine tube: chi-squared of the inflations {long['objective']:.1f} as a long tube, {clamped['objective']:.1f} as a clamped one")
    sys.exit()

ONE, THREE, SEVEN = ("hgo/lm", "gho/lm", "four_fibre/lm"), "four_fibre/lm#2", ("hgo/lm_8", "gho/lm_8", "four_fibre/lm_8")
runs = {run["run"]: run for run in result["runs"]}
assert set(runs) == {*ONE, THREE, *SEVEN}, f"runs {sorted(runs)}"
# Reached from most starts; a parameter may still wander along a valley.
OBJECTIVES = {"hgo/lm": 4.9368, "gho/lm": 4.9368, "four_fibre/lm": 0.68491, "four_fibre/lm#2": 21.464,
              "hgo/lm_8": 1755.8, "gho/lm_8": 1580.9, "four_fibre/lm_8": 106.62}


def channels(run, channel):
    return {test: one for test, fit in runs[run]["best"]["per_test"].items() for one in fit["channels"] if one["channel"] == channel}


def warned(run, kind, subject):
    return any(w["kind"] == kind and w["run"] == run and subject in w["subjects"] for w in result["warning_details"])


def error(run, channel, held_out):
    """Root mean square over all rows, and how many there are."""
    found = [one for one in channels(run, channel).values() if one["held_out"] == held_out]
    rows = sum(one["rows"] for one in found)
    return (math.sqrt(sum(one["rows"] * one["rmse"] ** 2 for one in found) / rows) if rows else None), rows


def measured(test):
    """Rows of one run: axial stretch, pressure, diameter, force."""
    with open(f"{RESULTS}/fit_{test}.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["run"] == SEVEN[0]]
    names = ("axial_stretch", "pressure [kPa]", "outer_diameter [mm]", "axial_force [mN]")
    return [[next(float(value) for key, value in row.items() if key.startswith(name)) for name in names] for row in rows]


def between(rows, x, column):
    """The row where a column has the value x, linearly."""
    rows = sorted(rows, key=lambda row: row[column])
    for a, b in zip(rows, rows[1:]):
        if a[column] <= x <= b[column]:
            w = (x - a[column]) / (b[column] - a[column])
            return [p + w * (q - p) for p, q in zip(a, b)]
    return None


# Where the two protocols meet: inflation at the pressure of the force-length test, this one at the stretch of the former.
squares, count = [0.0, 0.0], 0
for pressure in (2, 8, 17):
    path = measured(f"force_length_{pressure}")
    for inflation in map(measured, ("below", "in_vivo", "above")):
        # The longest force-length state is 0.2 % short of the inflation above; nothing is extrapolated.
        meeting = between(path, min(inflation[0][0], max(row[0] for row in path)), 0)
        other = between(inflation, meeting[1], 1)
        squares[0] += (meeting[2] - other[2]) ** 2
        squares[1] += (meeting[3] - other[3]) ** 2
        count += 1
diameter, force = (math.sqrt(s / count) for s in squares)
assert abs(diameter - 0.176) < 0.001 and abs(force - 7.83) < 0.02, f"the protocols disagree by {diameter} mm, {force} mN"

for name, run in runs.items():
    best = run["best"]
    assert abs(best["objective"] / OBJECTIVES[name] - 1) < 2e-3, f"{name}: objective {best['objective']}"
    assert not best["certificate"]["neighbours"]["better"], f"{name}: {best['certificate']['verdict']}"
    for parameter, found in best["parameters"].items():
        interval = found["ci95"]
        loose = warned(name, "not_fixed_by_data", parameter)
        assert interval or found["at_bound"] or loose, f"{name}: {parameter} has no interval, and nobody says why"
        assert not interval or interval[0] < found["value"] < interval[1], f"{name}: {parameter} {interval}"
        widened = best.get("interval_factor", 1) > 1  # the model misses the data by more than the stated noise
        assert not loose or widened or name in ("four_fibre/lm", "four_fibre/lm_8"), f"{name}: {parameter} is not fixed"

for name in ONE:
    own, unseen = channels(name, "outer_diameter"), channels(name, "axial_force")
    assert own["in_vivo"]["r2"] > 0.8, f"{name}: R² {own['in_vivo']['r2']} of the diameters it was fitted to"
    for test in ("unseen_below", "unseen_above"):
        assert unseen[test]["held_out"] and unseen[test]["r2"] < -2, f"{name}: R² {unseen[test]['r2']} of the forces {test}"
    assert error(name, "axial_force", True)[0] > 10 * error(name, "axial_force", False)[0], name
for name in (*ONE, THREE, *SEVEN):
    said = warned(name, "predicts_worse", "axial_force")
    assert said == (name not in SEVEN), f"{name}: warned of {said}"

# All inflations together: their forces within noise, those of the force-length tests not, nor their diameters.
assert error(THREE, "axial_force", False)[0] < 2 and 5 < error(THREE, "axial_force", True)[0] < 8
assert channels(THREE, "outer_diameter")["unseen_force_length_25"]["r2"] < -20

rows = sum(error(SEVEN[2], channel, False)[1] for channel in ("outer_diameter", "axial_force"))
assert rows == 232, rows
assert runs["four_fibre/lm_8"]["best"]["objective"] < rows, "four_fibre is not within the disagreement of the protocols"
for name in ("hgo/lm_8", "gho/lm_8"):
    assert runs[name]["best"]["objective"] > 5 * rows, f"{name} explains what it is known not to"
theta = runs["four_fibre/lm_8"]["best"]["parameters"]["theta"]
assert 40 < theta["ci95"][0] < 46.7 < theta["ci95"][1] < 53, f"four_fibre: theta {theta}"

seconds = sum(run["seconds"] for run in runs.values())
forces = "; ".join(f"{name} {error(name, 'axial_force', False)[0]:.2g} and {error(name, 'axial_force', True)[0]:.3g} mN" for name in (*ONE, THREE))
best = f"{error(SEVEN[2], 'axial_force', False)[0]:.2g} mN, {error(SEVEN[2], 'outer_diameter', False)[0]:.2g} mm"
print(f"murine tube: protocols disagree by {diameter:.3f} mm and {force:.1f} mN; forces in sample and held out: {forces}; "
      f"four_fibre on everything {best}; {seconds:.1f} s")
