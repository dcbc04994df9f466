# SPDX-License-Identifier: Apache-2.0
"""What the command line does, as functions: run, check, simulate, diagnose, discover."""
import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from . import _core
from .arguments import finite, path, text, texts
from .declarations import modules
from .errors import EvaluationError, Interrupted, WriteFailure
from .library import library, read
from .results import Check, Diagnosis, Discovery, Result, Simulation


def thread_count(threads):
    """All of the machine unless given."""
    return len(os.sched_getaffinity(0)) if threads is None else int(threads)


class _Line:
    """Progress as one line on stderr that is written again and again, in a notebook below the cell."""

    def __init__(self):
        self._written = 0

    def __call__(self, share, text):
        text = text.strip()[:110]
        if not text.split(" ", 1)[0].isdigit():  # the stages of a diagnosis come without their share
            text = f"{100 * share:.0f} %  {text}"
        sys.stderr.write("\r" + text.ljust(self._written))
        sys.stderr.flush()
        self._written = len(text)

    def clear(self):
        if self._written:
            sys.stderr.write("\r" + " " * self._written + "\r")
            sys.stderr.flush()


@contextlib.contextmanager
def listening(progress):
    """What a search tells how far it is; its line is gone afterwards."""
    listener = _Line() if progress is True else progress or None
    try:
        yield listener
    finally:
        if isinstance(listener, _Line):
            listener.clear()


def _types(value):
    """Every text under a key "type"."""
    if isinstance(value, list):
        return set().union(*map(_types, value))
    if not isinstance(value, dict):
        return set()
    found = set().union(*map(_types, value.values()))
    return found | {value["type"]} if isinstance(value.get("type"), str) else found


def _certify(folder, points):
    """The best points, evaluated by a Python process that has seen nothing of the search. Returns its answer, or why
    there is none."""
    used = _types(json.loads((pathlib.Path(folder) / "input.json").read_text(encoding="utf-8"))) & set(modules)
    loose = sorted(name for name in used if modules[name] == "__main__")
    if loose:
        return "", (f"'{loose[0]}' is defined in a notebook or a script, which a fresh process does not have; define "
                    "it in a module, and import that")
    package = str(pathlib.Path(_core.__file__).absolute().parent.parent)
    paths = [package] + [path or os.getcwd() for path in sys.path]
    answer = subprocess.run([sys.executable, "-m", "tunica.certify", folder, points, *sorted({modules[name]
                                                                                              for name in used})],
                            capture_output=True, text=True, check=False,
                            env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)})
    if answer.returncode:
        last = answer.stderr.strip().splitlines()
        return "", f"it ended with code {answer.returncode}" + (f": {last[-1]}" if last else "")
    return answer.stdout, ""


def _draws(posterior):
    """How many draws of the posterior are asked for, or None."""
    return (4000 if posterior else None) if posterior is None or isinstance(posterior, bool) else posterior


def run(experiment, directory=None, *, base=None, threads=None, seed=None, profiles=(), bootstrap=None,
        posterior=None, discrepancy=False, paired_starts=False, resume=False, certificate=True, progress=None):
    """Calibrates every entry of "runs" and compares them, as `tunica run` does; returns a Result.

    experiment: the path of a file, a dictionary, or an Experiment. directory: a new folder for the results; without
    it results/<name>-<n>. threads: all of the machine unless given; results do not depend on it. progress: True for a
    line on stderr, or a function that is called with the share that is done and a line of text.
    posterior: how often to draw from the posterior of every run, or True for 4000 times: Run.posterior has the draws.
    discrepancy: let the posterior allow for a smooth misfit of unknown size; 4000 draws unless `posterior` says more.
    paired_starts: runs of the same parameters and bounds begin at the same points, as the key of that name says.

    Ctrl-C raises Interrupted. Everything so far is saved, and the same call with its `directory` and resume=True goes
    on to the identical result. Raises InputError for whatever does not fit, before anything is evaluated, and
    EvaluationError where no run has a result; its `directory` has the record of the search.
    """
    found_experiment = read(experiment, base)
    names = ["all"] if profiles == "all" else texts(profiles, "profiles")
    with listening(progress) as listener:
        found = _core.run(found_experiment._loaded, path(directory, "directory"), resume,
                          thread_count(threads), seed, names, bootstrap, _draws(posterior), bool(discrepancy),
                          bool(paired_starts), listener, _certify if certificate else None)
    if found["ending"] == "interrupted":
        raise Interrupted(f"interrupted; everything so far is saved. Go on with "
                          f"run(…, directory={found['directory']!r}, resume=True)", found["directory"])
    if found["ending"] == "write_failure":
        raise WriteFailure(f"{found['write_failure']}. Then go on with run(…, directory={found['directory']!r}, "
                           "resume=True)")
    result = Result(found["directory"])
    if not any(run.found for run in result.runs.values()):
        reasons = {run.no_result for run in result.runs.values()}
        raise EvaluationError(f"no run has a result: {'; '.join(sorted(reasons))}. The record is in "
                              f"{found['directory']}", found["directory"])
    return result


