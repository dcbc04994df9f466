#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""hostile_test.py TUNICA PLUGIN [CASE...]: what a plugin that breaks its promises costs. One evaluation, or itself; never the
result of another run, the end of the program without a word, or a wrong number."""
import json
import pathlib
import re
import shutil
import signal
import sys
import time
import urllib.error
import urllib.request

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "browser"))
from laboratory import Program, expect, run_cases
from hostile_laboratory import expect_others_as_ever, honest_run, laboratory, outcome, root, timeless
from studio_server import Studio


def a_model_that_always_fails_costs_its_own_run():
    reasons = {"throws": "threw: a bad day", "throws_42": "threw something that is no std::exception",
               "writes_nothing": "returned ok without writing the gradient", "aborts": "aborted the program (SIGABRT)",
               "segfaults": "segmentation fault (SIGSEGV)", "overflows_the_stack": "segmentation fault (SIGSEGV)",
               "exits": "called exit()", "exits_at_once": "called _exit()",
               "writes_beyond": "wrote beyond the ends of its stress", "tangent_throws": "no tangent today",
               "tangent_throws_42": "threw something that is no std::exception", "loops": "did not come back within"}
    for how, reason in reasons.items():
        folder, tunica = laboratory(f"always_{how}", how)
        said = tunica("run", "experiment.json", "-o", "results", "-j", "2", code=1)
        expect(reason in " ".join(said.split()), f"{how}: nothing tells of '{reason}':\n{said}")
        expect("plugin 'hostile 1.0.0'" in said, f"{how}: the plugin is not named:\n{said}")
        expect_others_as_ever(folder, how)
        expect(outcome(folder)[0].get("best") is None, f"{how}: a result that nobody calculated")


def a_model_that_always_fails_is_not_assessed():
    for how in ("throws", "segfaults", "exits"):
        _, tunica = laboratory(f"stability_{how}", how)
        said = tunica("stability", "experiment.json", "--model", "bad", code=1)
        expect(said.count("NOT ASSESSED") >= 3, f"{how}: something was assessed:\n{said}")


def a_thread_of_a_plugin_that_ends_the_program_is_told():
    """No call leads to it. The plugin is evaluated no more after a few times; where it does so when it is loaded, the
    work ends."""
    for how, reason in {"thread_falls": "segmentation fault (SIGSEGV)", "thread_throws": "aborted the program (SIGABRT)",
                        "thread_exits": "called exit()", "thread_exits_at_once": "called _exit()"}.items():
        folder, tunica = laboratory(how, how)
        tunica.words[-1] = "30"  # the limit of a call: the thread ends before
        said = " ".join(tunica("run", "experiment.json", "-o", "results", code=1).split())
        expect("plugin 'hostile 1.0.0' " in said and f"{reason} in a thread of its own." in said, f"{how}: {said}")
        expect("It was time number 4: the plugin is not evaluated again" in said, f"{how}: {said}")
        expect_others_as_ever(folder, how)
    shell = Program("/bin/sh", folder)
    shell.words = ["/bin/sh", "-c"]
    said = shell(f"HOSTILE_AT_LOAD=thread_falls {' '.join(tunica.words)} list 2>&1", code=4)
    expect("hostile" in said and "in a thread of its own" in " ".join(said.split()), said)


def junk_in_shared_memory_is_found_in_its_call():
    folder, tunica = laboratory("junk", "spoils_shared_memory", since=13, search="es", max_evaluations=200)
    said = " ".join(tunica("run", "experiment.json", "-o", "results", code=None).split())
    expect("plugin 'hostile 1.0.0' ended the program with a segmentation fault (SIGSEGV) in evaluate" in said, said)
    expect(outcome(folder)[0]["failures"] > 0, "no point was bad")
    expect_others_as_ever(folder, "junk")


def a_model_that_takes_memory_is_given_up_soon():
    """Of all the memory of the machine a call of a model may take a GiB, and seven such calls are enough."""
    folder, tunica = laboratory("greedy", "allocates_without_end")
    tunica.words[-1] = "60"  # the limit of a call
    begin = time.monotonic()
    said = " ".join(tunica("run", "experiment.json", "-o", "results", code=1).split())
    expect("in a call of a model, which may take" in said and "the plugin is not evaluated again" in said, said)
    most = max(float(taken) for taken in re.findall(r"memory of the program to ([\d.]+) GiB", said))
    expect(most < 4, f"a model came to {most} GiB")
    expect(time.monotonic() - begin < 60, "the plugin was asked for minutes")
    expect_others_as_ever(folder, "greedy")


def a_crash_costs_one_evaluation():
    """The search finds its optimum around the points where the process ends."""
    for how in ("aborts", "segfaults", "exits", "exits_at_once", "loops"):
        folder, tunica = laboratory(f"seldom_{how}", how, since=700, search="es", max_evaluations=400)
        tunica("run", "experiment.json", "-o", "results", "--quiet")
        bad, _ = outcome(folder)
        expect(bad["failures"] > 0, f"{how}: no point was bad")
        expect(abs(bad["best"]["parameters"]["mu"]["value"] - 12.01) < 0.05, f"{how}: {bad['best']['parameters']}")
        expect_others_as_ever(folder, how)


def a_call_that_takes_all_memory_costs_one_evaluation():
    folder, tunica = laboratory("memory", "allocates_without_end", since=700, search="es", max_evaluations=400)
    tunica.words[-1] = "20"  # the limit of a call
    tunica.words += ["--memory-limit", "0.4"]
    said = tunica("run", "experiment.json", "-o", "results", code=None)
    expect("took the memory of the program to" in " ".join(said.split()), said)
    bad, _ = outcome(folder)
    expect(bad["failures"] > 0, "no point was bad")
    expect(abs(bad["best"]["parameters"]["mu"]["value"] - 12.01) < 0.05, bad["best"]["parameters"])
    expect_others_as_ever(folder, "memory")


def a_leak_costs_nothing_but_time():
    """Each process that comes to its limit is followed by another one; the numbers are those without the leak."""
    found = {}
    for how in ("honest", "leaks"):
        folder, tunica = laboratory(f"leak_{how}", how, search="es", max_evaluations=2000)
        tunica.words += ["--memory-limit", "0.4"]
        said = tunica("run", "experiment.json", "-o", "results", code=None)
        expect(("memory came to its limit" in " ".join(said.split())) == (how == "leaks"), said)
        bad, _ = outcome(folder)
        found[how] = timeless({key: bad[key] for key in ("best", "evaluations", "failures")})
        expect_others_as_ever(folder, how)
    expect(found["leaks"] == found["honest"], f"a leak changed the result: {found}")


def a_test_that_writes_nothing_fails():
    for does, reason in {"writes_nothing": "without writing the predictions",
                         "writes_no_derivatives": "without writing the Jacobian"}.items():
        folder, tunica = laboratory(f"test_{does}", test_does=does)
        said = tunica("run", "experiment.json", "-o", "results", code=1)
        expect(reason in " ".join(said.split()), f"{does}: nothing tells of '{reason}':\n{said}")
        expect(outcome(folder)[0].get("best") is None, f"{does}: a result that nobody calculated")
        expect_others_as_ever(folder, does)


def a_plugin_that_crashes_when_it_is_loaded_is_refused():
    for how in ("aborts", "segfaults", "exits", "exits_at_once"):
        folder, tunica = laboratory(f"load_{how}")
        shell = Program("/bin/sh", folder)
        shell.words = ["/bin/sh", "-c"]
        said = shell(f"HOSTILE_AT_LOAD={how} {' '.join(tunica.words)} list 2>&1", code=3)
        expect("hostile.so" in said and "load()" in said, f"{how}: {said}")


def a_plugin_that_changes_the_arithmetic_changes_no_number():
    """A library that was built with -ffast-math does such a thing when it is loaded; others do it in a call."""
    for wishes in ({"how": "rounds_up"}, {"search": "bad", "search_does": "rounds_up"}, {"test_does": "rounds_up"}):
        name = "_".join(wishes)
        folder, tunica = laboratory(f"rounds_{name}", **wishes)
        tunica("run", "experiment.json", "-o", "results", "--quiet", "-j", "1", code=None)
        expect_others_as_ever(folder, name)
    for how in ("traps", "flushes_to_zero", "cuts_precision"):
        for wishes in ({"how": how}, {"search": "bad", "search_does": how}, {"test_does": how}):
            name = how + "_" + "_".join(wishes)
            folder, tunica = laboratory(name, **wishes)
            said = tunica("run", "experiment.json", "-o", "results", "-j", "1", code=None)
            expect("plugin 'hostile 1.0.0'" in said, f"{name}: nobody is blamed:\n{said}")
            expect("'neo_hooke" not in said, f"{name}: an honest plugin is blamed:\n{said}")
            expect_others_as_ever(folder, name)
    folder, tunica = laboratory("rounds")
    shell = Program("/bin/sh", folder)
    shell.words = ["/bin/sh", "-c"]
    shell(f"HOSTILE_AT_LOAD=rounds_up {' '.join(tunica.words)} run experiment.json -o results --quiet")
    expect_others_as_ever(folder, "rounds")


def resuming_afterwards_gives_the_same():
    folder, tunica = laboratory("again", "aborts", since=13)
    tunica("run", "experiment.json", "-o", "results", "--quiet", code=None)
    first = timeless(outcome(folder))
    tunica("run", "experiment.json", "-o", "results", "--quiet", "--resume", code=None)
    expect(timeless(outcome(folder)) == first, "a run that is resumed after its end differs")


def a_search_that_misbehaves_costs_its_own_run():
    for how, reason in {"throws": "a bad day", "throws_42": "something that is not a std::exception",
                        "aborts": "aborted the program", "exits": "called exit()"}.items():
        folder, tunica = laboratory(f"search_{how}", search="bad", search_does=how)
        said = tunica("run", "experiment.json", "-o", "results", code=None)
        expect(reason in " ".join(said.split()), f"{how}: nothing tells of '{reason}':\n{said}")
        expect_others_as_ever(folder, how)


def what_fails_before_the_work_is_an_error_that_names_the_plugin():
    for name, wishes in {"describe": {"how": "describe_throws"}, "needs": {"search": "bad", "search_does": "needs_throw"}}.items():
        folder, tunica = laboratory(f"early_{name}", **wishes)
        said = tunica("run", "experiment.json", "-o", "results", code=4)
        expect("plugin 'hostile 1.0.0'" in said and "fault of tunica" not in said, said)


def max_time_holds_for_what_hangs():
    folder, tunica = laboratory("late", "loops", since=13, search="es", max_time=1)
    begin = time.monotonic()
    tunica("run", "experiment.json", "-o", "results", "--quiet", code=None)
    expect(time.monotonic() - begin < 30, "a search of one second took half a minute")
    expect_others_as_ever(folder, "late")


def what_is_left_for_the_end_of_the_process_disturbs_nothing():
    for how in ("leaves_a_process", "hangs_at_exit", "falls_at_exit"):
        folder, tunica = laboratory(f"end_{how}", how)
        shell = Program("/bin/sh", folder)
        shell.words = ["/bin/sh", "-c"]  # a process that is left behind would keep a pipe of ours open, too
        begin = time.monotonic()
        shell(f"{' '.join(tunica.words)} run experiment.json -o results --quiet > said 2>&1")
        expect(time.monotonic() - begin < 30, f"{how}: half a minute for a fit of milliseconds")
        bad, _ = outcome(folder)
        certificate = bad["best"]["certificate"]
        expect(certificate["verdict_code"] == "confirmed", f"{how}: {certificate}")
        expect_others_as_ever(folder, how)


def processes_in(folder):
    """Those that work in a folder, by their working directory."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and pathlib.Path(entry / "cwd").resolve() == folder.resolve():
                found.append(entry.name)
        except OSError:
            pass
    return found


