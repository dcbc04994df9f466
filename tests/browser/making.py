# SPDX-License-Identifier: Apache-2.0
"""Result folders as a user makes them: of every example, and of the cases that no example shows."""
import json
import os
import re
import shutil
import subprocess
import time

import hostile

# What ctest -L example runs in full is here for its pictures: budgets for which an example takes seconds.
FEW = {"evaluations": 400, "realisations": 4, "starts": 2}
BUDGETS = {"lamb_aorta": {}, "treloar": {}, "known_solution": {}, "lamb_aorta_stable": {**FEW, "evaluations": 200},
           "cn_pressurisation": {"evaluations": 8, "realisations": 1, "starts": 1, "elements": [3, 6]},
           "optimizer_comparison": {**FEW, "evaluations": 800, "realisations": 10},
           "calculix": {"evaluations": 2, "tests": ["strip"], "certificate": False, "fixed": {"c20": -8, "c30": 1.2}},
           "cn_guided": {**FEW, "evaluations": 20, "starts": 1, "certificate": False},
           "es_assessment": {**FEW, "realisations": 20}, "murine_tube": {**FEW, "evaluations": 60, "starts": 1},
           "mechanisms": {**FEW, "starts": 1, "evaluations": 40},
           # A field is fitted to all its frames: a coarse mesh and two evaluations have every picture.
           "plate": {"evaluations": 2, "starts": 1, "size": "2.5 mm", "certificate": False},
           "time_protocols": {"evaluations": 10, "starts": 1, "certificate": False}}


def tunica(options, *arguments):
    began = time.monotonic()
    ended = subprocess.run([options.tunica, "--allow-world-writable-plugins", *map(str, arguments)], capture_output=True,
                           text=True, timeout=280)
    assert ended.returncode in (0, 1), f"tunica {arguments}: {ended.stderr}"
    return time.monotonic() - began


def without_comments(text):
    """JSON; `//` inside a string stays."""
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*', lambda found: found.group(1) or "", text)


def lessened(value, budget):
    """The same experiment with no number above the budget's."""
    keys = {"max_evaluations": "evaluations", "realisations": "realisations", "starts": "starts"}
    if isinstance(value, list):
        return [lessened(entry, budget) for entry in value]
    if not isinstance(value, dict):
        return value
    made = {key: lessened(entry, budget) for key, entry in value.items()}
    for key, name in keys.items():
        if key in made and name in budget:
            made[key] = min(made[key], budget[name])
    if "elements" in made and "elements" in budget:
        made.update(elements=budget["elements"], element="quadrilateral_9")
    if "size" in made and "size" in budget:
        made["size"] = budget["size"]
    return made


def short(made, budget):
    """The same experiment with few tests and parameters, and within the budget."""
    tests = {name: test for name, test in made["tests"].items() if name in budget.get("tests", made["tests"])}
    for model in made["models"].values():
        for name in budget.get("fixed", {}):
            model["parameters"][name] = {"fixed": budget["fixed"][name]}
    return lessened({**made, "tests": tests}, budget)


def experiment(options, source, output, change=lambda made: made):
    """A copy with absolute paths, which can lie anywhere."""
    made = change(json.loads(without_comments(source.read_text())))
    made.pop("$schema", None)
    for test in made["tests"].values():
        tables = test["data"] if isinstance(test["data"], list) else [test["data"]]
        for table in tables:
            key = "numbered_files" if "numbered_files" in table else "file"
            table[key] = os.path.abspath(source.parent / table[key])
        if test["type"] == "external":
            test["folder"] = os.path.abspath(source.parent)
    made.setdefault("stop", {}).setdefault("max_evaluations", 20000)
    file = output.with_suffix(".json")
    file.write_text(json.dumps(made))
    return file


def of_examples(options, output):
    reports = []
    for source in sorted(options.source.glob("examples/*/experiment.json")):
        name = source.parent.name
        if name == "calculix" and not shutil.which("ccx"):
            print("skipped: no report of examples/calculix, ccx is not installed")
            continue
        file = experiment(options, source, output / name, lambda made: short(made, BUDGETS.get(name, FEW)))
        diagnosis = "diagnosis" in json.loads(file.read_text())
        certified = BUDGETS.get(name, {}).get("certificate", True)
        verb = ["diagnose", file, "--quick"] if diagnosis else ["run", file, *([] if certified else ["--no-certificate"])]
        seconds = tunica(options, *verb, "--quiet", "-o", output / name)
        print(f"{name}: made in {seconds:.1f} s")
        reports.append(output / name / "report.html")
    return reports


