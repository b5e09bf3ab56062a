"""Generalised-alpha in plain Python on equations with dense derivatives, every step kept."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from offwind_pin.solvers.generalized_alpha import CONVERGED, Method, advance, start

Array = NDArray[np.float64]


class DenseEquations(Protocol):
    """Equations of motion r(t, q, v, a) = 0 as they are written down."""

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        """(n,) residual."""

    def mass(self, q: Array) -> Array:
        """(n, n) dr/da."""

    def tangents(self, time: float, q: Array, v: Array) -> tuple[Array, Array]:
        """dr/dq and dr/dv, (n, n); they may be approximate."""


@dataclass(frozen=True, eq=False)
class Step:
    """One converged step: its end, the corrections it took, and its residual over the load scale."""

    time: float
    q: Array
    v: Array
    a: Array
    iterations: int
    residual: float


class InTime:
    """What the integrator asks of a system, by dense matrices; a row of numbers is the time alone.

    steps : those taken so far
    """

    def __init__(self, equations: DenseEquations) -> None:
        self.equations = equations
        self.steps: list[Step] = []

    def residual(self, row: Array, q: Array, v: Array, a: Array) -> Array:
        return self.equations.residual(float(row[0]), q, v, a)

    def factorise(
        self, row: Array, q: Array, v: Array, a: Array, dv_dq: float, da_dq: float
    ) -> None:
        stiffness, damping = self.equations.tangents(float(row[0]), q, v)
        matrix = da_dq * self.equations.mass(q) + dv_dq * damping + stiffness
        self._factors = lu_factor(matrix)

    def correction(self, residual: Array) -> Array:
        return lu_solve(self._factors, residual)

    def observe(self, row: Array, state: Array, iterations: int, size: float) -> None:
        q, v, a = state[:3].copy()
        self.steps.append(Step(float(row[0]), q, v, a, iterations, float(size)))


@dataclass(frozen=True, eq=False)
class Ended:
    """How an integration ended.

    steps : the start and the completed ones; reason : CONVERGED or why the next one failed;
    completed, error : as returned; state : (5, n) at the end; last : the last finite residual
    """

    steps: list[Step]
    reason: int
    completed: int
    error: float
    state: Array
    last: Array


def attempt(equations: DenseEquations, q: Array, v: Array, method: Method, count: int) -> Ended:
    """Up to so many steps from a start at time 0."""
    system = InTime(equations)
    state = start(system, np.zeros(1), q, v)
    left = equations.residual(0.0, q, v, state[2])
    system.observe(np.zeros(1), state, 0, np.max(np.abs(left)) / method.scale)
    rows = method.step * np.arange(1, count + 1)[:, None]
    last = np.full_like(q, np.nan)
    completed, reason, error = advance(system, method, state, rows, last)
    return Ended(system.steps, reason, completed, error, state, last)


def integrate(
    equations: DenseEquations, q: Array, v: Array, method: Method, count: int
) -> list[Step]:
    """The start and so many steps, all of which must converge."""
    ended = attempt(equations, q, v, method, count)
    assert ended.reason == CONVERGED
    return ended.steps
