#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every check of the code that takes longer than the suite, in one command (`./bootstrap analyse`).

    bench/analyse.py                      all of them, hours on two cores: what runs nightly
    bench/analyse.py tidy cppcheck fuzz   some of them
    bench/analyse.py asan --tests Csv     of the sanitizers and valgrind only some tests

asan      the suite under AddressSanitizer and UndefinedBehaviorSanitizer
coverage  the share of lines of core and plugins that step asan has run, by gcov; its build counts them
tsan      the suite under ThreadSanitizer; its loops run on threads of the standard library, since TBB, as Debian builds
          it, hides from the sanitizer how it hands work over (cmake/loops_on_threads.hpp)
valgrind  every plugin of the release build under `tunica plugin check` in valgrind; logs: valgrind-PLUGIN.log
tidy      clang-tidy over core, plugins and apps
cppcheck  cppcheck over the same
fuzz      every fuzz target with libFuzzer for --seconds

The suite is here every test that is a program of the build, and the scripts that work with the program as a user does
(cohorts, rig files, shards, servers). Other scripts are left out: they build, install and read sources, start other
tools, or measure and damage the program from outside, and see nothing more under a sanitizer.

Logs: build/analysis/NAME.log. The exit code is 1 where a check has found something."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LOGS = ROOT / "build/analysis"
ENVIRONMENT = {  # a signal that a plugin dies of stays one, for the tests that look for it
    "asan": {"ASAN_OPTIONS": "detect_stack_use_after_return=1:strict_string_checks=1:handle_segv=0",
             "UBSAN_OPTIONS": "print_stacktrace=1", "LSAN_OPTIONS": f"suppressions={ROOT}/cmake/lsan.supp:print_suppressions=0"},
    "tsan": {"TSAN_OPTIONS": f"suppressions={ROOT}/cmake/tsan.supp:second_deadlock_stack=1:handle_segv=0"},
}


class Step:
    """One check: its commands go to a log, its figures to the table."""

    def __init__(self, name, options):
        self.name, self.options = name, options
        self.log = LOGS / f"{name}.log"
        self.log.write_text("")

    def run(self, *command, environment=None):
        with open(self.log, "a") as log:
            log.write("$ " + " ".join(map(str, command)) + "\n")
            log.flush()
            return subprocess.run(list(map(str, command)), cwd=ROOT, stdout=log, stderr=subprocess.STDOUT,
                                  env=dict(os.environ, **(environment or {}))).returncode

    def build(self, preset, *targets):
        if self.run("cmake", "--preset", preset):
            return False
        names = ["--target", *targets] if targets else []
        return self.run("cmake", "--build", f"build/{preset}", "-j", self.options.jobs, *names) == 0

    def text(self):
        return self.log.read_text(errors="replace")


USERS = re.compile(r"(Cohort|Discover|Rig|Serve|Shards)\.")  # scripts that work with the program


def programs_of(build, wanted):
    """Numbers of the tests that run programs of the build, as ctest -I reads them from a file."""
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, stdout=subprocess.PIPE)
    tests = json.loads(shown.stdout)["tests"]

    def run(test):
        return str(build) in test.get("command", [""])[0] or USERS.match(test["name"])

    return [number for number, test in enumerate(tests, 1) if run(test) and re.search(wanted or "", test["name"])]


def suite(step, preset):
    """Builds a preset and runs its tests; returns whether all passed, and how many."""
    if not step.build(preset, *step.options.target):
        return False, "does not build"
    build, chosen = ROOT / "build" / preset, LOGS / f"{step.name}-tests.txt"
    chosen.write_text("0,0,0," + ",".join(map(str, programs_of(build, step.options.tests))))
    code = step.run("ctest", "--test-dir", build, "--output-on-failure", "--timeout", "3600", "-j", step.options.jobs,
                    "-I", chosen, environment=ENVIRONMENT[step.name])
    verdict = re.findall(r"^(\d+)% tests passed, (\d+) tests failed out of (\d+)", step.text(), re.M)
    return code == 0, f"{verdict[-1][1]} of {verdict[-1][2]} tests failed" if verdict else "no verdict"


def asan(step):
    return suite(step, "asan-ubsan")


def tsan(step):
    return suite(step, "tsan")


def coverage(step):
    code = step.run("gcovr", "--root", ".", "--object-directory", "build/asan-ubsan", "--filter", "core/", "--filter",
                    "plugins/", "--gcov-ignore-parse-errors", "--exclude-throw-branches", "--txt",
                    "build/analysis/coverage.txt", "--print-summary", "-j", step.options.jobs)
    lines = re.findall(r"^lines: ([\d.]+)% \((\d+) out of (\d+)\)", step.text(), re.M)
    return code == 0 and bool(lines), f"{lines[-1][0]} % of {lines[-1][2]} lines" if lines else "no figure"


def valgrind_one(plugin):
    """Whether valgrind finds something in a plugin: findings begin with ==PID==. Properties that fail say nothing of
    memory: they run in the suite, and here some come to their limits of time."""
    log = LOGS / f"valgrind-{plugin.stem}.log"
    command = ["valgrind", "--quiet", "--error-exitcode=99", "--leak-check=no",
               f"--suppressions={ROOT}/cmake/valgrind.supp", "build/release/bin/tunica",
               "--allow-world-writable-plugins", "plugin", "check", plugin, "--time-limit", 7200]
    with open(log, "w") as file:
        subprocess.run(list(map(str, command)), cwd=ROOT, stdout=file, stderr=subprocess.STDOUT)
    return re.search(r"^==\d+== ", log.read_text(errors="replace"), re.M) is not None


