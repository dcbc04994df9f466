#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench/discovery_cohorts.py with programs that only pretend: driver_test.py DISCOVERY_COHORTS_PY."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

DRIVER = sys.argv.pop(1)

GENERATOR = """#!/usr/bin/env python3
import hashlib, json, pathlib, sys
word = lambda name: sys.argv[sys.argv.index(name) + 1]
out, what = pathlib.Path(word("--out")), word("--set")
(out / "sealed").mkdir(parents=True, exist_ok=True)
for k in range(int(word("--first")), int(word("--first")) + int(word("--count"))):
    effects = [{"id": "tone", "target": {"test": None, "channel": None}}] if what != "nulls" else []
    if what == "pairs": effects.append({"id": "drift", "target": {"test": "tube", "channel": "force"}})
    text = json.dumps({"set": what, "effect": "tone" if effects else "", "reached": True, "affected_group":
                       "b" if what == "groups" else "", "specimens": [{"effects": []}, {"effects": effects}]})
    cohort = out / f"cohort-{what}-{k}"
    if cohort.exists(): continue
    cohort.mkdir()
    (cohort / "truth.sha256").write_text(hashlib.sha256(text.encode()).hexdigest())
    (out / "sealed" / (cohort.name + ".json")).write_text(text)
"""
BENCH = """#!/usr/bin/env python3
import json, pathlib, sys
for cohort in map(pathlib.Path, sys.argv[2:]):
    what = cohort.name.split("-")[1]
    names = {"nulls": [], "pairs": ["drift", "tone"]}.get(what, ["NAME"])
    (cohort / "verdict.json").write_text(json.dumps({
        "verdict": "named" if names else "nothing_detected", "alarm": bool(names), "ambiguity_set": names, "p_values": [0.5],
        "explanations": [{"mechanisms": names, "places": [{"tests": [], "words": "in the material"}]}] if names else [],
        "factors": [{"only_in": "b" if what == "groups" else None}], "contradictions": [], "matrix": [], "likeness": [],
        "sums_of_own_weights": {"tone": 1}, "own": [{"causes": ["tone"], "verdict": "named"}]}))
"""
TUNICA = """#!/usr/bin/env python3
import sys
print('{"mechanisms": [{"name": "tone"}]}' if "list" in sys.argv else '{"mechanism": {"look_alikes": ["other"]}}')
"""


class Driver(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        folder = pathlib.Path(self.place.name)
        self.build, self.out = folder / "build", folder / "out"
        (self.build / "bin").mkdir(parents=True)
        self.write("discovery_cohorts", GENERATOR)
        self.write("tunica", TUNICA)

    def tearDown(self):
        self.place.cleanup()

    def write(self, name, text):
        file = self.build / "bin" / name
        file.write_text(text.replace("/usr/bin/env python3", f"{sys.executable} -SE"))  # starts at once
        file.chmod(0o755)

    def run_driver(self, named, *words):
        self.write("bench_cohort_diagnosis", BENCH.replace("NAME", named))
        return subprocess.run([sys.executable, DRIVER, str(self.out), "--build", str(self.build), "--jobs", "1", *words],
                              capture_output=True, text=True)

    def test_what_is_right_passes(self):
        ended = self.run_driver("tone", "--reduced")
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("| right name, effect in all specimens | 1.000", ended.stdout)
        self.assertIn("| right pair | 1.000", ended.stdout)

    def test_wrong_names_fail(self):
        ended = self.run_driver("other", "--reduced")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("| right name, effect in all specimens | 0.000", ended.stdout)
        self.assertIn("tone → other", ended.stdout)

    def test_a_truth_that_was_changed_is_refused(self):
        self.run_driver("tone", "--reduced")
        sealed = next((self.out / "cohorts/sealed").glob("*.json"))
        sealed.write_text(sealed.read_text().replace("tone", "other").replace("nulls", "pairs"))
        self.assertIn("is not the one that was sealed", self.run_driver("tone", "--reduced").stderr)

    def test_the_scored_seed_runs_once(self):
        self.run_driver("tone", "--scored", "--share", "0.01")
        self.assertIn("which runs once", self.run_driver("other", "--scored", "--share", "0.01").stderr)

    def test_a_folder_is_of_one_seed(self):
        self.run_driver("tone", "--reduced")
        self.assertIn("holds another run, of seed 1807", self.run_driver("tone", "--reduced", "--seed", "8").stderr)


unittest.main()
