"""Measured surface elevations, and their harmonics for linear waves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from offwind_pin.base.definition import (
    Array,
    ComplexArray,
    Definition,
    Flag,
    Number,
    Numbers,
    Positive,
    key,
    origin_of,
)
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import read_time_columns

HIGHEST_SURFACE = 40.0
"""m; larger than any wave, but exceeded by values in cm or mm and by markers of missing values."""

FEWEST_SAMPLES = 64
_COARSEST = 5.0
"""s, as long as the shortest waves of a sea: longer steps are more likely ms."""

_UNEVEN = 0.02
"""Fraction of a step by which times rounded in a file may deviate from even ones."""

TAPERED = 0.01
"""Default taper at each end, as a fraction of the record."""


class SurfaceRecord(Definition, kw_only=False):
    """Surface elevations at equal intervals from time 0.

    Attributes
    ----------
    dt : float, s
    elevation : (t,) array, m
    origin : str
        Where the numbers come from.
    start : float, s
        First time of the original samples.
    resampled : bool
        Whether the original samples were unevenly spaced.
    """

    dt: Positive = key("dt_s")
    elevation: Annotated[Numbers, Field(min_length=FEWEST_SAMPLES)] = key("elevation_m")
    origin: str
    start: Number = key("start_s", default=0.0)
    resampled: Flag = False

    @property
    def duration(self) -> float:
        """Duration in s after which the record repeats: one step after its last sample."""
        return len(self.elevation) * self.dt

    @staticmethod
    def of(time: Array, elevation: Array, origin: str) -> SurfaceRecord:
        """A record from samples, which are interpolated linearly if they are not evenly spaced.

        Parameters
        ----------
        time : (t,) array, s
            Sample times.
        elevation : (t,) array, m
        origin : str
            Where the numbers come from.

        Returns
        -------
        SurfaceRecord

        Raises
        ------
        InputError
            Too few samples, times that do not rise, implausible elevations.
        """
        if len(time) != len(elevation) or len(time) < FEWEST_SAMPLES:
            received = f"{len(time)} times and {len(elevation)} elevations"
            allowed = f"{FEWEST_SAMPLES} samples or more"
            raise InputError(origin, received, allowed, "Is the record complete?")
        if not (np.all(np.isfinite(time)) and np.all(np.isfinite(elevation))):
            raise InputError(origin, "NaN or infinity", "finite numbers", "Fill the gaps.")
        if np.any(np.diff(time) <= 0):
            raise InputError(origin, "times that do not rise", "rising times", "Sort the rows.")
        worst = float(elevation[np.argmax(np.abs(elevation))])
        if abs(worst) > HIGHEST_SURFACE:
            raise InputError(
                f"{origin}, elevation",
                worst,
                f"-{HIGHEST_SURFACE:g} to {HIGHEST_SURFACE:g} m",
                "Is the unit m? Does a number such as 999.99 mark missing values?",
            )
        if np.ptp(elevation) == 0:
            raise InputError(
                f"{origin}, elevation", worst, "a surface that varies", "Check the record."
            )
        count, dt = len(time), float(time[-1] - time[0]) / (len(time) - 1)
        uneven = np.max(np.abs(time - time[0] - dt * np.arange(count))) > _UNEVEN * dt
        if uneven:
            dt = float(np.median(np.diff(time)))
            even = np.arange(time[0], time[-1] + 1e-9 * dt, dt)
            elevation = np.interp(even, time, elevation)
        return SurfaceRecord(dt, tuple(elevation.tolist()), origin, float(time[0]), bool(uneven))

    def harmonics(
        self, low_cut: float, high_cut: float, taper: float | None = None
    ) -> RecordHarmonics:
        """Harmonics of the record between two frequencies, which linear waves reproduce.

        Mean and linear trend are removed, and the ends are tapered by a cosine so that the record
        can repeat; then frequencies outside the band are removed.

        Parameters
        ----------
        low_cut, high_cut : float, Hz
            Ends of the band.
        taper : float, s, optional
            Length of the taper at each end; by default a hundredth of the record.

        Returns
        -------
        RecordHarmonics
        """
        from scipy.signal.windows import tukey

        n, duration = len(self.elevation), self.duration
        at = np.arange(n) * self.dt
        slope, start = np.polyfit(at, self.elevation, 1)
        level = np.array(self.elevation) - (start + slope * at)
        fade = TAPERED * duration if taper is None else taper
        if fade > 0:
            level = level * tukey(n, min(2 * fade / duration, 1.0))
        lines = np.fft.rfft(level)[: (n + 1) // 2] * 2 / n
        order = np.arange(len(lines), dtype=float)
        kept = (order >= low_cut * duration * (1 - 1e-12)) & (
            order <= high_cut * duration * (1 + 1e-12)
        )
        square = np.abs(lines[1:]) ** 2
        left_out = 1 - np.sum(square[kept[1:]]) / np.sum(square)
        return RecordHarmonics(
            order[kept],
            lines[kept],
            float(np.mean(self.elevation)),
            float(slope * duration),
            float(fade),
            float(left_out),
        )


@dataclass(frozen=True, eq=False)
class RecordHarmonics:
    """Harmonics of a record.

    Attributes
    ----------
    harmonic : (m,) array
        Whole numbers.
    elevation : (m,) complex array
        m Complex amplitudes.
    mean, trend : float, m
        Removed from the record; the trend is over its whole length.
    fade : float, s
        Length of the taper at each end.
    left_out : float
        Fraction of the variance outside the cuts.
    """

    harmonic: Array
    elevation: ComplexArray
    mean: float
    trend: float
    fade: float
    left_out: float


def read_surface_record(path: Path) -> SurfaceRecord:
    """Two columns, time in s and elevation in m; see :func:`read_time_columns`.

    The first line may name the columns.

    Raises
    ------
    InputError
        Missing, empty or short file; a cell that is not a number; times that do not rise, leave a
        gap, or are not in s; elevations beyond any sea.
    """
    table = read_time_columns(path, 2, coarsest=_COARSEST, fewest=FEWEST_SAMPLES, header=True)
    time, elevation = table.values.T
    return SurfaceRecord.of(time, elevation, origin_of(path))
