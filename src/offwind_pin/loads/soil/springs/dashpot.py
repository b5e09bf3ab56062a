"""Dashpots beside soil springs: coefficient over stiffness, C_s = K_s beta_s / (pi f_load)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import inner
from offwind_pin.definitions.soil.springs import DampingCurve, SoilDashpot


@inner
def ratio_at(table: Array, y: float) -> tuple[float, float]:
    """Coefficient over secant stiffness in s at a deflection y >= 0, and its derivative by y.

    table : :attr:`Dashpot.table`; linear in log y between the points
    """
    count = int(table[0])
    if count == 1 or y <= table[1]:
        return table[1 + count], 0.0
    if y >= table[count]:
        return table[2 * count], 0.0
    k = 1
    while y > table[1 + k]:
        k += 1
    low, high = table[count + k], table[count + k + 1]
    slope = (high - low) / np.log(table[1 + k] / table[k])
    return low + slope * np.log(y / table[k]), slope / y


@dataclass(frozen=True, eq=False)
class Dashpot:
    """Coefficients of dashpots relative to springs.

    Attributes
    ----------
    deflection : (b,) array, m or rad
        Rising deflections at which the ratios are given.
    secant_time : (b,) array, s
        beta_s / (pi f_load) there, times the secant stiffness.
    initial_time : float
        Factor of the initial stiffness, the same for all deflections.
    """

    deflection: Array
    secant_time: Array
    initial_time: float = 0.0

    @property
    def table(self) -> Array:
        """(1 + 2 b,) number of points, their deflections and times, for the constants of a load."""
        return np.concatenate([[len(self.deflection)], self.deflection, self.secant_time])

    @staticmethod
    def of(definition: SoilDashpot | None) -> Dashpot:
        """The dashpot of a definition; zero without one."""
        if definition is None:
            return NO_DASHPOT
        unit, factor = 1 / (np.pi * definition.load_frequency), definition.damping_factor
        if isinstance(factor, DampingCurve):
            return Dashpot(np.array(factor.displacement), unit * np.array(factor.factor))
        if definition.stiffness == "initial":
            return Dashpot(np.zeros(1), np.zeros(1), unit * factor)
        return Dashpot(np.zeros(1), np.array([unit * factor]))

    def of_rotations(self, radius: float) -> Dashpot:
        """The dashpot of rotational springs: that of the displacement at a radius in m."""
        return replace(self, deflection=self.deflection / radius)


NO_DASHPOT = Dashpot(np.zeros(1), np.zeros(1))
