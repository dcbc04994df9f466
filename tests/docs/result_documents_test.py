#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""result_documents_test.py TUNICA SOURCE: an independent validator holds what the verbs write to the closed schemas.

Recorded documents of tests/references have lost their counts, so there no key is required. Ends with 77 where the
module jsonschema (Debian: python3-jsonschema) is missing."""
import copy
import functools
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
try:
    import jsonschema
except ImportError:
    print("skipped: the Python module jsonschema is missing (Debian: python3-jsonschema)")
    sys.exit(77)
PROGRAM, SOURCE = (pathlib.Path(one).resolve() for one in sys.argv[1:3])
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE / "docs"))
sys.path.insert(0, str(SOURCE / "tests/experiment"))
from check_schemas import read  # JSON with comments
from results_reference import ANSWERS, COHORT, RESULT, Schemas

SCHEMAS = Schemas(SOURCE / "schemas")
PLUGIN = PROGRAM.parent.parent / "lib/tunica/plugins/yeoh.so"


def without_required(part):
    if isinstance(part, dict):
        return {key: without_required(value) for key, value in part.items()
                if key != "required" and not (key == "oneOf" and any("required" in one for one in value))}
    return [without_required(one) for one in part] if isinstance(part, list) else part


@functools.lru_cache(maxsize=None)
def validator_of(file, name, every_key):
    schema = SCHEMAS.bundle(file, name)
    return jsonschema.Draft7Validator(schema if every_key else without_required(schema))


def faults(document, file, name, every_key=True):
    validator = validator_of(file, name, every_key)
    return [f"/{'/'.join(map(str, fault.absolute_path))}: {fault.message[-200:]}" for fault in validator.iter_errors(document)]


class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name) / "examples"
        shutil.copytree(SOURCE / "examples", cls.folder, ignore=shutil.ignore_patterns("*.html", "*.svg", "*.png"))
        shutil.copytree(SOURCE / "tests/references/experiments", cls.folder / "own")
        plate = cls.folder / "plate/experiment.json"  # a check simulates the field once a derivative
        fine = plate.read_text(encoding="utf-8")
        plate.write_text(fine.replace('"size": "0.8 mm"', '"size": "2.5 mm"'), encoding="utf-8")
        assert plate.read_text(encoding="utf-8") != fine, f"{plate} has another mesh"

    def tunica(self, *words, codes=(0,)):
        ended = subprocess.run([PROGRAM, *words], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                               check=False)
        self.assertIn(ended.returncode, codes, f"{words}: {ended.stderr}")
        return ended.stdout

    def conforms(self, document, file, name, **how):
        self.assertEqual([], faults(document, file, name, **how)[:5])

    def result_of(self, *words, file=RESULT, codes=(0,)):
        out = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "out"
        self.tunica(*words, "-o", str(out), "--quiet", codes=codes)
        document = json.loads((out / "result.json").read_text(encoding="utf-8"))
        self.conforms(document, file, "result")
        return document, out

    def answer(self, name, *words, codes=(0,)):
        document = json.loads(self.tunica(*words, codes=codes))
        self.conforms(document, ANSWERS, name)
        return document

    def test_schemas_are_valid(self):
        for schema in SCHEMAS.files.values():
            jsonschema.Draft7Validator.check_schema(schema)

    def test_recorded_results(self):
        found = 0
        for file in sorted((SOURCE / "tests/references").glob("*_*.json")):
            for name, document in json.loads(file.read_text(encoding="utf-8")).items():
                if name.endswith("result.json"):
                    found += 1
                    with self.subTest(f"{file.name}: {name}"):
                        self.conforms(document, RESULT, "result", every_key=False)
        self.assertGreater(found, 20)

    def test_a_run_and_what_reads_it(self):
        document, out = self.result_of("run", "human_brain_cortex/experiment_held_out.json", "--profiles", "all",
                                       "--bootstrap", "40", codes=(0, 1))
        self.assertTrue(any("bootstrap" in run["best"] for run in document["runs"]))
        self.answer("certificates", "certify", str(out))

    def test_an_unknown_key_a_missing_key_or_an_unknown_code_is_refused(self):
        document, _ = self.result_of("run", "treloar/experiment.json", "--no-certificate")
        for change in (lambda best: best.update(aicx=1), lambda best: best.pop("aicc"), lambda best: best.update(status="fine")):
            damaged = copy.deepcopy(document)
            change(damaged["runs"][0]["best"])
            self.assertEqual(1, len([one for one in faults(damaged, RESULT, "result") if one.startswith("/runs/0/best")]))

    def test_runs_that_end_otherwise(self):
        experiment = read(self.folder / "treloar/experiment.json")
        experiment["stop"] = {"max_evaluations": 2}
        limited = self.folder / "treloar/limited.json"
        limited.write_text(json.dumps(experiment), encoding="utf-8")
        document, _ = self.result_of("run", str(limited), codes=(0, 1))
        self.assertTrue(any(run["limit"] for run in document["runs"]))

    def test_diagnoses(self):
        for words in (["treloar_cause/experiment.json", "--quick"], ["own/wrong_row/experiment.json"],
                      ["own/replicates/experiment.json"], ["lamb_aorta_cause/experiment.json", "--quick"]):
            with self.subTest(words[0]):
                self.result_of("diagnose", *words)

    def test_discoveries(self):
        for words in (["james_1975/experiment.json", "--quick"], ["own/rubbers/cohort.json", "--quick"],
                      ["own/rubbers/cohort.json", "--quick", "--from-nothing"]):
            with self.subTest(words):
                self.result_of("discover", *words)

    def test_cohorts(self):
        _, out = self.result_of("cohort", "own/rubbers/cohort.json", "--diagnose", file=COHORT)
        self.answer("cohort_status", "cohort", "status", "own/rubbers/cohort.json", "-o", str(out), "--json")
        table = self.folder / "dermis_cohort/specimens.csv"
        lines = table.read_text(encoding="utf-8").splitlines(keepends=True)
        table.write_text("".join(lines[:7]), encoding="utf-8")
        document, _ = self.result_of("cohort", "dermis_cohort/cohort.json", file=COHORT)
        self.assertTrue(document["cohort"]["populations"][0]["readings"]["of"])

    def test_checks_of_the_examples(self):
        for file in sorted(self.folder.glob("[!c]*/experiment*.json")):  # those of finite elements take long
            with self.subTest(str(file.relative_to(self.folder))):
                self.answer("check", "check", str(file), "--json", codes=(0, 1))

    def test_what_plugins_declare(self):
        shelves = self.answer("list", "list", "--json")
        self.answer("list", "list", "models", "--json")
        for kind in ("models", "tests", "optimizers", "mechanisms"):
            for one in shelves[kind]:
                with self.subTest(one["name"]):
                    described = self.answer("description", "describe", one["name"], "--json")
                    self.assertEqual(one["name"], next(iter(described.values()))["name"])
        self.answer("plugin_check", "plugin", "check", str(PLUGIN), "--json", "--only", "concurrent_calls_agree")

    def test_stability_and_simulation(self):
        self.answer("taken_rows", "data", "treloar/experiment.json", "--json")
        self.answer("stability_answer", "stability", "treloar/experiment.json", "--model", "ogden", "--json")
        self.tunica("simulate", "treloar/experiment.json", "--model", "ogden", "-o", str(self.folder / "simulated"))
        self.conforms(json.loads((self.folder / "simulated/simulation.json").read_text(encoding="utf-8")), ANSWERS, "simulation")


unittest.main()
