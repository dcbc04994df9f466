# SPDX-License-Identifier: Apache-2.0
"""The plugins of this process, and how an experiment is read from what the user has: a file, a dictionary."""
import csv
import hashlib
import io
import json
import os
import pathlib
import tempfile
import threading
import warnings

import numpy

from . import _core
from ._installation import PLUGINS
from .errors import InputError

_lock = threading.Lock()
_library = None
_paths = []
_options = {"allow_world_writable": False}


def library():
    """The one library of the process. Its plugins are loaded when it is first asked for."""
    global _library
    with _lock:
        if _library is None:
            # The folder of the package as it was imported: its files may be links.
            package = pathlib.Path(_core.__file__).absolute().parent
            _library = _core.Library([str(path) for path in _paths], str(package / PLUGINS),
                                     _options["allow_world_writable"])
            for refusal in _library.refusals:
                warnings.warn(refusal, stacklevel=2)
        return _library


def use_plugins(*paths, allow_world_writable=False):
    """Names plugin files, or folders that hold some, to load beside those that came with tunica. TUNICA_PLUGIN_PATH
    does the same from outside. Call it before anything else: plugins are loaded once."""
    if _library is not None:
        raise InputError("the plugins of this process are loaded already; call use_plugins() right after the import, "
                         "or set TUNICA_PLUGIN_PATH")
    _paths.extend(paths)
    _options["allow_world_writable"] |= allow_world_writable


def _plain(value):
    """numpy's numbers and arrays, and paths, as JSON has them."""
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, pathlib.PurePath):
        return str(value)
    raise TypeError(f"found {value!r}, of type {type(value).__name__}, in the experiment; expected what JSON can hold: "
                    "dictionaries, lists, text, numbers, True, False and None")


def _kept(table, place):
    """The file of a table: its name is the hash of what is in it, so that the same data are the same file."""
    try:
        columns = {str(name): numpy.asarray(table[name]) for name in table}
        lengths = {len(column) for column in columns.values()}
    except TypeError:
        columns, lengths = {}, set()
    if len(lengths) != 1:
        raise InputError(f"{place}: found a table with columns of the lengths {sorted(lengths)}; expected a frame, or "
                         "a dictionary with columns of one length")
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(column.tolist() for column in columns.values())))  # floats as they read back bit for bit
    text = stream.getvalue()
    folder = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "tunica"
    file = folder / f"{hashlib.sha256(text.encode()).hexdigest()}.csv"
    if not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile("w", dir=folder, suffix=".part", delete=False, encoding="utf-8") as part:
            part.write(text)
        os.replace(part.name, file)
    return str(file)


def _with_files(experiment):
    """The experiment with a file in place of each table that its tests have."""
    tests = experiment.get("tests")
    if not isinstance(tests, dict):
        return experiment
    changed = dict(tests)
    for name, test in tests.items():
        data = test.get("data") if isinstance(test, dict) else None
        if isinstance(data, dict) and "table" in data and "file" not in data:
            rest = {key: value for key, value in data.items() if key != "table"}
            changed[name] = {**test, "data": {"file": _kept(data["table"], f"/tests/{name}/data/table"), **rest}}
    return {**experiment, "tests": changed}


class Experiment:
    """An experiment that has been read and checked: every name, unit and number in it is known to fit."""

    def __init__(self, loaded):
        self._loaded = loaded

    @property
    def name(self):
        return self._loaded.name

    @property
    def seed(self):
        return self._loaded.seed

    @property
    def input(self):
        """The experiment with every default filled in and numbers in base units, as input.json has it."""
        return json.loads(self._loaded.input_json)

    def __repr__(self):
        return f"<tunica.Experiment '{self.name}'>"


def read(experiment, base="."):
    """Reads an experiment: the path of a file, or a dictionary with the same keys, whose data files are relative to
    the folder `base`; "table" in place of "file" is a frame or a dictionary of columns. What is an Experiment already
    is returned as it is. Raises InputError, which names file, line and key; a line of a dictionary counts the lines of
    `json.dumps(experiment, indent=2)`."""
    if isinstance(experiment, Experiment):
        return experiment
    if isinstance(experiment, dict):
        try:
            text = json.dumps({**({} if "name" in experiment else {"name": "experiment"}), **_with_files(experiment)},
                              indent=2, default=_plain, allow_nan=False)
        except (TypeError, ValueError) as problem:
            raise InputError(str(problem)) from None
        return Experiment(library().parse(text, str(pathlib.Path(base) / "<dict>")))
    if isinstance(experiment, (str, pathlib.PurePath)):
        return Experiment(library().read(str(experiment)))
    raise InputError(f"found an experiment of type {type(experiment).__name__}; expected the path of a file or a dict")


def names():
    """What there is: {"models": {name: one sentence}, "tests": …, "optimizers": …, "mechanisms": …}."""
    return library().list()


def describe(name):
    """What a model, test, optimiser or mechanism declares: its parameters, options and source, as
    `tunica describe --json` prints it."""
    found = json.loads(library().describe(name))
    return next(iter(found.values())) if len(found) == 1 else found


def schema():
    """The JSON Schema of experiment files, with what Python code has defined."""
    return json.loads(library().schema())
