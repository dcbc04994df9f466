#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""posterior_discrepancy.py TUNICA [set …]: how many held-out rows lie within the 95 % band of measurements, on measured
data, without a discrepancy and with one. Held out are every third row, the last fifth of each test, or each test in
turn. Models, noise and bounds are those of the examples.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent / "examples"
DRAWS = 2000
#: By name: example, models that are fitted in turn.
SETS = {"Treloar's rubber": ("treloar", ["gent", "ogden"]),
        "James's rubber": ("james_1975", ["mooney_rivlin"]),
        "human brain, cortex": ("human_brain_cortex", ["ogden"]),
        "human brain, corona radiata": ("human_brain_corona_radiata", ["ogden"]),
        "lamb aorta": ("lamb_aorta", ["gho", "hgo"]),
        "murine tube": ("murine_tube", ["gho"]),
        "VHB 4910": ("vhb4910_time", ["yeoh"])}


def example(name):
    folder = EXAMPLES / name
    text = re.sub(r"^\s*//.*$|(?<=[\s,{\[])//.*$", "", (folder / "experiment.json").read_text(), flags=re.MULTILINE)
    experiment = json.loads(text)
    for test in experiment["tests"].values():
        test.pop("hold_out", None)
        test["data"]["file"] = str((folder / test["data"]["file"]).resolve())
    for unmeasured in ("oscillation",):
        experiment["tests"].pop(unmeasured, None)
    return {key: experiment[key] for key in ("format", "models", "tests")}


def of(experiment, model, held_out):
    """The experiment with one model, and these {test: rows} held out."""
    models = {"ogden": {"type": "ogden", "terms": 1}, "hgo": {"type": "hgo"}, "gent": {"type": "gent"},
              "mooney_rivlin": {"type": "mooney_rivlin"}, "neo_hooke": {"type": "neo_hooke"}}
    tests = json.loads(json.dumps(experiment["tests"]))
    for name, rows in held_out.items():
        tests[name]["hold_out"] = rows
    return {"format": 1, "models": {"m": experiment["models"].get(model) or models[model]}, "tests": tests,
            "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm", "starts": 12}},
            "runs": [{"model": "m", "optimizer": "lm"}]}


def inside(tunica, experiment, discrepancy):
    """Held-out rows within the band, all of them, and the size of the misfit."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "experiment.json").write_text(json.dumps(experiment))
        made = subprocess.run([tunica, "run", folder / "experiment.json", "-o", folder / "out", "--no-certificate",
                               "--quiet", f"--posterior={DRAWS}", *(["--discrepancy"] if discrepancy else [])],
                              capture_output=True, text=True)
        if made.returncode != 0:
            raise SystemExit(made.stderr)
        best = json.loads((folder / "out/result.json").read_text())["runs"][0]["best"]
        if "posterior" not in best:
            raise SystemExit("\n".join(best["uncertainty"]))
        found = best["posterior"]
        return found["held_out"]["inside"], found["held_out"]["rows"], found.get("discrepancy", {}).get("median", 0), \
            found["converged"]


def rows_of(tunica, experiment):
    """Rows of each test, from the tables of a run that is not searched for long."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "experiment.json").write_text(json.dumps({**experiment, "stop": {"max_evaluations": 20}}))
        subprocess.run([tunica, "run", folder / "experiment.json", "-o", folder / "out", "--no-certificate", "--quiet"],
                       check=True, capture_output=True)
        return {test: len((folder / f"out/fit_{test}.csv").read_text().splitlines()) - 1
                for test in experiment["tests"]}


def protocols(counts):
    yield "every third row", [{test: f"1:{count}:3" for test, count in counts.items() if count > 5}]
    yield "the last fifth", [{test: f"{math.ceil(0.8 * count)}:{count}" for test, count in counts.items() if count > 5}]
    if len(counts) > 1:
        yield "each test in turn", [{test: True} for test in counts]


def main(tunica, wanted):
    print(f"{'data':28}{'model':15}{'held out':19}{'rows':>5}{'without':>9}{'with':>9}{'misfit':>9}  short chains")
    for name, (folder, models) in SETS.items():
        if wanted and folder not in wanted:
            continue
        bare = example(folder)
        for model in models:
            counts = rows_of(tunica, of(bare, model, {}))
            for what, cases in protocols(counts):
                totals = [[0, 0], [0, 0]]
                sizes, short = [], 0
                for held_out in cases:
                    for discrepancy in (False, True):
                        hit, rows, size, settled = inside(tunica, of(bare, model, held_out), discrepancy)
                        totals[discrepancy][0] += hit
                        totals[discrepancy][1] += rows
                        short += not settled
                        if discrepancy:
                            sizes.append(size)
                if not totals[1][1]:
                    print(f"{name:28}{model:15}{what:19}no row with a noise that is known", flush=True)
                    continue
                shares = [100 * hit / rows for hit, rows in totals]
                print(f"{name:28}{model:15}{what:19}{totals[1][1]:5}{shares[0]:7.1f} %{shares[1]:7.1f} %"
                      f"{100 * sum(sizes) / len(sizes):7.2f} %  {short}", flush=True)


if __name__ == "__main__":
    main(str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2:])
