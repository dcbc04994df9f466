#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""interface_test.py INCLUDE RECORD [--write]: a change of the interface needs a new plugin API number.

RECORD holds TUNICA_PLUGIN_API and a digest of the code of every header that crosses the boundary, comments and blanks
apart. Where code has changed and the number has not, plugins built before would be loaded and call into the wrong place."""
import hashlib
import pathlib
import re
import sys

headers = ["card_energy.hpp", "energy_part.hpp", "energy_scaled_model.hpp", "error.hpp", "maxwell_model.hpp", "mechanism.hpp", "model.hpp", "optimizer.hpp",
           "options.hpp", "parameter.hpp", "plugin.hpp", "status.hpp", "strip_path.hpp", "test.hpp"]
include, record = map(pathlib.Path, sys.argv[1:3])


def code(text):
    """Without comments and blanks, and without the number itself; text in quotes stays."""
    text = re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda found: found[1] or " ", text, flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"#define TUNICA_PLUGIN_API \d+", "", text)).strip()


text = {name: (include / "tunica" / name).read_text(encoding="utf-8") for name in headers}
number = int(re.search(r"#define TUNICA_PLUGIN_API (\d+)", text["plugin.hpp"])[1])
found = {name: hashlib.sha256(code(content).encode()).hexdigest()[:16] for name, content in text.items()}
if "--write" in sys.argv:
    record.write_text("".join(f"{key} {value}\n" for key, value in [("api", number), *found.items()]), encoding="utf-8")
    sys.exit()
known = dict(line.split() for line in record.read_text(encoding="utf-8").splitlines())
changed = [name for name in headers if known.get(name) != found[name]]
again = f"{sys.argv[0]} {include} {record} --write"
if changed and number == int(known["api"]):
    sys.exit(f"the code of {', '.join(changed)} has changed, and TUNICA_PLUGIN_API is still {number}: raise it by one in "
             f"tunica/plugin.hpp, say in docs/migration.md what plugins have to change, then record it: {again}")
if changed or number != int(known["api"]):
    sys.exit(f"TUNICA_PLUGIN_API is {number}, recorded is {known['api']}; record it: {again}")
