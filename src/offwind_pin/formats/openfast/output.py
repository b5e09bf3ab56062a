"""Output of OpenFAST, as text (.out) or binary (.outb): channels by name, in SI."""

from __future__ import annotations

import difflib
import hashlib
import logging
import re
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array, file_digest
from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import read_bytes
from offwind_pin.base.number_tables import CLOSING_LINE, Lines, RowReader, pieces, without_remarks
from offwind_pin.formats.openfast.units import TIME, si_factor

_log = logging.getLogger(__name__)

SUFFIXES = {".out", ".outb"}

WITH_TIME, WITHOUT_TIME, NO_COMPRESSION, OWN_NAME_LENGTH = 1, 2, 3, 4
"""FileID of the binary formats: integers with packed times; integers with a constant step; float64
with a constant step; as the second, with the length of names in the file."""

_NAME_LENGTH = 10
_LONGEST_NAME = 256
_MOST_CHANNELS = 100_000
_MOST_STEPS = 1_000_000_000
_LONGEST_DESCRIPTION = 1_000_000
_HEADER_LINES = 100
"""Lines of a text file in which the names of the channels must come."""
_CLOSING = re.compile(CLOSING_LINE, re.MULTILINE)
_FORTRAN = re.compile(r"([+-]?[0-9]*\.[0-9]+)([+-][0-9]{3})")


@dataclass(frozen=True, eq=False)
class OpenFastOutput:
    """Channels of an output file. What is wrong with one matters only where it is asked for.

    Attributes
    ----------
    path : Path
        Of the file.
    digest : str
        SHA-256 of its content.
    time : (t,) array, s
    name, unit : list of str
        List of str Names and units of the c channels as in the file, time excluded.
    packed : (t, c) array
        As in the file.
    slope, offset : (c,) array
        Of the packing: value = (packed - offset) / slope.
    place : (t,) int array
        Where each time stands in the file: its line, or its number from 1.
    counted : str
        Str ``line`` or ``time step``.
    """

    path: Path
    digest: str
    time: Array
    name: list[str]
    unit: list[str]
    packed: NDArray[Any] = field(repr=False)
    slope: Array = field(repr=False)
    offset: Array = field(repr=False)
    place: Lines = field(repr=False)
    counted: str

    def channel(self, name: str, kind: str) -> Array:
        """(t,) values of a channel in SI; for ``kind`` see :func:`si_factor`.

        Raises
        ------
        InputError
            No channel of that name, several, or one that cannot be used.
        """
        found = [i for i, known in enumerate(self.name) if known.lower() == name.lower()]
        if not found:
            near = difflib.get_close_matches(name, self.name, n=3)
            likely = f"Is it {' or '.join(near)}?" if near else "Ask OpenFAST for it (OutList)."
            raise InputError(
                f"{self.path}, channel", name, f"one of its {len(self.name)} channels", likely
            )
        index = found[0]
        where = f"{self.path}, channel {self.name[index]}"
        if len(found) > 1:
            columns = ", ".join(str(i + 2) for i in found)
            remedy = "Rename or remove all but one of them."
            raise InputError(where, f"{len(found)} of that name, columns {columns}", "one", remedy)
        slope, offset = float(self.slope[index]), float(self.offset[index])
        if not (np.isfinite(slope) and np.isfinite(offset) and slope != 0):
            received = f"a slope of {slope} and an offset of {offset}"
            raise InputError(
                where, received, "finite ones, the slope not 0", "Did the run diverge?"
            )
        factor = si_factor(where, self.unit[index], kind)
        values: Array = (self.packed[:, index] - offset) / slope * factor
        bad = np.flatnonzero(~np.isfinite(values))
        if len(bad):
            at = f"{where}, {self.counted} {self.place[bad[0]]}"
            raise InputError(
                at,
                f"{float(values[bad[0]])} ({len(bad)} such)",
                "a finite number",
                "Did the run diverge, or is the number too long for its column?",
            )
        return values


def read_openfast_output(path: Path) -> OpenFastOutput:
    """Read an OpenFAST output file; ``.outb`` is binary, anything else text.

    Raises
    ------
    InputError
        A file that is missing, truncated, or of another format; the message says where.
    """
    path = Path(path)
    return _read_binary(path) if path.suffix.lower() == ".outb" else _read_text(path)


def _read_text(path: Path) -> OpenFastOutput:
    reader: RowReader | None = None
    names: list[str] = []
    units: list[str] = []
    last: list[str] = []
    line, ends = 1, True
    for piece in pieces(path):
        text = without_remarks(piece, _CLOSING)
        if reader is None:
            lines = text.split("\n")
            head = next(
                (i for i, row in enumerate(lines[:_HEADER_LINES]) if _begins_table(row)), None
            )
            if head is None or head + 1 >= len(lines):
                break
            names, units = (_decoded(row).split() for row in lines[head : head + 2])
            if len(units) != len(names):
                raise InputError(
                    f"{path}, line {head + 2}",
                    f"{len(units)} units",
                    f"{len(names)}, one for each channel",
                    "Units such as (kN-m) must not contain spaces.",
                )
            reader = RowReader(path, len(names), " ", _spoilt)
            text = "\n" * (head + 2) + "\n".join(lines[head + 2 :])
        reader.add(text, line)
        line += piece.count("\n")
        ends = text.endswith("\n")
        last = [*last, *text.splitlines()[-2:]][-2:]
    if reader is None:
        raise InputError(
            str(path),
            f"no line that starts with Time and a line of units after it, in {_HEADER_LINES} lines",
            "names of channels, their units, and rows of numbers",
            "Is it OpenFAST's .out file, and complete?",
        )
    if not ends and len(last[-1]) < len(last[0]):
        raise InputError(
            f"{path}, line {line}",
            last[-1].strip(),
            "a row as long as the previous one, ending with a newline",
            "The file is truncated; was the run killed? Run it again, or delete the last line.",
        )
    values, place = reader.values, np.concatenate(reader.lines)
    if len(values) < 2:
        received = f"{len(values)} rows"
        raise InputError(str(path), received, "two rows or more", "Is the file complete?")
    bad = np.flatnonzero(~np.isfinite(values[:, 0]))
    if len(bad):
        where = f"{path}, line {place[bad[0]]}, column 1"
        raise InputError(where, float(values[bad[0], 0]), "a time", "Is the line complete?")
    return OpenFastOutput(
        path,
        file_digest(path),
        values[:, 0] * si_factor(f"{path}, channel Time", units[0], TIME),
        names[1:],
        units[1:],
        values[:, 1:],
        np.ones(len(names) - 1),
        np.zeros(len(names) - 1),
        place,
        "line",
    )


