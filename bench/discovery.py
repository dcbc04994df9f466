#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The blind benchmark of diagnosis, one command: hide effects, diagnose, then open the sealed truths and score.

    bench/discovery.py OUT                  development seed, the same numbers of cases; look at it as often as you like
    bench/discovery.py OUT --scored         the scored seed, once: verdicts of another build in OUT are refused
    bench/discovery.py OUT --reduced        few cases with a fixed seed, for the test suite

Every stage leaves alone what is there, so that an interrupted run is taken up by the same command; cases and verdicts of
another build are made anew. Exit code 1: a figure that has to be met is missed; with --reduced, by more than chance: its
whole 95 % interval misses."""
import argparse
import concurrent.futures
import datetime
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys

DEVELOPMENT_SEED, SCORED_SEED, REDUCED_SEED = 101, 2030, 7
STATED = ["white", "relative", "quantised"]
BEGIN, END = "<!-- blind benchmark: begin -->", "<!-- blind benchmark: end -->"


def plan(reduced):
    """(set, cases, kinds of noise, Λ, whether the oracle is asked), each for every effect and Λ of the set."""
    if reduced:
        return [("nulls", range(0, 60), STATED, [], False), ("singles", range(0, 3), STATED, [60], True),
                ("pairs", range(0, 4), STATED, [60], False), ("outside", range(0, 1), STATED, [60], False)]
    return [("nulls", range(0, 1000), STATED, [], False), ("nulls", range(0, 300), ["ar1"], [], False),
            ("nulls", range(0, 200), ["outliers"], [], False),
            ("singles", range(0, 30), STATED, [10, 25, 60, 150], True),
            ("singles", range(30, 35), ["ar1"], [10, 25, 60, 150], True),
            ("singles", range(35, 40), ["outliers"], [10, 25, 60, 150], True),
            ("pairs", range(0, 160), STATED, [60], True), ("outside", range(0, 8), STATED, [25, 60, 150], False)]


def chunks(stages, size):
    """Stages cut into pieces of `size` cases an effect and Λ, so that work is shared and progress is seen."""
    for what, cases, noise, lambdas, oracle in stages:
        step = size if what in ("nulls", "pairs") else max(1, size // 50)
        for first in range(cases.start, cases.stop, step):
            yield what, range(first, min(first + step, cases.stop)), noise, lambdas, oracle


def generate(generator, out, seed, chunk):
    what, cases, noise, lambdas, oracle = chunk
    command = [generator, "--out", out, "--seed", seed, "--set", what, "--cases", f"{cases.start}:{cases.stop}"]
    command += ["--noise", *noise] + (["--lambda", *lambdas] if lambdas else []) + (["--oracle"] if oracle else [])
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)
    return f"{what} {cases.start}:{cases.stop} {'+'.join(noise)}"


def tunica(build):
    return [str(build / "bin/tunica"), "--allow-world-writable-plugins"]


def fingerprint(files):
    """SHA-256 over the contents of files."""
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()


def look_alikes(build):
    """Declared look-alikes of every mechanism."""
    def ask(*words):
        return json.loads(subprocess.run([*tunica(build), *words, "--json"], check=True, capture_output=True, text=True).stdout)

    declared = {}
    for entry in ask("list", "mechanisms")["mechanisms"]:
        name = entry["name"]
        declared[name] = ask("describe", name)["mechanism"]["look_alikes"]
        if len(declared[name]) > 3:
            sys.exit(f"discovery.py: {name} declares {len(declared[name])} look-alikes, and at most three count")
    return declared


def take_up(out, seed, build, scored):
    """What stands in `out` belongs to this seed and these programs, or goes: cases of another generator, verdicts of
    another build. But the scored seed runs once, with thresholds frozen before: there it is refused. The day it began."""
    program = [build / "bin/tunica", *sorted((build / "lib/tunica/plugins").glob("*.so"))]
    mine = {"seed": seed, "scored": scored, "generator": fingerprint([build / "bin/discovery_generator"]),
            "program": fingerprint(program), "begun": datetime.date.today().isoformat()}
    note, cases = out / "run.json", out / "cases"
    if note.exists():
        found = json.loads(note.read_text())
        if found["seed"] != seed or found["scored"] != scored:
            sys.exit(f"discovery.py: {out} holds another run, of seed {found['seed']}; choose another folder")
        if scored and (found["program"], found["generator"]) != (mine["program"], mine["generator"]):
            sys.exit(f"discovery.py: {out} holds verdicts of another build of the scored seed, which runs once; "
                     "go on with that build, or take a new seed (--seed) and say so beside the table")
        if found["generator"] != mine["generator"]:
            shutil.rmtree(cases, ignore_errors=True)
        elif found["program"] != mine["program"]:
            for verdict in cases.glob("*/result.json"):
                verdict.unlink()
        else:
            mine["begun"] = found["begun"]
    cases.mkdir(parents=True, exist_ok=True)
    note.write_text(json.dumps(mine, indent=1) + "\n")
    return mine["begun"]


def put_into(document, table):
    text = document.read_text()
    if BEGIN not in text or END not in text:
        sys.exit(f"discovery.py: {document} has no lines '{BEGIN}' and '{END}' for the table to stand between")
    head, tail = text.split(BEGIN)[0], text.split(END)[1]
    document.write_text(f"{head}{BEGIN}\n{table}{END}{tail}")


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("out", type=pathlib.Path, help="folder for cases, verdicts and table")
    ask.add_argument("--build", type=pathlib.Path, default=root / "build/release", help="build folder")
    ask.add_argument("--jobs", type=int, default=os.cpu_count(), help="cores to use")
    ask.add_argument("--seed", type=int, help="another seed than the fixed ones")
    ask.add_argument("--scored", action="store_true", help="the scored seed instead of the one for development")
    ask.add_argument("--reduced", action="store_true", help="few cases, for the test suite")
    ask.add_argument("--docs", type=pathlib.Path, help="put the table into this document, between its marks")
    told = ask.parse_args()
    if told.reduced and told.scored:
        ask.error("--reduced and --scored exclude each other")
    seed = told.seed if told.seed is not None else (
        SCORED_SEED if told.scored else REDUCED_SEED if told.reduced else DEVELOPMENT_SEED)
    cases = told.out / "cases"
    begun = take_up(told.out, seed, told.build, told.scored)

    work = list(chunks(plan(told.reduced), 100))
    with concurrent.futures.ThreadPoolExecutor(told.jobs) as pool:
        futures = [pool.submit(generate, told.build / "bin/discovery_generator", cases, seed, chunk) for chunk in work]
        for done, future in enumerate(concurrent.futures.as_completed(futures), 1):
            print(f"generated {done} of {len(work)}: {future.result()}", file=sys.stderr)

    subprocess.run([*tunica(told.build), "diagnose", "--quick", "--batch", "-j", str(told.jobs), str(cases)], check=True)

    alike = told.out / "look_alikes.json"
    alike.write_text(json.dumps(look_alikes(told.build), indent=1) + "\n")
    table = told.out / "table.md"
    kind = "scored" if told.scored else "reduced" if told.reduced else "development"
    count = sum(1 for folder in cases.iterdir() if (folder / "truth.sha256").exists())
    heading = f"{begun}, {kind} seed {seed}, {count} cases, written by `bench/discovery.py`."
    score = [str(told.build / "bin/discovery_score"), str(cases), "--look-alikes", str(alike), "--heading", heading,
             "--markdown", str(table), "--json", str(told.out / "score.json")]
    code = subprocess.run(score + (["--reduced"] if told.reduced else [])).returncode
    if told.docs and code in (0, 1):
        put_into(told.docs, table.read_text())
    sys.exit(code)


main()
