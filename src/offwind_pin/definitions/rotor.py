"""Rotor operation as tables over the wind speed: thrust coefficient and rotor speed."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, Integer, NonNegative, Number, Positive

WindSpeed = Annotated[Positive, Field(le=100)]

_LARGEST_COEFFICIENT = 1.5
"""Limit of the measurements behind the empirical branch of momentum theory."""

_STANDARD_AIR = 1.225
"""kg/m3, the standard atmosphere at sea level (ISO 2533)."""


def _check_wind_speeds(wind_speed: tuple[float, ...], values: tuple[float, ...]) -> None:
    if len(wind_speed) != len(values):
        raise ValueError(
            f"wind_speed_m_per_s has {len(wind_speed)} entries and value {len(values)}; give one "
            "value per wind speed"
        )
    if np.any(np.diff(wind_speed) <= 0):
        raise ValueError("wind_speed_m_per_s must increase strictly; sort the table")


class ThrustCoefficient(Definition):
    """Steady thrust over rho A U^2 / 2, by the undisturbed wind speed at hub height.

    It is that of the operating turbine, including tilt, cone and controller.
    """

    wind_speed: Annotated[tuple[WindSpeed, ...], Field(min_length=3)] = Field(
        alias="wind_speed_m_per_s"
    )
    value: Annotated[tuple[NonNegative, ...], Field(min_length=3)]

    @model_validator(mode="after")
    def _is_a_coefficient(self) -> ThrustCoefficient:
        _check_wind_speeds(self.wind_speed, self.value)
        if max(self.value) > _LARGEST_COEFFICIENT:
            raise ValueError(
                f"a thrust coefficient of {max(self.value):g} is too large for a rotor; give the "
                f"thrust over rho A U^2 / 2, at most {_LARGEST_COEFFICIENT:g}, not a thrust in kN"
            )
        if not any(self.value):
            raise ValueError("the thrust coefficients are all zero; one of them must be positive")
        return self


class RotorSpeed(Definition):
    """Rotor speed in rpm by the undisturbed wind speed at hub height."""

    wind_speed: Annotated[tuple[WindSpeed, ...], Field(min_length=2)] = Field(
        alias="wind_speed_m_per_s"
    )
    value: Annotated[tuple[Annotated[Positive, Field(le=100)], ...], Field(min_length=2)]

    @model_validator(mode="after")
    def _is_a_table(self) -> RotorSpeed:
        _check_wind_speeds(self.wind_speed, self.value)
        return self


class Rotor(Definition):
    """Steady operation of the rotor.

    The second half of the keys is for a rotor-nacelle assembly given as one rigid body, and is
    omitted where it is given by its parts; lengths and signs are those of ``RotorNacelleRNA``.
    """

    thrust_coefficient: ThrustCoefficient
    rated_wind_speed: WindSpeed = Field(alias="rated_wind_speed_m_per_s")
    rotor_speed: RotorSpeed | None = Field(alias="rotor_speed_rpm", default=None)
    air_density: Annotated[Positive, Field(ge=0.5, le=2)] = Field(
        alias="air_density_kg_per_m3", default=_STANDARD_AIR
    )
    radius: Annotated[Positive, Field(le=200)] | None = Field(alias="radius_m", default=None)
    blades: Annotated[Integer, Field(ge=1, le=6)] | None = None
    overhang: Annotated[Number, Field(ge=-50, le=50)] | None = Field(
        alias="overhang_m", default=None
    )
    shaft_tilt: Annotated[Number, Field(ge=-30, le=30)] | None = Field(
        alias="shaft_tilt_deg", default=None
    )
    tower_to_shaft: Annotated[NonNegative, Field(le=50)] | None = Field(
        alias="tower_to_shaft_m", default=None
    )
    surrogate: str | None = None

    @model_validator(mode="after")
    def _rated_is_in_the_table(self) -> Rotor:
        first, last = self.thrust_coefficient.wind_speed[0], self.thrust_coefficient.wind_speed[-1]
        if not first < self.rated_wind_speed < last:
            raise ValueError(
                f"rated_wind_speed_m_per_s = {self.rated_wind_speed} is outside the table of the "
                f"thrust coefficient ({first} to {last} m/s); extend the table"
            )
        return self


GEOMETRY = ("radius", "blades", "overhang", "shaft_tilt", "tower_to_shaft")
"""Rotor data that a rigid body does not contain."""
