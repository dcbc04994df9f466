#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""results_reference.py [--check] [--root FOLDER]: writes docs/results-reference.md, the types of the Python package
(apps/python/tunica/result_types.py) and the keys that readers in C++ use (core/src/results/keys.hpp), from the schemas
of the documents that tunica writes.

--check writes nothing, and ends with 1 where a file is not what the schemas say. A field has a description; its numbers
have a unit, `x-unit`, which is "unit" where the key beside it says it. A code list is a `oneOf` of constants with a
meaning each; `x-source` says which source writes them."""
import argparse
import difflib
import json
import keyword
import pathlib
import re
import sys
import textwrap

RESULT, COHORT, ANSWERS = (f"tunica-{one}.schema.json" for one in ("result", "cohort-result", "answers"))
PREFIX = {RESULT: "", COHORT: "cohort_", ANSWERS: ""}  # of the names in page and types
PAGE, TYPES = "docs/results-reference.md", "apps/python/tunica/result_types.py"
KEYS = "core/src/results/keys.hpp"
CPP_KEYWORDS = {"auto", "class", "default", "double", "explicit", "export", "float", "for", "if", "int", "namespace", "new",
                "operator", "private", "public", "register", "signed", "static", "template", "union", "unsigned"}
INTRODUCTION = """# Reference of results

Every document that tunica writes for programs, field by field. [Results](results.md) says what they mean together.
`docs/results_reference.py` writes this page from [the schemas](../schemas), and the types of the Python package with
it. Do not edit it by hand.

