"""Structural damping as a user defines it: by joint factors, by modes, or after Rayleigh."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, Flag, NonNegative, Number, Positive, key

ModeLabel = Annotated[str, Field(pattern=r"^(FA|SS|T|V)[1-9]$")]
Ratio = Annotated[Positive, Field(lt=1)]
Ratios = Annotated[dict[ModeLabel, Ratio], Field(min_length=1)]


class _OfASystem(Definition):
    """Ratios that refer to modes of a system.

    Attributes
    ----------
    foundation : str or None
        Of that system; by default the run's own.
    still_water : bool or None
        Whether that system is in water; by default as the run is.
    """

    foundation: str | None = None
    still_water: Flag | None = None

    def wet(self, *, in_water: bool) -> bool:
        """Whether that system is in water.

        Parameters
        ----------
        in_water : bool
            Whether the run is.

        Returns
        -------
        bool
        """
        return in_water if self.still_water is None else self.still_water


class StiffnessDamping(_OfASystem):
    """Stiffness-proportional joint damping whose factors are calibrated on named modes.

    Attributes
    ----------
    ratios : dict of str to float
        Of critical, by mode label.
    """

    kind: Literal["stiffness"] = "stiffness"
    ratios: Ratios = key("ratios_of_critical")

    def ratio_of(self, label: str, frequency: float) -> float:
        """Structural damping ratio asked for in a mode.

        Parameters
        ----------
        label : str
            Label such as ``"FA1"``.
        frequency : float, Hz

        Returns
        -------
        float
            NaN if none was asked for.
        """
        return self.ratios.get(label, math.nan)


class ModalDamping(_OfASystem):
    """Damping ratios of modes, exact for the named ones.

    Attributes
    ----------
    ratios : dict of str to float
        Of critical, by mode label.
    others : float
        Ratio of every other mode up to the cutoff; beyond, damping grows with frequency.
    cutoff : float, Hz
    """

    kind: Literal["modal"] = "modal"
    ratios: Ratios = key("ratios_of_critical")
    others: Ratio
    cutoff: Annotated[Positive, Field(ge=0.1, le=20)] = key("cutoff_hz", default=5.0)

    def ratio_of(self, label: str, frequency: float) -> float:
        """Structural damping ratio asked for in a mode.

        Parameters
        ----------
        label : str
            Label such as ``"FA1"``.
        frequency : float, Hz

        Returns
        -------
        float
            NaN if none was asked for.
        """
        others = self.others if frequency <= self.cutoff else math.nan
        return self.ratios.get(label, others)


class RayleighDamping(_OfASystem):
    """Damping alpha M + beta K of the structure.

    Either the ratios of two named modes, or two frequencies and the ratios
    there, or both factors are given.

    Attributes
    ----------
    ratios : dict of str to float or None
        Of critical, by mode label.
    frequencies : (float, float) or None, Hz
    ratios_at_frequencies : (float, float) or None
    alpha : float or None, 1/s
    beta : float or None, s
    """

    kind: Literal["rayleigh"] = "rayleigh"
    ratios: Ratios | None = key("ratios_of_critical", default=None)
    frequencies: tuple[Positive, Positive] | None = key("frequencies_hz", default=None)
    ratios_at_frequencies: tuple[Ratio, Ratio] | None = None
    alpha: NonNegative | None = key("alpha_per_s", default=None)
    beta: Annotated[Number, Field(ge=0, le=10)] | None = key("beta_s", default=None)

    def ratio_of(self, label: str, frequency: float) -> float:
        """Structural damping ratio asked for in a mode.

        Parameters
        ----------
        label : str
            Label such as ``"FA1"``.
        frequency : float, Hz

        Returns
        -------
        float
            NaN if none was asked for.
        """
        return (self.ratios or {}).get(label, math.nan)

    @model_validator(mode="after")
    def _is_given_once(self) -> RayleighDamping:
        ways = {
            "ratios_of_critical": (self.ratios,),
            "frequencies_hz with ratios_at_frequencies": (
                self.frequencies,
                self.ratios_at_frequencies,
            ),
            "alpha_per_s with beta_s": (self.alpha, self.beta),
        }
        begun = [name for name, values in ways.items() if any(v is not None for v in values)]
        whole = [name for name, values in ways.items() if all(v is not None for v in values)]
        if len(begun) != 1 or begun != whole:
            raise ValueError(
                f"rayleigh damping with {' and '.join(begun) or 'no numbers'}"
                f"{'' if begun == whole else ', incomplete'}; give one of: {', or '.join(ways)}"
            )
        if self.ratios is not None and len(self.ratios) != 2:
            raise ValueError(
                f"ratios_of_critical names {len(self.ratios)} modes "
                f"({', '.join(self.ratios)}); Rayleigh damping has two factors, name two modes"
            )
        if self.frequencies is not None and self.frequencies[0] == self.frequencies[1]:
            raise ValueError(
                f"frequencies_hz gives {self.frequencies[0]:g} Hz twice; give two that differ"
            )
        if self.alpha == 0 and self.beta == 0:
            raise ValueError("alpha_per_s and beta_s are both 0; leave structural_damping out")
        return self


StructuralDamping = Annotated[
    StiffnessDamping | ModalDamping | RayleighDamping, Field(discriminator="kind")
]


def with_kind(damping: object) -> object:
    """A block as in a file, one without a kind as ``kind: stiffness``."""
    if isinstance(damping, dict) and "kind" not in damping:
        return {"kind": "stiffness", **damping}
    return damping
