#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""slurm_test.py TUNICA [SPECIMENS]: a cohort over three nodes of a real Slurm, which is harmed while it works.

For 1, 2 and 7 shards: kill -9 of a slurmstepd, of a slurmd and of slurmctld, and a node set down. The merged files are
those of one machine, byte for byte, and Slurm has seen no job but those that tunica recorded. Ends with 77 where there
is no Slurm, or nobody may start one."""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # nothing is left beside the sources
from laboratory import Program, expect, expect_same, make_cohort, records

LOCAL = pathlib.Path(__file__).resolve().parent / "slurm_local.sh"
SPECIMENS = int(sys.argv[2]) if len(sys.argv) > 2 else 200
NODES = 3


def free_ports(count):
    """The first of `count` neighbouring ports that nobody listens to."""
    for first in range(20000 + os.getpid() % 5000, 60000, count):
        sockets = []
        try:
            for port in range(first, first + count):
                one = socket.socket()
                sockets.append(one)
                one.bind(("127.0.0.1", port))
            return first
        except OSError:
            continue
        finally:
            for one in sockets:
                one.close()
    raise SystemExit("no free ports")


class Slurm:
    def __init__(self, folder):
        self.folder = folder
        started = subprocess.run([LOCAL, "start", folder, str(NODES), str(free_ports(NODES + 1))], check=False)
        if started.returncode:
            self.stop()
            raise SystemExit(started.returncode)
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")

    def call(self, *words):
        subprocess.run([LOCAL, words[0], self.folder, *words[1:]], check=True)

    def stop(self):
        subprocess.run([LOCAL, "stop", self.folder], check=False)

    def kill(self, daemon):
        os.kill(int((self.folder / f"pid/{daemon}.pid").read_text(encoding="utf-8")), signal.SIGKILL)


def ask(*words):
    """What a command of Slurm says, asked again while a controller is on its way back."""
    for _ in range(60):
        ended = subprocess.run(words, capture_output=True, text=True, check=False)
        if ended.returncode == 0:
            return ended.stdout
        time.sleep(0.5)
    raise AssertionError(f"{' '.join(words)}: {ended.stderr}")


def processes_of(results):
    """(process, parent) of every shard of these results that runs on this machine."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            if str(results).encode() in words and b"--shard" in words:
                parent = int((entry / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()[1])
                found.append((int(entry.name), parent))
        except (OSError, ValueError):
            continue
    return found


class Patience:
    """Ends the test where nothing has moved for long, however slow the machine is."""
    seconds = 300

    def __init__(self):
        self.seen, self.since = None, time.monotonic()

    def lasts(self, state):
        if state != self.seen:
            self.seen, self.since = state, time.monotonic()
        return time.monotonic() - self.since < self.seconds


@contextlib.contextmanager
def paused(results):
    """Shards stand still meanwhile: without its controller Slurm answers so late that the cohort would be done."""
    processes = [process for process, _ in processes_of(results)]

    def signal_all(which):
        for process in processes:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, which)
    signal_all(signal.SIGSTOP)
    try:
        yield
    finally:
        signal_all(signal.SIGCONT)


def wait_until(holds, what):
    patience = Patience()
    while not holds():
        tend()
        queue = ask("squeue", "--array", "--states=all", "--noheader", "--format=%i %T %r")
        expect(patience.lasts((queue, len(list(folder.glob("of*/specimens/*/record.json"))))), f"nothing moves while it waits for {what}:\n{queue}")
        time.sleep(0.02)


def running_nodes():
    return ask("squeue", "--noheader", "--states=RUNNING", "--format=%N").split()


def harm_stepd(slurm, results):
    def killed():
        for process, parent in processes_of(results):
            try:
                if pathlib.Path(f"/proc/{parent}/comm").read_text(encoding="utf-8").startswith("slurmstepd"):
                    os.kill(parent, signal.SIGKILL)
                    os.kill(process, 0)
                    return True
            except OSError:
                continue
        return False
    wait_until(killed, "a slurmstepd to kill")


def harm_slurmd(slurm, results):
    wait_until(running_nodes, "a node that works")
    node = running_nodes()[0]
    slurm.kill(f"slurmd.{node}")
    wait_until(lambda: "down" in ask("sinfo", "--noheader", f"--nodes={node}", "--format=%T"), f"{node} to be seen down")
    slurm.call("node", node[1:])


def harm_slurmctld(slurm, results):
    """Slurm writes its state every five seconds. A job that it has taken since would be lost with it, by Slurm itself."""
    state, submitted = folder / "slurm/state/job_state", results / "slurm/jobs.json"
    with paused(results):
        wait_until(lambda: state.exists() and state.stat().st_mtime > submitted.stat().st_mtime + 0.1, "Slurm's state on disk")
        slurm.kill("slurmctld")
        time.sleep(1)
        said = tunica("cohort", "submit", "cohort.json", "-o", str(results), "--slurm", "--shards", "1", code=2)
        expect("are alive" in said or "squeue ended with" in said, said)
        slurm.call("controller")
        ask("squeue", "--noheader")  # until it answers


