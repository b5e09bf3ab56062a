"""Text files of numbers; every fault is told with its line."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from offwind_pin.base.errors import InputError


def read_text(path: Path) -> str:
    """A user's text file, with or without a byte-order mark.

    Raises
    ------
    InputError : it is missing, cannot be read, or is no text
    """
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError(str(path), "no such file", "an existing file", "Check the path.") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(str(path), str(error), "a readable UTF-8 text file", "Check it.") from None


def read_numbers(path: Path, columns: tuple[str, ...]) -> list[tuple[int, tuple[float, ...]]]:
    """Rows of numbers of a CSV file with a header, each with its line number.

    Lines that start with ``#`` are comments.

    Raises
    ------
    InputError : missing or empty file, wrong header, a cell that is no finite number
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


def to_numbers(path: Path, line: int, cells: list[str], count: int) -> tuple[float, ...]:
    """Finite numbers out of the cells of one line.

    Raises
    ------
    InputError : a wrong number of cells, or a cell that is no finite number
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
