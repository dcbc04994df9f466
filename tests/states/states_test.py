#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""states_test.py TUNICA: sheets of one wall, relaxed and contracted, with ten parameters that they share and one that
differs. The data are simulated with noise of a stated seed."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

tunica = str(pathlib.Path(sys.argv[1]).resolve())
TERMS = [{"name": "m", "invariant": "I1", "law": "exponential"},
         {"name": "n", "invariant": "I2", "law": "linear"},
         {"name": "f", "invariant": "fibre", "family": "diagonal", "law": "exponential_square"},
         {"name": "a", "invariant": "fibre", "family": "axial", "law": "exponential_square"},
         {"name": "c", "invariant": "fibre", "family": "circumferential", "law": "exponential_square"}]
TONE = 18.0  # kPa


def stretches(kind, rows=25):
    for i in range(rows):
        x = 0.35 * (i + 1) / rows
        yield {"both": (1 + x, 1 + x), "around": (1 + x, 1 + 0.3 * x), "along": (1 + 0.3 * x, 1 + x)}[kind]


class States(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def tunica(self, *arguments, expect=0):
        done = subprocess.run([tunica, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=500)
        said = " ".join((done.stdout + done.stderr).split())
        self.assertEqual(expect, done.returncode, said)
        return said

    def write(self, name, experiment):
        (self.folder / name).write_text(json.dumps(experiment), encoding="utf-8")

    def sheets(self, tests):
        """Tests of sheets, by name: (kind, state or none); their rows are written."""
        entries = {}
        for name, (kind, state) in tests.items():
            rows = "".join(f"{t},{z},100,100\n" for t, z in stretches(kind))
            (self.folder / f"{name}.csv").write_text("t,z,st [kPa],sz [kPa]\n" + rows, encoding="utf-8")
            entries[name] = {"type": "biaxial",
                             "data": {"file": f"{name}.csv", "order": "loading",
                                      "columns": {"stretch_circumferential": "t", "stretch_axial": "z",
                                                  "stress_circumferential": "st", "stress_axial": "sz"},
                                      "noise": {"relative": "1 %"}}}
            if state:
                entries[name]["state"] = state
        return entries

    def simulated(self, experiment, values):
        """The experiment with data that are its own prediction and noise."""
        self.write("truth.json", experiment)
        self.write("values.json", values)
        self.tunica("simulate", "truth.json", "--parameters", "values.json", "--noise", 0.01, "--seed", 5, "-o", "data")
        for name in experiment["tests"]:
            (self.folder / f"{name}.csv").write_text((self.folder / "data" / f"{name}.csv").read_text("utf-8"), "utf-8")

    @staticmethod
    def frame(models, tests, **more):
        return {"format": 1, "seed": 3, "models": models, "tests": tests, "objective": "least_squares",
                "optimizers": {"lm": {"type": "ceres_lm", "starts": 4}}, "stop": {"max_evaluations": 3000},
                "runs": [{"model": next(iter(models)), "optimizer": "lm"}], **more}

    def wall(self):
        return {"wall": {"type": "composed", "terms": TERMS,
                         "mechanisms": [{"type": "active_tone", "parameters": {"tone": {"fixed": 0}}}]}}

    SHARED = {"m_mu": 20, "m_b": 0.6, "n_mu": 4, "f_k1": 25, "f_k2": 0.7, "f_theta": 38, "a_k1": 9, "a_k2": 1.1, "c_k1": 14,
              "c_k2": 0.9}
    BOTH = {"relaxed_both": ("both", None), "relaxed_around": ("around", None), "relaxed_along": ("along", None),
            "contracted_both": ("both", "contracted"), "contracted_around": ("around", "contracted")}
    CONTRACTED = {"contracted": {"doc": "20 mM of potassium", "parameters": {"active_tone.tone": {"max": "100 kPa"}}}}

    def test_ten_shared_parameters_and_one_that_differs(self):
        experiment = self.frame(self.wall(), self.sheets(self.BOTH), states=self.CONTRACTED)
        self.simulated(experiment, {**self.SHARED, "contracted.active_tone.tone": TONE})
        self.write("experiment.json", experiment)
        said = self.tunica("run", "experiment.json", "-o", "out", "--no-certificate")
        best = json.loads((self.folder / "out/result.json").read_text("utf-8"))["runs"][0]["best"]
        self.assertEqual(len(best["parameters"]), 11)
        tone = best["parameters"]["contracted.active_tone.tone"]
        half = (tone["ci95"][1] - tone["ci95"][0]) / 2
        self.assertLess(half, 0.1 * TONE)
        self.assertLess(abs(tone["value"] - TONE), 2 * half)  # once in 10 000 seeds not
        difference = tone["difference"]
        self.assertEqual((difference["state"], difference["from"]), ("contracted", "active_tone.tone"))
        self.assertAlmostEqual(difference["value"], tone["value"])  # the tone of the relaxed wall is held at 0
        self.assertAlmostEqual(difference["ci95"][0], tone["ci95"][0])
        self.assertIn("active_tone.tone +", said)
        # What is written down reads as it was.
        self.tunica("check", "out/input.json")

    def test_a_difference_has_the_interval_of_both(self):
        models = {"wall": {"type": "gho", "parameters": {"kappa": {"fixed": 0.1}}}}
        values = {"mu": 20, "k1": 25, "k2": 0.7, "theta": 42}
        treated = {"treated": {"parameters": {"k1": {}}}}
        experiment = self.frame(models, self.sheets({"before": ("both", None), "before_2": ("around", None),
                                                     "after": ("both", "treated"), "after_2": ("along", "treated")}),
                                states=treated)
        self.simulated(experiment, {**values, "treated.k1": 15})
        self.write("experiment.json", experiment)
        self.tunica("run", "experiment.json", "-o", "out", "--no-certificate")
        best = json.loads((self.folder / "out/result.json").read_text("utf-8"))["runs"][0]["best"]
        own, shared = best["parameters"]["treated.k1"], best["parameters"]["k1"]
        difference = own["difference"]
        self.assertAlmostEqual(difference["value"], own["value"] - shared["value"])
        low, high = difference["ci95"]
        self.assertLess(abs(difference["value"] + 10), high - low)  # four standard errors: once in 10 000 seeds not
        self.assertLess(high, 0)
        # Its interval is that of the covariance, narrower than both together where they move together.
        names = best["covariance"]["parameters"]
        i, j = names.index("treated.k1"), names.index("k1")
        cov = best["covariance"]["values"]
        ratio = (cov[i][i] + cov[j][j] - 2 * cov[i][j]) / cov[i][i]
        half = (own["ci95"][1] - own["ci95"][0]) / 2
        self.assertAlmostEqual((high - low) / 2, half * ratio ** 0.5, delta=0.02 * half)

    def test_another_state_that_the_file_does_not_say_is_found(self):
        """One sheet was stiffer in one parameter; the diagnosis names it, and writes the experiment that says so."""
        models = {"wall": {"type": "composed", "terms": TERMS}}
        tests = {"both": ("both", None), "around": ("around", None), "along": ("along", None), "late": ("both", "hidden"),
                 }
        truth = self.frame(models, self.sheets(tests), states={"hidden": {"parameters": {"f_k1": {}}}})
        self.simulated(truth, {**self.SHARED, "hidden.f_k1": 45})
        blind = json.loads(json.dumps(truth))
        del blind["states"], blind["tests"]["late"]["state"]
        blind["diagnosis"] = {"model": "wall"}
        self.write("experiment.json", blind)
        said = self.tunica("diagnose", "experiment.json", "-o", "out")
        found = json.loads((self.folder / "out/result.json").read_text("utf-8"))["diagnosis"]
        self.assertEqual(found["verdict"], "leading", said)
        self.assertEqual(found["budget"]["lead"]["id"], "another_state")
        state = found["budget"]["state"]
        self.assertEqual(state["test"], "late")
        self.assertIn("as a state of its own, f_k1 is", said)
        self.assertEqual([one["parameter"] for one in state["changes"]], ["f_k1"])
        self.assertLess(abs(state["changes"][0]["in_state"] / 45 - 1), 0.1)
        extended = json.loads((self.folder / "out/extended.json").read_text("utf-8"))
        self.assertEqual(extended["tests"]["late"]["state"], state["name"])
        self.tunica("run", "out/extended.json", "-o", "again", "--no-certificate")
        best = json.loads((self.folder / "again/result.json").read_text("utf-8"))["runs"][0]["best"]
        low, high = best["parameters"][f"{state['name']}.f_k1"]["difference"]["ci95"]
        self.assertTrue(low < 20 < high, (low, high))

    def test_a_parameter_is_named_with_its_model_or_without(self):
        """A run of one model leaves the model's name out; what no model of the run has is said, name by name."""
        models = {"wall": {"type": "gho", "parameters": {"kappa": {"fixed": 0.1}}}, "plain": {"type": "neo_hooke"}}
        experiment = self.frame(models, self.sheets({"before": ("both", None), "after": ("around", "treated")}), runs=[
            {"model": name, "optimizer": "lm"} for name in models],
            states={"treated": {"parameters": {"wall.mu": {"max": 70}, "mu": {}, "k1": {}}}}, stop={"max_evaluations": 20})
        self.write("experiment.json", experiment)
        self.tunica("run", "experiment.json", "-o", "out", "--no-certificate", "-j", 1)
        result = json.loads((self.folder / "out/result.json").read_text("utf-8"))
        wall, plain = ({run["run"]: run for run in result["runs"]}[f"{name}/lm"] for name in models)
        self.assertEqual(["treated.k1", "treated.mu"], sorted(n for n in wall["best"]["parameters"] if "treated" in n))
        self.assertEqual(["treated.mu"], sorted(name for name in plain["best"]["parameters"] if "treated" in name))
        self.assertEqual(70, wall["best"]["parameters"]["treated.mu"]["max"])  # the name with the model's counts first
        said = sorted(text for text in result["warnings"] if "no model of it has that parameter" in text)
        self.assertEqual(2, len(said), said)  # of the run of the other model
        for name, text in zip(("k1", "wall.mu"), said):
            self.assertIn("in a run of plain", text)
            self.assertIn(f"'{name}'", text)

    def test_a_name_without_a_model_is_that_of_every_layer(self):
        models = {"media": {"type": "neo_hooke"}, "adventitia": {"type": "neo_hooke"}}
        tube = {"type": "thick_wall_pressurisation", "inner_radius": 2, "axial_stretch": 1.2,
                "layers": [{"model": name, "thickness": 0.4} for name in models]}
        columns = {"pressure": "p", "outer_diameter_stretch": "d"}
        tests = {name: {**tube, "data": {"file": f"{name}.csv", "columns": columns, "noise": {"relative": "1 %"}}}
                 for name in ("before", "after")}
        tests["after"]["state"] = "treated"
        for name in tests:
            rows = "".join(f"{p},{1 + p / 20}\n" for p in range(1, 9))
            (self.folder / f"{name}.csv").write_text("p [kPa],d\n" + rows, "utf-8")
        experiment = self.frame(models, tests, states={"treated": {"parameters": {"mu": {}}}}, runs=[{"optimizer": "lm"}])
        self.simulated(experiment, {"media.mu": 60, "adventitia.mu": 40, "treated.media.mu": 80, "treated.adventitia.mu": 50})
        for named, own in (("mu", ["treated.adventitia.mu", "treated.media.mu"]), ("media.mu", ["treated.media.mu"])):
            experiment["states"]["treated"]["parameters"] = {named: {}}
            self.write("layers.json", experiment)
            self.tunica("run", "layers.json", "-o", f"fitted {named}", "--no-certificate", "-j", 1)
            result = json.loads((self.folder / f"fitted {named}" / "result.json").read_text("utf-8"))
            found = result["runs"][0]["best"]["parameters"]
            self.assertEqual(own, sorted(name for name in found if name.startswith("treated")))
            self.assertFalse([text for text in result["warnings"] if "no model of it has" in text])

    def refused(self, **more):
        experiment = self.frame({"wall": {"type": "gho"}}, self.sheets({"one": ("both", more.pop("state", None))}), **more)
        self.write("experiment.json", experiment)
        return self.tunica("check", "experiment.json", expect=2)

    def test_what_is_no_state_is_refused(self):
        self.assertIn("and the experiment has no \"states\"", self.refused(state="relaxed"))
        self.assertIn("unknown parameter 'muu' of state 'relaxed'",
                      self.refused(state="relaxed", states={"relaxed": {"parameters": {"muu": {}}}}))
        self.assertIn("Did you mean 'mu'?",
                      self.refused(state="relaxed", states={"relaxed": {"parameters": {"muu": {}}}}))
        self.assertIn("no test is in the state 'other'", self.refused(
            state="relaxed", states={"relaxed": {"parameters": {"mu": {}}}, "other": {"parameters": {"mu": {}}}}))
        self.assertIn("differs in no parameter", self.refused(state="relaxed", states={"relaxed": {"parameters": {}}}))
        self.assertIn("has the name of a model, a mechanism or a test",
                      self.refused(state="wall", states={"wall": {"parameters": {"mu": {}}}}))
        self.assertIn("is not below max", self.refused(
            state="relaxed", states={"relaxed": {"parameters": {"mu": {"min": "1 MPa", "max": "900 kPa"}}}}))


unittest.main(argv=sys.argv[:1])
