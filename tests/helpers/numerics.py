"""Fitted orders, central differences and directional checks."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from offwind_pin.verification.orders import fitted_order

__all__ = ["fitted_order"]

Array = NDArray[np.float64]


def central_differences(function: Callable[[Array], Array], x: Array, step: float) -> Array:
    """(m, n) Jacobian; error of order step^2 from truncation and eps / step from rounding."""
    columns = [
        (function(x + step * unit) - function(x - step * unit)) / (2 * step)
        for unit in np.eye(len(x))
    ]
    return np.array(columns).T


def relative_difference(value: Array, reference: Array) -> float:
    """Largest difference over the largest reference entry."""
    return float(np.max(np.abs(value - reference)) / np.max(np.abs(reference)))


def blockwise_difference(value: Array, reference: Array, kind: Sequence[str]) -> float:
    """The same of each block of a matrix or vector by itself, entries of one kind together.

    Rows and columns of forces and of moments differ in size by more than a tolerance.
    """
    groups = [[i for i, other in enumerate(kind) if other == one] for one in sorted(set(kind))]
    blocks = [(group,) for group in groups]
    if value.ndim == 2:
        blocks = [np.ix_(rows, columns) for rows in groups for columns in groups]
    return max(relative_difference(value[block], reference[block]) for block in blocks)


def fourth_order_differences(function: Callable[[Array], Array], x: Array, step: float) -> Array:
    """(m, n) Jacobian by five-point differences; truncation of order step^4."""
    near = central_differences(function, x, step)
    far = central_differences(function, x, 2 * step)
    return (4 * near - far) / 3
