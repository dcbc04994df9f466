# SPDX-License-Identifier: Apache-2.0
"""Material parameters from mechanical tests of soft tissue and rubber: docs/python.md.

    import tunica
    result = tunica.run("experiment.json")
    print(result.parameters)
"""
try:
    from ._core import version as __version__
except ModuleNotFoundError as problem:
    from .missing import explained
    if problem.name != "tunica._core":
        raise
    raise ImportError(explained()) from None
from .cohorts import Cohort
from .cohorts import open_results as open
from .declarations import Observable, Parameter, forget
from .energies import Energy, Strain, model
from .errors import (EvaluationError, InputError, Interrupted, PluginFailure, StopSearch, TunicaError, WriteFailure)
from .library import Experiment, describe, names, read, schema, use_plugins
from .material import Material
from .mechanisms import mechanism
from .pages import Studio, studio
from .problem import Evaluation, Problem
from .results import Check, Diagnosis, Discovery, Estimate, Result, Run, Simulation
from .rigs import Imported, import_rig
from .rows import Rows, test
from .searches import Search, optimizer
from .serving import Server, serve
from .studies import cohort, export, report, stability
from .table import Table
from .verbs import check, diagnose, discover, run, simulate

__all__ = ["Check", "Cohort", "Diagnosis", "Discovery", "Energy", "Estimate", "Evaluation", "EvaluationError", "Experiment", "Imported",
           "InputError", "Interrupted", "Material", "Observable", "Parameter", "PluginFailure", "Problem", "Result", "Rows", "Run",
           "Search", "Server", "Simulation", "StopSearch", "Strain", "Studio", "Table", "TunicaError", "WriteFailure", "check", "cohort",
           "describe", "diagnose", "discover", "export", "forget", "import_rig", "mechanism", "model", "names", "open",
           "optimizer", "read", "report", "run", "schema", "serve", "simulate", "stability", "studio", "test", "use_plugins", "__version__"]
