#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""faults_test.py TUNICA LIBRARY [--of calibration cohort diagnosis] [--faults N] [--seed S]

Lets the n-th call of open, write, fsync and rename below the results fail, and of fork, once or from there on, for every n
of a short piece of work, or for N drawn faults; of the calls for memory, 200 are drawn. It ends with one message and a
documented exit code, or had no need of the call; afterwards it goes on to the identical result. Where memory is denied to
a search of a run, that search may end and say so in the results."""
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
FAULTS = {"open": ((":", errno.EIO), ("+:", errno.EACCES), ("+:", errno.ENOSPC)), "write": ((":", errno.EIO), ("+:", errno.ENOSPC)),
          "fsync": ((":", errno.EIO), ("+:", errno.EIO)), "rename": ((":", errno.EIO), ("+:", errno.ENOSPC)),
          "fork": ((":", errno.EAGAIN), ("+:", errno.EAGAIN)), "memory": ((":", errno.ENOMEM),)}
MEMORY_CALLS = 200  # of a million; the same stretches of code ask again and again


def counts_of(work, executable, library, original, room):
    file = room / "counts"
    file.unlink(missing_ok=True)
    code, said = call(program(executable, *work.start), original,
                      {"LD_PRELOAD": library, "FAULT_UNDER": f"{original}/out", "FAULT_COUNTS": str(file)})
    if code != 0 or not file.exists():
        raise SystemExit(f"ended with {code} without any fault:\n{said}")
    calls = collections.Counter()
    for name, number in (line.split() for line in file.read_text().splitlines()):
        calls[name] = max(calls[name], int(number))  # of the process that calls most: the one that works
    return calls


def told_in_results(folder):
    """Whether the results say that a search ended for want of memory: the others went on."""
    return any("bad_alloc" in file.read_text(encoding="utf-8") for file in folder.glob("**/*.json"))


def wrong(fault, code, said, different, messages):
    """What is wrong with the end of the work that met the fault."""
    # Libraries below do not all survive that memory is denied. Then the process that watches says so.
    fell = fault.startswith("memory") and (code == 4 or code > 130) and "memory ran out" in said
    if code not in DOCUMENTED and not fell:
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
    numbers = {name: range(1, calls[name] + 1) for name in FAULTS}
    if len(numbers["memory"]) > MEMORY_CALLS:
        numbers["memory"] = sorted(draw.sample(numbers["memory"], MEMORY_CALLS))
    faults = [f"{name}:{n}{how}{error}" for name, ways in FAULTS.items() for n in numbers[name] for how, error in ways]
    number = len(faults)
    if number < 10:
        raise SystemExit(f"{kind}: only {number} faults: the calls of the process that works are not counted")
    if wanted and wanted < number:
        faults = draw.sample(faults, wanted)
    ends, problems = collections.Counter(), []
    for number_tried, fault in enumerate(faults):
        if number_tried % 50 == 49:
            print(f"{kind}: {number_tried} of {len(faults)} faults tried, {len(problems)} wrong", flush=True)
        shutil.rmtree(original / "out", ignore_errors=True)
        code, said = call(program(executable, *work.start), original,
                          {"LD_PRELOAD": library, "FAULT_UNDER": f"{original}/out", "FAULT": fault})
        search_ended = work.keeps_ends and fault.startswith("memory") and code in (0, 1) and told_in_results(original / "out")
        different = differing(work.results(original), expected)
        problem = "" if search_ended else wrong(fault, code, said, different, work.messages)
        if not problem and not search_ended:
            go_on = work.go_on if (original / "out").exists() else work.start
            again, words = call(program(executable, *go_on), original)
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