def _decoded(row: str) -> str:
    """A line as UTF-8; older versions write the dot of kN.m in Latin-1."""
    try:
        return row.encode("latin-1").decode("utf-8")
    except UnicodeDecodeError:
        return row


def _spoilt(cell: str) -> float:
    """NaN; or a number whose exponent of three digits left no room for its letter, as 1.5-101."""
    return float(_FORTRAN.sub(r"\1E\2", cell)) if _FORTRAN.fullmatch(cell) else np.nan


def _begins_table(row: str) -> bool:
    cells = row.split()
    return len(cells) > 1 and cells[0].lower() == "time"


class _Bytes:
    """Content of a file, read sequentially; an error for missing bytes names what was being
    read."""

    def __init__(self, path: Path, content: bytes) -> None:
        self.path = path
        self.content = memoryview(content)
        self.at = 0

    def take(self, count: int, what: str) -> memoryview:
        rest = len(self.content) - self.at
        if count > rest:
            raise InputError(
                f"{self.path}, byte {self.at}, {what}",
                f"{rest} bytes",
                f"{count} bytes",
                "The file is truncated; was the run killed? Run it again.",
            )
        self.at += count
        return self.content[self.at - count : self.at]

    def number(self, kind: str, what: str) -> float:
        value = struct.unpack(f"<{kind}", self.take(struct.calcsize(f"<{kind}"), what))[0]
        if not np.isfinite(value):
            raise self.wrong(what, value, "a finite number")
        return float(value)

    def count(self, kind: str, what: str, lowest: int, highest: int) -> int:
        value = int(self.number(kind, what))
        if not lowest <= value <= highest:
            raise self.wrong(what, value, f"{lowest} to {highest}")
        return value

    def array(self, kind: str, count: int, what: str) -> NDArray[Any]:
        width = np.dtype(kind).itemsize
        return np.frombuffer(self.take(width * count, what), dtype=kind)

    def texts(self, count: int, length: int, what: str) -> list[str]:
        whole = bytes(self.take(count * length, what)).decode("latin-1")
        found = [whole[i * length : (i + 1) * length].strip(" \0") for i in range(count)]
        for text in found:
            if not text.isprintable():
                raise self.wrong(what, text, "printable text")
        return found

    def wrong(self, what: str, received: object, allowed: str) -> InputError:
        where = f"{self.path}, before byte {self.at}, {what}"
        return InputError(where, received, allowed, "Is it OpenFAST's binary output?")


def _read_binary(path: Path) -> OpenFastOutput:
    content = read_bytes(path)
    data = _Bytes(path, content)
    kind = data.count("h", "FileID", WITH_TIME, OWN_NAME_LENGTH)
    length = _NAME_LENGTH
    if kind == OWN_NAME_LENGTH:
        length = data.count("h", "length of names", 1, _LONGEST_NAME)
    channels = data.count("i", "number of channels", 1, _MOST_CHANNELS)
    steps = data.count("i", "number of time steps", 2, _MOST_STEPS)
    first, second = data.number("d", "first number of the time"), data.number("d", "its second")
    slope, offset = np.ones(channels), np.zeros(channels)
    if kind != NO_COMPRESSION:
        slope = data.array("<f4", channels, "slopes of the channels").astype(float)
        offset = data.array("<f4", channels, "offsets of the channels").astype(float)
    described = data.count("i", "length of the description", 0, _LONGEST_DESCRIPTION)
    data.take(described, "description")
    names = data.texts(channels + 1, length, "names of the channels")
    units = data.texts(channels + 1, length, "units of the channels")
    ticks: Array | None = None
    if kind == WITH_TIME:
        if first == 0:
            raise data.wrong("slope of the time", first, "a nonzero number")
        ticks = (data.array("<i4", steps, "times").astype(float) - second) / first
    elif second <= 0:
        raise data.wrong("time step", second, "a positive number of seconds")
    width = "<f8" if kind == NO_COMPRESSION else "<i2"
    packed = data.array(width, steps * channels, "values").reshape(steps, channels)
    if data.at != len(content):
        _log.warning(
            "%s: %d bytes follow the last of its %d time steps and are left out; was a longer file "
            "written over?",
            path,
            len(content) - data.at,
            steps,
        )
    # Allocated only now that the file is known to contain all its steps.
    time = first + second * np.arange(0.0, steps) if ticks is None else ticks
    time = time * si_factor(f"{path}, channel {names[0]}", units[0], TIME)
    return OpenFastOutput(
        path,
        hashlib.sha256(content).hexdigest(),
        time,
        names[1:],
        units[1:],
        packed,
        slope,
        offset,
        np.arange(1, steps + 1),
        "time step",
    )
