"""Mean wind over height, and its gusts in time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError

LOWEST = 1.0
"""Height in m above the water below which a profile stays as it is there: waves are in its way."""

GUST_PERIOD = 10.5
"""Length of the extreme operating gust in s (IEC 61400-1:2005, 6.3.2.2)."""


def check_positive(where: str, value: float, *, zero: bool = False) -> None:
    """A finite number above zero, or from zero on.

    Raises
    ------
    InputError : it is not
    """
    if not (np.isfinite(value) and (value > 0 or (zero and value == 0))):
        allowed = "a number from 0" if zero else "a positive number"
        raise InputError(where, value, allowed, "Correct it.")


@dataclass(frozen=True)
class PowerLaw:
    """Wind that grows with a power of height, (z / z_ref)^exponent (IEC 61400-1:2005, Eq. 10).

    IEC 61400-3-1 takes an exponent of 0.14 for the normal wind at sea.
    """

    exponent: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.exponent) and 0 <= self.exponent <= 1):
            raise InputError("power law, exponent", self.exponent, "0 to 1", "Correct it.")

    def ratio(self, height: Array, reference: float) -> Array:
        """(n,) speed at heights above the water over that at the reference height, both in m."""
        above = np.maximum(height, LOWEST) / reference
        return np.asarray(above**self.exponent)


@dataclass(frozen=True)
class LogLaw:
    """Wind that grows with the logarithm of height, ln(z / z0) / ln(z_ref / z0).

    roughness : z0 in m; 0.001 and less over water
    """

    roughness: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.roughness) and 0 < self.roughness < LOWEST / 2):
            allowed = f"a length in m between 0 and {LOWEST / 2}"
            raise InputError("log law, roughness", self.roughness, allowed, "Correct it.")

    def ratio(self, height: Array, reference: float) -> Array:
        """(n,) speed at heights above the water over that at the reference height, both in m."""
        above = np.log(np.maximum(height, LOWEST) / self.roughness)
        return np.asarray(above / np.log(reference / self.roughness))


Profile = PowerLaw | LogLaw


@dataclass(frozen=True)
class ExtremeOperatingGust:
    """IEC's gust: a dip, a peak and a dip, V - 0.37 V_gust sin(3 pi t/T) (1 - cos(2 pi t/T)).

    IEC 61400-1:2005, 6.3.2.2, Eq. 17 (size) and 18 (shape). It is the same at all heights.

    size : V_gust in m/s; start : of the gust in s; period : T in s
    """

    size: float
    start: float
    period: float = GUST_PERIOD

    def __post_init__(self) -> None:
        check_positive("gust, size", self.size)
        check_positive("gust, start", self.start, zero=True)
        check_positive("gust, period", self.period)

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
        """The gust of a turbine class, V_gust = min(1.35 (V_e1 - V_hub), 3.3 s / (1 + 0.1 D / L)).

        V_e1 = 0.8 * 1.4 V_ref at hub height (Eq. 14 and 15), s = I_ref (0.75 V_hub + 5.6 m/s)
        (Eq. 11), and L = 0.7 z_hub, 42 m at most (Eq. 5).

        hub_speed, reference_speed : V_hub and V_ref in m/s; hub_height, rotor_diameter : in m;
        turbulence : I_ref, a fraction

        Raises
        ------
        InputError : a number that is not positive, or a wind above the extreme one
        """
        for name, value in (
            ("hub_speed", hub_speed),
            ("hub_height", hub_height),
            ("rotor_diameter", rotor_diameter),
            ("reference_speed", reference_speed),
            ("turbulence", turbulence),
        ):
            check_positive(f"gust, {name}", value)
        of_a_year = 0.8 * 1.4 * reference_speed
        if hub_speed >= of_a_year:
            allowed = f"less than the extreme wind of a year ({of_a_year:g} m/s)"
            raise InputError("gust, hub_speed", hub_speed, allowed, "Lower it.")
        scatter = turbulence * (0.75 * hub_speed + 5.6)
        scale = min(0.7 * hub_height, 42.0)
        size = min(
            1.35 * (of_a_year - hub_speed), 3.3 * scatter / (1 + 0.1 * rotor_diameter / scale)
        )
        return ExtremeOperatingGust(size, start)

    def at(self, time: Array) -> Array:
        """(t,) departure from the mean wind in m/s."""
        phase = np.clip((np.asarray(time) - self.start) / self.period, 0.0, 1.0)
        shape = np.sin(3 * np.pi * phase) * (1 - np.cos(2 * np.pi * phase))
        return np.asarray(-0.37 * self.size * shape)


@dataclass(frozen=True, eq=False)
class WindSeries:
    """Departures of the wind from its mean, in m/s; linear in between, the ends hold beyond.

    time (t,) in s, rising; departure (t,) in m/s, the same at all heights
    """

    time: Array
    departure: Array

    def __post_init__(self) -> None:
        time, departure = np.asarray(self.time, float), np.asarray(self.departure, float)
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "departure", departure)
        if time.ndim != 1 or time.shape != departure.shape or len(time) < 2:
            shapes = f"time {time.shape}, departure {departure.shape}"
            raise InputError("wind series", shapes, "two rows of one length", "Reshape them.")
        if not (np.all(np.isfinite(time)) and np.all(np.isfinite(departure))):
            raise InputError("wind series", "NaN or infinity", "finite numbers", "Correct them.")
        if np.any(np.diff(time) <= 0):
            raise InputError("wind series, time", time.tolist(), "rising times", "Sort them.")

    def at(self, time: Array) -> Array:
        """(t,) departure from the mean wind in m/s."""
        return np.interp(time, self.time, self.departure)


Gust = ExtremeOperatingGust | WindSeries
