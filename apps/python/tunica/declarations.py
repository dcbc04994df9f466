# SPDX-License-Identifier: Apache-2.0
"""What a definition in Python declares, as the core wants it."""
import inspect
from typing import NamedTuple

from .library import library


class Parameter(NamedTuple):
    """A parameter of a definition, in its base unit. Bounds decide where a search goes; files may change them."""
    name: str
    unit: str = "kPa"
    initial: float = 1.0
    min: float = 1e-3
    max: float = 1e3
    log: bool = False
    doc: str = ""
    reference: str = ""


class Observable(NamedTuple):
    """A column that the data of a test can have. role: "channel" is measured and predicted, "abscissa" prescribed,
    "time" the clock, in s. kind: "stretch" and "stress" are checked and converted, "plain" is not."""
    name: str
    unit: str = "1"
    role: str = "channel"
    kind: str = "plain"
    required: bool = True
    doc: str = ""


def parameters_of(declared):
    """Parameters, or {"mu": ("kPa", 100, 1, 1e4)}."""
    if isinstance(declared, dict):
        declared = [Parameter(name, *about) for name, about in declared.items()]
    return [parameter._asdict() for parameter in declared]


def observables_of(declared):
    """Observables, or {"pressure": ("kPa", "channel")}."""
    if isinstance(declared, dict):
        declared = [Observable(name, *about) for name, about in declared.items()]
    return [observable._asdict() for observable in declared]


def options_of(declared):
    """{"terms": 2} with its default, or {"terms": (2, "How many.")}."""
    pairs = {name: about if isinstance(about, tuple) else (about, "") for name, about in (declared or {}).items()}
    return [{"name": name, "default": default, "doc": doc} for name, (default, doc) in pairs.items()]


#: {name: module} of the definitions, for other processes that need them
modules = {}


def head(name, definition, doc, reference, options):
    """What all kinds have in common. The sentence is the first one of the docstring unless given."""
    modules[name] = getattr(definition, "__module__", None) or "__main__"
    written = inspect.getdoc(definition) if inspect.isfunction(definition) or inspect.isclass(definition) else None
    sentence = doc or " ".join((written or "Defined in Python.").split("\n\n")[0].split())
    return {"name": name, "doc": sentence, "reference": reference, "options": options_of(options)}


def method_of(definition, options, method):
    """The function of a definition: itself with the options as keywords, or the method of an object of the class that
    is made with them."""
    if inspect.isclass(definition):
        return getattr(definition(**options), method)
    if not options:
        return definition
    return lambda *arguments: definition(*arguments, **options)


def forget(name):
    """Removes the definition of this name."""
    library().forget(name)
    modules.pop(name, None)
