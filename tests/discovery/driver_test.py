#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench/discovery.py with programs that only note how they were called: driver_test.py DISCOVERY_PY."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

DRIVER = sys.argv.pop(1)

# Each stand-in appends its arguments to calls.txt beside the build folder. What is called hundreds of times is for the
# shell, which starts in a millisecond.
NOTE = """#!/usr/bin/env python3
import pathlib, sys
here = pathlib.Path(__file__).resolve().parent.parent
(here / "calls.txt").open("a").write(pathlib.Path(__file__).name + " " + " ".join(sys.argv[1:]) + "\\n")
word = lambda name: sys.argv[sys.argv.index(name) + 1]
"""
SHELL = """#!/bin/sh
echo "${0##*/} $*" >>"${0%/*}/../calls.txt"
"""
GENERATOR = SHELL + """
while [ $# -gt 0 ]; do
    case $1 in
        --out) out=$2 ;;
        --set) set_of=$2 ;;
        --cases) cases=${2%:*}-${2#*:} ;;
        --base) IFS=-; base=-$*; break ;;
    esac
    shift
done
mkdir -p "$out/case-$set_of$cases$base"
printf 0 >"$out/case-$set_of$cases$base/truth.sha256"
"""
TUNICA = SHELL + """
case " $* " in
    *" list "*) echo '{"mechanisms": [{"name": "active_tone"}]}' ;;
    *" describe "*) echo '{"mechanism": {"look_alikes": ["force_offset", "residual_stress"]}}' ;;
    *" diagnose "*)
        for cases; do :; done
        for case in "$cases"/*/; do [ -e "$case/result.json" ] || printf '{}' >"$case/result.json"; done ;;
esac
"""
SCORE = NOTE + """
pathlib.Path(word("--markdown")).write_text("| table |\\n")
sys.exit(1)
"""


