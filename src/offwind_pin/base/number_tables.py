"""Text files of numbers; errors name the line.

A file is read in pieces. Each goes to NumPy's parser first; what that does not read, or reads
differently from the rules below, is read again line by line, which is slower and locates the fault.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import check_file

Array = NDArray[np.float64]
Lines = NDArray[np.int64]

_GAP = 5.0
"""Multiple of the median step beyond which rows are missing."""
_SAMPLED = 20
"""Number of steps from which a file counts as sampled rather than as a hand-written table."""
_LONGEST_SPAN = 1e5
"""s; as long as the longest simulation of a case."""
_PIECE = 4_000_000
"""Number of characters read at once."""
_LONGEST_LINE = 1_000_000

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]+)?")
_NUMERALS = b"0123456789+-.eE,; \t\n"
CLOSING_LINE = r"^[ \t]*This output file was closed on[^\n]*"
"""The line with which HydroDyn, SubDyn and other modules of OpenFAST end a text file."""
_REMARK = re.compile(rf"[#!%][^\n]*|{CLOSING_LINE}", re.MULTILINE)
_LINE = re.compile(r"^.*\S.*$", re.MULTILINE)
_CSV_REMARK = re.compile(r"^[ \t]*#[^\n]*", re.MULTILINE)
_TIME_UNIT = re.compile(
    r"(?<![a-z])(?:t|time)(?:_| *[\[(/] *| +in +)"
    r"(seconds?|secs?|s|msecs?|ms|milliseconds?|us|microseconds?|minutes?|mins?|hours?|h)(?![a-z])",
    re.IGNORECASE,
)

DECIMAL_COMMAS = "Are these decimal commas? Write decimal points."


def parse_number(text: str) -> float | None:
    """A finite decimal number written in ASCII, else None.

    ``float`` alone would take ``4_0`` and the digits of other scripts too.
    """
    if _NUMBER.fullmatch(text) is None:
        return None
    value = float(text)
    return value if math.isfinite(value) else None


@dataclass(frozen=True, eq=False)
class NumberTable:
    """Rows of numbers.

    Attributes
    ----------
    path : Path
    names : tuple of str
        Cells of the header; none without a header.
    values : (n, c) array
    lines : (n,) int array
        Line of each row.
    remarks : str
        Header and comments up to the first rows.
    """

    path: Path
    names: tuple[str, ...]
    values: Array
    lines: Lines
    remarks: str


def read_numbers(path: Path, columns: tuple[str, ...]) -> NumberTable:
    """A CSV file with a header of these names; lines that start with ``#`` are comments.

    Raises
    ------
    InputError
        Missing or empty file, wrong header, a cell that is not a finite number.
    """

    def head(cells: list[str], where: str) -> tuple[str, ...]:
        if tuple(cells) != columns:
            allowed = f"the header {','.join(columns)}"
            raise InputError(where, ",".join(cells), allowed, "Correct the header.")
        return columns

    table = read_csv(path, head)
    if not len(table.values):
        raise InputError(
            str(path), "no rows of numbers", "a header and one row or more", "Is the file complete?"
        )
    return table


def read_csv(path: Path, head: Callable[[list[str], str], tuple[str, ...]]) -> NumberTable:
    """A CSV file with a header; lines that start with ``#`` are comments.

    Parameters
    ----------
    head : callable
        Function from the cells of the header and its location to the names of the columns.

    Raises
    ------
    InputError
        A missing file, a cell that is not a finite number, or an error of ``head``.
    """

    def first(line: str, where: str) -> tuple[str, ...]:
        return head([cell.strip() for cell in next(csv.reader([line]))], where)

    return _read(path, _CSV_REMARK, first, None, ",")


def read_time_columns(
    path: Path,
    count: int,
    *,
    coarsest: float,
    sampled: int = _SAMPLED,
    fewest: int = 2,
    header: bool = False,
) -> NumberTable:
    """Columns of numbers over time in s, the time first.

    Columns are separated by blanks or tabs, by commas, or by semicolons; ``#``, ``!`` and ``%``
    start a comment. A comment or header that names another unit of time (``time [ms]``) is
    rejected, as are times that look like ms, unless a comment or header names s (``time [s]``).

    Parameters
    ----------
    count : int
        Number of columns, the time included.
    coarsest : float, s
        Step above which times look like ms.
    sampled : int
        Number of rows from which the steps are checked.
    fewest : int
        Minimum number of rows.
    header : bool
        Whether the first line may name the columns.

    Raises
    ------
    InputError
        A missing, empty or short file; a cell that is not a finite number; decimal commas; times
        that do not rise, that leave a gap, or that are not in s.
    """

    def first(line: str, where: str) -> tuple[str, ...]:
        cells = re.split(r"\s*[,;]\s*|\s+", line)
        named = header and not any(parse_number(cell) is not None for cell in cells)
        return tuple(cells) if named else ()

    table = _read(path, _REMARK, first, count, None)
    if len(table.values) < fewest:
        received = f"{len(table.values)} rows"
        raise InputError(str(path), received, f"{fewest} rows or more", "Is the file complete?")
    time = table.values[:, 0]
    check_times(path, time, table.lines, "line")
    check_time_unit(path, table.remarks, time, coarsest, sampled)
    return table


def check_times(path: Path, time: Array, place: Lines, counted: str) -> None:
    """Reject times (t,) that do not rise, or that leave a gap in evenly sampled ones.

    Parameters
    ----------
    place : (t,) int array
        Location of each time in the file, in units of ``counted``.

    Raises
    ------
    InputError
        Naming the location of the first fault.
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
    if len(step) < _SAMPLED:
        return
    usual = float(np.median(step))
    gaps = np.flatnonzero(step > _GAP * usual)
    if len(gaps):
        i = int(gaps[0])
        raise InputError(
            f"{path}, {counted}s {place[i]} to {place[i + 1]}, column t",
            f"a step of {step[i]:g} s ({len(gaps)} such steps)",
            f"steps of about {usual:g} s, as in the rest of the file",
            "Are rows missing? Fill the gap, or shorten the file.",
        )


