# SPDX-License-Identifier: Apache-2.0
"""How the mutants of a source are written side by side: mutation_test.py BENCH."""
import pathlib
import sys
import tempfile

sys.path.insert(0, sys.argv[1])
from mutation import report, schemata, trials  # noqa: E402


class Place:
    def __init__(self, kind, begin, end, mutants, operator=(), type=""):
        self.kind, self.begin, self.end, self.mutants = kind, begin, end, mutants
        self.operator, self.type = operator, type


def check(found, expected):
    if found != expected:
        sys.exit(f"found\n  {found}\nexpected\n  {expected}")


# Operators nest, each operand is written once, and every line keeps its number.
text = b"x = a +\n b * 2;"
places = [Place("statement", 0, 15, ("statement left out",)), Place("add", 4, 14, ("+ turned round",), operator=(5, 9)),
          Place("multiply", 9, 14, ("* turned round",), operator=(10, 13)),
          Place("whole_from_one", 13, 14, ("one more", "one less"), type="int")]
first = schemata.first_number("x.cpp")
check(schemata.instrumented(text, schemata.numbered("x.cpp", places)).decode(),
      f"{{ if (!tunica_mutant::is({first})) x = tunica_mutant::add({first + 1}, a, \n"
      f"tunica_mutant::multiply({first + 2}, b, tunica_mutant::whole_from_one<int>({first + 3}, 2))); }}")

# What does not compile is found again in the copy.
copy = schemata.instrumented(text, schemata.numbered("x.cpp", places))
check([place.kind for place in schemata.around(places, "x.cpp", text, [copy.index(b"whole")])], ["whole_from_one"])

# Quick cases come first, a round as long as what was spent before it, and none beyond the budget.
cases = [("p", "slow", 50, {1}), ("p", "quick", 1, {1}), ("p", "middle", 3, {1}), ("p", "other", 1, {2}), ("p", "small", 0.5, {1}),
         ("p", "never", 200, {1})]
rounds = []


def noticed_by(culprit):
    def run(program, names, mutant, limit):
        rounds.append(names)
        return culprit in names, sum(case[2] for case in cases if case[1] in names)
    return run


trials.run = noticed_by("nobody")
verdict = trials.attempt({"number": 1}, cases, 60)
check(rounds, [["small", "quick"], ["middle"], ["slow"]])
check((verdict["verdict"], verdict["cases"], verdict["of"]), ("survived", 4, 5))
rounds.clear()
trials.run = noticed_by("middle")
check(trials.attempt({"number": 1}, cases, 60)["verdict"], "killed")
check(rounds, [["small", "quick"], ["middle"]])
check(trials.attempt({"number": 3}, cases, 60)["verdict"], "not reached")

# A reason belongs to a place, whatever lines are added before it.
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "equivalent.txt"
    file.write_text("# a remark\nx.cpp | y = 2; | 2 | constant changed -- nobody sees it\n")
    reasons = report.reasons(file)
    mutant = {"number": first, "hash": "", "file": "x.cpp", "line": 7, "source": "y = 2;", "text": "2",
              "mutant": "constant changed", "verdict": "survived", "cases": 3, "of": 3}
    words = report.write(pathlib.Path(folder), [mutant, {**mutant, "number": first + 1, "verdict": "killed"}], reasons)
    if "killed 1 of 2 (50.0 %)" not in words or "1 listed with a reason: without those 1 of 1 (100.0 %)" not in words:
        sys.exit(words)
