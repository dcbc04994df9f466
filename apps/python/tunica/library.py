# SPDX-License-Identifier: Apache-2.0
"""The plugins of this process, and the reading of an experiment from a file or a dictionary."""
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
from .arguments import text
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
    _paths.extend(text(path, "use_plugins()") for path in paths)
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
    """The file of a table. Its name is the hash of its content, so equal data share a file."""
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
    def kept(data, pointer):
        if not isinstance(data, dict) or "table" not in data or "file" in data:
            return data
        rest = {key: value for key, value in data.items() if key != "table"}
        return {"file": _kept(data["table"], pointer + "/table"), **rest}

    changed = dict(tests)
    for name, test in tests.items():
        data, pointer = test.get("data") if isinstance(test, dict) else None, f"/tests/{name}/data"
        if isinstance(data, list):
            changed[name] = {**test, "data": [kept(one, f"{pointer}/{k}") for k, one in enumerate(data)]}
        elif isinstance(data, dict):
            changed[name] = {**test, "data": kept(data, pointer)}
    return {**experiment, "tests": changed}


class FileName(str):
    """The name of a data file as an experiment file has it, with the folder that relative names of that file begin at."""

    def __new__(cls, name, folder):
        made = super().__new__(cls, name)
        made.folder = folder
        return made

    def __reduce__(self):
        return FileName, (str(self), self.folder)


def _data_blocks(experiment):
    """The tables of the data of every test, those among them that a run defines for itself."""
    runs = experiment.get("runs")
    own = [run.get("tests") for run in runs if isinstance(run, dict)] if isinstance(runs, list) else []
    for tests in [experiment.get("tests"), *own]:
        for test in tests.values() if isinstance(tests, dict) else ():
            data = test.get("data") if isinstance(test, dict) else None
            yield from (one for one in (data if isinstance(data, list) else [data]) if isinstance(one, dict))


def _with_folder(experiment, folder):
    """The experiment, whose names of data files remember their folder."""
    for data in _data_blocks(experiment):
        for key in ("file", "numbered_files"):
            if isinstance(data.get(key), str):
                data[key] = FileName(data[key], folder)
        if isinstance(data.get("files"), list):
            data["files"] = [FileName(name, folder) for name in data["files"]]
    return experiment


def _base_of(experiment):
    """Where relative names of a dictionary begin: at the folder of the file it was read from, or here."""
    folders = set()
    for data in _data_blocks(experiment):
        several = data.get("files")
        names = [data.get("file"), data.get("numbered_files"), *(several if isinstance(several, list) else ())]
        folders |= {name.folder for name in names if isinstance(name, FileName) and not os.path.isabs(name)}
    if len(folders) > 1:
        raise InputError(f"the tests come from files in several folders, {' and '.join(sorted(folders))}; write "
                         "absolute names of their data files")
    return folders.pop() if folders else "."


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
        """The experiment as the file, or the dictionary, has it: a new dictionary to change and to run. Its data files
        are found wherever it is run from. input.json of a result has the defaults filled in."""
        return _with_folder(json.loads(self._loaded.given_json), self._loaded.folder)

    def __repr__(self):
        return f"<tunica.Experiment '{self.name}'>"


def read(experiment, base=None):
    """Reads an experiment: the path of a file, or a dictionary with the same keys, whose data files are relative to
    the folder `base`. Without it that is the current folder, or the one of the file that `input` came from. "table" in place of "file" is a frame or a dictionary of columns. What is an Experiment already
    is returned as it is. Raises InputError, which names file, line and key; a line of a dictionary counts the lines of
    `json.dumps(experiment, indent=2)`."""
    if isinstance(experiment, Experiment):
        return experiment
    if isinstance(experiment, dict):
        folder = _base_of(experiment) if base is None else text(base, "base")
        try:
            written = json.dumps({**({} if "name" in experiment else {"name": "experiment"}), **_with_files(experiment)},
                                 indent=2, default=_plain, allow_nan=False)
        except (TypeError, ValueError) as problem:
            raise InputError(str(problem)) from None
        return Experiment(library().parse(written, str(pathlib.Path(folder) / "<dict>")))
    if isinstance(experiment, (str, pathlib.PurePath)):
        return Experiment(library().read(text(experiment, "experiment")))
    raise InputError(f"found an experiment of type {type(experiment).__name__}; expected the path of a file or a dict")


def names():
    """What there is: {"models": {name: one sentence}, "tests": …, "optimizers": …, "mechanisms": …}."""
    return library().list()


def describe(name):
    """What a model, test, optimiser or mechanism declares: its parameters, options and source. It is the object that
    `tunica describe --json` prints under the kind; where several kinds share the name, all of them by kind."""
    found = json.loads(library().describe(name))
    return next(iter(found.values())) if len(found) == 1 else found


def schema():
    """The JSON Schema of experiment files, with what Python code has defined."""
    return json.loads(library().schema())
