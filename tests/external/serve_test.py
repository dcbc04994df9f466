#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""serve_test.py TUNICA PLUGINS: `tunica serve` and the test type um_bridge, in the protocol UM-Bridge 1.0.

A strip of neo-Hookean rubber, sigma = mu (l^2 - 1/l), is the oracle: predictions and Jacobian are known. Then a fit
through the client is held against the direct one, and a server of Python's own, without derivatives, is fitted too."""
import gzip
import http.server
import json
import math
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

tunica, plugins = sys.argv[1:3]
folder = pathlib.Path(tempfile.mkdtemp(prefix="tunica-serve-"))
stretches = [1 + 0.05 * k for k in range(1, 21)]
# A ripple, so that the fit is not perfect.
stresses = [30 * (s * s - 1 / s) + 0.3 * math.sin(9 * s) for s in stretches]
(folder / "strip.csv").write_text("stretch,stress [kPa]\n" + "".join(f"{a!r},{b!r}\n" for a, b in zip(stretches, stresses)))


def run(*arguments):
    return subprocess.run([tunica, "--plugin-path", plugins, *arguments], cwd=folder, capture_output=True, text=True,
                          timeout=120)


def write(name, test, **model):
    experiment = {
        "format": 1, "name": name, "seed": 3,
        "models": {"neo": {"type": "neo_hooke", "parameters": {"mu": {"min": 1, "max": 500, **model}}}},
        "tests": {"strip": test}, "objective": "least_squares",
        "optimizers": {"lm": {"type": "ceres_lm", "starts": 1}}, "stop": {"max_evaluations": 60},
        "runs": [{"model": "neo", "optimizer": "lm"}]}
    (folder / f"{name}.json").write_text(json.dumps(experiment))


def best(name):
    found = run("run", f"{name}.json", "-o", name)
    assert found.returncode == 0, found.stderr + found.stdout
    result = json.loads((folder / name / "result.json").read_text())["runs"][0]
    return result["best"]["parameters"]["mu"]["value"], result["best"]["objective"], result


def close(a, b, tolerance):
    assert abs(a - b) <= tolerance * max(abs(a), abs(b)), f"{a!r} is not {b!r} within {tolerance}"


data = {"file": "strip.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "stress_measure": "cauchy",
        "noise": {"absolute": "0.2 kPa"}}

# `check` shows the address that a file names, and asks nobody there, unless it is told to.
with socket.create_server(("127.0.0.1", 0)) as listener:
    listener.setblocking(False)
    address = f"http://127.0.0.1:{listener.getsockname()[1]}"
    write("foreign", {"type": "um_bridge", "url": address, "inputs": [["mu"]], "time_limit": 0.2,
                      "outputs": {"stress": {"output": 0, "unit": "kPa"}}, "data": data})

    def asked():
        try:
            listener.accept()[0].close()
            return True
        except BlockingIOError:
            return False
    for options in ((), ("--json",)):
        found = run("check", "foreign.json", *options)
        said = " ".join(found.stdout.split())
        assert found.returncode == 0 and f"test 'strip' asks the server at {address}" in said, found.stdout + found.stderr
        assert not asked(), "check asks a server that the file names"
    found = run("check", "foreign.json", "--run-external")
    assert found.returncode == 2 and asked(), (found.returncode, found.stderr)
    found = run("run", "foreign.json", "-o", "foreign")
    assert found.returncode == 2 and asked(), (found.returncode, found.stderr)
    write("wrong", {"type": "um_bridge", "url": address, "inputs": [["nu"]], "outputs": {"stress": {}}, "data": data})
    found = run("check", "wrong.json")
    assert found.returncode == 2 and "'nu'" in found.stderr and not asked(), (found.returncode, found.stderr)
    write("wrong", {"type": "um_bridge", "url": address, "inputs": [["mu"]], "offline": True,
                    "outputs": {"stress": {"output": 0}}, "data": data})
    found = run("run", "wrong.json", "-o", "wrong")
    assert found.returncode == 1 and "the server is not asked" in " ".join(found.stdout.split()), found.stdout
write("direct", {"type": "uniaxial", "direction": "axial", "data": data})
mu, objective, _ = best("direct")

