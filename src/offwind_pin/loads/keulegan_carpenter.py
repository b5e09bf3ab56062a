"""Keulegan-Carpenter numbers of strips in a sea."""

from __future__ import annotations

import numpy as np

from offwind_pin.turbines.base import Array, ComplexArray


def keulegan_carpenter(velocity: ComplexArray, omega: Array, diameter: Array) -> Array:
    """(n,) KC = u_m T / D of strips (Keulegan and Carpenter, J. Res. Nat. Bur. Stand. 60, 1958).

    In irregular waves u_m and T are those of the sinusoid with the same standard deviations of
    velocity and acceleration: u_m = sqrt(2) sigma_u, T = 2 pi sigma_u / sigma_a, which is the mean
    zero-upcrossing period of a Gaussian velocity. In a regular wave they are its own. Currents and
    the structure's own motion do not count.

    velocity (3, n, m) complex amplitudes of the water in m/s, of which x and y count; omega (m,) in
    rad/s, of which 0 is left out; diameter (n,) in m
    """
    square = np.abs(velocity[0]) ** 2 + np.abs(velocity[1]) ** 2
    of_velocity = square @ (omega > 0) / 2
    of_acceleration = square @ omega**2 / 2
    moving = of_acceleration > 0
    safe = np.where(moving, of_acceleration, 1.0)
    return np.where(moving, 2 * np.pi * np.sqrt(2) * of_velocity / np.sqrt(safe) / diameter, 0.0)
