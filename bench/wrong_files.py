#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The blind benchmark of files that say what is not so: write honest data of a true base model into files with one
mistake, and honest files with a real effect; let tunica diagnose them, and count.

    bench/wrong_files.py OUT                   every mistake once, development seed 301
    bench/wrong_files.py OUT --draws 3         three specimens of each
    bench/wrong_files.py OUT --reduced         every fourth mistake
    bench/wrong_files.py OUT --only measure    mistakes whose name has this word
    bench/wrong_files.py OUT --unstated        nobody states the noise
    bench/wrong_files.py OUT --full            without --quick

A mistake is right where it, or one that the data cannot tell from it, is `named`, or `tied`: it stands in the verdict as
a question. `look-alike`: a cause in the rig that the catalogue lists as its look-alike is in the verdict. `false science`:
another cause, or a term, is the verdict and no question is asked. Two strips alone are counted by themselves, because they
often cannot tell a mistake from an effect; honest files with an error of the rig too, because the group `file` has such
errors. Nothing here links or calls tunica but to diagnose. Needs numpy and scipy."""
import argparse
import concurrent.futures
import os
import pathlib
import sys
import typing

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
from false_records.case import honest  # noqa: E402
from false_records.judgement import diagnosed, judged  # noqa: E402
from false_records.mistakes import Mistake, mistakes  # noqa: E402
from hidden_terms.generate import Spec, make  # noqa: E402

DEVELOPMENT_SEED = 301


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--draws", type=int, default=1)
    parser.add_argument("--reduced", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=DEVELOPMENT_SEED)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--unstated", action="store_true", help="nobody states the noise")
    parser.add_argument("--full", action="store_true", help="without --quick")
    parser.add_argument("--stride", type=int, default=1, help="every so many mistakes")
    parser.add_argument("--effects", type=int, default=4, help="honest files with a real effect, of each base and size")
    told = parser.parse_args()
    chosen = [one for one in mistakes() if told.only in one.name][::4 if told.reduced else told.stride]
    jobs: typing.List[typing.Tuple[pathlib.Path, typing.Optional[Mistake], typing.List[str]]] = []
    for mistake in chosen:
        for k in range(told.draws):
            case = honest(mistake.base, told.seed + k, mistake.kind == "angle", mistake.name.startswith("tube"))
            if mistake.only:
                case.keep(mistake.only)
            everything = list(case.tests)
            mistake.spoil(case, mistake.tests or everything)
            group = "two strips alone" if mistake.only else "calibration" if mistake.mechanism else "mistakes"
            folder = told.out / group.replace(" ", "_") / f"{mistake.name}-{k}"
            case.write(folder, stated=not told.unstated)
            jobs.append((folder, mistake, everything))
    for base in ("gho", "hgo", "mooney_rivlin") if not told.only else ():
        for target in (60, 150):
            for k in range(told.effects):
                for what, folder in (("single", "effects"), ("rig", "rig_errors")):
                    name = make(Spec(what, base, target, k, "white", not told.unstated), told.seed, told.out / folder)
                    jobs.append((told.out / folder / "cases" / name, None, []))
        for k in range(told.effects):
            folder = told.out / "honest" / f"{base}-{k}"
            honest(base, told.seed + 1000 + k, False).write(folder, stated=not told.unstated)
            jobs.append((folder, None, []))
    with concurrent.futures.ThreadPoolExecutor(told.jobs) as pool:
        found = list(pool.map(lambda job: diagnosed(job[0], told.full), jobs))
    counts: typing.Dict[str, typing.List[str]] = {}
    for (folder, mistake, everything), (d, seconds) in zip(jobs, found):
        file = d.get("file", {})
        group = folder.relative_to(told.out).parts[0].replace("_", " ")
        if mistake is None:
            word = f"file {file.get('standing')}" if d.get("verdict") != "nothing_detected" else "silent"
        else:
            word = judged(d, mistake, mistake.tests or everything, everything)
        counts.setdefault(group, []).append(word)
        first = file["causes"][0] if file.get("causes") else {}
        print(f"{word:14} {folder.name:44} {seconds:6.1f} s {d.get('verdict')}; {file.get('standing')}, lead "
              f"{file.get('lead') if file.get('lead') is None else round(file['lead'], 1)}, p {first.get('p_after', 0):.3f}: {first.get('sentence', '')}")
    for group, words in counts.items():
        rates = ", ".join(f"{word} {words.count(word)}" for word in sorted(set(words)))
        print(f"{group}: {len(words)} files: {rates}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
