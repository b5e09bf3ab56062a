"""Earthquakes: motion of the ground over time, at one or several depths."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError

Baseline = Literal["none", "parabolic"]

LARGEST_ACCELERATION = 100.0
"""m/s2, several times the strongest recorded ground acceleration (about 43 m/s2, Ichinoseki,
2008)."""
_GAP = 5.0
"""Multiple of the median step beyond which samples are missing."""
_MANY = 20
"""Number of steps from which a record counts as sampled rather than as a hand-written table."""


@dataclass(frozen=True, eq=False)
class GroundMotion:
    """Acceleration of the ground, linear between samples, with the resulting motion.

    The ground is at rest before the first sample. After the last its acceleration is zero, and its
    velocity stays constant. Velocity and displacement are exact integrals.

    Attributes
    ----------
    time : (n,) array, s
        Rising.
    acceleration : (n, 3) array, m/s2
        Along x, y, z, or (D, n, 3) at D heights.
    height : (D,) array or None, m
        Rising, from z = 0 at still water level upwards; between them the motion is linear in z.
        None for one motion everywhere.
    baseline : {"none", "parabolic"}
        ``"parabolic"`` subtracts a parabola from each component of the acceleration, so that the
        velocity ends at zero with the smallest possible mean square; after Berg and
        Housner (Bulletin of the Seismological Society of America 51, 1961, pages 175 to 189), who
        do not require zero velocity at the end.
    origin : str
        Where the numbers come from.

    Raises
    ------
    InputError
        Shapes that do not match, numbers that are not finite or implausibly large, times that do
        not rise or leave a gap, heights that do not rise.
    """

    time: Array
    acceleration: Array
    height: Array | None = None
    baseline: Baseline = "none"
    origin: str = "given"

    __repr__ = one_line

    def __post_init__(self) -> None:
        for name in ("time", "acceleration", "height"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, _numbers(name, value))
        self._check_shapes()
        self._check_times()
        largest = float(np.max(np.abs(self.acceleration)))
        if largest > LARGEST_ACCELERATION:
            raise InputError(
                "ground motion, acceleration",
                f"{largest:g} m/s2",
                f"at most {LARGEST_ACCELERATION:g} m/s2",
                "Is the unit m/s2? Accelerograms often come in cm/s2.",
            )
        if self.baseline not in ("none", "parabolic"):
            raise InputError("baseline", self.baseline, "none or parabolic", "Choose one of them.")

    def _check_shapes(self) -> None:
        n = len(self.time) if self.time.ndim == 1 else 0
        expected: tuple[int, ...] = (n, 3)
        if self.height is not None:
            expected = (len(self.height) if self.height.ndim == 1 else 0, n, 3)
        if n < 2 or 0 in expected or self.acceleration.shape != expected:
            raise InputError(
                "ground motion",
                f"time {self.time.shape}, acceleration {self.acceleration.shape}"
                + ("" if self.height is None else f", height {self.height.shape}"),
                "time (n,) of two samples or more, acceleration (n, 3); at height (D,) (D, n, 3)",
                "Give three components, zero where the ground does not move.",
            )
        if self.height is not None and np.any(np.diff(self.height) <= 0):
            raise InputError(
                "ground motion, height", self.height.tolist(), "rising heights", "Sort them."
            )

    def _check_times(self) -> None:
        step = np.diff(self.time)
        if np.any(step <= 0):
            i = int(np.argmax(step <= 0))
            raise InputError(
                "ground motion, time",
                f"{self.time[i + 1]:g} s after {self.time[i]:g} s",
                "rising times",
                "Sort the samples by time and remove repeated ones.",
            )
        usual = float(np.median(step))
        if len(step) >= _MANY and np.max(step) > _GAP * usual:
            i = int(np.argmax(step))
            raise InputError(
                "ground motion, time",
                f"a step of {step[i]:g} s after {self.time[i]:g} s",
                f"steps of about {usual:g} s, as in the rest of the record",
                "Are samples missing?",
            )

    @property
    def levels(self) -> Array:
        """(D,) heights in m; a single 0 for one motion everywhere."""
        return np.zeros(1) if self.height is None else self.height

    @property
    def step(self) -> float:
        """Usual interval between samples in s."""
        return float(np.median(np.diff(self.time)))

    @cached_property
    def corrected(self) -> Array:
        """(D, n, 3) acceleration at the samples after the baseline correction, in m/s2."""
        acceleration = self.acceleration if self.height is not None else self.acceleration[None]
        if self.baseline == "none":
            return acceleration
        parts = [_without_parabola(self.time, level) for level in acceleration]
        return np.array(parts)

    @cached_property
    def _integrals(self) -> tuple[Array, Array]:
        """(D, n, 3) velocity and displacement at the samples in m/s and m."""
        velocity = _velocity(self.time, self.corrected)
        h, a = np.diff(self.time)[:, None], self.corrected
        gained = h * velocity[:, :-1] + h**2 * (2 * a[:, :-1] + a[:, 1:]) / 6
        return velocity, _summed(gained)

    def motion(self, time: Array) -> Array:
        """Motion of the ground.

        Parameters
        ----------
        time : (t,) array, s

        Returns
        -------
        (t, D, 3, 3) array, m, m/s and m/s2
            Displacement, velocity and acceleration along x, y and z at each height.
        """
        time = np.asarray(time, dtype=float)
        velocity, displacement = self._integrals
        at = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        beyond = time > self.time[-1]
        s = np.where(beyond, 0.0, time - self.time[at])[:, None]
        h = (self.time[at + 1] - self.time[at])[:, None]
        moved = []
        for a, v, u in zip(self.corrected, velocity, displacement, strict=True):
            rate = (a[at + 1] - a[at]) / h
            late = (time - self.time[-1])[:, None]
            inside = (
                u[at] + s * v[at] + s**2 * a[at] / 2 + s**3 * rate / 6,
                v[at] + s * a[at] + s**2 * rate / 2,
                a[at] + s * rate,
            )
            after = (u[-1] + late * v[-1], np.tile(v[-1], (len(time), 1)), np.zeros_like(inside[0]))
            moved.append(np.where(beyond[:, None, None], _stacked(after), _stacked(inside)))
        result = np.stack(moved, axis=1)
        result[time < self.time[0]] = 0.0
        return result

    def later(self, start: float) -> GroundMotion:
        """The same motion, delayed.

        Parameters
        ----------
        start : float, s
            Delay.

        Returns
        -------
        GroundMotion
        """
        return replace(self, time=self.time + start)

    def scaled(self, factor: float) -> GroundMotion:
        """The same motion with accelerations multiplied.

        Parameters
        ----------
        factor : float
            Multiplier.

        Returns
        -------
        GroundMotion
        """
        return replace(self, acceleration=factor * self.acceleration)

    def turned(self, angle: float) -> GroundMotion:
        """The same motion rotated about z.

        Parameters
        ----------
        angle : float, rad
            From x towards y.

        Returns
        -------
        GroundMotion
        """
        cosine, sine = np.cos(angle), np.sin(angle)
        turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        return replace(self, acceleration=self.acceleration @ turn.T)


def ground_motion_cautions(motion: GroundMotion, dt: float, duration: float) -> list[str]:
    """Cautions about a ground motion in a simulation of a duration with steps of dt, in s.

    Raises
    ------
    InputError
        It begins after the end of the simulation.
    """
    if motion.time[0] >= duration:
        raise InputError(
            "ground motion, time",
            f"a start at {motion.time[0]:g} s",
            f"a start before the end of the simulation ({duration:g} s)",
            "Reduce the start, or lengthen the simulation.",
        )
    told = []
    if motion.time[0] < 0:
        told.append(
            f"the record begins at {motion.time[0]:g} s, so the simulation starts in the middle of "
            "it, with the structure at rest relative to the moving ground"
        )
    if motion.time[-1] > duration:
        told.append(f"the record ends at {motion.time[-1]:g} s, after the simulation")
    if motion.step > _COARSE:
        told.append(
            f"samples {motion.step:g} s apart are coarse: linear interpolation attenuates "
            f"frequencies above {1 / (8 * motion.step):.2g} Hz by more than 5 %"
        )
    if dt > 1.001 * motion.step:
        told.append(
            f"steps of {dt:g} s skip samples that are {motion.step:g} s apart: frequencies above "
            f"{0.5 / dt:.3g} Hz are aliased"
        )
    if not np.any(motion.acceleration):
        told.append("the record contains only zeros; the ground does not move")
    velocity = motion.motion(motion.time[-1:])[0, :, 1]
    peak = np.max(np.abs(motion.motion(motion.time)[:, :, 1]))
    if np.max(np.abs(velocity)) > _DRIFTING * peak:
        told.append(
            f"the ground still moves at {np.max(np.abs(velocity)):.3g} m/s when the record ends, "
            "and drifts on; use baseline: parabolic to bring it to rest"
        )
    given = motion.acceleration if motion.height is not None else motion.acceleration[None]
    share = np.max(np.abs(motion.corrected - given)) / max(np.max(np.abs(given)), 1e-300)
    if share > _CROOKED:
        told.append(
            f"the baseline correction removes {share:.0%} of the largest acceleration; the record "
            "is distorted, or has too few samples to determine its baseline"
        )
    return told


_COARSE = 0.025
"""s; an eighth of the period of 5 Hz, below which most of an earthquake's energy lies."""
_DRIFTING = 0.02
"""Fraction of the largest velocity that may remain at the end."""
_CROOKED = 0.1
"""Fraction of the largest acceleration that a correction may remove."""


