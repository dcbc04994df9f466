# SPDX-License-Identifier: Apache-2.0
"""The exceptions of tunica. Each message says what was found, where, what was expected and what to do."""


class TunicaError(Exception):
    """Everything that tunica raises, Ctrl-C apart."""


class InputError(TunicaError, ValueError):
    """Something in the experiment, its data, a definition or an argument is not as it has to be."""


class EvaluationError(TunicaError, ArithmeticError):
    """The model cannot be evaluated there, the base fit of a diagnosis failed, or a calibration has no result: then
    `directory` is the folder with its record, else None."""

    def __init__(self, message="", directory=None):
        super().__init__(message)
        self.directory = directory


class PluginFailure(TunicaError, RuntimeError):
    """A plugin broke a promise: a fault to report to its author."""


class WriteFailure(TunicaError, OSError):
    """A file could not be written. What was searched so far is saved: run again with resume=True."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C, in a notebook the interrupt of the kernel. Of a run everything so far is saved in `directory`:
    run again with this directory and resume=True. A diagnosis leaves nothing behind, and `directory` is None."""

    def __init__(self, message, directory=None):
        super().__init__(message)
        self.directory = directory


class StopSearch(Exception):
    """Raised by the functions of a search problem once the search has to end: a definition of an optimiser need not
    catch it."""
