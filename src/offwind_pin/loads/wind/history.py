"""Rotor-effective wind over time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError


@dataclass(frozen=True, eq=False)
class WindHistory:
    """Rotor-effective wind speed along the shaft, periodic, linear between samples.

    Attributes
    ----------
    interval : float, s
        Interval of the samples.
    speed : (n,) array, m/s
        Samples from time 0; the first one follows the last.
    mean : float, m/s
        Wind speed of the steady state in which the rotor starts.
    origin : str
        Where the numbers come from.
    """

    interval: float
    speed: Array
    mean: float
    origin: str

    def __post_init__(self) -> None:
        speed = np.asarray(self.speed, dtype=float)
        object.__setattr__(self, "speed", speed)
        if speed.ndim != 1 or len(speed) == 0 or not np.all(np.isfinite(speed)):
            raise InputError("wind history", speed.shape, "finite speeds (n,)", "Correct them.")
        if not (np.isfinite(self.interval) and self.interval > 0):
            raise InputError(
                "wind history, interval",
                self.interval,
                "a positive number of seconds",
                "Correct it.",
            )
        if not (np.isfinite(self.mean) and self.mean > 0):
            raise InputError("wind history, mean", self.mean, "a positive speed", "Correct it.")

    @property
    def period(self) -> float:
        """Time in s after which it repeats."""
        return self.interval * len(self.speed)

    def at(self, time: Array | float) -> Array:
        """Speed in m/s at times in s."""
        place = np.mod(np.asarray(time, dtype=float) / self.interval, len(self.speed))
        return np.interp(
            place, np.arange(len(self.speed) + 1), np.append(self.speed, self.speed[0])
        )


def constant_wind(speed: float) -> WindHistory:
    """A constant wind speed in m/s."""
    return WindHistory(1.0, np.array([speed]), speed, f"constant wind of {speed:g} m/s")
