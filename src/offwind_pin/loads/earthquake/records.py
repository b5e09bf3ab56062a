"""Accelerograms from files: columns of numbers, and PEER's AT2."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from offwind_pin.base.definition import Array, origin_of
from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import read_text
from offwind_pin.base.number_tables import parse_number, read_time_columns, to_numbers

Unit = Literal["m_per_s2", "cm_per_s2", "g"]
Axis = Literal["x", "y", "z"]

STANDARD_GRAVITY = 9.80665
"""m/s2; the g of accelerograms."""
UNITS: dict[str, float] = {"m_per_s2": 1.0, "cm_per_s2": 0.01, "g": STANDARD_GRAVITY}
"""By name, in m/s2."""
AXES = ("x", "y", "z")

STRONG, WEAK = 20.0, 0.5
"""m/s2; peaks above the first are less likely than a wrong unit, those below the second are
weak."""
_COARSEST = 0.5
"""s; no accelerogram is sampled as coarsely, so that longer steps are more likely ms."""


@dataclass(frozen=True, eq=False)
class Accelerogram:
    """Samples from files: time (n,) in s, acceleration (n, 3) in m/s2, and their origin."""

    time: Array
    acceleration: Array
    origin: str


def read_columns(path: Path, unit: Unit, components: Sequence[Axis]) -> Accelerogram:
    """Columns of time in s and of one to three accelerations.

    For their separators see :func:`read_time_columns`.

    Parameters
    ----------
    unit : {"m_per_s2", "cm_per_s2", "g"}
        Of the accelerations.
    components : sequence of {"x", "y", "z"}
        Axis of each column after the time.

    Raises
    ------
    InputError
        A missing, empty or truncated file; a cell that is not a number; times that do not rise,
        leave a gap, or are not in s; an axis named twice.
    """
    check_components(components)
    values = read_time_columns(path, 1 + len(components), coarsest=_COARSEST).values
    acceleration = np.zeros((len(values), 3))
    for column, axis in enumerate(components, 1):
        acceleration[:, AXES.index(axis)] = UNITS[unit] * values[:, column]
    return Accelerogram(values[:, 0], acceleration, origin_of(path))


def check_components(components: Sequence[str]) -> None:
    """Reject axes that are unknown, duplicate or missing.

    Raises
    ------
    InputError
        Naming the axes given.
    """
    unknown = set(components) - set(AXES)
    if unknown or not components or len(set(components)) < len(components):
        raise InputError(
            "components", list(components), "one to three of x, y, z, each once", "Correct them."
        )


_VALUE = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:E[+-]?[0-9]+)?"
_NAMED_COUNT = re.compile(r"\bNPTS\s*[=:]\s*([0-9]+)(?![0-9.])", re.IGNORECASE)
_NAMED_STEP = re.compile(rf"\bDT\s*[=:]\s*({_VALUE})\s*([a-z]*)", re.IGNORECASE)
_UNNAMED = re.compile(rf"^\s*([0-9]+)\s+({_VALUE})\s+NPTS\s*,\s*DT()", re.IGNORECASE)
"""The two header formats of PEER for number and interval of the samples."""
_HEADER_LINES = 10
_UNIT = re.compile(r"\bUNITS?\s*(?:\bOF\b|[:=])\s*([^\s,;]+)", re.IGNORECASE)
_AT2_UNITS = {
    "G": STANDARD_GRAVITY,
    "G'S": STANDARD_GRAVITY,
    "GS": STANDARD_GRAVITY,
    "M/S2": 1.0,
    "CM/S2": 0.01,
    "MM/S2": 0.001,
    "GAL": 0.01,
    "IN/S2": 0.0254,
    "FT/S2": 0.3048,
}
"""m/s2, by the spelling that :func:`_at2_unit` gives to CM/SEC/SEC, cm/s^2 and the like."""


def read_at2(path: Path) -> tuple[float, Array, str]:
    """Interval in s, acceleration (n,) in m/s2, and origin, of a file of the PEER database.

    A header names the unit and ends with number and interval of the samples (``NPTS= 4000, DT=
    .0050 SEC``, in capitals or not); then come the samples, several in a line. A closing line of
    text may follow them. That is the format as it is found in files and readers of it; PEER has not
    published a definition.

    Raises
    ------
    InputError
        No such header, no unit or an unknown one, a cell that is not a number, or a wrong count.
    """
    lines = read_text(path).splitlines()
    number, count, interval = _at2_header(path, lines)
    factor = _at2_unit(path, lines[:number])
    values: list[float] = []
    for position, line in enumerate(lines[number:], number + 1):
        cells = line.split()
        if len(values) >= count and cells and parse_number(cells[0]) is None:
            continue  # a closing line
        values += to_numbers(path, position, cells, len(cells))
    if len(values) != count or count < 2 or not 0 < interval < math.inf:
        raise InputError(
            f"{path}, line {number}",
            f"{len(values)} samples, {count} promised, {interval:g} s apart",
            "as many as promised, two or more, at a positive interval",
            "Is the file complete?",
        )
    return interval, factor * np.array(values), origin_of(path)


def _at2_header(path: Path, lines: list[str]) -> tuple[int, int, float]:
    """Number of the header's last line, number of samples, and their interval in s."""
    for number, line in enumerate(lines[:_HEADER_LINES], 1):
        named = _NAMED_COUNT.search(line), _NAMED_STEP.search(line)
        if named[0] and named[1]:
            count, (step, unit) = named[0][1], named[1].groups()
        elif unnamed := _UNNAMED.search(line):
            count, step, unit = unnamed.groups()
        else:
            continue
        if unit.upper() not in ("", "S", "SEC", "SECS", "SECONDS", "NPTS"):
            where = f"{path}, line {number}"
            raise InputError(where, f"DT in {unit}", "DT in SEC", "Convert the interval to s.")
        return number, int(count), float(step)
    raise InputError(
        str(path),
        "no line with NPTS and DT",
        f"one such as 'NPTS= 4000, DT= .0050 SEC' in the first {_HEADER_LINES} lines",
        "Is it an AT2 file? Use file for columns of numbers.",
    )


