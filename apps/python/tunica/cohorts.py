# SPDX-License-Identifier: Apache-2.0
"""Results of many specimens, read from their folder, and what any folder of results is."""
import pathlib

from .arguments import text
from .errors import InputError
from .results import Diagnosis, Discovery, Folder, Result, once, saved


class Cohort(Folder):
    """What tunica.cohort() found."""

    @property
    def specimens(self):
        """What became of each specimen, in the order of the table."""
        return self.json["cohort"]["specimens"]

    @property
    def populations(self):
        """What the specimens of each run have in common."""
        return self.json["cohort"]["populations"]

    @property
    @once
    def parameters(self):
        """The parameters of every specimen, in the order of parameters.csv."""
        return self.table("parameters")

    @property
    @once
    def population(self):
        """Means, spreads and effects, in the order of population.csv."""
        return self.table("population")

    def specimen(self, id):
        """The Result of one specimen."""
        for about in self.specimens:
            if about["id"] == id:
                return Result(self.directory / about["folder"])
        raise InputError(f"{self.directory}: there is no specimen '{id}'; there are: "
                         f"{', '.join(about['id'] for about in self.specimens)}")


def open_results(directory):
    """Results that were written before, by Python or by the command line."""
    directory = pathlib.Path(text(directory, "directory"))
    if not (directory / "result.json").exists():
        raise InputError(f"{directory}: there is no result.json; name the folder of a finished run, diagnosis, discovery or cohort")
    found = saved(directory / "result.json")
    if "cohort" in found:
        return Cohort(directory)
    if "diagnosis" in found:
        return Diagnosis(directory)
    return Discovery(directory) if "discovery" in found else Result(directory)
