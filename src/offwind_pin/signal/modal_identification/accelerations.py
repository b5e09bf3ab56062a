"""Measured accelerations from a CSV file."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import Lines, check_time_unit, parse_number, read_csv

Array = NDArray[np.float64]

STANDARD_GRAVITY = 9.80665
"""m/s2; the value that defines one g (CGPM, 1901)."""

_FEWEST_ROWS = 64
_COARSEST = 2.0
"""s; modes of a support structure need shorter steps, so that longer ones are more likely ms."""
_UNEVEN = 0.01
"""Deviation of a step from the mean one, over it; more jitter distorts a spectrum."""
_G_IN_NAME = re.compile(r"[\s_(\[]m?g[\])]?$", re.IGNORECASE)
_LOOKS_LIKE_GRAVITY = (0.97, 1.03)


@dataclass(frozen=True, eq=False)
class Accelerations:
    """Accelerations at equal intervals.

    Attributes
    ----------
    time : (n,) array, s
    names : tuple of str
        Tuple of str Names of the c channels.
    values : (n, c) array, m/s2
    """

    time: Array
    names: tuple[str, ...]
    values: Array

    __repr__ = one_line

    @property
    def sample_rate(self) -> float:
        """Samples per second, in Hz."""
        return float((len(self.time) - 1) / (self.time[-1] - self.time[0]))

    def select(self, names: Sequence[str]) -> Accelerations:
        """Channels by name, in the order given, such as those of one direction.

        Parameters
        ----------
        names : sequence of str
            Names of channels.

        Returns
        -------
        Accelerations

        Raises
        ------
        InputError
            A name that no channel has.
        """
        missing = [name for name in names if name not in self.names]
        if missing or not names:
            allowed = ", ".join(self.names)
            raise InputError("names", ", ".join(missing) or "none", allowed, "Choose among them.")
        columns = [self.names.index(name) for name in names]
        return Accelerations(self.time, tuple(names), self.values[:, columns])


def read_accelerations(path: Path | str, factor: float | None = None) -> Accelerations:
    """Read accelerations from a CSV file: a header, the time in s first, one column per channel.

    Lines that start with ``#`` are comments.

    Parameters
    ----------
    path : Path or str
    factor : float, optional
        Turns the file's unit into m/s2, such as 9.80665 for g; 1 states that it is m/s2. Without
        it, channels that look like g are refused.

    Returns
    -------
    Accelerations

    Raises
    ------
    InputError
        No such file, no header, duplicate names, a cell that is not a finite number, times that do
        not rise evenly or are not in s, missing rows, fewer than 64 rows, a channel that does not
        move, or one that seems to be in g.
    """
    path = Path(path)
    if factor is not None and not (np.isfinite(factor) and factor > 0):
        raise InputError("factor", factor, "a positive number", "Give 9.80665 for g.")
    table = read_csv(path, _names)
    if len(table.values) < _FEWEST_ROWS:
        allowed = f"a header and {_FEWEST_ROWS} rows or more"
        received = f"{len(table.values)} rows" if table.names else "no rows"
        raise InputError(str(path), received, allowed, "Is the file complete?")
    time, values = table.values[:, 0], table.values[:, 1:]
    _check_times(path, time, table.lines)
    check_time_unit(path, table.remarks, time, _COARSEST)
    for i, name in enumerate(table.names[1:]):
        if np.ptp(values[:, i]) == 0:
            raise InputError(
                f"{path}, channel {name}",
                f"{values[0, i]:g} at all times",
                "channels that vary",
                "Is the sensor dead? Delete the column.",
            )
        if factor is None:
            _check_unit(path, name, values[:, i])
    return Accelerations(time, table.names[1:], values * (factor or 1.0))


def _names(header: list[str], where: str) -> tuple[str, ...]:
    """Names of the columns, checked."""
    if len(header) < 2:
        raise InputError(
            where, ",".join(header), "time and one channel or more, with commas", "Complete it."
        )
    numbers = [cell for cell in header if parse_number(cell) is not None]
    if numbers or "" in header:
        allowed = "a header that names time and channels"
        raise InputError(where, ",".join(header), allowed, "Add names above the numbers.")
    twice = sorted({name for name in header if header.count(name) > 1})
    if twice:
        raise InputError(
            where, f"{', '.join(twice)} more than once", "unique names", "Rename them."
        )
    return tuple(header)


def _check_times(path: Path, time: Array, lines: Lines) -> None:
    """Check for even steps; the error names the line, and whether it is a gap."""
    steps = np.diff(time)
    step = float(np.median(steps))
    falls = np.flatnonzero(steps <= 0)
    if len(falls):
        at = falls[0] + 1
        raise InputError(
            f"{path}, line {lines[at]}",
            f"time {time[at]:g} s after {time[at - 1]:g} s",
            "increasing times",
            "Is the time the first column, and is the file complete?",
        )
    gaps = np.flatnonzero(steps > 1.5 * step)
    if len(gaps):
        at = gaps[0] + 1
        raise InputError(
            f"{path}, line {lines[at]}",
            f"a step of {steps[at - 1]:g} s among steps of {step:g} s",
            "a record without gaps",
            "Split the file there and use the longer part.",
        )
    uneven = np.flatnonzero(np.abs(steps - step) > _UNEVEN * step)
    if len(uneven):
        at = uneven[0] + 1
        raise InputError(
            f"{path}, line {lines[at]}",
            f"a step of {steps[at - 1]:.6g} s among steps of {step:.6g} s",
            f"steps equal to within {100 * _UNEVEN:g} %",
            "Give the time with more digits, or resample the record.",
        )


def _check_unit(path: Path, name: str, values: Array) -> None:
    mean = abs(float(np.mean(values)))
    low, high = _LOOKS_LIKE_GRAVITY
    said = _G_IN_NAME.search(name) is not None
    # An upright sensor measures gravity: 1 in g, 9.81 in m/s2.
    if not said and not (low < mean < high and np.std(values) < 0.3 * mean):
        return
    found = "a name that says g" if said else f"a mean of {mean:.4g}, close to gravity in g"
    raise InputError(
        f"{path}, channel {name}",
        found,
        "accelerations in m/s2",
        f"Pass factor={STANDARD_GRAVITY} for g (a thousandth of it for mg), or factor=1 for m/s2.",
    )
