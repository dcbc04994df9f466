#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The blind benchmark of the diagnosis of cohorts: hide one effect in eight specimens, diagnose, then open the truth.

    bench/discovery_cohorts.py OUT               development seed; look at it as often as you like
    bench/discovery_cohorts.py OUT --scored      the scored seed, once: verdicts of another build in OUT are refused
    bench/discovery_cohorts.py OUT --reduced     few cohorts with a fixed seed, for the test suite
    bench/discovery_cohorts.py OUT --share 0.4   the first two fifths of the cohorts of every set

Every specimen has parameters, noise and an amplitude of its own; an effect leaves Λ = 25 on average. Exit code 1: a
figure that has to be met is missed; with --reduced, by more than chance: its whole 95 % interval misses."""
import argparse
import concurrent.futures
import datetime
import hashlib
import json
import os
import pathlib
import subprocess
import sys

DEVELOPMENT_SEED, SCORED_SEED, REDUCED_SEED = 1801, 1818, 1807
BEGIN, END = "<!-- blind cohorts: begin -->", "<!-- blind cohorts: end -->"
# Set → cohorts of each effect (of all, where none is named): development, scored, reduced.
COUNTS = {"nulls": (100, 400, 8), "singles": (2, 5, 1), "pairs": (20, 60, 1), "groups": (1, 3, 1)}
# Of the reduced run, which has to be quick: effects of every kind.
REDUCED_EFFECTS = ["fibre_dispersion", "stress_softening", "pressure_offset"]
# Figure → its limits: at least, at most.
BARS = {"false alarms": (0.035, 0.065), "right name": (0.97, 1), "right pair": (0.95, 1), "found and placed": (0.90, 1)}
WORDS = {"false alarms": "false alarms at α = 0.05", "right name": "right name, effect in all specimens",
         "right pair": "right pair", "found and placed": "effect in one of two groups found, named and placed"}


def wilson(hits, total):
    """95 % interval of a share."""
    z = 1.959964
    if total == 0:
        return 0.0, 1.0
    p, zz = hits / total, z * z / total
    half = z * (p * (1 - p) / total + zz / (4 * total)) ** 0.5
    return (p + zz / 2 - half) / (1 + zz), (p + zz / 2 + half) / (1 + zz)


def run(command):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)


def generate_all(program, cohorts, seed, counts, effects, jobs):
    """In pieces of one cohort an effect, or ten where no effect is named."""
    work = []
    for what, number in counts.items():
        step = 10 if what in ("nulls", "pairs") else 1
        for first in range(0, number, step):
            command = [program, "--out", cohorts, "--seed", seed, "--set", what, "--first", first, "--count",
                       min(step, number - first)]
            work.append(command + (["--effect", *effects] if effects and what in ("singles", "groups") else []))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(run, work))


def diagnose_all(program, cohorts, jobs):
    """Verdicts of what has none, twenty cohorts at a time."""
    left = sorted(seal.parent for seal in cohorts.glob("[!.]*/truth.sha256") if not (seal.parent / "verdict.json").exists())
    for first in range(0, len(left), 20):
        run([program, jobs, *left[first:first + 20]])
        print(f"diagnosed {min(first + 20, len(left))} of {len(left)} cohorts", file=sys.stderr)


def opened(folder):
    """Truth and verdict of a cohort; the truth is what was sealed."""
    text = (folder.parent / "sealed" / f"{folder.name}.json").read_bytes()
    if hashlib.sha256(text).hexdigest() != (folder / "truth.sha256").read_text().strip():
        sys.exit(f"discovery_cohorts.py: the truth of {folder.name} is not the one that was sealed")
    return json.loads(text), json.loads((folder / "verdict.json").read_text())


def hidden_in(truth):
    """Ids, and of each test and channel as files call them."""
    having = next((one for one in truth["specimens"] if one["effects"]), {"effects": []})
    return {effect["id"]: effect["target"] for effect in having["effects"]}


def named_first(verdict):
    """The ids of the best explanation, where it is one."""
    if not verdict["alarm"] or verdict["verdict"] == "unknown" or not verdict["explanations"]:
        return set()
    return set(verdict["explanations"][0]["mechanisms"])


def look_alikes(build):
    """Declared look-alikes of every mechanism."""
    def ask(*words):
        command = [build / "bin/tunica", "--allow-world-writable-plugins", *words, "--json"]
        return json.loads(subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout)

    names = [entry["name"] for entry in ask("list", "mechanisms")["mechanisms"]]
    return {name: ask("describe", name)["mechanism"]["look_alikes"] for name in names}


def stands_for(verdict, named, truth, declared):
    """As for one specimen: a declared look-alike counts where the truth is in the set, and these data make the two look
    alike above 0.9."""
    if named == truth:
        return True
    rows = [row["mechanism"] for row in verdict["matrix"]]
    if truth not in rows or truth not in declared.get(named, []) or truth not in verdict["ambiguity_set"]:
        return False
    return verdict["likeness"][rows.index(named)][rows.index(truth)] > 0.9


def all_stand(verdict, found, hidden, declared):
    """Whether every name counts for a hidden effect, and none is left."""
    left, rest = hidden - found, found - hidden
    return len(rest) == len(left) and all(any(stands_for(verdict, one, truth, declared) for truth in left) for one in rest)


def placed(truth, verdict):
    """Whether the explanation is put where the effect is."""
    target = next(iter(hidden_in(truth).values()))
    place = verdict["explanations"][0]["places"][0]
    if target["test"] is None:
        return True  # the material, or alike in all tubes
    return target["test"] in place["tests"] and target["channel"] in (None, place.get("channel"))


class Scores:
    def __init__(self, declared):
        self.declared = declared
        self.counts, self.mistakes, self.by_effect = {}, [], {}
        self.contradictions = {}

    def add(self, figure, hit):
        hits, total = self.counts.get(figure, (0, 0))
        self.counts[figure] = hits + bool(hit), total + 1

    def judge(self, name, truth, verdict):
        what, hidden, found = truth["set"], set(hidden_in(truth)), named_first(verdict)
        note = f"{name} {what} {'+'.join(sorted(hidden)) or 'nothing'} → {'+'.join(sorted(found)) or '–'} " \
               f"({verdict['verdict']}, set {', '.join(verdict['ambiguity_set'])})"
        if what == "nulls":
            self.add("false alarms", verdict["alarm"])
            for p in verdict["p_values"]:
                self.add("one specimen alone: false alarms", p <= 0.05)
            return
        if not truth["reached"]:
            self.add("not reached", True)
            return
        self.add(f"{what}: detected", verdict["alarm"])
        if what == "pairs":
            self.add("right pair", all_stand(verdict, found, hidden, self.declared))
            self.add("pairs: right, no look-alike counted", found == hidden)
            self.add("pair: set holds both", hidden <= set(verdict["ambiguity_set"]))
            self.add("pair: named something false", verdict["verdict"] == "named" and not found <= hidden)
        else:
            effect = truth["effect"]
            right = len(found) == 1 and stands_for(verdict, next(iter(found)), effect, self.declared)
            figure = "right name" if what == "singles" else "right name, in one group"
            self.add(figure, right)
            self.add(f"{what}: right name, no look-alike counted", found == {effect})
            self.add(f"{what}: named alone", found == {effect} and verdict["ambiguity_set"] == [effect])
            for one in verdict["contradictions"]:
                self.contradictions[one["code"]] = self.contradictions.get(one["code"], 0) + 1
            self.add(f"{what}: set holds the truth", effect in verdict["ambiguity_set"])
            self.add(f"{what}: named, wrongly", verdict["verdict"] == "named" and found != {effect})
            if what == "singles":
                hits, total = self.by_effect.get(effect, (0, 0))
                self.by_effect[effect] = hits + right, total + 1
                sums = verdict["sums_of_own_weights"]
                self.add("sum of own weights: right name", sums and max(sums, key=sums.get) == effect)
                for own in verdict["own"]:
                    self.add("one specimen alone: right name", own["causes"] == [effect] and own["verdict"] != "unknown")
                self.add("said to be in one group only, and is not",
                         any(factor["only_in"] for factor in verdict["factors"]))
                if found == {effect}:
                    self.add("place", placed(truth, verdict))
            if what == "groups":
                factor = verdict["factors"][0] if verdict["factors"] else {"only_in": None}
                grouped = factor["only_in"] == truth["affected_group"]
                self.add("found and placed", right and grouped and placed(truth, verdict))
                self.add("group, whatever the name", grouped)
        if found != hidden:
            self.mistakes.append(note)

    def met(self, figure, reduced):
        hits, total = self.counts.get(figure, (0, 0))
        if total == 0:
            return True
        low, high = BARS[figure]
        least, most = wilson(hits, total) if reduced else (hits / total,) * 2
        return most >= low and least <= high

    def table(self, heading, reduced):
        lines = [heading, "", "| figure | measured (95 % interval) | asked | of |", "|---|---|---|---|"]
        for figure, (hits, total) in sorted(self.counts.items(), key=lambda one: (one[0] not in BARS, one[0])):
            low, high = wilson(hits, total)
            asked = "–"
            if figure in BARS:
                bar = BARS[figure]
                asked = f"{bar[0]}–{bar[1]}" if bar[1] < 1 else f"≥ {bar[0]:.2f}"
                asked += " ✓" if self.met(figure, reduced) else " ✗"
            lines.append(f"| {WORDS.get(figure, figure)} | {hits / total:.3f} ({low:.3f}–{high:.3f}) | {asked} | {total} |")
        return "\n".join(lines) + "\n"


def fingerprint(files):
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()


def take_up(out, seed, build, scored):
    """What stands in `out` belongs to this seed and these programs; the scored seed runs once."""
    files = [build / "bin/bench_cohort_diagnosis", build / "bin/discovery_cohorts",
             *sorted((build / "lib/tunica/plugins").glob("*.so"))]
    mine = {"seed": seed, "programs": fingerprint(files)}
    note = out / "run.json"
    if note.exists():
        found = json.loads(note.read_text())
        if found["seed"] != seed:
            sys.exit(f"discovery_cohorts.py: {out} holds another run, of seed {found['seed']}; choose another folder")
        if scored and found != mine:
            sys.exit(f"discovery_cohorts.py: {out} holds verdicts of another build of the scored seed, which runs once; "
                     "go on with that build, or take a new seed (--seed) and say so beside the table")
        if found != mine:
            for file in [*out.glob("cohorts/*/verdict.json"), *out.glob("cohorts/*/*/evidence.json")]:
                file.unlink()
    (out / "cohorts").mkdir(parents=True, exist_ok=True)
    note.write_text(json.dumps(mine) + "\n")


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("out", type=pathlib.Path, help="folder for cohorts, verdicts and table")
    ask.add_argument("--build", type=pathlib.Path, default=root / "build/release", help="build folder")
    ask.add_argument("--jobs", type=int, default=os.cpu_count(), help="cores to use")
    ask.add_argument("--seed", type=int, help="another seed than the fixed ones")
    ask.add_argument("--scored", action="store_true", help="the scored seed instead of the one for development")
    ask.add_argument("--reduced", action="store_true", help="few cohorts, for the test suite")
    ask.add_argument("--share", type=float, default=1, help="so many times as many cohorts of every set: above 0")
    ask.add_argument("--docs", type=pathlib.Path, help="put the table into this document, between its marks")
    told = ask.parse_args()
    column = 2 if told.reduced else 1 if told.scored else 0
    seed = told.seed or (DEVELOPMENT_SEED, SCORED_SEED, REDUCED_SEED)[column]
    take_up(told.out, seed, told.build, told.scored)
    counts = {what: max(1, round(told.share * numbers[column])) for what, numbers in COUNTS.items()}
    cohorts = told.out / "cohorts"
    generate_all(told.build / "bin/discovery_cohorts", cohorts, seed, counts, REDUCED_EFFECTS if told.reduced else [],
                 told.jobs)
    diagnose_all(told.build / "bin/bench_cohort_diagnosis", cohorts, told.jobs)

    scores = Scores(look_alikes(told.build))
    folders = sorted(seal.parent for seal in cohorts.glob("[!.]*/truth.sha256"))
    for folder in folders:
        scores.judge(folder.name, *opened(folder))
    kind = ("development", "scored", "reduced")[column]
    day = datetime.date.today().isoformat()
    table = scores.table(f"{day}, {kind} seed {seed}, {len(folders)} cohorts of eight, written by "
                         "`bench/discovery_cohorts.py`.", told.reduced)
    print(table)
    print("\n".join(scores.mistakes))
    print("specimens said to contradict, of cohorts with one effect:", scores.contradictions)
    print({effect: f"{hits}/{total}" for effect, (hits, total) in sorted(scores.by_effect.items()) if hits < total})
    (told.out / "table.md").write_text(table)
    if told.docs:
        text = told.docs.read_text()
        if BEGIN not in text or END not in text:
            sys.exit(f"discovery_cohorts.py: {told.docs} has no lines '{BEGIN}' and '{END}'")
        told.docs.write_text(text.split(BEGIN)[0] + BEGIN + "\n" + table + END + text.split(END)[1])
    sys.exit(0 if all(scores.met(figure, told.reduced) for figure in BARS) else 1)


main()