def _at2_unit(path: Path, header: list[str]) -> float:
    """What the samples are multiplied by to be in m/s2."""
    found = _UNIT.search(" ".join(header))
    spelled = "" if found is None else found[1].strip("().'").upper()
    plain = spelled.replace("SEC", "S").translate(str.maketrans("", "", "^* "))
    plain = plain.removesuffix("S") if plain == "GALS" else plain.replace("/S/S", "/S2")
    factor = _AT2_UNITS.get(plain)
    if factor is None:
        raise InputError(
            f"{path}, header",
            "no unit" if found is None else found[1],
            f"UNITS OF {', '.join(_AT2_UNITS)}",
            "Is it a velocity (VT2)? Name the unit in the header, or convert the samples to g.",
        )
    return factor


def read_at2_components(paths: Mapping[Axis, Path]) -> Accelerogram:
    """One AT2 file per axis; a shorter one is padded with zeros.

    Raises
    ------
    InputError
        As in :func:`read_at2`; different intervals.
    """
    check_components(list(paths))
    read = {axis: read_at2(path) for axis, path in paths.items()}
    steps = {axis: step for axis, (step, _, _) in read.items()}
    step = next(iter(steps.values()))
    if any(abs(other - step) > 1e-9 * step for other in steps.values()):
        raise InputError(
            "at2, DT", steps, "one interval for all components", "Resample one of the files."
        )
    count = max(len(values) for _, values, _ in read.values())
    acceleration = np.zeros((count, 3))
    for axis, (_, values, _) in read.items():
        acceleration[: len(values), AXES.index(axis)] = values
    origin = "; ".join(f"{axis}: {text}" for axis, (_, _, text) in read.items())
    return Accelerogram(step * np.arange(count, dtype=float), acceleration, origin)


def unit_cautions(acceleration: Array, unit: Unit) -> list[str]:
    """Cautions about a unit, given the resulting accelerations in m/s2."""
    peak = float(np.max(np.abs(acceleration)))
    number = f"{peak / UNITS[unit]:.3g}"
    if peak > STRONG:
        likely = "cm/s2" if unit == "m_per_s2" else "m/s2 or cm/s2"
        return [
            f"a peak of {number} in the unit {unit} is {peak:.3g} m/s2, more than almost any "
            f"recorded earthquake; are the numbers in {likely}?"
        ]
    if 0 < peak < WEAK:
        likely = "g" if unit == "m_per_s2" else "m/s2 or g"
        hint = "" if unit == "g" else f"; are the numbers in {likely}?"
        return [f"a peak of {number} in the unit {unit} is {peak:.3g} m/s2, a weak motion{hint}"]
    return []
