"""Generalised-alpha time integration of r(t, q, v, a) = 0 with a converged residual every step.

The second-order method of Chung and Hulbert (1993), in the form of Arnold and Bruels (2007) that
satisfies the equations of motion exactly at the end of each step and blends an auxiliary
acceleration instead.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

Array = NDArray[np.float64]


class SecondOrderSystem(Protocol):
    """Equations of motion in a vector space of configurations."""

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        """(n,) residual."""

    def mass(self, q: Array) -> Array:
        """(n, n) dr/da."""

    def tangents(self, time: float, q: Array, v: Array) -> tuple[Array, Array]:
        """dr/dq and dr/dv, (n, n); they may be approximate."""


@dataclass(frozen=True, eq=False)
class Step:
    """One converged step.

    number : counted from 0, the start; time in s; q, v, a : (n,) state, with the true acceleration;
    iterations : Newton iterations used; residual : largest entry over the load scale
    """

    number: int
    time: float
    q: Array
    v: Array
    a: Array
    iterations: int
    residual: float


class StepFailed(Exception):
    """A step that did not converge: its number, its time and its last finite residual (n,)."""

    def __init__(self, number: int, time: float, residual: Array) -> None:
        self.number = number
        self.time = time
        self.residual = residual
        super().__init__(f"step {number} at {time} did not converge")


@dataclass(frozen=True)
class GeneralizedAlpha:
    """Method and its settings.

    Attributes
    ----------
    dt : step in s
    spectral_radius : at infinite frequency, 1 keeps every frequency and 0 damps the highest at once
    relative_tolerance : a step has converged when no entry of the residual exceeds this times the
        load scale and no increment of q exceeds ``increment_tolerance``
    max_iterations : a step that needs more has failed
    slow : ratio of successive residuals above which the iteration matrix is made anew
    """

    dt: float
    spectral_radius: float = 0.9
    relative_tolerance: float = 1e-8
    increment_tolerance: float = 1e-8
    max_iterations: int = 25
    slow: float = 0.2

    def steps(
        self, system: SecondOrderSystem, q: Array, v: Array, *, count: int, scale: float
    ) -> Iterator[Step]:
        """The start, then ``count`` steps.

        scale : size of the loads that the residual is a balance of

        Raises
        ------
        StepFailed : the Newton iteration of a step did not converge
        """
        rho, h = self.spectral_radius, self.dt
        alpha_m, alpha_f = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
        gamma = 0.5 + alpha_f - alpha_m
        beta = 0.25 * (gamma + 0.5) ** 2
        by_a = (1 - alpha_m) / (h**2 * beta * (1 - alpha_f))
        by_v = gamma / (h * beta)
        a: Array = -lu_solve(
            lu_factor(system.mass(q)), system.residual(0.0, q, v, np.zeros_like(q))
        )
        blended = a.copy()
        start = system.residual(0.0, q, v, a)
        yield Step(0, 0.0, q, v, a, 0, float(np.max(np.abs(start))) / scale)
        before, factors = a, None
        for number in range(1, count + 1):
            time = number * h
            next_blended = (alpha_f * a - alpha_m * blended) / (1 - alpha_m)
            q_new = q + h * v + h**2 * ((0.5 - beta) * blended + beta * next_blended)
            v_new = v + h * ((1 - gamma) * blended + gamma * next_blended)
            # The predictor continues the acceleration of the last two steps.
            guess = (2 * a - before) / by_a
            q_new, v_new, a_new = _correct(q_new, v_new, np.zeros_like(a), guess, by_v, by_a)
            previous = increment = np.inf
            last = np.full_like(a, np.inf)
            for iteration in range(self.max_iterations + 1):
                r = system.residual(time, q_new, v_new, a_new)
                size = float(np.max(np.abs(r))) / scale
                if not np.isfinite(size) or iteration == self.max_iterations:
                    raise StepFailed(number, time, last)
                last = r
                if size <= self.relative_tolerance and increment <= self.increment_tolerance:
                    break
                if factors is None or size > self.slow * previous:
                    stiffness, damping = system.tangents(time, q_new, v_new)
                    matrix = by_a * system.mass(q_new) + by_v * damping + stiffness
                    factors = lu_factor(matrix)
                previous = size
                step = -lu_solve(factors, r)
                increment = float(np.max(np.abs(step)))
                q_new, v_new, a_new = _correct(q_new, v_new, a_new, step, by_v, by_a)
            blended = next_blended + (1 - alpha_f) / (1 - alpha_m) * a_new
            before, q, v, a = a, q_new, v_new, a_new
            yield Step(number, time, q, v, a, iteration, size)


def _correct(
    q: Array, v: Array, a: Array, step: Array, by_v: float, by_a: float
) -> tuple[Array, Array, Array]:
    return q + step, v + by_v * step, a + by_a * step
