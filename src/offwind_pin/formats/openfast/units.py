"""Spellings of units in load files, and their SI equivalents."""

from __future__ import annotations

import re

import numpy as np

from offwind_pin.base.errors import InputError

FORCE, MOMENT, ANGLE, TIME = "force", "moment", "angle", "time"

_SI = {FORCE: "N", MOMENT: "N m", ANGLE: "rad", TIME: "s"}
_KNOWN = {
    "N": (FORCE, 1.0),
    "kN": (FORCE, 1e3),
    "KN": (FORCE, 1e3),
    "MN": (FORCE, 1e6),
    "Nm": (MOMENT, 1.0),
    "kNm": (MOMENT, 1e3),
    "KNm": (MOMENT, 1e3),
    "MNm": (MOMENT, 1e6),
    "deg": (ANGLE, np.pi / 180),
    "rad": (ANGLE, 1.0),
    "s": (TIME, 1.0),
    "sec": (TIME, 1.0),
}
_BETWEEN = re.compile(r"[\s·*.\-⋅∙]")
"""Separators between kN and m, which differ between programs."""


def si_factor(where: str, unit: str, kind: str) -> float:
    """Factor that converts a number in a unit to SI.

    unit : as in the file, with or without brackets; kind : ``FORCE``, ``MOMENT``, ``ANGLE`` or
    ``TIME``

    Raises
    ------
    InputError
        An unknown unit, or one of another kind.
    """
    plain = _BETWEEN.sub("", unit.strip().strip("()[]"))
    found = _KNOWN.get(plain)
    if found is None or found[0] != kind:
        spelled = [name.replace("Nm", "N-m") for name, (of, _) in _KNOWN.items() if of == kind]
        raise InputError(
            f"{where}, unit",
            unit,
            f"a {kind} in {', '.join(spelled)}",
            f"Choose a channel of that kind, or convert the file to {_SI[kind]}.",
        )
    return found[1]