def check_time_unit(
    path: Path, remarks: str, time: Array, coarsest: float, sampled: int = _SAMPLED
) -> None:
    """Reject times (t,) in another unit than s, by name or by size.

    Parameters
    ----------
    remarks : str
        Header and comments, where a unit may be named.
    coarsest : float, s
    sampled : int
        See :func:`read_time_columns`.

    Raises
    ------
    InputError
        Naming the unit or the step.
    """
    named = _TIME_UNIT.search(remarks)
    if named is not None:
        if named[1].lower().rstrip("s") not in ("", "sec", "second"):
            raise InputError(f"{path}, time", named[0], "time in s", "Convert the times to s.")
        return
    if len(time) <= sampled:
        return
    step, span = float(np.median(np.diff(time))), float(time[-1] - time[0])
    if step > coarsest or span > _LONGEST_SPAN:
        raise InputError(
            f"{path}, time",
            f"{len(time)} rows {step:g} s apart, {span:g} s in all",
            f"steps up to {coarsest:g} s and {_LONGEST_SPAN:g} s in all",
            "Are the times in ms? Convert them to s; if they are in s, write the comment "
            "'# time [s]' above them.",
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
        value = parse_number(cell)
        if value is None:
            remedy = DECIMAL_COMMAS if _DECIMAL_COMMA.fullmatch(cell) else "Correct the cell."
            raise InputError(f"{where}, column {column}", cell, "a finite number", remedy)
        values.append(value)
    return tuple(values)


def pieces(path: Path) -> Iterator[str]:
    """Text of a file in pieces of whole lines, one character per byte, with line feeds.

    Raises
    ------
    InputError
        An unreadable file, or one that is not text.
    """
    check_file(path)
    rest = ""
    try:
        with path.open(encoding="latin-1", newline=None) as file:
            first = file.read(_PIECE).removeprefix("\xef\xbb\xbf")  # the byte-order mark
            for piece in chain([first], iter(lambda: file.read(_PIECE), "")):
                piece = rest + piece
                end = piece.rfind("\n") + 1
                rest = piece[end:]
                if "\0" in piece or len(rest) > _LONGEST_LINE:
                    allowed = f"text in lines of up to {_LONGEST_LINE} characters"
                    raise InputError(
                        str(path), "bytes that are not text", allowed, "Check the file."
                    )
                if end:
                    yield piece[:end]
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(str(path), reason, "a readable file", "Check the file.") from None
    if rest:
        yield rest


def without_remarks(text: str, remark: re.Pattern[str]) -> str:
    """A piece of text with matches of a pattern removed; line numbers do not change."""
    marked = any(mark in text for mark in ("#", "!", "%", "This output file"))
    return remark.sub("", text) if marked else text


class RowReader:
    """Rows of numbers from pieces of text, each with its line.

    Parameters
    ----------
    count : int
        Number of columns.
    separator : str or None
        Comma or blank; None for the separator of each line: blanks, commas or semicolons.
    spoilt : callable, optional
        Function from a cell that is not a number to a number; by default such a cell is an error.
    """

    def __init__(
        self,
        path: Path,
        count: int,
        separator: str | None,
        spoilt: Callable[[str], float] | None = None,
    ) -> None:
        self.path = path
        self.count = count
        self.separator = separator
        self.spoilt = spoilt
        self.lines: list[Lines] = []
        self.values = np.empty((0, count))

    def add(self, text: str, line: int) -> None:
        """Rows of a piece whose first line has this number.

        Raises
        ------
        InputError
            An invalid line.
        """
        rows = self._at_once(text)
        if rows is None:
            filled = [(i, one) for i, one in enumerate(text.split("\n"), line) if one.strip()]
            rows = np.array([self._one(i, one) for i, one in filled]).reshape(-1, self.count)
            lines = np.array([i for i, _ in filled], dtype=np.int64)
        elif len(rows) == text.count("\n") + (not text.endswith("\n")):
            lines = np.arange(line, line + len(rows))
        else:
            lines = np.array([i for i, t in enumerate(text.split("\n"), line) if t.strip()])
        before = len(self.values)
        self.values.resize((before + len(rows), self.count), refcheck=False)  # grows in place
        self.values[before:] = rows
        self.lines.append(lines)

    def _at_once(self, text: str) -> Array | None:
        """Rows (n, c) by NumPy's parser; None unless they certainly follow the rules."""
        begin = text[: text.find("\n", len(text) - len(text.lstrip()))]
        delimiter = self.separator or next((mark for mark in ",;" if mark in begin), " ")
        try:
            encoded = text.encode("ascii")
        except UnicodeEncodeError:
            return None
        if not begin.strip() or encoded.translate(None, _NUMERALS):
            return None
        try:
            rows = np.loadtxt(
                io.BytesIO(encoded), delimiter=delimiter.strip() or None, ndmin=2, comments=None
            )
        except ValueError:
            return None
        return rows if rows.shape[1] == self.count and np.all(np.isfinite(rows)) else None

    def _one(self, line: int, text: str) -> tuple[float, ...]:
        cells = self._cells(line, text)
        if self.spoilt is None or len(cells) != self.count:
            return to_numbers(self.path, line, cells, self.count)
        read = (parse_number(cell) for cell in cells)
        return tuple(
            self.spoilt(cell) if value is None else value
            for cell, value in zip(cells, read, strict=True)
        )

    def _cells(self, line: int, text: str) -> list[str]:
        where = f"{self.path}, line {line}"
        separators = [mark for mark in ",;" if mark in text]
        if self.separator == " " or (self.separator is None and not separators):
            return text.split()
        if self.separator == ",":
            cells = [cell.strip() for cell in next(csv.reader([text]))]
        else:
            cells = [cell.strip() for cell in text.split(separators[0])]
        if "," in separators and len(cells) > self.count:
            received, allowed = f"{len(cells)} cells between commas", f"{self.count}"
            raise InputError(where, received, allowed, DECIMAL_COMMAS)
        if self.separator is None and (
            len(separators) > 1 or any(len(cell.split()) > 1 for cell in cells)
        ):
            raise InputError(
                where,
                text.strip(),
                "cells separated by blanks, by commas or by semicolons, not by a mixture",
                DECIMAL_COMMAS,
            )
        return cells


def _read(
    path: Path,
    remark: re.Pattern[str],
    first: Callable[[str, str], tuple[str, ...]],
    count: int | None,
    separator: str | None,
) -> NumberTable:
    """Rows of a file.

    Parameters
    ----------
    remark : Pattern
        Pattern of comments.
    first : callable
        Function from the first line without comments and its location to the names of the columns;
        none if that line is a row.
    count : int or None
        Number of columns; None for the number of names.
    """
    names: tuple[str, ...] = ()
    reader: RowReader | None = None
    remarks: list[str] = []
    line = 1
    for piece in pieces(path):
        data = without_remarks(piece, remark)
        begin = _LINE.search(data) if reader is None else None
        if reader is None:
            remarks += remark.findall(piece)
        if begin is not None:
            where = f"{path}, line {line + data.count(chr(10), 0, begin.start())}"
            head = begin[0].encode("latin-1").decode("utf-8", "replace").strip()
            names = first(head, where)
            if names:
                remarks.append(head)
                data = data[: begin.start()] + data[begin.end() :]
            reader = RowReader(path, count or len(names), separator)
        if reader is not None:
            reader.add(data, line)
        line += piece.count("\n")
    if reader is None:
        return NumberTable(path, (), np.empty((0, count or 0)), np.empty(0, np.int64), "")
    return NumberTable(path, names, reader.values, np.concatenate(reader.lines), "\n".join(remarks))
