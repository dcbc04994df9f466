#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks JSON Schemas with a validator that shares no code with tunica.

usage: check_schemas.py SCHEMA [DOCUMENT ...]

The schema must be valid against the meta-schema of draft 7, and every document against the schema. Documents may have
comments. Exit code 77 (skipped) where the module jsonschema (Debian: python3-jsonschema) is missing.
"""
import json
import re
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: the Python module jsonschema is missing (Debian: python3-jsonschema)")
    sys.exit(77)

STRING_OR_COMMENT = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)


def read(path):
    with open(path, encoding="utf-8-sig") as file:
        return json.loads(STRING_OR_COMMENT.sub(lambda found: found.group(1) or " ", file.read()))


def main(schema_path, documents):
    schema = read(schema_path)
    jsonschema.Draft7Validator.check_schema(schema)
    print(f"{schema_path}: a valid draft-7 schema")
    validator = jsonschema.Draft7Validator(schema)
    wrong = 0
    for path in documents:
        errors = list(validator.iter_errors(read(path)))
        for error in errors:
            print(f"{path}: /{'/'.join(map(str, error.absolute_path))}: {error.message}")
        wrong += bool(errors)
        print(f"{path}: {'refused' if errors else 'valid'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
