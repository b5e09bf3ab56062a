"""A 6x6 foundation as files that other codes read: OpenFAST's SubDyn and SoilDyn.

Order x, y, z, rx, ry, rz in N, m, rad; kg, m for masses. Numbers are printed with 17 significant
digits, so that reading recovers them exactly.

WISDEM has no input for a 6x6; :mod:`offwind_pin.formats.wisdem` expresses it as springs along its
pile.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import read_text
from offwind_pin.base.number_tables import parse_number
from offwind_pin.base.whole_files import write_text

Array = NDArray[np.float64]

_DIRECTIONS = ("x", "y", "z", "tx", "ty", "tz")
_UPPER = tuple((i, j) for j in range(6) for i in range(j + 1))
"""Indices of SubDyn's 21 entries: the upper triangle, column by column."""
_ASYMMETRY = 1e-9
"""Difference of entries ij and ji over the root of ii times jj that counts as rounding error."""


@dataclass(frozen=True, eq=False)
class SoilDynInput:
    """Input of SoilDyn's stiffness option.

    Attributes
    ----------
    location : (3,) array, m
        Interface point, z from still water level.
    stiffness, damping : (6, 6) array
    """

    location: Array
    stiffness: Array
    damping: Array


def write_subdyn_ssi(
    path: Path, stiffness: ArrayLike, mass: ArrayLike | None = None, *, note: str = ""
) -> None:
    """Write a SubDyn soil-structure interaction file, named in its table of base reaction joints.

    All 21 entries of either matrix are written: for omitted entries the manual says that they are
    infinite, and the program (OpenFAST 3 to 4, ``ReadSSIfile`` in SubDyn.f90) that they are zero.
    The joint must be free, 0 in all six columns of that table, in the directions of its springs.
    Source: OpenFAST's documentation of SubDyn, section SSI Input File, and that routine.

    Parameters
    ----------
    stiffness, mass : (6, 6) array_like
        Symmetric; without a mass zeros are written.
    note : str
        One line for the head of the file.

    Raises
    ------
    InputError
        A matrix that is not six by six, finite and symmetric.
    """
    lines = [f"! Foundation at the mudline. {_one_line(note)}".rstrip()]
    parts: list[tuple[str, str, ArrayLike]] = [
        ("K", "Stiffness in N/m, N and N m/rad", stiffness),
        ("M", "Mass in kg, kg m and kg m2", np.zeros((6, 6)) if mass is None else mass),
    ]
    for letter, what, given in parts:
        matrix = symmetric_matrix(given, {"K": "stiffness", "M": "mass"}[letter])
        lines.append(f"! {what}: the upper triangle, column by column")
        lines += [f"{matrix[i, j]: .16E}  {_entry(letter, i, j)}" for i, j in _UPPER]
    write_text(path, "\n".join(lines) + "\n")


def read_subdyn_ssi(path: Path) -> tuple[Array, Array]:
    """Stiffness and mass (6, 6) of a SubDyn SSI file; omitted entries are zero, as in the program.

    Raises
    ------
    InputError
        A missing file, or a line that is not a number and the name of an entry.
    """
    names = {
        _entry(letter, i, j).lower(): (which, i, j)
        for which, letter in enumerate("KM")
        for i, j in _UPPER
    }
    matrices = np.zeros((2, 6, 6))
    seen: set[str] = set()
    for number, text in enumerate(read_text(path).splitlines(), 1):
        words = re.split(r"[!#%]", text)[0].split()
        if not words:
            continue
        where = f"{path}, line {number}"
        name = words[1].lower() if len(words) > 1 else ""
        if name not in names:
            raise InputError(
                where,
                text,
                "a number and one of Kxx ... Ktztz, Mxx ... Mtztz",
                "Complete the line.",
            )
        if name in seen:
            raise InputError(where, text, f"{words[1]} once", "Remove one of the two.")
        seen.add(name)
        which, i, j = names[name]
        matrices[which, i, j] = matrices[which, j, i] = _number(where, words[0])
    return matrices[0], matrices[1]


