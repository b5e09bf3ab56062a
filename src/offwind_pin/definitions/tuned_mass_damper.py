"""Tuned mass dampers: definition in a turbine file, and Den Hartog's optimum."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, NonNegative, Positive
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.hydrodynamics import Height

Direction = Literal["fore_aft", "side_side", "both"]

_OWN = ("stiffness_n_per_m", "damping_n_s_per_m")
_TUNED = ("frequency_hz", "damping_ratio")


class TunedMassDamper(Definition):
    """Point mass that slides across the axis on a spring and a linear damper.

    Along the axis it is fixed to its carrier. Spring and damper are given directly, or by the
    natural frequency and damping ratio on a carrier at rest; with ``direction: both`` they are the
    same along x and y of the carrier. The travel has no end stops: simulations warn if it is
    exceeded.
    """

    name: Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
    z: Height = Field(alias="z_m")
    mass: Positive = Field(alias="mass_kg")
    direction: Direction
    own_stiffness: Positive | None = Field(alias="stiffness_n_per_m", default=None)
    own_damping: NonNegative | None = Field(alias="damping_n_s_per_m", default=None)
    frequency: Annotated[Positive, Field(ge=1e-3, le=100)] | None = Field(
        alias="frequency_hz", default=None
    )
    damping_ratio: Annotated[NonNegative, Field(le=10)] | None = None
    travel: Positive | None = Field(alias="travel_m", default=None)

    @model_validator(mode="after")
    def _tuned_in_one_way(self) -> TunedMassDamper:
        values = (self.own_stiffness, self.own_damping, self.frequency, self.damping_ratio)
        given = [
            name for name, value in zip((*_OWN, *_TUNED), values, strict=True) if value is not None
        ]
        if given not in (list(_OWN), list(_TUNED)):
            raise ValueError(
                f"damper {self.name} gives {', '.join(given) or 'neither spring nor damper'}; give "
                f"either {' and '.join(_OWN)}, or {' and '.join(_TUNED)}"
            )
        return self

    @property
    def stiffness(self) -> float:
        """Stiffness of the spring in N/m."""
        if self.frequency is None:
            return self.own_stiffness or 0.0
        return self.mass * (2 * math.pi * self.frequency) ** 2

    @property
    def damping(self) -> float:
        """Coefficient of the damper in N s/m."""
        if self.damping_ratio is None:
            return self.own_damping or 0.0
        return 2 * self.damping_ratio * math.sqrt(self.stiffness * self.mass)


@dataclass(frozen=True)
class DampedAbsorber:
    """Optimum tuned mass damper of an undamped structure.

    Attributes
    ----------
    mass_ratio : float
        Mass of the damper over that of the mode.
    frequency_ratio : float
        Natural frequency of the damper alone over that of the mode without it.
    damping_ratio : float
        Damping ratio of the damper alone, c / (2 sqrt(k m)), as in a turbine file.
    amplification : float
        Motion of the mode under a harmonic force over that under a constant one, at the two
        frequencies at which it does not depend on the damping; within some thousandths the largest.
    """

    mass_ratio: float
    frequency_ratio: float
    damping_ratio: float
    amplification: float


def den_hartog(mass_ratio: float) -> DampedAbsorber:
    """Optimum tuned mass damper under a harmonic force on the structure.

    Frequency ratio 1 / (1 + mu) and amplification sqrt(1 + 2 / mu): Den Hartog, Mechanical
    Vibrations, 4th ed. (1956), section 3.3. Damping by Brock, A note on the damped vibration
    absorber, J. Appl. Mech. 13 (1946), A-284: c / (2 m omega) = sqrt(3 mu / (8 (1 + mu)^3)) with
    the frequency omega of the structure, which is sqrt(3 mu / (8 (1 + mu))) with the damper's own.

    Parameters
    ----------
    mass_ratio : float
        Mass of the damper over the modal mass of the mode, with the shape scaled to 1 at the
        damper.

    Returns
    -------
    DampedAbsorber

    Raises
    ------
    InputError
        A ratio that is not above zero.
    """
    if not 0 < mass_ratio < math.inf:
        raise InputError("mass_ratio", mass_ratio, "a finite number above zero", "Correct it.")
    return DampedAbsorber(
        mass_ratio=mass_ratio,
        frequency_ratio=1 / (1 + mass_ratio),
        damping_ratio=math.sqrt(3 * mass_ratio / (8 * (1 + mass_ratio))),
        amplification=math.sqrt(1 + 2 / mass_ratio),
    )
