# SPDX-License-Identifier: Apache-2.0
"""Who may ask `tunica studio`, and for what: token, Host, Origin, names of files, sizes, jobs that end with the server.
Needs no browser."""
import argparse
import concurrent.futures
import http.client
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time

from studio_live import ACCEPT, BINARY, CLOSING, PING, PONG, TEXT, Live
from studio_proof import a_folder_that_cannot_be_written, a_text_is_tried_without_its_servers
from studio_server import Studio, decoded, mistaken_experiment, rig_file, slow_experiment


def only_with_the_token(studio):
    headers = {"Host": studio.host}
    assert studio.request("GET", "/", headers=headers)[0] == 403
    assert studio.request("GET", "/?token=" + "0" * 32, headers=headers)[0] == 403
    for cookie in ("", "tunica_studio=" + studio.token, studio.cookie[:-1], studio.cookie + "0", f"x{studio.cookie}"):
        assert studio.request("GET", "/", headers={**headers, "Cookie": cookie})[0] == 403, cookie
    status, found, leads = studio.request("GET", f"/?token={studio.token}", headers=headers)
    assert status == 200 and b'content="0;url=/"' in leads and found["Referrer-Policy"] == "no-referrer", (found, leads)
    assert "HttpOnly" in found["Set-Cookie"] and "SameSite=Strict" in found["Set-Cookie"], found
    status, found, page = studio.get("/")
    assert status == 200 and b"tunica" in page
    policy = found["Content-Security-Policy"]
    assert "default-src 'none'" in policy and "unsafe" not in policy and "frame-ancestors 'none'" in policy, policy
    assert studio.request("PUT", "/api/project", b"{}", studio.own(b"{}"))[0] == 403


def only_from_its_own_page(studio):
    for host in ("evil.example", f"evil.example:{studio.port}", "127.0.0.1", f"127.0.0.1:{studio.port + 1}", ""):
        assert studio.post("/api/project", {}, Host=host)[0] == 403, host
        assert studio.request("GET", "/", headers={"Host": host, "Cookie": studio.cookie})[0] == 403, host
    for origin in ("http://evil.example", "null", "", f"https://{studio.host}", f"http://127.0.0.1:{studio.port + 1}"):
        assert studio.post("/api/project", {}, Origin=origin)[0] == 403, origin
    headers = studio.own(b"{}")
    del headers["Origin"]
    assert studio.request("POST", "/api/project", b"{}", headers)[0] == 403
    assert studio.post("/api/project", {}, Host=f"localhost:{studio.port}", Origin=f"http://localhost:{studio.port}")[0] == 200


def predictions_on_one_connection(studio):
    """What it answers is what a request is answered; who sends anything but whole, masked, short texts is left."""
    for origin in ("http://evil.example", f"http://127.0.0.1:{studio.port + 1}", "null", None):
        with Live(studio, Origin=origin) as live:
            assert live.status == 403, origin
    with Live(studio, Cookie=None) as live:
        assert live.status == 403
    file = studio.ask("example", name="treloar")["file"]
    run = studio.ask("problem", file=file)["runs"][0]
    question = {"file": file, "run": run["label"], "values": [one["initial"] for one in run["parameters"]]}
    expected = studio.simulate(**question)
    with Live(studio) as live:
        assert live.status == 101 and f"Sec-WebSocket-Accept: {ACCEPT}\r\n".encode() in live.head, live.head
        for _ in range(3):
            live.send(TEXT, json.dumps(question).encode())
            kind, said = live.receive()
            assert kind == BINARY and decoded(said)["channels"] == expected["channels"], kind
        live.send(TEXT, json.dumps({**question, "run": "none"}).encode())
        kind, said = live.receive()
        assert kind == TEXT and "has no run 'none'" in json.loads(said)["error"], said
        live.send(TEXT, b"{")
        assert live.receive()[0] == TEXT
        live.send(PING, b"there?")
        assert live.receive() == (PONG, b"there?")
        live.send(CLOSING, b"")
        assert live.receive() == (CLOSING, b"") and live.receive() == (None, b"")
    text = json.dumps(question).encode()
    for wrong in ({"payload": text, "masked": False}, {"payload": text, "whole": False}, {"payload": b" " * 40000}, {"payload": b" " * 70000}):
        with Live(studio) as live:
            live.send(TEXT, **wrong)
            assert live.receive() == (CLOSING, b""), {**wrong, "payload": len(wrong["payload"])}
    with Live(studio) as live:
        live.send(TEXT, json.dumps({**question, "file": "../secret.csv"}).encode())
        kind, said = live.receive()
        assert kind == TEXT and said.startswith(b"'../secret.csv' leaves the project"), said