def write_soildyn(
    path: Path,
    stiffness: ArrayLike,
    location: Sequence[float],
    damping: ArrayLike | None = None,
    *,
    note: str = "",
) -> None:
    """Write SoilDyn's input file with ``CalcOption`` 1, the stiffness matrix.

    The location must be that of a reaction joint of SubDyn, free in all directions and without an
    SSI file of its own, or the foundation counts twice. Source: OpenFAST's ``SlD_ReadInput`` in
    SoilDyn_IO.f90, which reads line by line, and the r-test case OC6_phaseII.

    Parameters
    ----------
    stiffness : (6, 6) array_like
    location : sequence of float, m
        x, y, z of the interface point, z from still water level.
    damping : (6, 6) array_like, optional
        What SoilDyn's files call damping ratios; zeros by default.
    note : str
        The second line of the file.

    Raises
    ------
    InputError
        A matrix or location with numbers that are not finite.
    """
    place = np.asarray(location, dtype=float)
    if place.shape != (3,) or not np.all(np.isfinite(place)):
        raise InputError("location", list(location), "x, y, z in m", "Give three finite numbers.")
    rows = _rows(_matrix(stiffness, "stiffness"))
    damping_rows = _rows(_matrix(np.zeros((6, 6)) if damping is None else damping, "damping"))
    text = [
        "------- SoilDyn input file -------",
        _one_line(note) or "A 6x6 foundation",
        "---------------------------------",
        "False      Echo          - write what was read to a file of its own",
        '"default"  DT            - communication interval in s',
        "1          CalcOption    - 1: stiffness and damping matrices",
        "======= Stiffness and damping matrices (CalcOption 1) =======",
        f"{' '.join(f'{x:.17g}' for x in place)}   Location - x, y, z of the interface point in m",
        "Stiffness matrix",
        *rows,
        "Damping ratio matrix",
        *damping_rows,
        "======= P-y curves (CalcOption 2, not used) =======",
        "0          PY_numPts     - number of points",
        "Location, file",
        "======= REDWIN library (CalcOption 3, not used) =======",
        "2          DLL_model     - model of the library",
        '"unused"   DLL_FileName  - library',
        "0          DLL_NumPoints - number of points",
        "Location, properties, displacements",
        "======= Output =======",
        "False      SumPrint      - write a summary",
        "           OutList       - channels, one a line",
        "END of the list",
    ]
    write_text(path, "\n".join(text) + "\n")


def read_soildyn(path: Path) -> SoilDynInput:
    """Location, stiffness and damping of a SoilDyn input file, by line number as SoilDyn reads it.

    Raises
    ------
    InputError
        A missing file, one that is too short, or a line without its numbers.
    """
    lines = dict(enumerate(read_text(path).splitlines(), 1))
    last = _DAMPING_AT + 5
    if len(lines) < last:
        allowed = f"{last} lines up to the end of the damping matrix"
        raise InputError(str(path), f"{len(lines)} lines", allowed, "Is the file complete?")
    return SoilDynInput(
        location=_numbers(path, lines, _LOCATION_AT, 3),
        stiffness=np.array([_numbers(path, lines, _STIFFNESS_AT + i, 6) for i in range(6)]),
        damping=np.array([_numbers(path, lines, _DAMPING_AT + i, 6) for i in range(6)]),
    )


_LOCATION_AT, _STIFFNESS_AT, _DAMPING_AT = 8, 10, 17
"""Lines of a SoilDyn file, counted from 1."""


def _entry(letter: str, i: int, j: int) -> str:
    return f"{letter}{_DIRECTIONS[i]}{_DIRECTIONS[j]}"


def _rows(matrix: Array) -> list[str]:
    return [" ".join(f"{value: .16E}" for value in row) for row in matrix]


def _one_line(note: str) -> str:
    return " ".join(note.split())


def _matrix(given: ArrayLike, where: str) -> Array:
    matrix = np.asarray(given, dtype=float)
    if matrix.shape != (6, 6) or not np.all(np.isfinite(matrix)):
        shape = f"an array of shape {matrix.shape}"
        raise InputError(where, shape, "six by six finite numbers", "Give the full matrix.")
    return matrix


def symmetric_matrix(given: ArrayLike, where: str) -> Array:
    """(6, 6) with rounding asymmetry removed; an InputError for a larger one."""
    matrix = _matrix(given, where)
    size = np.sqrt(np.abs(np.diag(matrix)))
    difference = np.abs(matrix - matrix.T)
    if np.any(difference > _ASYMMETRY * np.outer(size, size)):
        i, j = divmod(int(np.argmax(difference)), 6)
        raise InputError(
            where,
            f"{matrix[i, j]} at {_entry('', i, j)} and {matrix[j, i]} at {_entry('', j, i)}",
            "a symmetric matrix",
            "Give the symmetric part if the difference is negligible.",
        )
    return (matrix + matrix.T) / 2


def _numbers(path: Path, lines: dict[int, str], line: int, count: int) -> Array:
    where = f"{path}, line {line}"
    words = lines[line].replace(",", " ").split()
    if len(words) < count:
        raise InputError(where, lines[line], f"{count} numbers", "Is a line missing before it?")
    return np.array([_number(where, word) for word in words[:count]])


def _number(where: str, word: str) -> float:
    """A number as Fortran writes it: 1.0D3 is 1000."""
    value = parse_number(re.sub("[dD]", "E", word))
    if value is None:
        raise InputError(where, word, "a finite number", "Correct it.")
    return value
