"""A first-order scheme for the chain, as a negative control for what claims to be of second order."""

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.kernels import kernel
from offwind_pin.solvers.generalized_alpha import (
    CONVERGED,
    DIVERGED,
    Method,
    SecondOrderSystem,
    correction,
    factorise,
    observe,
    residual,
)

Array = NDArray[np.float64]


def backward_euler(
    system: SecondOrderSystem, method: Method, state: Array, rows: Array, last: Array
) -> tuple[int, int, float]:
    """q' = q + h v', v' = v + h a', r(t', q', v', a') = 0; to be put in the place of ``advance``."""
    h = method.step
    for number in range(len(rows)):
        row = rows[number]
        a = state[2].copy()
        v = state[1] + h * a
        q = state[0] + h * v
        iterations = 0
        while True:
            r = residual(system, row, q, v, a)
            size = np.max(np.abs(r)) / method.scale
            last[:] = r
            if size <= method.relative_tolerance and iterations > 0:
                break
            if iterations == method.max_iterations:
                return number, DIVERGED, np.inf
            factorise(system, row, q, v, a, 1 / h, 1 / h**2)
            change = correction(system, r)
            q = q - change
            v = v - change / h
            a = a - change / h**2
            iterations += 1
        state[0], state[1], state[2] = q, v, a
        observe(system, row, state, iterations, size)
    return len(rows), CONVERGED, 0.0


compiled_backward_euler = kernel(backward_euler)
