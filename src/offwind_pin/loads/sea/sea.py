"""What the sea is: water at rest or in waves, on a current, at a level."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.base.errors import InputError
from offwind_pin.loads.sea.current import Current, CurrentSum, mean_velocity
from offwind_pin.loads.sea.kinematics import Stretching
from offwind_pin.loads.sea.waves.fourier_wave import SteadyWave
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.second_order import SecondOrderWaves
from offwind_pin.loads.sea.waves.spectra import require_positive
from offwind_pin.loads.sea.waves.stream_function import StreamFunctionWaves
from offwind_pin.loads.sea.waves.warnings import regular_wave_cautions
from offwind_pin.loads.sea.waves.wave_field import WaveField

Order = Literal[1, 2]

MOST_BLOCKED = 0.05
"""Of the variance, that an opposing current may stop."""


@dataclass(frozen=True, kw_only=True)
class Sea(ABC):
    """What all seas have.

    Attributes
    ----------
    current : over height, or None for none
    water_level : mean height of the surface in m (tide, surge)
    stretching : how linear waves act above the mean water level, see :class:`WaterSeries`
    """

    current: Current | CurrentSum | None = None
    water_level: float = 0.0
    stretching: Stretching = "none"

    @abstractmethod
    def waves(self, depth: float, gravity: float) -> WaveField | None:
        """The waves over a depth in m under a gravity in m/s2, or None for none."""

    @property
    @abstractmethod
    def in_words(self) -> str:
        """The waves as a reader is told of them."""

    @property
    def wave_seed(self) -> int:
        """What draws the waves, or -1 where nothing is drawn."""
        return -1

    @property
    def longest_time(self) -> float | None:
        """In s, after which waves that should not repeat do so; None where that is no matter."""
        return None

    @property
    def main_period(self) -> float | None:
        """In s, of the waves that hold most of the variance, if it is known beforehand."""
        return None

    def cautions(self, waves: WaveField) -> list[str]:
        """Sentences about its waves where they look like a mistake, or leave their theory.

        waves : those of first order
        """
        return []

    def notes(self) -> list[str]:
        """Sentences about what was done to the numbers that the user gave."""
        return []


@dataclass(frozen=True, kw_only=True)
class LinearSea(Sea):
    """What seas of free linear waves have.

    order : 1 for linear waves, 2 for what every two of them bind at the sums and differences of
        their frequencies as well, see :class:`SecondOrderWaves`
    doppler : whether the current carries the waves. Then their frequencies are those that a fixed
        observer sees, and their lengths those on water that flows everywhere as the current does
        in the mean over the depth, along each of them. The heights stay those given.
    """

    order: Order = 1
    doppler: bool = False

    def __post_init__(self) -> None:
        if self.order not in get_args(Order):
            raise InputError("waves, field order", self.order, "1 or 2", "Choose one.")
        if self.order == 2 and self.doppler:
            raise InputError(
                "waves, field order",
                "2 with doppler",
                "waves of second order on water at rest",
                "Leave doppler out, or use order 1; the current itself may stay.",
            )
        if self.doppler and self.current is None:
            raise InputError(
                "waves, field doppler",
                "no current",
                "a current that carries the waves",
                "Give one, or leave doppler out.",
            )

    def waves(self, depth: float, gravity: float) -> LinearWaves | SecondOrderWaves:
        waves = self.linear(depth, gravity)
        return waves if self.order == 1 else SecondOrderWaves(waves)

    @abstractmethod
    def linear(self, depth: float, gravity: float) -> LinearWaves:
        """The free waves of first order, of which those of any higher order follow."""

    def free_waves(
        self,
        period: float,
        harmonic: Array,
        elevation: ComplexArray,
        depth: float,
        gravity: float,
        direction: Array | float,
    ) -> LinearWaves:
        """Components as :meth:`LinearWaves.free` has them, in the current if that carries them.

        Raises
        ------
        InputError : the current blocks too much of the waves
        """
        if not self.doppler or self.current is None:
            return LinearWaves.free(period, harmonic, elevation, depth, gravity, direction)
        mean = mean_velocity(self.current, depth)
        waves = LinearWaves.in_current(period, harmonic, elevation, depth, gravity, direction, mean)
        if waves.blocked > MOST_BLOCKED:
            raise InputError(
                "waves, field doppler",
                f"an opposing current that blocks {100 * waves.blocked:.3g} % of the variance",
                f"at most {100 * MOST_BLOCKED:g} %",
                "Such waves cannot reach the structure: check the current and its direction.",
            )
        return waves

    @property
    def theory_in_words(self) -> str:
        """What follows the waves' name: nothing for linear waves that no current carries."""
        told = ", to second order" if self.order == 2 else ""
        return f"{told}, carried by the current" if self.doppler else told

    def cautions(self, waves: WaveField) -> list[str]:
        if isinstance(waves, LinearWaves) and waves.blocked > 0:
            return [
                f"the opposing current blocks {100 * waves.blocked:.2g} % of the variance, in the "
                "shortest waves; they are left out"
            ]
        return []


