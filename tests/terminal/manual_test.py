#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""manual_test.py TUNICA PAGE: the manual page is that of this program, complete, and typeset without a warning."""
import os
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
from screen import need

tunica, page = sys.argv[1], sys.argv[2]
source = open(page, encoding="utf-8").read()
assert source == subprocess.run([tunica, "man"], capture_output=True, text=True, check=True).stdout, "not of this program"
assert all(ord(c) < 128 and (ord(c) >= 32 or c == "\n") for c in source), "characters that roff may not know"

need("groff", "groff-base")
for device in ("ascii", "utf8"):
    done = subprocess.run(["groff", "-man", "-ww", "-z", "-T", device, page], capture_output=True, text=True, check=False)
    # An old terminal has no λ; everything else is a fault of the page.
    complaints = [line for line in done.stderr.splitlines() if not (device == "ascii" and "can't find special character" in line)]
    assert done.returncode == 0 and not complaints, "\n".join(complaints)

need("man", "man-db")
environment = dict(os.environ, MANWIDTH="80", LC_ALL="C.UTF-8", MAN_KEEP_FORMATTING="")
done = subprocess.run(["man", "--warnings", "-l", page], capture_output=True, text=True, env=environment, check=True)
assert done.stderr == "", done.stderr
text = re.sub(".\b", "", done.stdout)
assert max(len(line) for line in text.splitlines()) <= 80, max(text.splitlines(), key=len)
for section in ("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "VERBS", "ENVIRONMENT", "FILES"):
    assert re.search(f"^{section}$", text, re.M), f"no section {section}"
usage = subprocess.run([tunica, "--help"], capture_output=True, text=True, check=True).stdout
verbs = re.findall(r"^  ([a-z]+) ", usage.split("Subcommands:")[1].split("\n\n")[0], re.M)
assert len(verbs) >= 12, verbs
for verb in verbs:
    help_text = subprocess.run([tunica, verb, "--help"], capture_output=True, text=True, check=True).stdout
    assert re.search(rf"^ +tunica {verb}\b", text, re.M), f"no section on {verb}"
    for option in re.findall(r"^  (?:-\w,)?(--[a-z-]+)", help_text, re.M):
        assert option in text, f"{verb}: {option} is missing"
    for example in re.findall(r"^  tunica .*$", help_text, re.M):
        assert example.strip()[:60] in text, f"{verb}: the example '{example.strip()}' is missing"
print(f"{len(text.splitlines())} lines, {len(verbs)} verbs")
