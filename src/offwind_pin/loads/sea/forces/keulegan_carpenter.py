"""Keulegan-Carpenter numbers of strips in a sea."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray


def keulegan_carpenter(velocity: ComplexArray, omega: Array, diameter: Array) -> Array:
    """(n,) KC = u_m T / D of strips (Keulegan and Carpenter, J. Res. Nat. Bur. Stand. 60, 1958).

    In a regular wave it is 2 pi times the horizontal amplitude of the particles' orbits over D. In
    irregular waves that amplitude is taken as sqrt(2) times the standard deviation of the orbits,
    so that the number is that of the sinusoid with the same standard deviation. Unlike one made of
    the velocity and a mean period it does not hang on where the spectrum's tail is cut off.
    Currents and the structure's own motion do not count.

    velocity (3, n, m) complex amplitudes of the water in m/s, of which x and y count; omega (m,) in
    rad/s, of which 0 is left out; diameter (n,) in m
    """
    moving = omega > 0
    orbit = np.abs(velocity[:2, :, moving]) / omega[moving]
    amplitude = np.sqrt(np.sum(orbit**2, axis=(0, 2)))
    return np.asarray(2 * np.pi * amplitude / diameter)
