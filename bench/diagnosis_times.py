#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many seconds of processor time a diagnosis takes: every example, and generated files of a few classes.

    bench/diagnosis_times.py                          build/release, --quick
    bench/diagnosis_times.py --full                   without --quick
    bench/diagnosis_times.py --only memory            files whose name has this word
    bench/diagnosis_times.py --draws 3                three specimens of each generated class

Seconds are those of the user mode, of all threads together. Generated files have a base model that is too simple and a
misfit that nothing lists, so that everything is searched: with the noise stated (1 % of each range), and without.
Examples that state noise are diagnosed without it, too. Examples with finite elements, external programs or fields need
--costly: each fit of theirs is a series of simulations.
Prints each file, and a table with median, worst and slowest file of each class. Needs numpy and scipy."""
import argparse
import json
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import typing
import zlib

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np  # noqa: E402

from hidden_terms.bases import curves, draw  # noqa: E402
from hidden_terms.case_files import model_entry  # noqa: E402
from hidden_terms.protocol import observe  # noqa: E402
from real.real import absolute_paths, without_noise  # noqa: E402
from false_records.case import NOISE, Case  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
COSTLY = ("fe_pressurisation", "external", "full_field", "plane_specimen")
SEED = 601


def read(file: pathlib.Path) -> typing.Dict[str, typing.Any]:
    """An experiment file without its comments."""
    return json.loads(re.sub(r"(^|\s)//.*$", "", file.read_text(), flags=re.MULTILINE))


def drawn(base: str, random: np.random.Generator, tubes: bool) -> Case:
    """An honest file of a true model."""
    while True:
        try:
            form = draw(base, random)
            protocol = curves(base, form, random)
            case = Case(base, protocol, observe(protocol, form.material), random)
            if tubes:
                case.add_tubes(form.material)
            return case
        except ArithmeticError:
            continue


def missed(case: Case, base: str) -> Case:
    """The file of a case with another base model, beside a wave of 2 % of each range that nothing lists."""
    case.base, case.model = base, model_entry(base)
    for name, test in case.tests.items():
        for channel in test["data"]["noise"]:
            values = case.tables[name][channel]
            wave = np.sin(np.linspace(case.random.uniform(0, 6), 8, len(values)))
            case.tables[name][channel] = values + 0.02 * float(np.ptp(values)) * wave
    return case


def strips(random: np.random.Generator) -> Case:
    case = drawn("gho", random, False)
    case.keep(["circumferential_strip", "axial_strip"])
    return missed(case, "hgo")


def with_tubes(random: np.random.Generator) -> Case:
    case = drawn("gho", random, True)
    case.keep(["circumferential_strip", "axial_strip", "tube_110", "tube_125", "tube_140"])
    return missed(case, "hgo")


def sheets(random: np.random.Generator) -> Case:
    return missed(drawn("gho", random, False), "hgo")


def rubber(random: np.random.Generator) -> Case:
    return missed(drawn("mooney_rivlin", random, False), "neo_hooke")


def memory(random: np.random.Generator) -> Case:
    """Two cyclic strips of 350 rows each: a Maxwell branch beside rubber, pulled three times, at two rates."""
    case = drawn("neo_hooke", random, False)
    case.keep([])
    for name, rate in (("slow", 0.01), ("fast", 0.2)):
        phase = np.linspace(0, 3, 350)
        stretch = 1 + 0.6 * (1 - np.abs(2 * (phase % 1) - 1))
        time = np.append(0, np.cumsum(np.abs(np.diff(stretch)))) / rate
        elastic = 200 * (stretch**2 - 1 / stretch)
        branch, kept, relaxation = np.zeros_like(elastic), 0.0, random.uniform(3, 10)
        for k in range(1, len(time)):
            step = (time[k] - time[k - 1]) / relaxation
            kept = kept * np.exp(-step) + 0.4 * np.exp(-step / 2) * (elastic[k] - elastic[k - 1])
            branch[k] = kept
        case.tables[name] = {"stretch": stretch, "stress": elastic + branch, "time": time}
        case.tests[name] = {"type": "uniaxial", "direction": "axial", "data": {
            "file": f"{name}.csv", "order": "loading", "columns": {key: key for key in case.tables[name]},
            "noise": {"stress": {"absolute": 1.0}}}}
    return missed(case, "neo_hooke")


CLASSES: typing.Dict[str, typing.Callable[[np.random.Generator], Case]] = {
    "strips": strips, "strips and tubes": with_tubes, "sheets": sheets, "rubber": rubber, "memory, 700 rows": memory}


def costly(experiment: typing.Dict[str, typing.Any]) -> bool:
    used = experiment["runs"][0].get("tests", list(experiment["tests"]))
    return any(experiment["tests"][name]["type"] in COSTLY for name in used if name in experiment["tests"])


def states_noise(node: typing.Any) -> bool:
    if isinstance(node, dict):
        return "noise" in node or any(states_noise(one) for one in node.values())
    return False


def files(draws: int) -> typing.Iterator[typing.Tuple[str, str, typing.Callable[[pathlib.Path], None]]]:
    """Class, name, and what writes the file into a folder."""
    def written(experiment: typing.Dict[str, typing.Any]) -> typing.Callable[[pathlib.Path], None]:
        return lambda folder: (folder / "experiment.json").write_text(json.dumps(experiment)) and None

    for file in sorted((ROOT / "examples").glob("*/*.json")):
        experiment = read(file)
        if "tests" not in experiment or "runs" not in experiment:
            continue
        experiment = absolute_paths(experiment, file.parent)
        kind = "costly examples" if costly(experiment) else "examples"
        name = f"{file.parent.name}/{file.stem}"
        yield kind, name, written(experiment)
        if states_noise(experiment["tests"]) or "noise" in experiment:
            yield kind, f"{name}, no noise stated", written(without_noise(json.loads(json.dumps(experiment))))
    for kind, make in CLASSES.items():
        for k in range(draws):
            for stated in (True, False):
                def write(folder: pathlib.Path, make: typing.Any = make, kind: str = kind, k: int = k, stated: bool = stated) -> None:
                    make(np.random.default_rng([SEED, zlib.crc32(kind.encode()), k])).write(folder, NOISE, stated)
                yield kind, f"{kind} {k}{'' if stated else ', no noise stated'}", write


def diagnosed(program: str, folder: pathlib.Path, full: bool, limit: float) -> typing.Tuple[float, str]:
    """Seconds, and the verdict or what went wrong."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    try:
        told = subprocess.run([program, "diagnose", str(folder / "experiment.json"), *([] if full else ["--quick"]), "--quiet", "-o",
                               str(folder / "out")], capture_output=True, text=True, check=False, timeout=limit)
    except subprocess.TimeoutExpired:
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, f"stopped after {limit:g} s"
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if told.returncode != 0:
        return seconds, "refused: " + (told.stderr.strip().splitlines() or ["-"])[0]
    return seconds, json.loads((folder / "out" / "result.json").read_text())["diagnosis"]["verdict"]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--draws", type=int, default=2)
    parser.add_argument("--full", action="store_true", help="without --quick")
    parser.add_argument("--only", default="")
    parser.add_argument("--costly", action="store_true", help="also examples with finite elements")
    parser.add_argument("--limit", type=float, default=300, help="seconds by the clock after which a diagnosis is stopped")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for files and results")
    told = parser.parse_args()
    table: typing.Dict[str, typing.List[typing.Tuple[float, str]]] = {}
    with tempfile.TemporaryDirectory() as scratch:
        for kind, name, write in files(told.draws):
            if told.only not in name and told.only not in kind or kind == "costly examples" and not told.costly:
                continue
            folder = (told.keep or pathlib.Path(scratch)) / name.replace("/", "-").replace(",", "").replace(" ", "_")
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            write(folder)
            seconds, verdict = diagnosed(str(told.build / "bin/tunica"), folder, told.full, told.limit)
            print(f"{seconds:7.2f} s  {name:60} {verdict}", flush=True)
            if not verdict.startswith("refused"):
                table.setdefault(kind, []).append((seconds, name))
    print("\n| class | files | median | worst | slowest |\n|---|---|---|---|---|")
    for kind, rows in table.items():
        print(f"| {kind} | {len(rows)} | {statistics.median(s for s, _ in rows):.2f} s | {max(rows)[0]:.2f} s | {max(rows)[1]} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
