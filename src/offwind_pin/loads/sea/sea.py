"""Sea states: still water or waves, current, water level."""

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
"""Largest fraction of the variance that an opposing current may block."""


class Sea(Definition):
    """Base class of sea states.

    Attributes
    ----------
    current : UniformCurrent, PowerLawCurrent, SurfaceCurrent, CurrentTable, CurrentSum or None
        A current, or a :class:`CurrentSum` of several.
    water_level : float, m
        Mean height of the surface (tide, surge).
    stretching : {"none", "vertical", "extrapolation", "wheeler"}
        How linear waves act above the mean water level, see the theory page on waves.
    """

    current: CurrentChoice | None = None
    water_level: Annotated[Number, Field(ge=-20, le=20)] = key("water_level_m", default=0.0)
    stretching: Stretching = "none"

    @abstractmethod
    def waves(self, depth: float, gravity: float) -> WaveField | None:
        """Waves of this sea.

        Parameters
        ----------
        depth : float, m
            From the mudline to the mean water level.
        gravity : float, m/s2

        Returns
        -------
        WaveField or None
            None without waves.
        """

    @property
    @abstractmethod
    def in_words(self) -> str:
        """Short description of the waves for reports."""

    def completed(self, seed: int, duration: float) -> Self:
        """The same sea, with open settings taken from a load case.

        Parameters
        ----------
        seed : int
            Seed of the case.
        duration : float, s
            Length of the case.

        Returns
        -------
        Sea
        """
        return self

    @property
    def has_waves(self) -> bool:
        """Whether there are waves."""
        return True

    @property
    def wave_seed(self) -> int:
        """Seed of the waves, or -1 where nothing is random."""
        return -1

    @property
    def longest_time(self) -> float | None:
        """Time in s after which irregular waves repeat; None for other seas."""
        return None

    @property
    def main_period(self) -> float | None:
        """Period in s of the waves with most of the variance, if known in advance."""
        return None

    @property
    def marked_frequency(self) -> float | None:
        """Frequency in Hz at which spectra of responses mark the waves, or None."""
        return None if self.main_period is None else 1 / self.main_period

    def cautions(self, waves: WaveField) -> list[str]:
        """Cautions about waves that look like a mistake or exceed the limits of their theory.

        Parameters
        ----------
        waves : WaveField
            First-order waves.

        Returns
        -------
        list of str
        """
        return []

    def notes(self) -> list[str]:
        """Notes on changes that were made to the user's numbers.

        Returns
        -------
        list of str
        """
        return []


class DrySea(Definition):
    """No water, in a load case; in Python use None."""

    kind: Literal["dry"] = "dry"


class StillWater(Sea):
    """Water without waves: added mass, and drag on the moving structure."""

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
    """Base class of seas of free linear waves.

    Attributes
    ----------
    order : {1, 2}
        1 for linear waves, 2 to add bound sum- and difference-frequency components.
    doppler : bool
        Whether the current carries the waves. Frequencies are then those of a fixed observer, and
        wave lengths those in a uniform current equal to the depth mean along each wave. Wave
        heights are not changed.
    """

    order: Order = 1
    doppler: Flag = False

    @model_validator(mode="after")
    def _doppler_has_a_current(self) -> Self:
        if self.doppler and self.order == 2:
            raise ValueError(
                "doppler cannot be combined with order 2, since second-order theory assumes "
                "water at rest; leave one of them out"
            )
        if self.doppler and self.current is None:
            raise ValueError("doppler requires a current; give one, or leave doppler out")
        return self

    def waves(self, depth: float, gravity: float) -> LinearWaves | SecondOrderWaves:
        waves = self.linear(depth, gravity)
        return waves if self.order == 1 else SecondOrderWaves(waves)

    @abstractmethod
    def linear(self, depth: float, gravity: float) -> LinearWaves:
        """Free first-order waves, from which higher orders follow.

        Parameters
        ----------
        depth : float, m
            From the mudline to the mean water level.
        gravity : float, m/s2

        Returns
        -------
        LinearWaves
        """

    def free_waves(
        self,
        period: float,
        harmonic: Array,
        elevation: ComplexArray,
        depth: float,
        gravity: float,
        direction: Array | float,
    ) -> LinearWaves:
        """Wave components as in :meth:`LinearWaves.free`, carried by the current if ``doppler`` is
        set.

        Parameters
        ----------
        period : float, s
            After which the waves repeat.
        harmonic : (m,) array
            Harmonics of 1 / period.
        elevation : (m,) complex array, m
            Complex amplitudes of the surface.
        depth : float, m
        gravity : float, m/s2
        direction : (m,) array or float, rad
            Towards which the waves travel.

        Returns
        -------
        LinearWaves

        Raises
        ------
        InputError
            The current blocks too large a part of the waves.
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
                "Check the current and its direction.",
            )
        return waves

    @property
    def theory_in_words(self) -> str:
        """Suffix to the description: empty for linear waves not carried by the current."""
        order = ", to second order" if self.order == 2 else ""
        return f"{order}, carried by the current" if self.doppler else order

    def cautions(self, waves: WaveField) -> list[str]:
        if isinstance(waves, LinearWaves) and waves.blocked > 0:
            return [
                f"the opposing current blocks the shortest waves, {100 * waves.blocked:.2g} % of "
                "the variance; they are omitted"
            ]
        return []


class RegularWaves(LinearSea, kw_only=False):
    """A linear regular wave with a crest at the axis at time 0.

    Attributes
    ----------
    height : float, m
        From trough to crest.
    period : float, s
    direction_deg : float
        Direction of travel in degrees from +x towards +y.
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
    """A regular wave by stream function theory, exact up to its surface.

    The wave is carried by the depth mean of the current along it; the current's full profile acts
    on the structure.

    Attributes
    ----------
    height : float, m
        From trough to crest.
    period : float, s
        Period for a fixed observer.
    direction_deg : float
        Direction of travel in degrees from +x towards +y.
    crest_time : float, s
        Time at which a crest is at the axis.
    order : int or None
        Order of the series; None chooses a sufficient one.
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