Keys are always present unless they are *optional*. Where no unit is given, a number is a count. *unit* is the unit that
the key `unit` beside it names. The objective of `least_squares` has no unit; the others have those of their channels.
*σ* is a multiple of the noise. A type that is a link has a table of its own, and [codes](#codes) come last.

The Python module `tunica.result_types` has the same as types. The name of a type is that of its table here, in capitals:
`ranked_run` is `RankedRun`.
"""


class Schemas:
    """The schemas of a folder, with references followed, also from one file to another."""

    def __init__(self, folder):
        self.files = {name: json.loads((folder / name).read_text(encoding="utf-8")) for name in PREFIX}

    def documents(self):
        """(heading, schema, name) of each document: the roots, and definitions with `x-document`. A root is "result"."""
        answers = self.files[ANSWERS]["definitions"].items()
        return [("result.json of run, diagnose and discover", RESULT, "result"), ("result.json of cohort", COHORT, "result"),
                *((one["x-document"], ANSWERS, name) for name, one in answers if "x-document" in one)]

    def at(self, file, name):
        """A definition by its name; the root is "result"."""
        return self.files[file]["definitions"][name] if name in self.files[file]["definitions"] else self.files[file]

    @staticmethod
    def target(reference, file):
        other, _, name = reference.partition("#/definitions/")
        return other or file, name

    def bundle(self, file, name):
        """The schema of one document, which needs no other file."""
        found = {}

        def local(part, here):
            if isinstance(part, list):
                return [local(one, here) for one in part]
            if not isinstance(part, dict):
                return part
            if "$ref" in part:
                there, of = self.target(part["$ref"], here)
                key = there.split(".")[0] + "." + of
                if key not in found:
                    found[key] = None
                    found[key] = local(self.at(there, of), there)
                return {"$ref": f"#/definitions/{key}"}
            return {one: local(value, here) for one, value in part.items() if one != "definitions"}

        return {**local(self.at(file, name), file), "definitions": found}


def is_codes(part):
    return "const" in part.get("oneOf", [{}])[0]


def branches(part):
    """What a value may be beside null, and whether it may be null."""
    parts = [one for one in part.get("anyOf", [part]) if one.get("type") != "null"]
    kinds = parts[0].get("type", [])
    return parts, len(parts) < len(part.get("anyOf", [part])) or (isinstance(kinds, list) and "null" in kinds)


class Markdown:
    """Types as the page spells them."""
    simple = staticmethod(str)
    either = staticmethod(" or ".join)
    or_null = staticmethod(lambda spelled: f"{spelled} or null")
    listed = staticmethod(lambda inner: f"list of {inner}")
    mapped = staticmethod(lambda inner: f"name → {inner}")
    constant = staticmethod(lambda value: f"`{json.dumps(value)}`")
    named = staticmethod(lambda name: f"[{name}](#{name})")


def class_name(name):
    return "".join(word[:1].upper() + word[1:] for word in name.split("_"))


class Python:
    """Types as the package spells them."""
    simple = staticmethod({"string": "str", "number": "float", "integer": "int", "boolean": "bool"}.__getitem__)
    either = staticmethod(" | ".join)
    or_null = staticmethod(lambda spelled: f"{spelled} | None")
    listed = staticmethod(lambda inner: f"list[{inner}]")
    mapped = staticmethod(lambda inner: f"dict[str, {inner}]")
    constant = staticmethod(lambda value: f"Literal[{value!r}]")
    named = staticmethod(class_name)


class Writer:
    """Objects and code lists by their names, in the order in which the documents lead to them: (file, name, schema)."""

    def __init__(self, schemas):
        self.schemas, self.objects, self.lists = schemas, {}, {}

    def meet(self, file, name, part):
        """Notes an object or a code list, and all that it leads to. Returns its name; none of anything else."""
        kind = self.lists if is_codes(part) else self.objects if "properties" in part else None
        if kind is None:
            return None
        called = PREFIX[file] + name
        known = self.objects.get(called) or self.lists.get(called)
        if known is None:
            kind[called] = (file, name, part)
            for key, field in part.get("properties", {}).items():
                self.type_of(file, field, f"{name}_{key}", Markdown)
        elif any(known[2].get(key) != part.get(key) for key in ("oneOf", "properties")):
            sys.exit(f"{file}: there are two definitions called '{called}'; rename one")
        return called

    def type_of(self, file, part, path, words):
        """The type of a value, as `words` spells it. An object without a name gets that of its path."""
        if "$ref" in part:
            file, path = self.schemas.target(part["$ref"], file)
            part = self.schemas.at(file, path)
        parts, nullable = branches(part)
        spelled = words.either([self.plain(file, one, path, words) for one in parts])
        return words.or_null(spelled) if nullable else spelled

    def plain(self, file, part, path, words):
        if "$ref" in part:
            return self.type_of(file, part, path, words)
        if called := self.meet(file, path, part):
            return words.named(called)
        if "const" in part:
            return words.constant(part["const"])
        kinds = [part["type"]] if isinstance(part["type"], str) else [one for one in part["type"] if one != "null"]
        if kinds == ["array"]:
            return words.listed(self.type_of(file, part["items"], path, words))
        if kinds == ["object"]:
            return words.mapped(self.type_of(file, part["additionalProperties"], path, words))
        return words.either([words.simple(one) for one in kinds])


def unit_of(schemas, file, part):
    """The unit of the numbers that a field leads to without another object between."""
    while True:
        if "x-unit" in part:
            return part["x-unit"]
        if "$ref" in part:
            file, name = schemas.target(part["$ref"], file)
            part = schemas.at(file, name)
        elif "anyOf" in part:
            part = branches(part)[0][0]
        elif "items" in part:
            part = part["items"]
        elif isinstance(part.get("additionalProperties"), dict):
            part = part["additionalProperties"]
        else:
            return ""


def cell(text):
    return re.sub(r"([|<>*])", r"\\\1", text.removesuffix("."))


def page(schemas):
    writer, lines, printed = Writer(schemas), [INTRODUCTION], set()
    for heading, file, name in schemas.documents():
        writer.meet(file, name, schemas.at(file, name))
        lines += [f"\n## {heading}", f"[{file}](../schemas/{file})"]
        for called, (own, _, part) in writer.objects.items():
            if called in printed:
                continue
            printed.add(called)
            # Links lead to objects and code lists, whose headings have their names.
            lines += [f"\n### {called}", part["description"], "", "| key | type | unit | meaning |", "|---|---|---|---|"]
            for key, field in part["properties"].items():
                optional = "" if key in part.get("required", []) else " *optional*"
                spelled = writer.type_of(own, field, f"{writer.objects[called][1]}_{key}", Markdown)
                lines.append(f"| `{key}`{optional} | {spelled} | {unit_of(schemas, own, field)} | "
                             f"{cell(field['description'])} |")
    lines += ["\n## Codes", "Sentences may change; these codes do not. Scripts should decide by them."]
    for called, (_, _, part) in sorted(writer.lists.items()):
        lines += [f"\n### {called}", part["description"], "", "| code | meaning |", "|---|---|"]
        lines += [f"| `{one['const']}` | {cell(one['description'])} |" for one in part["oneOf"]]
    return "\n".join(lines) + "\n"


def wrapped(first, text, begin):
    return textwrap.wrap(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text), 120, initial_indent=first, subsequent_indent=begin)


def types(schemas):
    writer = Writer(schemas)
    for _, file, name in schemas.documents():
        writer.meet(file, name, schemas.at(file, name))
    lines = ["# SPDX-License-Identifier: Apache-2.0",
             "# Written by docs/results_reference.py from schemas/. Do not edit it by hand.",
             *wrapped('"""', 'The documents that tunica writes, as types for editors and mypy. docs/results-reference.md has '
                      'the same with units. Nothing here is needed to run."""', ""),
             "from __future__ import annotations", "", "import sys", "from typing import Literal", "",
             "if sys.version_info >= (3, 11):", "    from typing import NotRequired, TypedDict",
             "else:", "    from typing_extensions import NotRequired, TypedDict"]
    for called, (_, _, part) in sorted(writer.lists.items()):
        codes = ", ".join(json.dumps(one["const"]) for one in part["oneOf"])
        lines += ["", *wrapped("#: ", part["description"], "#: "),
                  *wrapped(f"{class_name(called)} = Literal[", f"{codes}]", "    ")]
    for called, (file, name, part) in writer.objects.items():
        fields = []
        for key, field in part["properties"].items():
            spelled = writer.type_of(file, field, f"{name}_{key}", Python)
            unit = unit_of(schemas, file, field)
            told = field["description"] + {"": "", "1": "", "unit": " Unit: `unit`."}.get(unit, f" Unit: {unit}.")
            fields.append((key, spelled if key in part.get("required", []) else f"NotRequired[{spelled}]", told))
        by_class = not any(keyword.iskeyword(key) for key, _, _ in fields)
        lines += ["", ""]
        if by_class:
            lines += [f"class {class_name(called)}(TypedDict):", *wrapped('    """', part["description"] + '"""', "    ")]
        else:  # keys such as "with" are no names in Python
            lines += [*wrapped("#: ", part["description"], "#: "),
                      f'{class_name(called)} = TypedDict("{class_name(called)}", {{']
        for key, spelled, told in fields:
            begin = "    "
            lines += wrapped(begin + "#: ", told, begin + "#: ")
            lines.append(f"{begin}{key}: {spelled}" if by_class else f'{begin}"{key}": "{spelled}",')
        if not by_class:
            lines.append("})")
    return "\n".join(lines) + "\n"


