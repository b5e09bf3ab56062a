"""Keulegan-Carpenter numbers of strips in a sea."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray


def keulegan_carpenter(velocity: ComplexArray, omega: Array, diameter: Array) -> Array:
    """(n,) KC = u_m T / D of strips (Keulegan and Carpenter, J. Res. Nat. Bur. Stand. 60, 1958).

    In a regular wave it is 2 pi times the horizontal amplitude of the particle orbits over D. In
    irregular waves that amplitude is taken as sqrt(2) times the standard deviation of the orbits,
    which is that of a sinusoid with the same standard deviation. Unlike a number from the velocity
    and a mean period, it does not depend on the cut-off of the spectrum's tail. Currents and the
    motion of the structure are not included.

    velocity (3, n, m) complex amplitudes of the water in m/s, of which x and y are used; omega (m,)
    in rad/s, of which 0 is omitted; diameter (n,) in m
    """
    moving = omega > 0
    orbit = np.abs(velocity[:2, :, moving]) / omega[moving]
    amplitude = np.sqrt(np.sum(orbit**2, axis=(0, 2)))
    return np.asarray(2 * np.pi * amplitude / diameter)
