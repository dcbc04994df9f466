# SPDX-License-Identifier: Apache-2.0
"""What the tests of the package share."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["TUNICA"]
EXAMPLES = pathlib.Path(os.environ["TUNICA_EXAMPLES"])
TRELOAR = EXAMPLES / "treloar"


def program(*arguments):
    """Runs the command line; returns what it prints."""
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def of_treloar(model, optimizer=None, evaluations=2000):
    """The three tests of examples/treloar with one model, as a dictionary."""
    measured = {"columns": {"stretch": "stretch", "stress": "stress"}, "stress_measure": "first_piola_kirchhoff",
                "noise": {"absolute": "0.02 MPa", "relative": "2 %"}}
    return {"format": 1, "name": "treloar", "models": {"rubber": model},
            "tests": {"uniaxial": {"type": "uniaxial", "direction": "circumferential",
                                   "data": {"file": "uniaxial.csv", **measured}},
                      "equibiaxial": {"type": "biaxial", "protocol": "equibiaxial",
                                      "data": {"file": "equibiaxial.csv", **measured}},
                      "pure_shear": {"type": "biaxial", "protocol": "pure_shear",
                                     "data": {"file": "pure_shear.csv", **measured}}},
            "objective": "least_squares", "stop": {"max_evaluations": evaluations},
            "optimizers": {"lm": optimizer or {"type": "ceres_lm", "starts": 5}},
            "runs": [{"model": "rubber", "optimizer": "lm"}]}


class Case(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)


# What a clock decides, or a folder.
VOLATILE = {"seconds", "date", "time", "file"}


def without_clock(value):
    if isinstance(value, dict):
        return {key: without_clock(entry) for key, entry in value.items() if key not in VOLATILE}
    return [without_clock(entry) for entry in value] if isinstance(value, list) else value


def result_of(folder):
    return without_clock(json.loads((folder / "result.json").read_text()))


def rows_of(file):
    """The lines of a table without the columns, and the statistics, of what a clock decides: checksums
    of rows too."""
    import csv
    header, *rows = csv.reader(line for line in file.read_text().splitlines() if not line.startswith("#"))
    kept = [k for k, name in enumerate(header) if "[s]" not in name and name != "checksum"]
    return [[row[k] for k in kept] for row in [header, *rows] if "seconds" not in row]
