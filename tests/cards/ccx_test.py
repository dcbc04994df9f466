#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ccx_test.py TUNICA SOURCE: fits are exported, CalculiX computes a cube with the card, and its curves are those that
tunica wrote beside the fit. Ends with 77 where there is no ccx."""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # nothing is left beside the sources
import ccx_cube

tunica, source = sys.argv[1], pathlib.Path(sys.argv[2])
ISOTROPIC = ["neo_hooke", "mooney_rivlin", "yeoh", "ogden"]
# Axial and circumferential stretches of a sheet of artery; the fibres are stretched in every row.
SHEET = [(1 + 0.02 * k, 1 + 0.01 * k * ratio) for ratio in (0.5, 1, 2) for k in range(1, 13)]
# Constants of polynomials in kPa: those with one more power of I1 - 3 or I2 - 3 have no counterpart in simpler cards.
POLYNOMIALS = {
    3: {"c10": 180, "c01": 20, "c11": 15},
    5: {"c10": 180, "c01": 20, "c20": 30, "c11": 15, "c02": 8},
    9: {"c10": 180, "c01": 20, "c20": 30, "c11": 15, "c02": 8, "c30": 12, "c21": -6, "c12": 9, "c03": 5},
}
FIBRES = {
    "hgo": {"mu": 12, "k1": 20, "k2": 0.8, "theta": 40},
    "four_fibre": {"mu": 9, "k1": 15, "k2": 0.5, "theta": 35, "k1_axial": 8, "k2_axial": 0.3, "k1_circumferential": 11,
                   "k2_circumferential": 0.7},
}
# Materials that change their volume: the bulk modulus of the card is the fitted one.
FOAMS = {
    "hyperfoam": ({"mu_1": 25, "alpha_1": 6, "nu": 0.18}, {}),
    "hyperfoam of two terms": ({"mu_1": 25, "alpha_1": 6, "nu_1": 0.18, "mu_2": 8, "alpha_2": -2, "nu_2": 0.3},
                               {"terms": 2, "poisson": "each"}),
    "blatz_ko": ({"mu": 11, "f": 0.3, "nu": 0.25}, {}),
    "mooney_rivlin": ({"c10": 18, "c01": 5}, {"mechanisms": [{"type": "compressibility", "invariants": "isochoric", "law": "quadratic",
                                                                "parameters": {"compliance": {"fixed": 0.01}}}]}),
}


def run(*words, folder=None):
    ended = subprocess.run([tunica, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout


def curve(folder, test, of_run, columns):
    """The columns of a fit, row by row."""
    with open(folder / f"fit_{test}.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["run"] == of_run]
    return [[float(row[column]) for row in rows] for column in columns]


def largest_difference(found, expected, factor):
    """Relative, of stresses that the card has in `factor` times kPa."""
    return max(abs(one / (factor * other) - 1) for one, other in zip(found, expected))


class Cards(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    @classmethod
    def setUpClass(cls):
        """The fits to Treloar's data, which several cards are made of."""
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.rubber = pathlib.Path(scratch.name) / "rubber"
        run("run", source / "examples/treloar/experiment.json", "-o", cls.rubber)

    def compare(self, target, ratio, factor, units, largest_stretch, limit):
        for model in ISOTROPIC:
            card = run("export", self.rubber, "--to", target, "--run", model + "/lm", "--units", units, *ratio)
            for protocol in ccx_cube.FACES:
                stretches, expected = curve(self.rubber, protocol, model + "/lm", ["stretch [1]", "stress.predicted [kPa]"])
                kept = [row for row in zip(stretches, expected) if row[0] <= largest_stretch]
                found = ccx_cube.nominal_stress(self.folder, card, protocol, [row[0] for row in kept])
                with self.subTest(target=target, model=model, protocol=protocol):
                    self.assertGreater(len(kept), 5)
                    self.assertLess(largest_difference(found, [row[1] for row in kept], factor), limit)

    def test_isotropic_cards_reproduce_the_fits_over_all_of_treloars_data(self):
        self.compare("calculix", ["--bulk-ratio", "1e5"], 1e-3, "mm-N-MPa", 8, 1e-3)

    def test_the_default_bulk_modulus_is_enough_to_a_stretch_of_three(self):
        self.compare("calculix", [], 1, "mm-mN-kPa", 3, 1e-3)

    def test_abaqus_cards_of_isotropic_models_are_read_by_calculix(self):
        self.compare("abaqus", ["--bulk-ratio", "1e5"], 1e-3, "mm-N-MPa", 8, 1e-3)

    def sheet(self, model, values=None, **options):
        """The folder of a fit to a sheet that is the model's own."""
        values = values or FIBRES[model]
        free = next(iter(values))
        rows = "".join(f"{circ:.6g},{axial:.6g},1,1\n" for circ, axial in SHEET)
        (self.folder / "sheet.csv").write_text("t,z,st,sz\n" + rows, encoding="utf-8")
        data = {"file": "sheet.csv", "stress_measure": "first_piola_kirchhoff",
                "columns": {"stretch_circumferential": "t", "stretch_axial": "z",
                            "stress_circumferential": "st", "stress_axial": "sz"}}
        # One parameter is free, so that there is something to fit.
        fixed = {name: {"fixed": value} for name, value in values.items() if name != free}
        experiment = {"format": 1, "models": {"wall": {"type": model, "parameters": fixed, **options}},
                      "tests": {"sheet": {"type": "biaxial", "data": data}}, "objective": "least_squares",
                      "optimizers": {"lm": {"type": "ceres_lm"}}, "runs": [{"model": "wall", "optimizer": "lm"}]}
        name = f"{model}_{len(values)}"
        path = self.folder / "experiment.json"
        path.write_text(json.dumps(experiment), encoding="utf-8")
        (self.folder / "truth.json").write_text(json.dumps({free: values[free]}), encoding="utf-8")
        run("simulate", path, "--model", "wall", "--parameters", self.folder / "truth.json", "-o",
            self.folder / f"made_{name}")
        data["file"] = f"made_{name}/sheet.csv"
        path.write_text(json.dumps(experiment), encoding="utf-8")
        run("run", path, "-o", self.folder / name)
        return self.folder / name

    def reproduce(self, fit, *ratio):
        card = run("export", fit, "--to", "calculix", "--units", "mm-mN-kPa", *ratio)
        circ, axial, along, across = curve(fit, "sheet", "wall/lm", [
            "stretch_circumferential [1]", "stretch_axial [1]", "stress_circumferential.predicted [kPa]",
            "stress_axial.predicted [kPa]"])
        found = ccx_cube.sheet_stress(self.folder, card, list(zip(circ, axial)))
        for direction, (forces, expected) in enumerate(zip(found, (along, across))):
            with self.subTest(fit=fit.name, direction=direction):
                self.assertLess(largest_difference(forces, expected, 1), 1e-3)

    def test_fibres_of_hgo_and_four_fibre_reproduce_a_sheet(self):
        for model in FIBRES:
            self.reproduce(self.sheet(model))

    def test_foams_and_a_fitted_bulk_modulus_reproduce_a_sheet(self):
        for name, (values, options) in FOAMS.items():
            self.reproduce(self.sheet(name.split()[0], values, **options))

    def test_polynomials_of_three_five_and_nine_constants_reproduce_a_sheet(self):
        for terms, values in POLYNOMIALS.items():
            # The card is nearly incompressible; with nine constants 1e5 costs CalculiX the last digits.
            self.reproduce(self.sheet("mooney_rivlin", values, terms=terms), "--bulk-ratio", "1e4" if terms == 9 else "1e5")

    def test_the_bulk_modulus_is_that_of_the_card(self):
        fits = {"calculix": (self.rubber, ["--run", "neo_hooke/lm"]), "fibres": (self.sheet("hgo"), [])}
        for name, (fit, words) in fits.items():
            card = run("export", fit, "--to", "calculix", "--units", "mm-mN-kPa", *words)
            stated = float(" ".join(card.replace("\n**", " ").split()).split("bulk modulus is ")[1].split()[0])
            with self.subTest(card=name):
                self.assertLess(abs(ccx_cube.bulk_modulus(self.folder, card) / stated - 1), 1e-3)


if not shutil.which("ccx"):
    print("no ccx here (Debian: calculix-ccx)")
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