def harm_node(slurm, results):
    wait_until(running_nodes, "a node that works")
    node = running_nodes()[0]
    ask("scontrol", "update", f"NodeName={node}", "State=DOWN", "Reason=test")
    time.sleep(2)
    # Its slurmd is alive and may have brought it back by itself, which makes this an error.
    subprocess.run(["scontrol", "update", f"NodeName={node}", "State=RESUME"], capture_output=True, check=False)


def tend():
    """What the people of a computing centre do, and Slurm after two minutes: requeued jobs may start at once, jobs that
    Slurm holds since a launch failed are released, as `status` advises, and nodes that it drained for that come back."""
    for line in ask("squeue", "--noheader", "--array", "--states=PENDING", "--format=%i|%r").splitlines():
        job, _, reason = line.partition("|")
        if reason == "BeginTime":
            subprocess.run(["scontrol", "update", f"JobId={job}", "StartTime=now"], capture_output=True, check=False)
        if "held" in reason:
            subprocess.run(["scontrol", "release", job], capture_output=True, check=False)
    for node in ask("sinfo", "--noheader", "--Node", "--states=drain", "--format=%N").split():
        subprocess.run(["scontrol", "update", f"NodeName={node}", "State=RESUME"], capture_output=True, check=False)


def jobs_that_slurm_knows(name):
    lines = ask("squeue", "--noheader", "--array", "--states=all", f"--name={name},{name}-merge", "--format=%F").split()
    return sorted(set(lines), key=int)


def harmed_cohort_is_that_of_one_machine(slurm, shards):
    results = folder / f"of{shards}"
    begin = time.monotonic()
    print(tunica("cohort", "submit", "cohort.json", "-o", str(results), "--slurm", "--shards", str(shards), "--no-reports"), end="")
    expect("are alive" in tunica("cohort", "submit", "cohort.json", "-o", str(results), "--slurm", code=2), "submitted twice")
    harms = [harm_stepd, harm_node, harm_slurmctld, harm_slurmd]  # the cohort may be done before the last is noticed
    for harm in harms:
        wanted = min(len(records(results)) + SPECIMENS // 20, SPECIMENS - 1)
        wait_until(lambda: len(records(results)) >= wanted, f"{wanted} records")
        print(f"{harm.__name__} at {len(records(results))} of {SPECIMENS} records", flush=True)
        expect(len(records(results)) < SPECIMENS, "the cohort was done before it could be harmed")
        harm(slurm, results)
    resubmitted = 0
    patience = Patience()
    while True:
        said = tunica("cohort", "status", "cohort.json", "-o", str(results), "--json", code=None)
        view = json.loads(said)
        standing = [one["standing"] for one in view["shards"]]
        expect(patience.lasts((standing, view["missing"], view["merge"], resubmitted)), f"it does not come to an end:\n{said}")
        alive = [one for one in view["shards"] if one["standing"] in ("running", "waiting")]
        merge = view["merge"] and view["merge"]["standing"]
        if not view["queue_problem"] and (view["missing"] or merge == "failed") and not alive and merge not in ("running", "waiting"):
            print(tunica("cohort", "status", "cohort.json", "-o", str(results), code=None), end="")
            print(tunica("cohort", "resubmit", "cohort.json", "-o", str(results)), end="")
            resubmitted += 1
        if merge == "ended" and not view["missing"]:
            break
        tend()
        time.sleep(0.3)
    expect_same(folder / "whole", results, f"{shards} shards")
    recorded = json.loads((results / "slurm/jobs.json").read_text(encoding="utf-8"))
    known = jobs_that_slurm_knows(recorded["name"])
    ids = sorted((job["id"] for job in recorded["jobs"]), key=int)
    expect(known == ids, f"Slurm knows the jobs {known}, recorded are {ids}")
    print(f"{shards} shards: same bytes after {len(harms)} harms, {resubmitted} resubmitted, jobs {' '.join(ids)}, "
          f"{time.monotonic() - begin:.0f} s", flush=True)


folder = pathlib.Path(tempfile.mkdtemp(prefix="cluster"))
tunica = Program(sys.argv[1], folder)
slurm = Slurm(folder / "slurm")
try:
    make_cohort(folder, SPECIMENS, realisations=60)
    begin = time.monotonic()
    tunica("cohort", "cohort.json", "-o", "whole", "--no-reports", "--quiet")
    print(f"one machine: {time.monotonic() - begin:.0f} s", flush=True)
    tunica.environment = dict(os.environ)
    for shards in (1, 2, 7):
        harmed_cohort_is_that_of_one_machine(slurm, shards)
except AssertionError as problem:
    raise SystemExit(f"{problem}\nSee {folder}") from None
finally:
    slurm.stop()
    for process, _ in [one for shards in (1, 2, 7) for one in processes_of(folder / f"of{shards}")]:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
shutil.rmtree(folder, ignore_errors=True)  # only where all held; a failure is looked into