def what_a_plugin_forks_is_ended_and_holds_no_lock():
    """A copy of the program that comes back into it would write the journal too."""
    for how in ("forks", "leaves_a_process"):
        folder, tunica = laboratory(f"copies_{how}", how)
        tunica("run", "experiment.json", "-o", "results", "--quiet")
        expect(not processes_in(folder), f"{how}: a process is left")
        rows = (folder / "results/evaluations.csv").read_text(encoding="utf-8").splitlines()
        names = [tuple(row.split(",")[:3]) for row in rows]
        expect(len(set(names)) == len(names), f"{how}: rows of the journal stand twice")
        expect_others_as_ever(folder, how)
        tunica("run", "experiment.json", "-o", "results", "--quiet", "--resume")


def timers_that_a_plugin_sets_end_nothing():
    folder, tunica = laboratory("timers", "sets_timers")
    tunica("run", "experiment.json", "-o", "results", "--quiet")
    expect_others_as_ever(folder, "timers")


def a_journal_that_a_plugin_loses_is_told():
    for how, words in {"closes_files": "closed the file", "redirects_files": "another one in its place",
                       "limits_files": "raise the limit"}.items():
        folder, tunica = laboratory(f"journal_{how}", how)
        said = tunica("run", "experiment.json", "-o", "results", code=130)  # it can be gone on with
        expect(words in " ".join(said.split()), f"{how}: nothing tells of it:\n{said}")


