# SPDX-License-Identifier: Apache-2.0
"""What docs/python.md shows works as it stands, one piece after the other in the same session."""
import contextlib
import io
import os
import pathlib
import re
import shutil

import numpy
import scipy.optimize

import tunica
from support import EXAMPLES, TRELOAR, Case, of_treloar

ROOT = pathlib.Path(os.environ["TUNICA_PAGES"])


def pieces(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", (ROOT / page).read_text(), re.DOTALL | re.MULTILINE)


class Pages(Case):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        shutil.copytree(EXAMPLES / "lamb_aorta", "examples/lamb_aorta")
        for file in TRELOAR.iterdir():
            if file.is_file():
                shutil.copy(file, ".")
        pathlib.Path("examples/lamb_aorta/first.json").write_text(pieces("README.md", "json")[0])

    def test_every_piece_runs(self):
        experiment = of_treloar({"type": "my_neo_hooke"})
        session = {"numpy": numpy, "scipy": scipy, "experiment": experiment}
        shown = pieces("docs/python.md", "python")
        printed = []
        for piece in shown:
            with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()):
                exec(compile(piece, "docs/python.md", "exec"), session)
            printed.append(out.getvalue())
        self.assertEqual(8, len(shown))
        self.assertEqual(5, len(shown[0].splitlines()), "the example of the README in five lines")
        self.assertRegex(printed[0], r"^gho/(lm|es) \{'mu': ")
        self.assertRegex(printed[1], r"^\{'c10': ")
        self.assertAlmostEqual(1, session["result"].parameters["mu"] / 404.37141701523916, 8)
        # μ/2 (I1 − 3 − 2 ln J) + K/2 ln²J: nothing at rest, and K ln J/c beside μ (1 − 1/c) in a body of C = c 1.
        foam, stretch = tunica.Material("my_foam", mu=20.0, K=50.0), numpy.array([1.0, 1.1])
        found = foam.stress(stretches=numpy.stack([stretch] * 3, axis=1))[:, 0, 0]
        numpy.testing.assert_allclose(found, 20 * (1 - stretch**-2) + 50 * 3 * numpy.log(stretch) / stretch**2,
                                      atol=1e-12)
        # What is defined takes part.
        experiment["models"]["rubber"]["mechanisms"] = [{"type": "crosslinks"}]
        experiment["tests"]["uniaxial"]["mechanisms"] = [{"type": "offset"}]
        experiment["optimizers"]["lm"] = {"type": "nelder_mead_of_scipy"}
        result = tunica.run(experiment, "changed")
        self.assertEqual({"mu", "crosslinks.c", "uniaxial.offset.offset"}, set(result.parameters))
        self.assertLess(result.best.objective, session["result"].best.objective)

    def test_the_balloon_is_the_closed_form(self):
        exec(compile("import numpy, tunica\n" + next(piece for piece in pieces("docs/python.md", "python")
                                                     if "balloon" in piece), "docs/python.md", "exec"), {})
        stretch = numpy.linspace(1.05, 3, 20)
        # Thin sphere of a neo-Hookean sheet: p = 2 (h/r) mu (1/λ − 1/λ⁷), h/r at rest.
        mu, thickness = 30.0, 0.04
        pressure = 2 * thickness * mu * (1 / stretch - stretch**-7)
        result = tunica.run({
            "format": 1, "models": {"rubber": {"type": "neo_hooke"}},
            "tests": {"balloon": {"type": "balloon", "parameters": {"thickness": {"fixed": thickness}},
                                  "data": {"table": {"stretch": stretch, "pressure": pressure},
                                           "columns": {"stretch": "stretch", "pressure": "pressure"}}}},
            "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm"}},
            "runs": [{"model": "rubber", "optimizer": "lm"}]}, "balloon")
        self.assertAlmostEqual(1, result.parameters["mu"] / mu, 6)
