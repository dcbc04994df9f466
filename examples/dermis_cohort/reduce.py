#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""reduce.py RAW: makes curves/*.csv and specimens.csv from the raw rig files of porcine dermis in the folder RAW.

Of each file it takes the last cycle to the second stretch (set "Stretch3.5"), which is the first that is not also the
first loading, from valley to valley, and of it every third row. The gauge length is the size less the displacement.
Source: public repository tajtac/node_damage, folder data/Dermis (V. Tac, A. B. Tepole et al.)."""
import csv
import pathlib
import statistics
import sys

HERE = pathlib.Path(__file__).resolve().parent
SET, STEP = "Stretch3.5", 3


def last_cycle(rows):
    """Rows from the valley before the last peak to the valley behind it."""
    way = [float(row["Displacement_mm"]) for row in rows]
    cycle = [int(row["Cycle"].split("-")[0]) for row in rows]
    of_last = [k for k, number in enumerate(cycle) if number == max(cycle)]
    peak = max(of_last, key=lambda k: way[k])
    before = [k for k, number in enumerate(cycle) if number == max(cycle) - 1]
    earlier = max(before, key=lambda k: way[k])
    valley = min(reversed(range(earlier, peak)), key=lambda k: way[k])
    end = min(range(peak, len(rows)), key=lambda k: way[k])
    return rows[valley:end + 1]


raw = pathlib.Path(sys.argv[1])
(HERE / "curves").mkdir(exist_ok=True)
table = []
with open(raw / "specimens.csv", encoding="utf-8") as stream:
    specimens = list(csv.DictReader(stream))
for specimen in specimens:
    name = specimen["Specimen"]
    with open(raw / f"{name}.csv", encoding="utf-8") as stream:
        rows = [row for row in csv.DictReader(stream) if row["SetName"] == SET]
    gauge = statistics.median(float(row["Size_mm"]) - float(row["Displacement_mm"]) for row in rows)
    used = last_cycle(rows)[::STEP]
    begin = float(used[0]["Time_S"])
    with open(HERE / "curves" / f"{name}.csv", "w", encoding="utf-8") as stream:
        stream.write("# porcine dermis, last cycle of set Stretch3.5, every third row; "
                     "public repository tajtac/node_damage (Tac, Tepole et al.)\n")
        stream.write("time [s],displacement [mm],force [N]\n")
        for row in used:
            stream.write(f"{float(row['Time_S']) - begin:.1f},{row['Displacement_mm']},{row['Force_N']}\n")
    table.append([name, specimen["Pig"], specimen["Location"], specimen["Direction"], specimen["Width"],
                  specimen["Thickness"], f"{gauge:.3f}"])
with open(HERE / "specimens.csv", "w", encoding="utf-8") as stream:
    stream.write("# porcine dermis; public repository tajtac/node_damage (Tac, Tepole et al.)\n")
    stream.write("specimen,pig,location,direction,width [mm],thickness [mm],gauge length [mm]\n")
    for row in table:
        stream.write(",".join(row) + "\n")
