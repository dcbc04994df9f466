#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""queue_test.py TUNICA: submit, status and resubmit against a made-up Slurm, which holds jobs and runs none by itself."""
import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left beside the sources
HERE = pathlib.Path(__file__).resolve().parent
from laboratory import Program, expect, expect_same, make_cohort, run_cases, small

executable = small(sys.argv[1], "ceres_lm", "es", "gho", "uniaxial")
room = tempfile.TemporaryDirectory(suffix=" of it's %a")  # a name that a careless shell or sbatch takes amiss
folder = pathlib.Path(room.name)
make_cohort(folder, 20)
commands = folder / "commands"
commands.mkdir()
for name in ("sbatch", "squeue", "sacct", "scancel", "scontrol"):
    (commands / name).write_text(f"#!/bin/sh\nexec '{sys.executable}' '{HERE}/fake_slurm.py' {name} \"$@\"\n", encoding="utf-8")
    (commands / name).chmod(0o755)
Program(executable, folder)("cohort", "cohort.json", "-o", "whole", "--quiet", "--no-reports")


class Cluster:
    """A queue of its own for each case, and a results folder r."""

    def __init__(self, name):
        self.folder = folder / name
        self.folder.mkdir()
        os.environ["FAKE_SLURM"] = str(self.folder)
        self.results = self.folder / "r"
        self.tunica = Program(executable, folder, {"PATH": f"{commands}:{os.environ['PATH']}"})

    def __call__(self, verb, *words, code=0):
        return self.tunica("cohort", verb, "cohort.json", "-o", str(self.results), *words, code=code)

    def submit(self, *words, code=0):
        if "--shards" in words and "--time" not in words:
            words += ("--time", "5", "--memory", "300M")  # no pilot, so that every shard has work left
        return self("submit", "--slurm", "--no-reports", *words, code=code)

    def tasks(self):
        file = self.folder / "jobs.json"
        return json.loads(file.read_text(encoding="utf-8")) if file.exists() else []

    @contextlib.contextmanager
    def changed_tasks(self):
        tasks = self.tasks()
        yield tasks
        (self.folder / "jobs.json").write_text(json.dumps(tasks), encoding="utf-8")

    def calls(self, name):
        lines = (self.folder / "calls.txt").read_text(encoding="utf-8").splitlines()
        return [words[1:] for words in map(json.loads, lines) if words[0] == name]

    def run(self, wanted):
        """Runs tasks as a node would, those for which wanted(task) holds."""
        with self.changed_tasks() as tasks:
            for task in tasks:
                if task["state"] != "PENDING" or not wanted(task):
                    continue
                log = task["log"].replace("%%", "\0").replace("%a", str(task["part"])).replace("\0", "%")
                with open(log, "a", encoding="utf-8") as output:
                    ended = subprocess.run(["sh", task["script"]], cwd="/", stdout=output, stderr=output, check=False,
                                           env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task["part"])})
                task["state"] = "FAILED" if ended.returncode else "COMPLETED"
                task["reason"] = "NonZeroExitCode" if ended.returncode else "None"

    def status(self, code=0):
        return json.loads(self("status", "--json", code=code))


def shard(task):
    return task["part"] is not None


def the_array_and_the_merge_give_the_bytes_of_one_machine():
    for shards in (1, 2, 7):
        cluster = Cluster(f"n{shards}")
        cluster.submit("--shards", str(shards))
        array, merge = cluster.calls("sbatch")
        for word in ("--requeue", f"--array=1-{shards}" if shards > 1 else "--array=1", "--cpus-per-task=1"):
            expect(word in array, f"{word} is missing in {array}")
        expect("--dependency=afterany:101" in merge, merge)
        cluster.run(shard)
        cluster.run(lambda task: True)
        logs = "".join(log.read_text(encoding="utf-8") for log in sorted((cluster.results / "slurm").glob("*.txt")))
        expect([task["state"] for task in cluster.tasks()] == ["COMPLETED"] * (shards + 1), logs)
        expect_same(folder / "whole", cluster.results, f"{shards} shards")
        expect(f"Results:  {cluster.results}" in cluster("status"), "status does not say where the results are")


def nothing_is_submitted_twice():
    cluster = Cluster("twice")
    cluster.submit("--shards", "7")
    recorded = json.loads((cluster.results / "slurm/jobs.json").read_text(encoding="utf-8"))
    expect([job["id"] for job in recorded["jobs"]] == ["101", "102"], recorded)
    said = cluster.submit(code=2)
    for words in ("jobs of this cohort are alive: 101 102 (8 tasks)", "cohort status", "cohort resubmit", "scancel 101 102"):
        expect(words in said, said)
    # As after a crash between sbatch and the record of its number.
    (cluster.results / "slurm/jobs.json").write_text(json.dumps({**recorded, "jobs": []}), encoding="utf-8")
    expect("are alive: 101 102" in cluster.submit(code=2), "a job without a record is not found")
    (cluster.results / "slurm/jobs.json").unlink()
    expect("are alive: 101 102" in cluster.submit(code=2), "a job without any record is not found")
    expect(len(cluster.calls("sbatch")) == 2, cluster.calls("sbatch"))


