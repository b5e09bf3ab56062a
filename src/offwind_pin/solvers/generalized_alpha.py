"""Generalised-alpha time integration of r(t, q, v, a) = 0 with a converged residual every step.

The second-order method of Chung and Hulbert (1993), in the form of Arnold and Bruels (2007) that
satisfies the equations of motion exactly at the end of each step and blends an auxiliary
acceleration instead.

:func:`advance` is plain Python on a :class:`SecondOrderSystem`, and the same text compiled on a
system of arrays: what it asks of a system goes through the four functions at the end of this page,
and a compiled system gives its own of them to Numba (``numba.extending.overload``).
"""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.kernels import kernel

Array = NDArray[np.float64]


class Equilibrium(Protocol):
    """Equations of motion in a vector space of configurations, and a matrix to solve them with.

    row : numbers that depend on time alone, such as the time itself; its first is the time
    """

    def residual(self, row: Array, q: Array, v: Array, a: Array) -> Array:
        """(n,) residual."""

    def factorise(self, row: Array, q: Array, v: Array, a: Array, by_v: float, by_a: float) -> None:
        """Make the iteration matrix by_a dr/da + by_v dr/dv + dr/dq anew; it may be approximate."""

    def correction(self, residual: Array) -> Array:
        """(n,) solution of the iteration matrix for a right side."""


class SecondOrderSystem(Equilibrium, Protocol):
    """Equations of motion with a place for the results."""

    def observe(self, row: Array, state: Array, iterations: int, size: float) -> None:
        """Take note of a converged step: state (6, n) holds q, v, a first."""


class Method(NamedTuple):
    """Step and settings of generalised-alpha, as numbers.

    Attributes
    ----------
    step : in s
    spectral_radius : at infinite frequency, 1 keeps every frequency and 0 damps the highest at once
    scale : size of the loads that the residual is a balance of
    relative_tolerance, increment_tolerance : a step has converged when no entry of the residual
        exceeds the first times the scale, and the correction that it still asks for nowhere the
        second; the predictor is corrected once at least
    max_iterations : a step that needs more has failed
    slow : ratio of successive corrections above which the iteration matrix is made anew
    """

    step: float
    spectral_radius: float
    scale: float
    relative_tolerance: float = 1e-5
    increment_tolerance: float = 1e-8
    max_iterations: int = 25
    slow: float = 0.02


CONVERGED, DIVERGED, NOT_FINITE = 0, 1, 2
REASONS = {
    DIVERGED: "Newton's iteration did not converge",
    NOT_FINITE: "the residual is not finite",
}


def start(system: Equilibrium, row: Array, q: Array, v: Array) -> Array:
    """(6, n) state: q, v, the acceleration there, the auxiliary one, those of the two steps before.

    The system's iteration matrix is used as the mass matrix; the residual must be linear in a.
    """
    rest = np.zeros_like(q)
    factorise(system, row, q, v, rest, 0.0, _HUGE)
    a = rest
    for _ in range(_REFINEMENTS):
        a = a - _HUGE * correction(system, residual(system, row, q, v, a))
    return np.array([q, v, a, a, a, a])


_HUGE = 1e12
"""In 1/s2: beside it the stiffness is rounding in the iteration matrix."""
_REFINEMENTS = 4


def advance(
    system: SecondOrderSystem, method: Method, state: Array, rows: Array, last: Array
) -> tuple[int, int, float]:
    """Take a step for each row of numbers, changing the state (6, n).

    The iteration matrix is made anew at the first step, and when corrections shrink too slowly.

    Returns
    -------
    Number of completed steps; CONVERGED, or the reason why the next one failed; and the largest
    local error of a displacement, |beta - 1/6| h^2 max|a_new - a|. After a failure ``last`` (n,) is
    the last finite residual, and the state is that of the last completed step.
    """
    rho, h = method.spectral_radius, method.step
    alpha_m, alpha_f = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
    gamma = 0.5 + alpha_f - alpha_m
    beta = 0.25 * (gamma + 0.5) ** 2
    by_a = (1 - alpha_m) / (h**2 * beta * (1 - alpha_f))
    by_v = gamma / (h * beta)
    made = False
    error = 0.0
    for number in range(len(rows)):
        row = rows[number]
        q, v, a, blended, before = state[0], state[1], state[2], state[3], state[4]
        next_blended = (alpha_f * a - alpha_m * blended) / (1 - alpha_m)
        # The predictor continues the acceleration of the last three steps.
        a_new = 3 * (a - before) + state[5]
        q_new = q + h * v + h**2 * ((0.5 - beta) * blended + beta * next_blended) + a_new / by_a
        v_new = v + h * ((1 - gamma) * blended + gamma * next_blended) + a_new * (by_v / by_a)
        previous = np.inf
        iterations = 0
        while True:
            r = residual(system, row, q_new, v_new, a_new)
            size = np.max(np.abs(r)) / method.scale
            if not np.isfinite(size):
                return number, NOT_FINITE, np.inf
            last[:] = r
            if not made:
                factorise(system, row, q_new, v_new, a_new, by_v, by_a)
                made = True
            change = correction(system, r)
            increment = np.max(np.abs(change))
            small = size <= method.relative_tolerance and increment <= method.increment_tolerance
            if small and iterations > 0:
                break
            if iterations == method.max_iterations:
                return number, DIVERGED, np.inf
            if increment > method.slow * previous:
                factorise(system, row, q_new, v_new, a_new, by_v, by_a)
                change = correction(system, r)
                increment = np.max(np.abs(change))
            previous = increment
            q_new = q_new - change
            v_new = v_new - by_v * change
            a_new = a_new - by_a * change
            iterations += 1
        error = max(error, abs(beta - 1 / 6) * h**2 * np.max(np.abs(a_new - a)))
        state[5] = before
        state[4] = a
        state[3] = next_blended + (1 - alpha_f) / (1 - alpha_m) * a_new
        state[0], state[1], state[2] = q_new, v_new, a_new
        observe(system, row, state, iterations, size)
    return len(rows), CONVERGED, error


compiled_advance: Any = kernel(advance)
"""The same, on a system of arrays."""


def residual(system: Equilibrium, row: Array, q: Array, v: Array, a: Array) -> Array:
    return system.residual(row, q, v, a)


def factorise(
    system: Equilibrium, row: Array, q: Array, v: Array, a: Array, by_v: float, by_a: float
) -> None:
    system.factorise(row, q, v, a, by_v, by_a)


def correction(system: Equilibrium, r: Array) -> Array:
    return system.correction(r)


def observe(
    system: SecondOrderSystem, row: Array, state: Array, iterations: int, size: float
) -> None:
    system.observe(row, state, iterations, size)
