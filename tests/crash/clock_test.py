#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clock_test.py TUNICA [--of calibration cohort diagnosis] [--seed S]

The clock of the machine jumps by up to a year, forward and back, every few milliseconds of a short piece of work; the
result is that of a clock which goes as it should. Work that was killed goes on to the identical result a year earlier.
Clocks that measure durations do not jump, as they do not on a real machine. Needs libfaketime (Debian: faketime)."""
import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

sys.dont_write_bytecode = True
from work import call, differing, program, work_of

LIBRARY = next(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"), None)
YEAR = 365 * 86400


class JumpingClock:
    """Writes another offset into the file that libfaketime reads, until it is left."""

    def __init__(self, file, draw):
        self.file, self.draw, self.over, self.jumps = file, draw, threading.Event(), 0

    def environment(self):
        return {"LD_PRELOAD": str(LIBRARY), "FAKETIME_TIMESTAMP_FILE": str(self.file), "FAKETIME_NO_CACHE": "1",
                "FAKETIME_DONT_FAKE_MONOTONIC": "1", "DONT_FAKE_MONOTONIC": "1"}

    def jump(self):
        other = self.file.with_suffix(".new")
        other.write_text(f"{self.draw.randint(-YEAR, YEAR):+d}")
        os.replace(other, self.file)
        self.jumps += 1

    def __enter__(self):
        self.jump()

        def go_on():
            while not self.over.wait(0.005):
                self.jump()
        self.thread = threading.Thread(target=go_on)
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()


def examine(kind, executable, draw, room):
    work = work_of(kind)
    folder = room / kind
    folder.mkdir()
    work.prepare(folder)
    code, said = call(program(executable, *work.start), folder)
    if code != 0:
        raise SystemExit(f"{kind}: ended with {code}\n{said}")
    expected, problems = work.results(folder), []
    shutil.rmtree(folder / "out")
    with JumpingClock(room / "clock", draw) as clock:
        code, said = call(program(executable, *work.start), folder, clock.environment())
    if code != 0 or differing(work.results(folder), expected):
        problems.append(f"jumps: ended with {code}, other than before: {differing(work.results(folder), expected)}\n{said}")
    shutil.rmtree(folder / "out")
    process = subprocess.Popen(program(executable, *work.start), cwd=folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    while process.poll() is None and not any((folder / "out").glob("**/*.csv")):
        pass
    process.send_signal(signal.SIGKILL)
    process.wait()
    earlier = {"LD_PRELOAD": str(LIBRARY), "FAKETIME": f"-{YEAR}"}
    code, said = call(program(executable, *work.go_on), folder, earlier)
    if code != 0 or differing(work.results(folder), expected):
        problems.append(f"a year earlier: ended with {code}, other than before: {differing(work.results(folder), expected)}\n{said}")
    print(f"{kind}: {clock.jumps} jumps of the clock, {len(problems)} wrong", flush=True)
    print("\n".join(problems))
    return not problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tunica")
    parser.add_argument("--of", nargs="+", default=["calibration", "cohort", "diagnosis"])
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if LIBRARY is None:
        raise SystemExit("libfaketime is not here: install the Debian package faketime")
    with tempfile.TemporaryDirectory(prefix="clock") as room:
        good = [examine(kind, options.tunica, random.Random(options.seed), pathlib.Path(room).resolve())
                for kind in options.of]
    raise SystemExit(0 if all(good) else 1)


main()
