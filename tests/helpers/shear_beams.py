"""Independent answers for uniform cantilevers that bend and shear (Timoshenko's beam)."""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

Array = NDArray[np.float64]


def cowper(poisson: float, ratio: float) -> float:
    """Shear coefficient of a hollow circle, ratio of its inner to its outer diameter.

    Cowper (1966), Table 1: 6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2).
    """
    m, nu = ratio, poisson
    return 6 * (1 + nu) * (1 + m**2) ** 2 / ((7 + 6 * nu) * (1 + m**2) ** 2 + (20 + 12 * nu) * m**2)


def ritz_frequencies(
    length: float,
    *,
    bending: float,
    shear: float,
    mass: float,
    rotary: float,
    count: int,
    order: int = 16,
) -> Array:
    """(count,) frequencies in rad/s of a clamped-free beam, by Rayleigh-Ritz.

    bending EI in N m2, shear kappa G A in N, mass in kg/m, rotary inertia rho I in kg m. Deflection
    and rotation are each x P_k(2 x - 1), x = s / length: exponential convergence.
    """
    points, weights = np.polynomial.legendre.leggauss(2 * order)
    x, weight = (1 + points) / 2, weights / 2 * length
    series = [np.polynomial.Legendre.basis(k, domain=[0.0, 1.0]) for k in range(order)]
    shape = np.array([x * p(x) for p in series])
    slope = np.array([p(x) + x * p.deriv()(x) for p in series]) / length
    nothing = np.zeros_like(shape)
    curvature = np.vstack([nothing, slope])
    strain = np.vstack([slope, -shape])
    moved, turned = np.vstack([shape, nothing]), np.vstack([nothing, shape])
    stiffness = bending * (curvature * weight) @ curvature.T + shear * (strain * weight) @ strain.T
    inertia = mass * (moved * weight) @ moved.T + rotary * (turned * weight) @ turned.T
    return np.sqrt(eigh(stiffness, inertia, eigvals_only=True)[:count])
