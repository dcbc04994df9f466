# SPDX-License-Identifier: Apache-2.0
"""A run as functions of its parameters over HTTP, as `tunica serve` answers them (UM-Bridge, protocol version 1.0)."""
import atexit
import http.server
import threading

from .arguments import text
from .errors import InputError
from .problem import Problem

LARGEST_BODY = 64 << 20  # bytes; far above the vectors of any run


class _Handler(http.server.BaseHTTPRequestHandler):
    problem = None  # of the run that is served

    def _answer(self, body):
        status, document = self.problem.answer(self.path, body)
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
        if not length.isdigit() or int(length) > LARGEST_BODY:
            self.send_error(413 if length.isdigit() else 411)
            return
        self._answer(self.rfile.read(int(length)).decode(errors="replace"))

    def log_message(self, *_):
        pass


class Server:
    """A run that is served until close(), until the end of a `with` block, or until Python ends. `address` is where
    clients find it, `run` its name and `names` its parameters, in the order of every vector."""

    def __init__(self, problem, host, port):
        handler = type("Handler", (_Handler,), {"problem": problem._problem})
        try:
            self._server = http.server.ThreadingHTTPServer((host, port), handler)
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
        """Ends it; requests that are being answered are answered."""
        atexit.unregister(self.close)
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


def serve(experiment, run=None, *, base=None, host="127.0.0.1", port=0):
    """Answers questions about a run by HTTP, as `tunica serve` does; returns a Server.

    experiment and run as Problem() has them; models, tests and mechanisms of this process take part. port=0 is any that is
    free. The default host is this machine only. Raises InputError where nothing can listen there.
    """
    return Server(Problem(experiment, run, base=base), text(host, "host"), int(port))