def check(experiment, *, base=None, run_external=False):
    """A dry run, as `tunica check` does it: names, units, data, bounds, the initial point and identifiability. Returns
    a Check, a dictionary; its `in_order` says whether all is well. Writes nothing. Programs and servers that the file
    names are started and asked with run_external only; without it `not_run` names them."""
    return Check(json.loads(_core.check(read(experiment, base)._loaded, run_external)))


def subject(experiment, model, parameters, scratch):
    """The name of the model and the file of its parameters, as the command line has them. A dictionary of parameters
    becomes a file of the folder `scratch`."""
    if not model and len(experiment.input["models"]) == 1 and not isinstance(parameters, Result):
        model = next(iter(experiment.input["models"]))
    if hasattr(parameters, "json") and hasattr(parameters, "optimizer"):
        model, parameters = model or parameters.model, {**parameters.parameters}
    if isinstance(parameters, Result):
        model = model or parameters.best.model
        parameters = parameters.directory / "result.json"
    if isinstance(parameters, dict):
        file = pathlib.Path(scratch) / "parameters.json"
        file.write_text(json.dumps({name: value if isinstance(value, str) else finite(value, f"parameters: '{name}'")
                                    for name, value in parameters.items()}))
        parameters = file
    return text(model, "model"), path(parameters, "parameters")


def simulate(experiment, model="", parameters=None, directory=None, *, base=None, run="", noise=0.0, seed=None,
             fields=()):
    """Predicts every test, as `tunica simulate` does; returns a Simulation.

    model: a model of the experiment; the only one unless given. parameters: a Result, a Run, the path of a
    result.json, or a dictionary {name: value or "value unit"}; the initial values unless given. directory: where to
    write the tables; nothing is written without it. noise: relative, for synthetic data.
    """
    found_experiment = read(experiment, base)
    with tempfile.TemporaryDirectory() as scratch:
        model, parameters = subject(found_experiment, model, parameters, scratch)
        found = _core.simulate(found_experiment._loaded, model, parameters, text(run, "run"), finite(noise, "noise"), seed, texts(fields, "fields"),
                               path(directory, "directory"))
    return Simulation(found, directory)


def diagnose(experiment, directory=None, *, base=None, threads=None, seed=None, alpha=None, mechanisms=(), quick=False,
             progress=None):
    """Shows where the simulation is wrong and names the cause, as `tunica diagnose` does; returns a Diagnosis.

    Arguments as run() has them; alpha: the share of false alarms that is accepted; mechanisms: only these causes;
    quick: a first answer. Ctrl-C raises Interrupted, and leaves nothing behind.
    """
    found = _searched(experiment, base, progress, lambda loaded, listener: _core.diagnose(
        loaded, path(directory, "directory"), thread_count(threads), seed, finite(alpha, "alpha"),
        texts(mechanisms, "mechanisms"), quick, listener))
    return Diagnosis(found["directory"])


def discover(experiment, directory=None, *, base=None, threads=None, seed=None, alpha=None, model="", from_nothing=False,
             invariants=(), laws=(), most_terms=None, most_parameters=None, quick=False, progress=None):
    """Finds the terms that the energy lacks, or is made of, as `tunica discover` does; returns a Discovery.

    Arguments as diagnose() has them; model: the base; from_nothing: the terms make up the whole energy; invariants,
    laws: only these; most_terms, most_parameters: limits of a set. Ctrl-C raises Interrupted, and leaves nothing
    behind.
    """
    options = {"seed": seed, "alpha": finite(alpha, "alpha"), "model": text(model, "model"),
               "from_nothing": from_nothing, "invariants": texts(invariants, "invariants"), "laws": texts(laws, "laws"), "most_terms": most_terms,
               "most_parameters": most_parameters, "quick": quick}
    found = _searched(experiment, base, progress, lambda loaded, listener: _core.discover(
        loaded, path(directory, "directory"), thread_count(threads), options, listener))
    return Discovery(found["directory"])


def _searched(experiment, base, progress, search):
    """What `search` says of the experiment that was read, and of a listener. Raises Interrupted."""
    found_experiment = read(experiment, base)
    with listening(progress) as listener:
        found = search(found_experiment._loaded, listener)
    if found["ending"] == "interrupted":
        raise Interrupted("interrupted; an unfinished search leaves nothing behind. Start it again, or with "
                          "quick=True for a first answer")
    return found


def certify(folder, points):
    """What `tunica certify` prints; for the process that run() starts."""
    return _core.certify(library(), str(folder), str(points))