def objects_have_a_limit_of_time_too():
    folder, tunica = laboratory("create", "create_loops")
    tunica.words[-1] = "0.1"  # ten times as long for a factory
    said = tunica("run", "experiment.json", "-o", "results", code=4)
    expect("in create()" in said and "did not come back" in " ".join(said.split()), said)


def a_destructor_that_crashes_costs_nothing():
    for name, wishes in {"model": {"how": "destructor_falls"}, "search": {"search": "bad", "search_does": "destructor_falls"},
                         "late_search": {"search": "bad", "search_does": "destructor_hangs"}}.items():
        folder, tunica = laboratory(f"destructor_{name}", **wishes)
        tunica.words[-1] = "0.1"  # ten times as long for a destructor
        said = tunica("run", "experiment.json", "-o", "results", code=None)
        expect("destroy()" in said, f"{name}: {said}")
        expect_others_as_ever(folder, f"destructor_{name}")


def ask(url, parameter):
    request = json.dumps({"name": "objective", "input": [[parameter]]}).encode()
    try:
        with urllib.request.urlopen(urllib.request.Request(url + "/Evaluate", request), timeout=30) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as problem:
        return problem.code, problem.read().decode()


def a_server_outlives_its_plugins():
    for how in ("segfaults", "aborts", "exits_at_once", "loops", "allocates_without_end"):
        folder, tunica = laboratory(f"serve_{how}", how, since=700)
        if how == "allocates_without_end":
            tunica.words += ["--memory-limit", "0.4"]
        server = tunica.start("serve", "experiment.json", "--port", "0")
        url = server.stdout.readline().strip()
        status, before = ask(url, 12)
        expect(status == 200, f"{how}: {before}")
        status, said = ask(url, 800)
        expect(status == 500 and "plugin 'hostile 1.0.0'" in json.loads(said)["error"]["message"], f"{how}: {said}")
        status, after = ask(url, 12)
        expect((status, after) == (200, before), f"{how}: the next request is answered {status}, {after}")
        status, said = ask(url, 800)
        expect(status == 500 and "not made again" in said, f"{how}: {said}")
        server.send_signal(signal.SIGINT)
        server.communicate(timeout=20)
        expect(server.returncode == 0, f"{how}: the server ends with {server.returncode}")


