"""Generalised-alpha time integration of r(t, q, v, a) = 0 with a converged residual every step.

The second-order method of Chung and Hulbert (1993), in the form of Arnold and Bruels (2007) that
satisfies the equations of motion exactly at the end of each step and blends an auxiliary
acceleration instead.

:func:`advance` is plain Python on a :class:`SecondOrderSystem`, and the same source compiled on a
system of arrays: it uses the system through the four functions at the end of this file, which a
compiled system overloads (``numba.extending.overload``).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.kernels import kernel

Array = NDArray[np.float64]


class Equilibrium(Protocol):
    """Equations of motion in a vector space of configurations, and their iteration matrix.

    row : time inputs, numbers that depend on time alone; the first is the time
    """

    def residual(self, row: Array, q: Array, v: Array, a: Array) -> Array:
        """(n,) residual."""

    def factorise(
        self, row: Array, q: Array, v: Array, a: Array, dv_dq: float, da_dq: float
    ) -> None:
        """Factorise the matrix da_dq dr/da + dv_dq dr/dv + dr/dq; it may be approximate."""

    def correction(self, residual: Array) -> Array:
        """(n,) solution of the iteration matrix for a right side."""


class SecondOrderSystem(Equilibrium, Protocol):
    """Equations of motion that observe the results."""

    def observe(self, row: Array, state: Array, iterations: int, size: float) -> None:
        """Observe a converged step, whose residual was evaluated last.

        state : (6, n) with q, v, a first
        """


class Method(NamedTuple):
    """Step and settings of generalised-alpha, as numbers.

    Attributes
    ----------
    step : float, s
    spectral_radius : float
        At infinite frequency: 1 for no numerical damping, 0 for immediate decay of the highest.
    scale : float
        Size of the loads in the residual.
    relative_tolerance, increment_tolerance : float
        A step has converged when no entry of the residual exceeds the first times the scale, and no
        entry of the remaining correction the second; the predictor is corrected at least once.
    max_iterations : int
        A step that requires more has failed.
    slow : float
        Ratio of successive corrections above which the iteration matrix is rebuilt.
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
"""da_dq in 1/s2, against which the stiffness is rounding error in the iteration matrix."""
_REFINEMENTS = 4


def advance(
    system: SecondOrderSystem, method: Method, state: Array, rows: Array, last: Array
) -> tuple[int, int, float]:
    """Take one step per row of time inputs, changing the state (6, n).

    The iteration matrix is rebuilt at the first step, and when corrections decrease too slowly.

    Returns
    -------
    (int, int, float)
        Number of completed steps; CONVERGED, or the reason why the next one failed; and the largest
        local error of a displacement, |beta - 1/6| h^2 max|a_new - a|. After a failure ``last``
        (n,) is the last finite residual, and the state is that of the last completed step.
    """
    rho, h = method.spectral_radius, method.step
    alpha_m, alpha_f = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
    gamma = 0.5 + alpha_f - alpha_m
    beta = 0.25 * (gamma + 0.5) ** 2
    da_dq = (1 - alpha_m) / (h**2 * beta * (1 - alpha_f))
    dv_dq = gamma / (h * beta)
    new = np.empty((4, state.shape[1]))
    q, v, a = new[0], new[1], new[2]
    made = False
    error = 0.0
    for number in range(len(rows)):
        row = rows[number]
        _predict(h, alpha_m, alpha_f, beta, gamma, dv_dq, da_dq, state, new)
        previous = np.inf
        iterations = 0
        while True:
            r = residual(system, row, q, v, a)
            size = _largest(r) / method.scale
            if not math.isfinite(size):
                return number, NOT_FINITE, np.inf
            _copy(r, last)
            if not made:
                factorise(system, row, q, v, a, dv_dq, da_dq)
                made = True
            change = correction(system, r)
            increment = _largest(change)
            small = size <= method.relative_tolerance and increment <= method.increment_tolerance
            if small and iterations > 0:
                break
            if iterations == method.max_iterations:
                return number, DIVERGED, np.inf
            if increment > method.slow * previous:
                factorise(system, row, q, v, a, dv_dq, da_dq)
                change = correction(system, r)
                increment = _largest(change)
            previous = increment
            _correct(new, change, dv_dq, da_dq)
            iterations += 1
        jump = _complete(state, new, (1 - alpha_f) / (1 - alpha_m))
        error = max(error, abs(beta - 1 / 6) * h**2 * jump)
        observe(system, row, state, iterations, size)
    return len(rows), CONVERGED, error


# Loops compile several times faster than array expressions.


@kernel
def _predict(
    h: float,
    alpha_m: float,
    alpha_f: float,
    beta: float,
    gamma: float,
    dv_dq: float,
    da_dq: float,
    state: Array,
    new: Array,
) -> None:
    """Set the predictor of q, v, a and the auxiliary acceleration (4, n).

    The predictor continues the acceleration of the last three steps.
    """
    for i in range(state.shape[1]):
        a, blended = state[2, i], state[3, i]
        next_blended = (alpha_f * a - alpha_m * blended) / (1 - alpha_m)
        a_new = 3 * (a - state[4, i]) + state[5, i]
        mean = (0.5 - beta) * blended + beta * next_blended
        new[0, i] = state[0, i] + h * state[1, i] + h**2 * mean + a_new / da_dq
        mean = (1 - gamma) * blended + gamma * next_blended
        new[1, i] = state[1, i] + h * mean + a_new * (dv_dq / da_dq)
        new[2, i], new[3, i] = a_new, next_blended


@kernel
def _largest(values: Array) -> float:
    """Largest size of any entry; NaN if one is."""
    largest = 0.0
    for i in range(len(values)):
        size = abs(values[i])
        if not size <= largest:
            largest = size
            if size != size:
                break
    return largest


@kernel
def _copy(values: Array, target: Array) -> None:
    for i in range(len(values)):
        target[i] = values[i]


@kernel
def _correct(new: Array, change: Array, dv_dq: float, da_dq: float) -> None:
    """Subtract a correction of the displacements from q, v and a."""
    for i in range(len(change)):
        new[0, i] -= change[i]
        new[1, i] -= dv_dq * change[i]
        new[2, i] -= da_dq * change[i]


@kernel
def _complete(state: Array, new: Array, ratio: float) -> float:
    """Make the new values the state (6, n); returns the largest change of an acceleration."""
    jump = 0.0
    for i in range(state.shape[1]):
        jump = max(jump, abs(new[2, i] - state[2, i]))
        state[5, i] = state[4, i]
        state[4, i] = state[2, i]
        state[3, i] = new[3, i] + ratio * new[2, i]
        state[0, i], state[1, i], state[2, i] = new[0, i], new[1, i], new[2, i]
    return jump


compiled_advance: Any = kernel(advance)
"""The same on a system of arrays."""


def residual(system: Equilibrium, row: Array, q: Array, v: Array, a: Array) -> Array:
    return system.residual(row, q, v, a)


def factorise(
    system: Equilibrium, row: Array, q: Array, v: Array, a: Array, dv_dq: float, da_dq: float
) -> None:
    system.factorise(row, q, v, a, dv_dq, da_dq)


def correction(system: Equilibrium, r: Array) -> Array:
    return system.correction(r)


def observe(
    system: SecondOrderSystem, row: Array, state: Array, iterations: int, size: float
) -> None:
    system.observe(row, state, iterations, size)
