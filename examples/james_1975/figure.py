#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""figure.py RESULTS FILE.svg: measured and computed stresses of all series, from the results of `tunica run` on the
extended.json of the discovery. Needs matplotlib (Debian: python3-matplotlib)."""
import csv
import pathlib
import sys

import matplotlib
matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "james_1975"  # the same bytes each time
matplotlib.rcParams["svg.fonttype"] = "none"
import matplotlib.pyplot as plt

# Columns of the varied stretch, and of the stresses with their colours.
VARIED = {"stretch": {"stress": "tab:blue"},
          "stretch_circumferential": {"stress_circumferential": "tab:blue", "stress_axial": "tab:orange"}}


def column(rows, name):
    return [float(row[name]) if row[name] else float("nan") for row in rows]


def draw(pane, name, rows):
    """Points as measured, lines as computed; dashed where the series was not fitted."""
    held_out = rows[0]["held_out"] == "1"
    varied = "stretch" if name == "uniaxial" else "stretch_circumferential"
    rows.sort(key=lambda row: float(row[f"{varied} [1]"]))
    for stress, colour in VARIED[varied].items():
        if f"{stress} [kPa]" not in rows[0]:
            continue
        x = column(rows, f"{varied} [1]")
        pane.plot(x, [one / 1000 for one in column(rows, f"{stress} [kPa]")], "o", ms=3, color=colour)
        pane.plot(x, [one / 1000 for one in column(rows, f"{stress}.predicted [kPa]")], "--" if held_out else "-",
                  color=colour)
    title = "uniaxial" if name == "uniaxial" else f"one stretch held at {name[5:].replace('_', '.')}"
    pane.set_title(f"{title}\n{'predicted' if held_out else 'fitted'}", fontsize=9)


results, file = pathlib.Path(sys.argv[1]), sys.argv[2]
figure, panes = plt.subplots(2, 4, figsize=(11, 5.6), sharey=True)
for pane, table in zip(panes.flat, sorted(results.glob("fit_*.csv"))):
    with open(table, encoding="utf-8") as lines:
        draw(pane, table.stem[4:], list(csv.DictReader(lines)))
for pane in panes[:, 0]:
    pane.set_ylabel("nominal stress [MPa]")
for pane in panes[1]:
    pane.set_xlabel("varied stretch [1]")
panes[0, 0].plot([], [], "o", color="tab:blue", label="along the varied stretch")
panes[0, 0].plot([], [], "o", color="tab:orange", label="along the held stretch")
panes[0, 0].legend(fontsize=7, frameon=False)
figure.tight_layout()
figure.savefig(file, metadata={"Date": None})
