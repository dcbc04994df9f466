#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Memory in strips with a clock, beside inflations without time whose rows, a first loading, are shuffled: how often the
diagnosis names it, and how often it takes an error of the rig in its place.

    bench/partly_ordered.py OUT                 development seed 501
    bench/partly_ordered.py OUT --cases 20

Cases are those of the blind benchmark (bench/discovery.py), plain class; only the files of the inflations are changed.
An answer is `right` where the effect, or a declared look-alike, is named or leads, `tied` where it is in the tie, `wrong`
where anything else is named or leads."""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
DEVELOPMENT_SEED = 501
MEMORY = ("stress_softening", "viscoelasticity")


def forget_order(case: pathlib.Path, number: int) -> None:
    """The inflations of a case become first loadings without time, and their rows lose the order."""
    file = case / "experiment.json"
    experiment = json.loads(file.read_text())
    for name, test in experiment["tests"].items():
        if test["type"] == "uniaxial":
            continue
        test["data"]["columns"].pop("time", None)
        for data in case.glob(f"{name}*.csv"):
            heading, *rows = data.read_text().splitlines()
            load = heading.split(",").index("pressure [kPa]")
            highest, first = -1.0, []
            for line in rows:
                if float(line.split(",")[load]) > highest:
                    highest = float(line.split(",")[load])
                    first.append(line)
            rows = first
            random.Random(f"{number} {data.name}").shuffle(rows)
            kept = [k for k, column in enumerate(heading.split(",")) if not column.startswith("time")]
            lines = [",".join(line.split(",")[k] for k in kept) for line in [heading, *rows]]
            data.write_text("\n".join(lines) + "\n")
    file.write_text(json.dumps(experiment))


def said(diagnosis: dict) -> tuple:
    """The verdict, and the causes that it names, leads with or lists."""
    verdict = diagnosis["verdict"]
    if verdict == "leading":
        return verdict, [diagnosis["budget"]["lead"]["id"]]
    if verdict == "indistinguishable":
        return verdict, diagnosis["ambiguity_set"]
    if verdict == "named":
        return verdict, [one["type"] for one in diagnosis["extension"]["mechanisms"]]
    return verdict, []


def main() -> int:
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("out", type=pathlib.Path)
    ask.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    ask.add_argument("--cases", type=int, default=10, help="of each effect and Λ")
    ask.add_argument("--lambdas", nargs="+", default=["60", "150"])
    ask.add_argument("--seed", type=int, default=DEVELOPMENT_SEED)
    ask.add_argument("--jobs", type=int, default=2)
    told = ask.parse_args()
    tunica = [str(told.build / "bin/tunica"), "--allow-world-writable-plugins"]
    subprocess.run([str(told.build / "bin/discovery_generator"), "--out", str(told.out), "--seed", str(told.seed), "--set",
                    "singles", "--cases", f"0:{told.cases}", "--effect", *MEMORY, "--lambda", *told.lambdas],
                   check=True, stdout=subprocess.DEVNULL)
    alike = {}
    for effect in MEMORY:
        described = subprocess.run([*tunica, "describe", effect, "--json"], check=True, capture_output=True, text=True)
        alike[effect] = {effect, *json.loads(described.stdout)["mechanism"]["look_alikes"]}
    cases = sorted(seal.parent for seal in told.out.glob("*/truth.sha256"))
    for number, case in enumerate(cases):
        forget_order(case, number)

    def diagnose(case: pathlib.Path) -> dict:
        answer = told.out / "answers" / case.name
        if not (answer / "result.json").exists():
            subprocess.run([*tunica, "diagnose", str(case / "experiment.json"), "--quick", "--quiet", "-j", "1", "-o", str(answer)],
                           check=True, stdout=subprocess.DEVNULL)
        return json.loads((answer / "result.json").read_text())["diagnosis"]

    with concurrent.futures.ThreadPoolExecutor(told.jobs) as pool:
        found = list(pool.map(diagnose, cases))
    table: dict = collections.defaultdict(collections.Counter)
    for case, diagnosis in zip(cases, found):
        truth = json.loads((told.out / "sealed" / f"{case.name}.json").read_text())
        effect, strength = truth["effects"][0]["id"], truth["lambda_asked"]
        verdict, causes = said(diagnosis)
        here = bool(alike[effect] & set(causes))
        answer = "right" if here and verdict != "indistinguishable" else "tied" if here else "wrong" if causes else verdict
        row = table[effect, strength]
        row["cases"] += 1
        row[answer] += 1
        row["drift alone"] += causes == ["signal_drift"]
        print(f"{case.name[:12]} {effect:18} {strength:4} {verdict:17} {', '.join(causes)}")
    columns = ["cases", "right", "tied", "wrong", "unknown", "nothing_detected", "suspect_data", "drift alone"]
    print(f"\n| effect | Λ | {' | '.join(columns)} |\n|---|---|{'---|' * len(columns)}")
    for (effect, strength), row in sorted(table.items()):
        print(f"| {effect} | {strength:g} | {' | '.join(str(row[name]) for name in columns)} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
