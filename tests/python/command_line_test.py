# SPDX-License-Identifier: Apache-2.0
"""What Python computes is what the command line computes, bit for bit."""
import json
import os

import numpy

import tunica
from support import EXAMPLES, TRELOAR, Case, of_treloar, program, result_of, rows_of


class CommandLine(Case):
    def test_a_run_writes_the_same_result_and_the_same_evaluations(self):
        for example in ("treloar/experiment.json", "lamb_aorta/experiment.json"):
            with self.subTest(example):
                name = example.split("/")[0]
                program("run", EXAMPLES / example, "-o", self.folder / f"{name}-program", "-j", 1, "--quiet")
                tunica.run(EXAMPLES / example, self.folder / f"{name}-python", threads=2)
                one, other = self.folder / f"{name}-program", self.folder / f"{name}-python"
                self.assertEqual(result_of(one), result_of(other))
                self.assertEqual((one / "input.json").read_bytes(), (other / "input.json").read_bytes())
                for table in sorted(one.glob("*.csv")):
                    self.assertEqual(rows_of(table), rows_of(other / table.name), table.name)

    def test_a_dictionary_is_the_file_that_it_would_be(self):
        experiment = of_treloar({"type": "yeoh"})
        (self.folder / "experiment.json").write_text(json.dumps(experiment))
        for table in TRELOAR.glob("*.csv"):
            (self.folder / table.name).write_bytes(table.read_bytes())
        program("run", self.folder / "experiment.json", "-o", self.folder / "file", "--quiet")
        tunica.run(experiment, self.folder / "dictionary", base=self.folder)
        # One sentence names what was run, `tunica diagnose <file>`.
        self.assertEqual(json.dumps(result_of(self.folder / "file")).replace("experiment.json", "<dict>"),
                         json.dumps(result_of(self.folder / "dictionary")))

    def test_arguments_do_what_the_options_of_the_program_do(self):
        experiment = TRELOAR / "experiment.json"
        program("run", experiment, "-o", self.folder / "a", "--seed", 7, "--profiles", "mu", "--bootstrap", 40,
                "--no-certificate", "--quiet")
        tunica.run(experiment, self.folder / "b", seed=7, profiles=["mu"], bootstrap=40, certificate=False)
        self.assertEqual(result_of(self.folder / "a"), result_of(self.folder / "b"))

    def test_draws_from_the_posterior_are_those_of_the_program(self):
        experiment = of_treloar({"type": "yeoh"})
        (self.folder / "experiment.json").write_text(json.dumps(experiment))
        for table in TRELOAR.glob("*.csv"):
            (self.folder / table.name).write_bytes(table.read_bytes())
        path = self.folder / "experiment.json"
        program("run", path, "-o", self.folder / "a", "--posterior", "--no-certificate", "--quiet")
        run = tunica.run(path, self.folder / "b", posterior=True, certificate=False)
        self.assertEqual(result_of(self.folder / "a"), result_of(self.folder / "b"))
        draws = run.posterior["c10"]
        self.assertEqual(draws.shape, (4, 1000))
        low, high = run.parameters["c10"].about["posterior_ci95"]
        self.assertAlmostEqual(((draws >= low) & (draws <= high)).mean(), 0.95, delta=0.001)
        self.assertIsNone(tunica.run(path, self.folder / "c", certificate=False).posterior)
        beside = tunica.run(path, self.folder / "d", posterior=800, discrepancy=True, certificate=False).best
        self.assertEqual(beside.best["posterior"]["draws"], 800)
        self.assertIn("discrepancy", beside.best["posterior"])

    def test_paired_starts_are_those_of_the_program(self):
        experiment = of_treloar({"type": "yeoh"})
        experiment["optimizers"]["slsqp"] = {"type": "nlopt", "algorithm": "slsqp", "starts": 5}
        experiment["runs"].append({"model": "rubber", "optimizer": "slsqp"})
        (self.folder / "experiment.json").write_text(json.dumps(experiment))
        for table in TRELOAR.glob("*.csv"):
            (self.folder / table.name).write_bytes(table.read_bytes())
        path = self.folder / "experiment.json"
        program("run", path, "-o", self.folder / "a", "--paired-starts", "--no-certificate", "--quiet")
        tunica.run(path, self.folder / "b", paired_starts=True, certificate=False)
        self.assertEqual(result_of(self.folder / "a"), result_of(self.folder / "b"))
        self.assertEqual(result_of(self.folder / "b")["runs"][0]["paired_with"], ["rubber/slsqp"])

    def test_check_says_what_the_program_says(self):
        experiment = EXAMPLES / "lamb_aorta" / "experiment.json"
        def timeless(found):
            for problem in found["problems"]:
                problem["initial"].pop("seconds")
            return found
        self.assertEqual(timeless(json.loads(program("check", experiment, "--json"))),
                         timeless(tunica.check(experiment)))
        self.assertTrue(tunica.check(experiment).in_order)

    def test_a_simulation_has_the_numbers_of_the_program(self):
        experiment = TRELOAR / "experiment.json"
        result = tunica.run(experiment, self.folder / "run")
        program("simulate", experiment, "--model", "yeoh", "--parameters", self.folder / "run" / "result.json", "-o",
                self.folder / "a", "--noise", 0.02, "--seed", 3)
        given = tunica.simulate(experiment, "yeoh", result, self.folder / "b", noise=0.02, seed=3)
        by_run = tunica.simulate(experiment, "yeoh", result.runs["yeoh/lm"], noise=0.02, seed=3)
        self.assertIn("<iframe", given._repr_html_())
        self.assertIn("<table>", by_run._repr_html_())
        for test in ("uniaxial", "equibiaxial", "pure_shear"):
            self.assertEqual((self.folder / "a" / f"{test}.csv").read_bytes(),
                             (self.folder / "b" / f"{test}.csv").read_bytes())
            written = tunica.Table.read(self.folder / "a" / f"{test}.csv")
            for column, values in given[test].items():
                numpy.testing.assert_array_equal(values, written[column])
                numpy.testing.assert_array_equal(values, by_run[test][column])

    def test_a_card_is_that_of_the_program(self):
        result = tunica.run(TRELOAR / "experiment.json", self.folder / "run")
        for to in ("calculix", "abaqus"):
            for run in ("yeoh/lm", "neo_hooke/lm"):
                self.assertEqual(program("export", result.directory, "--to", to, "--run", run, "--units", "mm-mN-kPa"),
                                 result.runs[run].card(to, units="mm-mN-kPa"))
        self.assertEqual(result.card("calculix", units="mm-mN-kPa"), result.best.card("calculix", units="mm-mN-kPa"))
        with self.assertRaises(tunica.InputError):
            result.best.card("nastran")
        self.assertEqual(program("export", result.directory, "--to", "lsdyna", "--run", "yeoh/lm", "--density", "1000 kg/m3"),
                         result.runs["yeoh/lm"].card("lsdyna", density="1000 kg/m3"))
        with self.assertRaisesRegex(KeyError, "no parameter 'c9'; there are: c10, c20, c30"):
            result.runs["yeoh/lm"].parameters["c9"]
        with self.assertRaisesRegex(KeyError, "no test 'torsion'; there are: uniaxial"):
            result.best.fit["torsion"]

    def test_a_diagnosis_has_the_verdict_of_the_program(self):
        experiment = EXAMPLES / "treloar_cause" / "experiment.json"
        program("diagnose", experiment, "--quick", "-o", self.folder / "a", "--quiet")
        stages = []
        found = tunica.diagnose(experiment, self.folder / "b", quick=True,
                                progress=lambda share, stage: stages.append((share, stage)))
        self.assertEqual(result_of(self.folder / "a"), result_of(self.folder / "b"))
        for table in sorted((self.folder / "a").glob("*.csv")):
            self.assertEqual(table.read_bytes(), (self.folder / "b" / table.name).read_bytes(), table.name)
        self.assertEqual("discovered", found.verdict)
        self.assertEqual([], found.causes)
        self.assertTrue(found.extended.exists())
        self.assertEqual(1, stages[-1][0])

    def test_a_discovery_has_the_terms_of_the_program(self):
        experiment = EXAMPLES / "treloar_discovery" / "experiment.json"
        program("discover", experiment, "--from-nothing", "--most-terms", 2, "-o", self.folder / "a", "--quiet")
        found = tunica.discover(experiment, self.folder / "b", from_nothing=True, most_terms=2)
        self.assertEqual(result_of(self.folder / "a"), result_of(self.folder / "b"))
        self.assertEqual(2, len(found.terms))
        self.assertTrue(found.extended.exists())
        self.assertEqual(found.terms, tunica.open(self.folder / "b").terms)
        with self.assertRaisesRegex(tunica.InputError, "invariants: 'I3' is not known"):
            tunica.discover(experiment, invariants=["I3"])

    def test_results_are_arrays_and_numbers(self):
        result = tunica.run(of_treloar({"type": "neo_hooke"}), self.folder / "run", base=TRELOAR)
        mu = result.parameters["mu"]
        self.assertEqual("kPa", mu.unit)
        self.assertTrue(mu.ci95[0] < mu < mu.ci95[1])
        fit = result.best.fit["uniaxial"]
        # Of one parameter that enters linearly: the prediction of neo_hooke in uniaxial tension, P = mu (λ − λ⁻²).
        stretch = fit["stretch"]
        numpy.testing.assert_allclose(fit["stress.predicted"], mu * (stretch - stretch**-2), rtol=1e-9)
        self.assertEqual(result.json["runs"][0]["evaluations"], result.evaluations.rows)
        about = {"parameters": ["a", "b"], "values": [[4.0, 1.0], [1.0, 9.0]]}
        names, matrix = tunica.Run(result, {"best": {"covariance": about}}).covariance
        self.assertEqual((["a", "b"], (2, 2), 9.0), (names, matrix.shape, matrix[1, 1]))
        frame, table = result.frame(), fit.frame()
        self.assertEqual([("rubber/lm", "mu", float(mu))],
                         list(frame[["run", "parameter", "value"]].itertuples(index=False, name=None)))
        numpy.testing.assert_array_equal(table["stretch [1]"], stretch)
        again = tunica.open(self.folder / "run")
        self.assertEqual(result.parameters, again.parameters)

    def test_a_table_in_memory_is_the_file_that_it_came_from(self):
        experiment = of_treloar({"type": "yeoh"})
        of_files = tunica.run(experiment, self.folder / "files", base=TRELOAR)
        os.environ["XDG_CACHE_HOME"] = str(self.folder / "cache")
        self.addCleanup(os.environ.pop, "XDG_CACHE_HOME")
        kinds = {"uniaxial": lambda table: table, "equibiaxial": dict, "pure_shear": lambda table: table.frame()}
        for test, kind in kinds.items():
            data = experiment["tests"][test]["data"]
            data["table"] = kind(tunica.Table.read(TRELOAR / data.pop("file")))
        of_tables = tunica.run(experiment, self.folder / "tables")
        self.assertEqual({**of_files.parameters}, {**of_tables.parameters})
        self.assertEqual(3, len(list((self.folder / "cache" / "tunica").iterdir())))
        experiment["tests"]["uniaxial"]["data"]["table"] = {"stretch": [1.0, 2.0], "stress": [0.0]}
        with self.assertRaisesRegex(tunica.InputError, "/tests/uniaxial/data/table"):
            tunica.read(experiment)