def valgrind(step):
    if not step.build("release", "product"):
        return False, "does not build"
    plugins = [plugin for plugin in sorted((ROOT / "build/release/lib").rglob("tunica/plugins/*.so"))
               if not step.options.tests or re.search(step.options.tests, plugin.stem)]
    with concurrent.futures.ThreadPoolExecutor(step.options.jobs) as pool:
        wrong = [plugin.stem for plugin, found in zip(plugins, pool.map(valgrind_one, plugins)) if found]
    with open(step.log, "a") as log:
        log.writelines(f"{'FOUND' if plugin.stem in wrong else 'clean'}  valgrind-{plugin.stem}.log\n" for plugin in plugins)
    return not wrong and bool(plugins), f"{len(plugins)} plugins, {len(wrong)} with findings" + "".join(f" {one}" for one in wrong)


def tidy(step):
    if step.run("cmake", "--preset", "dev", "-B", "build/tidy", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=16"):
        return False, "cannot be configured"
    code = step.run("cmake", "--build", "build/tidy", "--target", "lint")
    findings = re.findall(r"(?:error|warning): .*\[", step.text())
    return code == 0, f"{len(findings)} findings"


def cppcheck(step):
    cache = LOGS / "cppcheck"
    cache.mkdir(exist_ok=True)
    code = step.run("cppcheck", "--quiet", "-j", step.options.jobs, "--enable=warning,performance,portability",
                    "--inline-suppr", "--std=c++20", "--error-exitcode=1", f"--cppcheck-build-dir={cache}", "-I",
                    "core/include", "-I", "core/src", f"--suppressions-list={ROOT}/cmake/cppcheck.txt",
                    "--template={file}:{line}: {id}: {message}", "core/src", "plugins", "apps")
    return code == 0, f"{len(re.findall(r'^[^$ ][^:]*:[0-9]+: ', step.text(), re.M))} findings"


def fuzz_one(step, target):
    """(name, exit code, executions) of one target; it keeps what it has found in its log."""
    name = target.name.removesuffix("_fuzzer")
    grown, found, log = LOGS / "corpus" / name, LOGS / "findings" / name, LOGS / f"fuzz-{name}.log"
    grown.mkdir(parents=True, exist_ok=True)
    found.mkdir(parents=True, exist_ok=True)
    command = [target, grown, f"tests/fuzz/corpus/{name}", f"-dict=tests/fuzz/dictionaries/{name}.dict",
               f"-artifact_prefix={found}/", f"-max_total_time={step.options.seconds}", "-timeout=20",
               "-rss_limit_mb=4096", "-max_len=8192", "-print_final_stats=1", "-print_funcs=0"]
    in_memory = {"TMPDIR": "/dev/shm"} if pathlib.Path("/dev/shm").is_dir() else {}  # some write a file an execution
    with open(log, "w") as file:
        code = subprocess.run(list(map(str, command)), cwd=ROOT, stdout=file, stderr=subprocess.STDOUT,
                              env=dict(os.environ, **ENVIRONMENT["asan"], **in_memory)).returncode
    counted = re.findall(r"^stat::number_of_executed_units: (\d+)", log.read_text(errors="replace"), re.M)
    return name, code, int(counted[-1]) if counted else 0


def fuzz(step):
    if not step.build("fuzz", "fuzz_targets"):
        return False, "does not build"
    targets = [target for target in sorted((ROOT / "build/fuzz/bin").glob("*_fuzzer"))
               if not step.options.tests or re.search(step.options.tests, target.name)]
    with concurrent.futures.ThreadPoolExecutor(step.options.jobs) as pool:
        results = list(pool.map(lambda target: fuzz_one(step, target), targets))
    wrong = [name for name, code, _ in results if code]
    with open(step.log, "a") as log:
        log.writelines(f"{name}: exit code {code}, {executions} executions\n" for name, code, executions in results)
    return not wrong and bool(results), (f"{sum(executions for *_, executions in results)} executions of {len(results)} "
                                         "targets" + "".join(f"; a finding of {name}" for name in wrong))


STEPS = {"cppcheck": cppcheck, "tidy": tidy, "asan": asan, "coverage": coverage, "tsan": tsan, "valgrind": valgrind,
         "fuzz": fuzz}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("steps", nargs="*", metavar="STEP", help=f"of {', '.join(STEPS)}; all without any")
    parser.add_argument("--tests", metavar="REGEX", help="only these tests, plugins or fuzz targets")
    parser.add_argument("--target", nargs="+", default=[], help="build only these targets of the suite")
    parser.add_argument("--seconds", type=int, default=600, help="of each fuzz target")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    unknown = [step for step in options.steps if step not in STEPS]
    if unknown:
        parser.error(f"found the step '{unknown[0]}', expected one of {', '.join(STEPS)}")
    LOGS.mkdir(parents=True, exist_ok=True)
    clean = True
    for name in options.steps or STEPS:
        start = time.monotonic()
        passed, words = STEPS[name](Step(name, options))
        clean = clean and passed
        print(f"{name:10} {'clean' if passed else 'FOUND'}  {time.monotonic() - start:7.0f} s  {words}  "
              f"({LOGS.relative_to(ROOT) / name}.log)", flush=True)
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
