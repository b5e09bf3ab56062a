"""Text files of numbers; errors name the line."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.errors import InputError

_GAP = 5.0
"""Times the median step, beyond which rows are missing."""
_MANY = 20
"""Steps from which on a file is sampled, and not a table of corners written by hand."""


def read_text(path: Path) -> str:
    """A text file, with or without a byte-order mark.

    Raises
    ------
    InputError
        It is missing, cannot be read, or is not text.
    """
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError(str(path), "no such file", "an existing file", "Check the path.") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(str(path), str(error), "a readable UTF-8 text file", "Check it.") from None


def read_numbers(path: Path, columns: tuple[str, ...]) -> list[tuple[int, tuple[float, ...]]]:
    """Rows of numbers from a CSV file with a header, each with its line number.

    Lines that start with ``#`` are comments.

    Raises
    ------
    InputError
        Missing or empty file, wrong header, a cell that is not a finite number.
    """
    header_seen = False
    rows = []
    for line, raw in enumerate(read_text(path).splitlines(), 1):
        text = raw.strip()
        if not text or text.startswith("#"):
            continue
        cells = [cell.strip() for cell in next(csv.reader([text]))]
        if not header_seen:
            if tuple(cells) != columns:
                raise InputError(
                    f"{path}, line {line}",
                    ",".join(cells),
                    f"the header {','.join(columns)}",
                    "Name the columns so.",
                )
            header_seen = True
            continue
        rows.append((line, to_numbers(path, line, cells, len(columns))))
    if not rows:
        raise InputError(
            str(path), "no rows of numbers", "a header and one row or more", "Is the file complete?"
        )
    return rows


def read_time_columns(
    path: Path, count: int, *, fewest: int = 2, header: bool = False
) -> tuple[NDArray[np.float64], list[int], str]:
    """Columns of numbers over time, the time first.

    Columns are separated by blanks, tabs, commas or semicolons; ``#``, ``!`` and ``%`` start a
    comment.

    Parameters
    ----------
    count : int
        Number of columns, the time included.
    fewest : int
        Number of rows that the file must have.
    header : bool
        Whether the first line may name the columns.

    Returns
    -------
    (array, list of int, str)
        (n, count) numbers, the n line numbers, and the text of the file.

    Raises
    ------
    InputError
        A missing, empty or short file; a cell that is not a finite number; times that do not rise,
        or that leave a gap.
    """
    text = read_text(path)
    rows: list[tuple[float, ...]] = []
    lines: list[int] = []
    first = True
    for line, raw in enumerate(text.splitlines(), 1):
        data = re.split(r"[#!%]", raw, maxsplit=1)[0].strip()
        if not data:
            continue
        cells = re.split(r"\s*[,;]\s*|\s+", data)
        named = header and first and not any(_is_number(cell) for cell in cells)
        first = False
        if not named:
            rows.append(to_numbers(path, line, cells, count))
            lines.append(line)
    if len(rows) < fewest:
        allowed = f"{fewest} rows or more"
        raise InputError(str(path), f"{len(rows)} rows", allowed, "Is the file complete?")
    values = np.array(rows)
    check_times(path, values[:, 0], lines, "line")
    return values, lines, text


def check_times(path: Path, time: NDArray[np.float64], place: Sequence[int], counted: str) -> None:
    """Refuse times (t,) that do not rise, or that leave a gap in evenly sampled ones.

    Parameters
    ----------
    place : (t,) sequence of int
        Where they are in the file, in what ``counted`` names.

    Raises
    ------
    InputError
        With the place of the first fault.
    """
    step = np.diff(time)
    back = np.flatnonzero(~(step > 0))
    if len(back):
        i = int(back[0])
        raise InputError(
            f"{path}, {counted} {place[i + 1]}, column t",
            float(time[i + 1]),
            f"a time later than that of {counted} {place[i]} ({time[i]:g} s)",
            "Sort the rows by time and remove repeated ones.",
        )
    if len(step) < _MANY:
        return
    usual = float(np.median(step))
    gaps = np.flatnonzero(step > _GAP * usual)
    if len(gaps):
        i = int(gaps[0])
        raise InputError(
            f"{path}, {counted}s {place[i]} to {place[i + 1]}, column t",
            f"a step of {step[i]:g} s ({len(gaps)} such)",
            f"steps of about {usual:g} s, as elsewhere in the file",
            "Are rows missing? Fill the gap, or shorten the file.",
        )


def to_numbers(path: Path, line: int, cells: list[str], count: int) -> tuple[float, ...]:
    """Finite numbers from the cells of one line.

    Raises
    ------
    InputError
        A wrong number of cells, or a cell that is not a finite number.
    """
    where = f"{path}, line {line}"
    if len(cells) != count:
        raise InputError(where, f"{len(cells)} cells", f"{count} cells", "Is the line complete?")
    values = []
    for column, cell in enumerate(cells, 1):
        try:
            value = float(cell)
        except ValueError:
            value = float("nan")
        if not math.isfinite(value):
            raise InputError(
                f"{where}, column {column}", cell, "a finite number", "Correct the cell."
            )
        values.append(value)
    return tuple(values)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
