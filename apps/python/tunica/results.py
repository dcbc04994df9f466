# SPDX-License-Identifier: Apache-2.0
"""Results, read from the folder that the core has written: the files are those of the command line."""
import functools
import html
import json
import pathlib
import re

import numpy

from . import _core
from .arguments import finite, text
from .errors import EvaluationError, InputError
from .library import library
from .table import Table


def once(method):
    """Reads a file when it is first asked for, and keeps what it says."""
    @functools.wraps(method)
    def kept(self):
        name = "_" + method.__name__
        if name not in self.__dict__:
            self.__dict__[name] = method(self)
        return self.__dict__[name]
    return kept


class Named(dict):
    """A dictionary that says which names there are where one is not."""

    def __init__(self, kind, entries=()):
        super().__init__(entries)
        self._kind = kind

    def __missing__(self, name):
        raise KeyError(f"no {self._kind} '{name}'; there are: {', '.join(map(str, self))}")

    def __reduce__(self):
        return Named, (self._kind, dict(self))


class Estimate(float):
    """A parameter: its value, which is a number, and its uncertainty. All are in `unit`."""

    def __new__(cls, value, about):
        estimate = super().__new__(cls, value)
        estimate.about = about
        return estimate

    @property
    def unit(self):
        return self.about["unit"]

    @property
    def ci95(self):
        """The 95 % interval, or None where the data do not fix the parameter."""
        return self.about.get("ci95") and tuple(self.about["ci95"])

    @property
    def mesh_bias(self):
        """What finite elements on a finer mesh would take off the value, or None where no test compares itself so."""
        return self.about.get("mesh_bias")

    @property
    def at_bound(self):
        """"lower" or "upper" where the value lies at a bound, else None."""
        return self.about.get("at_bound")

    def __repr__(self):
        interval = f" ({self.ci95[0]:.6g} … {self.ci95[1]:.6g})" if self.ci95 else ""
        return f"{float(self):.6g}{'' if self.unit == '1' else ' ' + self.unit}{interval}"

    def __reduce__(self):
        return Estimate, (float(self), self.about)


def _framed(report, name):
    """The report with its charts. Scripts run in a frame of their own, which reaches nothing outside of it."""
    page = html.escape(report.read_text(encoding="utf-8"), quote=True)
    return ('<iframe sandbox="allow-scripts allow-downloads" style="width: 100%; height: 45em; border: 1px solid" '
            f'title="Report of {html.escape(name, quote=True)}" srcdoc="{page}"></iframe>')


