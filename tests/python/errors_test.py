# SPDX-License-Identifier: Apache-2.0
"""Errors are exceptions that say what was found, where, and what to do."""
import json
import pathlib
import subprocess
import sys

import tunica
from support import TRELOAR, Case, of_treloar


class Errors(Case):
    def message(self, call, *arguments, **keywords):
        with self.assertRaises(tunica.InputError) as raised:
            call(*arguments, **keywords)
        return str(raised.exception)

    def test_a_wrong_key_of_a_file_names_file_line_and_the_right_key(self):
        experiment = of_treloar({"type": "neo_hooke"})
        experiment["objectiv"] = experiment.pop("objective")
        file = self.folder / "experiment.json"
        file.write_text(json.dumps(experiment, indent=2))
        line = 1 + file.read_text().splitlines().index('  "objectiv": "least_squares"')
        message = self.message(tunica.run, file)
        self.assertIn(f"{file}", message)
        self.assertIn(f"line {line},", message)
        self.assertIn("'objective'", message)
        self.assertEqual([file], list(self.folder.iterdir()), "nothing is written before the experiment is in order")

    def test_results_nested_without_end_are_refused(self):
        for levels in (65, 80000):  # as deep as the command line reads, whatever the interpreter allows
            (self.folder / "result.json").write_text("[" * levels + "]" * levels)
            self.assertIn("is not JSON that tunica has written (more than 64 levels", self.message(tunica.open, self.folder))

    def test_a_wrong_key_of_a_dictionary_names_its_path_and_the_right_key(self):
        experiment = of_treloar({"type": "neo_hoke"})
        message = self.message(tunica.check, experiment, base=TRELOAR)
        self.assertIn("/models/rubber/type", message)
        self.assertIn("neo_hooke", message)
        self.assertIn("<dict>", message)

    def test_a_package_without_its_extension_module_says_which_target_to_build(self):
        package = pathlib.Path(tunica.__file__).parent
        (self.folder / "tunica").mkdir()
        for file in package.glob("*.py"):
            (self.folder / "tunica" / file.name).write_bytes(file.read_bytes())
        def said():
            return subprocess.run([sys.executable, "-B", "-c", "import tunica"], capture_output=True, text=True,
                                  env={"PYTHONPATH": str(self.folder)}, check=False).stderr.splitlines()[-1]
        self.assertIn("it was not built. Build the target tunica_python", said())
        (self.folder / "tunica/_core.cpython-30-other.so").touch()
        self.assertIn("found _core.cpython-30-other.so, which are for other Pythons", said())

    def test_what_json_cannot_hold_is_named(self):
        experiment = of_treloar({"type": "neo_hooke"})
        experiment["seed"] = {1, 2}
        self.assertIn("of type set", self.message(tunica.read, experiment))
        self.assertIn("expected the path of a file or a dict", self.message(tunica.read, 7))
        experiment["seed"] = float("nan")
        self.message(tunica.read, experiment)

    def test_a_missing_file_and_a_folder_in_use_are_input_errors(self):
        self.assertIn("nowhere.json", self.message(tunica.run, self.folder / "nowhere.json"))
        (self.folder / "taken").mkdir()
        (self.folder / "taken" / "note.txt").write_text("mine")
        for verb in (tunica.run, tunica.diagnose):
            self.assertIn("taken", self.message(verb, TRELOAR / "experiment.json", self.folder / "taken"))
        self.assertEqual("mine", (self.folder / "taken" / "note.txt").read_text())

    def test_names_that_are_not_there_are_answered_with_the_nearest(self):
        experiment = TRELOAR / "experiment.json"
        self.assertIn("neo_hooke/lm", self.message(tunica.Problem, experiment, "neo_hook/lm"))
        self.assertIn("mu", self.message(tunica.simulate, experiment, "neo_hooke", {"mue": 1.0}))
        self.assertIn("neo_hooke", self.message(tunica.describe, "neo_hoke"))
        self.assertIn("fibre_dispersion", self.message(tunica.diagnose, experiment, mechanisms=["fibre_dispersionn"]))
        with self.assertRaises(KeyError):
            tunica.Table({"stretch [1]": []})["stress"]

    def test_an_input_error_is_a_value_error(self):
        with self.assertRaises(ValueError):
            tunica.read({})
