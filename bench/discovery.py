#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The blind benchmark of diagnosis, one command: hide effects, diagnose, then open the sealed truths and score.

    bench/discovery.py OUT                  development seed, the same numbers of cases; look at it as often as you like
    bench/discovery.py OUT --scored         the scored seed, once: verdicts of another build in OUT are refused
    bench/discovery.py OUT --reduced        few cases with a fixed seed, for the test suite
    bench/discovery.py OUT --share 0.25     a quarter of the cases of every class
    bench/discovery.py OUT --classes gho yeoh unstated

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
import time
import typing

DEVELOPMENT_SEED, SCORED_SEED, REDUCED_SEED = 101, 2032, 7
STATED = ["white", "relative", "quantised"]
BEGIN, END = "<!-- blind benchmark: begin -->", "<!-- blind benchmark: end -->"


class Stage(typing.NamedTuple):
    """Cases of one set, for every effect and Λ of it; `words` tell the generator the class."""
    what: str
    cases: range
    noise: list
    lambdas: list
    oracle: bool
    words: tuple = ()


ARTERIES, RUBBERS = ["gho", "holzapfel_2015", "four_fibre"], ["yeoh", "ogden"]
# Class → the options of the generator.
CLASSES = {"plain": (), "unstated": ("--noise-not-stated",), "unordered": ("--order-not-recorded",),
           **{base: ("--base", base) for base in ARTERIES},
           "sheets": ("--protocol", "sheets"), "gho_sheets": ("--base", "gho", "--protocol", "sheets"),
           **{base: ("--base", base, "--protocol", "rubber") for base in RUBBERS}}


def plain(reduced):
    if reduced:
        return [Stage("nulls", range(0, 36), STATED, [], False), Stage("singles", range(0, 3), STATED, [60], True),
                Stage("pairs", range(0, 4), STATED, [60], False), Stage("outside", range(0, 1), STATED, [60], False)]
    return [Stage("nulls", range(0, 600), STATED, [], False), Stage("nulls", range(0, 100), ["ar1"], [], False),
            Stage("nulls", range(0, 60), ["outliers"], [], False),
            Stage("singles", range(0, 12), STATED, [10, 25, 60, 150], True),
            Stage("singles", range(12, 14), ["ar1"], [10, 25, 60, 150], True),
            Stage("singles", range(14, 16), ["outliers"], [10, 25, 60, 150], True),
            Stage("pairs", range(0, 120), STATED, [60], True), Stage("outside", range(0, 4), STATED, [25, 60, 150], False)]


def stages(name, reduced, classes):
    """Of one class. Where the noise is not stated, the same data with it stated belong to it; the plain class has them."""
    words = CLASSES[name]
    if name == "plain":
        return plain(reduced)
    if name == "unstated":
        nulls = [Stage("nulls", range(0, 10 if reduced else 500), STATED, [], False, words)]
        if not reduced:
            nulls.append(Stage("nulls", range(0, 60), ["correlated"], [], False, words))
        singles = Stage("singles", range(0, 1 if reduced else 6), STATED, [60] if reduced else [25, 60, 150], False, words)
        return [*nulls, singles] + ([] if "plain" in classes else [singles._replace(oracle=True, words=())])
    if reduced:
        return [Stage("nulls", range(0, 4), STATED, [], False, words)] + (
            [Stage("singles", range(0, 1), STATED, [60], False, words)] if name in ["sheets", "yeoh"] else [])
    cheap = "--protocol" in words
    return [Stage("nulls", range(0, 300 if cheap else 200), STATED, [], False, words),
            Stage("singles", range(0, 4 if cheap else 2), STATED, [25, 60, 150] if cheap else [25, 60], True, words)]


def plan(reduced, classes, share):
    """Stages of all classes, with so many times as many cases: at least one."""
    for name in classes:
        for stage in stages(name, reduced, classes):
            count = max(1, round(share * len(stage.cases)))
            yield stage._replace(cases=range(stage.cases.start, stage.cases.start + count))


