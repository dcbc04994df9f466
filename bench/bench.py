#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how fast tunica is, a row a kind of work, each beside its floor on the machine at hand. docs/performance.md says
how the figures come about.

    bench/bench.py                                  everything, a table on the terminal
    bench/bench.py --only '^(strip|tube)/'          some rows
    bench/bench.py --only '^fe/' --out times.json   adds rows to a file, or replaces them there
    bench/bench.py --only NONE --out times.json --page   writes the table of docs/performance.md from the file
"""
import argparse
import datetime
import json
import math
import os
import pathlib
import platform
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "performance"))
import programs  # noqa: E402
import table  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[1]
LEVELS = ("baseline", "avx2", "avx512")
VECTORISED = r"^(strip|sheet|tube|fe/four_node/25x50|fe/nine_node/8x20)/"


def in_process(build, only, quick, level=None, arguments=()):
    """Rows of bench_performance, with the program held to a vector level if one is given."""
    environment = dict(os.environ)
    environment.pop("TUNICA_VECTOR_LEVEL", None)
    if level:
        environment["TUNICA_VECTOR_LEVEL"] = level
    command = [str(build / "bin/bench_performance"), "--only", only, *(["--quick"] if quick else []), *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as child:
        for line in child.stdout:
            yield json.loads(line)
    if child.returncode != 0:
        raise programs.Failure(f"{' '.join(command)} ended with {child.returncode}")


def names_in_process(build, only):
    listed = subprocess.run([str(build / "bin/bench_performance"), "--list", "--only", only], capture_output=True, text=True, check=True)
    return listed.stdout.split()


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def machine(build):
    cache = (build / "CMakeCache.txt").read_text() if (build / "CMakeCache.txt").exists() else ""
    found = re.search(r"^CMAKE_CXX_COMPILER:[A-Z]+=(.*)$", cache, re.M)
    version = subprocess.run([found.group(1), "--version"], capture_output=True, text=True).stdout.splitlines() if found else []
    return {"processor": processor(), "cores": os.cpu_count(), "compiler": version[0] if version else "compiler unknown",
            "system": platform.platform()}


def fit_meshes(rows):
    """The growth of finite elements over their meshes: time over nodes, for each element and each kind of result."""
    families = {}
    for row in rows:
        match = re.match(r"^fe/(\w+)/(\d+)x(\d+)/(values|one_channel|three_channels)$", row["name"])
        if match:
            families.setdefault((match.group(1), match.group(4)), []).append((int(row["size"].split()[0]), row))
    for members in families.values():
        members.sort(key=lambda member: member[0])
        if len(members) < 3:
            continue
        x = [math.log(nodes) for nodes, _ in members]
        y = [math.log(row["time_s"]) for _, row in members]
        mx, my = sum(x) / len(x), sum(y) / len(y)
        exponent = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)
        for _, row in members:
            row["growth"] = {"by": "nodes", "sizes": [nodes for nodes, _ in members],
                             "times_s": [row["time_s"] for _, row in members], "exponent": exponent}


def strip_floors(build, quick):
    """Seconds of objective and Jacobian of two strips of 40 points by level, measured now, once."""
    kept = {}

    def floors():
        if not kept:
            rows = list(in_process(build, "^strip/gho/(objective|jacobian)$", quick, arguments=() if quick else ("--rounds", "7")))
            for one, other in zip(rows[0]["floors"], rows[1]["floors"]):
                kept[one["level"]] = (one["time_s"], other["time_s"])
        return kept
    return floors


def measured(build, options):
    """The rows that are asked for, as they come."""
    whole = programs.Programs(build, options.quick, strip_floors(build, options.quick))
    if options.levels:
        for level in LEVELS:
            for row in in_process(build, options.only if options.only != "." else VECTORISED, options.quick, level):
                yield row
        return
    for row in in_process(build, options.only, options.quick):
        if row["name"] in ("strip/gho/objective", "strip/gho/jacobian") and not options.no_peers:
            found = whole.scipy()
            if found:
                time = found["objective_s" if row["name"].endswith("objective") else "jacobian_s"]
                row["peers"].append({"what": "numpy" if row["name"].endswith("objective") else "numpy, scipy's differences", "level": "",
                                     "time_s": time, "ratio": row["time_s"] / time})
        yield row
    for name, make in whole.table().items():
        if re.search(options.only, name):
            yield make()


def merge(document, rows):
    places = {row["name"]: k for k, row in enumerate(document["rows"])}
    for row in rows:
        if row["name"] in places:
            document["rows"][places[row["name"]]] = row
        else:
            document["rows"].append(row)
    fit_meshes(document["rows"])


def save(out, document):
    if out:
        unfinished = out.with_name(out.name + ".part")
        unfinished.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
        unfinished.replace(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build/release", help="build folder (build/release)")
    parser.add_argument("--only", default=".", metavar="REGEX", help="rows whose name contains this")
    parser.add_argument("--list", action="store_true", help="names of the rows")
    parser.add_argument("--quick", action="store_true", help="short samples, no growth: for a look, not for a figure")
    parser.add_argument("--levels", action="store_true", help="rows in process once for every set of vector instructions")
    parser.add_argument("--no-peers", action="store_true", help="without numpy and scipy")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="JSON; rows of an existing file stay or are replaced")
    parser.add_argument("--page", nargs="?", type=pathlib.Path, const=SOURCE / "docs/performance.md", metavar="FILE",
                        help="writes the table of this page (docs/performance.md) from all rows of --out")
    options = parser.parse_args()
    build = options.build.resolve()
    if options.list:
        print("\n".join(names_in_process(build, options.only)))
        print("\n".join(name for name in programs.Programs(build, True, None).names() if re.search(options.only, name)))
        return 0
    document = {"format": 1, "machine": machine(build), "rows": []}
    if options.out and options.out.exists():
        document["rows"] = json.loads(options.out.read_text())["rows"]
    fresh = []
    try:
        for row in measured(build, options):
            row["date"] = datetime.date.today().isoformat()
            print(f"{row['name']:<44} {table.seconds(row['time_s']):>9}  {table.ratio_words(row)}", file=sys.stderr, flush=True)
            fresh.append(row)
            merge(document, [row])
            save(options.out, document)  # at once: whoever ends this keeps what was measured
    except programs.Failure as failure:
        print(f"bench.py: {failure}", file=sys.stderr)
        return 1
    if fresh:
        print(table.terminal(fresh))
    save(options.out, document)
    if options.page:
        table.write_page(options.page, document)
    return 0


if __name__ == "__main__":
    sys.exit(main())
