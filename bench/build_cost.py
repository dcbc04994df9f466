#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a cold build costs: core-seconds of what a first result needs, of the program and of everything, the most expensive
files and headers.

    bench/build_cost.py                             this checkout
    bench/build_cost.py --against OLD               and another checkout in the same run, with the ratio of the two
    bench/build_cost.py --target first_result -j 1  only what `./bootstrap run` builds before its result, one job
    bench/build_cost.py --target first_result --hold bench/build_cost.json
                                                    fails where it costs 10 % more than is written down there

Every build starts from an empty folder and as on a fresh machine: without a compiler cache, with precompiled headers. A
core-second is a second of processor time in user mode, of the compilers and of everything else that the build starts.
CMake's own configuration is not counted. Machines differ, and so does one machine beside other work. So each figure is
also given in compilations of bench/build_reference.cpp before and after the build; --hold compares this ratio.
"""
import argparse
import collections
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve()
SHOWN = 5
ALLOWED = 1.1  # a build that costs more than this share of what is written down is not held
TARGETS = {"first_result": "what a first result needs", "product": "the program and its plugins", "all": "everything"}
SYSTEM_INCLUDE = re.compile(r"^#include <((?:nlohmann|CLI|Eigen|boost|tbb|fmt|spdlog|valijson|ceres|pagmo|nlopt|gtest|gmock)"
                            r"[^>]*)>", re.M)


def used():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def compile_one(record, command):
    """Is the compiler of a build: runs c++ and writes what it cost."""
    command = ["c++", *command]
    status = subprocess.run(command).returncode
    source = next((word for word in command if word.endswith((".cpp", ".cxx", ".c"))), "?")
    with open(record, "a") as file:
        file.write(f"{used():.3f}\t{source}\n")
    return status


def build(checkout, target, jobs, folder):
    """Configures and builds in an empty folder; returns core-seconds, seconds and the cost of each file."""
    environment = dict(os.environ, CCACHE_DISABLE="1")
    record, compiler = folder / "record.tsv", folder / "c++"
    compiler.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{HERE}" --compile "{record}" "$@"\n')
    compiler.chmod(0o755)
    # An empty name is one that CMake does not look for.
    configure = ["cmake", "--preset", "release", "-B", str(folder / "build"), f"-DCMAKE_CXX_COMPILER={compiler}",
                 "-DCCACHE_PROGRAM="]
    subprocess.run(configure, cwd=checkout, env=environment, check=True, stdout=subprocess.DEVNULL)
    record.write_text("")
    before, start = used(), time.monotonic()
    command = ["cmake", "--build", str(folder / "build"), "-j", str(jobs), "--target", target]
    with open(folder / "log", "w") as log:
        if subprocess.run(command, env=environment, stdout=log, stderr=subprocess.STDOUT).returncode:
            sys.exit(f"{checkout}: the build failed:\n{(folder / 'log').read_text()[-2000:]}")
    files = [line.split("\t") for line in record.read_text().splitlines()]
    costs = sorted(((float(cost), readable(source, checkout)) for cost, source in files), reverse=True)
    return used() - before, time.monotonic() - start, costs


def readable(source, checkout):
    """plugins/models/gho/gho.cpp, or the target of a file that several sources were joined in."""
    joined = re.search(r"([^/]+)\.dir/Unity/(unity_\d+)", source)
    if joined:
        return f"{joined.group(1)} ({joined.group(2)})"
    path = pathlib.Path(source)
    return str(path.relative_to(checkout)) if path.is_relative_to(checkout) else path.name


def header_costs(checkout):
    """Core-seconds to compile a file that includes nothing but one header, and how many files include it."""
    sources = [path for folder in ("core", "plugins", "apps") for path in (checkout / folder).rglob("*.?pp")]
    users = collections.Counter()
    for source in sources:
        text = source.read_text()
        users.update(set(SYSTEM_INCLUDE.findall(text)) | set(re.findall(r'^#include "(tunica/[^"]+)"', text, re.M)))
    costs = []
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "file.cpp"
        for header, count in users.items():
            file.write_text(f'#include "{header}"\n')
            before = used()
            command = ["c++", "-std=c++20", "-fsyntax-only", "-I/usr/include/eigen3", f"-I{checkout}/core/include", str(file)]
            if subprocess.run(command, capture_output=True).returncode == 0:
                costs.append((used() - before, f"{header} (in {count} files)"))
    return sorted(costs, reverse=True)


def reference():
    """Core-seconds to compile bench/build_reference.cpp, which is no part of the project."""
    before = used()
    subprocess.run(["c++", "-std=c++20", "-O2", "-I/usr/include/eigen3", "-c", str(HERE.parent / "build_reference.cpp"),
                    "-o", os.devnull], check=True)
    return used() - before


def measure(checkout, target, jobs):
    """What build() returns, and the mean cost of the reference before and after it."""
    with tempfile.TemporaryDirectory(prefix="tunica-build-") as folder:
        before = reference()
        found = build(checkout, target, jobs, pathlib.Path(folder))
        return *found, (before + reference()) / 2


def held(target, ratio, file):
    """Whether the ratio is at most 10 % over the one that was written down."""
    known = json.loads(file.read_text())[target]
    print(f"  {ratio:.1f} reference compilations, {100 * (ratio / known - 1):+.0f} % of the {known:.1f} in {file.name}")
    return ratio <= ALLOWED * known


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--against", type=pathlib.Path, metavar="CHECKOUT", help="another checkout, built in the same run")
    parser.add_argument("--target", choices=[*TARGETS], help="only this; all three without it")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--no-headers", action="store_true", help="do not measure headers")
    parser.add_argument("--json", type=pathlib.Path, help="write the figures here too")
    parser.add_argument("--hold", type=pathlib.Path, metavar="FILE", help="ratios that are written down: {target: ratio}")
    options = parser.parse_args()
    checkouts = [HERE.parent.parent] + ([options.against.resolve()] if options.against else [])
    figures, too_much = {}, []
    for target in [options.target] if options.target else TARGETS:
        print(f"\nCold build of {TARGETS[target]}, {options.jobs} jobs")
        for checkout in checkouts:
            cores, seconds, costs, unit = measure(checkout, target, options.jobs)
            figures.setdefault(target, []).append({"checkout": str(checkout), "core_seconds": cores, "seconds": seconds,
                                                   "reference": unit, "ratio": cores / unit,
                                                   "files": costs[:SHOWN]})
            print(f"  {cores:8.0f} core-seconds, {seconds:6.0f} s, {len(costs):4d} files compiled, "
                  f"{cores / unit:.1f} times the reference of {unit:.1f} s   {checkout}", flush=True)
            if options.hold and checkout == checkouts[0] and not held(target, cores / unit, options.hold):
                too_much.append(target)
            for cost, name in costs[:SHOWN]:
                print(f"    {cost:8.1f}   {name}")
        if options.against:
            mine, other = (entry["core_seconds"] for entry in figures[target])
            print(f"  ratio {mine / other:.3f}, one part in {other / mine:.1f}", flush=True)
    if not options.no_headers:
        figures["headers"] = header_costs(checkouts[0])
        print("\nMost expensive headers, core-seconds of a file that includes nothing else")
        for cost, name in figures["headers"][:SHOWN]:
            print(f"    {cost:8.1f}   {name}")
    if options.json:
        options.json.write_text(json.dumps(figures, indent=2) + "\n")
    if too_much:
        sys.exit(f"a cold build of {' and '.join(too_much)} costs over 10 % more than {options.hold} allows. Find the file in "
                 "the list above, or write down the new ratio with its reason")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--compile"]:
        sys.exit(compile_one(sys.argv[2], sys.argv[3:]))
    main()
