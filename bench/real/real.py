# SPDX-License-Identifier: Apache-2.0
"""Diagnoses real data whose cause of misfit is known from the experiment, and counts how often the answer is right.

    python3 bench/real/real.py build/release/bin/tunica --data ../shared/data/real_causes

Without --data, TUNICA_DATA_DIR/real_causes is taken; examples are always there. Each pair is diagnosed with the noise
stated and, where the file has an "unstated" one beside it or states noise, without. A name is right where the leading
cause is one that the experiment says, a tie where all that it lists are. Prints a table in Markdown, with the sentence
and the seconds of processor time in user mode.
"""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent


def without_noise(experiment):
    """The experiment with its stated noise taken out."""
    for test in experiment["tests"].values():
        test.get("data", {}).pop("noise", None)
        test.pop("noise", None)
    experiment.pop("noise", None)
    return experiment


def absolute_paths(node, folder):
    """Files of the data by their full path, so that the experiment can stand elsewhere."""
    if isinstance(node, dict):
        return {key: str(folder / value) if key == "file" and isinstance(value, str)
                else [str(folder / one) for one in value] if key == "files" else absolute_paths(value, folder)
                for key, value in node.items()}
    return [absolute_paths(one, folder) for one in node] if isinstance(node, list) else node


def matches(said, leads):
    """Whether a cause "I2 (linear)", "fibre diagonal (exponential)" or "viscoelasticity" is one of those."""
    return any(one == lead or one.startswith(lead + " ") for lead in leads for one in said.split(" / "))


def answer(result):
    """What the diagnosis leads with: a list of causes, empty where it names none."""
    diagnosis = result["diagnosis"]
    verdict = diagnosis["verdict"]
    budget = diagnosis.get("budget", {})
    if verdict in ("named", "suspect_data"):
        return [mechanism["type"] for mechanism in diagnosis.get("extension", {}).get("mechanisms", [])]
    if verdict == "leading":
        return [f'{budget["lead"]["id"]} / {budget["lead"]["acts_like"]}']
    if verdict == "indistinguishable":
        return diagnosis["ambiguity_set"]
    if verdict == "discovered":
        return [f'{term["invariant"]} {term.get("family") or ""}'.strip() for term in result["discovery"]["terms"]]
    return []


def judged(verdict, said, leads):
    if not said:
        return "right" if not leads else "withheld"
    if not leads:
        return "wrong"
    if verdict == "indistinguishable":
        return "right" if all(matches(one, leads) for one in said) else "tie" if any(
            matches(one, leads) for one in said) else "wrong"
    return "right" if matches(said[0], leads) else "wrong"


def diagnosed(program, experiment, quick, folder):
    path = folder / "experiment.json"
    path.write_text(json.dumps(experiment))
    command = [program, "diagnose", str(path), "-o", str(folder / "out"), "--quiet"] + (["--quick"] if quick else [])
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if done.returncode != 0:
        return None, done.stdout + done.stderr, seconds
    return json.loads((folder / "out" / "result.json").read_text()), done.stdout, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--data", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get("TUNICA_DATA_DIR", "data")) / "real_causes")
    parser.add_argument("--full", action="store_true", help="without --quick")
    parser.add_argument("--only", default="", help="pairs whose name begins so")
    options = parser.parse_args()
    known = json.loads((HERE / "pairs.json").read_text())
    pairs = []
    for name, truth in known["data"].items():
        for kind in ("stated", "unstated"):
            pairs.append((f"{name}, {kind}", options.data / name / f"experiment_{kind}.json", False, truth))
    for name, truth in known["examples"].items():
        file = HERE.parent.parent / "examples" / name / "experiment.json"
        pairs.append((f"{name}, stated", file, False, truth))
        pairs.append((f"{name}, unstated", file, True, truth))
    counts, longest = {}, (0.0, "")
    print("| pair | verdict | says | judged | misfit → rest | CPU |\n|---|---|---|---|---|---|")
    for name, file, bare, truth in pairs:
        if not name.startswith(options.only):
            continue
        if not file.exists():
            print(f"| {name} | – | {file} is not there | skipped | | |")
            continue
        lines = [line for line in file.read_text().splitlines() if not line.lstrip().startswith("//")]
        experiment = absolute_paths(json.loads("\n".join(lines)), file.parent.resolve())
        with tempfile.TemporaryDirectory() as folder:
            result, words, seconds = diagnosed(options.program, without_noise(experiment) if bare else experiment,
                                      not options.full, pathlib.Path(folder))
        if result is None:
            print(f"| {name} | failed | {words.strip().splitlines()[-1]} | failed | | |")
            counts["failed"] = counts.get("failed", 0) + 1
            continue
        diagnosis = result["diagnosis"]
        judgement = judged(diagnosis["verdict"], answer(result), truth["leads"])
        counts[judgement] = counts.get(judgement, 0) + 1
        budget = diagnosis["budget"]
        rest = budget["steps"][-1]["rms"] if budget["steps"] else budget["rms"]
        print(f'| {name} | {diagnosis["verdict"]} | {(diagnosis["reasons"] or ["–"])[0]} | {judgement} | '
              f'{100 * budget["rms"]:.2g} → {100 * rest:.2g} % | {seconds:.1f} s |', flush=True)
        longest = max(longest, (seconds, name))
    total = sum(counts.values())
    print()
    for what, count in sorted(counts.items()):
        print(f"{what}: {count} of {total} ({count / total:.2f})")
    print(f"longest: {longest[1]}, {longest[0]:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
