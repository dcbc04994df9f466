#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_reference.py DOXYGEN SOURCE BUILD: writes the SDK reference to BUILD/reference, and fails on any gap in it.

One public symbol without documentation, one reference to what does not exist, one broken formula is a gap. That the
check itself can see is tested with a copy of a header from which one comment is taken. Without Doxygen: ends with 77."""
import pathlib
import re
import shutil
import subprocess
import sys

doxygen, source, build = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
if not shutil.which(doxygen):
    print("skipped: Doxygen is not installed; install the Debian package doxygen, then configure again")
    sys.exit(77)


def run(output, **changed):
    """Doxygen from the root of the sources; what it warns of, line by line."""
    settings = {"OUTPUT_DIRECTORY": f'"{output}"', **changed}
    output.mkdir(parents=True, exist_ok=True)
    text = (source / "docs/Doxyfile").read_text(encoding="utf-8")
    text += "".join(f"{key} = {value}\n" for key, value in settings.items())
    ended = subprocess.run([doxygen, "-"], input=text, cwd=source, capture_output=True, text=True)
    found = [line.replace(f"{source}/", "") for line in ended.stderr.splitlines() if line.strip()]
    if ended.returncode and not found:
        found = [f"doxygen ended with {ended.returncode} and said nothing"]
    return found


def with_a_gap(folder):
    """The headers, one member of Status without its comment."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source / "core/include/tunica", folder / "tunica")
    header = folder / "tunica/status.hpp"
    lines = header.read_text(encoding="utf-8").splitlines()
    header.write_text("\n".join(line.split("///<")[0] if " ok() const" in line else line for line in lines))
    return run(folder / "html", INPUT=f'"{folder}/tunica"', USE_MDFILE_AS_MAINPAGE="")


def left_out(pages):
    """Doxygen is silent about what stands in a namespace, and about macros of a file, that have no documentation."""
    hidden = re.search(r"EXCLUDE_SYMBOLS *= (.*)", (source / "docs/Doxyfile").read_text(encoding="utf-8"))[1].split()
    for header in sorted((source / "core/include/tunica").rglob("*.hpp")):
        if header.parent.name == "detail":
            continue
        text = header.read_text(encoding="utf-8")
        for name in re.findall(r"^namespace ([\w:]+) {", text, re.MULTILINE):
            page = "namespace" + name.replace("_", "__").replace("::", "_1_1") + ".html"
            if name not in hidden and not (pages / page).is_file():
                yield f"{header.name}: namespace {name} is not documented, nor is anything in it"
        for name in re.findall(r"^#define (\w+)", text, re.MULTILINE):
            page = pages / f"{header.stem.replace('_', '__')}_8hpp.html"
            if name not in hidden and (not page.is_file() or name not in page.read_text(encoding="utf-8")):
                yield f"{header.name}: macro {name} is not documented"


gaps = run(build / "reference")
gaps += left_out(build / "reference")
if gaps:
    print("\n".join(gaps))
    sys.exit(f"{len(gaps)} gaps in the SDK reference: document what is named above, in the header or docs/sdk.md")
if not (build / "reference/index.html").is_file():
    sys.exit(f"doxygen wrote no page to {build / 'reference'}: expected index.html; see docs/Doxyfile")
seen = with_a_gap(build / "reference_gap")
if len(seen) != 1 or "Member ok() const" not in seen[0]:
    sys.exit("a member without documentation was not told of, but: " + "\n".join(seen or ["nothing"]))
print(f"no gap; the reference begins at {build / 'reference/index.html'}")
