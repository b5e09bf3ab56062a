"""Kinds of foundation by name, with their wording.

Help texts and completion use these names, so each kind imports its builder only when it is used.
"""

from __future__ import annotations

import logging
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar

from offwind_pin.base.errors import InputError

if TYPE_CHECKING:
    from offwind_pin.definitions.turbine import Turbine
    from offwind_pin.loads.soil.foundation import Foundation

_log = logging.getLogger(__name__)


class FoundationKind(ABC):
    """A kind of foundation with a name: base class of the package's kinds and of your own.

    Attributes
    ----------
    name : str
        Name in case files and commands.
    description : str
        Description in tables, figures and reports.
    preposition : str
        Preposition between a structure and the description in a sentence.
    lower_end : str
        Name of the lower end of a structure that extends below the mudline.
    """

    name: ClassVar[str]
    description: ClassVar[str]
    preposition: ClassVar[str] = "on"
    lower_end: ClassVar[str] = "pile toe"

    @abstractmethod
    def make(self, turbine: Turbine) -> Foundation:
        """The foundation of a turbine.

        Parameters
        ----------
        turbine : Turbine

        Returns
        -------
        Foundation

        Raises
        ------
        InputError
            The turbine lacks what the foundation needs.
        """

    def is_described(self, turbine: Turbine) -> bool:
        """Whether a turbine file defines it; ``offwind show`` lists those foundations.

        Parameters
        ----------
        turbine : Turbine

        Returns
        -------
        bool
        """
        return True


class Clamped(FoundationKind):
    """Fixed rigidly at the mudline."""

    name = "clamped"
    description = "clamped at the mudline"
    preposition = ""

    def make(self, turbine: Turbine) -> Foundation:
        from offwind_pin.loads.soil.foundation import clamped

        return clamped(turbine)


class ApparentFixity(FoundationKind):
    """A cantilever below the mudline with the stiffness of pile and soil."""

    name = "apparent_fixity"
    description = "apparent fixity below the mudline"
    preposition = "with"
    lower_end = "apparent fixity"

    def make(self, turbine: Turbine) -> Foundation:
        from offwind_pin.analysis.foundation.equivalent import apparent_fixity

        return apparent_fixity(turbine)

    def is_described(self, turbine: Turbine) -> bool:
        soil = turbine.soil
        return soil.distributed_springs is not None or soil.coupled_springs is not None


class CoupledSprings(FoundationKind):
    """A 6x6 stiffness at the mudline."""

    name = "coupled_springs"
    description = "coupled springs at the mudline"

    def make(self, turbine: Turbine) -> Foundation:
        from offwind_pin.loads.soil.foundation import coupled_springs

        return coupled_springs(turbine)

    def is_described(self, turbine: Turbine) -> bool:
        return turbine.soil.coupled_springs is not None


class DistributedSprings(FoundationKind):
    """The pile to its toe, with soil springs along it."""

    name = "distributed_springs"
    description = "distributed springs"

    def make(self, turbine: Turbine) -> Foundation:
        from offwind_pin.loads.soil.foundation import distributed_springs

        return distributed_springs(turbine)

    def is_described(self, turbine: Turbine) -> bool:
        return turbine.soil.distributed_springs is not None


class MacroElement(FoundationKind):
    """Kinematic hardening at the mudline, calibrated to a monotonic loading."""

    name = "macro_element"
    description = "macro-element at the mudline"
    preposition = "on a"

    def make(self, turbine: Turbine) -> Foundation:
        from offwind_pin.analysis.foundation.equivalent import macro_element

        return macro_element(turbine)

    def is_described(self, turbine: Turbine) -> bool:
        soil = turbine.soil
        return soil.distributed_springs is not None or soil.macro_element is not None


FOUNDATIONS: dict[str, FoundationKind] = {}


def register_foundation(kind: FoundationKind) -> None:
    """Register a kind of foundation by name for :func:`build`, case files and commands.

    Parameters
    ----------
    kind : FoundationKind

    Raises
    ------
    InputError
        A kind of another class already has the name.
    """
    known = FOUNDATIONS.get(kind.name)
    if known is not None and type(known) is not type(kind):
        raise InputError(
            "foundation", kind.name, f"a name other than {', '.join(FOUNDATIONS)}", "Rename it."
        )
    FOUNDATIONS[kind.name] = kind


def make_foundation(turbine: Turbine, kind: str | Foundation) -> Foundation:
    """The foundation of a name for a turbine, or the one given; cautions go to the log.

    Raises
    ------
    InputError
        No foundation of that name, or the turbine lacks what it needs.
    """
    from offwind_pin.loads.soil.foundation import Foundation

    if isinstance(kind, Foundation):
        foundation = kind
    elif kind in FOUNDATIONS:
        foundation = FOUNDATIONS[kind].make(turbine)
    else:
        raise InputError("foundation", kind, ", ".join(FOUNDATIONS), "Choose one of them.")
    for caution in foundation.cautions:
        _log.warning("turbine %s: %s", turbine.name, caution)
    return foundation


def described_foundations(turbine: Turbine) -> list[str]:
    """Names of the foundations that the turbine defines."""
    return [name for name, kind in FOUNDATIONS.items() if kind.is_described(turbine)]


for _kind in (Clamped, ApparentFixity, CoupledSprings, DistributedSprings, MacroElement):
    register_foundation(_kind())
