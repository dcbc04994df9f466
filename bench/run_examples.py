#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Run every worked experiment as its test does, and keep the results, so that two builds can be compared.

    bench/run_examples.py PROGRAM OUT                   examples/*/experiment*.json into OUT/<example>-<file>
    bench/run_examples.py PROGRAM OUT --only NAME       those whose folder is called NAME; may be repeated
    bench/run_examples.py PROGRAM OUT --examples DIR    the examples of another version of the sources

An experiment that asks for a diagnosis is diagnosed by its check.py, which leaves OUT/<example>-<file>/diagnosis. Results
that are there already are left alone, so that an interrupted run is taken up by the same command.
Exit code 1: a run failed, or a check is not content. Then: bench/compare_results.py OLD_OUT OUT."""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time


def run(program, experiment, output):
    """What ctest -L example does, see examples/run_example.cmake; the words of what failed, or nothing."""
    shutil.rmtree(output, ignore_errors=True)
    words = [str(program), "--allow-world-writable-plugins"]
    ended = subprocess.run([*words, "run", str(experiment), "--quiet", "-o", str(output)], capture_output=True, text=True)
    if ended.returncode != 0:
        return f"tunica run: exit code {ended.returncode}: {ended.stderr.strip()}"
    check = experiment.parent / "check.py"
    if check.exists():
        environment = {**os.environ, "TUNICA": ";".join(words)}
        ended = subprocess.run([sys.executable, str(check), str(output)], capture_output=True, text=True, env=environment)
        if ended.returncode != 0:
            return f"check.py: {(ended.stderr.strip() or ended.stdout.strip()).splitlines()[-1]}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[], metavar="NAME")
    parser.add_argument("--examples", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent / "examples")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    experiments = [file for file in sorted(options.examples.resolve().glob("*/experiment*.json"))
                   if not options.only or file.parent.name in options.only]
    if not experiments:
        print(f"{options.examples}: no <example>/experiment*.json" + (f" of {options.only}" if options.only else ""),
              file=sys.stderr)
        return 1
    failed = 0
    for experiment in experiments:
        name = f"{experiment.parent.name}-{experiment.stem}"
        done = options.out / f"{name}.done"
        if done.exists():
            print(f"{name}: there already", flush=True)
            continue
        began = time.monotonic()
        found = run(options.program.resolve(), experiment, options.out.resolve() / name)
        failed += bool(found)
        print(f"{name}: {time.monotonic() - began:.1f} s{': ' if found else ''}{found}", flush=True)
        if not found:
            done.touch()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
