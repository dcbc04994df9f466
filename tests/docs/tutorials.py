#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tutorials.py SOURCE: the code blocks of docs/plugins/*.md that name a file are that file, whole and in its order."""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
pages = sorted((source / "docs/plugins").glob("*.md"))
found = 0
for page in pages:
    pieces = {}
    for name, code in re.findall(r"<!-- (\S+) -->\n```cpp\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL):
        pieces.setdefault(name, []).append(code)
    for name, blocks in pieces.items():
        lines = lambda text: [line for line in text.split("\n") if line.strip()]
        shown, file = lines("".join(blocks)), lines((source / name).read_text(encoding="utf-8"))
        for number, (one, other) in enumerate(zip(shown + [""] * len(file), file)):
            if one != other:
                sys.exit(f"{page.name} differs from {name}:\n  page: {one}\n  file: {other}")
        if len(shown) > len(file):
            sys.exit(f"{page.name} has more than {name}: {shown[len(file)]}")
        found += 1
if found < 4:
    sys.exit(f"only {found} pages of docs/plugins show a whole file; there is one for each kind of plugin")