def diagnosed(options, output, name, verdict, *what):
    if not options.generator:
        print(f"skipped: no diagnosis '{name}', discovery_generator is not built")
        return []
    cases = output / f"cases_{name}"
    subprocess.run([options.generator, "--out", cases, *what], check=True, capture_output=True, timeout=120)
    tunica(options, "diagnose", next(cases.glob("case-*/experiment.json")), "--quick", "--quiet", "-o", output / name)
    found = json.loads((output / name / "result.json").read_text())["diagnosis"]["verdict"]
    assert found == verdict, f"the case that is to show '{verdict}' shows '{found}'"
    return [output / name / "report.html"]


def with_uncertainty(options, output):
    """Profiles and bootstrap of a real result."""
    def only_lm(made):
        run = next(run for run in made["runs"] if run["model"] == "gho" and run["optimizer"] == "lm")
        return {**made, "runs": [run, {**run, "realisations": 2, "initial": "random"}]}  # intervals stand beside each other
    file = experiment(options, options.source / "examples/lamb_aorta/experiment.json", output / "uncertainty", only_lm)
    tunica(options, "run", file, "--quiet", "--profiles", "all", "--bootstrap", "50", "-o", output / "uncertainty")
    return [output / "uncertainty/report.html"]


def with_many_realisations(options, output):
    """100 realisations of each of four optimisers, on the aorta."""
    def many(made):
        made["optimizers"] = {"es": {"type": "es"}, "cma_es": {"type": "cma_es"}, "lm": {"type": "ceres_lm", "starts": 1},
                              "crs2": {"type": "nlopt", "algorithm": "crs2_lm"}}
        return {**made, "initial": "random", "stop": {"max_evaluations": 400},
                "runs": [{"model": "gho", "optimizer": name, "realisations": 100} for name in made["optimizers"]]}
    file = experiment(options, options.source / "examples/lamb_aorta/experiment.json", output / "many", many)
    print(f"100 realisations of 4 optimisers: made in {tunica(options, 'run', file, '--quiet', '-o', output / 'many'):.1f} s")
    return [output / "many/report.html"]


def with_fields(options, output):
    """Two tubes under set S of Canales et al. 2023: one of finite elements, one long and opened."""
    source = options.source / "examples/cn_pressurisation/experiment.json"

    def tubes(made):
        tube = lessened(made["tests"]["s_tube"], {"elements": [4, 10]})
        long = {key: value for key, value in tube.items() if key in ("inner_radius", "thickness", "axial_stretch", "data")}
        made["tests"] = {"clamped": tube, "long": {"type": "thick_wall_pressurisation", **long,
                                                   "parameters": {"opening_angle": {"fixed": "60 deg"}}}}
        values = {"mu": 18.668, "kappa": 0.1367, "k1": 24.905, "k2": 0.2912, "theta": 46.44}
        made["models"] = {"gho": {"type": "gho", "parameters": {name: {"fixed": value} for name, value in values.items()}}}
        return {**made, "runs": [{"model": "gho", "optimizer": "one"}]}
    file = experiment(options, source, output / "fields", tubes)
    tunica(options, "simulate", file, "--model", "gho", "--fields", "clamped", "--fields", "long", "-o", output / "fields")
    return [output / "fields/report.html"]


def reports(options, output):
    files = of_examples(options, output)
    lamb = output / "lamb_aorta"
    hostile.with_hostile_names(lamb, output / "hostile", "gho/lm")
    tunica(options, "report", output / "hostile")
    files.append(output / "hostile/report.html")
    files += with_uncertainty(options, output) + with_fields(options, output) + with_many_realisations(options, output)
    tunica(options, "report", lamb, output / "many", "-o", output / "side_by_side.html")
    files.append(output / "side_by_side.html")
    files += diagnosed(options, output, "named", "named", "--seed", "5", "--set", "singles", "--effect", "fibre_dispersion",
                       "--lambda", "150", "--cases", "0:1")
    files += diagnosed(options, output, "tie", "indistinguishable", "--seed", "5", "--set", "singles", "--effect",
                       "axial_force_offset", "--lambda", "60", "--cases", "0:1")
    files += diagnosed(options, output, "nothing", "nothing_detected", "--seed", "5", "--set", "nulls", "--cases", "0:1")
    return files


def begin(output):
    shutil.rmtree(output, ignore_errors=True)
    for folder in ("downloads", "screenshots"):
        (output / folder).mkdir(parents=True)
