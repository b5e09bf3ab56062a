"""Exact and independent solutions for Euler-Bernoulli cantilevers."""

from collections.abc import Callable

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

from offwind_pin.base.definition import Array


def cantilever_roots(count: int) -> Array:
    """First roots of cos x cosh x = -1, written as cos x + 1 / cosh x = 0: it does not overflow."""
    roots = []
    for i in range(count):
        middle = (i + 0.5) * np.pi
        roots.append(brentq(lambda x: np.cos(x) + 1 / np.cosh(x), middle - 0.4, middle + 0.4))
    return np.array(roots)


def ritz_frequencies(
    length: float,
    stiffness: Callable[[Array], Array],
    mass: Callable[[Array], Array],
    count: int,
    order: int = 18,
) -> Array:
    """(count,) frequencies in rad/s of a clamped-free beam of EI(s) and m(s), by Rayleigh-Ritz.

    Trial functions x^2 P_k(2 x - 1), which meet the clamped end and span all smooth shapes; their
    convergence is exponential. x = s / length.
    """
    points, weights = np.polynomial.legendre.leggauss(2 * order)
    x, weight = (1 + points) / 2, weights / 2
    shape, bent = [], []
    for k in range(order):
        series = np.polynomial.Legendre.basis(k, domain=[0.0, 1.0])
        slope, curve = series.deriv(1), series.deriv(2)
        shape.append(x**2 * series(x))
        bent.append(2 * series(x) + 4 * x * slope(x) + x**2 * curve(x))
    w, b = np.array(shape), np.array(bent)
    k_matrix = (b * weight * stiffness(x * length)) @ b.T / length**3
    m_matrix = (w * weight * mass(x * length)) @ w.T * length
    return np.sqrt(eigh(k_matrix, m_matrix, eigvals_only=True)[:count])
