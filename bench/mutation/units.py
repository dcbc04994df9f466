# SPDX-License-Identifier: Apache-2.0
"""How each source is compiled, from compile_commands.json of a build that may join sources (unity builds)."""
import json
import pathlib
import re
import shlex

INCLUDED = re.compile(r'^#include "(/[^"]+)"', re.M)
# Options of g++ that clang does not know or would misread, and their values.
FOREIGN = {"-fno-gnu-unique", "-Wno-restrict", "-Winvalid-pch"}
WITH_VALUE = {"-o", "-include", "-c", "-MT", "-MF"}


class Unit:
    """One compilation: its output, its sources and the options with which clang may read them."""

    def __init__(self, entry):
        words = shlex.split(entry["command"])
        self.file = pathlib.Path(entry["file"])
        self.output = pathlib.Path(entry["directory"]) / words[words.index("-o") + 1]
        joined = self.file.suffix == ".cxx" and self.file.parent.name == "Unity"
        self.sources = [pathlib.Path(name) for name in INCLUDED.findall(self.file.read_text())] if joined else [self.file]
        self.options = []
        skip = True  # the compiler's name
        for word in words:
            if skip or word in WITH_VALUE:
                skip = not skip
            elif word not in FOREIGN and word != str(self.file):
                self.options.append(word)


def units(build):
    """All compilations of a configured build folder."""
    return [Unit(entry) for entry in json.loads((build / "compile_commands.json").read_text())]


def wanted(build, root, folders):
    """Source -> its unit, for the sources below one of the folders."""
    found = {}
    for unit in units(build):
        for source in unit.sources:
            if any(source.is_relative_to(root / folder) for folder in folders):
                found[source] = unit
    return found
