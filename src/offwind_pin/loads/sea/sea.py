"""What the sea is: water at rest or in waves, on a current, at a level."""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import (
    Array,
    ComplexArray,
    Definition,
    Direction,
    Flag,
    Integer,
    Number,
    Positive,
    key,
)
from offwind_pin.base.errors import InputError
from offwind_pin.loads.sea.current import CurrentChoice, mean_velocity
from offwind_pin.loads.sea.kinematics import Stretching
from offwind_pin.loads.sea.waves.fourier_wave import SteadyWave
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.second_order import SecondOrderWaves
from offwind_pin.loads.sea.waves.spectra import WavePeriod
from offwind_pin.loads.sea.waves.stream_function import StreamFunctionWaves
from offwind_pin.loads.sea.waves.warnings import regular_wave_cautions
from offwind_pin.loads.sea.waves.wave_field import WaveField

WaveHeight = Annotated[Positive, Field(le=40)]
Order = Literal[1, 2]

MOST_BLOCKED = 0.05
"""Of the variance, that an opposing current may stop."""


class Sea(Definition):
    """What all seas have.

    Attributes
    ----------
    current : UniformCurrent, PowerLawCurrent, SurfaceCurrent, CurrentTable, CurrentSum or None
        One current, a :class:`CurrentSum` of several, or None.
    water_level : float, m
        Mean height of the surface (tide, surge).
    stretching : {"none", "vertical", "extrapolation", "wheeler"}
        How linear waves act above the mean water level, see :class:`WaterSeries`.
    """

    current: CurrentChoice | None = None
    water_level: Annotated[Number, Field(ge=-20, le=20)] = key("water_level_m", default=0.0)
    stretching: Stretching = "none"

    @abstractmethod
    def waves(self, depth: float, gravity: float) -> WaveField | None:
        """The waves over a depth in m under a gravity in m/s2, or None for none."""

    @property
    @abstractmethod
    def in_words(self) -> str:
        """Short description of the waves for reports."""

    def completed(self, seed: int, duration: float) -> Self:
        """The same sea with what a load case gives where it is left open.

        Parameters
        ----------
        seed : int
            Of the case.
        duration : float, s
            Of the case.
        """
        return self

    @property
    def has_waves(self) -> bool:
        return True

    @property
    def wave_seed(self) -> int:
        """Seed of the waves, or -1 where nothing is random."""
        return -1

    @property
    def longest_time(self) -> float | None:
        """Time in s after which irregular waves repeat; None where that does not matter."""
        return None

    @property
    def main_period(self) -> float | None:
        """Period in s of the waves that have most of the variance, if known beforehand."""
        return None

    @property
    def marked_frequency(self) -> float | None:
        """Frequency in Hz at which spectra of responses mark the waves, or None."""
        return None if self.main_period is None else 1 / self.main_period

    def cautions(self, waves: WaveField) -> list[str]:
        """Sentences about its waves where they look like a mistake, or leave their theory.

        waves : those of first order
        """
        return []

    def notes(self) -> list[str]:
        """Sentences about what was done to the numbers that the user gave."""
        return []


class DrySea(Definition):
    """No water, in a load case; in Python the sea is then None."""

    kind: Literal["dry"] = "dry"


class StillWater(Sea):
    """Water without waves: added mass, and drag on a structure that moves."""

    kind: Literal["still_water"] = "still_water"
    stretching: Literal["none"] = "none"

    def waves(self, depth: float, gravity: float) -> None:
        return None

    @property
    def has_waves(self) -> bool:
        return False

    @property
    def in_words(self) -> str:
        return "still water"


