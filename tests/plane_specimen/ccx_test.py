#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ccx_test.py TUNICA: clamped strips, a dog-bone and a plate with a hole as CalculiX simulates them with other elements on
other meshes. Ends with 77 where there is no ccx."""
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # nothing is left beside the sources
import ccx_plate

tunica = str(pathlib.Path(sys.argv[1]).resolve())
STRETCHES = [1.15, 1.4]
FIBRE_STRETCHES = [1.1, 1.3]
FIBRES = {"mu": 20, "kappa": 0, "k1": 10, "k2": 1, "theta": 35}  # CalculiX has no dispersion
MU, BULK = 100.0, 1e6  # kPa; the card is nearly incompressible, which costs 1e-4 at most
NEO_HOOKE = f"*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, NEO HOOKE\n{MU / 2}, {2 / BULK}\n"
FOAM = "*MATERIAL, NAME=FOAM\n*HYPERFOAM, N=2\n12.5, 6, 12.5, 6, 0.18, 0.18\n"
FOAM_VALUES = {"mu_1": 25, "alpha_1": 6, "nu": 0.18}


def fibres(bulk):
    """CalculiX's material of Holzapfel, Gasser and Ogden (2000); fibres pull where the part of their stretch that keeps the
    volume is above 1."""
    angle = math.radians(FIBRES["theta"])
    family = [f"{math.cos(angle):.12g}, {sign * math.sin(angle):.12g}" for sign in (1, -1)]
    strength = f"{FIBRES['k1']}, {FIBRES['k2']}"
    return (f"*MATERIAL, NAME=ELASTIC_FIBER\n*USER MATERIAL, CONSTANTS=10\n{FIBRES['mu'] / 2}, {2 / bulk}, "
            f"{family[0]}, {strength}, {family[1]}\n{strength}\n")


# A mark of CalculiX is a node: strips have them at these places.
SPECIMENS = {
    "strip": (ccx_plate.Quarter(12, 6, ccx_plate.strip(20, 10)), [(2.5, 0), (0, 2.5)],
              {"length": "20 mm", "width": "10 mm", "marks_along": "5 mm", "marks_across": "5 mm"}),
    "plate_with_hole": (ccx_plate.Quarter(12, 8, ccx_plate.plate_with_hole(20, 10, 2)), [],
                        {"shape": "plate_with_hole", "length": "20 mm", "width": "10 mm", "hole_radius": "2 mm",
                         "marks_along": "8 mm", "marks_across": "6 mm"}),
    "dog_bone": (ccx_plate.Quarter(18, 4, ccx_plate.dog_bone(40, 12, 16, 4, 8)), [],
                 {"shape": "dog_bone", "length": "40 mm", "width": "12 mm", "gauge_section": "16 mm",
                  "gauge_width": "4 mm", "fillet": "8 mm", "marks_along": "5 mm", "marks_across": "3 mm"}),
}


class Plates(unittest.TestCase):
    def compare(self, name, model, values, card):
        length = self.length_of(name)
        mesh, marks, options = SPECIMENS[name]
        rows = self.ours(model, values, options, STRETCHES)
        with tempfile.TemporaryDirectory() as folder:
            forces, moved = ccx_plate.solve(folder, mesh, length, card, STRETCHES, marks or [(length / 2, 0)])
        self.hold(name, model, rows, forces, moved if marks else [[]] * len(rows))

    @staticmethod
    def length_of(name):
        return float(SPECIMENS[name][2]["length"].split()[0])

    def ours(self, model, values, options, stretches):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            (folder / "rows.csv").write_text(
                "stretch,stress [kPa],mark,across\n" + "".join(f"{s},0,1,1\n" for s in stretches), encoding="utf-8")
            test = {"type": "plane_specimen", **options,
                    "data": {"file": "rows.csv", "stress_measure": "first_piola_kirchhoff",
                             "columns": {"stretch": "stretch", "stress": "stress", "mark_stretch": "mark",
                                         "mark_transverse_stretch": "across"}}}
            experiment = {"format": 1, "models": {"m": {"type": model}}, "tests": {"plate": test},
                          "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm"}},
                          "runs": [{"model": "m", "optimizer": "lm"}]}
            (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
            (folder / "values.json").write_text(json.dumps(values), encoding="utf-8")
            ended = subprocess.run([tunica, "simulate", "experiment.json", "--parameters", "values.json", "-o", "out"],
                                   cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            with open(folder / "out/plate.csv", newline="", encoding="utf-8") as file:
                return [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]

    def hold(self, name, model, rows, forces, moved):
        width = float(SPECIMENS[name][2]["width"].split()[0])
        for force, row, found in zip(forces, rows, moved):
            self.assertLess(abs(force / width / row[1] - 1), 1e-3, (name, model, row))
            for mark, ours in zip(found, row[2:]):
                self.assertLess(abs(mark - ours), 1e-3 * abs(row[0] - 1), (name, model, row))

    def test_rubber(self):
        for name in SPECIMENS:
            with self.subTest(specimen=name):
                self.compare(name, "neo_hooke", {"mu": MU}, NEO_HOOKE)

    def test_fibres(self):
        """The volume of CalculiX's material changes: of two bulk moduli K the results are taken to 1/K = 0."""
        mesh, marks, options = SPECIMENS["strip"]
        rows = self.ours("gho", FIBRES, options, FIBRE_STRETCHES)
        soft, stiff = 2e3, 2e4
        with tempfile.TemporaryDirectory() as folder:
            found = [ccx_plate.solve(folder, mesh, self.length_of("strip"), fibres(bulk), FIBRE_STRETCHES, marks, first=0.02)
                     for bulk in (soft, stiff)]
        limit = [[b + (b - a) * soft / (stiff - soft) for a, b in zip(*columns)]
                 for columns in zip(*[[[force, *mark] for force, mark in zip(*one)] for one in found])]
        self.hold("strip", "gho", rows, [row[0] for row in limit], [row[1:] for row in limit])

    def test_foam(self):
        for name in SPECIMENS:
            with self.subTest(specimen=name):
                self.compare(name, "hyperfoam", FOAM_VALUES, FOAM)


if not shutil.which("ccx"):
    print("no ccx here (Debian: calculix-ccx)")
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
