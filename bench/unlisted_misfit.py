#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The blind benchmark of causes beside a smooth misfit that no hypothesis lists: hide a term of the energy, add to every
channel a smooth random curve of 1–3 % of its range, let tunica diagnose, and count what leads.

    bench/unlisted_misfit.py OUT                        development seed 401
    bench/unlisted_misfit.py OUT --cases 20 --lengths 0.25,1

The curves are Gaussian processes along the load; their length is a share of its range. Each case is diagnosed three
times: with cause and misfit, with the misfit alone, and with the cause alone. The true share of the cause is
a²/(a² + u²), a and u the misfits of the base in the other two. It is `right` where a term of the invariant, or a cause
of the energy, leads or is in the tie; `wrong` where anything else leads. Needs numpy and scipy."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import typing
import zlib

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np  # noqa: E402

from hidden_terms.bases import curves, draw  # noqa: E402
from hidden_terms.generate import draw_term, grown  # noqa: E402
from hidden_terms.protocol import observe  # noqa: E402
from wrong_files import Case, diagnosed  # noqa: E402

DEVELOPMENT_SEED = 401
NOISE = 0.005  # of the range of every channel
BASES = ("neo_hooke", "mooney_rivlin", "gho", "hgo")


def smooth(load: np.ndarray, length: float, random: np.random.Generator) -> np.ndarray:
    """A Gaussian process over the load, of root mean square 1."""
    u = (load - load.min()) / max(float(np.ptp(load)), 1e-12)
    covariance = np.exp(-0.5 * ((u[:, None] - u[None, :]) / length)**2) + 1e-9 * np.eye(len(u))
    values = np.linalg.cholesky(covariance) @ random.standard_normal(len(u))
    return values / max(float(np.sqrt(np.mean(values**2))), 1e-12)


class Hidden(typing.NamedTuple):
    folder: pathlib.Path
    invariant: str
    length: float


def write(base: str, length: float, number: int, seed: int, out: pathlib.Path) -> Hidden:
    random = np.random.default_rng([seed, zlib.crc32(base.encode()), int(1000 * length), number])
    while True:
        form = draw(base, random)
        try:
            protocol = curves(base, form, random)
            bare = observe(protocol, form.material)
            part = draw_term(base, form, protocol, random, "single")
            small = observe(protocol, (*form.material, grown(part, 1e-3)))
            break
        except ArithmeticError:
            continue
    # As large as 4 to 15 % of the range, before the base makes up for it.
    effect = np.sqrt(np.mean(((small - bare) / np.ptp(bare))**2)) / 1e-3
    amplitude = random.uniform(0.04, 0.15) / max(float(effect), 1e-12)
    full = observe(protocol, (*form.material, grown(part, amplitude)))
    folder = out / f"{base}-{length:g}-{number}"
    size = random.uniform(0.01, 0.03)
    unlisted: typing.Dict[typing.Tuple[str, str], np.ndarray] = {}
    for kind, readings, adds in (("both", full, True), ("alone", bare, True), ("cause", full, False)):
        case = Case(base, protocol, readings, np.random.default_rng([seed, number]))
        for name, table in case.tables.items():
            load = next(values for column, values in table.items() if "stress" not in column)
            for channel in [column for column in table if "stress" in column]:
                if (name, channel) not in unlisted:
                    unlisted[name, channel] = smooth(load, length, random)
                if adds:
                    table[channel] = table[channel] + size * float(np.ptp(table[channel])) * unlisted[name, channel]
        case.write(folder / kind)
    return Hidden(folder, part.invariant, length)


def leads(d: typing.Dict[str, typing.Any]) -> typing.List[str]:
    if d.get("verdict") == "leading":
        return [d["budget"]["lead"]["acts_like"]]
    if d.get("verdict") == "indistinguishable":
        return d["ambiguity_set"]
    if d.get("verdict") == "named":
        return [one["type"] for one in d["extension"]["mechanisms"]]
    return ["a term"] if d.get("verdict") == "discovered" else []


def is_right(said: typing.Sequence[str], invariant: str, group: typing.Dict[str, str]) -> bool:
    """A law of the invariant, or a mechanism of the material: those are names for changes of the energy."""
    word = "fibre" if invariant not in ("I1", "I2") else invariant
    return any(one == "a term" or one.startswith(word) or one.startswith("stretches") or group.get(one) == "material"
               for one in said)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--cases", type=int, default=5, help="of each base and length")
    parser.add_argument("--lengths", default="0.15,0.25,0.5,1,2")
    parser.add_argument("--seed", type=int, default=DEVELOPMENT_SEED)
    parser.add_argument("--jobs", type=int, default=2)
    told = parser.parse_args()
    cases = [write(base, float(length), k, told.seed, told.out) for base in BASES for length in told.lengths.split(",")
             for k in range(told.cases)]
    jobs = [case.folder / kind for case in cases for kind in ("both", "alone", "cause")]
    with concurrent.futures.ThreadPoolExecutor(told.jobs) as pool:
        found = dict(zip(jobs, pool.map(lambda folder: diagnosed(folder)[0], jobs)))
    table: typing.Dict[float, typing.Dict[str, typing.List[float]]] = {}
    for case in cases:
        both, alone, cause = (found[case.folder / kind] for kind in ("both", "alone", "cause"))
        if not both or not alone or not cause:
            continue
        a, u = cause["budget"]["rms"], alone["budget"]["rms"]
        true = a**2 / max(a**2 + u**2, 1e-12)
        group = {one["id"]: one["group"] for one in both["budget"].get("alone", [])}
        row = table.setdefault(case.length, {"leads right": [], "leads wrong": [], "alone leads": [], "share off": []})
        row["alone leads"].append(float(bool(leads(alone))))
        said = leads(both)
        print(f"{case.folder.name:28} true share {true:.2f}, hidden {case.invariant:10} {both['verdict']:17} {', '.join(said)}; "
              f"alone: {alone['verdict']} {', '.join(leads(alone))}")
        if true < 0.6:
            continue
        row["leads right"].append(float(bool(said) and is_right(said, case.invariant, group)))
        row["leads wrong"].append(float(bool(said) and not is_right(said, case.invariant, group)))
        steps = both["budget"]["steps"]
        if steps:
            row["share off"].append(float(abs(steps[0]["share"] - true) > 0.1))
    print("\n| length | cause of 60 % and more leads, right | leads, wrong | share off by more than 0.1 | misfit alone: something leads |\n|---|---|---|---|---|")
    for length, row in sorted(table.items()):
        mean = {key: f"{np.mean(values):.2f} of {len(values)}" if values else "–" for key, values in row.items()}
        print(f"| {length:g} | {mean['leads right']} | {mean['leads wrong']} | {mean['share off']} | {mean['alone leads']} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
