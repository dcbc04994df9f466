#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clamped_ends_test.py TUNICA [ASPECT...]: short strips that CalculiX clamps, so many times as long as wide, with noise of 1 % of
the range. The diagnosis names the clamps, and the modulus is right once they are there. Ends with 77 where there is no ccx."""
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # nothing is left beside the sources
import ccx_plate

tunica = str(pathlib.Path(sys.argv[1]).resolve())
MU, BULK, WIDTH, NOISE = 100.0, 1e6, 10, 0.01
CARD = f"*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, NEO HOOKE\n{MU / 2}, {2 / BULK}\n"
STRETCHES = [1 + 0.6 * (k + 1) / 30 for k in range(30)]


class ClampedStrip(unittest.TestCase):
    def run_tunica(self, *arguments):
        ended = subprocess.run([tunica, *arguments], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return ended.stdout

    def result(self, name):
        return json.loads((self.folder / name / "result.json").read_text(encoding="utf-8"))

    def modulus(self, experiment, name):
        self.run_tunica("run", experiment, "-o", name)
        return self.result(name)["runs"][0]["best"]["parameters"]["mu"]["value"]

    def measure(self, aspect):
        """Writes the rows, and returns the test without sizes."""
        mesh = ccx_plate.Quarter(6 * aspect, 6, ccx_plate.strip(aspect * WIDTH, WIDTH))
        forces, moved = ccx_plate.solve(self.folder, mesh, aspect * WIDTH, CARD, STRETCHES, [(0, WIDTH / 2)])
        noise = random.Random(1)
        columns = [[force / WIDTH for force in forces], [mark[0] for mark in moved]]
        sds = [NOISE * max(columns[0]), NOISE * (1 - min(columns[1]))]
        lines = [f"{stretch},{stress + noise.gauss(0, sds[0])},{across + noise.gauss(0, sds[1])}\n"
                 for stretch, stress, across in zip(STRETCHES, *columns)]
        (self.folder / "rows.csv").write_text("stretch,stress [kPa],across\n" + "".join(lines), encoding="utf-8")
        return {"type": "uniaxial", "direction": "axial",
                "data": {"file": "rows.csv", "stress_measure": "first_piola_kirchhoff",
                         "columns": {"stretch": "stretch", "stress": "stress", "transverse_stretch": "across"},
                         "noise": {"stress": {"absolute": sds[0]}, "transverse_stretch": {"absolute": sds[1]}}}}

    def write(self, test):
        text = {"format": 1, "models": {"m": {"type": "neo_hooke"}}, "tests": {"strip": test},
                "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm"}},
                "runs": [{"model": "m", "optimizer": "lm"}]}
        (self.folder / "experiment.json").write_text(json.dumps(text), encoding="utf-8")

    def test_is_named_and_corrected_where_sizes_are_known(self):
        for aspect in map(int, sys.argv[2:] or (2, 4)):
            with self.subTest(aspect=aspect), tempfile.TemporaryDirectory() as scratch:
                self.folder = pathlib.Path(scratch)
                bare = self.measure(aspect)
                self.write(bare)
                told = " ".join(self.run_tunica("diagnose", "experiment.json", "--quick", "-o", "quick").split())
                self.assertNotIn("consistent with clamped_ends", told)
                if aspect == 2:  # of a misfit that raises the alarm
                    self.assertIn("clamped_ends (needs the length and width of the specimen in the file)", told)
                self.write({**bare, "length": f"{aspect * WIDTH} mm", "width": f"{WIDTH} mm"})
                told = self.run_tunica("diagnose", "experiment.json", "-o", "out")
                self.assertIn("NAMED: consistent with clamped_ends", told)
                self.assertGreater(self.modulus("experiment.json", "bare") / MU - 1, 0.01)
                self.assertLess(abs(self.modulus("out/extended.json", "clamped") / MU - 1), 0.01)


if not shutil.which("ccx"):
    print("no ccx here (Debian: calculix-ccx)")
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
