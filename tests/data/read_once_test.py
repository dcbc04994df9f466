#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""read_once_test.py TUNICA EXAMPLES NAME: a run and a diagnosis open every file of data once, however many fits they make.
77: strace cannot run here."""
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def opened(command, trace):
    """How often each CSV file was opened by one process, by its name: the program, or the fresh one that certifies a run."""
    ended = subprocess.run(["strace", "-f", "--seccomp-bpf", "-qq", "-e", "signal=none", "-e", "trace=openat,open,execve", "-o", trace, *command],
                           check=False, capture_output=True, text=True)
    if ended.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(command)}: ended with {ended.returncode}\n{ended.stdout}{ended.stderr}")
    most = collections.Counter()
    for part in re.split(r'execve\("[^"]*", \["tunica", "certify"', trace.read_text(encoding="utf-8")):
        most |= collections.Counter(re.findall(r'open(?:at)?\(.*"([^"]*\.csv)".* = \d', part))
    return most


def main():
    program, examples, name = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    try:
        works = subprocess.run(["strace", "--seccomp-bpf", "-f", "-o", os.devnull, "true"], check=False,
                               stderr=subprocess.DEVNULL).returncode == 0
    except FileNotFoundError:
        works = False
    if not works:
        print("strace cannot run here")
        return 77
    wrong = []
    with tempfile.TemporaryDirectory() as directory:
        folder = pathlib.Path(directory) / "examples"
        shutil.copytree(examples, folder)
        data = set()
        for file in folder.rglob("*.csv"):
            os.utime(file, (1e9, 1e9))
            data.add(str(file))
        for verb in (["run"], ["diagnose", "--quick"]):
            counts = opened([program, *verb, str(folder / name / "experiment.json"), "-o", str(pathlib.Path(directory) / verb[0]), "--quiet"],
                            pathlib.Path(directory) / "trace")
            read = {name: count for name, count in counts.items() if name in data}
            print(verb[0], read)
            if not read or max(read.values()) > 1:
                wrong.append(f"{' '.join(verb)} opened {read or 'none of ' + str(data)}; expected each file once")
    print(*wrong, sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
