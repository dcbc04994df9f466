#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""references_test.py TUNICA [CASE...] [--write]

What the verbs say of the data of the examples and of experiments/, against what they said when the references beside
this script were written: every number of their JSON to 1e-4 of itself, every sentence, and count, mean and root mean
square of every column of their tables. Counts of evaluations are left out. A change that means to move the others writes
them anew with --write, and its diff shows what has moved. In cases.json, own/ is the folder experiments/."""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = HERE.parent.parent / "examples"
CASES = json.loads((HERE / "cases.json").read_text(encoding="utf-8"))
WITHIN = 1e-4
OF_THE_DAY = re.compile(r"provenance|^date$|seconds|version|\$schema|time_s")
# How long a search took says nothing of its result, and the last digits of a processor decide it.
COUNTS = re.compile(r"evaluation|jacobian|failure|convergence|statistics|_profile\.csv|realisations\.csv|^cost$")
# So do they decide which of the starts that came to the same place is the best.
START = re.compile(r"(?<=the best was start )\d+")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def column(cells):
    """[rows, mean, root mean square] of numbers; else how often each word occurs."""
    try:
        values = [float(cell) for cell in cells if cell]
    except ValueError:
        return {cell: cells.count(cell) for cell in sorted(set(cells))[:20]}
    if not values:
        return [0]
    return [len(values), sum(values) / len(values), math.sqrt(sum(value * value for value in values) / len(values))]


def table(file):
    rows = list(csv.reader(line for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith("#")))
    return {name: column([row[k] for row in rows[1:] if k < len(row)]) for k, name in enumerate(rows[0])} if rows else {}


def rounded(value):
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items() if not (OF_THE_DAY.search(key) or COUNTS.search(key))}
    if isinstance(value, list):
        return [rounded(one) for one in value if not (isinstance(one, str) and "evaluations failed" in one)
                and not (isinstance(one, dict) and "evaluations failed" in one.get("sentence", ""))]
    return float(f"{value:.7g}") if isinstance(value, float) and math.isfinite(value) else value


def results(program, case):
    """File -> what is compared of it."""
    with tempfile.TemporaryDirectory(prefix="references") as room:
        folder = pathlib.Path(room) / "examples"
        shutil.copytree(EXAMPLES, folder, ignore=shutil.ignore_patterns("*.html", "*.svg", "*.png"))
        shutil.copytree(HERE / "experiments", folder / "own")
        words = [str(pathlib.Path(program).resolve()), *case["words"], "-o", str(folder / "out"), "--quiet"]
        ended = subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               text=True, check=False, env={"TUNICA_VECTOR_LEVEL": "baseline", **os.environ})
        if ended.returncode != case.get("code", 0):
            sys.exit(f"{' '.join(words)} ended with {ended.returncode}:\n{ended.stderr}")
        found = {}
        for file in sorted((folder / "out").rglob("*")):
            name = str(file.relative_to(folder / "out"))
            if file.suffix == ".json" and name not in ("input.json", "checkpoint.json"):
                found[name] = rounded(json.loads(file.read_text(encoding="utf-8").replace(str(folder), "examples")))
            elif file.suffix == ".csv" and not COUNTS.search(name):
                found[name] = rounded(table(file))
    return found


# A gain is a difference of objectives of some hundreds: machines differ in it by 2e-11.
def same_number(one, other, within):
    return one == other or abs(one - other) <= within * max(abs(one), abs(other)) + 5e-11


def same_words(one, other):
    """Sentences, whose numbers may differ by two in their last digit; whole ones not at all."""
    one, other = START.sub("#", one), START.sub("#", other)
    if NUMBER.sub("#", one) != NUMBER.sub("#", other):
        return False
    for a, b in zip(NUMBER.findall(one), NUMBER.findall(other)):
        mantissa, _, exponent = a.lower().partition("e")
        last = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        if a != b and ("." not in a or abs(float(a) - float(b)) > 2.5 * last):
            return False
    return True


def differences(reference, found, place=""):
    """Yields a line for each."""
    if isinstance(reference, dict) and isinstance(found, dict):
        for key in reference.keys() | found.keys():
            if key not in found or key not in reference:
                yield f"{place}/{key}: {'no longer there' if key in reference else 'is new'}"
            else:
                yield from differences(reference[key], found[key], f"{place}/{key}")
    elif isinstance(reference, list) and isinstance(found, list) and len(reference) == len(found):
        for k, (one, other) in enumerate(zip(reference, found)):
            yield from differences(one, other, f"{place}/{k}")
    else:
        numbers = all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in (reference, found))
        words = isinstance(reference, str) and isinstance(found, str)
        if not (same_number(reference, found, WITHIN) if numbers else same_words(reference, found) if words
                else reference == found):
            yield f"{place}: {found!r}, was {reference!r}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tunica")
    parser.add_argument("cases", nargs="*", default=sorted(CASES))
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    moved = 0
    for name in options.cases:
        file, found = HERE / f"{name}.json", results(options.tunica, CASES[name])
        if options.write:
            file.write_text(json.dumps(found, indent=0, sort_keys=True, ensure_ascii=False) + "\n", encoding="utf-8")
            continue
        different = list(differences(json.loads(file.read_text(encoding="utf-8")), found))
        moved += len(different)
        for line in different[:20]:
            print(f"{name}{line}")
        print(f"{name}: {len(different)} differences")
    sys.exit(1 if moved else 0)


if __name__ == "__main__":
    main()
