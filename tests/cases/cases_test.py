# SPDX-License-Identifier: Apache-2.0
"""Small public cases. Each folder has the data, an experiment and a line on the source; the right values are known from
numpy, scipy or a publication, as the tests say."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

PROGRAM = ""
CASES = pathlib.Path(__file__).parent


class Cases(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def case(self, name):
        shutil.copytree(CASES / name, self.folder, dirs_exist_ok=True)

    def tunica(self, *arguments):
        """The exit code and all that was printed, without line breaks."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=240)
        return done.returncode, " ".join((done.stdout + done.stderr).split())

    def in_order(self, experiment="experiment.json"):
        """What check says of an experiment that is in order."""
        code, said = self.tunica("check", experiment)
        self.assertEqual(0, code, said)
        return said

    def changed(self, **tests):
        """The experiment with other keys in the data of its tests."""
        file = self.folder / "experiment.json"
        experiment = json.loads(file.read_text())
        for name, data in tests.items():
            experiment["tests"][name]["data"].update(data)
        file.write_text(json.dumps(experiment))

    def best(self, *arguments, experiment="experiment.json"):
        code, said = self.tunica("run", experiment, "-o", "out", "--no-certificate", *arguments)
        self.assertEqual(0, code, said)
        run = json.loads((self.folder / "out" / "result.json").read_text())["runs"][0]
        self.values = {name: about["value"] for name, about in run["best"]["parameters"].items()}
        return run

    def assert_values(self, tolerance, **right):
        for name, value in right.items():
            self.assertLess(abs(self.values[name] / value - 1), tolerance, f"{name} = {self.values[name]}")

    def test_an_isotropic_strip_to_stretch_10_is_a_linear_problem(self):
        self.case("isotropic-holes-yeoh-large-stretch")
        run = self.best("-j", 1)
        self.assertEqual(0, run["failures"])
        self.assert_values(1e-3, c10=19.6179520, c20=-0.0793856822, c30=8.86046894e-4)  # numpy.linalg.lstsq

    def test_three_constants_of_mooney_and_rivlin_are_found(self):
        self.case("mooney-rivlin-three-terms")
        self.best()
        self.assert_values(1e-5, c10=1283.033, c01=593.477, c11=-6.9017)  # numpy.linalg.lstsq, absolute weights
        self.changed(t={"noise": {"relative": "1 %"}})
        shutil.rmtree(self.folder / "out")
        self.best()
        self.assert_values(1e-5, c10=1338.856, c01=523.6214, c11=-16.48364)  # and published: relative ones

    def test_a_product_of_invariants_is_a_term_of_a_composed_model(self):
        self.case("mooney-rivlin-three-terms")
        self.best(experiment="composed_product.json")
        self.assert_values(1e-4, **self.least_squares_of_products())

    def least_squares_of_products(self):
        """Linear least squares of the same energy, in exact fractions: nominal stress is linear in a, b, q and x."""
        with open(self.folder / "uniax.csv", encoding="utf-8") as file:
            rows = [[Fraction(cell) for cell in line.split(",")] for line in file.read().split()[2:]]
        table = []
        for strain, stress in rows:
            stretch = 1 + strain
            i1, i2 = stretch**2 + 2 / stretch - 3, 2 * stretch + stretch**-2 - 3
            d1, d2 = 2 * (stretch - stretch**-2), 2 * (1 - stretch**-3)
            # W = a/2 (I1-3) + b/2 (I2-3) + q/2 (I1-3)² + x/2 (I1-3)(I2-3); MPa in the file
            table.append(([d1 / 2, d2 / 2, i1 * d1, (i1 * d2 + i2 * d1) / 2], 1000 * stress))
        matrix = [[sum(row[i] * row[j] for row, _ in table) for j in range(4)] +
                  [sum(row[i] * stress for row, stress in table)] for i in range(4)]
        for k in range(4):  # Gauss and Jordan; fractions need no pivots
            matrix[k] = [value / matrix[k][k] for value in matrix[k]]
            for i in range(4):
                if i != k:
                    matrix[i] = [a - matrix[i][k] * b for a, b in zip(matrix[i], matrix[k])]
        return dict(zip(("a_mu", "b_mu", "q_k", "x_mu"), (float(row[4]) for row in matrix)))

    def test_forces_of_a_simple_shear_are_read(self):
        self.case("simple-shear-force-columns")
        self.best()
        self.assert_values(1e-4, mu_1=0.026545, alpha_1=15.892)  # numpy

    def test_a_compression_that_is_written_positive_is_read_with_negative_units(self):
        self.case("compression-positive-load")
        self.best(experiment="with_negative_units.json")
        self.assert_values(0.01, mu_1=2.0, alpha_1=9.0)  # the data were made with them

    def test_two_axes_of_a_cellscale_file_give_fungs_constants(self):
        self.case("cellscale-import")
        self.best()
        self.assert_values(0.01, c=8.0, a1=6.0, a2=3.0, a4=1.2)  # the data were made with them

    def test_a_tube_of_vasotracker_gives_demirays_constants(self):
        self.case("vasotracker-import")
        self.best()
        self.assert_values(0.02, m_mu=12.0, m_b=3.0)  # the data were made with them

    def test_a_second_prony_branch_is_tried_or_said_to_be_left_out(self):
        self.case("diagnose-second-prony-branch")
        code, said = self.tunica("diagnose", "experiment.json", "-o", "why", "--quick")
        found = json.loads((self.folder / "why" / "result.json").read_text())["diagnosis"]
        if [cause["id"] for cause in found["causes"]] != ["viscoelasticity"]:
            self.assertIn("Left out: a second viscoelasticity beside that of the base", said)
        self.assertIn(code, (0, 1))

    def test_percent_without_a_unit_is_asked_about(self):
        self.case("percent-strain-no-unit")
        code, said = self.tunica("import", "pct.csv", "--stress-measure", "cauchy", "--unit", "Stress=kPa", "-o",
                                 "e.json")
        self.assertEqual(2, code, said)
        self.assertIn("Strain", said)

    def test_honest_records_raise_no_question(self):
        for name in ("lamb_aorta", "treloar", "james_1975", "human_brain_cortex",
                     "human_brain_corona_radiata", "vhb4910_cause", "murine_tube_cause"):
            code, said = self.tunica("check", CASES.parents[1] / "examples" / name / "experiment.json", "--json")
            self.assertEqual(0, code, said)
            found = [one["sentence"] for one in json.loads(said)["warning_details"] if one["kind"].startswith("record_")]
            self.assertEqual([], found, name)

    def test_a_strain_in_percent_is_asked_about_by_check(self):
        self.case("percent-strain-no-unit")
        self.assertIn("goes to 11.79", self.in_order())
        self.changed(pct={"units": {"Stress": "kPa", "Strain": "%"}})
        self.assertNotIn("Is it percent?", self.in_order())

    def test_a_grip_distance_beside_a_gauge_length_is_refused(self):
        self.case("grip-distance-ignored")
        code, said = self.tunica("check", "experiment.json")
        self.assertEqual(2, code, said)
        self.assertIn('"grip_distance" changes nothing beside a "gauge_length" of 22.76 mm', said)
        self.assertIn('grip_distance + displacement, as "length"', said)
        self.assertIn('or give "gauge_length": "preload" with a "preload"', said)

    def test_a_spike_and_a_cylinder_that_may_be_pressed_are_asked_about(self):
        self.case("compression-positive-load")
        said = self.in_order()
        self.assertIn("Is it a spike of the start?", said)
        self.assertIn('add "compression": "positive"', said)
        self.assertNotIn("several cycles", said)
        self.changed(muscle={"compression": "positive", "rows": "1:"})
        said = self.in_order()
        self.assertNotIn("Is it a spike", said)
        self.assertNotIn("as one to be pressed", said)

    def test_import_asks_whether_a_cylinder_is_pressed(self):
        self.case("compression-positive-load")
        arguments = ("import", "muscle.csv", "--diameter", "14mm", "--height", "21mm", "-o", "e.json")
        code, said = self.tunica(*arguments)
        self.assertEqual(2, code, said)
        self.assertIn("--compression positive or --compression negative", said)
        self.assertFalse((self.folder / "e.json").exists())
        for sign, stretch in (("positive", "stretch 0.6 … 1"), ("negative", "stretch 1 … 1.4")):
            code, said = self.tunica(*arguments, "--compression", sign)
            self.assertEqual(0, code, said)
            self.assertIn("displacement / 21 mm", said)
            said = self.in_order("e.json")
            self.assertIn(stretch, said)
            self.assertNotIn("as one to be pressed", said)
            (self.folder / "e.json").unlink()

    def test_rows_after_a_break_are_asked_about(self):
        self.case("isotropic-holes-yeoh-large-stretch")
        self.assertNotIn("Did the specimen break", self.in_order())
        with open(self.folder / "mono.csv", "a", encoding="utf-8") as data:
            for row in range(20):  # the specimen hangs in two parts, and the grips go on
                data.write(f"0.0{row % 3},{230 + row}\n")
        self.assertIn("Did the specimen break or slip? The 20 rows", self.in_order())

    def test_a_german_file_of_mts_is_imported(self):
        self.case("mts-german-locale")
        (self.folder / "experiment.json").unlink()
        code, said = self.tunica("import", "u.dat", "--set", "direction=axial", "--area", "7651mm2",
                                 "--gauge-length", "299.5mm", "-o", "e.json")
        self.assertEqual(0, code, said)
        data = next(iter(json.loads((self.folder / "e.json").read_text())["tests"].values()))["data"]
        self.assertEqual({"time": "Laufzeit", "force": "Ch 1 Kraft", "displacement": "Ch 1 Weg"}, data["columns"])

    def test_rows_of_empty_cells_are_blank_lines(self):
        self.case("spreadsheet-empty-tail")
        self.assertIn("27", self.in_order())

    def test_import_makes_a_biaxial_test_of_two_axes(self):
        self.case("cellscale-import")
        (self.folder / "experiment.json").unlink()
        code, said = self.tunica("import", "bio.csv", "--each", "SetName", "--thickness", "0.8mm", "--width", "5mm",
                                 "--gauge-length", "5mm", "-o", "e.json")
        self.assertEqual(0, code, said)
        tests = json.loads((self.folder / "e.json").read_text())["tests"]
        self.assertEqual({"biaxial"}, {test["type"] for test in tests.values()})
        self.in_order("e.json")

    def test_import_makes_an_experiment_of_a_vasotracker_file(self):
        self.case("vasotracker-import")
        (self.folder / "experiment.json").unlink()
        code, said = self.tunica("import", "vt.csv", "--thickness", "20um", "--set", "outer_radius=55um", "--set",
                                 "axial_stretch=1.2", "--unit", "Outer Diameter=um", "--unit", "Inner Diameter=um",
                                 "-o", "e.json")
        self.assertEqual(0, code, said)
        self.assertIn("52", self.in_order("e.json"))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(verbosity=2)