@dataclass(frozen=True)
class StillWater(Sea):
    """Water without waves: added mass, and drag on a structure that moves."""

    def waves(self, depth: float, gravity: float) -> None:
        return None

    @property
    def in_words(self) -> str:
        return "still water"


@dataclass(frozen=True)
class RegularWaves(LinearSea):
    """A linear wave of one height and period, its crest at the axis at time 0.

    height in m from trough to crest, period in s, direction_deg in which it travels, from +x
    towards +y.
    """

    height: float
    period: float
    direction_deg: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("height", "period"):
            require_positive(f"waves, field {name}", getattr(self, name))
        require_angle(self.direction_deg)

    def linear(self, depth: float, gravity: float) -> LinearWaves:
        return self.free_waves(
            self.period,
            np.ones(1),
            np.array([self.height / 2 + 0j]),
            depth,
            gravity,
            float(np.radians(self.direction_deg)),
        )

    @property
    def main_period(self) -> float:
        return self.period

    def cautions(self, waves: WaveField) -> list[str]:
        k = float(waves.wave_number[0])
        told = regular_wave_cautions(self.height, k, waves.depth, self.order)
        return super().cautions(waves) + told

    @property
    def in_words(self) -> str:
        return f"regular waves, {self.height:g} m high, {self.period:g} s{self.theory_in_words}"


@dataclass(frozen=True)
class StreamWaves(Sea):
    """A steep regular wave by stream function theory, exact up to its surface.

    The wave is carried by the mean over the depth of the current along it; the current's own
    profile acts on the structure.

    height in m from trough to crest, period in s as a fixed observer sees it, direction_deg in
    which it travels from +x towards +y, crest_time in s at which its crest is at the axis, order of
    the series or None for one that is large enough
    """

    height: float
    period: float
    direction_deg: float = 0.0
    crest_time: float = 0.0
    order: int | None = None

    def __post_init__(self) -> None:
        require_angle(self.direction_deg)
        if not np.isfinite(self.crest_time):
            where = "waves, field crest_time"
            raise InputError(where, self.crest_time, "a time in s", "Correct it.")

    def waves(self, depth: float, gravity: float) -> StreamFunctionWaves:
        angle = float(np.radians(self.direction_deg))
        along = 0.0
        if self.current is not None:
            mean = mean_velocity(self.current, depth)
            along = float(mean @ [np.cos(angle), np.sin(angle), 0.0])
        wave = SteadyWave.solve(
            self.height,
            period=self.period,
            depth=depth,
            gravity=gravity,
            eulerian_current=along,
            order=self.order,
        )
        return StreamFunctionWaves(wave, direction=angle, crest_time=self.crest_time)

    @property
    def main_period(self) -> float:
        return self.period

    @property
    def in_words(self) -> str:
        return f"stream function wave, {self.height:g} m high, {self.period:g} s"


def require_angle(direction_deg: float) -> None:
    """Refuse what is no direction of waves."""
    if not np.isfinite(direction_deg):
        where = "waves, field direction_deg"
        raise InputError(where, direction_deg, "an angle in degrees", "Correct it.")
