# SPDX-License-Identifier: Apache-2.0
"""A first experiment from files as a testing machine wrote them, as `tunica import` makes it."""
import os
import pathlib

from . import _core
from .arguments import text
from .errors import InputError
from .library import Experiment, library

_CHOICES = {"strain_measure": ("engineering", "true", "green"), "delimiter": (",", ";", "tab", "space"),
            "decimal": (".", ",")}


class Imported(Experiment):
    """The experiment that was written to `file`, read and checked. `notes` say what was understood of the data files,
    `understood` what every column is taken for, and `warnings` what `check` finds; `in_order` is that of `check`."""

    def __init__(self, loaded, found):
        super().__init__(loaded)
        self.file = pathlib.Path(found["file"])
        self.notes = found["notes"]
        self.understood = found["understood"]
        self.warnings = found["warnings"]
        self.in_order = found["in_order"]


def _pairs(given, what):
    """{"force": "Kraft"} as ["force=Kraft"]; a text stands for all."""
    if given is None:
        return []
    if isinstance(given, str):
        return [text(given, what)]
    try:
        return [f"{text(name, what)}={text(str(value), what)}" for name, value in given.items()]
    except AttributeError:
        raise InputError(f"{what}: found {given!r}, expected a dictionary") from None


def import_rig(files, output=None, *, test=None, model=None, width=None, thickness=None, height=None, gauge_length=None,
               area=None, diameter=None, specimens=None, strain_measure=None, stress_measure=None, cycle=None, branch=None,
               preload=None, each=None, delimiter=None, decimal=None, skip_lines=None, rows=None, columns=None, units=None,
               where=None, direction=None, compression=None, options=None, join=False, together=False):
    """Reads files of a testing machine and writes a first experiment from them, as `tunica import` does; returns an
    Imported, which is an Experiment.

    files: a path, or several. output: the experiment file to write; without it the name of the data file with .json.
    The other arguments are the options of the command line, sizes as texts with their unit ("5 mm"). columns is
    {quantity: column}, units {column: unit}, where {column: value}, options {key: value} of the test; direction and
    compression are one word, or a dictionary by test and by column. together: the files are tests of one specimen.

    What the files do not say raises InputError, which names each option that answers, and nothing is written."""
    given = {"test": test, "model": model, "width": width, "thickness": thickness, "height": height,
             "gauge_length": gauge_length, "area": area, "diameter": diameter, "specimens": specimens,
             "strain_measure": strain_measure, "stress_measure": stress_measure, "cycle": cycle, "branch": branch,
             "preload": preload, "each": each, "delimiter": delimiter, "decimal": decimal, "skip_lines": skip_lines,
             "rows": rows, "output": output}
    texts = {name: text(str(value) if isinstance(value, int) else value, name)
             for name, value in given.items() if value is not None}
    for name, words in _CHOICES.items():
        if texts.get(name, words[0]) not in words:
            raise InputError(f"{name}: found {texts[name]!r}, expected {' or '.join(words)}")
    if not texts.get("skip_lines", "0").isdigit():
        raise InputError(f"skip_lines: found {texts['skip_lines']!r}, expected a number of lines")
    several = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    if not several:
        raise InputError("files: found none, expected the path of a data file, or several")
    lists = {"files": [text(file, "files") for file in several], "columns": _pairs(columns, "columns"),
             "units": _pairs(units, "units"), "where": _pairs(where, "where"), "direction": _pairs(direction, "direction"),
             "compression": _pairs(compression, "compression"), "options": _pairs(options, "options")}
    found = _core.import_files(library(), texts, lists, bool(join), bool(together))
    return Imported(library().read(found["file"]), found)