def _numbers(name: str, value: Array) -> Array:
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        array = np.array(np.nan)
    if not np.all(np.isfinite(array)):
        raise InputError(
            f"ground motion, {name}", "invalid numbers", "finite numbers", "Correct them."
        )
    return array


def _stacked(parts: tuple[Array, Array, Array]) -> Array:
    """(t, 3, 3) from three (t, 3)."""
    return np.stack(parts, axis=1)


def _velocity(time: Array, acceleration: Array) -> Array:
    """(..., n, 3) integral of an acceleration that is linear between samples, zero at the first."""
    step = np.diff(time)[:, None]
    return _summed(step * (acceleration[..., :-1, :] + acceleration[..., 1:, :]) / 2)


def _summed(gained: Array) -> Array:
    """(..., n, 3) running sums of (..., n - 1, 3) from zero."""
    whole = np.cumsum(gained, axis=-2)
    return np.concatenate([np.zeros_like(whole[..., :1, :]), whole], axis=-2)


def _without_parabola(time: Array, acceleration: Array) -> Array:
    """(n, 3) acceleration less a parabola in time; see ``GroundMotion.baseline``.

    The parabola is taken at the samples and linear between them, as the acceleration is, so that
    the velocity ends at exactly zero.
    """
    share = (time - time[0]) / (time[-1] - time[0])
    degrees = min(3, len(time))
    shapes = share[:, None] ** np.arange(degrees)
    by_shape = _velocity(time, shapes)
    velocity = _velocity(time, acceleration)
    step = np.diff(time)
    weight = np.sqrt((np.append(step, 0.0) + np.append(0.0, step)) / 2)[:, None]
    end = by_shape[-1]
    # One solution ends at zero velocity; the remaining freedom is a null space.
    some = np.outer(end, velocity[-1]) / (end @ end)
    free = np.linalg.svd(end[None, :])[2][1:].T
    left = velocity - by_shape @ some
    amount = np.linalg.lstsq(weight * (by_shape @ free), weight * left, rcond=None)[0]
    return acceleration - shapes @ (some + free @ amount)
