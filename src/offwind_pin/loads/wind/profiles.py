"""Mean wind over height, and its gusts in time."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Discriminator, Field, Tag, model_validator

from offwind_pin.base.definition import (
    Array,
    Definition,
    NonNegative,
    Numbers,
    Positive,
    key,
)
from offwind_pin.base.errors import InputError

LOWEST = 1.0
"""Height in m above the water below which a profile is constant, since waves disturb it."""

GUST_PERIOD = 10.5
"""Length of the extreme operating gust in s (IEC 61400-1:2005, 6.3.2.2)."""


class PowerLaw(Definition, kw_only=False):
    """Wind profile (z / z_ref)^exponent (IEC 61400-1:2005, Eq. 10).

    IEC 61400-3-1 uses an exponent of 0.14 for the normal wind at sea.

    Attributes
    ----------
    exponent : float
    """

    kind: Literal["power_law"] = Field(default="power_law", kw_only=True)
    exponent: Annotated[NonNegative, Field(le=1)] = 0.14

    def ratio(self, height: Array, reference: float) -> Array:
        """Wind speed over that at the reference height.

        Parameters
        ----------
        height : (n,) array, m
            Above the water.
        reference : float, m
            Reference height above the water.

        Returns
        -------
        (n,) array
        """
        above = np.maximum(height, LOWEST) / reference
        return np.asarray(above**self.exponent)


class LogLaw(Definition, kw_only=False):
    """Wind profile ln(z / z0) / ln(z_ref / z0).

    Attributes
    ----------
    roughness : float, m
        z0; 0.001 and less over water.
    """

    kind: Literal["log_law"] = Field(default="log_law", kw_only=True)
    roughness: Annotated[Positive, Field(lt=LOWEST / 2)] = key("roughness_m")

    def ratio(self, height: Array, reference: float) -> Array:
        """Wind speed over that at the reference height.

        Parameters
        ----------
        height : (n,) array, m
            Above the water.
        reference : float, m
            Reference height above the water.

        Returns
        -------
        (n,) array
        """
        above = np.log(np.maximum(height, LOWEST) / self.roughness)
        return np.asarray(above / np.log(reference / self.roughness))


Profile = Annotated[PowerLaw | LogLaw, Field(discriminator="kind")]


class ExtremeOperatingGust(Definition, kw_only=False):
    """IEC's gust: a dip, a peak and a dip, V - 0.37 V_gust sin(3 pi t/T) (1 - cos(2 pi t/T)).

    IEC 61400-1:2005, 6.3.2.2, Eq. 17 (size) and 18 (shape). It is the same at all heights.

    Attributes
    ----------
    size : float, m/s
        V_gust.
    start : float, s
        Start of the gust.
    period : float, s
        T.
    """

    size: Annotated[Positive, Field(le=60)] = key("size_m_per_s")
    start: NonNegative = key("start_s")
    period: Positive = key("period_s", default=GUST_PERIOD)

    @staticmethod
    def of_class(
        hub_speed: float,
        hub_height: float,
        rotor_diameter: float,
        *,
        reference_speed: float,
        turbulence: float,
        start: float,
    ) -> ExtremeOperatingGust:
        """Gust of a turbine class, V_gust = min(1.35 (V_e1 - V_hub), 3.3 s / (1 + 0.1 D / L)).

        V_e1 = 0.8 * 1.4 V_ref at hub height (Eq. 14 and 15), s = I_ref (0.75 V_hub + 5.6 m/s) (Eq.
        11), and L = 0.7 z_hub, 42 m at most (Eq. 5).

        Parameters
        ----------
        hub_speed : float, m/s
            V_hub.
        hub_height, rotor_diameter : float, m
        reference_speed : float, m/s
            V_ref.
        turbulence : float
            I_ref, a fraction.
        start : float, s
            Start of the gust.

        Returns
        -------
        ExtremeOperatingGust

        Raises
        ------
        InputError
            A number that is not positive, or a wind above the extreme wind speed.
        """
        for name, value in (
            ("hub_speed", hub_speed),
            ("hub_height", hub_height),
            ("rotor_diameter", rotor_diameter),
            ("reference_speed", reference_speed),
            ("turbulence", turbulence),
        ):
            if not 0 < value < np.inf:
                raise InputError(f"gust, {name}", value, "a positive number", "Correct it.")
        of_a_year = 0.8 * 1.4 * reference_speed
        if hub_speed >= of_a_year:
            allowed = f"less than the one-year extreme wind speed ({of_a_year:g} m/s)"
            raise InputError("gust, hub_speed", hub_speed, allowed, "Lower it.")
        scatter = turbulence * (0.75 * hub_speed + 5.6)
        scale = min(0.7 * hub_height, 42.0)
        size = min(
            1.35 * (of_a_year - hub_speed), 3.3 * scatter / (1 + 0.1 * rotor_diameter / scale)
        )
        return ExtremeOperatingGust(size, start)

    def at(self, time: Array) -> Array:
        """Departure from the mean wind.

        Parameters
        ----------
        time : (t,) array, s

        Returns
        -------
        (t,) array, m/s
        """
        phase = np.clip((np.asarray(time) - self.start) / self.period, 0.0, 1.0)
        shape = np.sin(3 * np.pi * phase) * (1 - np.cos(2 * np.pi * phase))
        return np.asarray(-0.37 * self.size * shape)


class WindSeries(Definition, kw_only=False):
    """Departures of the wind from its mean, linear between samples and constant beyond both ends.

    Attributes
    ----------
    time : (t,) array, s
        Rising.
    departure : (t,) array, m/s
        The same at all heights.
    """

    time: Annotated[Numbers, Field(min_length=2)] = key("time_s")
    departure: Numbers = key("departure_m_per_s")

    @model_validator(mode="after")
    def _is_a_series(self) -> WindSeries:
        if len(self.time) != len(self.departure):
            raise ValueError(
                f"the series has {len(self.time)} times and {len(self.departure)} departures; give "
                "one departure per time"
            )
        if np.any(np.diff(self.time) <= 0):
            raise ValueError("the times do not increase strictly; sort them")
        return self

    def at(self, time: Array) -> Array:
        """Departure from the mean wind.

        Parameters
        ----------
        time : (t,) array, s

        Returns
        -------
        (t,) array, m/s
        """
        return np.interp(time, self.time, self.departure)


def _series_or_gust(value: Any) -> str:
    if isinstance(value, dict):
        return "series" if {"time_s", "time"} & value.keys() else "gust"
    return "series" if isinstance(value, WindSeries) else "gust"


Gust = Annotated[
    Annotated[ExtremeOperatingGust, Tag("gust")] | Annotated[WindSeries, Tag("series")],
    Discriminator(_series_or_gust),
]
