#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_architecture.py SOURCE: the table of modules in docs/architecture.md names the folders of core/src, and every module
links only modules that stand above it there; the rooms of the diagnosis are its folders."""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
page = (source / "docs/architecture.md").read_text(encoding="utf-8")
problems = []


def first_column(heading):
    return re.findall(r"^\| `(\w+)` \|", page.split(heading + "\n")[1].split("\n#")[0], re.M)


def compare(what, written, folder):
    there = {path.name for path in folder.iterdir() if path.is_dir() and list(path.glob("*.cpp"))}
    problems.extend(f"docs/architecture.md lists no {what} {name}" for name in sorted(there - set(written)))
    problems.extend(f"docs/architecture.md lists the {what} {name}, and {folder.relative_to(source)}/{name} is not there"
                    for name in written if name not in there)


modules = first_column("## Modules")
compare("module", modules, source / "core/src")
compare("room", first_column("### The rooms of `diagnosis`"), source / "core/src/diagnosis")
arrows = 0
for place, module in enumerate(modules):
    file = source / "core/src" / module / "CMakeLists.txt"
    libraries = re.findall(r"\btunica_(\w+)", file.read_text(encoding="utf-8").partition("LIBRARIES")[2]) if file.exists() else []
    for library in libraries:
        if library in modules and library != module:
            arrows += 1
            if library not in modules[:place]:
                problems.append(f"{module} links {library}, which stands below it in docs/architecture.md")
if problems:
    sys.exit("\n".join(problems))
if arrows < 15:
    sys.exit(f"found only {arrows} arrows between modules; expected more, see LIBRARIES in core/src/*/CMakeLists.txt")
print(f"{len(modules)} modules, {arrows} arrows")
