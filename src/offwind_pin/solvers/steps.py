"""Step policies: number of equal steps between two outputs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

from offwind_pin.base.errors import InputError

MOST_STEPS = 100_000
"""Of an interval between two outputs."""
MOST_OUTPUTS = 10_000_000
"""Of a time history: a day at 100 Hz."""


class StepPolicy(Protocol):
    """Chooses the number of steps of an output interval from the outcome of the previous one."""

    def first(self, interval: float) -> int:
        """Number of steps in the first interval.

        Parameters
        ----------
        interval : float, s
            Output interval.

        Returns
        -------
        int
            Number of steps in the first interval.
        """

    def next(self, steps: int, error: float, interval: float) -> int:
        """Number of steps of the next interval.

        More than ``steps`` rejects the interval, which is then repeated with that many. An infinite
        error is a failed step.

        Parameters
        ----------
        steps : int
            Number of steps taken in the last interval.
        error : float, m or rad
            Largest local error in it.
        interval : float, s
            Output interval.

        Returns
        -------
        int
            Number of steps for the next interval.
        """

    def most(self, interval: float) -> int:
        """Number of steps of an interval beyond which a failure is reported.

        Parameters
        ----------
        interval : float, s
            Output interval.

        Returns
        -------
        int
            Largest number of steps allowed in an interval.
        """

    def describe(self) -> dict[str, float | str]:
        """Plain data for the results.

        Returns
        -------
        dict of str to float or str
            Attributes for the results.
        """


@dataclass(frozen=True)
class FixedStep(StepPolicy):
    """Steps of one size; an interval in which a step fails is repeated with half the step.

    Attributes
    ----------
    dt : float, s
        Step.
    halvings : int
        How often the step may be halved before the failure is reported.
    """

    dt: float
    halvings: int = 4

    def __post_init__(self) -> None:
        _check_positive("dt", self.dt)

    def first(self, interval: float) -> int:
        steps = _bounded("dt", self.dt, interval / self.dt)
        if steps < 1 or abs(steps * self.dt - interval) > 1e-6 * interval:
            allowed = f"a multiple of dt = {self.dt} s"
            raise InputError("output_dt", interval, allowed, "Adjust one of them.")
        return steps

    def next(self, steps: int, error: float, interval: float) -> int:
        return 2 * steps if math.isinf(error) else self.first(interval)

    def most(self, interval: float) -> int:
        return self.first(interval) * 2**self.halvings

    def describe(self) -> dict[str, float | str]:
        return {"step_policy": "fixed", "dt_s": self.dt}


@dataclass(frozen=True)
class AdaptiveStep(StepPolicy):
    """Steps halved where the local error exceeds a tolerance, doubled where it is far below.

    The error of a step is estimated as |beta - 1/6| h^2 max|a_new - a|, the leading term of the
    displacement that a second-order step neglects (Zienkiewicz and Xie, 1991).

    Attributes
    ----------
    tolerance : float, m or rad
        Largest local error of a joint's displacement.
    smallest, largest : float, s
        Bounds of the step.
    """

    tolerance: float = 1e-7
    smallest: float = 1e-5
    largest: float = 0.1

    def __post_init__(self) -> None:
        for name in ("tolerance", "smallest", "largest"):
            _check_positive(name, getattr(self, name))
        if self.smallest > self.largest:
            allowed = f"at most the largest, {self.largest} s"
            raise InputError("smallest", self.smallest, allowed, "Swap them.")

    def first(self, interval: float) -> int:
        _bounded("smallest", self.smallest, interval / self.smallest)
        return max(1, math.ceil(interval / self.largest - 1e-9))

    def next(self, steps: int, error: float, interval: float) -> int:
        if error > self.tolerance:
            return 2 * steps
        # Twice the step has about eight times the error.
        if error < self.tolerance / 16 and steps % 2 == 0 and steps // 2 >= self.first(interval):
            return steps // 2
        return steps

    def most(self, interval: float) -> int:
        return max(self.first(interval), int(interval / self.smallest))

    def describe(self) -> dict[str, float | str]:
        return {"step_policy": "adaptive", "step_tolerance": self.tolerance}


def _bounded(name: str, dt: float, steps: float) -> int:
    """Whole number of steps of an interval, if there is memory for what depends on time in it."""
    if steps > MOST_STEPS:
        raise InputError(
            name, dt, f"{MOST_STEPS} steps at most between two outputs", "Choose longer steps."
        )
    return round(steps)


def _check_positive(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0):
        raise InputError(name, value, "a positive number", "Correct it.")
