# SPDX-License-Identifier: Apache-2.0
"""A run over HTTP: what clients of UM-Bridge ask, and what they are told."""
import http.client
import json
import threading
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


def status_of(server, path="/Info", method="GET", **headers):
    """The status of a request whose headers are told one by one; Host unless given is that of the server."""
    connection = http.client.HTTPConnection(server.address.removeprefix("http://"), timeout=60)
    connection.putrequest(method, path, skip_host="Host" in headers, skip_accept_encoding=True)
    for name, value in headers.items():
        connection.putheader(name.replace("_", "-"), value)
    connection.endheaders()
    try:
        return connection.getresponse().status
    finally:
        connection.close()


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

    def test_requests_that_are_under_way_are_answered_before_the_end(self):
        under_way, go_on = threading.Event(), threading.Event()

        @tunica.model("served_slowly", {"mu": ("kPa", 400, 1, 1e4)})
        def energy(C, mu):
            if mu == 300:
                under_way.set()
                go_on.wait(60)
            return mu / 2 * (C.I1 - 3)
        self.addCleanup(tunica.forget, "served_slowly")
        self.addCleanup(go_on.set)
        server = tunica.serve(of_treloar({"type": "served_slowly"}), base=TRELOAR)
        answers, closed = [], threading.Event()
        question = {"name": "objective", "input": [[300.0]], "config": {}}
        client = threading.Thread(target=lambda: answers.append(asked(server, "/Evaluate", question)))
        client.start()
        self.assertTrue(under_way.wait(60))
        closing = threading.Thread(target=lambda: (server.close(), closed.set()))
        closing.start()
        self.assertFalse(closed.wait(1), "close() did not wait for the request")
        go_on.set()
        self.assertTrue(closed.wait(60))
        client.join()
        closing.join()
        self.assertEqual(1, len(answers[0]["output"]))

    def test_pages_of_other_sites_are_refused(self):
        with tunica.serve(of_treloar({"type": "yeoh"}), base=TRELOAR) as server:
            port = server.address.rpartition(":")[2]
            for host in (f"127.0.0.1:{port}", f"localhost:{port}", f"LOCALHOST:{port}", f"[::1]:{port}"):
                self.assertEqual(200, status_of(server, Host=host), host)
                self.assertEqual(200, status_of(server, Origin="http://" + host), host)
            for host in (f"evil.example:{port}", f"127.0.0.1.evil.example:{port}", f"192.0.2.1:{port}", "[::2]"):
                self.assertEqual(403, status_of(server, Host=host), host)
                self.assertEqual(403, status_of(server, Origin="https://" + host), host)
            self.assertEqual(403, status_of(server, Origin="null"))
            self.assertEqual(403, status_of(server, "/Evaluate", "POST", Origin="https://evil.example",
                                            Content_Length="0"))

    def test_lengths_that_cannot_be_are_refused(self):
        with tunica.serve(of_treloar({"type": "yeoh"}), base=TRELOAR) as server:
            self.assertEqual(200, status_of(server, "/Info?a=b"))
            self.assertEqual(411, status_of(server, "/Evaluate", "POST"))
            for length in ("-1", "\u00b2", "1e3", ""):
                self.assertEqual(411, status_of(server, "/Evaluate", "POST", Content_Length=length), length)
            # Three tests of a few dozen rows: their numbers are far from 1 MB.
            for length in (str(1 << 20), "9" * 30, "9" * 5000):
                self.assertEqual(413, status_of(server, "/Evaluate", "POST", Content_Length=length), length[:40])

    def test_a_port_is_a_whole_number(self):
        for port in ("x", "4242", 1.5, None):
            with self.assertRaisesRegex(tunica.InputError, "port: found .*, expected a whole number"):
                tunica.serve(of_treloar({"type": "yeoh"}), base=TRELOAR, port=port)

    def test_an_unknown_run_is_refused(self):
        with self.assertRaisesRegex(tunica.InputError, "no run 'gho/x'"):
            tunica.serve(of_treloar({"type": "yeoh"}), "gho/x", base=TRELOAR)


if __name__ == "__main__":
    unittest.main()
