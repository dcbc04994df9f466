# SPDX-License-Identifier: Apache-2.0
"""A hostile run beside an honest one, and what the honest one gives undisturbed: what the cases share."""
import json
import pathlib
import sys
import tempfile

from laboratory import Program, expect, small

root = pathlib.Path(tempfile.mkdtemp(prefix="hostile"))
executable, plugin = small(sys.argv[1], "ceres_lm", "es", "neo_hooke", "uniaxial"), sys.argv[2]


def strip():
    """A neo-Hookean strip of 12 kPa, with errors of a per cent."""
    lines = ["stretch,stress [kPa]"]
    for k in range(25):
        stretch = 1.02 + 0.02 * k
        lines.append(f"{stretch},{12 * (stretch**2 - 1 / stretch) * (1 + 0.01 * (k * 7 % 5 - 2)):.8g}")
    return "\n".join(lines) + "\n"


def laboratory(name, how="honest", since=0, search="lm", search_does="honest", test_does=None, **stop):
    """A hostile material, and an honest one beside it; the program in their folder. A hostile test is for the first."""
    folder = root / name
    folder.mkdir()
    (folder / "strip.csv").write_text(strip(), encoding="utf-8")
    experiment = {
        "format": 1, "name": "hostile",
        "models": {"bad": {"type": "hostile", "how": how, "from": since}, "good": {"type": "neo_hooke"}},
        "tests": {"t": {"type": "uniaxial", "direction": "axial",
                        "data": {"file": "strip.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}},
        "optimizers": {"lm": {"type": "ceres_lm"}, "es": {"type": "es"},
                       "bad": {"type": "hostile_search", "how": search_does}},
        "runs": [{"model": "bad", "optimizer": search, "stop": stop}, {"model": "good", "optimizer": "lm"}]}
    if test_does:
        hostile = {"h": {"type": "hostile_strip", "how": test_does, "data": experiment["tests"]["t"]["data"]}}
        experiment["runs"][0]["tests"] = hostile
    (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
    program = Program(executable, folder)
    program.words += ["--plugin-path", plugin, "--call-limit", "1"]
    return folder, program


def outcome(folder, name="results"):
    """The entries of the hostile and of the honest run."""
    found = json.loads((folder / name / "result.json").read_text(encoding="utf-8"))
    runs = {run["run"]: run for run in found["runs"]}
    honest = runs.pop("good/lm")
    (bad,) = runs.values()
    return bad, honest


def timeless(value):
    if isinstance(value, dict):
        return {key: timeless(one) for key, one in value.items() if not any(w in key for w in ("time", "second", "date"))}
    return [timeless(one) for one in value] if isinstance(value, list) else value


def undisturbed():
    """The honest run where nothing misbehaves."""
    folder, tunica = laboratory("undisturbed")
    tunica("run", "experiment.json", "-o", "results", "--quiet")
    return timeless(outcome(folder)[1])


honest_run = undisturbed()


def expect_others_as_ever(folder, case):
    expect(timeless(outcome(folder)[1]) == honest_run, f"{case}: the honest run is not what it is without the culprit")
