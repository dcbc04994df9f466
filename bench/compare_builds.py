#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the speed of two builds, one after the other in turn, and says what became slower beyond the noise.

    bench/compare_builds.py OLD/build/release build/release --only '^(strip|tube)/' --rounds 9

Each round starts bench_performance of both builds, in the order A B, then B A. A row's figure is the mean of ln(B/A)
over the rounds; its interval is Student's, at a confidence shared out among all rows (Bonferroni), so that all of them
together hold with the stated one. A row counts as slower where its whole interval lies above the margin. Exit code 1: something
is slower; 2: it could not be measured.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys

DEFAULT = (r"^(point/(gho|neo_hooke|composed)/|strip/|sheet/|tube/|fe/(four_node/25x50|nine_node/8x20)/|optimizer/es$|search/es/one"
           r"|constraint/|journal/)")


class Failure(Exception):
    pass


def student_tail(t, freedom):
    """P(T > t) for t ≥ 0: the density integrated with x = √n tan φ, which makes it a power of cos φ (Simpson's rule)."""
    low, steps = math.atan(t / math.sqrt(freedom)), 2000
    h = (math.pi / 2 - low) / steps
    total = sum((1 if k in (0, steps) else 4 if k % 2 else 2) * math.cos(low + k * h) ** (freedom - 1) for k in range(steps + 1))
    factor = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(math.pi)
    return factor * total * h / 3


def student_quantile(tail, freedom):
    """t with P(T > t) = tail, by bisection."""
    low, high = 0.0, 1.0
    while student_tail(high, freedom) > tail:
        high *= 2
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if student_tail(middle, freedom) > tail else (low, middle)
    return (low + high) / 2


def times(build, only, samples, quick):
    """Seconds of each row in one process of a build."""
    program = pathlib.Path(build) / "bin/bench_performance"
    command = [str(program), "--only", only, "--bare", *(["--quick"] if quick else ["--rounds", str(samples)])]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except OSError as problem:
        raise Failure(f"{program} cannot be started: {problem.strerror}. Build the target bench_performance there.") from None
    if done.returncode != 0:
        raise Failure(f"{program} ended with {done.returncode}: {done.stderr.strip()}")
    rows = [json.loads(line) for line in done.stdout.splitlines()]
    if not rows:
        raise Failure(f"no row of {program} matches {only}")
    return {row["name"]: row["time_s"] for row in rows}


def interval(ratios, tail):
    """Mean and half width of the logarithms."""
    mean = statistics.fmean(ratios)
    half = student_quantile(tail, len(ratios) - 1) * statistics.stdev(ratios) / math.sqrt(len(ratios))
    return mean, half


def compare(a, b, options):
    logs, last = {}, {}
    for k in range(options.rounds):
        order = ("a", "b") if k % 2 == 0 else ("b", "a")
        found = {which: times(a if which == "a" else b, options.only, options.samples, options.quick) for which in order}
        for name in found["a"]:
            if name in found["b"]:
                logs.setdefault(name, []).append(math.log(found["b"][name] / found["a"][name]))
                last.setdefault(name, []).append(found["a"][name])
        print(f"round {k + 1} of {options.rounds}", file=sys.stderr, flush=True)
    if not logs:
        raise Failure("the two builds have no row in common")
    tail = (1 - options.confidence) / 2 / len(logs)
    rows = []
    for name, ratios in logs.items():
        mean, half = interval(ratios, tail)
        verdict = "slower" if mean - half > math.log1p(options.margin) else "faster" if mean + half < -math.log1p(options.margin) else "same"
        rows.append({"name": name, "time_a_s": statistics.median(last[name]), "ratio": math.exp(mean), "low": math.exp(mean - half),
                     "high": math.exp(mean + half), "verdict": verdict})
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", type=pathlib.Path, metavar="BUILD_A", help="the build to compare with")
    parser.add_argument("b", type=pathlib.Path, metavar="BUILD_B", help="the build that must not be slower")
    parser.add_argument("--only", default=DEFAULT, metavar="REGEX", help="rows of bench_performance; without it the quick ones")
    parser.add_argument("--rounds", type=int, default=9, help="processes of each build (9; at least 3)")
    parser.add_argument("--samples", type=int, default=5, help="samples a row and process (5)")
    parser.add_argument("--confidence", type=float, default=0.99, help="that no row at all is called wrongly (0.99)")
    parser.add_argument("--margin", type=float, default=0.02, help="change that nobody minds (0.02)")
    parser.add_argument("--quick", action="store_true", help="short samples: for a look")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="JSON")
    options = parser.parse_args()
    if options.rounds < 3 or not 0 < options.confidence < 1 or options.margin < 0:
        parser.error("at least 3 rounds, a confidence between 0 and 1, no negative margin")
    try:
        rows = compare(options.a, options.b, options)
    except Failure as failure:
        print(f"compare_builds.py: {failure}", file=sys.stderr)
        return 2
    width = max(len(row["name"]) for row in rows)
    for row in rows:
        print(f"{row['name']:<{width}}  {row['time_a_s'] * 1e6:>12.3f} us  B/A {row['ratio']:.3f}  ({row['low']:.3f} to {row['high']:.3f})"
              f"  {'' if row['verdict'] == 'same' else row['verdict'].upper()}".rstrip())
    slower = [row["name"] for row in rows if row["verdict"] == "slower"]
    print(f"{len(rows)} rows, {options.rounds} rounds; with {100 * options.confidence:g} % confidence in all of them together, "
          f"slower by more than {100 * options.margin:g} %: " + (", ".join(slower) if slower else "none"))
    if options.out:
        options.out.write_text(json.dumps({"format": 1, "rounds": options.rounds, "confidence": options.confidence,
                                           "margin": options.margin, "rows": rows}, indent=1) + "\n", encoding="utf-8")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