server = subprocess.Popen([tunica, "--plugin-path", plugins, "serve", "direct.json", "--port", "0"], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
try:
    url = server.stdout.readline().strip()
    port = int(url.rsplit(":", 1)[1])
    assert url.startswith("http://127.0.0.1:"), url

    def ask(path, request=None, expected=200):
        body = None if request is None else (request if isinstance(request, bytes) else json.dumps(request).encode())
        try:
            with urllib.request.urlopen(urllib.request.Request(url + path, body), timeout=20) as answer:
                code, text = answer.status, answer.read()
        except urllib.error.HTTPError as problem:
            code, text = problem.code, problem.read()
        assert code == expected, (path, code, text)
        return json.loads(text)

    assert ask("/Info") == {"protocolVersion": 1.0, "models": ["objective", "residuals", "predictions"]}
    assert ask("/InputSizes", {"name": "objective", "config": {}}) == {"inputSizes": [1]}
    assert ask("/OutputSizes", {"name": "predictions"}) == {"outputSizes": [20]}
    assert ask("/OutputSizes", {"name": "residuals"}) == {"outputSizes": [20]}
    info = ask("/ModelInfo", {"name": "objective"})
    assert info["support"] == {"Evaluate": True, "Gradient": True, "ApplyJacobian": True, "ApplyHessian": False}
    assert info["parameters"][0]["name"] == "mu" and info["parameters"][0]["unit"] == "kPa"

    # The objective where the search ended; predictions, residuals and their derivatives by the closed form.
    close(ask("/Evaluate", {"name": "objective", "input": [[mu]], "config": {}})["output"][0][0], objective, 1e-12)
    for trial in (12.5, 30.0, 441.0):
        point = {"input": [[trial]], "outWrt": 0, "inWrt": 0}
        values = ask("/Evaluate", {"name": "predictions", **point})["output"][0]
        slopes = ask("/ApplyJacobian", {"name": "predictions", "vec": [1], **point})["output"]
        residuals = ask("/Evaluate", {"name": "residuals", **point})["output"][0]
        for k, s in enumerate(stretches):
            close(values[k], trial * (s * s - 1 / s), 1e-12)
            close(slopes[k], s * s - 1 / s, 1e-12)
            assert abs(residuals[k] - (trial * (s * s - 1 / s) - stresses[k]) / 0.2) < 1e-9
        squares = sum(value * value for value in residuals)
        close(ask("/Evaluate", {"name": "objective", **point})["output"][0][0], squares, 1e-12)
        exact = sum(2 * r * (s * s - 1 / s) / 0.2 for r, s in zip(residuals, stretches))
        close(ask("/Gradient", {"name": "objective", "sens": [1], **point})["output"][0], exact, 1e-12)
        close(ask("/ApplyJacobian", {"name": "objective", "vec": [2], **point})["output"][0], 2 * exact, 1e-12)
        close(ask("/Gradient", {"name": "residuals", "sens": [2 * r for r in residuals], **point})["output"][0], exact,
              1e-12)

    # Errors are answers with type and message.
    def refusal(path, request):
        return ask(path, request, 400)["error"]
    assert refusal("/Evaluate", {"name": "objektive", "input": [[1]]})["type"] == "ModelNotFound"
    assert "objective" in refusal("/Evaluate", {"name": "objektive", "input": [[1]]})["message"]
    assert "outside its bounds" in refusal("/Evaluate", {"name": "objective", "input": [[501]]})["message"]
    assert "1 numbers" in refusal("/Evaluate", {"name": "objective", "input": [[1, 2]]})["message"]
    assert refusal("/Evaluate", b"{")["type"] == "InvalidInput"
    assert refusal("/ApplyHessian", {"name": "objective"})["type"] == "UnsupportedFeature"
    assert "outWrt" in refusal("/Gradient", {"name": "objective", "outWrt": 3, "inWrt": 0, "input": [[1]]})["message"]

    # What a page of somebody else could send, through a browser or a name that leads here.
    def raw(lines, body=b""):
        with socket.create_connection(("127.0.0.1", port), timeout=20) as client:
            try:
                client.sendall("\r\n".join([*lines, "", ""]).encode() + body)
            except OSError:
                pass  # it was refused before all of it was sent
            answer = b""
            try:
                while b"\r\n\r\n" not in answer and (more := client.recv(4096)):
                    answer += more
            except OSError:
                pass
            return answer.split(b"\r\n")[0].decode()

    own = f"Host: 127.0.0.1:{port}"
    for lines, status in (([own], " 200 "), ([f"Host: localhost:{port}", "Origin: http://localhost:8080"], " 200 "),
                          (["Host: [::1]"], " 200 "), (["Host: rebound.example"], " 403 "),
                          (["Host: 10.1.2.3"], " 403 "), ([own, "Origin: https://else.example"], " 403 "),
                          ([own, "Origin: null"], " 403 ")):
        assert status in raw(["GET /Info HTTP/1.1", *lines]), (lines, raw(["GET /Info HTTP/1.1", *lines]))
    assert " 403 " in raw(["POST /Evaluate HTTP/1.1", "Host: rebound.example", "Content-Length: 2"], b"{}")

    # Heads and bodies without end, compressed ones, and depth: refused, or the connection is closed.
    def resident():
        children = pathlib.Path(f"/proc/{server.pid}/task/{server.pid}/children").read_text().split()
        return sum(int(pathlib.Path(f"/proc/{one}/statm").read_text().split()[1]) * 4096 for one in children)
    before = resident()
    many = [f"X-{k}: {'x' * 900}" for k in range(20000)]
    assert " 200 " not in raw(["GET /Info HTTP/1.1", own, *many])
    assert " 200 " not in raw(["GET /Info HTTP/1.1", own, "X: " + "x" * 20_000_000])
    post = ["POST /Evaluate HTTP/1.1", own]
    chunk = b"10000\r\n" + b" " * 0x10000 + b"\r\n"
    assert " 200 " not in raw([*post, "Transfer-Encoding: chunked"], 400 * chunk)
    assert " 200 " not in raw([*post, "Content-Length: 900000000000"], b" " * 20_000_000)
    assert " 415 " in raw([*post, "Content-Encoding: gzip", "Content-Length: 2"], b"{}")
    raw(["GET /Info HTTP/1.1", own, "Range: bytes=" + "0-," * 2000 + "0-"])  # no answer a range, and no crash
    assert resident() - before < 64 << 20, resident() - before
    deep = refusal("/Evaluate", b'{"name":' + b"[" * 20000 + b"]" * 20000 + b"}")["message"]
    assert "64 levels" in deep, deep
    assert ask("/Info")["protocolVersion"] == 1.0

    # The port is taken.
    found = run("serve", "direct.json", "--port", str(port))
    assert found.returncode == 2 and "in use" in found.stderr, (found.returncode, found.stderr)
    found = run("serve", "direct.json", "--run", "neo/ml")
    assert found.returncode == 2 and "neo/lm" in found.stderr, found.stderr

    # Through the client, exact derivatives included, the fit is the direct one.
    client = {"type": "um_bridge", "url": url, "model": "predictions", "inputs": [["mu"]],
              "outputs": {"stress": {"output": 0}}, "data": data}
    write("client", client)
    other, other_objective, result = best("client")
    close(other, mu, 1e-12)
    close(other_objective, objective, 1e-12)
    assert result["efforts"]["strip"]["jacobian_actions"] == result["jacobians"], result["efforts"]
    for key, value, words in (("inputs", [["mu"], ["mu"]], "1 input"), ("inputs", [["nu"]], "'nu'"),
                              ("outputs", {}, "'stress'"), ("outputs", {"stress": {"output": 1}}, "'stress' has 20 rows"),
                              ("outputs", {"stress": {"output": 0, "first": -1}}, "/outputs/stress/first"),
                              ("outputs", {"stress": {"output": 0.5}}, "/outputs/stress/output"),
                              ("outputs", {"stress": {"first": 18446744073709551615}}, "'stress' has 20 rows"),
                              ("outputs", {"stress": {"first": "1"}}, "a whole number from 0"),
                              ("outputs", {"stress": {"factor": "2"}}, "/outputs/stress/factor"),
                              ("outputs", {"stress": {"unit": 3}}, "/outputs/stress/unit"),
                              ("outputs", {"stress": {"offset": 3}}, "the key 'offset'"),
                              ("outputs", {"stress": {}, "force": {}}, "'force'"),
                              ("model", "prediction", "predictions")):
        write("wrong", {**client, key: value})
        found = run("run", "wrong.json", "-o", "wrong")
        assert found.returncode == 2 and words in found.stderr, (key, found.stderr)
finally:
    server.send_signal(signal.SIGINT)
    assert server.wait(20) == 0

# IPv6, where the machine has it: an address has brackets.
if socket.has_ipv6 and pathlib.Path("/proc/net/if_inet6").exists() and pathlib.Path("/proc/net/if_inet6").read_text():
    server = subprocess.Popen([tunica, "--plugin-path", plugins, "serve", "direct.json", "--port", "0", "--host", "::1"],
                              cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    url = server.stdout.readline().strip()
    assert url.startswith("http://[::1]:"), url
    with urllib.request.urlopen(url + "/Info", timeout=20) as answer:
        assert answer.status == 200
    server.send_signal(signal.SIGINT)
    assert server.wait(20) == 0
found = run("serve", "direct.json", "--host", "no.such.host.invalid")
assert found.returncode == 2 and "--host" in found.stderr, found.stderr

found = run("run", "client.json", "-o", "gone")
assert found.returncode == 2 and "cannot be reached" in found.stderr, found.stderr


class Strip(http.server.BaseHTTPRequestHandler):
    """A server as others write them: no derivatives, MPa, and one number that JSON has no way to write."""

    def do_GET(self):
        self.reply({"protocolVersion": 1.0, "models": ["forward"]})

    def do_POST(self):
        request = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        if self.path == "/InputSizes":
            self.reply({"inputSizes": [1]})
        elif self.path == "/OutputSizes":
            self.reply({"outputSizes": [3, 22]})
        elif self.path == "/ModelInfo":
            self.reply({"support": {"Evaluate": True, "Gradient": False, "ApplyJacobian": False, "ApplyHessian": False}})
        else:
            value = request["input"][0][0]
            curve = [value * (s * s - 1 / s) for s in stretches]
            self.reply({"output": [[0, 0, 0], [0, 0] + curve]})

    def reply(self, document):
        text = json.dumps(document).encode()
        self.send_response(200)
        self.send_header("Content-Length", str(len(text)))
        self.end_headers()
        self.wfile.write(text)

    def log_message(self, *arguments):
        pass


other = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Strip)
threading.Thread(target=other.serve_forever, daemon=True).start()
write("foreign", {"type": "um_bridge", "url": f"http://127.0.0.1:{other.server_port}", "inputs": [["mu MPa"]],
                  "outputs": {"stress": {"output": 1, "first": 2, "unit": "MPa"}}, "data": data})
found_mu, found_objective, result = best("foreign")
close(found_mu, mu, 1e-6)
close(found_objective, objective, 1e-9)
other.shutdown()

# A server that takes connections and says nothing is given up at the limit.
with socket.socket() as silent:
    silent.bind(("127.0.0.1", 0))
    silent.listen()
    write("silent", {"type": "um_bridge", "url": f"http://127.0.0.1:{silent.getsockname()[1]}", "time_limit": "0.3 s",
                     "inputs": [["mu"]], "outputs": {"stress": {}}, "data": data})
    found = run("run", "silent.json", "-o", "silent")
    assert found.returncode == 2 and "within 0.3 s" in found.stderr, found.stderr


def hostile(answer, words, **more):
    """A server that answers every connection with what `answer` sends; the client gives up with `words`."""
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen()

        def serve():
            while True:
                try:
                    connection, _ = listening.accept()
                except OSError:
                    return
                with connection:
                    try:
                        connection.recv(65536)
                        answer(connection)
                    except OSError:
                        pass
        threading.Thread(target=serve, daemon=True).start()
        write("hostile", {"type": "um_bridge", "url": f"http://127.0.0.1:{listening.getsockname()[1]}",
                          "inputs": [["mu"]], "outputs": {"stress": {}}, "data": data, **more})
        found = run("run", "hostile.json", "-o", "hostile")
        assert found.returncode == 2 and words in " ".join(found.stderr.split()), (words, found.returncode, found.stderr)
        listening.close()


class Dripping(Strip):
    """It says what it has, and its predictions come a blank at a time."""

    def do_POST(self):
        if self.path != "/Evaluate":
            return super().do_POST()
        self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(200)
        self.send_header("Content-Length", "1000000")
        self.end_headers()
        try:
            while True:
                self.wfile.write(b" ")
                threading.Event().wait(0.05)
        except OSError:
            pass  # given up


dripping = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Dripping)
dripping.daemon_threads = True
threading.Thread(target=dripping.serve_forever, daemon=True).start()
write("dripping", {"type": "um_bridge", "url": f"http://127.0.0.1:{dripping.server_port}", "inputs": [["mu MPa"]],
                   "outputs": {"stress": {"output": 1, "first": 2, "unit": "MPa"}}, "data": data})
