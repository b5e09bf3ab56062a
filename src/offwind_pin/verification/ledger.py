"""The verification ledger: rows, and the outcomes of checking them.

A row names a function of ``verification/checks`` that recomputes the quantity. Tests, the
``offwind verify`` command and the page that is rendered read the same rows: a tolerance is written
once, in ``ledger.yaml``.
"""

from __future__ import annotations

import fnmatch
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.resources import files
from typing import Any, Literal

import yaml
from pydantic import Field, TypeAdapter

from offwind_pin.base.definition import Definition, NonNegative, Number
from offwind_pin.base.errors import InputError

Status = Literal["pass", "fail", "not run"]


@dataclass(frozen=True)
class Found:
    """Computed value of a check, and the closed form or second implementation as its reference."""

    value: float
    reference: float


class Row(Definition):
    """One claim.

    Attributes
    ----------
    id : str
        Short and unique.
    group : str
        Heading under which it is listed.
    quantity, unit : str
        What is compared.
    check : str
        Module of ``verification/checks`` and function in it, with its arguments ``given``.
    reference : float or None
        Published number; None where the check computes the reference as well.
    source : str
        Where the reference comes from (paper, equation, program).
    tolerance : float
        Largest difference that passes, relative to the reference or absolute (``kind``).
    remark : str or None
        What a reader needs to know to judge it.
    needs : str or None
        A program that must be installed, or None.
    """

    id: str
    group: str
    quantity: str
    unit: str = "-"
    check: str
    given: dict[str, Any] = Field(default_factory=dict)
    reference: Number | None = None
    source: str
    tolerance: NonNegative
    kind: Literal["relative", "absolute"] = "relative"
    remark: str | None = None
    needs: str | None = None

    @property
    def command(self) -> str:
        """Command that checks this row alone."""
        return f"offwind verify --only {self.id}"

    @property
    def function(self) -> Callable[..., float | Found]:
        """The check itself."""
        module, name = self.check.split(".")
        found: Callable[..., float | Found] = getattr(
            import_module(f"offwind_pin.verification.checks.{module}"), name
        )
        return found


@dataclass(frozen=True)
class Outcome:
    """A row that was checked, or could not be.

    Attributes
    ----------
    value, reference : float or None
        Computed value and its reference; None if not run.
    status : {"pass", "fail", "not run"}
        Whether the difference is within the tolerance.
    reason : str or None
        Why it was not run, or how it failed to compute.
    wall : float, s
        Time taken.
    """

    row: Row
    value: float | None
    reference: float | None
    status: Status
    reason: str | None = None
    wall: float = 0.0

    @property
    def distance(self) -> float | None:
        """Difference of value and reference, relative or absolute as the row requires."""
        if self.value is None or self.reference is None:
            return None
        return distance(self.value, self.reference, self.row.kind)

    def as_dict(self) -> dict[str, Any]:
        """Plain data; ``pass`` is None where the row was not run."""
        row = self.row
        return {
            "id": row.id,
            "group": row.group,
            "quantity": row.quantity,
            "unit": row.unit,
            "value": self.value,
            "reference": self.reference,
            "source": row.source,
            "tolerance": row.tolerance,
            "kind": row.kind,
            "distance": self.distance,
            "pass": None if self.status == "not run" else self.status == "pass",
            "reason": self.reason,
            "command": row.command,
        }


def distance(value: float, reference: float, kind: str) -> float:
    """Difference of a value from its reference."""
    off = abs(value - reference)
    return off if kind == "absolute" else off / abs(reference)


@cache
def read_ledger() -> tuple[Row, ...]:
    """All rows, in the order of the ledger."""
    text = files("offwind_pin.verification").joinpath("ledger.yaml").read_text(encoding="utf-8")
    rows = TypeAdapter(tuple[Row, ...]).validate_python(yaml.safe_load(text))
    names = [row.id for row in rows]
    doubled = {name for name in names if names.count(name) > 1}
    if doubled:
        raise RuntimeError(f"the ledger has several rows called {', '.join(sorted(doubled))}")
    return rows


def choose(pattern: str | None) -> tuple[Row, ...]:
    """Rows whose id matches a pattern such as ``oc6-*``, or all.

    Raises
    ------
    InputError
        No row matches.
    """
    rows = read_ledger()
    if pattern is None:
        return rows
    chosen = tuple(row for row in rows if fnmatch.fnmatchcase(row.id, pattern))
    if not chosen:
        known = ", ".join(sorted({row.id.split("-")[0] + "-*" for row in rows}))
        raise InputError("--only", pattern, f"a row of the ledger, or {known}", "Correct it.")
    return chosen


def check(row: Row) -> Outcome:
    """Recompute a row and compare."""
    missing = None if row.needs is None else _missing(row.needs)
    if missing is not None:
        return Outcome(row, None, row.reference, "not run", missing)
    begun = time.perf_counter()
    found = row.function(**row.given)
    wall = time.perf_counter() - begun
    if isinstance(found, Found):
        value, reference = found.value, found.reference
    elif row.reference is None:
        raise RuntimeError(f"row {row.id} has no reference, and its check returns none")
    else:
        value, reference = float(found), row.reference
    near = math.isfinite(value) and distance(value, reference, row.kind) <= row.tolerance
    return Outcome(row, value, reference, "pass" if near else "fail", None, wall)


@cache
def _missing(peer: str) -> str | None:
    """Why a program cannot be used, or None."""
    try:
        import_module(peer)
    except ModuleNotFoundError:
        return f"{peer} is not installed"
    except Exception as error:  # anything another program raises, such as a missing library
        return f"{peer} cannot be imported: {error}"
    return None


def verify(
    rows: Sequence[Row], progress: Callable[[int, Row], None] | None = None
) -> tuple[Outcome, ...]:
    """Check rows; a row whose check raises fails with the reason, and the others continue.

    progress : called before each row with its index
    """
    outcomes = []
    for place, row in enumerate(rows):
        if progress is not None:
            progress(place, row)
        try:
            outcomes.append(check(row))
        except Exception as error:
            outcomes.append(Outcome(row, None, row.reference, "fail", f"{error}"))
    return tuple(outcomes)