def a_studio_outlives_its_plugins():
    """The page, its address and its cookie stay."""
    for how in ("segfaults", "exits_at_once"):
        folder, tunica = laboratory(f"studio_{how}", how, since=700)
        with Studio(tunica.words[0], folder, *tunica.words[1:]) as studio:
            question = {"file": "experiment.json", "run": "bad/lm"}
            before = studio.simulate(**question, values=[12])
            status, said = studio.post("/api/simulate", {**question, "values": [800]})
            expect(status == 500 and "plugin 'hostile 1.0.0'" in str(said), f"{how}: {status} {said}")
            after = studio.simulate(**question, values=[12])
            expect(after["channels"] == before["channels"], f"{how}: {after}")
        expect(studio.process.returncode == 0, f"{how}: the studio ends with {studio.process.returncode}")


def what_a_fresh_process_refutes_is_no_result():
    """The search has seen half the stress for nearly all of its calls; a fresh process sees the whole."""
    folder, tunica = laboratory("refuted", "tires", search="es", max_evaluations=2000)
    said = tunica("run", "experiment.json", "-o", "results", code=1)
    expect("NOT CONFIRMED" in said.upper(), said)
    bad, _ = outcome(folder)
    expect(bad["best"]["certificate"]["verdict_code"] == "objective_differs", bad["best"]["certificate"])
    ranking = json.loads((folder / "results/result.json").read_text(encoding="utf-8"))["ranking"]
    expect([entry["run"] for entry in ranking] == ["good/lm", "bad/es"], ranking)
    expect([bool(entry["reason"]) for entry in ranking] == [False, True], ranking)
    rows = (folder / "results/ranking.csv").read_text(encoding="utf-8").splitlines()
    expect("good/lm" in rows[-2] and "bad/es" in rows[-1], rows)
    expect_others_as_ever(folder, "refuted")


