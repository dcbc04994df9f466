#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_functions.py SOURCE: docs/sdk.md lists what the formula of an energy may call, no more and no less than
tunica::functions has, and every function is tested."""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
header = (source / "core/include/tunica/models/jet_functions.hpp").read_text()
page = (source / "docs/sdk.md").read_text()
tests = (source / "tests/models/jets_test.cpp").read_text()
has = set(re.findall(r"^using (?:ceres|std)::(\w+);", header, re.MULTILINE))
table = page.split("## What the formula of an energy may call")[1].split("\n## ")[0]
shown = {name for row in re.findall(r"^\| (`.*?) \|", table, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}
tested = set(re.findall(r"\b(\w+)\(", "".join(re.findall(r"FORMULA\((.*)\)", tests))))
faults = []
for name, missing in (("docs/sdk.md does not list", has - shown), ("docs/sdk.md lists without a header", shown - has),
                      ("tests/models/jets_test.cpp does not test", has - tested)):
    if missing:
        faults.append(f"{name}: {', '.join(sorted(missing))}")
if len(has) < 20:
    faults.append(f"only {len(has)} functions found in the header: has tunica::functions moved?")
if faults:
    sys.exit("\n".join(faults))
print(f"{len(has)} functions, all listed and tested")
