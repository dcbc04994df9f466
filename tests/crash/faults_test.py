#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""faults_test.py TUNICA LIBRARY [--of calibration cohort diagnosis] [--faults N] [--seed S]

Lets the n-th call of open, write, fsync and rename below the results fail, once or from there on, for every n of a short
piece of work, or for N drawn faults. It ends with one message and a documented exit code, or had no need of the call;
afterwards it goes on to the identical result."""
import argparse
import collections
import errno
import pathlib
import random
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
from work import call, differing, program, work_of

DOCUMENTED = (0, 1, 2, 130)
FAULTS = {"open": ((":", errno.EIO), ("+:", errno.EACCES)), "write": ((":", errno.EIO), ("+:", errno.ENOSPC)),
          "fsync": ((":", errno.EIO), ("+:", errno.EIO)), "rename": ((":", errno.EIO), ("+:", errno.ENOSPC))}


def counts_of(work, executable, library, original, room):
    file = room / "counts"
    code, said = call(program(executable, *work.start), original,
                      {"LD_PRELOAD": library, "FAULT_UNDER": f"{original}/out", "FAULT_COUNTS": str(file)})
    if code != 0 or not file.exists():
        raise SystemExit(f"ended with {code} without any fault:\n{said}")
    return {name: int(number) for name, number in (line.split() for line in file.read_text().splitlines())}


def wrong(code, said, different, messages):
    """What is wrong with the end of the work that met the fault."""
    if code not in DOCUMENTED:
        return f"exit code {code}"
    if code == 0:
        return f"exit code 0 with another result: {different}" if different else ""
    errors = [line for line in said.splitlines() if line.startswith("error: ")]
    return "" if 1 <= len(errors) <= messages else f"{len(errors)} messages"


def examine(kind, executable, library, wanted, draw, room):
    work = work_of(kind)
    original = room / kind
    original.mkdir()
    work.prepare(original)
    calls = counts_of(work, executable, library, original, room)
    expected = work.results(original)
    faults = [f"{name}:{n}{how}{error}" for name, ways in FAULTS.items() for n in range(1, calls[name] + 1) for how, error in ways]
    number = len(faults)
    if wanted and wanted < number:
        faults = draw.sample(faults, wanted)
    ends, problems = collections.Counter(), []
    for fault in faults:
        shutil.rmtree(original / "out", ignore_errors=True)
        code, said = call(program(executable, *work.start), original,
                          {"LD_PRELOAD": library, "FAULT_UNDER": f"{original}/out", "FAULT": fault})
        problem = wrong(code, said, differing(work.results(original), expected), work.messages)
        if not problem:
            again, words = call(program(executable, *work.go_on), original)
            different = differing(work.results(original), expected)
            if again != 0 or different:
                problem = f"going on ends with {again}, other than before: {different}\n{words}"
        ends[code] += 1
        if problem:
            problems.append(f"{fault}: {problem}\n{said}")
    print(f"{kind}: {number} faults ({', '.join(f'{n} {name}' for name, n in calls.items())}), {len(faults)} tried, exit codes "
          f"{dict(sorted(ends.items()))}, {len(problems)} wrong", flush=True)
    for problem in problems[:8]:
        print(problem)
    return not problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tunica")
    parser.add_argument("library")
    parser.add_argument("--of", nargs="+", default=["calibration", "cohort", "diagnosis"])
    parser.add_argument("--faults", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    library = str(pathlib.Path(options.library).resolve())
    with tempfile.TemporaryDirectory(prefix="faults") as room:
        good = [examine(kind, options.tunica, library, options.faults, random.Random(options.seed), pathlib.Path(room).resolve())
                for kind in options.of]
    raise SystemExit(0 if all(good) else 1)


main()
