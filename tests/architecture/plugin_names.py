#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plugin_names.py TUNICA SOURCE LIST: no name of a model, test, optimiser or mechanism stands in a literal of the core,
but those of LIST, one `path: names: reason` a line. The core knows what a plugin declares. A name on the list that is
gone has to go from the list too."""
import json
import pathlib
import re
import subprocess
import sys

PIECE = re.compile(r'//[^\n]*|/\*.*?\*/|"((?:\\.|[^"\\\n])*)"', re.S)
QUOTED = re.compile(r'\\?"([a-z0-9_]+)\\?"')


def names_of(program):
    listed = json.loads(subprocess.run([program, "list", "--json"], check=True, capture_output=True, text=True).stdout)
    return {entry["name"] for kind in ("models", "tests", "optimizers", "mechanisms") for entry in listed[kind]}


def found_in(text, names):
    """The names in literals: whole ones, and those that a raw literal quotes."""
    raw = re.findall(r'R"(\w*)\((.*?)\)\1"', text, re.S)
    literals = [piece[1] for piece in PIECE.finditer(text) if piece[1] is not None]
    literals += [name for _, content in raw for name in QUOTED.findall(content)]
    return set(literals) & names


def allowed_by(file):
    allowed = {}
    for line in file.read_text().splitlines():
        if line and not line.startswith("#"):
            path, words, reason = (part.strip() for part in line.split(":", 2))
            assert reason, f"{file}: '{path}' has no reason"
            allowed[path] = set(words.split())
    return allowed


def main():
    program, source, file = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    names, allowed = names_of(program), allowed_by(file)
    assert found_in('f("gho"); // "hgo"\n', {"gho", "hgo"}) == {"gho"}
    assert found_in('f(R"({"type": "gho"})");', {"gho"}) == {"gho"}
    problems = []
    for path in sorted(path for path in (source / "core/src").rglob("*.?pp")):
        place = str(path.relative_to(source))
        found, known = found_in(path.read_text(), names), allowed.pop(place, set())
        problems += [f"{place}: knows the plugin's name '{name}'; ask the catalogue for what the plugin declares"
                     for name in sorted(found - known)]
        problems += [f"{file.name}: '{name}' is not in {place} any more; take it off the list" for name in sorted(known - found)]
    problems += [f"{file.name}: there is no {place}; take it off the list" for place in allowed]
    for problem in problems:
        print(problem)
    sys.exit(1 if problems else 0)


main()