experiment = json.loads((folder / "dripping.json").read_text())
experiment["stop"]["max_time"] = "1 s"
(folder / "dripping.json").write_text(json.dumps(experiment))
begun = time.monotonic()
found = run("run", "dripping.json", "-o", "dripping")
assert found.returncode == 1 and "max_time was over" in " ".join(found.stderr.split()), (found.returncode, found.stderr)
assert time.monotonic() - begun < 40, "a server that drips holds the run beyond its max_time"
dripping.shutdown()


def endless(head, piece):
    def send(connection):
        connection.sendall(head)
        while True:
            connection.sendall(piece)
    return send


def drip(connection):
    connection.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: 1000000\r\n\r\n")
    while True:
        connection.sendall(b" ")
        threading.Event().wait(0.1)


def whole(body, head=b""):
    return lambda connection: connection.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: " + str(len(body)).encode() +
                                                 b"\r\n" + head + b"\r\n" + body)


ok = b"HTTP/1.1 200 OK\r\n"
hostile(endless(ok + b"\r\n", b"[" * 65536), "sent more than 32 MiB")
hostile(endless(ok, b"X: " + b"y" * 1000 + b"\r\n"), "sent more than 32 MiB")
hostile(drip, "within 1 s", time_limit="1 s")
hostile(whole(gzip.compress(b"0" * 10**6), b"Content-Encoding: gzip\r\n"), "the encoding 'gzip'")
hostile(whole(b'{"error": ' + b"[" * 80000 + b"]" * 80000 + b"}"), "more than 64 levels")
hostile(whole(b'{"protocolVersion": "1"}'), "speaks version unknown")
print("served, and asked")
