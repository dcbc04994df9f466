#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""arrows.py COMPILER SOURCES MODULE FOLDER...: what a file of a core module can include.

Asks the preprocessor with the include folders of MODULE. It finds headers of the modules that MODULE links, which also
get through it with all that they include. It finds none of any other module, nor of a plugin.
"""
import pathlib
import subprocess
import sys
import tempfile

compiler, sources, module, *folders = sys.argv[1:]
core = pathlib.Path(sources) / "core/src"
visible = {pathlib.Path(folder).name for folder in folders if pathlib.Path(folder).parent.name == "include_roots"}
problems = []


def preprocessed(text):
    """The exit code, the output and the complaints of the preprocessor."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "file.cpp"
        file.write_text(text)
        command = [compiler, "-x", "c++", "-std=c++20", "-fsyntax-only", "-fdirectives-only", "-E", str(file)]
        command += [f"-I{folder}" for folder in folders]
        return subprocess.run(command, capture_output=True, text=True)


if module not in visible:
    problems.append(f"module '{module}' does not see its own headers; its roots: {sorted(visible)}")
headers = {folder.name: str(min(folder.rglob("*.hpp"), key=lambda path: path.stat().st_size).relative_to(core))
           for folder in sorted(core.iterdir()) if folder.is_dir()}
plugins = ("gho/gho.hpp", "plugins/models/gho/gho.cpp")
asked = [*headers.values(), *plugins]
# What an #include would say one file at a time, each with a process of its own.
answer = preprocessed("".join(f'#if __has_include("{one}")\nfound {k}\n#else\nmissing {k}\n#endif\n' for k, one in enumerate(asked)))
answers = dict(reversed(line.split()) for line in answer.stdout.splitlines() if line.startswith(("found ", "missing ")))
found = {one: answers.get(str(k)) for k, one in enumerate(asked)}
for name, include in headers.items():
    if found[include] != ("found" if name in visible else "missing"):
        wanted = "should compile" if name in visible else "should not compile"
        problems.append(f'a file of module {module} with #include "{include}" {wanted}; {answer.stderr[:600]}')
if [found[one] for one in plugins] != ["missing", "missing"]:
    problems.append(f"a file of module {module} can include a plugin")
whole = preprocessed("".join(f'#include "{headers[name]}"\n' for name in sorted(visible & set(headers))))
if whole.returncode:
    problems.append(f"the headers that module {module} sees do not get through the preprocessor:\n{whole.stderr[:600]}")
print("\n".join(problems) or f"{module} sees {', '.join(sorted(visible))} and nothing else of the core")
sys.exit(1 if problems else 0)
