"""Newton's method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class NewtonResult:
    """Result of Newton's method.

    x : (n,) last iterate; residual : (n,) at x; iterations : number of steps;
    increment : largest entry of the last step; converged : whether both criteria were met.
    """

    x: Array
    residual: Array
    iterations: int
    increment: float
    converged: bool


def newton(
    residual: Callable[[Array], Array],
    correction: Callable[[Array, Array], Array],
    start: Array,
    *,
    scale: float,
    relative_tolerance: float = 1e-10,
    increment_tolerance: float = 1e-10,
    largest_step: float = 0.05,
    max_iterations: int = 100,
) -> NewtonResult:
    """Solve residual(x) = 0 with the exact tangent, steps limited in size.

    correction : function of x and its residual r that returns T(x)^-1 r with the tangent T;
    LinAlgError
        ends the search
    scale : size of the terms in the residual. Converged means that the residual is below
        ``relative_tolerance * scale`` and the last step below ``increment_tolerance``.
    largest_step : a longer step is shortened so that no entry exceeds it
    """
    x = start.copy()
    r = residual(x)
    increment = np.inf
    for iteration in range(max_iterations + 1):
        if not np.all(np.isfinite(r)):
            break
        small = float(np.max(np.abs(r))) <= relative_tolerance * scale
        if small and increment <= increment_tolerance:
            return NewtonResult(x, r, iteration, increment, converged=True)
        if iteration == max_iterations:
            break
        try:
            step = -correction(x, r)
        except np.linalg.LinAlgError:
            break
        increment = float(np.max(np.abs(step)))
        x = x + step * min(1.0, largest_step / increment if increment > 0 else 1.0)
        r = residual(x)
    return NewtonResult(x, r, iteration, increment, converged=False)
