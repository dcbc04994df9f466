#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""performance_test.py SOURCE BUILD: what the benchmark writes, and what a comparison of two builds says. No clock decides:
stub programs print made-up times, and of real ones only the shape is looked at."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

BUILD, SOURCE = pathlib.Path(sys.argv.pop()), pathlib.Path(sys.argv.pop())
sys.path.insert(0, str(SOURCE / "bench"))
sys.path.insert(0, str(SOURCE / "bench/performance"))
import compare_builds  # noqa: E402
import programs  # noqa: E402
import table  # noqa: E402

KEYS = {"name": str, "what": str, "unit": str, "size": str, "clock": str, "time_s": float, "spread": float, "repeats": int,
        "floors": list, "peers": list, "facts": dict, "samples_s": list}
# A build whose rows take 2 ms and 3 ms, each process with noise of its own of 1 % (deterministic), the second row `factor` times.
STUB = """#!/usr/bin/env python3
import json, pathlib
count = pathlib.Path(__file__).with_name("count")
k = int(count.read_text()) if count.exists() else 0
count.write_text(str(k + 1))
noise = 1 + 0.01 * ((k * 7 + SHIFT) % 5 - 2)
for name, seconds in (("a/steady", 2e-3), ("b/changed", 3e-3 * FACTOR)):
    print(json.dumps({"name": name, "time_s": seconds * noise}))
"""


def bench(*arguments):
    return subprocess.run([sys.executable, "-B", SOURCE / "bench/bench.py", "--build", BUILD, *arguments], capture_output=True, text=True)


