#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""experiment_reference.py [--check] [--root FOLDER]: writes docs/experiment-reference.md from the schema of experiment files.

--check writes nothing, and ends with 1 where the page is not what the schema says. What plugins declare is left out:
of models, tests, optimizers and mechanisms the page has the keys that all of them share."""
import argparse
import json
import pathlib
import sys

SCHEMA, PAGE = "schemas/tunica-experiment.schema.json", "docs/experiment-reference.md"
INTRODUCTION = """# Reference of the experiment file

Every key, block by block. [The experiment file](experiment-file.md) says how they go together, with examples.
`docs/experiment_reference.py` writes this page from [the schema](../schemas), which `tunica schema` prints from the
declarations that the reader follows. Do not edit it by hand.

A *quantity* is a number in the base unit, or text with a unit, as in `"3.71 mm"`. Keys in **bold** are needed. Options
of a plugin are keys beside these; `tunica describe NAME` lists them with their parameters.
"""
# What plugins declare, by the prefix of its definitions; the word is that of its key.
KINDS = {"model": "models", "test": "tests", "data": "data", "optimizer": "optimizers", "mechanism": "mechanisms"}


def shared(definitions, kind):
    """The keys that all plugins of a kind have, as one object."""
    all_of_kind = [one for name, one in definitions.items() if name.startswith(kind + "_")]
    keys = [key for key in all_of_kind[0]["properties"] if all(key in one["properties"] for one in all_of_kind)]
    required = [key for key in all_of_kind[0].get("required", []) if all(key in one.get("required", []) for one in all_of_kind)]
    properties = {key: all_of_kind[0]["properties"][key] for key in keys}
    for key in {"type", "parameters", "mechanisms", "columns", "constant"} & set(properties):
        properties[key] = {"description": {"type": "Which plugin serves it.", "mechanisms": "Mechanisms to include, in any order."}.get(
            key, properties[key].get("description", "")), "type": "string" if key == "type" else "object"}
    return {"type": "object", "properties": properties, "required": required}


class Page:
    def __init__(self, schema):
        self.schema, self.sections, self.done = schema, [], set()

    def resolved(self, part):
        while "$ref" in part or "allOf" in part and "$ref" in part["allOf"][0]:
            reference = part.get("$ref") or part["allOf"][0]["$ref"]
            target = self.schema["definitions"][reference.rpartition("/")[2]]
            part = {**target, **{key: value for key, value in part.items() if key == "description"}}
        return part

    def type_of(self, part, key):
        part = self.resolved(part)
        if "anyOf" in part:
            words = [self.type_of(one, key) for one in part["anyOf"]]
            return " or ".join(dict.fromkeys(words))
        if "const" in part:
            return f"`{json.dumps(part['const'])}`"
        if "enum" in part:
            return ", ".join(f"`{one}`" for one in part["enum"])
        if part.get("type") == ["number", "string"]:
            return "quantity"
        if part.get("type") == "array":
            items = part.get("items", {})
            if isinstance(items, list):  # each place has its own
                return "[" + ", ".join(self.type_of(one, key) for one in items) + "]"
            return "list of " + self.type_of(items, key)
        if "properties" in part:
            name = part["properties"].get("type", {}).get("const", key)
            self.section(name, part)
            return f"[object](#{name})"
        word = part.get("type", "object")
        word = " or ".join(word) if isinstance(word, list) else word
        low, high = part.get("minimum"), part.get("maximum")
        if word in ("integer", "number") and low is not None:
            word += f", {low:g} to {high:g}" if high is not None else f", at least {low:g}"
        return word

    def section(self, name, part):
        if name in self.done:
            return
        self.done.add(name)
        at = len(self.sections)
        self.sections.append(None)  # nested blocks follow theirs
        rows = []
        for key, value in part["properties"].items():
            value = self.resolved(value) if key not in KINDS.values() else value
            shown = f"**`{key}`**" if key in part.get("required", []) else f"`{key}`"
            meaning = value.get("description", "").replace("|", "\\|").replace("\n", " ")
            rows.append(f"| {shown} | {self.value(name, key, value)} | {meaning} |")
        about = part.get("description", "") if name != "file" else ""
        self.sections[at] = "\n".join([f"## {name}\n", *([about + "\n"] if about else []),
                                       "| key | value | meaning |", "|---|---|---|", *rows])

    def value(self, owner, key, value):
        """What stands behind a key; entries that plugins serve have a block of their own."""
        for kind, word in KINDS.items():
            if key == word and owner in ("file", "model", "test"):
                self.section(kind, shared(self.schema["definitions"], kind))
                how = "" if kind == "data" else "list, each: " if kind == "mechanism" else "by name, each: "
                return f"{how}[{kind}](#{kind})"
        value = self.resolved(value)
        entry = value.get("additionalProperties")
        if isinstance(entry, dict) and "properties" not in value and "properties" in self.resolved(entry):
            self.section(key, self.resolved(entry))
            return f"by name, each: [object](#{key})"
        return self.type_of(value, key)

    def text(self):
        self.section("file", self.schema)
        self.section("mechanism", shared(self.schema["definitions"], "mechanism"))
        layered = [one["properties"]["layers"] for one in self.schema["definitions"].values()
                   if "layers" in one.get("properties", {})]
        self.section("layers", layered[0]["items"])
        searched = self.schema["definitions"]["parameter"]["anyOf"]
        both = {**searched[0], "properties": {**searched[0]["properties"], **searched[1]["properties"]},
                "description": self.schema["definitions"]["parameter"]["description"]}
        self.section("parameter", both)
        self.section("stages", self.schema["definitions"]["staged"])
        return INTRODUCTION + "\n" + "\n\n".join(self.sections) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1])
    options = parser.parse_args()
    text = Page(json.loads((options.root / SCHEMA).read_text(encoding="utf-8"))).text()
    page = options.root / PAGE
    if not options.check:
        page.write_text(text, encoding="utf-8")
    elif not page.is_file() or page.read_text(encoding="utf-8") != text:
        sys.exit(f"{PAGE} is not what {SCHEMA} says; run docs/experiment_reference.py")


if __name__ == "__main__":
    main()
