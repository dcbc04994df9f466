#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The blind benchmark of discovery, one command: hide terms of energies, let tunica look for them, then open the sealed
truths and count.

    bench/terms.py OUT                   development seed 101, the same numbers of cases; as often as you like
    bench/terms.py OUT --scored          the scored seed 2032, once: verdicts of another build in OUT are refused
    bench/terms.py OUT --reduced         few cases with seed 7, for the test suite
    bench/terms.py OUT --share 0.25      a quarter of the cases of every kind
    bench/terms.py OUT --what single rig --bases gho
    bench/terms.py OUT --laws            the other study: complete laws from nothing

OUT/cases is what the program sees, OUT/truths what was hidden, OUT/results what was said. Cases and verdicts of the same
programs stay, so that the same command goes on with an interrupted run. Exit code 1: a figure that has to be met is
missed; with --reduced, by more than chance: its whole 95 % interval misses. Needs numpy and scipy."""
import argparse
import concurrent.futures
import datetime
import functools
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import typing

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # cases are made side by side
from hidden_terms import complete_laws, scoring, verdict  # noqa: E402
from hidden_terms.bases import BASES  # noqa: E402
from hidden_terms.case_files import SEAL, Tampered, open_truth  # noqa: E402
from hidden_terms.figures import table  # noqa: E402
from hidden_terms.generate import Spec, make  # noqa: E402

DEVELOPMENT_SEED, SCORED_SEED, REDUCED_SEED = 101, 2032, 7
BEGIN, END = "<!-- blind benchmark of {}: begin -->", "<!-- blind benchmark of {}: end -->"

# Modules that make cases; the others only read verdicts.
GENERATOR = ("laws", "deformation", "protocol", "bases", "fitting", "case_files")
GENERATOR_OF = {"terms": "generate", "laws": "complete_laws"}

# Hidden effect → Λ, number of cases per base and Λ, and the same for a reduced run.
FULL: typing.Dict[str, typing.Tuple[typing.Tuple[int, ...], int]] = {
    "null": ((0,), 60), "single": ((25, 60, 150, 400), 18), "pair": ((150, 400), 6), "kinked": ((60, 150, 400), 4),
    "unusual": ((150, 400), 2), "rig": ((25, 60, 150, 400), 8)}
REDUCED: typing.Dict[str, typing.Tuple[typing.Tuple[int, ...], int]] = {
    "null": ((0,), 6), "single": ((150,), 5), "pair": ((400,), 1), "kinked": ((150,), 1),
    "unusual": ((400,), 1), "rig": ((150,), 4)}


def plan(reduced: bool, share: float, what: typing.Sequence[str], bases: typing.Sequence[str]) -> typing.List[Spec]:
    """Every third case does not state its noise; every second has noise that grows with the reading."""
    specs = []
    for name, (targets, count) in (REDUCED if reduced else FULL).items():
        for base in bases if name in what else ():
            for target in targets:
                for k in range(max(1, round(share * count))):
                    specs.append(Spec(name, base, target, k, ("white", "relative")[k % 2], k % 3 != 2))
    return specs


def law_plan(reduced: bool, share: float) -> typing.List[typing.Tuple[str, float, int]]:
    draws = complete_laws.REDUCED_DRAWS if reduced else max(1, round(share * complete_laws.DRAWS))
    return [(law, noise, k) for law in complete_laws.LAWS for noise in complete_laws.NOISES for k in range(draws)]


def one_law(entry: typing.Tuple[str, float, int], seed: int, out: pathlib.Path) -> str:
    return complete_laws.make(*entry, seed, out)


def fingerprint(files: typing.Iterable[pathlib.Path]) -> str:
    """SHA-256 over the contents of files."""
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()


def take_up(told: argparse.Namespace, seed: int) -> str:
    """What stands in OUT belongs to this seed and these programs, or goes; of the scored seed it is refused. The day it
    began."""
    here = pathlib.Path(__file__).resolve().parent
    program = [told.build / "bin/tunica", *sorted((told.build / "lib/tunica/plugins").glob("*.so"))]
    study = "laws" if told.laws else "terms"
    makers = [here / "hidden_terms" / f"{name}.py" for name in (*GENERATOR, GENERATOR_OF[study])]
    mine = {"seed": seed, "study": study, "scored": told.scored, "generator": fingerprint(makers), "program": fingerprint(program),
            "begun": datetime.date.today().isoformat()}
    note = told.out / "run.json"
    if note.exists():
        found = json.loads(note.read_text())
        if any(found[key] != mine[key] for key in ("seed", "study", "scored")):
            sys.exit(f"terms.py: {told.out} holds another run, of seed {found['seed']}, study {found['study']}; choose "
                     "another folder")
        same = {key: found[key] == mine[key] for key in ("generator", "program")}
        if told.scored and not all(same.values()):
            sys.exit(f"terms.py: {told.out} holds verdicts of another build of the scored seed, which runs once; go on "
                     "with that build, or take a new seed (--seed) and say so beside the table")
        stale = ["cases", "truths", "results"] if not same["generator"] else [] if same["program"] else ["results"]
        for folder in stale:
            shutil.rmtree(told.out / folder, ignore_errors=True)
        if not stale:
            mine["begun"] = found["begun"]
    told.out.mkdir(parents=True, exist_ok=True)
    note.write_text(json.dumps(mine, indent=1) + "\n")
    return str(mine["begun"])


def generate(told: argparse.Namespace, seed: int) -> typing.List[str]:
    """Names of all cases, which are on disk then."""
    if told.laws:
        jobs: typing.List[typing.Any] = law_plan(told.reduced, told.share)
        work: typing.Callable[[typing.Any], str] = functools.partial(one_law, seed=seed, out=told.out)
    else:
        jobs = plan(told.reduced, told.share, told.what, told.bases)
        work = functools.partial(make, seed=seed, out=told.out)
    names = []
    with concurrent.futures.ProcessPoolExecutor(told.jobs) as pool:
        for name in pool.map(work, jobs):
            names.append(name)
            if len(names) % 20 == 0 or len(names) == len(jobs):
                print(f"generated {len(names)} of {len(jobs)}", file=sys.stderr, flush=True)
    return names


def discover(told: argparse.Namespace) -> None:
    """Verdicts of the cases that have none. Where the program leaves one out, that is an answer too: a file says so."""
    cases, results, left = told.out / "cases", told.out / "results", told.out / "left"
    names = sorted(seal.parent.name for seal in cases.glob(f"*/{SEAL}"))
    missing = [name for name in names if not (results / name / "result.json").exists()]
    if not missing:
        return
    shutil.rmtree(left, ignore_errors=True)
    left.mkdir()
    for name in missing:
        (left / name).symlink_to((cases / name).resolve(), target_is_directory=True)
    command = [str(told.build / "bin/tunica"), "--allow-world-writable-plugins", "discover", "--batch", str(left), "-o",
               str(results), "-j", str(told.jobs), "--quiet", "--quick"]
    code = subprocess.run(command, stdout=subprocess.DEVNULL).returncode
    if code == 130 or code < 0:
        sys.exit(f"terms.py: interrupted; the same command goes on ({' '.join(command)})")
    answered = [name for name in missing if (results / name / "result.json").exists()]
    if not answered:
        sys.exit(f"terms.py: no case got an answer (exit code {code}): {' '.join(command)}")
    for name in sorted(set(missing) - set(answered)):
        print(f"no answer for {name}", file=sys.stderr)
        (results / name).mkdir(parents=True, exist_ok=True)
        (results / name / "result.json").write_text("{}\n")
    shutil.rmtree(left, ignore_errors=True)


def score_laws(told: argparse.Namespace, heading: str) -> typing.Tuple[str, bool]:
    cases, results = told.out / "cases", told.out / "results"
    names = sorted(seal.parent.name for seal in cases.glob(f"*/{SEAL}"))
    if any(not (results / name / "result.json").exists() for name in names):
        raise scoring.NotYet("a case has no verdict yet")
    judged = [complete_laws.judge(open_truth(cases / name, told.out / "truths"),
                                  verdict.read_file(results / name / "result.json")) for name in names]
    return complete_laws.table(heading, judged), True


def score_terms(told: argparse.Namespace, heading: str) -> typing.Tuple[str, bool]:
    """The table, and whether it passes."""
    judged = scoring.judge_all(told.out / "cases", told.out / "truths", told.out / "results")
    figures = scoring.figures(judged)
    passed = not any(one.missed_by_more_than_chance() if told.reduced else not one.passed() for one in figures)
    (told.out / "judged.json").write_text(json.dumps(
        [{"case": one.name, "truth": {key: one.truth[key] for key in ("what", "base", "lambda", "stated", "noise", "rig")},
          "hidden": [[term["invariant"], term["law"]] for term in one.truth["terms"]], "verdict": one.said.name,
          "first": one.said.first.terms or one.said.first.rig, "right_first": one.right_first, "in_set": one.in_set,
          "separable": one.separable, "ratios": one.ratios} for one in judged], indent=1) + "\n")
    return table(heading, figures), passed


def put_into(document: pathlib.Path, text: str, study: str) -> None:
    """The table between the marks of a document."""
    begin, end, whole = BEGIN.format(study), END.format(study), document.read_text()
    if begin not in whole or end not in whole:
        sys.exit(f"terms.py: {document} has no lines '{begin}' and '{end}' for the table to stand between")
    document.write_text(f"{whole.split(begin)[0]}{begin}\n{text}{end}{whole.split(end)[1]}")


def arguments() -> argparse.Namespace:
    root = pathlib.Path(__file__).resolve().parent.parent
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("out", type=pathlib.Path, help="folder for cases, truths, verdicts and table")
    ask.add_argument("--build", type=pathlib.Path, default=root / "build/release", help="build folder")
    ask.add_argument("--jobs", type=int, default=2, help="cores to use")
    ask.add_argument("--seed", type=int, help="another seed than the fixed ones")
    ask.add_argument("--scored", action="store_true", help="the scored seed instead of the one for development")
    ask.add_argument("--reduced", action="store_true", help="few cases, for the test suite")
    ask.add_argument("--share", type=float, default=1, help="times as many cases: above 0, up to 10")
    ask.add_argument("--what", nargs="+", choices=list(FULL), default=list(FULL), help="what is hidden; default: all")
    ask.add_argument("--bases", nargs="+", choices=BASES, default=list(BASES), help="base models; default: all")
    ask.add_argument("--laws", action="store_true", help="complete laws from nothing")
    ask.add_argument("--only-generate", action="store_true", help="write the cases, and stop")
    ask.add_argument("--docs", type=pathlib.Path, help="put the table into this document, between its marks")
    told = ask.parse_args()
    if told.reduced and told.scored:
        ask.error("--reduced and --scored exclude each other")
    if not 0 < told.share <= 10:
        ask.error(f"--share: found {told.share:g}, expected a number above 0, up to 10")
    return told


def main() -> None:
    told = arguments()
    seed = told.seed if told.seed is not None else (
        SCORED_SEED if told.scored else REDUCED_SEED if told.reduced else DEVELOPMENT_SEED)
    begun = take_up(told, seed)
    names = generate(told, seed)
    if told.only_generate:
        return
    discover(told)
    kind = "scored" if told.scored else "reduced" if told.reduced else "development"
    heading = f"{begun}, {kind} seed {seed}, {len(names)} cases, written by `bench/terms.py{' --laws' if told.laws else ''}`."
    if not told.laws and (set(told.what) != set(FULL) or set(told.bases) != set(BASES)):
        heading += f" Hidden: {', '.join(told.what)}; bases: {', '.join(told.bases)}."
    if told.share != 1:
        heading += f" Share {told.share:g}."
    try:
        text, passed = (score_laws if told.laws else score_terms)(told, heading)
    except (scoring.NotYet, Tampered) as error:
        sys.exit(f"terms.py: {error}")
    (told.out / "table.md").write_text(text)
    print(text, end="")
    if told.docs:
        put_into(told.docs, text, "laws" if told.laws else "terms")
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