class Rows(unittest.TestCase):
    def check_row(self, row):
        for key, kind in KEYS.items():
            self.assertIsInstance(row[key], kind, key)
        self.assertGreater(row["time_s"], 0)
        self.assertEqual(len(row["samples_s"]), row["repeats"])
        for one in row["floors"] + row["peers"]:
            self.assertGreater(one["time_s"], 0)
            self.assertGreater(one["ratio"], 0)
            self.assertTrue(one["what"])

    def test_every_kind_of_row_in_the_process_is_measured_beside_its_floor(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "rows.json"
            only = r"^(point/gho/|strip/(gho|composed)/|sheet/|tube/|fe/four_node/10x40/values|optimizer/es|constraint/|journal/)"
            done = bench("--quick", "--no-peers", "--only", only, "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            document = json.loads(out.read_text())
            self.assertEqual(document["format"], 1)
            self.assertEqual(set(document["machine"]), {"processor", "cores", "compiler", "system"})
            rows = {row["name"]: row for row in document["rows"]}
            for row in rows.values():
                self.check_row(row)
            for name in ("point/gho/parameters", "strip/gho/objective", "strip/gho/jacobian", "sheet/gho/jacobian", "tube/gho/objective",
                         "fe/four_node/10x40/values", "optimizer/es", "journal/row", "constraint/transverse_stability/values"):
                self.assertIn(name, rows)
                self.assertTrue(rows[name]["floors"] or name.startswith("constraint"), name)
            # A floor is one only where it answers the same.
            for name in ("point/gho/parameters", "strip/gho/objective", "strip/gho/jacobian", "sheet/gho/jacobian", "tube/gho/objective"):
                self.assertLess(rows[name]["facts"]["floor_differs"], 1e-6, name)
            self.assertLess(rows["fe/four_node/10x40/values"]["facts"]["off_reference"], 2e-4)

            # More rows join those of the file; the page shows them all.
            page = pathlib.Path(folder) / "page.md"
            page.write_text(f"before\n{table.BEGIN}\nold\n{table.END}\nafter\n")
            done = bench("--quick", "--only", "^point/neo_hooke/energy$", "--out", out, "--page", page)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(json.loads(out.read_text())["rows"]), len(rows) + 1)
            text = page.read_text()
            self.assertTrue(text.startswith("before\n") and text.endswith("after\n") and "\nold\n" not in text)
            for name in [*rows, "point/neo_hooke/energy"]:
                self.assertIn(f"`{name}`", text)

    def test_a_program_is_measured_beside_its_floor(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "rows.json"
            done = bench("--quick", "--only", "^startup/version", "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            row = json.loads(out.read_text())["rows"][0]
            self.check_row(row)
            self.assertEqual(len(row["floors"]), 1)

    def test_the_list_has_every_row_that_is_asked_of_the_benchmark(self):
        names = bench("--list").stdout.split()
        self.assertEqual(len(names), len(set(names)))
        models = {path.name for path in (SOURCE / "plugins/models").iterdir() if path.is_dir()}
        for model in models:
            for call in ("energy", "gradient", "hessian", "parameters"):
                self.assertIn(f"point/{model}/{call}", names)
        for mesh in ("four_node/10x40", "four_node/25x50", "four_node/100x400", "nine_node/8x20", "nine_node/50x200"):
            for kind in ("values", "one_channel", "three_channels"):
                self.assertIn(f"fe/{mesh}/{kind}", names)
        for name in ("search/es/two_threads", "startup/all_plugins", "study/known_solution_x100", "study/inverse_fe/lm", "study/inverse_fe/es",
                     "study/lamb_aorta/profiles", "study/lamb_aorta/bootstrap_200", "diagnosis/quick", "diagnosis/full"):
            self.assertIn(name, names)

    def test_a_program_that_fails_ends_the_benchmark(self):
        with tempfile.TemporaryDirectory() as folder:
            stub = pathlib.Path(folder) / "bin/bench_performance"
            stub.parent.mkdir()
            stub.write_text("#!/bin/sh\nexit 3\n")
            stub.chmod(0o755)
            done = subprocess.run([sys.executable, "-B", SOURCE / "bench/bench.py", "--build", folder, "--only", "^strip"],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("ended with 3", done.stderr)

    def test_comments_leave_strings_alone(self):
        text = '{"a": "http://x", // comment "quoted"\n "b": 1}'
        self.assertEqual(json.loads(programs.without_comments(text)), {"a": "http://x", "b": 1})


class Comparison(unittest.TestCase):
    def compare(self, factor, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            for name, value, shift in (("old", 1, 0), ("new", factor, 3)):
                stub = pathlib.Path(folder) / name / "bin/bench_performance"
                stub.parent.mkdir(parents=True)
                stub.write_text(STUB.replace("FACTOR", str(value)).replace("SHIFT", str(shift)))
                stub.chmod(0o755)
            out = pathlib.Path(folder) / "out.json"
            done = subprocess.run([sys.executable, "-B", SOURCE / "bench/compare_builds.py", f"{folder}/old", f"{folder}/new", "--out", out,
                                   *arguments], capture_output=True, text=True)
            return done.returncode, done.stdout, json.loads(out.read_text()) if out.exists() else None

    def test_a_planted_slow_down_is_flagged_and_alone(self):
        code, text, found = self.compare(1.2)
        self.assertEqual(code, 1, text)
        self.assertEqual({row["name"]: row["verdict"] for row in found["rows"]}, {"a/steady": "same", "b/changed": "slower"})
        self.assertIn("slower by more than 2 %: b/changed", text)
        changed = found["rows"][1]
        self.assertTrue(changed["low"] < 1.2 < changed["high"])

    def test_the_same_and_the_faster_pass(self):
        code, text, _ = self.compare(1)
        self.assertEqual(code, 0, text)
        self.assertIn("none", text)
        code, _, found = self.compare(0.8)
        self.assertEqual((code, found["rows"][1]["verdict"]), (0, "faster"))

    def test_a_change_within_the_noise_is_not_called_one(self):
        code, _, found = self.compare(1.01)
        self.assertEqual((code, found["rows"][1]["verdict"]), (0, "same"))

    def test_a_build_without_the_program_is_named(self):
        done = subprocess.run([sys.executable, "-B", SOURCE / "bench/compare_builds.py", "/nowhere", "/nowhere"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("Build the target bench_performance", done.stderr)

    def test_quantiles_are_those_of_the_tables(self):
        for tail, freedom, expected in ((0.025, 2, 4.302653), (0.005, 8, 3.355387), (0.0005, 30, 3.645959)):
            self.assertTrue(math.isclose(compare_builds.student_quantile(tail, freedom), expected, rel_tol=1e-6))


if __name__ == "__main__":
    unittest.main()
