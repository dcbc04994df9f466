#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills work at random times, goes on with it, and compares the results with those of work that was left alone.

    bench/kills.py TUNICA --kills 1000                    run, cohort, discover and diagnose in turn
    bench/kills.py TUNICA --kills 50 --of calibration     run alone
    bench/kills.py TUNICA --minutes 20 --seed 3

Signals are -9, TERM and INT, a third each. Work is started, killed and gone on with until it comes to its end; then its
numbers must be those of the work that was left alone, to the last bit. Kills come at random, on average a quarter of the
work's length apart. A start that is refused with words counts apart: it is followed by one in a new folder.
Exit code 1: a result differs, or a process ended in a way that is not documented."""
import argparse
import collections
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/crash"))
from work import call, differing, program, work_of  # noqa: E402

SIGNALS = {"KILL": signal.SIGKILL, "TERM": signal.SIGTERM, "INT": signal.SIGINT}
MOST_KILLS = 20  # of one piece of work, for kills in quick succession leave no time to get on
KINDS = ["calibration", "cohort", "discovery", "diagnosis"]


class Campaign:
    def __init__(self, kind, executable, room, length, draw):
        self.kind, self.executable, self.draw = kind, executable, draw
        self.folder = room / kind
        self.folder.mkdir()
        self.work = work_of(kind, length)
        self.work.prepare(self.folder)
        began = time.monotonic()
        code, said = call(program(executable, *self.work.start), self.folder, timeout=600)
        if code != 0:
            raise SystemExit(f"{kind}: ended with {code}\n{said}")
        self.seconds = time.monotonic() - began
        self.expected = self.work.results(self.folder)
        self.kills, self.refused, self.cycles, self.problems = collections.Counter(), 0, 0, []

    def killed(self, words):
        """Starts the work and kills it after a while; None where it was quicker. Else its exit code and words."""
        process = subprocess.Popen(program(self.executable, *words), cwd=self.folder, text=True, errors="replace",
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        wait, name = self.draw.expovariate(4 / self.seconds), self.draw.choice(sorted(SIGNALS))
        try:
            process.wait(wait)
        except subprocess.TimeoutExpired:
            pass
        alive = process.poll() is None
        if alive:
            process.send_signal(SIGNALS[name])
        said = process.communicate(timeout=600)[1]
        if alive and process.returncode not in (0, 1, 2):
            self.kills[name] += 1
            if process.returncode not in (-SIGNALS[name], 130):
                self.problems.append(f"{name} ended it with {process.returncode}: {said}")
        elif process.returncode == 2:
            self.refused += 1
            shutil.rmtree(self.folder / "out", ignore_errors=True)
        return process.returncode

    def cycle(self):
        """From a first start to the end, with kills on the way."""
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        code = self.killed(self.work.start)
        for _ in range(MOST_KILLS):
            if code == 0:
                break
            code = self.killed(self.words())
        code, said = call(program(self.executable, *self.words()), self.folder, timeout=600)
        if code == 2:
            self.refused += 1
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            code, said = call(program(self.executable, *self.work.start), self.folder, timeout=600)
        different = differing(self.work.results(self.folder), self.expected)
        if code != 0 or different:
            self.problems.append(f"cycle {self.cycles}: ended with {code}, other than before: {different}\n{said}")
            shutil.copytree(self.folder, f"{self.folder}.wrong{len(self.problems)}", dirs_exist_ok=True)
        self.cycles += 1

    def words(self):
        return self.work.go_on if (self.folder / "out").exists() else self.work.start

    def told(self):
        kills = ", ".join(f"{number} {name}" for name, number in sorted(self.kills.items()))
        return (f"{self.kind}: {sum(self.kills.values())} kills ({kills}) in {self.cycles} cycles of {self.seconds:.1f} s, "
                f"{self.cycles - len(self.problems)} identical, {self.refused} starts refused, {len(self.problems)} wrong")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tunica")
    parser.add_argument("--kills", type=int, default=1000, help="of all verbs together")
    parser.add_argument("--minutes", type=float, default=1e9, help="end after so many, with fewer kills")
    parser.add_argument("--of", nargs="+", default=KINDS, choices=KINDS)
    parser.add_argument("--length", type=int, default=4, help="how long the work is")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell lets what it starts in the background ignore it
    draw, end = random.Random(options.seed), time.monotonic() + 60 * options.minutes
    room = pathlib.Path(tempfile.mkdtemp(prefix="kills")).resolve()
    campaigns = [Campaign(kind, options.tunica, room, options.length, draw) for kind in options.of]
    share = options.kills / len(campaigns)
    while time.monotonic() < end:
        left = [one for one in campaigns if sum(one.kills.values()) < share]
        if not left:
            break
        for one in left:
            one.cycle()
            print(one.told(), flush=True)
    print("\n".join(["", *(one.told() for one in campaigns)]))
    for one in campaigns:
        for problem in one.problems:
            print(problem)
    if any(one.problems for one in campaigns):
        raise SystemExit(f"what differs is kept in {room}")
    shutil.rmtree(room)


main()
