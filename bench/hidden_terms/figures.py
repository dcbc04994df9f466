# SPDX-License-Identifier: Apache-2.0
"""Figures of a blind run: shares with Wilson's 95 % intervals, medians, and the table that holds them."""
import math
import typing

import numpy as np

MISSING = "–"


def wilson(hits: int, count: int) -> typing.Tuple[float, float]:
    """95 % interval of a share (Wilson 1927); 0 to 1 where nothing was counted."""
    if count == 0:
        return 0.0, 1.0
    z, share = 1.959964, hits / count
    middle = (share + z * z / (2 * count)) / (1 + z * z / count)
    half = z / (1 + z * z / count) * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return middle - half if hits > 0 else 0.0, middle + half if hits < count else 1.0


class Figure(typing.NamedTuple):
    """A row of the table. `bar` and `at_least` say when it passes; without a bar it is told only."""
    name: str
    value: float
    low: float
    high: float
    cases: int
    bar: typing.Optional[float] = None
    at_least: bool = True
    note: str = ""

    def passed(self) -> bool:
        if self.bar is None or self.cases == 0:
            return True
        return self.value >= self.bar if self.at_least else self.value <= self.bar

    def missed_by_more_than_chance(self) -> bool:
        if self.bar is None or self.cases == 0:
            return False
        return self.high < self.bar if self.at_least else self.low > self.bar

    def row(self) -> str:
        if self.cases == 0:
            return f"| {self.name} | {MISSING} | {MISSING} | 0 | {self.note} |"
        bar = MISSING
        if self.bar is not None:
            bar = f"{'≥' if self.at_least else '≤'} {self.bar:g} {'✓' if self.passed() else '✗'}"
        return (f"| {self.name} | {self.value:.3f} ({self.low:.3f}–{self.high:.3f}) | {bar} | {self.cases} | "
                f"{self.note} |")


def share(name: str, answers: typing.Iterable[bool], bar: typing.Optional[float] = None, at_least: bool = True,
          note: str = "") -> Figure:
    """How many of the answers are yes."""
    told = list(answers)
    hits, count = sum(told), len(told)
    low, high = wilson(hits, count)
    return Figure(name, hits / count if count else float("nan"), low, high, count, bar, at_least, note)


def median(name: str, values: typing.Iterable[float], bar: typing.Optional[float] = None, at_least: bool = False,
           note: str = "") -> Figure:
    """The median and its 95 % interval from order statistics, which needs no distribution."""
    ordered = sorted(values)
    count = len(ordered)
    if count == 0:
        return Figure(name, float("nan"), 0.0, 1.0, 0, bar, at_least, note)
    half = 1.959964 * math.sqrt(count) / 2
    low = ordered[max(0, math.floor(count / 2 - half))]
    high = ordered[min(count - 1, math.ceil(count / 2 + half) - 1 if count > 1 else 0)]
    return Figure(name, float(np.median(ordered)), low, high, count, bar, at_least, note)


def calibration_error(stated: typing.Sequence[float], right: typing.Sequence[bool], bins: int = 5) -> float:
    """Mean difference between stated probability and share that is right, over bins of equal numbers of cases."""
    order = np.argsort(stated)
    total = 0.0
    for part in np.array_split(order, bins):
        if len(part):
            gap = abs(np.mean([stated[k] for k in part]) - np.mean([right[k] for k in part]))
            total += float(gap) * len(part) / len(order)
    return total


def table(heading: str, figures: typing.Sequence[Figure]) -> str:
    """Figures of no case stand there only where they have a bar."""
    figures = [figure for figure in figures if figure.cases > 0 or figure.bar is not None]
    lines = [heading, "", "| figure | measured (95 % interval) | pass | of | |", "|---|---|---|---|---|"]
    return "\n".join([*lines, *(figure.row() for figure in figures)]) + "\n"
