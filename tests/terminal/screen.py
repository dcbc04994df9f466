# SPDX-License-Identifier: Apache-2.0
"""A terminal of 80 columns that a test types into and looks at: a tmux session of its own server."""
import pathlib
import shutil
import subprocess
import sys
import time
import uuid


def need(program, package):
    """Ends the test as skipped where the program is missing."""
    if shutil.which(program) is None:
        print(f"skipped: there is no {program}; install the Debian package {package}")
        sys.exit(77)


class Screen:
    def __init__(self, command, folder, recording=None, environment=None):
        """Starts command (a list) in folder; everything it writes is recorded, escape sequences and all."""
        self.socket = f"tunica-test-{uuid.uuid4().hex[:12]}"
        variables = [word for name, value in (environment or {}).items() for word in ("-e", f"{name}={value}")]
        self.tmux("-f", "/dev/null", "new-session", "-d", "-x", "80", "-y", "50", "-c", str(folder), *variables, *command)
        if recording:
            pathlib.Path(recording).write_bytes(b"")
            self.tmux("pipe-pane", "-o", f"cat >> '{recording}'")

    def tmux(self, *arguments):
        return subprocess.run(["tmux", "-L", self.socket, *arguments], check=True, capture_output=True, text=True).stdout

    def type(self, text):
        self.tmux("send-keys", "-l", text)

    def press(self, *keys):
        self.tmux("send-keys", *keys)

    def enter(self, text):
        self.type(text)
        self.press("Enter")

    def text(self):
        return self.tmux("capture-pane", "-p")

    def wait_for(self, found, what, seconds=120):
        """Looks until found(text) is true and returns that."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            text = self.text()
            if answer := found(text):
                return answer
            time.sleep(0.02)
        raise AssertionError(f"{what} did not appear within {seconds} s. The screen:\n{self.text()}")

    def close(self):
        subprocess.run(["tmux", "-L", self.socket, "kill-server"], capture_output=True, check=False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
