# SPDX-License-Identifier: Apache-2.0
"""A run over HTTP: what clients of UM-Bridge ask, and what they are told."""
import json
import unittest
import urllib.error
import urllib.request

import numpy

import tunica
from support import EXAMPLES, TRELOAR, Case, of_treloar


def asked(server, path, question=None):
    body = None if question is None else json.dumps(question).encode()
    with urllib.request.urlopen(server.address + path, body, timeout=60) as reply:
        return json.load(reply)


class Served(Case):
    def test_answers_are_those_of_the_problem(self):
        file = EXAMPLES / "lamb_aorta" / "experiment.json"
        problem = tunica.Problem(file)
        x = problem.initial
        with tunica.serve(file) as server:
            self.assertEqual(problem.names, server.names)
            self.assertEqual(["objective", "predictions", "residuals"], sorted(asked(server, "/Info")["models"]))
            answer = asked(server, "/Evaluate", {"name": "objective", "input": [list(x)], "config": {}})
            self.assertEqual([[problem.objective(x)]], answer["output"])
            gradient = asked(server, "/Gradient", {"name": "objective", "inWrt": 0, "outWrt": 0, "input": [list(x)],
                                                   "sens": [1.0], "config": {}})
            numpy.testing.assert_allclose(gradient["output"], problem.gradient(x), rtol=1e-12)
        with self.assertRaises(urllib.error.URLError):
            asked(server, "/Info")

    def test_a_model_of_python_takes_part(self):
        @tunica.model("served_neo_hooke", {"mu": ("kPa", 400, 1, 1e4)})
        def energy(C, mu):
            return mu / 2 * (C.I1 - 3)
        self.addCleanup(tunica.forget, "served_neo_hooke")
        experiment = of_treloar({"type": "served_neo_hooke"})
        with tunica.serve(experiment, base=TRELOAR) as server:
            answer = asked(server, "/Evaluate", {"name": "objective", "input": [[300.0]], "config": {}})
            self.assertEqual([[tunica.Problem(experiment, base=TRELOAR).objective([300.0])]], answer["output"])

    def test_a_wrong_question_is_answered_with_its_reason(self):
        with tunica.serve(of_treloar({"type": "yeoh"}), base=TRELOAR) as server:
            with self.assertRaises(urllib.error.HTTPError) as refused:
                asked(server, "/Evaluate", {"name": "objective", "input": [[1.0]], "config": {}})
            self.assertEqual(400, refused.exception.code)
            with refused.exception as reply:
                self.assertEqual("InvalidInput", json.load(reply)["error"]["type"])
            with self.assertRaisesRegex(tunica.InputError, "cannot listen at 127.0.0.1, port .* Name another port"):
                tunica.serve(of_treloar({"type": "yeoh"}), base=TRELOAR, port=int(server.address.rpartition(":")[2]))

    def test_an_unknown_run_is_refused(self):
        with self.assertRaisesRegex(tunica.InputError, "no run 'gho/x'"):
            tunica.serve(of_treloar({"type": "yeoh"}), "gho/x", base=TRELOAR)


if __name__ == "__main__":
    unittest.main()
