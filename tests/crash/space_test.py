#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""space_test.py TUNICA: results that are written at once, where files may not grow any more. One message says so, exit code
2 or 130, nothing is left that the same command would refuse, and later it gives what it would have given."""
import json
import os
import pathlib
import pty
import resource
import signal
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from laboratory import expect, make_cohort, run_cases

program = [sys.argv[1], "--allow-world-writable-plugins"]
root = pathlib.Path(tempfile.mkdtemp(prefix="space"))


def call(folder, *words, limit=None):
    def no_more():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    ended = subprocess.run([*program, *words], cwd=folder, text=True, check=False, stdout=subprocess.PIPE,
                           stderr=subprocess.PIPE, preexec_fn=None if limit is None else no_more)
    return ended.returncode, ended.stderr


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def expect_nothing_left(folder, *words, limit=0, codes=(2,)):
    before = contents(folder)
    code, said = call(folder, *words, limit=limit)
    expect(code in codes, f"{words[0]} ended with {code}:\n{said}")
    expect(said.count("error: ") == 1 and "cannot write" in said and "limit" in said, f"{words[0]} says:\n{said}")
    if codes == (2,):
        left = {name for name, text in contents(folder).items() if before.get(name, b"\0") != text}
        expect(not left, f"{words[0]} leaves {sorted(left)}")
    code, said = call(folder, *words)
    expect(code == 0, f"{words[0]} ended with {code} afterwards:\n{said}")


def strip(width):
    return "".join(["stretch,stress [kPa]\n", *(f"{1 + 0.02 * k},{width * (1 + 0.02 * k - (1 + 0.02 * k)**-2):.6g}\n"
                                                  for k in range(1, 20))])


def of_one_fit():
    folder = root / "fit"
    folder.mkdir()
    (folder / "strip.csv").write_text(strip(30), encoding="utf-8")
    experiment = {"format": 1, "name": "strip", "models": {"neo": {"type": "neo_hooke"}},
                  "tests": {"strip": {"type": "uniaxial", "direction": "axial", "data": {
                      "file": "strip.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}},
                  "optimizers": {"lm": {"type": "ceres_lm"}}, "runs": [{"model": "neo", "optimizer": "lm"}]}
    (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
    code, said = call(folder, "run", "experiment.json", "-o", "results")
    expect(code == 0, said)
    return folder


def cards_and_pages():
    folder = of_one_fit()
    expect_nothing_left(folder, "export", "results", "--to", "abaqus", "-o", "card.inp")
    expect_nothing_left(folder, "report", "results", limit=1000)
    expect_nothing_left(folder, "report", "results", "results", "-o", "both.html", limit=1000)
    expect_nothing_left(folder, "check", "experiment.json", "--page", "page.html", limit=1000)


def folders_of_results():
    folder = root / "fit"
    for verb in ("simulate", "stability"):
        expect_nothing_left(folder, verb, "experiment.json", "--model", "neo", "--parameters", "results/result.json", "-o",
                            verb, limit=100)
    expect_nothing_left(folder, "diagnose", "experiment.json", "--quick", "--no-discovery", "-o", "diagnosis", limit=100)


def what_import_writes():
    folder = root / "rig"
    folder.mkdir()
    (folder / "strip.csv").write_text(strip(30), encoding="utf-8")
    strips = ("import", "strip.csv", "--direction", "axial", "--stress-measure", "first_piola_kirchhoff")
    expect_nothing_left(folder, *strips, "-o", "strip.json", limit=100)
    for axis in "12":
        (folder / f"axis_{axis}.csv").write_text(
            "".join(["time [s],stretch,stress [kPa]\n", *(f"{k},{1 + 0.02 * k},{k * float(axis):.6g}\n" for k in range(20))]),
            encoding="utf-8")
    sheet = ("import", "axis_1.csv", "axis_2.csv", "--join", "--direction", "axis_1=axial", "--direction", "axis_2=circumferential", "--stress-measure", "first_piola_kirchhoff", "-o", "sheet.json")
    code, said = call(folder, *sheet)
    expect(code == 0, said)
    joined = (folder / "sheet.csv").stat().st_size
    expect((folder / "sheet.json").stat().st_size > joined, "the experiment has to be the larger file")
    for made in ("sheet.csv", "sheet.json"):
        (folder / made).unlink()
    expect_nothing_left(folder, *sheet, limit=joined)


def ctrl_c_while_import_asks():
    """The table of both files is written before the questions."""
    folder = root / "rig"
    before = contents(folder)
    ours, terminal = pty.openpty()
    process = subprocess.Popen([*program, "import", "axis_1.csv", "axis_2.csv", "--join", "--direction", "axis_1=axial",
                                "--direction", "axis_2=circumferential", "-o", "asked.json"], cwd=folder, stdin=terminal,
                               stdout=subprocess.DEVNULL, stderr=terminal)
    said = b""
    while b"nominal" not in said and process.poll() is None:
        said += os.read(ours, 1000)
    expect((folder / "asked.csv").exists(), f"nothing was asked: {said.decode()}")
    process.send_signal(signal.SIGINT)
    expect(process.wait(30) == 130, f"ended with {process.returncode}")
    expect(contents(folder) == before, f"left: {sorted(set(contents(folder)) - set(before))}")


def cohorts_go_on():
    folder = root / "cohort"
    folder.mkdir()
    make_cohort(folder, 4)
    for limit in (0, 3000):
        expect_nothing_left(folder, "cohort", "cohort.json", "-o", f"results{limit}", "--no-reports", "--quiet", limit=limit,
                            codes=(2, 130))


run_cases([cards_and_pages, folders_of_results, what_import_writes, ctrl_c_while_import_asks, cohorts_go_on])
