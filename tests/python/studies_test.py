# SPDX-License-Identifier: Apache-2.0
"""Cohort, stability, report and export: what the program writes and prints, from Python."""
import json
import os
import signal

import tunica
from support import EXAMPLES, TRELOAR, Case, of_treloar, program, result_of, rows_of

STIFFER = (1.0, 1.1, 1.3)  # three specimens: Treloar's rubber, and two that are stiffer


class Studies(Case):
    def cohort(self):
        """The file of a cohort of three specimens."""
        experiment = of_treloar({"type": "neo_hooke"})
        experiment["tests"] = {"uniaxial": experiment["tests"]["uniaxial"]}
        lines = [line for line in (TRELOAR / "uniaxial.csv").read_text().splitlines() if not line.startswith("#")]
        rows = [tuple(map(float, line.split(","))) for line in lines[1:]]
        for name, factor in zip("abc", STIFFER):
            table = [lines[0], *(f"{stretch},{factor * stress:.6g}" for stretch, stress in rows)]
            (self.folder / f"{name}.csv").write_text("\n".join(table) + "\n")
        experiment["tests"]["uniaxial"]["data"].update(file="a.csv", noise={"relative": "2 %"})
        (self.folder / "strip.json").write_text(json.dumps(experiment))
        (self.folder / "specimens.csv").write_text("specimen\na\nb\nc\n")
        (self.folder / "cohort.json").write_text(json.dumps(
            {"format": 1, "name": "rubbers", "experiment": "strip.json", "specimens": "specimens.csv",
             "bind": {"/tests/uniaxial/data/file": "{specimen}.csv"}}))
        return self.folder / "cohort.json"

    def test_a_cohort_is_that_of_the_program(self):
        file = self.cohort()
        program("cohort", file, "-o", self.folder / "program", "-j", 1, "--quiet")
        told = []
        found = tunica.cohort(file, self.folder / "python", threads=2, progress=lambda share, text: told.append(share))
        self.assertEqual(result_of(self.folder / "program"), result_of(found.directory))
        for table in sorted((self.folder / "program").glob("*.csv")):
            self.assertEqual(rows_of(table), rows_of(found.directory / table.name), table.name)
        self.assertTrue(found.report.exists())
        self.assertEqual(["a", "b", "c"], [specimen["id"] for specimen in found.specimens])
        # W = mu/2 (I1 − 3) is linear in mu, and the noise is a share of the stress: stresses that are larger by a factor
        # give a modulus that is. The files have six digits.
        moduli = [found.specimen(name).parameters["mu"] for name in "abc"]
        for modulus, factor in zip(moduli, STIFFER):
            self.assertAlmostEqual(modulus / moduli[0], factor, delta=1e-4)
        self.assertEqual(3, found.populations[0]["specimens"])
        self.assertIn(1, told)

    def test_a_cohort_that_is_there_is_only_opened_again(self):
        found = tunica.cohort(self.cohort(), self.folder / "out", reports=False)
        records = {path: path.stat().st_mtime_ns for path in found.directory.glob("specimens/*/record.json")}
        again = tunica.cohort(self.folder / "cohort.json", found.directory, reports=False)
        self.assertEqual(records, {path: path.stat().st_mtime_ns for path in records})
        self.assertEqual(result_of(found.directory), result_of(again.directory))
        self.assertIsInstance(tunica.open(found.directory), tunica.Cohort)
        self.assertFalse((found.directory / "specimens/a/report.html").exists())
        with self.assertRaisesRegex(tunica.InputError, "no specimen 'd'; there are: a, b, c"):
            found.specimen("d")

    def test_ctrl_c_keeps_the_specimens_that_are_done(self):
        pressed = []

        def press(share, text):
            if share > 0 and not pressed:
                pressed.append(text)
                os.kill(os.getpid(), signal.SIGINT)

        out = self.folder / "out"
        with self.assertRaises(tunica.Interrupted) as raised:
            tunica.cohort(self.cohort(), out, threads=1, progress=press)
        self.assertEqual(["1 of 3 specimens"], pressed)
        self.assertEqual(str(out), raised.exception.directory)
        self.assertFalse((out / "result.json").exists())
        records = {path: path.stat().st_mtime_ns for path in out.glob("specimens/*/record.json")}
        self.assertIn(len(records), (1, 2))
        found = tunica.cohort(self.folder / "cohort.json", raised.exception.directory)
        self.assertEqual(records, {path: path.stat().st_mtime_ns for path in records})
        self.assertEqual({"fitted"}, {specimen["outcome"] for specimen in found.specimens})

    def test_what_progress_raises_ends_a_cohort(self):
        class Enough(Exception):
            pass

        def stop(share, text):
            raise Enough

        with self.assertRaises(Enough):
            tunica.cohort(self.cohort(), self.folder / "out", threads=1, progress=stop)
        self.assertFalse((self.folder / "out/result.json").exists())

    def test_stability_is_what_the_program_prints(self):
        experiment = EXAMPLES / "lamb_aorta/experiment.json"
        words = ["stability", experiment, "--model", "gho", "--to", 1.5]
        self.assertEqual(json.loads(program(*words, "--json")), tunica.stability(experiment, "gho", to=1.5))
        program(*words, "-o", self.folder / "a")
        written = tunica.stability(experiment, "gho", directory=self.folder / "b", to=1.5)
        for file in written["files"]:
            name = file.rpartition("/")[2]
            self.assertEqual((self.folder / "a" / name).read_text(), (self.folder / "b" / name).read_text())
        self.assertTrue(written["files"])
        with self.assertRaisesRegex(tunica.InputError, "name a new folder for it"):
            tunica.stability(experiment, "gho", map=["mu", "k1"])
        with self.assertRaisesRegex(tunica.InputError, "map: found 1 names"):
            tunica.stability(experiment, "gho", map=["mu"])

    def test_report_and_export_are_those_of_the_program(self):
        run = {name: tunica.run(of_treloar({"type": name}), self.folder / name, base=TRELOAR, certificate=False)
               for name in ("neo_hooke", "yeoh")}
        page = run["yeoh"].report.read_text()
        run["yeoh"].report.unlink()
        self.assertEqual(run["yeoh"].report, tunica.report(run["yeoh"]))
        self.assertEqual(page, run["yeoh"].report.read_text())
        program("report", self.folder / "neo_hooke", self.folder / "yeoh", "-o", self.folder / "a.html")
        tunica.report(run["neo_hooke"], self.folder / "yeoh", output=self.folder / "b.html")
        self.assertEqual((self.folder / "a.html").read_text(), (self.folder / "b.html").read_text())
        with self.assertRaisesRegex(tunica.InputError, "found 2 folders and no output"):
            tunica.report(run["neo_hooke"], run["yeoh"])
        with self.assertRaisesRegex(tunica.InputError, "needs folders and output="):
            tunica.report(run["yeoh"], pdf=True)
        with self.assertRaisesRegex(tunica.InputError, "no folder .*none; make it first"):
            tunica.report(run["yeoh"], output=self.folder / "none" / "b.pdf", pdf=True)
        card = program("export", self.folder / "yeoh", "--to", "abaqus")
        for result in (run["yeoh"], run["yeoh"].best, self.folder / "yeoh"):
            self.assertEqual(card, tunica.export(result, "abaqus"))
        with self.assertRaisesRegex(tunica.InputError, "run: found 'no', expected one of rubber/lm"):
            tunica.export(run["yeoh"], "abaqus", run="no")
