"""Natural modes: of dense matrices, or of products and solutions with large ones."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

Array = NDArray[np.float64]

_DENSE = 4
"""All modes are computed at once if more than one in this many is requested."""
_MORE = 4
"""Number of modes beyond the requested ones among which a gap is sought."""
_ATTEMPTS = 4
_REFINEMENTS = 50
_REFINED = 1e-13
"""Relative change of a solution below which it is accurate enough."""


def natural_modes(stiffness: Array, mass: Array, count: int) -> tuple[Array, Array]:
    """Lowest eigenpairs of K phi = omega^2 M phi.

    Returns
    -------
    squares : (count,) array, rad^2/s^2
        omega^2 in increasing order; negative where the structure is unstable.
    vectors : (n, count) array
        Modes with phi' M phi = 1.
    """
    symmetric = (stiffness + stiffness.T) / 2
    squares, vectors = eigh(symmetric, mass, subset_by_index=(0, count - 1))
    return squares, vectors


class Pencil(Protocol):
    """Mass M and stiffness K of n degrees of freedom, by products and solutions.

    K may be slightly unsymmetric, for example under follower forces; modes are those of its
    symmetric part.
    """

    def mass_times(self, vectors: Array) -> Array:
        """(n, m) products with vectors (n, m), or (n,)."""

    def symmetric_stiffness_times(self, vectors: Array) -> Array:
        """The same with the symmetric part of K."""

    def solve(self, rhs: Array) -> Array:
        """(n,) solution of K x = b."""

    def below(self, square: float) -> int:
        """Number of eigenvalues omega^2 below a value."""


def lowest_modes(pencil: Pencil, size: int, count: int) -> tuple[Array, Array]:
    """The same as :func:`natural_modes`, by Lanczos's method with K inverted.

    The number of modes is checked by Sylvester's law of inertia, and the search repeated if it
    missed one, such as one of a pair of equal frequency.

    Raises
    ------
    LinAlgError
        K is singular or too far from symmetric, or modes are missed repeatedly.
    """
    if _DENSE * count >= size:
        unit = np.eye(size)
        return natural_modes(pencil.symmetric_stiffness_times(unit), pencil.mass_times(unit), count)
    from scipy.sparse.linalg import LinearOperator, eigsh

    shape = (size, size)
    mass = LinearOperator(shape, matvec=pencil.mass_times, dtype=float)
    stiffness = LinearOperator(shape, matvec=pencil.symmetric_stiffness_times, dtype=float)
    inverse = LinearOperator(shape, matvec=lambda b: _solve(pencil, b), dtype=float)
    for attempt in range(_ATTEMPTS):
        wanted = min(count + _MORE * 2**attempt, size - 1)
        squares, vectors = eigsh(
            stiffness,
            wanted,
            mass,
            sigma=0.0,
            OPinv=inverse,
            ncv=min(size, 2 * wanted + 20),
            v0=np.random.default_rng(attempt).standard_normal(size),
        )
        order = np.argsort(squares)
        squares, vectors = squares[order], vectors[:, order]
        found = count + int(np.argmax(np.diff(squares[count - 1 :]) / np.abs(squares[count:])))
        if pencil.below((squares[found - 1] + squares[found]) / 2) == found:
            return squares[:count], vectors[:, :count]
    raise np.linalg.LinAlgError(f"the lowest {count} modes were not found")


def _solve(pencil: Pencil, rhs: Array) -> Array:
    """Solution with the symmetric part of K, refined from that with K."""
    x = pencil.solve(rhs)
    for _ in range(_REFINEMENTS):
        change = pencil.solve(rhs - pencil.symmetric_stiffness_times(x))
        x = x + change
        if np.linalg.norm(change) <= _REFINED * np.linalg.norm(x):
            return x
    raise np.linalg.LinAlgError("the stiffness is too far from symmetric")
