"""What the sea does to a system: the water that moves with it, and the waves that pass."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.errors import InputError
from offwind_pin.loads.waves import IrregularSea
from offwind_pin.turbines.definition import Turbine


@dataclass(frozen=True)
class StillWater:
    """Water at rest: added mass, and drag on a structure that moves."""

    def realise(self, turbine: Turbine) -> IrregularSea:
        nothing = np.zeros(0)
        return IrregularSea(nothing, nothing, nothing, -turbine.site.mudline, turbine.site.gravity)


@dataclass(frozen=True)
class IrregularWaves:
    """Pierson-Moskowitz sea travelling along +x.

    significant_height in m, peak_period in s; repeat_period in s should exceed the case's length.
    """

    significant_height: float
    peak_period: float
    seed: int
    repeat_period: float

    def __post_init__(self) -> None:
        for name in ("significant_height", "peak_period", "repeat_period"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"waves, field {name}", value, "a positive number", "Correct it.")
        if self.repeat_period < 5 * self.peak_period:
            allowed = f"at least five peak periods ({5 * self.peak_period} s)"
            raise InputError("waves, field repeat_period", self.repeat_period, allowed, "Raise it.")
        if not (isinstance(self.seed, int) and self.seed >= 0):
            raise InputError("waves, field seed", self.seed, "a whole number from 0", "Correct it.")

    def realise(self, turbine: Turbine) -> IrregularSea:
        return IrregularSea.pierson_moskowitz(
            self.significant_height,
            self.peak_period,
            depth=-turbine.site.mudline,
            gravity=turbine.site.gravity,
            repeat_period=self.repeat_period,
            seed=self.seed,
        )


Sea = StillWater | IrregularWaves