def work_after_slow_searches_says_what_it_does():
    folder, tunica = laboratory("slow", "is_slow", max_evaluations=3)
    said = tunica("run", "experiment.json", "-o", "results")
    expect("after the searches: " in said, f"nothing tells of the work after the searches:\n{said}")
    folder, tunica = laboratory("quick")
    said = tunica("run", "experiment.json", "-o", "results")
    expect("after the searches: " not in said, f"a fit of milliseconds talks:\n{said}")


def two_signals_end_what_hangs():
    for first, second in ((signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGTERM)):
        folder, tunica = laboratory(f"signals_{first}_{second}", "loops")
        tunica.words[-1] = "1000"  # the limit of a call
        process = tunica.start("run", "experiment.json", "-o", "results")
        while not (folder / "results/evaluations.csv").exists():
            time.sleep(0.01)
        process.send_signal(first)
        time.sleep(0.3)
        process.send_signal(second)
        _, said = process.communicate(timeout=20)
        expect(process.returncode == 130, f"{first}, {second}: exit code {process.returncode}\n{said}")


def nothing_that_plugins_print_gets_into_an_answer():
    folder, tunica = laboratory("prints", "prints")
    tunica("run", "experiment.json", "-o", "results", "--quiet")
    bad, _ = outcome(folder)
    expect(bad["best"]["certificate"]["verdict_code"] == "confirmed", "its certificate is void")
    process = tunica.start("check", "experiment.json", "--json")
    answer, _ = process.communicate()
    json.loads(answer)


def a_full_disk_at_the_other_end_is_told_and_harms_nothing():
    folder, tunica = laboratory("full")
    command = " ".join([*tunica.words, "run", "experiment.json", "-o"])
    shell = Program("/bin/sh", folder)
    shell.words = ["/bin/sh", "-c"]
    shell(f"{command} deaf 2>/dev/full")
    expect(timeless(outcome(folder, "deaf")[1]) == honest_run, "a full disk behind stderr changed the result")
    said = shell(f"{command} mute 2>&1 >/dev/full", code=2)
    expect("stdout" in said and "o space left" in said, said)
    expect(timeless(outcome(folder, "mute")[1]) == honest_run, "a full disk behind stdout changed the result")
    for verb in ("check experiment.json", "list", "--help", "certify mute",
                 "simulate experiment.json --model good --parameters mute/result.json -o curves"):
        said = shell(f"{' '.join(tunica.words)} {verb} 2>&1 >/dev/full", code=2)
        expect("stdout" in said, f"{verb}: {said}")


chosen = sys.argv[3:]
cases = [a_model_that_always_fails_costs_its_own_run, a_model_that_always_fails_is_not_assessed,
           a_thread_of_a_plugin_that_ends_the_program_is_told, junk_in_shared_memory_is_found_in_its_call,
           a_model_that_takes_memory_is_given_up_soon, a_crash_costs_one_evaluation,
           a_call_that_takes_all_memory_costs_one_evaluation, a_leak_costs_nothing_but_time,
           a_test_that_writes_nothing_fails, a_plugin_that_crashes_when_it_is_loaded_is_refused,
           a_plugin_that_changes_the_arithmetic_changes_no_number,
           resuming_afterwards_gives_the_same, a_search_that_misbehaves_costs_its_own_run,
           what_fails_before_the_work_is_an_error_that_names_the_plugin, max_time_holds_for_what_hangs,
           what_is_left_for_the_end_of_the_process_disturbs_nothing,
           what_a_fresh_process_refutes_is_no_result, work_after_slow_searches_says_what_it_does,
           two_signals_end_what_hangs, nothing_that_plugins_print_gets_into_an_answer,
           a_full_disk_at_the_other_end_is_told_and_harms_nothing, what_a_plugin_forks_is_ended_and_holds_no_lock,
           timers_that_a_plugin_sets_end_nothing, a_journal_that_a_plugin_loses_is_told,
           objects_have_a_limit_of_time_too, a_destructor_that_crashes_costs_nothing, a_server_outlives_its_plugins, a_studio_outlives_its_plugins]
run_cases([case for case in cases if not chosen or case.__name__ in chosen])
shutil.rmtree(root, ignore_errors=True)
