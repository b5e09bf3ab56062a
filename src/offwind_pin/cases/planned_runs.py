"""Which runs a command asks for: cases, seeds and their directories."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from offwind_pin.base.errors import InputError
from offwind_pin.cases.case import Case

_MOST_SEEDS = 10_000


@dataclass(frozen=True)
class PlannedRun:
    """One case with one seed, and the directory of its results."""

    case: Case
    directory: Path


def planned_runs(cases: Sequence[Case], seeds: Sequence[int] | None, out: Path) -> list[PlannedRun]:
    """One case with one seed goes to ``out``, several to ``out/<case>/seed_0001``.

    Parameters
    ----------
    cases : sequence of Case
    seeds : sequence of int, or None
        Of every case; None for the seed that each case has.
    out : Path

    Raises
    ------
    InputError
        Two cases of one name.
    """
    again = [name for name, count in Counter(case.name for case in cases).items() if count > 1]
    if again:
        raise InputError(
            "CASE", f"{again[0]} given twice", "cases with different names", "Rename one of them."
        )
    reseeded = list(cases)
    if seeds is not None:
        reseeded = [case.with_seed(seed) for case in cases for seed in seeds]
    if len(reseeded) == 1:
        return [PlannedRun(reseeded[0], out)]
    return [PlannedRun(case, out / case.name / f"seed_{case.seed:04d}") for case in reseeded]


def seed_numbers(text: str) -> list[int]:
    """Seeds out of ``1-6`` or ``1,4,7-9``.

    Raises
    ------
    InputError
        A text that is something else.
    """
    found: list[int] = []
    for part in text.split(","):
        first, dash, last = (number.strip() for number in part.partition("-"))
        ends = (first, last if dash else first)
        if not all(end.isascii() and end.isdigit() and len(end) < 10 for end in ends):
            raise _refused(text)
        low, high = map(int, ends)
        if not low <= high < low + _MOST_SEEDS:
            raise _refused(text)
        found += range(low, high + 1)
    if len(set(found)) < len(found) or len(found) > _MOST_SEEDS:
        raise _refused(text)
    return found


def _refused(text: str) -> InputError:
    allowed = f"up to {_MOST_SEEDS} different whole numbers, such as 1-6 or 1,4,7-9"
    return InputError("--seeds", text, allowed, "Correct the list.")