class Driver(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.place.name)
        self.build, self.out = self.folder / "build", self.folder / "out"
        (self.build / "lib/tunica/plugins").mkdir(parents=True)
        (self.build / "bin").mkdir()
        for name, text in (("discovery_generator", GENERATOR), ("tunica", TUNICA), ("discovery_score", SCORE)):
            self.write(name, text)

    def tearDown(self):
        self.place.cleanup()

    def write(self, name, text):
        file = self.build / "bin" / name
        file.write_text(text.replace("/usr/bin/env python3", f"{sys.executable} -SE"))  # starts at once
        file.chmod(0o755)

    def run_driver(self, *words):
        return subprocess.run([sys.executable, DRIVER, str(self.out), "--build", str(self.build), "--jobs", "1", *words],
                              capture_output=True, text=True)

    def calls(self, program):
        lines = (self.build / "calls.txt").read_text().splitlines()
        return [line for line in lines if line.startswith(program)]

    def test_generates_diagnoses_and_scores_in_this_order(self):
        ended = self.run_driver("--reduced")
        self.assertEqual(ended.returncode, 1, "the code is the scorer's; " + ended.stderr)
        order = [line.split()[0] for line in (self.build / "calls.txt").read_text().splitlines()]
        self.assertEqual(order[-1], "discovery_score")
        self.assertLess(order.index("discovery_generator"), order.index("tunica"))
        self.assertIn("--reduced", self.calls("discovery_score")[0])
        self.assertEqual(json.loads((self.out / "look_alikes.json").read_text()),
                         {"active_tone": ["force_offset", "residual_stress"]})

    def test_the_full_run_has_the_numbers_that_were_promised(self):
        self.run_driver()
        cases = {}
        for line in self.calls("discovery_generator"):
            words = line.split()
            if any(word in words for word in ("--base", "--protocol", "--noise-not-stated", "--order-not-recorded")):
                continue
            first, last = map(int, words[words.index("--cases") + 1].split(":"))
            noise = words[words.index("--noise") + 1]
            what = words[words.index("--set") + 1]
            cases[what, noise] = cases.get((what, noise), 0) + last - first
        self.assertGreaterEqual(cases["nulls", "white"], 600)
        self.assertGreaterEqual(sum(count for (what, _), count in cases.items() if what == "singles"), 16)
        self.assertGreaterEqual(cases["pairs", "white"], 60)
        singles = [line for line in self.calls("discovery_generator") if "--set singles" in line]
        classes = ("--base", "--protocol", "--noise-not-stated", "--order-not-recorded")
        plain = [line for line in singles if not any(word in line for word in classes)]
        self.assertTrue(all("--lambda 10 25 60 150 --oracle" in line for line in plain))
        others = [line for line in singles if line not in plain and "--noise-not-stated" not in line]
        self.assertTrue(all("--oracle" in line and " 25 60 " in line for line in others))
        self.assertNotIn("--selected", self.calls("discovery_score")[0])
        self.assertTrue(all("--oracle" in line for line in self.calls("discovery_generator") if "--set pairs" in line))

    def test_a_share_of_some_classes(self):
        self.run_driver("--classes", "unstated", "yeoh", "--share", "0.5")
        calls = self.calls("discovery_generator")
        silent = [line for line in calls if "--noise-not-stated" in line and "--set singles" in line]
        stated = [line for line in calls if "--set singles" in line and not any(
            word in line for word in ("--base", "--protocol", "--noise-not-stated"))]
        count = lambda lines: sum(int(b) - int(a) for a, b in
                                  (line.split("--cases ")[1].split()[0].split(":") for line in lines))
        self.assertEqual(count(silent), 3)
        self.assertEqual(count(stated), 3, "the same data with the noise stated")
        self.assertTrue(all("--oracle" in line for line in stated))
        nulls = [line for line in calls if "--base yeoh --protocol rubber" in line and "--set nulls" in line]
        self.assertEqual(count(nulls), 150)
        score = self.calls("discovery_score")[0]
        self.assertIn("--selected", score)
        self.assertIn("Classes unstated, yeoh; share 0.5.", score)
        self.assertIn("expected a number above 0", self.run_driver("--share", "20").stderr)

    def test_every_diagnosis_is_timed(self):
        self.run_driver("--classes", "yeoh", "--share", "0.01")
        seconds = json.loads((self.out / "seconds.json").read_text())
        self.assertEqual(set(seconds), {case.name for case in (self.out / "cases").iterdir()})
        self.assertTrue(all(value >= 0 for value in seconds.values()))
        self.assertFalse((self.out / "shards").exists())

    def test_verdicts_of_another_build_are_made_anew(self):
        self.run_driver("--reduced")
        verdict = self.out / "cases/case-pairs0-4/result.json"
        verdict.write_text("old")
        self.run_driver("--reduced")
        self.assertEqual(verdict.read_text(), "old", "the same build goes on from what is there")
        self.write("tunica", TUNICA + "# another build\n")
        self.run_driver("--reduced")
        self.assertEqual(verdict.read_text(), "{}")

    def test_the_scored_seed_runs_once(self):
        self.run_driver("--scored")
        self.assertEqual(self.run_driver("--scored").returncode, 1, "taken up by the same build")
        self.write("tunica", TUNICA + "# another build\n")
        ended = self.run_driver("--scored")
        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("verdicts of another build of the scored seed, which runs once", ended.stderr)

    def test_a_folder_is_of_one_seed(self):
        self.run_driver("--reduced")
        ended = self.run_driver("--reduced", "--seed", "8")
        self.assertIn("holds another run, of seed 7; choose another folder", ended.stderr)
        self.assertIn("exclude each other", self.run_driver("--reduced", "--scored").stderr)

    def test_the_table_goes_between_its_marks(self):
        document = self.folder / "diagnosis.md"
        document.write_text("no marks\n")
        self.assertIn("has no lines '<!-- blind benchmark: begin -->'", self.run_driver("--reduced", "--docs", str(document)).stderr)
        document.write_text("before\n<!-- blind benchmark: begin -->\nold\n<!-- blind benchmark: end -->\nafter\n")
        self.run_driver("--reduced", "--docs", str(document))
        self.assertEqual(document.read_text(), "before\n<!-- blind benchmark: begin -->\n| table |\n"
                                               "<!-- blind benchmark: end -->\nafter\n")

    def test_more_than_three_look_alikes_are_refused(self):
        self.write("tunica", TUNICA.replace('"force_offset",', '"a", "b", "c", "d",'))
        self.assertIn("active_tone declares 5 look-alikes, and at most three count", self.run_driver("--reduced").stderr)


unittest.main()
