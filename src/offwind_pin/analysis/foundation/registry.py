"""Foundations by name."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

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


@dataclass(frozen=True)
class FoundationKind:
    """A kind of foundation that has a name.

    Attributes
    ----------
    make : callable
        The foundation of a turbine.
    is_described : callable
        Whether a turbine's soil has the numbers for it.
    """

    make: Callable[[Turbine], Foundation]
    is_described: Callable[[Turbine], bool]

    def __call__(self, turbine: Turbine) -> Foundation:
        return self.make(turbine)


FOUNDATIONS: dict[str, FoundationKind] = {}


def register_foundation(
    name: str,
    make: Callable[[Turbine], Foundation],
    is_described: Callable[[Turbine], bool] | None = None,
) -> None:
    """Give a kind of foundation a name, for :func:`build`, case files and the commands.

    Parameters
    ----------
    make : callable
        The foundation of a turbine; raises :class:`InputError` where the turbine lacks something.
    is_described : callable, optional
        Whether a turbine's soil has the numbers for it; always unless given.

    Raises
    ------
    InputError
        Another kind has the name.
    """
    if name in FOUNDATIONS and FOUNDATIONS[name].make is not make:
        raise InputError(
            "foundation", name, f"a name other than {', '.join(FOUNDATIONS)}", "Choose another."
        )
    FOUNDATIONS[name] = FoundationKind(make, is_described or _always)


def make_foundation(turbine: Turbine, kind: str | Foundation) -> Foundation:
    """The foundation of that name for a turbine, or the one given; cautions go to the log.

    Raises
    ------
    InputError
        No foundation of that name, or the turbine lacks what it needs.
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
    return [name for name, kind in FOUNDATIONS.items() if kind.is_described(turbine)]


def _always(turbine: Turbine) -> bool:
    return True


def _has_springs(turbine: Turbine) -> bool:
    return turbine.soil.distributed_springs is not None


def _has_stiffness(turbine: Turbine) -> bool:
    return turbine.soil.coupled_springs is not None


register_foundation("clamped", clamped)
register_foundation(
    "apparent_fixity",
    apparent_fixity,
    lambda turbine: _has_springs(turbine) or _has_stiffness(turbine),
)
register_foundation("coupled_springs", coupled_springs, _has_stiffness)
register_foundation("distributed_springs", distributed_springs, _has_springs)
register_foundation(
    "macro_element",
    macro_element,
    lambda turbine: _has_springs(turbine) or turbine.soil.macro_element is not None,
)