def few_connections_for_predictions(studio):
    """Each holds a thread: beyond eight the page is refused one, and still answered by requests."""
    def one_more():
        for _ in range(100):  # those that were closed have their place for a moment still
            live = Live(studio)
            if live.status == 101:
                return live
            live.socket.close()
            time.sleep(0.05)
        raise AssertionError(f"no live connection: {live.head}")
    held = [one_more() for _ in range(8)]
    for _ in range(20):
        with Live(studio) as live:
            assert live.status == 503, live.head
    assert studio.post("/api/project", {})[0] == 200
    held.pop().socket.close()
    held.append(one_more())
    for live in held:
        live.socket.close()


def nothing_outside_the_project(studio, outside):
    os.symlink(outside / "secret.csv", studio.folder / "link.csv")
    os.symlink(outside, studio.folder / "linked")
    names = ("../secret.csv", "/etc/passwd", "a/../../secret.csv", "./x.csv", "..", "link.csv", "linked/secret.csv",
             ".tunica-studio/lock", "-o", "--resume", "a\u0000b", "a\u202eb", "a\nb", "")
    for name in names:
        for path, question in (("look", {"files": [name]}), ("import", {"files": [name]}), ("document", {"file": name}), ("problem", {"file": name}),
                               ("check", {"file": name}), ("save", {"file": name, "document": {}}), ("start", {"verb": "run", "experiment": name}),
                               ("start", {"verb": "report", "folders": [name]}), ("start", {"verb": "export", "folder": name, "to": "febio"})):
            status, said = studio.post(f"/api/{path}", question)
            assert status == 403 and "secret\n" not in said, f"{path} {name!r}: {status} {said}"
    for name in ("../secret.csv", "%2e%2e/secret.csv", "link.csv", "linked/secret.csv", ".tunica-studio/lock", "%00"):
        status, _, said = studio.shown(name)
        assert status in (400, 403) and b"secret\n" not in said, f"{name}: {status} {said}"
    listed = json.dumps(studio.ask("project"))
    assert "secret" not in listed and "link" not in listed, listed
    (studio.folder / "names_others.json").write_text(json.dumps({
        "format": 1, "models": {"neo_hooke": {"type": "neo_hooke"}}, "optimizers": {"lm": {"type": "ceres_lm"}},
        "tests": {"strip": {"type": "uniaxial", "direction": "axial", "data": {"file": str(outside / "secret.csv"), "columns": {"stretch": "stretch", "stress": "stress"}}}},
        "runs": [{"model": "neo_hooke", "optimizer": "lm"}]}))
    strip = {"type": "external", "command": ["true"], "files": [str(outside / "secret.csv")], "results": {},
             "data": {"file": "own.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}
    (studio.folder / "own.csv").write_text("stretch,stress\n1,0\n1.1,1\n1.2,3\n")
    experiment = json.loads((studio.folder / "names_others.json").read_text())
    (studio.folder / "names_files.json").write_text(json.dumps({**experiment, "tests": {"strip": strip}}))
    for name in ("names_others.json", "names_files.json"):
        for path, question in (("problem", {"file": name}), ("check", {"file": name}),
                               *(("start", {"verb": verb, "experiment": name}) for verb in ("run", "diagnose", "discover"))):
            status, said = studio.post(f"/api/{path}", question)
            assert status == 403 and "outside of the project" in said, f"{path} {question}: {status} {said}"
    assert not (studio.folder / "results").exists()


def files_are_shown_apart(studio):
    (studio.folder / "page.html").write_text("<script>fetch('/api/project')</script>")
    status, headers, _ = studio.shown("page.html")
    policy = headers["Content-Security-Policy"]
    assert status == 200 and policy.startswith("sandbox") and "allow-same-origin" not in policy and "connect-src" not in policy, policy
    assert headers["X-Content-Type-Options"] == "nosniff"
    other = "/view/" + "0" * 32 + "/page.html"
    assert studio.request("GET", other, headers={"Host": studio.host, "Cookie": studio.cookie})[0] == 403


def uploads_have_limits_and_plain_names(studio):
    headers = {**studio.own(), "Content-Length": str((64 << 20) + 1)}
    assert studio.request("POST", "/api/upload?name=large.csv", b"", headers)[0] == 413
    assert studio.request("POST", "/api/project", b"", {**studio.own(), "Content-Length": str(5 << 20)})[0] == 413
    headers = studio.own()
    del headers["Content-Length"]
    assert studio.request("POST", "/api/upload?name=x.csv", b"0\r\n\r\n", {**headers, "Transfer-Encoding": "chunked"})[0] == 411
    assert studio.upload("empty.csv", b"")[0] == 400
    status, said = studio.upload("..%2F..%2F%3Cscript%3Ealert(1)%3C%2Fscript%3E.csv", rig_file())
    assert status == 200 and said["file"] == "script-.csv", said
    assert studio.upload("-o.csv", rig_file())[1]["file"] == "o.csv"
    assert studio.upload("o.csv", rig_file())[1]["file"] == "o-2.csv", "a file was overwritten"
    assert not list(studio.folder.parent.glob("*.csv"))
    with concurrent.futures.ThreadPoolExecutor(16) as crowd:
        said = list(crowd.map(lambda k: studio.upload("same.csv", b"%d" % k)[1]["file"], range(32)))
    assert sorted((studio.folder / name).read_bytes() for name in said) == sorted(b"%d" % k for k in range(32)), "uploads of one name were lost"


def errors_carry_the_words_of_the_core(studio):
    (studio.folder / "wrong.json").write_text('{"format": 1, "modells": {}, "models": {}, "tests": {}}')
    status, said = studio.post("/api/check", {"file": "wrong.json"})
    assert status == 400 and "modells" in said["error"], said
    assert studio.post("/api/simulate", b"{")[0] == 400
    assert studio.post("/api/nothing", {})[0] == 400
    assert studio.post("/api/start", {"verb": "plugin"})[0] == 400


def what_changes_in_the_folder_is_read_again(studio):
    studio.upload("changing.csv", rig_file())
    sizes = {"--width": "6 mm", "--thickness": "1.5 mm", "--gauge-length": "20 mm"}
    file = studio.ask("import", files=["changing.csv"], asked=sizes)["file"]
    largest = [max(studio.ask("problem", file=file)["runs"][0]["channels"][0]["y"])]
    (studio.folder / "changing.csv").write_bytes(rig_file().replace(b";4,", b";9,"))
    largest.append(max(studio.ask("problem", file=file)["runs"][0]["channels"][0]["y"]))
    assert largest[1] > 1.5 * largest[0], largest
    read = studio.ask("document", file=file)
    changed = {**read["document"], "models": {"ogden": {"type": "no_such_model"}}}
    status, said = studio.post("/api/save", {"file": file, "hash": read["hash"], "document": changed})
    assert status == 400 and "no_such_model" in said["error"] and "passing" not in said["error"], said
    assert "no_such_model" not in (studio.folder / file).read_text() and not list(studio.folder.glob(".passing*"))
    with (studio.folder / file).open("a") as text:
        text.write("\n")  # an editor saves
    status, said = studio.post("/api/save", {"file": file, "hash": read["hash"], "document": read["document"]})
    assert status == 409 and "has changed since" in said["error"], said
    assert studio.ask("save", file=file, hash=studio.ask("document", file=file)["hash"], document=read["document"])["file"] == file


def a_changed_copy_within_results_is_listed(studio):
    folder = studio.folder / "results/made"
    folder.mkdir(parents=True)
    (folder / "result.json").write_text("{}")
    experiment = json.loads((studio.folder / "names_others.json").read_text())
    experiment["tests"]["strip"]["data"]["file"] = "../../own.csv"
    (folder / "extended.json").write_text(json.dumps(experiment))
    read = studio.ask("document", file="results/made/extended.json")
    copy = studio.ask("save", file="results/made/extended.json", hash=read["hash"], document=read["document"])["file"]
    listed = studio.ask("project")
    assert copy == "results/made/extended-2.json" and copy in listed["experiments"], listed["experiments"]
    assert listed["copies"][copy] == "results/made/extended.json", listed["copies"]


def every_example_opens_and_follows_its_sliders(studio):
    examples = studio.ask("project")["examples"]
    assert len(examples) == 10, examples
    for example in examples:
        file = studio.ask("example", name=example["name"])["file"]
        run = studio.ask("problem", file=file)["runs"][0]
        values = [(0.9 * one["initial"] + 0.1 * one["max"]) for one in run["parameters"]]
        before, after = (studio.simulate(file=file, run=run["label"], values=point)
                         for point in ([one["initial"] for one in run["parameters"]], values))
        assert [len(channel) for channel in before["channels"]] == [len(channel["x"]) for channel in run["channels"]], file
        objective = before["objective"]
        if objective is None:  # a prediction that takes long is answered alone
            initial = [one["initial"] for one in run["parameters"]]
            objective = studio.ask("judge", file=file, run=run["label"], values=initial)["objective"]
        assert objective > 0 and after["channels"] != before["channels"], file
    assert studio.post("/api/example", {"name": "../examples"})[0] == 400


def a_diagnosis_is_a_job_with_its_words(options, studio):
    """Of a file with a wrong stress measure: the question comes before any cause."""
    mistaken_experiment(options.source, studio.folder)
    job = studio.wait(studio.ask("start", verb="diagnose", experiment="mistaken.json")["id"])
    assert job["state"] == "done" and "is what the file says so?" in " ".join(job["words"].split()), job
    found = json.loads(studio.shown(job["folder"] + "/result.json")[2])["diagnosis"]
    first = found["file"]["causes"][0]
    assert first["kind"] == "stress_measure" and first["tests"] == ["uniaxial"] and found["base"]["squares"] > 40 * first["squares"], first
    assert first["changes"] == [{"op": "add", "path": "/tests/uniaxial/data/stress_measure", "value": "first_piola_kirchhoff"}], first
    entry = next(one for one in studio.ask("project")["results"] if one["folder"] == job["folder"])
    assert entry["kind"] == "diagnosis" and entry["experiment"] == "mistaken.json" and entry["summary"]["verdict"] == "indistinguishable", entry


def one_server_a_project(tunica, studio):
    found = subprocess.run([tunica, "studio", str(studio.folder), "--no-browser"], capture_output=True, text=True, timeout=30)
    assert found.returncode == 2 and "another `tunica studio`" in found.stderr, found.stderr


def the_browser_is_led_by_a_file_of_its_owner(tunica, folder):
    """A program in the place of xdg-open says what it was given, and in which session it is."""
    folder.mkdir()
    program, said = folder / "xdg-open", folder / "said.txt"
    program.write_text(f'#!/bin/sh\nprintf "%s\\n%s\\n" "$*" "$(cut -d" " -f6 /proc/$$/stat)" > {said}.new && mv {said}.new {said}\nexec sleep 60\n')
    program.chmod(0o755)
    process = subprocess.Popen([tunica, "studio", str(folder)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                               env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"})
    try:
        address = process.stdout.readline().strip()
        for _ in range(100):
            if said.exists():
                break
            time.sleep(0.05)
        given, session = said.read_text().splitlines()
        assert "token" not in given and given.endswith(".tunica-studio/open.html"), given
        assert pathlib.Path(given).stat().st_mode & 0o777 == 0o600 and address in pathlib.Path(given).read_text()
        assert int(session) != os.getsid(0), "Ctrl-C of the terminal reaches the browser"
    finally:
        process.terminate()
        assert process.wait(timeout=20) == 0
    os.kill(int(session), signal.SIGTERM)  # it outlived the studio


def is_alive(words, folder):
    """Whether a process of this command line works in the folder."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if words in (process / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace") and (process / "cwd").resolve() == folder:
                return True
        except OSError:  # it has ended meanwhile
            pass
    return False


def jobs_end_with_the_server_and_go_on_with_the_next(options, folder):
    slow_experiment(options.source, folder)
    straight = folder / "straight"
    with Studio(options.tunica, folder) as studio:
        job = studio.ask("start", verb="run", experiment="slow.json")
        journal = folder / job["folder"] / "evaluations.csv"
        while not journal.exists() or journal.read_bytes().count(b"\n") < 200:
            time.sleep(0.02)
        assert is_alive(job["folder"], folder)
        studio.process.send_signal(signal.SIGKILL)
        studio.process.wait()
        for _ in range(100):
            if not is_alive(job["folder"], folder):
                break
            time.sleep(0.05)
        assert not is_alive(job["folder"], folder), "the job goes on without its server"
        assert journal.read_bytes().count(b"\n") < 650, "the job was over before the server was ended"
    with Studio(options.tunica, folder) as studio:
        found = next(one for one in studio.ask("project")["jobs"] if one["id"] == job["id"])
        assert found["state"] == "interrupted" and found["resumable"], found
        again = studio.ask("start", verb="run", resume=job["id"])
        assert "--resume" in again["command"] and again["folder"] == job["folder"], again
        time.sleep(0.3)
        listener = http.client.HTTPConnection("127.0.0.1", studio.port)
        listener.request("GET", f"/api/events?name={again['id']}", headers={"Host": studio.host, "Cookie": studio.cookie})
        first = listener.getresponse().read(200).decode()
        assert first.startswith("retry:") and "event: progress" in first, first
        studio.process.terminate()  # somebody listens, and a job runs
        assert studio.process.wait(timeout=20) == 0
        listener.close()
    with Studio(options.tunica, folder) as studio:
        found = next(one for one in studio.ask("project")["jobs"] if one["id"] == again["id"])
        assert found["state"] == "stopped" and found["code"] == 130 and found["resumable"], found
        again = studio.ask("start", verb="run", resume=again["id"])
        time.sleep(0.2)
        studio.ask("stop", id=again["id"])
        stopped = studio.wait(again["id"])
        assert stopped["state"] == "stopped" and stopped["resumable"], stopped
        last = studio.ask("start", verb="run", resume=again["id"])
        ended = studio.wait(last["id"])
        assert ended["state"] in ("done", "not_converged"), ended
    run = [options.tunica, "run", "slow.json", "-o", str(straight), "--quiet"]
    assert subprocess.run(run, cwd=folder, capture_output=True, timeout=120).returncode in (0, 1)
    best = [json.loads((place / "result.json").read_text())["runs"][0]["best"] for place in (folder / job["folder"], straight)]
    assert best[0]["objective"] == best[1]["objective"] and best[0]["parameters"] == best[1]["parameters"], "ended three times, and another result"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tunica", required=True)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    shutil.rmtree(options.output, ignore_errors=True)
    outside, project, slow = (options.output.resolve() / name for name in ("outside", "outside/project", "slow"))
    for folder in (outside, project, slow):
        folder.mkdir(parents=True)
    (outside / "secret.csv").write_text("stretch,stress\n1,0\n1.1,1\n1.2,3\nsecret\n")
    the_browser_is_led_by_a_file_of_its_owner(options.tunica, options.output.resolve() / "opened")
    a_folder_that_cannot_be_written(options.tunica, options.output.resolve() / "unwritable")
    with Studio(options.tunica, project) as studio:
        only_with_the_token(studio)
        only_from_its_own_page(studio)
        predictions_on_one_connection(studio)
        few_connections_for_predictions(studio)
        a_text_is_tried_without_its_servers(studio)
        nothing_outside_the_project(studio, outside)
        files_are_shown_apart(studio)
        (outside / "secret.csv").unlink()
        uploads_have_limits_and_plain_names(studio)
        errors_carry_the_words_of_the_core(studio)
        what_changes_in_the_folder_is_read_again(studio)
        a_changed_copy_within_results_is_listed(studio)
        every_example_opens_and_follows_its_sliders(studio)
        a_diagnosis_is_a_job_with_its_words(options, studio)
        one_server_a_project(options.tunica, studio)
    assert studio.process.returncode == 0, studio.process.returncode
    for log in (studio.said, (project / ".tunica-studio/refused.log").read_text()):
        assert log.count("refused: ") > 100, log[-2000:]
        assert "Host names another machine" in log and "Origin" in log and "\u202e" not in log
    assert studio.token not in studio.said and studio.token not in (project / ".tunica-studio/refused.log").read_text()
    jobs_end_with_the_server_and_go_on_with_the_next(options, slow)


if __name__ == "__main__":
    main()
