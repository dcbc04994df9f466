#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""vector_code.py FILE…: only copies of kernels that detail::vectorised() chooses hold wide vector instructions.

Any other function of a plugin or program may run on a machine without AVX, where the first such instruction ends it."""
import concurrent.futures
import os
import re
import subprocess
import sys

WIDE = re.compile(r"%[yz]mm\d|\bv[a-z0-9]+\s.*%xmm")
CHOSEN = ("run_on_avx2", "run_on_avx512")


def offenders(path):
    # Of millions of lines grep keeps the heads of functions and what names a vector register.
    disassembled = subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", path], stdout=subprocess.PIPE)
    kept = subprocess.run(["grep", "-aE", "^[0-9a-f]+ <|%[xyz]mm"], stdin=disassembled.stdout, capture_output=True, text=True,
                          check=True, env={**os.environ, "LC_ALL": "C"})
    if disassembled.wait() != 0:
        sys.exit(f"objdump cannot read {path}")
    function, found, chosen = "", set(), 0
    for line in kept.stdout.splitlines():
        head = re.match(r"[0-9a-f]+ <(.*)>:$", line)
        if head:
            function = head[1]
            chosen += any(name in function for name in CHOSEN)
        elif WIDE.search(line) and not any(name in function for name in CHOSEN):
            found.add(function)
    return path, sorted(found), chosen


with concurrent.futures.ThreadPoolExecutor() as pool:
    results = list(pool.map(offenders, sys.argv[1:]))
for path, found, _ in results:
    for function in found:
        print(f"{path}: wide vector instructions in {function}")
total = sum(chosen for _, _, chosen in results)
print(f"{len(results)} files, {total} kernels of higher levels")
sys.exit(any(found for _, found, _ in results) or total == 0)
