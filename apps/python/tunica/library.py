# SPDX-License-Identifier: Apache-2.0
"""The plugins of this process, and how an experiment is read from what the user has: a file, a dictionary."""
import json
import pathlib
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
    the folder `base`. What is an Experiment already is returned as it is. Raises InputError, which names file, line and
    key; a line of a dictionary counts the lines of `json.dumps(experiment, indent=2)`."""
    if isinstance(experiment, Experiment):
        return experiment
    if isinstance(experiment, dict):
        try:
            text = json.dumps({"name": "experiment", **experiment} if "name" not in experiment else experiment,
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
