#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Mutants of the project's own code: which changed operators, constants and statements would the tests notice?

    bench/mutants.py                              a sample of 150 in the calibration, diagnosis, discovery, models and mechanisms
    bench/mutants.py --sample 0 plugins/models    every mutant of a folder
    bench/mutants.py --again                      only those that survived, and those of files that have changed

Every source is compiled once, with all its mutants side by side; TUNICA_MUTANT chooses one. Only test cases that reach a
mutant are run against it, the quick ones first. Output: mutants.json and survivors.md in the folder `mutation/out` of the
build; what each case reaches is remembered in `mutation/reach.json`. Mutants that change nothing anybody can see are
listed in bench/mutation/equivalent.txt, with the reason.
Needs the Debian packages python3-clang-14, libclang-14-dev and libgtest-dev."""
import argparse
import concurrent.futures
import hashlib
import json
import pathlib
import random
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mutation import building, report, trials  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["core/src/calibration", "core/src/diagnosis", "core/src/discovery", "plugins/models", "plugins/mechanisms"]
PROGRAMS = ["test_mechanisms", "test_models", "test_diagnosis", "test_discover", "test_calibration", "test_cohort_diagnosis",
            "test_cli"]  # the program itself, which test_cli starts, runs core/src/calibration too
# What of the rest of the suite looks at these folders without starting a search.
COMMANDS = r"^(References\.baseline\.|Schema\.CommittedIsWhat|Conformance\.BuiltIn_|Docs\.PagePrintsWhatItShows)"


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", default=FOLDERS, help="folders of sources, or single sources")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/mutants", help="its own build folder")
    parser.add_argument("--tests", default=",".join(PROGRAMS), metavar="A,B", help="test programs to run")
    parser.add_argument("--ctest", default=COMMANDS, metavar="REGEX", help="tests of CTest to run beside them; '': none")
    parser.add_argument("--sample", type=int, default=150, help="mutants to try; 0: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", metavar="REGEX", help="only mutants whose file, line, text or words match")
    parser.add_argument("--budget", type=float, default=120, help="seconds of test cases for one mutant")
    parser.add_argument("--again", action="store_true", help="keep what an unchanged file's killed mutants have shown")
    parser.add_argument("--build-only", action="store_true")
    parser.add_argument("--no-build", action="store_true", help="run what has been built")
    parser.add_argument("--out", type=pathlib.Path, help="where the results go")
    parser.add_argument("-j", "--jobs", type=int, default=2)
    chosen = parser.parse_args()
    chosen.tests = chosen.tests.split(",")
    return chosen


def sampled(mutants, chosen):
    if not chosen.sample or chosen.sample >= len(mutants):
        return mutants
    return random.Random(chosen.seed).sample(mutants, chosen.sample)


def try_all(mutants, cases, chosen, known):
    """The verdict on each mutant; with --again, killed ones keep theirs."""
    verdicts = []
    with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
        waiting = []
        for mutant in mutants:
            before = known.get(report.key(mutant))
            if before and before["verdict"] == "killed":
                verdicts.append(before)
            else:
                waiting.append(pool.submit(trials.attempt, mutant, cases, chosen.budget))
        for done, future in enumerate(concurrent.futures.as_completed(waiting), 1):
            found = future.result()
            verdicts.append(found)
            print(f"  [{done}/{len(waiting)}] {found['verdict']:12} {found['file']}:{found['line']} {found['mutant']}: "
                  f"{found['text']}", flush=True)
    return verdicts


def main():
    chosen = options()
    build = chosen.build.resolve()
    state = build / "mutation"
    out = chosen.out or state / "out"
    if not chosen.no_build:
        building.configure(ROOT, build)
    found = building.prepare(ROOT, build, [folder.rstrip("/") for folder in chosen.folders], chosen.jobs)
    mutants = [mutant for mutant in building.mutants(ROOT, found)
               if not chosen.only or re.search(chosen.only, f"{mutant['file']}:{mutant['line']} {report.place(mutant)}")]
    print(f"{len(mutants)} mutants in {len(found)} files", flush=True)
    if not chosen.no_build:
        building.compile(build, chosen.tests)
    if chosen.build_only or not mutants:
        return 0
    programs = [str(build / "bin" / name) for name in chosen.tests]
    programs += trials.commands(build, chosen.ctest) if chosen.ctest else []
    copies = hashlib.sha256(json.dumps(sorted((name, entry["hash"]) for name, entry in found.items())).encode()).digest()
    cases = trials.reach(programs, copies, state, chosen.jobs)
    known = report.load(out / "mutants.json") if chosen.again else {}
    verdicts = try_all(sampled(mutants, chosen), cases, chosen, known)
    print(report.write(out, verdicts, report.reasons(ROOT / "bench/mutation/equivalent.txt")))
    print(f"written: {out / 'mutants.json'}, {out / 'survivors.md'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
