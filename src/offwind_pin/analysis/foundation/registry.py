"""The five foundations by name."""

from __future__ import annotations

import logging
from collections.abc import Callable

from offwind_pin.analysis.foundation.equivalent import apparent_fixity, macro_element
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.soil.foundation import (
    Foundation,
    clamped,
    coupled_springs,
    distributed_springs,
)

_log = logging.getLogger(__name__)

FOUNDATIONS: dict[str, Callable[[Turbine], Foundation]] = {
    "clamped": clamped,
    "apparent_fixity": apparent_fixity,
    "coupled_springs": coupled_springs,
    "distributed_springs": distributed_springs,
    "macro_element": macro_element,
}


def make_foundation(turbine: Turbine, kind: str | Foundation) -> Foundation:
    """The foundation of that name for a turbine, or the one given; cautions go to the log.

    Raises
    ------
    InputError : no foundation of that name, or the turbine lacks what it needs
    """
    if isinstance(kind, Foundation):
        foundation = kind
    elif kind in FOUNDATIONS:
        foundation = FOUNDATIONS[kind](turbine)
    else:
        raise InputError("foundation", kind, ", ".join(FOUNDATIONS), "Choose one of them.")
    for caution in foundation.cautions:
        _log.warning("turbine %s: %s", turbine.name, caution)
    return foundation


def described_foundations(turbine: Turbine) -> list[str]:
    """Names of those that the turbine's soil has the numbers for."""
    soil = turbine.soil
    springs = soil.distributed_springs is not None
    known = {
        "clamped": True,
        "apparent_fixity": springs or soil.coupled_springs is not None,
        "coupled_springs": soil.coupled_springs is not None,
        "distributed_springs": springs,
        "macro_element": springs or (soil.macro_element is not None),
    }
    return [name for name in FOUNDATIONS if known.get(name, True)]
