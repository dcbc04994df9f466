#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""crash_states_test.py TUNICA [--of calibration cohort diagnosis] [--states N] [--seed S]

Records the system calls of a short piece of work, builds the states that a loss of power may leave after each of them,
and goes on from each: the result is the identical one, or it is refused with words. After an fsync of a file its data
are there, after one of its folder its name is; everything else may be there, be lost or be torn. N states are drawn;
without N there are all calls with seven states each, three of them torn. States that are equal are tried once. Exit code
77: strace cannot run here."""
import argparse
import collections
import pathlib
import random
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
import recorded
from work import call, differing, program, work_of


def states_of(calls, folder, wanted, draw):
    """(Number of the call, kind of state, state), all or `wanted` of them, and the state after all calls."""
    disk, points = recorded.Disk(folder, "out"), []
    for k, one in enumerate(calls):
        if disk.take(*one):
            points.append(k)
    kinds = ["everything", "nothing unsynced", "names only", "data only", "torn", "torn again", "torn once more"]
    chosen = [(k, kind) for k in points for kind in kinds]
    if wanted and wanted < len(chosen):
        chosen = sorted(draw.sample(chosen, wanted))
    chosen.append((points[-1], "at the end"))
    disk, at = recorded.Disk(folder, "out"), 0
    for k, kind in chosen:
        while at <= k:
            disk.take(*calls[at])
            at += 1
        names, data = {"everything": (recorded.every, recorded.all_data),
                       "nothing unsynced": (recorded.none, recorded.no_data), "at the end": (recorded.none, recorded.no_data),
                       "names only": (recorded.every, recorded.no_data),
                       "data only": (recorded.none, recorded.all_data)}.get(
                           kind, (recorded.some_names(draw), recorded.torn_data(draw)))
        yield k, kind, disk.after_a_crash(names, data)


def put(state):
    for place, text in ((pathlib.Path(path), text) for path, text in state.items()):
        if text is None:
            place.mkdir()
        else:
            place.write_bytes(text)


def examine(kind, executable, wanted, draw, room):
    work = work_of(kind)
    original = room / kind
    original.mkdir()
    work.prepare(original)
    code, calls = recorded.record(program(executable, *work.start), original, room / "trace")
    if code != 0:
        raise SystemExit(f"{kind}: ended with {code} under strace")
    expected = work.results(original)
    counts, refusals, problems, last, tried = collections.Counter(), collections.Counter(), [], None, set()
    for k, how, state in states_of(calls, original, wanted, draw):
        counts["states"] += 1
        if (content := frozenset(state.items())) in tried and how != "at the end":
            continue
        tried.add(content)
        if len(tried) % 50 == 0:
            print(f"{kind}: {len(tried)} states tried, {len(problems)} wrong", flush=True)
        shutil.rmtree(original / "out", ignore_errors=True)
        put(state)
        last = work.results(original)  # of the final state in the end
        code, said = call(program(executable, *work.go_on), original)
        different = differing(work.results(original), expected)
        if code == 0 and not different:
            counts["identical"] += 1
        elif code == 2 and said.startswith("error: "):
            counts["refused"] += 1
            refusals[" ".join(said.replace(str(original), "").split())[:120]] += 1
        else:
            problems.append(f"after call {k} ({calls[k][0]}), {how}: exit code {code}, other than before: {different}\n{said}")
    if differing(last, expected):
        problems.append("of work that had ended well, a loss of power takes results away")
    print(f"{kind}: {len(calls)} calls, {counts['states']} states, {len(tried)} different ones: "
          f"{counts['identical']} identical, {counts['refused']} refused, {len(problems)} wrong", flush=True)
    for words, number in refusals.most_common():
        print(f"    {number} times {words}")
    for problem in problems[:5]:
        print(problem)
    return not problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tunica")
    parser.add_argument("--of", nargs="+", default=["calibration", "cohort", "diagnosis"])
    parser.add_argument("--states", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if not recorded.strace_works():
        print("strace cannot run here")
        raise SystemExit(77)
    with tempfile.TemporaryDirectory(prefix="crash") as room:
        good = [examine(kind, options.tunica, options.states, random.Random(options.seed), pathlib.Path(room).resolve())
                for kind in options.of]
    raise SystemExit(0 if all(good) else 1)


main()