def chunks(all_stages, size):
    """Stages cut into pieces of `size` cases an effect and Λ, so that work is shared and progress is seen."""
    for stage in all_stages:
        step = size if stage.what in ("nulls", "pairs") else max(1, size // 50)
        for first in range(stage.cases.start, stage.cases.stop, step):
            yield stage._replace(cases=range(first, min(first + step, stage.cases.stop)))


def generate(generator, out, seed, stage):
    command = [generator, "--out", out, "--seed", seed, "--set", stage.what,
               "--cases", f"{stage.cases.start}:{stage.cases.stop}", "--noise", *stage.noise]
    command += (["--lambda", *stage.lambdas] if stage.lambdas else []) + (["--oracle"] if stage.oracle else [])
    subprocess.run([str(word) for word in [*command, *stage.words]], check=True, stdout=subprocess.DEVNULL)
    return " ".join([f"{stage.what} {stage.cases.start}:{stage.cases.stop} {'+'.join(stage.noise)}", *stage.words])


def diagnose(build, shard):
    """Verdicts of the cases that a folder of links names, one after the other on one core; the seconds of each."""
    begun = time.time()
    names = sorted(link.name for link in shard.iterdir())
    subprocess.run([*tunica(build), "diagnose", "--no-discovery", "--quick", "--batch", "--quiet", "-j", "1", str(shard)], check=True,
                   stdout=subprocess.DEVNULL)
    seconds = {}
    for name in names:
        ended = (shard / name / "result.json").stat().st_mtime
        seconds[name] = max(0.0, ended - begun)
        begun = ended
    return seconds


def diagnose_all(build, out, jobs):
    """What has no verdict yet, in folders of 25 links each; the seconds of every case so far stand in seconds.json."""
    cases, shards, noted = out / "cases", out / "shards", out / "seconds.json"
    shutil.rmtree(shards, ignore_errors=True)
    known = json.loads(noted.read_text()) if noted.exists() else {}
    left = sorted(seal.parent for seal in cases.glob("*/truth.sha256") if not (seal.parent / "result.json").exists())
    for k, case in enumerate(left):
        shard = shards / str(k // 25)
        shard.mkdir(parents=True, exist_ok=True)
        (shard / case.name).symlink_to(case.resolve(), target_is_directory=True)
    done = 0
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(diagnose, build, shard) for shard in (shards.iterdir() if left else [])]
        for future in concurrent.futures.as_completed(futures):
            seconds = future.result()
            known.update(seconds)
            noted.write_text(json.dumps(known, indent=0) + "\n")
            done += len(seconds)
            print(f"diagnosed {done} of {len(left)}", file=sys.stderr)
    shutil.rmtree(shards, ignore_errors=True)
    noted.write_text(json.dumps(known, indent=0) + "\n")


def fingerprint(files):
    """SHA-256 over the contents of files."""
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()


def tunica(build):
    return [str(build / "bin/tunica"), "--allow-world-writable-plugins"]


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
    ask.add_argument("--classes", nargs="+", choices=CLASSES, default=list(CLASSES), help="classes of cases; default: all")
    ask.add_argument("--share", type=float, default=1, help="times as many cases of every class: above 0, up to 10")
    ask.add_argument("--docs", type=pathlib.Path, help="put the table into this document, between its marks")
    told = ask.parse_args()
    if told.reduced and told.scored:
        ask.error("--reduced and --scored exclude each other")
    if not 0 < told.share <= 10:
        ask.error(f"--share: found {told.share:g}, expected a number above 0, up to 10")
    seed = told.seed if told.seed is not None else (
        SCORED_SEED if told.scored else REDUCED_SEED if told.reduced else DEVELOPMENT_SEED)
    cases = told.out / "cases"
    begun = take_up(told.out, seed, told.build, told.scored)

    work = list(chunks(plan(told.reduced, told.classes, told.share), 100))
    with concurrent.futures.ThreadPoolExecutor(told.jobs) as pool:
        futures = [pool.submit(generate, told.build / "bin/discovery_generator", cases, seed, chunk) for chunk in work]
        for done, future in enumerate(concurrent.futures.as_completed(futures), 1):
            print(f"generated {done} of {len(work)}: {future.result()}", file=sys.stderr)

    diagnose_all(told.build, told.out, told.jobs)

    alike = told.out / "look_alikes.json"
    alike.write_text(json.dumps(look_alikes(told.build), indent=1) + "\n")
    table = told.out / "table.md"
    kind = "scored" if told.scored else "reduced" if told.reduced else "development"
    count = sum(1 for folder in cases.iterdir() if (folder / "truth.sha256").exists())
    heading = f"{begun}, {kind} seed {seed}, {count} cases, written by `bench/discovery.py`."
    score = [str(told.build / "bin/discovery_score"), str(cases), "--look-alikes", str(alike), "--heading", heading,
             "--markdown", str(table), "--json", str(told.out / "score.json")]
    # A test must not depend on a clock.
    score += ["--reduced"] if told.reduced else ["--seconds", str(told.out / "seconds.json")]
    if told.share < 1 or set(told.classes) != set(CLASSES):
        score.append("--selected")
        heading_of = f" Classes {', '.join(told.classes)}; share {told.share:g}."
        score[score.index("--heading") + 1] = heading + heading_of
    code = subprocess.run(score).returncode
    if told.docs and code in (0, 1):
        put_into(told.docs, table.read_text())
    sys.exit(code)


main()
