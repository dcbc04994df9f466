# SPDX-License-Identifier: Apache-2.0
"""A run as functions of its parameters over HTTP, as `tunica serve` answers them (UM-Bridge, protocol version 1.0)."""
import atexit
import http.server
import ipaddress
import json
import threading

from .arguments import port_number, text
from .errors import InputError
from .problem import Problem

PATIENCE = 30  # s, for a client that sends or takes nothing
FOREIGN = "the headers Host and Origin name another machine than this one; ask by the address of the server"


def _largest_body(problem):
    """The bytes of a request: its parameters and a vector as long as an output, with room for how a program writes
    numbers, as `tunica serve` has it."""
    longest = max(sum(block["size"] for block in problem.blocks),
                  sum(len(channel["measured"]) for channel in problem.channels))
    return (64 << 10) + 64 * (longest + len(problem.names))


def _bare(host):
    return host.removeprefix("[").removesuffix("]").lower()


def _kind(host):
    """"loopback", "address" or "name"."""
    if host == "localhost":
        return "loopback"
    try:
        return "loopback" if ipaddress.ip_address(host).is_loopback else "address"
    except ValueError:
        return "name"


def _is_ours(authority, served):
    """Whether "name:4242" or "[::1]:4242" is this machine: a page of another site cannot ask by a name that its owner
    points at us."""
    end = authority.find(":", authority.find("]") + 1)
    host = _bare(authority if end < 0 else authority[:end])
    kind = _kind(host)
    return kind == "loopback" or host == served or (kind == "address" and _kind(served) != "loopback")


class _Handler(http.server.BaseHTTPRequestHandler):
    timeout = PATIENCE
    problem = None  # of the run that is served
    served = ""  # host
    largest_body = 0  # bytes

    def _is_foreign(self):
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin", "")
        _, found, authority = origin.partition("://")
        return bool(host and not _is_ours(host, self.served) or
                    origin and not (found and _is_ours(authority, self.served)))

    def _answer(self, body):
        if self._is_foreign():
            self._send(403, json.dumps({"error": {"type": "InvalidInput", "message": FOREIGN}}))
        else:
            self._send(*self.problem.answer(self.path.partition("?")[0], body))

    def _send(self, status, document):
        content = document.encode()
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def do_GET(self):
        self._answer("")

    def do_POST(self):
        length = self.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdigit()):
            self.send_error(411)
        elif len(length) > 18 or int(length) > self.largest_body:
            self.send_error(413)
        else:
            self._answer(self.rfile.read(int(length)).decode(errors="replace"))

    def log_message(self, *_):
        pass


class _Listener(http.server.ThreadingHTTPServer):
    daemon_threads = False  # one that Python ended in the core would end the process
    block_on_close = True


class Server:
    """A run that is served until close(), until the end of a `with` block, or until Python ends. `address` is where
    clients find it, `run` its name and `names` its parameters, in the order of every vector."""

    def __init__(self, problem, host, port):
        handler = type("Handler", (_Handler,), {"problem": problem._problem, "served": _bare(host),
                                                "largest_body": _largest_body(problem)})
        try:
            self._server = _Listener((host, port), handler)
        except (OSError, OverflowError) as error:
            raise InputError(f"serve() cannot listen at {host}, port {port}: {error}. Name another port, or 0 for any "
                             "that is free") from None
        self.run, self.names = problem.run, list(problem.names)
        self.address = f"http://{host}:{self._server.server_port}"
        self._thread = threading.Thread(target=self._server.serve_forever, name="tunica.serve", daemon=True)
        self._thread.start()
        atexit.register(self.close)

    def __repr__(self):
        return f"<tunica.Server of {self.run} at {self.address}>"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def wait(self):
        """Waits until somebody closes it, or until Ctrl-C."""
        self._thread.join()

    def close(self):
        """Ends it, once requests that are being answered are answered. A client that sends nothing has 30 s."""
        atexit.unregister(self.close)
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


def serve(experiment, run=None, *, base=None, host="127.0.0.1", port=0):
    """Answers questions about a run by HTTP, as `tunica serve` does; returns a Server.

    experiment and run as Problem() has them; models, tests and mechanisms of this process take part. port=0 is any that is
    free. The default host is this machine only. Raises InputError where nothing can listen there.
    """
    return Server(Problem(experiment, run, base=base), text(host, "host"), port_number(port))
