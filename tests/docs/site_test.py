#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""site_test.py SOURCE OUT: docs/site.py makes every page, and its search knows what is in them. A link that leads
nowhere ends it."""
import json
import pathlib
import subprocess
import sys

source, out = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
subprocess.run([sys.executable, "-B", source / "docs/site.py", out], check=True)
found = {entry["location"].partition("#")[0] for entry in json.loads((out / "search/search_index.json").read_text())["docs"]}
wanted = {str(page.relative_to(source).with_suffix(".html")) for page in (source / "docs").rglob("*.md")} | {"index.html"}
missing = sorted(name for name in wanted if name not in found and not (name == "index.html" and "" in found)
                 or not (out / name).exists())
if missing:
    sys.exit(f"the site, or its search, lacks {', '.join(missing)}")
