#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""import.py TUNICA SOURCES FOLDER: `tunica import` of a strip, a sheet and a tube of made-up machines; what it cannot
know, and bad input, is refused with what to give; `tunica check --page` draws what was understood."""
import json
import os
import pathlib
import pty
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

program, sources, out = sys.argv[1:4]
folder = rig.fresh_folder(out)


def words(text):
    return " ".join(text.split())


def imported(file, *options, code=0):
    """The experiment that a file gives, and what was said."""
    target = folder / (file.stem + ".json")
    target.unlink(missing_ok=True)
    printed, said = rig.tunica(program, "import", file, "-o", target, *options, code=code)
    return (json.loads(target.read_text()) if code == 0 else target.exists()), words(printed + said)


def table(name, lines):
    file = folder / name
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


# A strip: cycles, a row of units, a table of sizes.
ways = [0, 2, 4, 2, 0, 2, 4, 2, 0, 1, 2, 3, 4]
strip = table("strip.csv", ["Method;tension", "Operator;X", "", "Zeit;Weg;Kraft", "s;mm;N"] + [
    f"{0.5 * k:.1f};{way:.1f};{0.3 * way:.2f}".replace(".", ",") for k, way in enumerate(ways)])
sizes = table("sizes.csv", ["specimen,width [mm],thickness [um],gauge length", "strip,5,1500,20"])
experiment, said = imported(strip, "--specimens", sizes)
block = experiment["tests"]["strip"]["data"]
assert block["columns"] == {"time": "Zeit", "displacement": "Weg", "force": "Kraft"}, block
assert block["specimen"] == {"width": "5 mm", "thickness": "1500 um", "gauge_length": "20 mm"}, block
assert (block["cycle"], block["branch"], block["stress_measure"]) == ("last", "loading", "first_piola_kirchhoff"), block
assert "mm is assumed" in said and "several cycles (3): the last loading is taken" in said, said
assert "Softening and hysteresis need --cycle all" in said, said
printed, _ = rig.tunica(program, "check", folder / "strip.json", "--page", folder / "data.html")
assert "5 rows" in printed, printed
assert "stretch = 1 + displacement / 20 mm, from 'Weg' in mm" in words(printed), printed
assert "stress = force / (5 mm × 1.5 mm): first Piola-Kirchhoff stress (nominal), from 'Kraft' in N" in words(printed), printed
assert "rows: 5 of the 13 in the file: the last cycle, loading only" in words(printed), printed
page = (folder / "data.html").read_text(encoding="utf-8")
assert "5 of 13 rows are used" in page and "the curve that is fitted" in page and "Kraft [N]" in page
# Two files are two specimens, or two tests of one.
other = table("other.csv", ["Zeit;Weg;Kraft", "s;mm;N", "0;0;0", "1;2;0,6", "2;4;1,1"])
by_size = ("--width", "5 mm", "--thickness", "1 mm", "--gauge-length", "20 mm")
experiment, said = imported(strip, other, *by_size)
assert [run["tests"] for run in experiment["runs"]] == [["strip"], ["other"]], experiment["runs"]
assert "If they are one specimen, say --together" in said, said
experiment, said = imported(strip, other, "--together", *by_size)
assert [run["tests"] for run in experiment["runs"]] == [["strip", "other"]], experiment["runs"]
assert "--together" not in said, said
_, said = imported(strip, "--width", "5 mm", "--thickness", "1 mm", "--gauge-length", "preload", "--preload", "0.5 N", code=2)
assert "grip_distance" in said, said
_, said = imported(strip, "--width=-5mm", "--thickness", "1 mm", "--gauge-length", "20 mm", code=2)
assert "--width -5mm: it must be greater than zero" in said, said
_, said = imported(strip, "--width", "5 apples", "--thickness", "1 mm", "--gauge-length", "20 mm", code=2)
assert "--width is no length" in said, said
_, said = imported(strip, "--width", "5 mm", "--thickness", "1 mm", "--gauge-length", "preload", code=2)
assert "Add --preload" in said, said
experiment, said = imported(strip, "--width", "5", "--thickness", "1 mm", "--gauge-length", "20 mm")
assert "--width: no unit is given; 5 mm is assumed" in said, said
assert experiment["tests"]["strip"]["data"]["specimen"]["width"] == "5 mm"
toe = table("toe.csv", ["displacement [mm],force [N]"] + [f"{0.5 * k},{max(0, k - 12) ** 2}" for k in range(21)])
_, said = imported(toe, "--width", "5 mm", "--thickness", "1 mm", "--gauge-length", "20 mm")
assert "a toe" in said and "--preload" in said, said
# Everything that is missing is asked for at once, and nothing is written.
there, said = imported(strip, code=2)
assert all(option in said for option in ("--width", "--thickness", "--gauge-length")) and not there, said

# On a terminal it asks, and asks again where the answer makes no sense.
asked = folder / "asked.json"
terminal, other_end = pty.openpty()
with subprocess.Popen([program, "import", strip, "-o", asked], stdin=other_end, stderr=other_end, stdout=subprocess.PIPE,
                      text=True) as process:
    os.write(terminal, b"5 kPa\n-5 mm\n5 mm\n1.5 mm\n20 mm\n")
    printed = process.communicate(timeout=60)[0]
assert process.returncode == 0, printed
dialogue = words(os.read(terminal, 100000).decode())
assert "Width of the specimen" in dialogue and "must be greater than zero" in dialogue, dialogue
assert json.loads(asked.read_text())["tests"]["strip"]["data"]["specimen"] == {
    "width": "5 mm", "thickness": "1.5 mm", "gauge_length": "20 mm"}

# A long table: a test for each value of a column; a name that says nothing; numbers in place of names.
long = table("long.csv", ["run,a,b", "slow,0,0", "slow,1,0.2", "slow,2,0.5", "fast,0,0", "fast,1,0.3", "fast,2,0.7"])
given = ("--column", "displacement=a", "--column", "force=b", "--unit", "a=mm", "--unit", "b=N", "--each", "run",
         "--width", "5 mm", "--thickness", "1 mm", "--gauge-length", "10 mm")
experiment, said = imported(long, *given)
assert list(experiment["tests"]) == ["slow", "fast"] and experiment["runs"][0]["tests"] == ["slow", "fast"]
assert experiment["tests"]["fast"]["data"]["where"] == {"run": "fast"}
rig.tunica(program, "check", folder / "long.json")
bare = table("bare.csv", ["0 0", "1 0.2", "2 0.5"])
experiment, said = imported(bare, "--column", "displacement=#1", "--column", "force=#2", "--unit", "#1=mm", "--unit", "#2=N",
                            "--width", "5 mm", "--thickness", "1 mm", "--gauge-length", "10 mm")
assert experiment["tests"]["bare"]["data"]["columns"] == {"displacement": 1, "force": 2}
rig.tunica(program, "check", folder / "bare.json")

# A tube in the units of its rig: mmHg, um, grams of a transducer, length.
tube = table("tube.csv", ["Pressure (mmHg),Outer diameter (um),Transducer force (g),Length (mm)"] + [
    f"{10 * k},{700 + 20 * k},{0.5 + 0.1 * k},6.0" for k in range(8)])
experiment, said = imported(tube, "--thickness", "80 um", "--set", "outer_radius=0.34 mm", "--gauge-length", "5 mm")
entry = experiment["tests"]["tube"]
assert entry["type"] == "thick_wall_pressurisation" and entry["outer_radius"] == "0.34 mm", entry
assert entry["data"]["columns"] == {"pressure": "Pressure", "outer_diameter": "Outer diameter",
                                    "axial_force": "Transducer force", "axial_length": "Length"}, entry
printed, _ = rig.tunica(program, "check", folder / "tube.json", "--json")
channels = {one["observable"]: one["range"] for one in json.loads(printed)["problems"][0]["channels"]}
assert abs(channels["axial_force"][0] - 0.5 * 9.80665) < 1e-12 and abs(channels["outer_diameter"][1] - 0.84) < 1e-12

# A sheet: a width and a gauge length in each direction.
sheet = table("sheet.csv", ["Force X [N],Force Y [N],Displacement X [mm],Displacement Y [mm]"] + [
    f"{0.1 * k},{0.2 * k},{0.05 * k},{0.1 * k}" for k in range(6)])
experiment, said = imported(sheet, "--thickness", "0.5 mm", "--width", "10 mm", "--gauge-length", "5 mm")
entry = experiment["tests"]["sheet"]
assert entry["type"] == "biaxial" and set(entry["data"]["columns"]) == {
    "force_circumferential", "force_axial", "displacement_circumferential", "displacement_axial"}, entry
entry["data"]["specimen"]["axial"] = {"width": "20 mm"}
(folder / "sheet.json").write_text(json.dumps(experiment))
printed, _ = rig.tunica(program, "check", folder / "sheet.json", "--json")
channels = {one["observable"]: one["range"] for one in json.loads(printed)["problems"][0]["channels"]}
assert abs(channels["stress_circumferential"][1] - 500 / 5) < 1e-9 and abs(channels["stress_axial"][1] - 1000 / 10) < 1e-9

# A membrane whose table has tensions, in force per length.
membrane = table("membrane.csv", ["stretch_x [1],stretch_y [1],Tx [N/m],Ty [N/m]"] + [
    f"{1 + 0.05 * k},{1 + 0.1 * k},{10 * k},{20 * k}" for k in range(6)])
experiment, said = imported(membrane, "--thickness", "0.5 mm")
entry = experiment["tests"]["membrane"]
assert entry["type"] == "biaxial" and entry["data"]["specimen"] == {"width": "1 m", "thickness": "0.5 mm"}, entry
assert entry["data"]["units"] == {"Tx": "N", "Ty": "N"} and "a force per length of the unloaded edge" in said, said
printed, _ = rig.tunica(program, "check", folder / "membrane.json", "--json")
channels = {one["observable"]: one["range"] for one in json.loads(printed)["problems"][0]["channels"]}
# 50 N/m over 0.5 mm are 100 kPa.
assert abs(channels["stress_circumferential"][1] - 100) < 1e-9 and abs(channels["stress_axial"][1] - 200) < 1e-9

# The same in other units; sizes that do not go with a tension, and a tension beside a force.
membrane.write_text(membrane.read_text().replace("Tx [N/m]", "Tx [mN/cm]"))
experiment, said = imported(membrane, "--thickness", "0.5 mm")
assert experiment["tests"]["membrane"]["data"]["units"] == {"Tx": "100 mN", "Ty": "N"}, experiment
printed, _ = rig.tunica(program, "check", folder / "membrane.json", "--json")
channels = {one["observable"]: one["range"] for one in json.loads(printed)["problems"][0]["channels"]}
assert abs(channels["stress_circumferential"][1] - 10) < 1e-9 and abs(channels["stress_axial"][1] - 200) < 1e-9
experiment, said = imported(membrane, "--thickness", "0.5 mm", "--unit", "Tx=N/mm")  # what the header says is wrong
assert experiment["tests"]["membrane"]["data"]["units"] == {"Tx": "1000 N", "Ty": "N"}, experiment
for size in ("--width", "--diameter"):
    _, said = imported(membrane, size, "10 mm", "--thickness", "0.5 mm", code=2)
    assert "which needs the thickness only" in said, said
membrane.write_text(membrane.read_text().replace("Ty [N/m]", "Fy [N]"))
_, said = imported(membrane, "--thickness", "0.5 mm", code=2)
assert "A test takes one kind" in said, said

# The murine tubes of the examples as their authors published them.
murine = pathlib.Path(sources) / "examples" / "murine_tube"
example = json.loads("\n".join(line for line in (murine / "experiment.json").read_text().splitlines()
                               if not line.strip().startswith("//")))
for name, tests in (("inflation", ["test1", "test2", "test3"]), ("force_length", ["test1", "test2", "test3", "test4"])):
    target = folder / f"murine_{name}.json"
    rig.tunica(program, "import", murine / f"{name}.csv", "--each", "test", "--thickness", "769.85606 um",
               "--set", "outer_radius=2301 um", "-o", target)
    proposed = json.loads(target.read_text())["tests"]
    assert list(proposed) == tests
    # The columns of the hand-written example, and all rows.
    by_hand = example["tests"]["in_vivo"]["data"]["columns"]
    assert all(test["data"]["columns"] == by_hand and "cycle" not in test["data"] for test in proposed.values()), proposed
    rig.tunica(program, "check", target)

# Time and force alone: a relaxation curve, held at a stretch that only the user knows. Creep is driven by the force.
held = table("held.csv", ["Time [min],Load [N]", "0,1.2", "1,1.0", "10,0.9", "30,0.85"])
experiment, said = imported(held, "--test", "loading_segments", "--area", "6 mm2", "--set", "segments=1.3")
assert experiment["tests"]["held"]["segments"] == [{"ramp": {"stretch": 1.3}, "duration": 0}, {"hold": "30 min"}], experiment
printed, _ = rig.tunica(program, "check", folder / "held.json")
assert "4 rows, 141.7 … 200 kPa nominal stress" in words(printed) and "over time 0 … 1800 s" in words(printed), printed
_, said = imported(held, "--test", "loading_segments", "--area", "6 mm2", code=2)
assert "--set segments=STRETCH" in said, said
_, said = imported(held, "--test", "loading_segments", "--area", "6 mm2", "--set", "segments=true", code=2)
assert "expected the stretch of a hold as a number" in said, said
# A clock that ran before the jump: a ramp of so long would be another material.
late = table("late.csv", ["Time [s],Load [N]", "12.3,1.2", "13,1.0", "22.3,0.9", "612.3,0.85"])
experiment, said = imported(late, "--test", "loading_segments", "--area", "6 mm2", "--set", "segments=1.3")
assert experiment["tests"]["late"]["segments"] == [{"ramp": {"stretch": 1}, "duration": "12.3 s"}, {"ramp": {"stretch": 1.3}, "duration": 0}, {"hold": "600 s"}], experiment
assert "the clock begins before the first row, at 12.3 s" in words(said), said
rig.tunica(program, "check", folder / "late.json")
# Where columns say the loading, the way to a first row under load is assumed, and said.
for begins, expected in ((0, False), (12.3, True)):
    table("jump.csv", ["t [s],stretch,P [kPa]"] + [f"{begins + 5 * k},1.3,{20 - k}" for k in range(5)])
    (folder / "jump.json").write_text(json.dumps({
        "format": 1, "models": {"soft": {"type": "neo_hooke", "mechanisms": [{"type": "viscoelasticity"}]}},
        "tests": {"jump": {"type": "uniaxial", "direction": "axial", "data": {"file": "jump.csv", "columns": {"time": "t", "stretch": "stretch", "stress": "P"}, "stress_measure": "first_piola_kirchhoff"}}},
        "optimizers": {"lm": {"type": "ceres_lm"}}, "runs": [{"model": "soft", "optimizer": "lm"}]}))
    printed, said = rig.tunica(program, "check", folder / "jump.json")
    assert ("'jump', at a stretch of 1.3 after 12.3 s" in words(printed + said)) == expected, printed + said
_, said = imported(held, "--area", "6 mm2", code=2)
assert "--test loading_segments --set segments=STRETCH" in said, said
# Oscillations, under the names of the quantities and under their letters.
for titles in ("Frequenz [Hz],E' [kPa],E'' [kPa]", "Frequency [Hz],Storage modulus [kPa],Loss modulus [kPa]"):
    sweep = table("sweep.csv", [titles, "0.1,90,9", "1,100,12", "10,115,14"])
    experiment, said = imported(sweep, "--test", "dynamic_mechanical")
    assert list(experiment["tests"]["sweep"]["data"]["columns"]) == ["frequency", "storage_modulus", "loss_modulus"], experiment
    rig.tunica(program, "check", folder / "sweep.json")
_, said = imported(sweep, code=2)
assert "--test dynamic_mechanical" in said, said
# Moduli of shear are not taken for those of tension, which the test assumes.
_, said = imported(table("shear.csv", ["Frequency [Hz],G' [kPa],G'' [kPa]", "0.1,90,9", "1,100,12"]), "--test", "dynamic_mechanical", code=2)
assert "no column is known to be measured" in said and "'G''" in said, said
creep = table("creep.csv", ["Time [s],Load [N],Extension [mm]", "0,1,0.5", "10,1,0.8", "100,1,1.1"])
experiment, said = imported(creep, "--test", "creep", "--area", "6 mm2", "--gauge-length", "20 mm")
assert experiment["tests"]["creep"]["data"]["columns"] == {"time": "Time", "force": "Load", "displacement": "Extension"}, experiment
printed, _ = rig.tunica(program, "check", folder / "creep.json")
assert "stretch = 1 + displacement / 20 mm, from 'Extension' in mm" in words(printed), printed

# Bad input: what and where, exit code 2.
for file, options, expected in [
        (strip, ("--column", "froce=Kraft"), "Did you mean 'force'?"),
        (strip, ("--column", "force=Kruft"), "Did you mean 'Kraft'?"),
        (strip, ("--test", "uniaxal"), "Did you mean 'uniaxial'?"),
        (strip, ("--width", "5 mm", "--thickness", "-1 mm", "--gauge-length", "20 mm"), "--thickness -1 mm: it must be greater"),
        (strip, ("--width", "5 mm", "--thickness", "1 mm", "--gauge-length", "0 mm"), "--gauge-length 0 mm: it must be greater"),
        (strip, ("--specimens", table("other.csv", ["specimen,width", "x,5"])), "no row has the specimen 'strip'"),
        (strip, ("--where", "Kraft"), "Write NAME=VALUE"),
        (table("words.csv", ["a,b", "x,y"]), (), "no column is known to give 'stretch'"),
        (folder / "missing.csv", (), "there is no such file")]:
    there, said = imported(file, *options, code=2)
    assert expected in said and not there, f"{options}: {said}"
taken = folder / "taken.json"
taken.write_text("{}")
_, said = rig.tunica(program, "import", strip, "-o", taken, code=2)
assert "there is such a file already" in words(said) and taken.read_text() == "{}"
print("files of strips, sheets and tubes become experiments that check accepts")
