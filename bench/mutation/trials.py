# SPDX-License-Identifier: Apache-2.0
"""Runs test cases against mutants: which cases reach which mutant, and which mutants they notice."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import tempfile
import time

SPARE = 20  # seconds that a trial has beyond ten times what its cases take without a mutant


def run(program, cases, mutant, reach=None, limit=600):
    """(fails, seconds) of some cases of a program. A crash and a time-out are failures."""
    environment = dict(os.environ, TUNICA_MUTANT=str(mutant), GTEST_COLOR="no")
    if reach:
        environment["TUNICA_MUTANT_REACH"] = str(reach)
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="tunica-mutant-") as folder:
        flags = folder + "/flags"  # thousands of names do not fit on a command line
        pathlib.Path(flags).write_text("--gtest_filter=" + ":".join(cases) + "\n--gtest_fail_fast\n")
        process = subprocess.Popen([program, f"--gtest_flagfile={flags}"], env=environment, cwd=folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   start_new_session=True)
        try:
            fails = process.wait(limit) != 0
        except subprocess.TimeoutExpired:
            fails = True
            os.killpg(process.pid, 9)  # the programs that the tests have started too
            process.wait()
    return fails, time.monotonic() - start


def cases_of(program):
    listing = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    suite, found = "", []
    for line in listing.splitlines():
        name = line.split("#")[0].rstrip()
        if line.startswith("  "):
            if "DISABLED_" not in suite + name:
                found.append(suite + name.strip())
        elif name.endswith("."):
            suite = name
    return found


def look(job):
    """One case with the record of what it reaches: (program, case, seconds, numbers); None where it fails by itself."""
    program, case = job
    with tempfile.TemporaryDirectory(prefix="tunica-reach-") as folder:
        record = pathlib.Path(folder) / "reach"
        fails, seconds = run(program, [case], "reach", record)
        numbers = sorted({int(line) for line in record.read_text().split()}) if record.exists() else []
    return program, case, seconds, None if fails else numbers


def reach(programs, copies, state, jobs):
    """(program, case) -> (seconds, numbers). What neither the copies nor a program's file has changed is remembered."""
    file, found = state / "reach.json", []
    known = json.loads(file.read_text()) if file.exists() else {}
    for program in programs:
        digest = hashlib.sha256(copies + pathlib.Path(program).read_bytes()).hexdigest()
        if known.get(program, {}).get("hash") != digest:
            known[program] = {"hash": digest, "cases": {}}
            with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
                for _, case, seconds, numbers in pool.map(look, [(program, case) for case in cases_of(program)]):
                    if numbers is None:
                        print(f"  {pathlib.Path(program).name} {case} fails without a mutant; left out", flush=True)
                    elif numbers:
                        known[program]["cases"][case] = (seconds, numbers)
            file.write_text(json.dumps(known))
        cases = known[program]["cases"]
        print(f"  {pathlib.Path(program).name}: {len(cases)} cases reach a mutant, {sum(c[0] for c in cases.values()):.0f} s",
              flush=True)
        found += [(program, case, seconds, set(numbers)) for case, (seconds, numbers) in cases.items()]
    return found


def batches(cases, budget):
    """The quick cases first, each batch about as long as all before it, within the budget of seconds."""
    batch, spent, size = [], 0.0, 2.0
    for case in sorted(cases, key=lambda case: case[2]):
        if spent and spent + case[2] > budget:
            break
        batch.append(case)
        spent += case[2]
        if spent > size:
            yield batch
            batch, size = [], 2 * spent
    if batch:
        yield batch


def attempt(mutant, cases, budget):
    """Runs the cases that reach a mutant until one notices it; returns the mutant with its verdict."""
    reaching = [case for case in cases if mutant["number"] in case[3]]
    verdict = {**mutant, "verdict": "not reached" if not reaching else "survived", "cases": 0, "of": len(reaching)}
    for batch in batches(reaching, budget):
        for program in sorted({case[0] for case in batch}):
            own = [case for case in batch if case[0] == program]
            fails, _ = run(program, [case[1] for case in own], mutant["number"],
                           limit=10 * sum(case[2] for case in own) + SPARE)
            verdict["cases"] += len(own)
            if fails:
                return {**verdict, "verdict": "killed", "by": pathlib.Path(program).name}
    return verdict
