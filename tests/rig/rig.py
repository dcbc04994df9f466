# SPDX-License-Identifier: Apache-2.0
"""What the tests of rig data share: running tunica, reading back the curve that it fitted."""
import csv
import json
import pathlib
import shutil
import subprocess
import sys


def numpy():
    """numpy, or the end of the test where it is missing."""
    try:
        import numpy
    except ImportError:
        print("skipped: numpy is not installed (Debian: python3-numpy)")
        sys.exit(77)
    return numpy


def fresh_folder(path):
    folder = pathlib.Path(path)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def tunica(program, *arguments, code=0):
    """Standard output and error of a run that must end with this exit code."""
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    assert done.returncode == code, f"tunica {' '.join(map(str, arguments))}: exit code {done.returncode}\n" \
        f"{done.stdout}{done.stderr}"
    return done.stdout, done.stderr


def write_experiment(file, data, direction="circumferential", models=None):
    """A strip with this data block, fitted by one local search from the initial values."""
    models = models or {"yeoh": {"type": "yeoh"}}
    file.write_text(json.dumps({
        "format": 1, "name": file.stem, "models": models,
        "tests": {"strip": {"type": "uniaxial", "direction": direction, "data": data}},
        "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm"}},
        "runs": [{"model": name, "optimizer": "lm"} for name in models]}, indent=1))
    return file


def fitted_curve(folder, test="strip"):
    """Columns of fit_<test>*.csv by their names without units."""
    file = next(iter(sorted(folder.glob(f"fit_{test}*.csv"))))
    with open(file, encoding="utf-8") as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#")))
    names = [name.split(" [")[0] for name in rows[0]]
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(names)
            if name in ("stretch", "stress", "stress.predicted")}


def best_parameters(folder):
    best = json.loads((folder / "result.json").read_text())["runs"][0]["best"]
    return {name: entry["value"] for name, entry in best["parameters"].items()}
