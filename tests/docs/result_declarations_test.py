#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""result_declarations_test.py SOURCE: documents are declared once, in schemas/. The page and the types are generated from
there, every field is described, and the sources write these keys and codes and no others."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE / "docs"))
from results_reference import ANSWERS, COHORT, KEYS, PAGE, PREFIX, RESULT, TYPES, Schemas, Writer, unit_of

WRITERS = {
    RESULT: ["core/src/comparison/result_json.cpp", "core/src/comparison/provenance.cpp", "core/src/comparison/stability_report.cpp",
             "core/src/diagnosis/output/diagnosis_json.cpp", "core/src/budget/output/budget_json.cpp",
             "core/src/discovery/output/discovery_json.cpp", "core/src/discovery/output/parts.cpp",
             "core/src/cohort/discovery_json.cpp", "core/src/budget/diagnosed.cpp"],
    COHORT: ["core/src/cohort/study_json.cpp", "core/src/cohort/diagnosis_json.cpp",
             "core/src/cohort_diagnosis/verdict_json.cpp"],
    ANSWERS: ["core/src/calibration/examination_json.cpp", "core/src/plugins/description.cpp", "apps/tunica/describe.cpp",
              "apps/tunica/list.cpp", "core/src/comparison/stability_answer.cpp", "apps/tunica/plugin_check.cpp",
              "core/src/comparison/certify.cpp", "core/src/cluster/overview.cpp",
              "core/src/comparison/simulation_record.cpp", "core/src/comparison/stability_report.cpp",
              "core/src/comparison/taken_rows.cpp"],
}
# Names that provenance lists, which are data and no keys.
LIBRARIES = {"boost", "eigen", "fmt", "nlohmann_json", "onetbb", "spdlog"}
# Codes that no document has: words of the statistics, of cohort files, of material cards.
NOT_IN_RESULTS = {"adjustment_codes", "likelihood_codes", "shape_codes", "shape_reason_codes", "spread_codes",
                  "noise_pool_codes", "target_codes", "finding_codes"}


def text_of(path, root=SOURCE):
    return (root / path).read_text(encoding="utf-8")


def source_of(path, root=SOURCE):
    """A source with the text of each key in place of its constant."""
    texts = dict(re.findall(r'Key (\w+)\{"([^"]+)"\}', text_of(KEYS)))
    return re.sub(r"\bkey::(\w+)", lambda found: f'"{texts[found[1]]}"', text_of(path, root))


def parts_of(part):
    """A schema and all schemas in it."""
    yield part
    for value in part.values() if isinstance(part, dict) else part:
        if isinstance(value, (dict, list)):
            yield from parts_of(value)


def written_by(source, root=SOURCE):
    """The source of a code list: a function, a table or a statement, which begins with the words `from`; or what a
    pattern finds."""
    text = source_of(source["file"], root)
    if "pattern" in source:
        return "".join(re.findall(source["pattern"], text))
    start = text.index(source["from"]) + len(source["from"])
    function = text[start:text.index("\n", start)].endswith(") {")
    end = r"\}" if source["from"].startswith("{") else r"\n\}" if function else r";( \})?\n"
    return text[start:re.compile(end).search(text, start).end()]


def codes_in(source):
    """The texts of it; enumerators where it has no texts."""
    written = written_by(source)
    found = set(re.findall(r'"([^"\\]+)"', written)) or set(re.findall(r"::(\w+)(?=[\s,;}])", written))
    if source.get("words"):
        found = {word for text in found for word in text.split()}
    return found - set(source.get("except", []))


def sources_of(part):
    return part["x-source"] if isinstance(part["x-source"], list) else [part["x-source"]]


def keys_in(path):
    text = source_of(path)
    chosen = re.findall(r'\[[^\]"]*"(\w+)"(?: : "(\w+)")?\]', text)  # ["key"], and [one ? "key" : "other"]
    return set(re.findall(r'(?:\{|print_\w+\()"(\w+)",', text)) | {key for keys in chosen for key in keys if key}


