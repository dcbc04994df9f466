#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""driver_test.py BENCH: bench/terms.py with a stand-in for tunica, which notes how it was called."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import traceback
import unittest

DRIVER = pathlib.Path(sys.argv.pop()) / "terms.py"
sys.path.insert(0, str(DRIVER.parent))
import terms  # noqa: E402

TUNICA = """#!/usr/bin/env python3
import json, pathlib, sys
build = pathlib.Path(__file__).resolve().parent.parent
(build / "calls.txt").open("a").write(" ".join(sys.argv[1:]) + "\\n")
word = lambda name: pathlib.Path(sys.argv[sys.argv.index(name) + 1])
silent = (build / "silent").read_text().split() if (build / "silent").exists() else []
for case in sorted(word("--batch").iterdir()):
    assert (case / "experiment.json").exists()
    if case.name not in silent:
        (word("-o") / case.name).mkdir(parents=True, exist_ok=True)
        (word("-o") / case.name / "result.json").write_text(json.dumps({"discovery": {"verdict": "nothing_detected"}}))
"""
FEW = ("--reduced", "--what", "null", "--bases", "neo_hooke")


class Driver(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Six cases without a verdict, which most tests go on from: to make them takes longer than all else."""
        cls.prepared = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.prepared.cleanup)
        first = cls()
        first.setUp(prepared=False)
        ended = subprocess.run([sys.executable, "-B", *first.words((*FEW, "--only-generate"))], capture_output=True, text=True)
        assert ended.returncode == 0 and first.calls() == [], ended.stderr
        shutil.copytree(first.out, pathlib.Path(cls.prepared.name) / "out")
        first.tearDown()

    def setUp(self, prepared=True):
        self.place = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.place.name)
        self.build, self.out = self.folder / "build", self.folder / "out"
        (self.build / "bin").mkdir(parents=True)
        self.write(TUNICA)
        if prepared:
            shutil.copytree(pathlib.Path(self.prepared.name) / "out", self.out)

    def tearDown(self):
        self.place.cleanup()

    def write(self, text):
        program = self.build / "bin/tunica"
        program.write_text(text.replace("/usr/bin/env python3", f"{sys.executable} -SE"))  # starts at once
        program.chmod(0o755)

    def words(self, words):
        return [str(DRIVER), str(self.out), "--build", str(self.build), "--jobs", "1", *words]

    def run_driver(self, *words):
        """As a process of its own, but forked from this one: scipy takes a second to import."""
        files = [self.folder / "stdout.txt", self.folder / "stderr.txt"]
        sys.stdout.flush(), sys.stderr.flush()
        child = os.fork()
        if child == 0:
            for number, file in enumerate(files, 1):
                os.dup2(os.open(file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
            sys.argv, code = self.words(words), 1
            try:
                code = terms.main() or 0
            except SystemExit as ended:
                code = ended.code if isinstance(ended.code, int) else 1
                print(ended.code if isinstance(ended.code, str) else "", file=sys.stderr)
            except BaseException:
                traceback.print_exc()
            finally:
                sys.stdout.flush(), sys.stderr.flush()
                os._exit(code)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return subprocess.CompletedProcess(words, code, *(file.read_text() for file in files))

    def calls(self):
        file = self.build / "calls.txt"
        return file.read_text().splitlines() if file.exists() else []

    def names(self):
        return sorted(case.name for case in (self.out / "cases").iterdir())

    def test_generates_discovers_and_scores(self):
        ended = self.run_driver(*FEW)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual(len(self.names()), 6)
        self.assertEqual(len(self.calls()), 1)
        for word in ("discover", "--batch", "--quiet", "--quick", "-j 1", f"-o {self.out}/results"):
            self.assertIn(word, self.calls()[0])
        self.assertIn("reduced seed 7, 6 cases", ended.stdout)
        self.assertIn("| something discovered under nothing | 0.000", ended.stdout)
        self.assertEqual(ended.stdout, (self.out / "table.md").read_text())
        self.assertFalse(any("truth" in file.name and file.suffix == ".json" for file in (self.out / "cases").rglob("*")))

    def test_a_figure_that_is_missed_by_more_than_chance_ends_with_1(self):
        self.write(TUNICA.replace('"nothing_detected"', '"discovered"'))
        self.assertEqual(self.run_driver(*FEW).returncode, 1)

    def test_what_has_a_verdict_is_not_asked_again(self):
        self.run_driver(*FEW)
        (self.out / "results" / self.names()[0] / "result.json").unlink()
        self.run_driver(*FEW)
        self.assertEqual(len(self.calls()), 2)
        self.run_driver(*FEW)
        self.assertEqual(len(self.calls()), 2)

    def test_a_case_without_answer_is_one(self):
        (self.build / "silent").write_text(self.names()[0])
        ended = self.run_driver(*FEW)
        self.assertIn(f"no answer for {self.names()[0]}", ended.stderr)
        self.assertIn("| no answer | 0.167", ended.stdout)
        (self.build / "silent").write_text(" ".join(self.names()))
        (self.out / "results").rename(self.folder / "elsewhere")
        self.assertIn("no case got an answer", self.run_driver(*FEW).stderr)

    def test_verdicts_of_another_build_are_made_anew(self):
        self.run_driver(*FEW)
        self.write(TUNICA + "# another build\n")
        self.run_driver(*FEW)
        self.assertEqual(len(self.calls()), 2)

    def test_the_scored_seed_runs_once(self):
        shutil.rmtree(self.out)
        words = ("--scored", "--what", "null", "--bases", "neo_hooke", "--share", "0.02")
        self.assertEqual(self.run_driver(*words).returncode, 0)
        self.assertEqual(self.run_driver(*words).returncode, 0, "taken up by the same build")
        self.write(TUNICA + "# another build\n")
        ended = self.run_driver(*words)
        self.assertIn("verdicts of another build of the scored seed, which runs once", ended.stderr)
        self.assertEqual(len(self.calls()), 1)

    def test_a_folder_is_of_one_seed_and_one_study(self):
        self.run_driver(*FEW)
        self.assertIn("holds another run, of seed 7", self.run_driver(*FEW, "--seed", "8").stderr)
        self.assertIn("study terms; choose another folder", self.run_driver("--reduced", "--laws").stderr)
        self.assertIn("exclude each other", self.run_driver("--reduced", "--scored").stderr)
        self.assertIn("expected a number above 0", self.run_driver("--share", "20").stderr)

    def test_a_truth_that_was_changed_ends_it(self):
        self.run_driver(*FEW)
        truth = next((self.out / "truths").iterdir())
        truth.write_text(truth.read_text().replace('"null"', '"rig"'))
        ended = self.run_driver(*FEW)
        self.assertIn("does not fit the seal", ended.stderr)
        self.assertEqual(ended.returncode, 1)

    def test_complete_laws(self):
        shutil.rmtree(self.out)
        ended = self.run_driver("--reduced", "--laws")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual(len(self.names()), 18)
        self.assertIn("| Holzapfel | 3% | 1 | 0.00 (0.00–0.79) |", ended.stdout)

    def test_the_table_goes_between_its_marks(self):
        document = self.folder / "page.md"
        document.write_text("no marks\n")
        self.assertIn("has no lines '<!-- blind benchmark of terms: begin -->'",
                      self.run_driver(*FEW, "--docs", str(document)).stderr)
        begin, end = "<!-- blind benchmark of terms: begin -->", "<!-- blind benchmark of terms: end -->"
        document.write_text(f"before\n{begin}\nold\n{end}\nafter\n")
        self.run_driver(*FEW, "--docs", str(document))
        table = (self.out / "table.md").read_text()
        self.assertEqual(document.read_text(), f"before\n{begin}\n{table}{end}\nafter\n")

    def test_the_full_plan_has_the_numbers_that_its_intervals_need(self):
        ask = ("import sys; sys.path.insert(0, sys.argv[1]); import json, runpy; "
               "names = runpy.run_path(sys.argv[1] + '/terms.py', run_name='plan'); "
               "print(json.dumps([list(spec) for spec in names['plan'](False, 1, list(names['FULL']), names['BASES'])]))")
        ended = subprocess.run([sys.executable, "-B", "-c", ask, str(DRIVER.parent)], capture_output=True, text=True)
        specs = json.loads(ended.stdout)
        count = {}
        for what, _, target, _, noise, stated in specs:
            count[what, target] = count.get((what, target), 0) + 1
        self.assertGreaterEqual(count["null", 0], 200)
        self.assertTrue(all(count["single", target] >= 60 for target in (25, 60, 150, 400)))
        self.assertGreaterEqual(sum(n for (what, _), n in count.items() if what == "rig"), 100)
        self.assertEqual(len({tuple(spec[:4]) for spec in specs}), len(specs))
        for noise in ("white", "relative"):
            for stated in (True, False):
                self.assertTrue(any(spec[4] == noise and spec[5] == stated for spec in specs))


unittest.main()
