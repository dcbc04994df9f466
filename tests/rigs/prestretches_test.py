#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""prestretches_test.py TUNICA: sheets that were mounted with two unknown prestretches. Data are simulated; those of the
diagnosis have noise of a stated seed."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

tunica = str(pathlib.Path(sys.argv[1]).resolve())
MOUNTED = {"around": 0.05, "along": 0.03}  # true over recorded stretch, less 1
VALUES = {"mu": 20, "k1": 25, "k2": 0.7, "theta": 42}
MECHANISMS = [{"type": "sheet_prestretch", "as": "around", "channel": "stress_circumferential"},
              {"type": "sheet_prestretch", "as": "along", "channel": "stress_axial"}]


class Prestretches(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def tunica(self, *arguments):
        done = subprocess.run([tunica, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=500)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        return " ".join(done.stdout.split())

    def experiment(self, mounted):
        """Two sheets along three paths each; `mounted` has the mechanisms of the first."""
        tests = {}
        for name in ("mounted", "marked"):
            rows = [(1 + a * x, 1 + b * x) for a, b in ((1, 1), (1, 0.3), (0.3, 1)) for x in (k * 0.02 for k in range(1, 16))]
            (self.folder / f"{name}.csv").write_text(
                "t,z,st [kPa],sz [kPa]\n" + "".join(f"{t:.6f},{z:.6f},100,100\n" for t, z in rows), encoding="utf-8")
            tests[name] = {"type": "biaxial",
                           "data": {"file": f"{name}.csv", "stress_measure": "first_piola_kirchhoff",
                                    "columns": {"stretch_circumferential": "t", "stretch_axial": "z",
                                                "stress_circumferential": "st", "stress_axial": "sz"},
                                    "noise": {"relative": "1 %"}},
                           "mechanisms": mounted if name == "mounted" else []}
        return {"format": 1, "seed": 3, "models": {"wall": {"type": "hgo"}}, "tests": tests, "objective": "least_squares",
                "optimizers": {"lm": {"type": "ceres_lm", "starts": 4}}, "runs": [{"model": "wall", "optimizer": "lm"}],
                "diagnosis": {"model": "wall"}}

    def simulate(self, experiment, noise):
        (self.folder / "truth.json").write_text(json.dumps(experiment), encoding="utf-8")
        values = VALUES | {f"mounted.{name}.stretch": value for name, value in MOUNTED.items()}
        (self.folder / "values.json").write_text(json.dumps(values), encoding="utf-8")
        self.tunica("simulate", "truth.json", "--parameters", "values.json", "--noise", noise, "--seed", 11, "-o", "data")
        for name in experiment["tests"]:
            (self.folder / f"{name}.csv").write_text((self.folder / "data" / f"{name}.csv").read_text("utf-8"), "utf-8")

    def test_both_are_recovered(self):
        experiment = self.experiment(MECHANISMS)
        self.simulate(experiment, 0)
        self.tunica("run", "truth.json", "-o", "out", "--no-certificate")
        best = json.loads((self.folder / "out/result.json").read_text("utf-8"))["runs"][0]["best"]["parameters"]
        for name, value in MOUNTED.items():
            self.assertLess(abs(best[f"mounted.{name}.stretch"]["value"] - value), 1e-4)
        for name, value in VALUES.items():
            self.assertLess(abs(best[name]["value"] / value - 1), 1e-4)

    def test_the_diagnosis_names_them(self):
        self.simulate(self.experiment(MECHANISMS), 0.01)
        (self.folder / "experiment.json").write_text(json.dumps(self.experiment_without()), encoding="utf-8")
        said = self.tunica("diagnose", "experiment.json", "-o", "out", "--quiet")
        found = json.loads((self.folder / "out/result.json").read_text("utf-8"))["diagnosis"]
        first = found["file"]["causes"][0]
        self.assertEqual(first["mechanism"], "sheet_prestretch", said)
        self.assertIn("mounted", json.dumps(first))
        for channel in ("stress_circumferential", "stress_axial"):
            self.assertIn(channel, first["mend"])

    def experiment_without(self):
        experiment = json.loads((self.folder / "truth.json").read_text("utf-8"))
        experiment["tests"]["mounted"]["mechanisms"] = []
        return experiment


unittest.main(argv=sys.argv[:1])
