"""Accelerograms out of files: columns of numbers, and PEER's AT2."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import read_text, read_time_columns, to_numbers

Unit = Literal["m_per_s2", "cm_per_s2", "g"]
Axis = Literal["x", "y", "z"]

STANDARD_GRAVITY = 9.80665
"""m/s2; what accelerograms call g."""
UNITS: dict[str, float] = {"m_per_s2": 1.0, "cm_per_s2": 0.01, "g": STANDARD_GRAVITY}
"""By name, in m/s2."""
AXES = ("x", "y", "z")

STRONG, WEAK = 20.0, 0.5
"""m/s2; peaks beyond the first are rarer than a wrong unit; those below the second are weak."""


@dataclass(frozen=True, eq=False)
class Accelerogram:
    """Samples out of files: time (n,) in s, acceleration (n, 3) in m/s2, and their origin."""

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
        Axis of each column after the time's.

    Raises
    ------
    InputError
        A missing, empty or truncated file; a cell that is not a number; times that do not rise or
        leave a gap; an axis named twice.
    """
    check_components(components)
    values, _, text = read_time_columns(path, 1 + len(components))
    acceleration = np.zeros((len(values), 3))
    for column, axis in enumerate(components, 1):
        acceleration[:, AXES.index(axis)] = UNITS[unit] * values[:, column]
    return Accelerogram(values[:, 0], acceleration, _origin(path, text))


def check_components(components: Sequence[str]) -> None:
    """Refuse axes that are unknown, named twice, or none.

    Raises
    ------
    InputError
        With what was named.
    """
    unknown = set(components) - set(AXES)
    if unknown or not components or len(set(components)) < len(components):
        raise InputError(
            "components", list(components), "one to three of x, y, z, each once", "Correct them."
        )


_HEADS = (
    re.compile(r"NPTS\s*=\s*(?P<count>\d+)\s*,?\s*DT\s*=\s*(?P<step>[\d.]+(?:[eE][-+]?\d+)?)"),
    re.compile(r"^\s*(?P<count>\d+)\s+(?P<step>[\d.]+(?:[eE][-+]?\d+)?)\s+NPTS\s*,\s*DT"),
)
"""The two ways in which PEER has written number and interval of the samples."""
_HEADER_LINES = 10


def read_at2(path: Path) -> tuple[float, Array, str]:
    """Interval in s, acceleration (n,) in m/s2, and origin, out of a file of PEER's.

    A header ends with number and interval of the samples (``NPTS= 4000, DT= .0050 SEC``); then
    come the samples in g, several in a line. That is the format as it is found in files and
    readers of it; PEER has not published a definition.

    Raises
    ------
    InputError
        No such header, another unit, a cell that is not a number, or a wrong count.
    """
    text = read_text(path)
    lines = text.splitlines()
    heads = [
        (number, match)
        for number, line in enumerate(lines[:_HEADER_LINES])
        for head in _HEADS
        if (match := head.search(line))
    ]
    if not heads:
        raise InputError(
            str(path),
            "no line with NPTS and DT",
            f"one such as 'NPTS= 4000, DT= .0050 SEC' in the first {_HEADER_LINES} lines",
            "Is it an AT2 file? Columns of numbers go under file.",
        )
    number, found = heads[0]
    unit = re.search(r"UNITS\s+OF\s+([^\s,]+)", " ".join(lines[:number]))
    if unit and unit[1].upper().rstrip(".") != "G":
        raise InputError(
            f"{path}, header", unit[1], "accelerations in units of G", "Is it a velocity (VT2)?"
        )
    values: list[float] = []
    for place, line in enumerate(lines[number + 1 :], number + 2):
        cells = line.split()
        values += to_numbers(path, place, cells, len(cells))
    count, step = int(found["count"]), float(found["step"])
    if len(values) != count or count < 2 or not step > 0:
        raise InputError(
            f"{path}, line {number + 1}",
            f"{len(values)} samples, {count} promised, {step:g} s apart",
            "as many as promised, two or more, at a positive interval",
            "Is the file complete?",
        )
    return step, STANDARD_GRAVITY * np.array(values), _origin(path, text)


def read_at2_components(paths: Mapping[Axis, Path]) -> Accelerogram:
    """One AT2 file for each axis; one that ends early is followed by zeros.

    Raises
    ------
    InputError
        As in :func:`read_at2`; intervals that differ.
    """
    check_components(list(paths))
    read = {axis: read_at2(path) for axis, path in paths.items()}
    steps = {axis: step for axis, (step, _, _) in read.items()}
    step = next(iter(steps.values()))
    if any(abs(other - step) > 1e-9 * step for other in steps.values()):
        raise InputError("at2, DT", steps, "one interval for all components", "Resample a file.")
    count = max(len(values) for _, values, _ in read.values())
    acceleration = np.zeros((count, 3))
    for axis, (_, values, _) in read.items():
        acceleration[: len(values), AXES.index(axis)] = values
    origin = "; ".join(f"{axis}: {told}" for axis, (_, _, told) in read.items())
    return Accelerogram(step * np.arange(count, dtype=float), acceleration, origin)


def unit_cautions(acceleration: Array, unit: Unit) -> list[str]:
    """What speaks against a unit, given accelerations in m/s2 that came of it."""
    peak = float(np.max(np.abs(acceleration)))
    number = f"{peak / UNITS[unit]:.3g}"
    if peak > STRONG:
        likely = "cm/s2" if unit == "m_per_s2" else "m/s2 or cm/s2"
        return [
            f"a peak of {number} in the unit {unit} is {peak:.3g} m/s2, beyond nearly all that was "
            f"ever recorded; are the numbers in {likely}?"
        ]
    if 0 < peak < WEAK:
        likely = "g" if unit == "m_per_s2" else "m/s2 or g"
        hint = "" if unit == "g" else f"; are the numbers in {likely}?"
        return [f"a peak of {number} in the unit {unit} is {peak:.3g} m/s2, a weak motion{hint}"]
    return []


def _origin(path: Path, text: str) -> str:
    digest = hashlib.sha256(text.encode()).hexdigest()
    return f"{path.name} (SHA-256 {digest})"
