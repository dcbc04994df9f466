# SPDX-License-Identifier: Apache-2.0
"""What the command line does with many specimens and with what a run has left: cohort, stability, report, export."""
import json
import pathlib
import subprocess
import tempfile

from . import _core
from .arguments import finite, path, text, texts
from .cohorts import Cohort
from .errors import InputError, Interrupted
from .library import library, read
from .pages import _program
from .results import Folder, Result, Run
from .verbs import listening, subject, thread_count


def cohort(file, directory=None, *, threads=None, diagnose=False, reports=None, progress=None):
    """Fits many specimens and says what they have in common, as `tunica cohort` does; returns a Cohort.

    file: the path of a cohort file (docs/cohort.md). directory: a new folder, or one of an earlier start of the same
    cohort; without it results/<name>-<n>. reports: whether each specimen gets a report; of up to 50 unless given. The
    other arguments are those of run(). Ctrl-C raises Interrupted; the same call with its `directory` makes only what is
    missing.
    """
    with listening(progress) as listener:
        found = _core.fit_cohort(library(), text(file, "file"), path(directory, "directory"), thread_count(threads),
                                 bool(diagnose), reports, listener)
    if found["ending"] == "interrupted":
        raise Interrupted(f"interrupted; the specimens that are done are saved. Go on with "
                          f"cohort(…, directory={found['directory']!r})", found["directory"])
    return Cohort(found["directory"])


def stability(experiment, model="", parameters=None, directory=None, *, base=None, run="", to=None, map=None, points=41):
    """Judges whether a parameter set is a stable material, as `tunica stability --json` does: a dictionary,
    tunica.result_types.StabilityAnswer.

    experiment, model, parameters and run as simulate() has them. to: judge up to this stretch, the largest measured one
    unless given. map: the names of two free parameters, to map where the material is stable between their bounds, with
    `points` along each. directory: a new folder for the tables.
    """
    names = texts(map, "map") if map is not None else None
    if names is not None and len(names) != 2:
        raise InputError(f"map: found {len(names)} names, expected those of two free parameters")
    found_experiment = read(experiment, base)
    with tempfile.TemporaryDirectory() as scratch:
        model, parameters = subject(found_experiment, model, parameters, scratch)
        return json.loads(_core.stability(found_experiment._loaded, model, parameters, text(run, "run"),
                                          finite(to, "to"), names, points, path(directory, "directory")))


def _folder(result):
    return str(result.directory) if isinstance(result, Folder) else text(result, "result")


def _printed(folders, output):
    """The program prints: it finds a browser, and ends it where it hangs."""
    if output is None or not folders:
        raise InputError("report: pdf=True needs folders and output=, the file to print into")
    output = pathlib.Path(text(output, "output"))
    printed = subprocess.run([_program("report(pdf=True)"), "report", *folders, "--pdf", str(output)],
                             stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if printed.returncode:
        raise InputError(printed.stderr.strip().removeprefix("error: "))
    return output


def report(*results, output=None, pdf=False):
    """Makes the report again, as `tunica report` does; returns the path of the page.

    results: results, or folders of results. output: the file to write, which several of them need; report.html in the
    folder unless given. pdf: print it, by a browser that is installed; `output` is then needed.
    """
    folders = [_folder(result) for result in results]
    if pdf:
        return _printed(folders, output)
    if output is None and len(folders) == 1:
        return pathlib.Path(_core.write_report(folders[0]))
    if output is None or not folders:
        raise InputError(f"report: found {len(folders)} folders and no output; expected one folder, or several and "
                         "output=, the file that their page goes to")
    output = pathlib.Path(text(output, "output"))
    if output.is_dir():
        raise InputError(f"output {str(output)!r}: is a folder; name a file, for example {str(output / 'report.html')!r}")
    _core.write_page(folders, str(output))
    return output


def export(result, to, *, run="", **options):
    """The material card of a fit for a finite-element program, as `tunica export` prints it: text.

    result: a Result, a Run, or a folder of results. to: "calculix", "abaqus" and others that docs/export.md lists. run:
    the name of a run, the best one unless given. The other options are those of Run.card().
    """
    if isinstance(result, Run):
        return result.card(to, **options)
    if not isinstance(result, Result):
        result = Result(_folder(result))
    if run and run not in result.runs:
        raise InputError(f"run: found '{run}', expected one of {', '.join(result.runs)}")
    return (result.runs[run] if run else result.best).card(to, **options)
