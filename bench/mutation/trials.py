# SPDX-License-Identifier: Apache-2.0
"""Runs test cases against mutants: which cases reach which mutant, and which mutants they notice.

Time is that of the processor, so that neither verdicts nor the order of cases depend on what else the machine does."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import tempfile
import threading

SPARE = 20      # seconds that a trial has beyond ten times what its cases take without a mutant
STANDING = 30   # a trial that takes so many times its limit by the clock stands still
LONG_SUITE = 4  # seconds: a longer suite is looked at case by case


def run(program, cases, mutant, reach=None, limit=600):
    """(fails, seconds) of some cases of a program. A crash and a time-out are failures.

    A program may also be the words of a command, which is a test as a whole."""
    environment = dict(os.environ, TUNICA_MUTANT=str(mutant), GTEST_COLOR="no")
    if reach:
        environment["TUNICA_MUTANT_REACH"] = str(reach)
    with tempfile.TemporaryDirectory(prefix="tunica-mutant-") as folder:
        flags = folder + "/flags"  # thousands of names do not fit on a command line
        pathlib.Path(flags).write_text("--gtest_filter=" + ":".join(cases) + "\n--gtest_fail_fast\n")
        command = list(program) if isinstance(program, tuple) else [program, f"--gtest_flagfile={flags}"]
        process = subprocess.Popen(["prlimit", f"--cpu={int(limit) + 1}", *command],
                                   env=environment, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, start_new_session=True)
        # The programs that the tests have started end too.
        alarm = threading.Timer(STANDING * limit, os.killpg, (process.pid, 9))
        alarm.start()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)  # its number stays taken until the alarm is off
        alarm.cancel()
        alarm.join()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode != 0, used.ru_utime + used.ru_stime


def commands(build, names):
    """The commands of the tests of CTest whose names match, and that are no program of many cases."""
    listing = subprocess.run(["ctest", "--show-only=json-v1", "-R", names], cwd=build, capture_output=True, check=True)
    return [tuple(test["command"]) for test in json.loads(listing.stdout)["tests"]
            if not any(word.startswith("--gtest_filter") for word in test["command"])]


def title(program):
    return " ".join(pathlib.Path(word).name for word in program) if isinstance(program, tuple) else pathlib.Path(program).name


def cases_of(program):
    """Suite -> its cases, but for those that are switched off."""
    if isinstance(program, tuple):
        return {"": ["as a whole"]}
    listing = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    suite, found = "", {}
    for line in listing.splitlines():
        name = line.split("#")[0].rstrip()
        if line.startswith("  "):
            if "DISABLED_" not in suite + name:
                found.setdefault(suite, []).append(suite + name.strip())
        elif name.endswith("."):
            suite = name
    return found


def look(program, cases):
    """(seconds, numbers) of some cases with the record of what they reach; numbers is None where they fail."""
    with tempfile.TemporaryDirectory(prefix="tunica-reach-") as folder:
        record = pathlib.Path(folder) / "reach"
        fails, seconds = run(program, cases, "reach", record)
        numbers = sorted({int(line) for line in record.read_text().split()}) if record.exists() else []
    return seconds, None if fails else numbers


def look_at_suite(program, suite, cases):
    """Filter -> (seconds, numbers): of the suite, or of each of its cases where the suite is long or fails."""
    seconds, numbers = look(program, [suite + "*"])
    if numbers is not None and (seconds < LONG_SUITE or len(cases) == 1):
        return {suite + "*": (seconds, numbers)}
    return {case: look(program, [case]) for case in cases} if numbers is None or numbers else {}  # else it reaches nothing


def reach(programs, copies, state, jobs):
    """[(program, filter, seconds, numbers)]. Remembered as long as no copy and no name of the suite's cases changes; after
    another change of a test, remove reach.json."""
    file, found = state / "reach.json", []
    known = json.loads(file.read_text()) if file.exists() else {}
    for program in programs:
        work, seen = [], {}
        for suite, cases in cases_of(program).items():
            digest = hashlib.sha256(copies + "\n".join([str(program), *cases]).encode()).hexdigest()
            seen[digest] = known.get(digest)
            if seen[digest] is None:
                work.append((digest, suite, cases))
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            looks = pool.map(lambda entry: look_at_suite(program, *entry[1:]), work)
            for (digest, suite, _), looked in zip(work, looks):
                known[digest] = seen[digest] = looked
                for name in [name for name, (_, numbers) in looked.items() if numbers is None]:
                    print(f"  {title(program)} {name} fails without a mutant; left out", flush=True)
                file.write_text(json.dumps(known))
        own = [(program, name, seconds, set(numbers)) for looked in seen.values()
               for name, (seconds, numbers) in looked.items() if numbers]
        print(f"  {title(program)}: {len(own)} suites and cases reach a mutant, "
              f"{sum(case[2] for case in own):.0f} s", flush=True)
        found += own
    return found


def attempt(mutant, cases, budget):
    """Runs what reaches a mutant, the quick first, until one notices it; returns the mutant with its verdict.

    A round takes about as long as all before it, and no round begins that the budget of seconds would not hold."""
    reaching = sorted((case for case in cases if mutant["number"] in case[3]), key=lambda case: case[2])
    verdict = {**mutant, "verdict": "survived" if reaching else "not reached", "cases": 0, "of": len(reaching)}
    spent = 0.0
    while reaching:
        take, planned = 1, reaching[0][2]
        while take < len(reaching) and planned + reaching[take][2] <= max(spent, 2):
            planned += reaching[take][2]
            take += 1
        if spent and spent + planned > budget:
            break
        now, reaching = reaching[:take], reaching[take:]
        for program in dict.fromkeys(case[0] for case in now):
            own = [case for case in now if case[0] == program]
            fails, seconds = run(program, [case[1] for case in own], mutant["number"],
                                 limit=10 * sum(case[2] for case in own) + SPARE)
            spent += seconds
            verdict["cases"] += len(own)
            if fails:
                return {**verdict, "verdict": "killed", "by": title(program)}
    return verdict