def of_two_that_submit_at_once_one_does():
    cluster = Cluster("race")
    both = [cluster.tunica.start("cohort", "submit", "cohort.json", "-o", str(cluster.results), "--slurm", "--shards", "3")
            for _ in range(2)]
    said = [one.communicate()[1] for one in both]
    expect(sorted(one.returncode for one in both) == [0, 2], said)
    expect(len(cluster.calls("sbatch")) == 2, cluster.calls("sbatch"))


def only_shards_that_stopped_are_submitted_again():
    cluster = Cluster("again")
    cluster.submit("--shards", "5")
    cluster.run(lambda task: task["part"] in (1, 4))
    with cluster.changed_tasks() as tasks:
        for task in tasks:
            if task["part"] in (2, 3):
                task["state"], task["reason"] = ("FAILED", "NonZeroExitCode") if task["part"] == 2 else ("RUNNING", "None")
    (cluster.results / "slurm/shard_2.txt").write_text("an earlier line\nerror: the disk is full\n\n", encoding="utf-8")
    view = cluster.status(code=1)
    expect([one["standing"] for one in view["shards"]] == ["done", "stopped", "running", "done", "waiting"], view)
    second = view["shards"][1]
    expect((second["state"], second["reason"], second["last_words"]) ==
           ("FAILED", "NonZeroExitCode", "error: the disk is full"), second)
    words = cluster("status", code=1)
    for line in ("2/5  stopped", "FAILED (NonZeroExitCode)", "its log ends with: error: the disk is full", "cohort resubmit"):
        expect(line in words, words)
    cluster("resubmit", "--time", "90", "--merge-memory", "7G")
    array, merge = cluster.calls("sbatch")[2:]
    expect("--array=2" in array and "--time=90" in array, array)
    expect(cluster.calls("scancel") == [["102"]], "the old merge waits on")
    expect("--dependency=afterany:101:103" in merge and "--mem=7G" in merge, merge)
    said = cluster("resubmit")
    expect("Nothing has stopped: 1 shards are running, 2 are waiting" in said, said)
    expect(len(cluster.calls("sbatch")) == 4, "an idle resubmit has submitted something")
    with cluster.changed_tasks() as tasks:
        for task in tasks:
            task["state"] = "PENDING" if task["state"] == "RUNNING" else task["state"]
    cluster.run(shard)
    cluster.run(lambda task: True)
    expect_same(folder / "whole", cluster.results, "resubmitted")
    expect("No specimen is left to fit" in cluster("resubmit"), "a cohort that is done is submitted again")


def a_merge_that_failed_is_submitted_again():
    cluster = Cluster("merge")
    cluster.submit("--shards", "2")
    cluster.run(shard)
    with cluster.changed_tasks() as tasks:
        tasks[-1]["state"], tasks[-1]["reason"] = "OUT_OF_MEMORY", "OutOfMemory"
    (cluster.results / "slurm/merge.txt").write_text("Killed\n", encoding="utf-8")
    view = cluster.status(code=1)
    expect((view["missing"], view["merge"]["standing"], view["merge"]["last_words"]) == (0, "failed", "Killed"), view)
    expect("cohort resubmit" in cluster("status", code=1), "status does not say how to go on")
    cluster("resubmit", "--merge-memory", "7G")
    merge = cluster.calls("sbatch")[2]
    expect("--mem=7G" in merge and not any(word.startswith(("--array", "--dependency")) for word in merge), merge)
    cluster.run(lambda task: True)
    expect_same(folder / "whole", cluster.results, "merged again")
    cluster.status()


def accounts_tell_what_the_queue_has_forgotten():
    cluster = Cluster("forgotten")
    cluster.submit("--shards", "2")
    with cluster.changed_tasks() as tasks:
        for task in tasks:
            task["forgotten"], task["state"] = True, "TIMEOUT"
    words = cluster("status", code=1)
    expect("TIMEOUT" in words and "more with --time or --memory" in words, words)
    (cluster.folder / "broken").write_text("sacct", encoding="utf-8")
    expect([one["state"] for one in cluster.status(code=1)["shards"]] == [None, None], "states without accounts")
    cluster("resubmit")
    expect("--array=1-2" in cluster.calls("sbatch")[2], cluster.calls("sbatch"))