class Generated(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        shutil.copytree(SOURCE / "schemas", self.root / "schemas")
        for file in (PAGE, TYPES, KEYS):
            (self.root / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / file, self.root / file)

    def generator(self, *words):
        return subprocess.run([sys.executable, "-B", SOURCE / "docs/results_reference.py", "--root", self.root, *words],
                              capture_output=True, text=True, check=False)

    def test_page_and_types_are_what_the_schemas_say(self):
        ended = self.generator("--check")
        self.assertEqual(0, ended.returncode, ended.stderr)

    def test_page_and_types_follow_a_declaration(self):
        schema = json.loads(text_of(f"schemas/{RESULT}"))
        schema["definitions"]["channel_fit"]["properties"]["largest_error"] = {
            "description": "The largest of all rows.", "type": "number", "x-unit": "unit"}
        schema["definitions"]["noise_origin"]["oneOf"].append({"const": "guessed", "description": "By eye."})
        (self.root / "schemas" / RESULT).write_text(json.dumps(schema), encoding="utf-8")
        stale = self.generator("--check")
        self.assertEqual(1, stale.returncode)
        self.assertIn("largest_error", stale.stderr)
        self.assertEqual(0, self.generator().returncode)
        self.assertIn("| `largest_error` *optional* | number | unit | The largest of all rows |", text_of(PAGE, self.root))
        self.assertIn("| `guessed` | By eye |", text_of(PAGE, self.root))
        self.assertIn("    largest_error: NotRequired[float]", text_of(TYPES, self.root))
        self.assertIn('inline constexpr Key largest_error{"largest_error"};', text_of(KEYS, self.root))
        self.assertRegex(text_of(TYPES, self.root), r'NoiseOrigin = Literal\[[^]]*"guessed"\]')


class Declared(unittest.TestCase):
    schemas = Schemas(SOURCE / "schemas")

    def setUp(self):
        self.writer = Writer(self.schemas)
        for _, file, name in self.schemas.documents():
            self.writer.meet(file, name, self.schemas.at(file, name))

    def test_every_document_is_closed(self):
        for file, schema in self.schemas.files.items():
            for part in parts_of(schema):
                if isinstance(part, dict) and isinstance(part.get("type"), (str, list)) and "object" in part["type"]:
                    closed = part.get("additionalProperties")
                    self.assertTrue(closed is False if "properties" in part else isinstance(closed, dict), f"{file}: {part}")

    def test_every_field_has_a_meaning_and_its_numbers_a_unit(self):
        for called, (file, name, part) in self.writer.objects.items():
            for key, field in part["properties"].items():
                place = f"{called}.{key}"
                self.assertRegex(field.get("description", ""), r"\.$", place)
                inner = json.dumps(self.reached(file, field))
                self.assertTrue('"number"' not in inner or unit_of(self.schemas, file, field), f"{place}: state its x-unit")

    def reached(self, file, part):
        """A field as far as the next object or code list."""
        while "$ref" in part or "items" in part or isinstance(part.get("additionalProperties"), dict) or "anyOf" in part:
            if "$ref" in part:
                file, name = self.schemas.target(part["$ref"], file)
                part = self.schemas.at(file, name)
            else:
                part = part.get("items") or part.get("additionalProperties") or part["anyOf"][0]
        return {} if "properties" in part or "oneOf" in part else part

    def test_every_list_of_texts_is_one_of_codes(self):
        for file, schema in self.schemas.files.items():
            for part in parts_of(schema):
                self.assertFalse(isinstance(part, dict) and "enum" in part, f"{file}: give each code a meaning: {part}")
        for called, (_, _, part) in self.writer.lists.items():
            for one in part["oneOf"]:
                self.assertRegex(one["description"], r"\.$", f"{called}: {one['const']}")

    def test_no_definition_is_left_over(self):
        used = {(file, name) for file, name, _ in [*self.writer.objects.values(), *self.writer.lists.values()]}
        for file, schema in self.schemas.files.items():
            referred = "".join(json.dumps(one) for one in self.schemas.files.values())
            for name in schema["definitions"]:
                self.assertTrue((file, name) in used or f"#/definitions/{name}\"" in referred, f"{file}: {name}")


class Written(unittest.TestCase):
    schemas = Schemas(SOURCE / "schemas")

    def lists(self):
        for file, schema in self.schemas.files.items():
            for name, part in schema["definitions"].items():
                if "oneOf" in part and "const" in part["oneOf"][0]:
                    yield file, name, part

    def test_codes_are_those_of_the_sources(self):
        for file, name, part in self.lists():
            with self.subTest(f"{file}: {name}"):
                self.assertEqual(set().union(*map(codes_in, sources_of(part))), {one["const"] for one in part["oneOf"]})

    def test_codes_of_the_sources_are_declared(self):
        named = {(one["file"], one.get("from")) for _, _, part in self.lists() for one in sources_of(part)}
        for file in sorted((SOURCE / "core/src").rglob("*.[ch]pp")):
            text, path = file.read_text(encoding="utf-8"), str(file.relative_to(SOURCE))
            for found in re.finditer(r"^inline constexpr text::Codes<[^>]*> (\w+(?<!_names))\b|^const char\* (code_of\([\w:]+)[^)]*\) \{", text,
                                     re.MULTILINE):
                begin = found[1] or found[2]
                if begin not in NOT_IN_RESULTS:
                    self.assertTrue((path, begin) in named, f"{path}: declare the codes of '{begin}' in schemas/, with x-source")

    def test_keys_are_those_of_the_sources(self):
        for file, writers in WRITERS.items():
            own = set().union(*(part["properties"] for part in parts_of(self.schemas.files[file])
                                if isinstance(part, dict) and "properties" in part and "type" in part))
            written = set().union(*map(keys_in, writers))
            anywhere = own.union(*(part["properties"] for other in PREFIX for part in parts_of(self.schemas.files[other])
                                   if isinstance(part, dict) and "properties" in part))
            self.assertEqual(set(), own - written, f"{file} declares what no source writes")
            self.assertEqual(set(), written - anywhere - LIBRARIES, f"{', '.join(writers)} write what no schema declares")


unittest.main()
