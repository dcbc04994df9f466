# SPDX-License-Identifier: Apache-2.0
"""The stubs say what is there: mypy compares them with the package."""
import subprocess
import sys

import tunica
from support import TRELOAR, Case, of_treloar
from tunica import result_types as types

# Names of other libraries that the modules import, which are no part of the package; and the module of types, which is
# its own stub.
FOREIGN = r"""tunica\.(declarations|problem)\.NamedTuple
tunica\.table\.Mapping.*
tunica\.result_types\..*
"""
USE = """
import tunica
result = tunica.run({"format": 1}, threads=2, progress=lambda share, text: None)
value: float = result.parameters["mu"]
low = (result.parameters["mu"].ci95 or (0.0, 0.0))[0]
ended: bool = result.best.json["ending_code"] == "converged" and result.best.best["covariance"] is not None
named = [cause["amplitude"]["value"] for cause in tunica.diagnose("experiment.json").causes]
@tunica.model("typed", {"mu": ("kPa", 1, 0.1, 10)})
def energy(C: tunica.Strain, mu: float) -> object:
    return mu * C.I1
problem = tunica.Problem("experiment.json", coordinates="unit")
problem.evaluate(problem.initial, jacobian=True).jacobian
"""


class Types(Case):
    def mypy(self, *arguments, ignore_errors=False):
        (self.folder / "mypy.ini").write_text(f"[mypy]\nignore_missing_imports = True\n"
                                              f"ignore_errors = {ignore_errors}\n")
        return subprocess.run([sys.executable, "-B", "-m", *arguments], capture_output=True, text=True, cwd=self.folder,
                              check=False)

    def test_stubs_are_those_of_the_package(self):
        (self.folder / "foreign").write_text(FOREIGN)
        found = self.mypy("mypy.stubtest", "tunica", "--ignore-missing-stub", "--concise", "--mypy-config-file",
                          "mypy.ini", "--allowlist", "foreign", "--ignore-unused-allowlist", ignore_errors=True)
        self.assertEqual(0, found.returncode, found.stdout + found.stderr)

    def test_a_user_is_told_of_wrong_types(self):
        (self.folder / "right.py").write_text(USE)
        (self.folder / "wrong.py").write_text(USE + "tunica.run(7)\nproblem.objectiv([1.0])\n"
                                             'result.best.best["akaike"]\nresult.best.json["ending_code"] == "clean"\n')
        right, wrong = (self.mypy("mypy", "--strict", "--config-file", "mypy.ini", f"{name}.py")
                        for name in ("right", "wrong"))
        self.assertEqual(0, right.returncode, right.stdout)
        codes = [line.rpartition("[")[2].rstrip("]") for line in wrong.stdout.splitlines() if "error:" in line]
        self.assertEqual(["arg-type", "attr-defined", "typeddict-item", "comparison-overlap"], codes)

    def test_documents_have_the_keys_of_their_types(self):
        experiment = of_treloar({"type": "neo_hooke"}, evaluations=50)
        checked = tunica.check(experiment, base=TRELOAR)
        self.assertEqual(set(types.Check.__annotations__), set(checked))
        run = tunica.run(experiment, self.folder / "out", base=TRELOAR, certificate=False).best
        for found, declared in ((run.json, types.Run), (run.best, types.Best), (run.parameters["mu"].about, types.Estimate)):
            self.assertLessEqual(set(found), set(declared.__annotations__))
        self.assertEqual(set(types.DescribedModel.__annotations__) - {"formula"}, set(tunica.describe("hgo")) - {"formula"})
