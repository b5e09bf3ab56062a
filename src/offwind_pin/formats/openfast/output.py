"""Output of OpenFAST, as text (.out) or binary (.outb): channels by name, in SI."""

from __future__ import annotations

import difflib
import hashlib
import struct
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import to_numbers
from offwind_pin.formats.openfast.units import TIME, si_factor

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


@dataclass(frozen=True, eq=False)
class OpenFastOutput:
    """Channels of an output file.

    Attributes
    ----------
    path : Path
        Of the file.
    digest : str
        SHA-256 of its content.
    time : (t,) array, s
    name, unit : list of str
        c of each, as in the file, without time.
    data : (t, c) array
        In the file's units.
    place : list of int
        Location of each time in the file: its line, or its number from 1.
    counted : str
        ``line`` or ``time step``.
    """

    path: Path
    digest: str
    time: Array
    name: list[str]
    unit: list[str]
    data: Array = field(repr=False)
    place: list[int] = field(repr=False)
    counted: str

    def channel(self, name: str, kind: str) -> Array:
        """(t,) a channel in SI; kind : see :func:`si_factor`.

        Raises
        ------
        InputError
            No channel of that name, or one of another kind.
        """
        by_name = {known.lower(): i for i, known in enumerate(self.name)}
        index = by_name.get(name.lower())
        if index is None:
            near = difflib.get_close_matches(name, self.name, n=3)
            likely = f"Is it {' or '.join(near)}?" if near else "Ask OpenFAST for it (OutList)."
            raise InputError(
                f"{self.path}, channel", name, f"one of its {len(self.name)} channels", likely
            )
        where = f"{self.path}, channel {self.name[index]}"
        values = self.data[:, index] * si_factor(where, self.unit[index], kind)
        bad = np.flatnonzero(~np.isfinite(values))
        if len(bad):
            at = f"{where}, {self.counted} {self.place[bad[0]]}"
            raise InputError(at, float(values[bad[0]]), "a finite number", "Did the run diverge?")
        return values


def read_openfast_output(path: Path) -> OpenFastOutput:
    """Read an OpenFAST output file; ``.outb`` is binary, anything else text.

    Raises
    ------
    InputError
        A file that is missing, truncated, or of another format; the message tells where.
    """
    path = Path(path)
    return _read_binary(path) if path.suffix.lower() == ".outb" else _read_text(path)


def _read_text(path: Path) -> OpenFastOutput:
    content = _read_bytes(path)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:  # older versions write the dot of kN.m in Latin-1
        text = content.decode("latin-1")
    lines = text.splitlines()
    head = next((i for i, row in enumerate(lines[:_HEADER_LINES]) if _begins_table(row)), None)
    if head is None or head + 1 >= len(lines):
        raise InputError(
            str(path),
            f"no line that starts with Time and a line of units after it (of {len(lines)} lines)",
            "names of channels, their units, and rows of numbers",
            "Is it OpenFAST's .out file, and complete?",
        )
    names, units = lines[head].split(), lines[head + 1].split()
    if len(units) != len(names):
        raise InputError(
            f"{path}, line {head + 2}",
            f"{len(units)} units",
            f"{len(names)}, one for each channel",
            "Units such as (kN-m) hold no blanks.",
        )
    rows, place = [], []
    for line, raw in enumerate(lines[head + 2 :], head + 3):
        if raw.strip():
            rows.append(to_numbers(path, line, raw.split(), len(names)))
            place.append(line)
    if not text.endswith("\n") and len(lines[-1]) < len(lines[-2]):
        raise InputError(
            f"{path}, line {len(lines)}",
            lines[-1].strip(),
            "a row as long as the one before, and an end of line",
            "The file is truncated; was the run killed? Run it again, or delete the last line.",
        )
    if len(rows) < 2:
        raise InputError(
            str(path), f"{len(rows)} rows", "two rows or more", "Is the file complete?"
        )
    values = np.array(rows)
    time = values[:, 0] * si_factor(f"{path}, channel Time", units[0], TIME)
    digest = hashlib.sha256(content).hexdigest()
    return OpenFastOutput(path, digest, time, names[1:], units[1:], values[:, 1:], place, "line")


def _read_bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(str(path), "no such file", "an existing file", "Check the path.") from None
    except OSError as error:
        raise InputError(str(path), str(error), "a readable file", "Check it.") from None


def _begins_table(row: str) -> bool:
    cells = row.split()
    return len(cells) > 1 and cells[0].lower() == "time"


class _Bytes:
    """Content of a file, read in sequence; an error for missing bytes names what was being read."""

    def __init__(self, path: Path, content: bytes) -> None:
        self.path = path
        self.content = content
        self.at = 0

    def take(self, count: int, what: str) -> bytes:
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

    def array(self, kind: str, count: int, what: str) -> Array:
        width = np.dtype(kind).itemsize
        return np.frombuffer(self.take(width * count, what), dtype=kind).astype(float)

    def texts(self, count: int, length: int, what: str) -> list[str]:
        whole = self.take(count * length, what).decode("latin-1")
        found = [whole[i * length : (i + 1) * length].strip(" \0") for i in range(count)]
        for text in found:
            if not text.isprintable():
                raise self.wrong(what, text, "printable text")
        return found

    def wrong(self, what: str, received: object, allowed: str) -> InputError:
        where = f"{self.path}, before byte {self.at}, {what}"
        return InputError(where, received, allowed, "Is it OpenFAST's binary output?")


def _read_binary(path: Path) -> OpenFastOutput:
    content = _read_bytes(path)
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
        slope = data.array("<f4", channels, "slopes of the channels")
        offset = data.array("<f4", channels, "offsets of the channels")
        if not np.all(np.isfinite(slope) & np.isfinite(offset) & (slope != 0)):
            received = "NaN, infinity or a slope of 0"
            raise data.wrong("slopes and offsets of the channels", received, "finite numbers")
    described = data.count("i", "length of the description", 0, _LONGEST_DESCRIPTION)
    data.take(described, "description")
    names = data.texts(channels + 1, length, "names of the channels")
    units = data.texts(channels + 1, length, "units of the channels")
    ticks: Array | None = None
    if kind == WITH_TIME:
        if first == 0:
            raise data.wrong("slope of the time", first, "a number that is not zero")
        ticks = (data.array("<i4", steps, "times") - second) / first
    elif second <= 0:
        raise data.wrong("step of the time", second, "a positive number of s")
    width = "<f8" if kind == NO_COMPRESSION else "<i2"
    packed = data.array(width, steps * channels, "values").reshape(steps, channels)
    if data.at != len(content):
        raise data.wrong("end", f"{len(content) - data.at} bytes more", "the end of the file")
    # Made only now that the file is known to hold as many steps as it promises.
    time = first + second * np.arange(0.0, steps) if ticks is None else ticks
    time = time * si_factor(f"{path}, channel {names[0]}", units[0], TIME)
    return OpenFastOutput(
        path,
        hashlib.sha256(content).hexdigest(),
        time,
        names[1:],
        units[1:],
        (packed - offset) / slope,
        list(range(1, steps + 1)),
        "time step",
    )
