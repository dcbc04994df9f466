#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""arrows.py COMPILER SOURCES MODULE FOLDER...: what a file of a core module can include.

Compiles files with the include folders of MODULE. Headers of the modules that MODULE links are there; a header of any
other module does not compile, nor does one of a plugin.
"""
import pathlib
import subprocess
import sys
import tempfile

compiler, sources, module, *folders = sys.argv[1:]
core = pathlib.Path(sources) / "core/src"
visible = {pathlib.Path(folder).name for folder in folders if pathlib.Path(folder).parent.name == "include_roots"}
problems = []


def compiles(include):
    """Whether a file that includes this header gets through the preprocessor; and if not, that it is not found."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "file.cpp"
        file.write_text(f'#include "{include}"\n')
        command = [compiler, "-x", "c++", "-std=c++20", "-fsyntax-only", "-fdirectives-only", "-E", str(file)]
        command += [f"-I{folder}" for folder in folders]
        result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode and f"fatal error: {include}: No such file" not in result.stderr:
        problems.append(f"{include}: fails for another reason:\n{result.stderr[:600]}")
    return result.returncode == 0


if module not in visible:
    problems.append(f"module '{module}' does not see its own headers; its roots: {sorted(visible)}")
for folder in sorted(path for path in core.iterdir() if path.is_dir()):
    header = min(folder.rglob("*.hpp"), key=lambda path: path.stat().st_size)
    include = str(header.relative_to(core))
    if compiles(include) != (folder.name in visible):
        wanted = "should compile" if folder.name in visible else "should not compile"
        problems.append(f'a file of module {module} with #include "{include}" {wanted}')
if compiles("gho/gho.hpp") or compiles("plugins/models/gho/gho.cpp"):
    problems.append(f"a file of module {module} can include a plugin")
print("\n".join(problems) or f"{module} sees {', '.join(sorted(visible))} and nothing else of the core")
sys.exit(1 if problems else 0)
