#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""errors.py [PAGE COMMITTED]: writes the error list from the messages in the sources to docs/errors.md, or to PAGE,
which is then compared with COMMITTED.

Most messages say what is wrong and what to do. Cures of the others stand in error_cures.txt, by the beginning of the
message. Ends with 1 where a message has no cure, or a cure no message."""
import argparse
import difflib
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
from error_texts import GAP, NAMES, messages

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent

# The first folder or file that fits decides; the order is that of the page.
SUBJECTS = [
    ("Python", "Raised as `tunica.InputError`, beside the messages of the command line.", ["apps/python/"]),
    ("Command line", "What stands behind `tunica`, and where results go.",
     ["apps/", "core/src/cluster/", "core/src/exporting/", "core/src/importing/", "core/src/imports/", "core/src/comparison/snapshots", "core/src/comparison/simulation",
      "core/src/comparison/parameter_file", "core/src/comparison/certify"]),
    ("JSON", "The experiment file as text. Each message names file, line and column.",
     ["core/src/experiment/json_document"]),
    ("Experiment file", "Each message names the file, the JSON pointer, line and column.", ["core/src/experiment/"]),
    ("Units", "", ["core/src/data/units"]),
    ("Data files", "Each message names the file, and the line and column where there is one.", ["core/src/data/"]),
    ("Material cards", "What `tunica export` refuses.", ["core/src/cards/"]),
    ("Serving a run", "Answers of `tunica serve`, beside what fails in an evaluation.", ["core/src/serving/"]),
    ("Setting up a calibration", "Found when models, tests and data are put together, before anything is evaluated.",
     ["core/src/assembly/binding", "core/src/assembly/builder", "core/src/assembly/channels",
      "core/src/assembly/composition", "core/src/assembly/constraint.", "core/src/assembly/run_test", "core/src/assembly/noise",
      "core/src/assembly/objective", "core/src/calibration/", "core/src/search/calibration_problem", "core/src/execution/plan",
      "core/src/comparison/uncertainty", "core/src/comparison/stability_map"]),
    ("Running and resuming", "Folders of results, checkpoints, the journal of evaluations.", ["core/src/execution/"]),
    ("Statistics of a cohort", "The cohort is refused as a whole; a specimen that fails alone is listed instead.",
     ["core/src/population/"]),
    ("Evaluations that fail", "No errors of the program: such a point is counted, and the search goes on as "
     "`on_failure` says. They stand in evaluations.csv, and in the warning about failed evaluations.",
     ["core/src/assembly/", "core/src/search/", "core/src/uncertainty/", "core/src/posterior/", "core/include/tunica/detail/free_strip", "core/include/tunica/detail/symmetric_strip",
      "core/include/tunica/detail/free_faces", "core/include/tunica/detail/compressible", "core/include/tunica/detail/elastic_only", "core/src/stability/"]),
    ("Warnings about results", "Printed after a run, first in report.html and in result.json.",
     ["core/src/comparison/"]),
    ("Diagnosis", "", ["core/src/diagnosis/", "core/src/discovery/", "core/src/cohort_diagnosis/"]),
    ("Cohorts", "", ["core/src/cohort/"]),
    ("Reports", "", ["core/src/report/"]),
    ("Plugins that are refused", "Exit code 3 where the file was named with --plugin-path, else a warning.",
     ["core/src/plugins/"]),
    ("Writing a plugin", "What the SDK says where it is not used as its headers have it.",
     ["core/include/tunica/models/", "core/include/tunica/options",
      "core/include/tunica/model", "core/include/tunica/test", "core/include/tunica/detail/point_rows"]),
    ("`tunica plugin check`", "Told beside the property that could not be checked.", ["core/src/conformance/"]),
    ("Models and mechanisms", "", ["plugins/models/", "plugins/mechanisms/"]),
    ("Tests", "A message with a row is a failed evaluation, the others are wrong input.", ["plugins/simulated_tests/"]),
    ("Optimisers", "", ["plugins/optimizers/"]),
]
NOT_MESSAGES = ["core/src/conformance/function", "core/src/conformance/constrained", "core/src/conformance/test_calls"]
# Where functions return messages that others print.
RETURNS = ("core/src/plugins/", "core/src/execution/files", "apps/tunica/session")

# A clause that begins so tells what to do or what is expected.
DO = ("Add Allow Bind Check Choose Close Correct Define Enlarge Expected Fill Finish Fit Fix Free Give Hold Impose "
      "Install Keep Leave Let Link List Look Lower Make Map Mend Mount Move Name Narrow Pass Put Raise Rebuild Remove "
      "Rename Resume Run Save Say See Select Set Share Shorten Start State Strike Swap Take Use Wait Widen Write").split()
EXPECT = ["0 leaves it", "A fixed parameter is", "A map has", "A stage is", "A standard deviation is", "A stretch is",
          "About four", "At most", "Did you mean", "Difference the whole", "It applies", "It must", "JSON has",
          "Keys look", "Paths are", "Quantities with", "Radii are", "Relative names", "Rows are", "Rows must",
          "Rows stand", "Stretches of", "Tests that", "Text stands", "The test '⟨…⟩' names", "The test has",
          "Then go on", "They are one", "This is a fault", "This version", "Thick_wall_pressurisation can",
          "Units are", "Weights are", "`tunica list", "--resume goes", NAMES]
CURE = re.compile(
    r"(?:; |\. |\? |, (?=expected)|: (?=correct |give |leave |map |name |say |state ))(?:⟨…⟩ ?)?"
    r"(?=(?:or |then |to \w[^,;]*, |for a [^,;]*? )?"
    rf"(?:{'|'.join(map(re.escape, DO + EXPECT))}|(?<!⟩ )Is)(?![a-z]))", re.I)

INTRODUCTION = """# Errors and warnings

