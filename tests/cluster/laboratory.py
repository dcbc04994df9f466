# SPDX-License-Identifier: Apache-2.0
"""A made-up cohort, and the program that fits it: what the tests of shards and queues share."""
import atexit
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import tempfile


def make_cohort(folder, specimens, realisations=1, seed=5):
    """Writes `specimens` pairs of strips (one exponential solid each, noise of 2 %) and a cohort of them. `realisations`
    makes a fit longer."""
    folder = pathlib.Path(folder)
    (folder / "data").mkdir(parents=True, exist_ok=True)
    draw = random.Random(seed)
    rows = ["id,treatment"]
    for k in range(specimens):
        stiffness, growth = 40 * math.exp(0.3 * draw.gauss(0, 1)), 8 * math.exp(0.25 * draw.gauss(0, 1))
        ground = 20 * math.exp(0.2 * draw.gauss(0, 1))
        for direction in "ca":
            lines = ["stretch,stress [kPa]"]
            for step in range(30):
                stretch = 1.01 + 0.01 * step
                excess = stretch**2 + 2 / stretch - 3
                # Demiray with a neo-Hookean part, Cauchy stress of an incompressible strip under one-dimensional load
                slope = ground / 2 + stiffness * excess * math.exp(growth * excess**2)
                stress = 2 * (stretch**2 - 1 / stretch) * slope * (1 + 0.02 * draw.gauss(0, 1))
                lines.append(f"{stretch:.6g},{stress:.8g}")
            (folder / f"data/s{k}_{direction}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        rows.append(f"s{k},{'treated' if k % 2 else 'control'}")
    (folder / "specimens.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    columns = {"stretch": "stretch", "stress": "stress"}
    strip = {"type": "uniaxial", "direction": "circumferential", "data": {"file": "data/s0_c.csv", "columns": columns}}
    other = {"type": "uniaxial", "direction": "axial", "data": {"file": "data/s0_a.csv", "columns": columns}}
    experiment = {
        "format": 1, "name": "strips",
        "models": {"gho": {"type": "gho", "parameters": {"kappa": {"fixed": 1 / 3}, "theta": {"fixed": 0}}}},
        "tests": {"c": strip, "a": other}, "optimizers": {"lm": {"type": "ceres_lm"}},
        "runs": [{"model": "gho", "optimizer": "lm", "realisations": realisations}]}
    cohort = {"format": 1, "name": "study", "seed": 3, "experiment": "experiment.json", "specimens": "specimens.csv",
              "bind": {"/tests/c/data/file": "data/{id}_c.csv", "/tests/a/data/file": "data/{id}_a.csv"},
              "factors": {"treatment": {"reference": "control"}}}
    (folder / "experiment.json").write_text(json.dumps(experiment, indent=1), encoding="utf-8")
    (folder / "cohort.json").write_text(json.dumps(cohort, indent=1), encoding="utf-8")
    return folder / "cohort.json"


def small(executable, *plugins):
    """A copy of the program that has only these plugins: it starts in a third of the time, and tests start it hundreds
    of times."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="tunica"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    executable = pathlib.Path(executable).resolve()
    shelf = folder / "lib/tunica/plugins"
    shelf.mkdir(parents=True)
    for name in plugins:
        shutil.copy(executable.parent.parent / f"lib/tunica/plugins/{name}.so", shelf)
    (folder / "bin").mkdir()
    return shutil.copy(executable, folder / "bin")


class Program:
    """The built executable in a folder."""

    def __init__(self, executable, folder, environment=None):
        self.words = [executable, "--allow-world-writable-plugins"]
        self.folder = folder
        self.environment = {**os.environ, **(environment or {})}

    def start(self, *words):
        return subprocess.Popen([*self.words, *words], cwd=self.folder, env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def __call__(self, *words, code=0):
        """Runs it; stdout and stderr as one text. Another exit code than `code` ends the test;
        None takes any."""
        ended = subprocess.run([*self.words, *words], cwd=self.folder, env=self.environment, text=True, check=False,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        expect(code is None or ended.returncode == code, f"tunica {' '.join(words)} ended with {ended.returncode}:\n{ended.stdout}")
        return ended.stdout


def expect(holds, otherwise):
    if not holds:
        raise AssertionError(otherwise)


def merged(results):
    """The merged files of a cohort, by name: whatever stands in the folder itself. Seconds differ between runs, so no
    file may have them."""
    return {file.name: file.read_bytes() for file in sorted(pathlib.Path(results).iterdir())
            if file.is_file() and file.suffix in (".csv", ".json") and file.name != "cohort.json"}


def expect_same(results, others, name):
    """Both folders have the same merged files, byte for byte."""
    one, other = merged(results), merged(others)
    expect({"parameters.csv", "specimens.csv", "result.json"} <= set(one), f"{results} has only {sorted(one)}")
    expect(sorted(one) == sorted(other), f"{name}: files {sorted(one)} and {sorted(other)}")
    for file, text in one.items():
        expect(text == other[file], f"{name}: {file} differs from that of one machine")


def records(results):
    return sorted(pathlib.Path(results).glob("specimens/*/record.json"))


def run_cases(cases):
    """Runs functions, named as sentences, and says which one failed."""
    for case in cases:
        try:
            case()
        except AssertionError as problem:
            raise SystemExit(f"{case.__name__}: {problem}") from None
        print(f"{case.__name__}: holds", flush=True)
