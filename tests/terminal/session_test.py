#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""session_test.py TUNICA FOLDER: a session on a terminal of 80 columns. The progress line updates, Ctrl-C leaves a
folder that --resume finishes with the identical result, and what is piped is plain text. FOLDER gets the recording."""
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left beside the sources
from screen import Screen, need

need("tmux", "tmux")
tunica = pathlib.Path(sys.argv[1]).resolve()
recording = pathlib.Path(sys.argv[2]).resolve() / "session.log"
# `t` on the screen, so that no command fills more than a line.
SHELL = f"PS1='> '; t() {{ '{tunica}' --allow-world-writable-plugins \"$@\"; }}; clear"
PROGRESS = re.compile(r"^(?:\[#*\.*\] )? *(\d+) %  (\d+)/(\d+) searches  (\S+ ?[kM]?)/s  (?:\S+: )?best (\S+)  "
                      r"max (\d+:\d\d(?::\d\d)?) left *$", re.M)


def write_experiment(folder, name, model, evaluations, realisations, count=20):
    """A made-up strip whose curve of `count` rows has a ripple."""
    rows = [(1 + 0.4 * i / count, 0.2 * math.sin(7 * i)) for i in range(1, count + 1)]
    text = "stretch [1],stress [kPa]\n" + "".join(f"{x:.4f},{30 * (x * x - 1 / x) + e:.6f}\n" for x, e in rows)
    (folder / f"strip_{count}.csv").write_text(text, encoding="utf-8")
    experiment = {
        "format": 1, "name": "session", "seed": 7,
        "models": {model: {"type": "gho"}},
        "tests": {"strip": {"type": "uniaxial", "direction": "circumferential",
                            "data": {"file": f"strip_{count}.csv", "columns": {"stretch": "stretch", "stress": "stress"},
                                     "noise": {"absolute": "0.2 kPa"}}}},
        "optimizers": {"es": {"type": "es"}},
        "stop": {"max_evaluations": evaluations},
        "runs": [{"model": model, "optimizer": "es", "realisations": realisations}]}
    (folder / name).write_text(json.dumps(experiment), encoding="utf-8")


def result_of(folder):
    """Without what two equal runs may differ in."""
    result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    for run in result["runs"]:
        del run["seconds"], run["statistics"]["seconds"]
    del result["provenance"]["date"]
    return result


def show_that_progress_updates(screen, work):
    screen.enter("t run long.json -o cut -j 1; echo CODE=$?")
    shown = []

    def look(text):
        # Once on the screen: the line is redrawn, not repeated.
        lines = PROGRESS.findall(text)
        assert len(lines) <= 1, f"{len(lines)} progress lines:\n{text}"
        assert "CODE=" not in text.replace("echo CODE=", ""), f"it ended too early:\n{text}"
        if lines and (not shown or lines[0] != shown[-1]):
            shown.append(lines[0])
        return len(shown) >= 5

    screen.wait_for(look, "a progress line that updates")
    shares = [int(line[0]) for line in shown]
    assert shares == sorted(shares), f"the share goes back: {shares}"
    bests = [float(line[4]) for line in shown]
    assert bests == sorted(bests, reverse=True), f"the best value grows: {bests}"
    return shown


def show_that_ctrl_c_can_be_resumed(screen, work):
    screen.press("C-c")
    text = screen.wait_for(lambda text: text if "CODE=130" in text else None, "exit code 130")
    assert "interrupted; everything so far is saved. Go on with" in text, text
    assert not PROGRESS.search(text), f"the progress line is still there:\n{text}"
    assert (work / "cut/checkpoint.json").exists() and not (work / "cut/result.json").exists()
    # The command that was printed, as it was printed.
    said = text[text.index("Go on with") + len("Go on with"):text.index("CODE=130")]
    resume = " ".join(said.replace("\n", "").split())
    assert "-o cut --resume" in resume, resume
    screen.enter("clear")
    assert " -j 1 " in f"{resume} ", resume
    screen.enter(f"{resume.replace('tunica ', 't ', 1)} >/dev/null; echo CODE=$?")
    screen.wait_for(lambda text: "CODE=0" in text, "the end of the resumed run")


def show_that_pipes_get_plain_text(work):
    whole = subprocess.run([tunica, "--allow-world-writable-plugins", "run", "long.json", "-o", "whole", "-j", "1"],
                           cwd=work, capture_output=True, text=True, check=True)
    for text in (whole.stdout, whole.stderr):
        assert text and not re.search(r"[\x00-\x09\x0b-\x1f\x7f]", text), repr(text)
    assert result_of(work / "cut") == result_of(work / "whole"), "the resumed run has another result"


def show_that_colours_can_be_refused(work):
    """On a terminal that has colours they are there; NO_COLOR and TERM=dumb take them off, the latter the bar too."""
    seen = {}
    for name, setting in (("colour", ""), ("no_colour", "NO_COLOR=1 "), ("dumb", "TERM=dumb ")):
        log = recording.with_name(f"session_{name}.log")
        with Screen(["bash", "--norc", "--noprofile"], work, log) as screen:
            screen.enter(SHELL)
            screen.enter(f"{setting}t run short.json -o {name}; {setting}t run nothing.json; echo CODE=$?")
            screen.wait_for(lambda text: "CODE=2" in text, "the end of a run")
        seen[name] = log.read_text(encoding="utf-8")
        text = seen[name]
        assert "error" in text and "nothing.json" in text, text
    error = "\033[1;31merror"
    assert error in seen["colour"] and "\033[36m#" in seen["colour"], seen["colour"]
    for name in ("no_colour", "dumb"):
        assert error not in seen[name] and "\033[36m" not in seen[name] and "\033[33m" not in seen[name], seen[name]
    bar = re.compile(r"\[#*\.*\] +\d+ %|\d+ %  \d/8 searches[^\n]*\r")
    assert bar.search(seen["no_colour"]), "no progress line"
    assert not bar.search(seen["dumb"].replace("\r\n", "\n")), seen["dumb"]


def show_that_an_interrupted_diagnosis_leaves_nothing(work):
    with Screen(["bash", "--norc", "--noprofile"], work) as screen:
        screen.enter(SHELL)
        screen.enter("t diagnose rows.json -j 1; echo CODE=$?")
        screen.wait_for(lambda text: re.search(r"^(?:\[#*\.*\] )? *\d+ %  .* \d:\d\d", text, re.M), "a stage of the diagnosis")
        assert list((work / "results").iterdir()), "no folder while it is under way"
        screen.press("C-c")
        text = screen.wait_for(lambda text: text if "CODE=130" in text else None, "exit code 130")
    assert "leaves nothing behind" in text, text
    assert not (work / "results").exists(), list((work / "results").iterdir())


def main():
    work = pathlib.Path(tempfile.mkdtemp())
    try:
        write_experiment(work, "long.json", "a_model_with_a_name_that_is_much_too_long_for_one_line_of_a_terminal", 120000, 4)
        write_experiment(work, "short.json", "m", 15000, 8)
        write_experiment(work, "rows.json", "m", 15000, 1, 1500)  # some seconds of diagnosis
        with Screen(["bash", "--norc", "--noprofile"], work, recording) as screen:
            screen.enter(SHELL)
            shown = show_that_progress_updates(screen, work)
            show_that_ctrl_c_can_be_resumed(screen, work)
        show_that_pipes_get_plain_text(work)
        show_that_colours_can_be_refused(work)
        show_that_an_interrupted_diagnosis_leaves_nothing(work)
    finally:
        shutil.rmtree(work)
    print(f"{len(shown)} states of the progress line, the last: {' '.join(shown[-1])}; recorded in {recording}")


main()
