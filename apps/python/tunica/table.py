# SPDX-License-Identifier: Apache-2.0
"""A table of results: columns by their heading, as numpy arrays."""
import csv
import html
from collections.abc import Mapping

import numpy


def _column(cells):
    """Numbers where all cells are numbers or empty, which become NaN; else text."""
    try:
        return numpy.array([float(cell) if cell else numpy.nan for cell in cells])
    except ValueError:
        return numpy.array(cells)


class Table(Mapping):
    """Columns by heading, in order. A heading has its unit, "stress [kPa]"; table["stress"] finds it without."""

    def __init__(self, columns):
        self._columns = dict(columns)

    @classmethod
    def read(cls, file):
        """A CSV file that tunica has written. Lines that begin with # are comments."""
        with open(file, newline="", encoding="utf-8") as stream:
            header, *rows = csv.reader(line for line in stream if not line.startswith("#"))
        return cls({name: _column([row[k] for row in rows]) for k, name in enumerate(header)})

    def __getitem__(self, heading):
        if heading in self._columns:
            return self._columns[heading]
        for name, values in self._columns.items():
            if name.rpartition(" [")[0] == heading:
                return values
        raise KeyError(f"no column '{heading}'; there are: {', '.join(self._columns)}")

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    @property
    def rows(self):
        """The number of rows."""
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def where(self, heading, value):
        """The rows that have this value in this column."""
        chosen = self[heading] == value
        return Table({name: values[chosen] for name, values in self._columns.items()})

    def filled(self):
        """Without the columns that have no number in any row."""
        return Table({name: values for name, values in self._columns.items()
                      if values.dtype.kind != "f" or not numpy.isnan(values).all()})

    def frame(self):
        """The table as a pandas.DataFrame, where pandas is there."""
        import pandas
        return pandas.DataFrame(self._columns)

    def __repr__(self):
        return f"<tunica.Table, {self.rows} rows: {', '.join(self._columns)}>"

    def _repr_html_(self):
        def cell(value):
            return html.escape(f"{value:.6g}" if isinstance(value, float) else str(value))
        shown = 12
        head = "".join(f"<th>{html.escape(name)}</th>" for name in self)
        body = "".join("<tr>" + "".join(f"<td>{cell(values[row])}</td>" for values in self.values()) + "</tr>"
                       for row in range(min(shown, self.rows)))
        more = f"<p>{self.rows - shown} more rows</p>" if self.rows > shown else ""
        return f"<table><tr>{head}</tr>{body}</table>{more}"