def constants(schemas):
    """A constant for each key of the documents; a keyword of C++ gets an underscore."""
    writer = Writer(schemas)
    for _, file, name in schemas.documents():
        writer.meet(file, name, schemas.at(file, name))
    keys = sorted({key for _, _, part in writer.objects.values() for key in part["properties"] if key.isidentifier()})
    lines = [f'inline constexpr Key {key}{"_" if key in CPP_KEYWORDS else ""}{{"{key}"}};' for key in keys]
    return "\n".join(["// SPDX-License-Identifier: Apache-2.0", "// Written by docs/results_reference.py from schemas/.", "#pragma once",
                      "", '#include "results/reading.hpp"', "", "/// The keys of the documents, as the schemas declare them.",
                      "namespace tunica::results::key {", "", *lines, "", "}  // namespace tunica::results::key", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    chosen = parser.parse_args()
    schemas, stale = Schemas(chosen.root / "schemas"), []
    for name, text in ((PAGE, page(schemas)), (TYPES, types(schemas)), (KEYS, constants(schemas))):
        file = chosen.root / name
        if not chosen.check:
            file.write_text(text, encoding="utf-8")
            continue
        there = file.read_text(encoding="utf-8") if file.exists() else ""
        stale += [f"{name}: {line}" for line in difflib.unified_diff(there.splitlines(), text.splitlines(), n=0, lineterm="")
                  if line[0] in "+-"][2:]
    if stale:
        sys.exit("\n".join(stale[:30]) + "\nThe schemas say otherwise (+ new, - no longer said). Run: "
                 "python3 docs/results_reference.py")


if __name__ == "__main__":
    main()
