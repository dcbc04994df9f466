#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""calculix_test.py TUNICA PLUGINS EXAMPLE [MODEL...]: parameters from curves that CalculiX computed, through CalculiX.

Per model the strip and the tube of examples/calculix are simulated with known parameters, and fitted from others: all are
found within 1e-3, in at most 12 Jacobians (evaluations of the search, one Jacobian each). Broyden's updates take at most
60 % of the solver runs of plain differences; with one parameter they cannot take less than half, and 65 % are allowed.
Then the tube alone from a curve that tunica's own thick-walled tube gives.

The steps of the solver are twice as long as in the example, whose own test has the certificate too: ctest -L example."""
import atexit
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

tunica, plugins, example = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:4])
folder = pathlib.Path(tempfile.mkdtemp(prefix="tunica-calculix-"))
atexit.register(shutil.rmtree, folder, ignore_errors=True)
for file in pathlib.Path(example).iterdir():
    if file.is_file():
        shutil.copy(file, folder)
for template in folder.glob("*.inp.in"):
    short, long = "0.05, 1., 1e-6, 0.05", "0.1, 1., 1e-6, 0.1"
    assert short in template.read_text(), f"{template.name}: no step to lengthen"
    template.write_text(template.read_text().replace(short, long))
lines = (folder / "experiment.json").read_text().splitlines()
experiment = json.loads("\n".join(line for line in lines if not line.strip().startswith("//")))


def run(*arguments):
    found = subprocess.run([tunica, "--plugin-path", plugins, *arguments], cwd=folder, capture_output=True, text=True)
    assert found.returncode == 0, found.stderr + found.stdout
    return found


def fit(name):
    run("run", f"{name}.json", "--no-certificate", "-o", name)
    result = json.loads((folder / name / "result.json").read_text())["runs"][0]
    return {key: value["value"] for key, value in result["best"]["parameters"].items()}, result


def reached(name, truth):
    """The number of the first evaluation, which is one Jacobian each, whose parameters are all within 1e-3."""
    with open(folder / name / "evaluations.csv", newline="") as table:
        for row in csv.DictReader(table):
            values = {key.split(" [")[0]: value for key, value in row.items()}
            if all(abs(float(values[key]) / value - 1) < 1e-3 for key, value in truth.items()):
                return int(row["id"])
    raise AssertionError(f"{name}: never within 1e-3")


# Model, true parameters, bounds and start of each.
cases = {
    "neo_hooke": {"mu": (350, 20, 2000, 120)},
    "mooney_rivlin": {"c10": (150, 5, 1000, 80), "c01": (30, 0, 300, 60)},
    "yeoh": {"c10": (170, 20, 2000, 100), "c20": (-8, -50, 50, 0), "c30": (1.2, -5, 5, 0.5)},
    "ogden": {"mu_1": (420, 100, 1000, 350), "alpha_1": (1.8, 0.8, 5, 2.2)},
}
for model, parameters in cases.items():
    if sys.argv[4:] and model not in sys.argv[4:]:
        continue
    case = json.loads(json.dumps(experiment))
    case["name"] = model
    options = {"terms": 1} if model == "ogden" else {}
    case["models"] = {model: {"type": model, **options, "parameters": {
        name: {"min": least, "max": most, "initial": start} for name, (_, least, most, start) in parameters.items()}}}
    case["runs"] = [{"model": model, "optimizer": "lm"}]
    (folder / f"{model}.json").write_text(json.dumps(case))
    (folder / "truth.json").write_text(json.dumps({name: value[0] for name, value in parameters.items()}))
    run("simulate", f"{model}.json", "--model", model, "--parameters", "truth.json", "-o", f"{model}-data")
    counts = {}
    for derivatives in ("broyden", "forward"):
        for test in case["tests"].values():
            test["derivatives"] = derivatives
        for test in ("strip", "tube"):
            case["tests"][test]["data"]["file"] = f"{model}-data/{test}.csv"
        name = f"{model}-{derivatives}"
        (folder / f"{name}.json").write_text(json.dumps(case))
        found, result = fit(name)
        for key, (true, *_) in parameters.items():
            assert abs(found[key] / true - 1) < 1e-3, (model, key, found[key], true)
        within = reached(name, {key: value[0] for key, value in parameters.items()})
        assert within <= 12, (name, within)
        counts[derivatives] = sum(entry["solver_runs"] for entry in result["efforts"].values())
        print(name, found, "within 1e-3 after", within, "runs", counts[derivatives])
    saved = counts["broyden"] / counts["forward"]
    print(f"{model}: runs with updates / without {saved:.3f}")
    assert saved <= (0.6 if len(parameters) > 1 else 0.65), (model, counts)

# The wall of incompressible Mooney-Rivlin, fixed in length, by tunica's own quadrature; CalculiX's is slightly
# compressible and a mesh.
case = json.loads(json.dumps(experiment))
case["name"] = "mooney_rivlin"
case["models"] = {"mooney_rivlin": {"type": "mooney_rivlin", "parameters": {
    "c10": {"min": 5, "max": 1000, "initial": 80}, "c01": {"fixed": 30}}}}
case["runs"] = [{"model": "mooney_rivlin", "optimizer": "lm"}]
(folder / "own.csv").write_text("pressure [kPa],axial_stretch,diameter [mm]\n" +
                                "".join(f"{8 * k},1,3\n" for k in range(1, 11)))
own = json.loads(json.dumps(case))
own["tests"] = {"tube": {"type": "thick_wall_pressurisation", "inner_radius": "1 mm", "thickness": "0.5 mm", "data": {
    "file": "own.csv", "columns": {"pressure": "pressure", "axial_stretch": "axial_stretch",
                                   "outer_diameter": "diameter"}}}}
(folder / "own.json").write_text(json.dumps(own))
(folder / "truth.json").write_text(json.dumps({"c10": 150, "c01": 30}))
run("simulate", "own.json", "--model", "mooney_rivlin", "--parameters", "truth.json", "-o", "own-data")
lines = (folder / "own-data" / "tube.csv").read_text().splitlines()
rows = [[float(cell) for cell in line.split(",")] for line in lines[1:]]
(folder / "tube-own.csv").write_text("pressure [kPa],growth [mm]\n" + "".join(
    f"{row[0]!r},{row[-1] - 3!r}\n" for row in rows))
del case["tests"]["strip"]
case["tests"]["tube"]["data"]["file"] = "tube-own.csv"
(folder / "through.json").write_text(json.dumps(case))
found, result = fit("through")
print("tunica's tube through CalculiX", found, result["jacobians"])
assert abs(found["c10"] / 150 - 1) < 1e-3, found
