#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compare_results_test.py SCRIPT: what bench/compare_results.py calls the same, and what it does not."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = sys.argv.pop()
RESULT = {"runs": [{"run": "gho/lm", "best": {"objective": 66.1, "stable": None}, "seconds": 0.5, "ended_by": "stall"}],
          "warnings": ["theta lies at its upper bound"], "provenance": {"date": "2026-01-01", "seed": 7}}


class CompareResults(unittest.TestCase):
    def compare(self, change, *options):
        """Exit code and output for a result and a changed copy of it."""
        with tempfile.TemporaryDirectory() as folder:
            new = json.loads(json.dumps(RESULT))
            change(new)
            for name, result in (("old", RESULT), ("new", new)):
                place = pathlib.Path(folder) / name / "example"
                place.mkdir(parents=True)
                (place / "result.json").write_text(json.dumps(result), encoding="utf-8")
            ended = subprocess.run([sys.executable, SCRIPT, f"{folder}/old", f"{folder}/new", *options], capture_output=True, text=True)
            return ended.returncode, ended.stdout

    def test_times_and_the_program_do_not_count(self):
        def change(new):
            new["runs"][0]["seconds"] = 9
            new["provenance"]["date"] = "2027-01-01"
        self.assertEqual(self.compare(change)[0], 0)

    def test_the_last_bit_counts(self):
        code, text = self.compare(lambda new: new["runs"][0]["best"].update(objective=66.10000000000001))
        self.assertEqual(code, 1)
        self.assertIn("example.runs[0].best.objective", text)

    def test_a_tolerance_lets_rounding_pass_and_no_count(self):
        def change(new):
            new["runs"][0]["best"]["objective"] = 66.1 * (1 + 1e-11)
        code, text = self.compare(change, "--within", "1e-10")
        self.assertEqual(code, 0)
        self.assertIn("the largest relative difference that was let pass is 1e-11", text)
        self.assertEqual(self.compare(change, "--within", "1e-12")[0], 1)
        self.assertEqual(self.compare(lambda new: new["provenance"].update(seed=8), "--within", "1")[0], 1)

    def test_null_is_no_number(self):
        self.assertEqual(self.compare(lambda new: new["runs"][0]["best"].update(stable=0))[0], 1)

    def test_a_missing_key_counts_and_a_new_one_is_told(self):
        self.assertEqual(self.compare(lambda new: new["runs"][0]["best"].pop("stable"))[0], 1)
        code, text = self.compare(lambda new: new.update(extra=1))
        self.assertEqual((code, "new keys: 1" in text), (0, True))

    def test_words_may_change_and_are_told(self):
        def change(new):
            new["warnings"][0] = "theta is at its upper bound"
            new["runs"][0]["ended_by"] = "max_evaluations"
        code, text = self.compare(change)
        self.assertEqual(code, 0)
        self.assertIn("changed sentences: 1", text)
        self.assertIn("changed codes: 1", text)

    def test_a_missing_result_counts(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder) / "old"
            place.mkdir()
            (place / "result.json").write_text(json.dumps(RESULT), encoding="utf-8")
            (pathlib.Path(folder) / "new").mkdir()
            run = [sys.executable, SCRIPT, f"{folder}/old", f"{folder}/new"]
            self.assertEqual(subprocess.run(run, capture_output=True).returncode, 1)
            self.assertEqual(subprocess.run([*run[:2], f"{folder}/new", f"{folder}/old"], capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main()
