#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mesh_bias_test.py TUNICA: the bias of parameters by the mesh, estimated in one step, against a fit on the finer mesh."""
import csv
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

tunica = str(pathlib.Path(sys.argv[1]).resolve())
TRUTH = {"c10": 40, "c20": 4, "c30": 0.5}
ROWS = 12


class MeshBias(unittest.TestCase):
    def run_tunica(self, *arguments):
        ended = subprocess.run([tunica, *arguments], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return ended.stdout

    def experiment(self, elements, sd, mark_sd, name):
        test = {"type": "plane_specimen", "length": "12 mm", "width": "10 mm", "marks_along": "4 mm", "elements": elements,
                "data": {"file": "rows.csv", "stress_measure": "first_piola_kirchhoff",
                         "columns": {"stretch": "stretch", "stress": "stress", "mark_stretch": "mark"},
                         "noise": {"stress": {"absolute": sd}, "mark_stretch": {"absolute": mark_sd}}}}
        text = {"format": 1, "models": {"m": {"type": "yeoh"}}, "tests": {"strip": test}, "objective": "least_squares",
                "optimizers": {"lm": {"type": "ceres_lm", "starts": 1}}, "runs": [{"model": "m", "optimizer": "lm"}]}
        (self.folder / f"{name}.json").write_text(json.dumps(text), encoding="utf-8")

    def fit(self, elements, sd, mark_sd, name):
        self.experiment(elements, sd, mark_sd, name)
        told = self.run_tunica("run", f"{name}.json", "-o", name)
        result = json.loads((self.folder / name / "result.json").read_text(encoding="utf-8"))
        report = (self.folder / name / "report.html").read_text(encoding="utf-8")
        return result["runs"][0]["best"]["parameters"], [one["kind"] for one in result["warning_details"]], told, report

    def test_is_that_of_a_fit_on_the_finer_mesh(self):
        with tempfile.TemporaryDirectory() as scratch:
            self.folder = pathlib.Path(scratch)
            rows = [[1 + 0.5 * (k + 1) / ROWS, 0, 1] for k in range(ROWS)]
            self.write(rows)
            self.experiment([48, 40], 1, 1, "truth")
            (self.folder / "values.json").write_text(json.dumps(TRUTH), encoding="utf-8")
            self.run_tunica("simulate", "truth.json", "--parameters", "values.json", "-o", "truth")
            with open(self.folder / "truth/strip.csv", newline="", encoding="utf-8") as file:
                rows = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
            noise = random.Random(4)  # smaller than what the mesh does
            for row in rows:
                row[1] += noise.gauss(0, 0.01)
                row[2] += noise.gauss(0, 1e-7)
            self.write(rows)
            coarse, warned, told, report = self.fit([6, 4], 0.01, 1e-7, "coarse")
            fine, *_ = self.fit([12, 8], 0.01, 1e-7, "fine")
            for name in TRUTH:
                moved = coarse[name]["value"] - fine[name]["value"]
                self.assertAlmostEqual(coarse[name]["mesh_bias"], moved, delta=0.05 * abs(moved), msg=name)
            self.assertIn("mesh_biases_parameters", warned)
            self.assertIn("mesh +", told)
            self.assertIn("of which the mesh", report)
            self.assertIn("Take smaller elements", report)
            # Beside a large noise the same mesh does not matter.
            quiet, warned, *_ = self.fit([6, 4], 3, 1e-2, "quiet")
            self.assertNotIn("mesh_biases_parameters", warned)
            self.assertIn("mesh_bias", quiet["c10"])

    def write(self, rows):
        (self.folder / "rows.csv").write_text(
            "stretch,stress [kPa],mark\n" + "".join(",".join(map(str, row)) + "\n" for row in rows), encoding="utf-8")


unittest.main(argv=sys.argv[:1])