def without_an_answer_of_the_queue_nothing_is_submitted():
    cluster = Cluster("silent")
    (cluster.folder / "broken").write_text("squeue", encoding="utf-8")
    said = cluster.submit("--shards", "2", code=2)
    expect("squeue ended with code 1: squeue: error: Unable to contact slurm controller" in said, said)
    (cluster.folder / "broken").unlink()
    cluster.submit("--shards", "2")
    cluster.run(lambda task: task["part"] == 1)
    (cluster.folder / "broken").write_text("squeue", encoding="utf-8")
    view = cluster.status()
    expect(0 < view["missing"] <= 10 and "Unable to contact" in view["queue_problem"], view)
    expect("Unable to contact" in cluster("resubmit", code=2), "resubmit goes on without the queue")


def what_sbatch_refuses_is_said_and_submitted_later():
    cluster = Cluster("refused")
    (cluster.folder / "broken").write_text("sbatch", encoding="utf-8")
    said = cluster.submit("--shards", "2", code=2)
    expect("sbatch ended with code 1: sbatch: error: Unable" in said, said)
    (cluster.folder / "broken").write_text("merge", encoding="utf-8")
    said = cluster.submit("--shards", "2", code=2)
    expect("the shards were submitted, but not the merge: sbatch ended with code 1" in said, said)
    expect("are alive: 101 (2 tasks)" in cluster.submit("--shards", "2", code=2), "the shards are submitted again")
    (cluster.folder / "broken").unlink()
    cluster("resubmit")
    array, merge = cluster.calls("sbatch")
    expect("--dependency=afterany:101" in merge, merge)


def numbers_of_shards_that_cannot_be_are_refused():
    cluster = Cluster("numbers")
    for shards in ("11", "21"):  # MaxArraySize is 11, so the largest index is 10
        said = cluster.submit("--shards", shards, code=2)
        expect(f"--shards {shards}: there are 20 specimens, and a job array of this cluster has at most 10 tasks" in said, said)


def the_pilot_states_what_it_measured_and_keeps_its_records():
    cluster = Cluster("pilot")
    said = cluster.submit("--pilot", "4", "--dry-run")
    for words in ("Pilot:    4 specimens took", "MiB of memory", "Shards:   1 of at most 20 specimens", "Limits:", "× the longest"):
        expect(words in said, said)
    expect("sbatch --parsable" in said and "--dependency=afterany:JOB" in said, said)
    expect(not (cluster.folder / "jobs.json").exists() or not cluster.tasks(), "a dry run submits")
    expect(cluster.status(code=1)["missing"] == 16, "the records of the pilot are lost")
    said = cluster.submit("--shards", "2", "--time", "5", "--memory", "300M")
    expect("Pilot" not in said and cluster.status()["missing"] == 16, said)
    expect({"--time=5", "--mem=300M"} <= set(cluster.calls("sbatch")[0]), cluster.calls("sbatch"))


def a_dry_run_needs_no_slurm():
    cluster = Cluster("dry")
    without = Program(executable, folder, {"PATH": "/nowhere"})
    said = without("cohort", "submit", "cohort.json", "-o", str(cluster.results), "--slurm", "--shards", "3", "--dry-run")
    expect("--array=1-3" in said, said)
    said = without("cohort", "submit", "cohort.json", "-o", str(cluster.results), "--slurm", "--shards", "3", code=2)
    expect("squeue could not be started: No such file or directory" in said, said)


def paths_of_plugins_are_carried_over_absolute():
    cluster = Cluster("plugins")
    (folder / "own plugins").mkdir()
    program = Program(executable, folder, {"TUNICA_PLUGIN_PATH": "commands:/elsewhere"})
    program("--plugin-path", "own plugins", "cohort", "submit", "cohort.json", "-o", str(cluster.results), "--slurm",
            "--shards", "1", "--dry-run")
    script = (cluster.results / "slurm/shard.sh").read_text(encoding="utf-8")
    inside = str(folder).replace("'", "'\\''")
    expect(f"--plugin-path '{inside}/own plugins'" in script, script)
    expect(f"export TUNICA_PLUGIN_PATH='{inside}/commands:/elsewhere'" in script, script)


run_cases([the_array_and_the_merge_give_the_bytes_of_one_machine, nothing_is_submitted_twice,
           of_two_that_submit_at_once_one_does, only_shards_that_stopped_are_submitted_again,
           a_merge_that_failed_is_submitted_again, accounts_tell_what_the_queue_has_forgotten, without_an_answer_of_the_queue_nothing_is_submitted,
           what_sbatch_refuses_is_said_and_submitted_later, numbers_of_shards_that_cannot_be_are_refused,
           the_pilot_states_what_it_measured_and_keeps_its_records, a_dry_run_needs_no_slurm,
           paths_of_plugins_are_carried_over_absolute])