class Folder:
    """What a folder of results holds. It is as good when it is opened years later: tunica.open(folder)."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        #: result.json as it is; tunica.result_types and docs/results-reference.md have its keys
        self.json = saved(self.directory / "result.json")

    @property
    def name(self):
        return self.json["name"]

    @property
    def warnings(self):
        """Sentences. Codes to decide on stand in json["warning_details"]."""
        return self.json["warnings"]

    @property
    def report(self):
        """The path of the report, one HTML file."""
        return self.directory / "report.html"

    def table(self, name):
        """A table of the folder by the name of its file, for example "ranking" or "fit_strip"."""
        file = self.directory / f"{name}.csv"
        if not file.exists():
            known = ", ".join(sorted(path.stem for path in self.directory.glob("*.csv")))
            raise InputError(f"{self.directory}: there is no table '{name}'; there are: {known}")
        return Table.read(file)

    def _repr_html_(self):
        return _framed(self.report, self.name)


class Run:
    """One entry of "runs": a model, an optimiser, and the best point that was found."""

    def __init__(self, result, about):
        self._result = result
        #: its entry of result.json
        self.json = about

    @property
    def name(self):
        return self.json["run"]

    @property
    def model(self):
        return self.json["model"]

    @property
    def optimizer(self):
        return self.json["optimizer"]

    @property
    def found(self):
        """Whether there is a best point: some evaluation succeeded."""
        return self.json["best"] is not None

    @property
    def best(self):
        """The best point as result.json has it."""
        if not self.found:
            raise EvaluationError(self.no_result)
        return self.json["best"]

    @property
    def no_result(self):
        """Why there is no best point, or "" where there is one."""
        if self.found:
            return ""
        failure = self.json.get("first_failure")
        why = f"the first failure: {failure}" if failure else f"it ended after {self.json['evaluations']} evaluations"
        return f"the run '{self.name}' has no result; {why}"

    @property
    def objective(self):
        return self.best["objective"]

    @property
    def misses_by(self):
        """Root mean square of the misfit that noise does not explain, as a share of the range of the observables; None
        where nothing is fitted. `best["misfit_size"]` has it by test, in units, with its upper bound."""
        size = self.best["misfit_size"]
        return size and size["rms"]

    @property
    def parameters(self):
        """{name: Estimate} of the free parameters."""
        return Named("parameter", {name: Estimate(about["value"], about)
                                   for name, about in self.best["parameters"].items()})

    @property
    def fixed(self):
        """{name: Estimate} of the held parameters."""
        return {name: Estimate(about["value"], about) for name, about in self.json["fixed"].items()}

    @property
    def covariance(self):
        """(names, matrix) of the parameters that the data fix, in the units of the parameters; None in results without
        it."""
        about = self.best.get("covariance")
        return about and (about["parameters"], numpy.array(about["values"]))

    @property
    @once
    def posterior(self):
        """{name: array} of draws from the posterior, chains × draws, in base units; None where none were asked for.
        `best["posterior"]` says whether the chains agree. arviz.from_json(run.posterior_file) reads the same."""
        draws = self.posterior_file and saved(self.posterior_file)["posterior"]
        return draws and Named("parameter", {name: numpy.array(chains, dtype=float) for name, chains in draws.items()})

    @property
    def posterior_file(self):
        """The path of the draws, or None."""
        about = self.best.get("posterior")
        return about and self._result.directory / about["file"]

    @property
    def converged(self):
        return self.json["converged"]

    @property
    @once
    def fit(self):
        """{test: Table}: measured and predicted, row by row."""
        self.best  # raises where there is none
        tables = Named("test")
        for test in self.json["tests"]:
            table = self._result.table("fit_" + re.sub(r"[^A-Za-z0-9_-]", "-", test))
            tables[test] = table.where("run", self.name).filled()
        return tables

    def card(self, to, *, model="", units="mm-N-MPa", name="", bulk_ratio=None, density="", subroutine=""):
        """The material card for a finite-element program, as `tunica export` prints it: text. to: "calculix", "abaqus"
        and others that docs/export.md lists. model: where layers have several. density: "1000 kg/m3" or a number of
        kg/m³, for febio and lsdyna. subroutine: a new file for Abaqus' UANISOHYPER_INV, which the card then calls. Raises
        InputError with the reason for what the program cannot express."""
        self.best  # raises where there is none
        if density is not None and not isinstance(density, str):
            density = f"{finite(density, 'density')!r} kg/m3"
        words = {"to": to, "model": model, "units": units, "name": name, "density": density or "", "subroutine": subroutine}
        to, model, units, name, density, subroutine = (text(value, what) for what, value in words.items())
        return _core.export_card(library(), str(self._result.directory), to, self.name, model, units, name,
                                 finite(bulk_ratio, "bulk_ratio"), density, subroutine)

    def __repr__(self):
        if not self.found:
            return f"<tunica.Run '{self.name}', no result>"
        values = ", ".join(f"{name} = {value!r}" for name, value in self.parameters.items())
        return f"<tunica.Run '{self.name}', objective {self.objective:.6g}: {values}>"


class Result(Folder):
    """What tunica.run() found."""

    @property
    @once
    def runs(self):
        """{name: Run}, in the order of the experiment."""
        return {about["run"]: Run(self, about) for about in self.json["runs"]}

    @property
    def best(self):
        """The run that is ranked first. Ranks hold within a group of runs with the same tests and objective."""
        for entry in self.json["ranking"]:
            if entry["rank"] is not None:
                return self.runs[entry["run"]]
        raise EvaluationError(f"{self.directory}: no run has a result; {next(iter(self.runs.values())).no_result}",
                              str(self.directory))

    @property
    def parameters(self):
        """Those of the best run."""
        return self.best.parameters

    @property
    def posterior(self):
        """The draws of the best run, see Run.posterior."""
        return self.best.posterior

    def card(self, to, **options):
        """The material card of the best run, see Run.card."""
        return self.best.card(to, **options)

    @property
    @once
    def ranking(self):
        return self.table("ranking")

    @property
    @once
    def evaluations(self):
        """Every evaluation, in the order of evaluations.csv."""
        return self.table("evaluations")

    def frame(self):
        """Run, parameter, value, unit and interval as a pandas.DataFrame, where pandas is there."""
        import pandas
        rows = [(run.name, name, float(value), value.unit, *(value.ci95 or (numpy.nan, numpy.nan)))
                for run in self.runs.values() if run.found for name, value in run.parameters.items()]
        return pandas.DataFrame(rows, columns=["run", "parameter", "value", "unit", "low", "high"])

    def __repr__(self):
        return "\n".join([f"<tunica.Result '{self.name}' in {self.directory}>",
                          *(f"  {run!r}" for run in self.runs.values())])


class Judgement(Folder):
    """What tunica.diagnose() and tunica.discover() have in common."""

    _found = ""  # its key in result.json

    @property
    def verdict(self):
        """The code of the verdict, for example "nothing_detected", "named" or "discovered":
        tunica.result_types.DiagnosisVerdict."""
        return self.json[self._found]["verdict"]

    @property
    def reasons(self):
        """Why: sentences of a diagnosis, dictionaries with code and text of a discovery."""
        return self.json[self._found]["reasons"]

    @property
    def extended(self):
        """The path of the experiment with what was found added, which run() takes, or None."""
        file = self.directory / "extended.json"
        return file if file.exists() else None

    @property
    @once
    def residuals(self):
        return self.table("residuals")


class Diagnosis(Judgement):
    """What tunica.diagnose() found."""

    _found = "diagnosis"

    @property
    def causes(self):
        """The causes that are named, each a dictionary with id, probability and amplitude."""
        return self.json["diagnosis"]["causes"]

    def __repr__(self):
        causes = ", ".join(cause["id"] for cause in self.causes) or "none named"
        return f"<tunica.Diagnosis '{self.name}' in {self.directory}: {self.verdict}; causes: {causes}>"


class Discovery(Judgement):
    """What tunica.discover() found."""

    _found = "discovery"

    @property
    def terms(self):
        """The terms of the energy, each a dictionary with name, invariant, law, probability, parameters and curve."""
        return self.json["discovery"]["terms"]

    def __repr__(self):
        terms = ", ".join(term["name"] for term in self.terms) or "none"
        return f"<tunica.Discovery '{self.name}' in {self.directory}: {self.verdict}; terms: {terms}>"


class Simulation:
    """What tunica.simulate() predicted."""

    def __init__(self, found, directory):
        self.model = found["model"]
        #: {test: Table}, with the columns of the data
        self.tables = {test: Table(columns) for test, columns in found["tables"].items()}
        #: {name: value} in base units, fixed ones included
        self.parameters = dict(found["parameters"])
        self.warnings = list(found["warnings"])
        self.directory = pathlib.Path(directory) if directory is not None else None

    def __getitem__(self, test):
        return Named("test", self.tables)[test]

    def _repr_html_(self):
        if self.directory is not None:
            return _framed(self.directory / "report.html", self.model)
        return "".join(f"<h4>{html.escape(test)}</h4>{table._repr_html_()}" for test, table in self.tables.items())

    def __repr__(self):
        return f"<tunica.Simulation of {', '.join(self.tables)} with '{self.model}'>"


class Check(dict):
    """What tunica.check() found, as `tunica check --json` prints it: tunica.result_types.Check has its keys."""

    @property
    def in_order(self):
        return self["in_order"]

    @property
    def warnings(self):
        return self["warnings"]


def saved(file):
    """JSON of a folder that somebody else may have made."""
    try:
        content = file.read_text(encoding="utf-8")
        _core.check_levels(content)  # as deep as the command line reads, whatever the interpreter allows
        return json.loads(content)
    except (ValueError, RecursionError, InputError) as problem:
        raise InputError(f"{file}: is not JSON that tunica has written ({problem}); run it again") from None
