#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""figure.py RESULTS FILE.svg: loops at three rates, the spectrum of relaxation times and the moduli that it predicts,
from the results of `tunica run` on experiment.json. Needs matplotlib (Debian: python3-matplotlib)."""
import csv
import json
import pathlib
import sys

import matplotlib
matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "vhb4910_time"  # the same bytes each time
matplotlib.rcParams["svg.fonttype"] = "none"
import matplotlib.pyplot as plt

results, file = pathlib.Path(sys.argv[1]), sys.argv[2]


def table(test):
    with open(results / f"fit_{test}.csv", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    return lambda name: [float(row[name]) for row in rows]


figure, (loops, spectrum, moduli) = plt.subplots(1, 3, figsize=(11, 3.4))
for rate, colour in (("0.01", "tab:blue"), ("0.03", "tab:orange"), ("0.05", "tab:green")):
    column = table(f"at_{rate.replace('.', '_')}_per_s")
    loops.plot(column("stretch [1]"), column("stress [kPa]"), "o", ms=2, color=colour)
    loops.plot(column("stretch [1]"), column("stress.predicted [kPa]"), "-", color=colour, label=f"{rate} per s")
loops.set(xlabel="stretch [1]", ylabel="nominal stress [kPa]", title="three rates, one set")
loops.legend(fontsize=8, frameon=False)

best = json.loads((results / "result.json").read_text(encoding="utf-8"))["runs"][0]["best"]["parameters"]
for branch in ("fast", "slow"):
    g, tau = best[f"{branch}.g"], best[f"{branch}.tau"]
    spectrum.errorbar(tau["value"], g["value"], color="tab:blue", fmt="o", capsize=3,
                      xerr=[[tau["value"] - tau["ci95"][0]], [tau["ci95"][1] - tau["value"]]],
                      yerr=[[g["value"] - g["ci95"][0]], [g["ci95"][1] - g["value"]]])
    spectrum.vlines(tau["value"], 0, g["value"], color="tab:blue")
spectrum.set(xscale="log", xlim=(1, 200), ylim=(0, None), xlabel="relaxation time [s]", ylabel="g [1]",
             title="spectrum, 95 % intervals")

column = table("oscillation")
moduli.loglog(column("frequency [Hz]"), column("storage_modulus.predicted [kPa]"), label="storage")
moduli.loglog(column("frequency [Hz]"), column("loss_modulus.predicted [kPa]"), label="loss")
moduli.set(xlabel="frequency [Hz]", ylabel="modulus [kPa]", title="predicted about stretch 1.5")
moduli.legend(fontsize=8, frameon=False)
figure.tight_layout()
figure.savefig(file, metadata={"Date": None})
