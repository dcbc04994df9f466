#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""covariance.py TUNICA SOURCES FOLDER: the covariance in result.json is that of linear regression with numpy, and what
the search had follows from it; a test without stresses is predicted and nothing else."""
import json
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

np = rig.numpy()
program, _, out = sys.argv[1:4]
folder = rig.fresh_folder(out)
SIGMA = 2.0
stretch = np.linspace(1.02, 2.0, 40)
# Nominal stress of Mooney and Rivlin's material: P = 2 (λ − λ⁻²)(c10 + c01/λ), linear in both.
design = 2 * (stretch - stretch ** -2)[:, None] * np.stack([np.ones_like(stretch), 1 / stretch], axis=1)
stress = design @ [30, 20] + np.random.default_rng(5).normal(0, SIGMA, stretch.size)
(folder / "strip.csv").write_text("stretch [-],stress [kPa]\n" + "".join(
    f"{x!r},{y!r}\n" for x, y in zip(stretch.tolist(), stress.tolist())))
(folder / "unseen.csv").write_text("stretch [-],note\n1.1,a\n1.5,b\n2.5,c\n")
strip = {"type": "uniaxial", "direction": "axial", "data": {
    "file": "strip.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "noise": {"absolute": SIGMA},
    "stress_measure": "first_piola_kirchhoff"}}
unseen = {"type": "uniaxial", "direction": "axial", "data": {
    "file": "unseen.csv", "columns": {"stretch": "stretch"}, "stress_measure": "first_piola_kirchhoff"}}
BOUNDS = {"c10": {"min": 1, "max": 100, "scale": "log"}, "c01": {"min": -100, "max": 200, "scale": "linear"}}
experiment = {"format": 1, "name": "linear", "objective": "least_squares",
              "models": {"mr": {"type": "mooney_rivlin", "parameters": BOUNDS}},
              "tests": {"strip": strip, "unseen": unseen}, "optimizers": {"lm": {"type": "ceres_lm"}},
              "runs": [{"model": "mr", "optimizer": "lm"}]}
file = folder / "linear.json"
file.write_text(json.dumps(experiment))
printed, _ = rig.tunica(program, "check", file)
assert "nothing measured: predicted only" in " ".join(printed.split()), printed
rig.tunica(program, "run", file, "-o", folder / "out")
best = json.loads((folder / "out" / "result.json").read_text())["runs"][0]["best"]
found = best["covariance"]
expected = SIGMA ** 2 * np.linalg.inv(design.T @ design)
order = [{"c10": 0, "c01": 1}[name] for name in found["parameters"]]
expected = expected[np.ix_(order, order)]
assert found["units"] == ["kPa", "kPa"]
assert np.allclose(found["values"], expected, rtol=1e-6), (found["values"], expected)
scale = np.sqrt(np.diag(expected))
assert np.allclose(found["correlation"], expected / np.outer(scale, scale), atol=1e-9)
# In the coordinate of the search: linear (p − min)/(max − min), logarithmic log(p/min)/log(max/min).
slope = []
for name, kind in zip(found["parameters"], found["search"]["scales"]):
    low, high = BOUNDS[name]["min"], BOUNDS[name]["max"]
    assert kind == BOUNDS[name]["scale"]
    slope.append(best["parameters"][name]["value"] * np.log(high / low) if kind == "log" else high - low)
assert np.allclose(np.array(found["search"]["values"]) * np.outer(slope, slope), expected, rtol=1e-6)
# ±1.96 standard deviations are the interval where the search is linear.
low, high = best["parameters"]["c01"]["ci95"]
place = found["parameters"].index("c01")
assert abs((high - low) / 2 - 1.959964 * scale[place]) < 1e-4 * scale[place], (low, high, scale)

# The test without stresses: predicted beside the fit, scored nowhere, and by `simulate` too.
c = np.array([best["parameters"][name]["value"] for name in ("c10", "c01")])
at = np.array([1.1, 1.5, 2.5])
predicted = 2 * (at - at ** -2) * (c[0] + c[1] / at)
assert np.allclose(rig.fitted_curve(folder / "out", "unseen")["stress.predicted"], predicted, rtol=1e-9)
assert best["per_test"]["unseen"]["channels"] == []
rig.tunica(program, "simulate", file, "--model", "mr", "--parameters", folder / "out" / "result.json", "-o", folder / "sim")
lines = (folder / "sim" / "unseen.csv").read_text().splitlines()
assert lines[0] == "stretch [-],stress [kPa]", lines[0]
assert np.allclose([float(line.split(",")[1]) for line in lines[1:]], predicted, rtol=1e-9)

# A diagnosis looks at what was measured.
rig.tunica(program, "diagnose", file, "-o", folder / "diagnosed", "--mechanisms", "force_offset")

# Nothing but predictions: check and simulate work, run says why it does not.
experiment["tests"] = {"unseen": unseen}
file.write_text(json.dumps(experiment))
rig.tunica(program, "check", file)
rig.tunica(program, "check", file, "--json")
rig.tunica(program, "simulate", file, "--model", "mr", "-o", folder / "sim2")
_, message = rig.tunica(program, "run", file, "-o", folder / "none", code=2)
assert "no test has measured values" in " ".join(message.split()), message
rig.tunica(program, "diagnose", file, "-o", folder / "none", code=2)
assert not (folder / "none").exists()
print("covariance and predictions are those of numpy")