Every message says what was found and where; most say what to do as well. Here they stand by subject, with {gap} for
what differs from case to case, and without the place before it. To find one, search for the words between names and
numbers.

A message reads: `error:` or `warning:`, the place (file, line, JSON pointer, option or plugin), what was found, what is
expected, what to do. Unknown names are answered with the nearest one and with all there are. Errors end the program;
warnings do not, and those about results stand first in the report. Where a plugin speaks, its name and version stand
before the message.

| exit code | meaning |
|---|---|
| 0 | done |
| 1 | ran, but a run has no result, is no fit, did not converge, broke its constraints or was given up |
| 2 | wrong input: command line, experiment file, data, a folder that cannot be written |
| 3 | a plugin that was asked for was refused |
| 4 | a fault of tunica or of a plugin: please report it with the files that caused it |
| 130 | interrupted and saved; go on with `--resume` |

What the parser of the command line says of options and values comes from CLI11 and is not listed. This page is
written by `docs/errors.py` from the sources; do not edit it by hand.
"""


def subject_of(path):
    return next((k for k, (_, _, places) in enumerate(SUBJECTS) if any(path.startswith(one) for one in places)), None)


def plain(message):
    """The message from its first word on."""
    return re.sub(rf"^(?:{GAP}[:,./]* ?)+", "", message)


def parted(message):
    """What is wrong, and the cure if the message has one."""
    found = next((one for one in CURE.finditer(message) if words_of(message[:one.start()])), None)
    return (message[:found.start()], message[found.end():]) if found else (message, "")


def words_of(message):
    return re.findall(r"[^\W\d_]{2,}", re.sub(r"⟨[^⟩]*⟩|plugin '|test '|line ⟨|column ⟨", " ", message))


def cures():
    lines = (HERE / "error_cures.txt").read_text(encoding="utf-8").splitlines()
    return dict(line.split(" => ", 1) for line in lines if " => " in line and not line.startswith("#"))


def collect():
    """Subject → (what is wrong, file) → cures; and the messages for which no cure is known."""
    known, used, missing = cures(), set(), []
    rows = [{} for _ in SUBJECTS]
    files = [file for folder in ("core", "apps", "plugins") for file in sorted((ROOT / folder).rglob("*.[ch]pp"))]
    for file in files:
        path = str(file.relative_to(ROOT))
        subject = subject_of(path)
        for message in messages(file.read_text(encoding="utf-8"), returns=path.startswith(RETURNS)):
            message = re.sub(rf"^{GAP}: (?=.*\w)", "", message.strip())
            if len(words_of(message)) < 2 or any(path.startswith(one) for one in NOT_MESSAGES):
                continue
            wrong, cure = parted(message)
            for beginning in known:
                if plain(message).startswith(beginning):
                    used.add(beginning)
                    cure = known[beginning] if not cure else cure
            if cure == "-":
                continue
            if subject is None or not cure:
                missing.append(f"{path}: {message}")
                continue
            told = rows[subject].setdefault((wrong, f"{file.parent.name}/{file.name}"), [])
            if cure not in told:
                told.append(cure)
    missing += [f"error_cures.txt: no message begins with '{one}'; remove it" for one in known if one not in used]
    return rows, missing


def cell(text):
    return re.sub(r"([|<>*])", r"\\\1", re.sub(r"(?<!\.)\.$", "", text.strip()))


def cure_cell(told):
    return "; or: ".join(cell(one[:1].upper() + one[1:]) for one in told)


def page(rows):
    lines = [INTRODUCTION.format(gap=GAP)]
    for (title, note, _), messages_here in zip(SUBJECTS, rows):
        if messages_here:
            lines += [f"\n## {title}", *([note, ""] if note else [])]
            lines += ["| message | what to do | from |", "|---|---|---|"]
            lines += [f"| {cell(wrong)} | {cure_cell(told)} | `{name}` |"
                      for (wrong, name), told in messages_here.items()]
    return "\n".join(lines) + "\n"


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("page", nargs="?", type=pathlib.Path, default=HERE / "errors.md")
parser.add_argument("committed", nargs="?", type=pathlib.Path)
chosen = parser.parse_args()
rows, missing = collect()
chosen.page.write_text(page(rows), encoding="utf-8")
if missing:
    sys.exit("\n".join(missing) + "\nSay in the message what to do; where it cannot, add `beginning => cure` to "
             "docs/error_cures.txt. Then run: python3 docs/errors.py")
if chosen.committed:
    pages = [one.read_text(encoding="utf-8").splitlines() for one in (chosen.page, chosen.committed)]
    differing = [line for line in difflib.unified_diff(pages[1], pages[0], lineterm="", n=0) if line[:1] in "+-"][2:]
    if differing:
        sys.exit("\n".join(differing[:40]) + f"\n{chosen.committed} is not what the sources say (+ new, - no longer "
                 "said). Run: python3 docs/errors.py")
