"""Diffraction of waves by a cylinder that is not small compared with their length."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray

SMALLEST = 1e-6
"""Radius times wave number below which the long-wave limit is exact to rounding error."""


def maccamy_fuchs(diameter: Array, wave_number: Array) -> ComplexArray:
    """(n, m) force of waves on a vertical cylinder over that of rho pi D^2/4 times acceleration.

    With the radius a and the second Hankel function, for a time factor exp(i omega t),

        C = -4 i / (pi (k a)^2 H1'(k a)),

    which is the force per length of linear diffraction theory, 4 rho g A / (k |H1'(ka)|) times
    cosh k(z + h) / cosh kh (MacCamy and Fuchs, Wave forces on piles: a diffraction theory,
    Beach Erosion Board TM 69, 1954), over that of the undisturbed acceleration at the axis. For
    long waves it is 2, Morison's 1 + Ca with Ca = 1; for short ones it decreases and lags.

    diameter (n,) in m; wave_number (m,) in rad/m, 0 for water at rest or a current
    """
    from scipy.special import h2vp

    size = np.multiply.outer(diameter / 2, wave_number)
    long = size < SMALLEST
    safe = np.where(long, 1.0, size)
    ratio = -4j / (np.pi * safe**2 * h2vp(1, safe))
    return np.where(long, 2.0 + 0.0j, ratio)


def inertia_factor(diameter: Array, wave_number: Array, added_mass: Array) -> ComplexArray:
    """(n, m) factor from a strip's inertia force with 1 + Ca to that of diffraction theory.

    added_mass : (n,) coefficients Ca of the strips
    """
    return maccamy_fuchs(diameter, wave_number) / (1 + added_mass)[:, None]
