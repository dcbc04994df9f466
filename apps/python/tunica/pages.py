# SPDX-License-Identifier: Apache-2.0
"""The page of `tunica studio`, from Python."""
import atexit
import os
import pathlib
import shutil
import subprocess
import tempfile

from . import _core
from ._installation import PROGRAM
from .arguments import path, port_number
from .errors import InputError
from .library import _options, _paths


class Studio:
    """A page that is served until close(), until the end of a `with` block, or until Python ends. `address` is where a
    browser finds it; who has it can use the page."""

    def __init__(self, process, address):
        self._process = process
        self.address = address
        atexit.register(self.close)

    def __repr__(self):
        return f"<tunica.Studio at {self.address}>"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends the page and its jobs, which save their results so far."""
        atexit.unregister(self.close)
        if self._process.poll() is None:
            self._process.terminate()
            self._process.wait()
        self._process.stdout.close()


def _version_of(program):
    """What `program --version` prints; empty where it fails."""
    try:
        return subprocess.run([program, "--version"], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True,
                              timeout=30).stdout.strip()
    except (OSError, ValueError, subprocess.SubprocessError):
        return ""


def _program(who):
    """The program that was installed with this package, else the one of the same version that a shell would find."""
    beside = pathlib.Path(_core.__file__).absolute().parent / PROGRAM
    if os.access(beside, os.X_OK):
        return str(beside)
    wanted = f"tunica {_core.version}"
    found = shutil.which("tunica")
    if found is None:
        raise InputError(f"{who} starts the program tunica, and found none at {beside} or in PATH; a wheel of pip has "
                         f"none inside. Install {wanted}, or build it with ./bootstrap build and add build/release/bin to "
                         "PATH")
    version = _version_of(found)
    if version != wanted:
        raise InputError(f"{who} found no program beside this package, and {found} in PATH is "
                         f"{version or 'no tunica that tells its version'}; expected {wanted}, as this package. Install "
                         "that version, or put its folder first in PATH")
    return found


def studio(folder=".", *, port=0, browser=True):
    """Serves the page of the project `folder`, on this machine only, and opens it where `browser` is true. port=0 is any
    that is free. Raises InputError where the folder is missing or is served already, or where no program tunica of this version is
    installed."""
    words = [_program("studio()")]
    for plugins in _paths:
        words += ["--plugin-path", os.path.abspath(plugins)]
    if _options["allow_world_writable"]:
        words.append("--allow-world-writable-plugins")
    words += ["studio", path(folder, "studio()"), "--port", str(port_number(port)), *([] if browser else ["--no-browser"])]
    with tempfile.TemporaryFile("w+") as said:  # a pipe whose reader is gone would end the program
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=said, text=True, start_new_session=True)
        address = process.stdout.readline().strip()
        if address:
            return Studio(process, address)
        process.communicate()
        said.seek(0)
        raise InputError(said.read().strip().removeprefix("error: "))