class LinearSea(Sea):
    """What seas of free linear waves have.

    Attributes
    ----------
    order : {1, 2}
        1 for linear waves, 2 for their bound components at sums and differences of frequencies as
        well, see :class:`SecondOrderWaves`.
    doppler : bool
        Whether the current carries the waves. Then their frequencies are those that a fixed
        observer sees, and their lengths those on water that flows everywhere as the current does in
        the mean over the depth, along each of them. The heights stay those given.
    """

    order: Order = 1
    doppler: Flag = False

    @model_validator(mode="after")
    def _doppler_has_a_current(self) -> Self:
        if self.doppler and self.order == 2:
            raise ValueError(
                "doppler and order 2 exclude each other: waves of second order are those on water "
                "at rest; leave one of them out"
            )
        if self.doppler and self.current is None:
            raise ValueError("doppler needs a current; give one, or leave doppler out")
        return self

    def waves(self, depth: float, gravity: float) -> LinearWaves | SecondOrderWaves:
        waves = self.linear(depth, gravity)
        return waves if self.order == 1 else SecondOrderWaves(waves)

    @abstractmethod
    def linear(self, depth: float, gravity: float) -> LinearWaves:
        """The free waves of first order, from which those of any higher order follow."""

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
        InputError
            The current blocks too much of the waves.
        """
        if not self.doppler or self.current is None:
            return LinearWaves.free(period, harmonic, elevation, depth, gravity, direction)
        mean = mean_velocity(self.current, depth)
        waves = LinearWaves.in_current(period, harmonic, elevation, depth, gravity, direction, mean)
        if waves.blocked > MOST_BLOCKED:
            raise InputError(
                "sea, field doppler",
                f"an opposing current that blocks {100 * waves.blocked:.3g} % of the variance",
                f"at most {100 * MOST_BLOCKED:g} %",
                "Such waves cannot reach the structure: check the current and its direction.",
            )
        return waves

    @property
    def theory_in_words(self) -> str:
        """What follows the waves' name: nothing for linear waves that no current carries."""
        order = ", to second order" if self.order == 2 else ""
        return f"{order}, carried by the current" if self.doppler else order

    def cautions(self, waves: WaveField) -> list[str]:
        if isinstance(waves, LinearWaves) and waves.blocked > 0:
            return [
                f"the opposing current blocks {100 * waves.blocked:.2g} % of the variance, in the "
                "shortest waves; they are left out"
            ]
        return []


class RegularWaves(LinearSea, kw_only=False):
    """A linear wave of one height and period, its crest at the axis at time 0.

    Attributes
    ----------
    height : float, m
        From trough to crest.
    period : float, s
    direction_deg : float
        Degrees from +x towards +y, in which it travels.
    """

    kind: Literal["regular_waves"] = Field(default="regular_waves", kw_only=True)
    height: WaveHeight = key("height_m")
    period: WavePeriod = key("period_s")
    direction_deg: Direction = 0.0

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
        own = regular_wave_cautions(self.height, k, waves.depth, self.order)
        return super().cautions(waves) + own

    @property
    def in_words(self) -> str:
        return f"regular waves, {self.height:g} m high, {self.period:g} s{self.theory_in_words}"


class StreamWaves(Sea, kw_only=False):
    """A steep regular wave by stream function theory, exact up to its surface.

    The wave is carried by the mean over the depth of the current along it; the current's own
    profile acts on the structure.

    Attributes
    ----------
    height : float, m
        From trough to crest.
    period : float, s
        As a fixed observer sees it.
    direction_deg : float
        Degrees from +x towards +y, in which it travels.
    crest_time : float, s
        At which its crest is at the axis.
    order : int or None
        Of the series, or None for one that is large enough.
    """

    kind: Literal["stream_function_waves"] = Field(default="stream_function_waves", kw_only=True)
    stretching: Literal["none"] = Field(default="none", kw_only=True)
    height: WaveHeight = key("height_m")
    period: WavePeriod = key("period_s")
    direction_deg: Direction = 0.0
    crest_time: Number = key("crest_time_s", default=0.0)
    order: Annotated[Integer, Field(ge=2, le=128)] | None = None

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
