"""Measured surface elevations, and the harmonics that linear waves replay them with."""

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
"""m; beyond any sea, but what cm, mm and marks of missing values give."""

FEWEST_SAMPLES = 64
_COARSEST = 5.0
"""s, as long as the shortest waves of a sea: longer steps are more likely ms."""

_UNEVEN = 0.02
"""Of a step, by which times rounded in a file may depart from even ones."""

TAPERED = 0.01
"""Of the record at each end, over which it fades unless another taper is given."""


class SurfaceRecord(Definition, kw_only=False):
    """Surface elevations at even times from 0 on.

    Attributes
    ----------
    dt : float, s
    elevation : (t,) array, m
    origin : str
        Where the numbers come from.
    start : float, s
        The first time of the samples it was made from.
    resampled : bool
        Whether those were not even.
    """

    dt: Positive = key("dt_s")
    elevation: Annotated[Numbers, Field(min_length=FEWEST_SAMPLES)] = key("elevation_m")
    origin: str
    start: Number = key("start_s", default=0.0)
    resampled: Flag = False

    @property
    def duration(self) -> float:
        """In s, after which the record repeats: one step after its last sample."""
        return len(self.elevation) * self.dt

    @staticmethod
    def of(time: Array, elevation: Array, origin: str) -> SurfaceRecord:
        """From samples (t,) at times (t,) in s, which are interpolated linearly if not even.

        Raises
        ------
        InputError
            Too few samples, times that do not rise, numbers that are no elevations in m.
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
            raise InputError(f"{origin}, elevation", worst, "a surface that moves", "Check it.")
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
        """What linear waves replay: the record between two frequencies in Hz.

        Mean and linear trend are taken off, the ends fade over a taper in s by a cosine (by default
        over a hundredth of the record), so that the record may repeat; then all frequencies beyond
        the cuts are left out.
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
    """Of a record's length.

    Attributes
    ----------
    harmonic : (m,) array
        Whole numbers.
    elevation : (m,) complex array
        m Complex amplitudes.
    mean, trend : float, m
        Taken off; the trend over the whole record.
    fade : float, s
        Over which each end was faded.
    left_out : float
        Share of the variance beyond the cuts.
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
