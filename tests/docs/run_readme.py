#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_readme.py TUNICA SOURCE_DIR: the JSON of the README runs as it stands, beside the two files of the example."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

tunica, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
blocks = re.findall(r"```json\n(.*?)```", (source / "README.md").read_text(encoding="utf-8"), re.S)
assert len(blocks) == 1, f"the README has {len(blocks)} JSON blocks, expected one"
lines = blocks[0].strip().count("\n") + 1
assert lines <= 12, f"the JSON of the README has {lines} lines, twelve were promised"
with tempfile.TemporaryDirectory() as folder:
    for name in ("circumferential.csv", "axial.csv"):
        shutil.copy(source / "examples/lamb_aorta" / name, folder)
    (pathlib.Path(folder) / "first.json").write_text(blocks[0], encoding="utf-8")
    done = subprocess.run([tunica, "run", "first.json", "-o", "results"], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for word in ("gho/es", "gho/lm", "kPa", "result.json"):
        assert word in done.stdout, f"'{word}' is not in the output:\n{done.stdout}"
print("the README's JSON runs")
