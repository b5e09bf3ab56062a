"""Steady thrust of a rotor: thrust coefficient over the wind speed, and induction."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.definitions.rotor_disc import RotorDisc, rotor_disc
from offwind_pin.definitions.turbine import Turbine

_HIGH_THRUST = 0.96
"""Thrust coefficient at which momentum theory gives an induction of 0.4."""


@kernel
def thrust_coefficient(table: Array, wind: float) -> tuple[float, float]:
    """Thrust coefficient of a table at a wind speed, and its slope; constant beyond both ends.

    table : number of pieces, the wind speeds between them, and four coefficients per piece, the
        cubic one first
    """
    pieces = int(table[0])
    speeds, cubics = table[1 : pieces + 2], table[pieces + 2 :]
    outside = wind <= speeds[0] or wind >= speeds[pieces]
    x = min(max(wind, speeds[0]), speeds[pieces])
    i = 0
    while i < pieces - 1 and x >= speeds[i + 1]:
        i += 1
    t = x - speeds[i]
    c3, c2, c1, c0 = cubics[4 * i], cubics[4 * i + 1], cubics[4 * i + 2], cubics[4 * i + 3]
    slope = 0.0 if outside else (3 * c3 * t + 2 * c2) * t + c1
    return ((c3 * t + c2) * t + c1) * t + c0, slope


@kernel
def induction(coefficient: float) -> tuple[float, float]:
    """Induction factor of a thrust coefficient, and its slope.

    Ct = 4 a (1 - a) of momentum theory up to 0.96, beyond it Ct = 8/9 - 4 a / 9 + 14 a^2 / 9 (Buhl
    2005, NREL/TP-500-36834, without tip loss), which continues it smoothly.
    """
    if coefficient <= _HIGH_THRUST:
        root = np.sqrt(1 - coefficient)
        return (1 - root) / 2, 1 / (4 * root)
    root = np.sqrt(14 * coefficient - 12)
    return (2 + 3 * root) / 14, 1.5 / root


class ThrustTable:
    """A rotor's thrust coefficient over the wind speed: monotone cubics through the table.

    Their slope is continuous, and they do not overshoot between entries (Fritsch and Carlson 1980).
    """

    def __init__(self, disc: RotorDisc) -> None:
        from scipy.interpolate import PchipInterpolator

        table = disc.rotor.thrust_coefficient
        cubics = PchipInterpolator(table.wind_speed, table.value)
        self.numbers: Array = np.concatenate(
            [[len(table.wind_speed) - 1], table.wind_speed, cubics.c.T.ravel()]
        )

    def coefficient(self, wind_speed: float) -> tuple[float, float]:
        """Thrust coefficient at a wind speed in m/s, and its slope in s/m."""
        value, slope = thrust_coefficient(self.numbers, wind_speed)
        return float(value), float(slope)

    def induction(self, wind_speed: float) -> tuple[float, float]:
        """Induction factor at a wind speed in m/s, and its slope by the thrust coefficient."""
        value, slope = induction(self.coefficient(wind_speed)[0])
        return float(value), float(slope)


def thrust_curve(rotor: Turbine | RotorDisc, wind_speeds: Array) -> Array:
    """Steady thrust over the wind speed.

    Parameters
    ----------
    rotor : Turbine or RotorDisc
    wind_speeds : (n,) array, m/s

    Returns
    -------
    (n,) array, N

    Raises
    ------
    InputError
        A turbine without a block ``rotor``.
    """
    disc = rotor_disc(rotor) if isinstance(rotor, Turbine) else rotor
    table = ThrustTable(disc)
    speeds = np.asarray(wind_speeds, dtype=float)
    coefficients = np.array([table.coefficient(speed)[0] for speed in speeds])
    return disc.rotor.air_density * disc.area / 2 * coefficients * speeds**2


def inflow_time(disc: RotorDisc, wind_speed: float) -> float:
    """Time constant in s with which the induced velocity follows: 1.1 R / ((1 - 1.3 a) U).

    The slow time constant of Oye's model (Snel and Schepers 1995, ECN-C--94-107), with a limited to
    0.5. The second, faster lag of the model is omitted.
    """
    a = min(ThrustTable(disc).induction(wind_speed)[0], 0.5)
    return 1.1 * disc.radius / ((1 - 1.3 * a) * wind_speed)
