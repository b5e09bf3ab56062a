"""Wave numbers of free waves at finite depth, with a current or without."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array

_ROUNDING = 1e-14
_MOST_STEPS = 50


def wave_number(angular_frequency: Array, depth: float, gravity: float) -> Array:
    """Wave numbers in rad/m from omega^2 = g k tanh(k h), by Newton to 1e-14 relative.

    angular_frequency in rad/s (positive), depth in m, gravity in m/s2.
    """
    deep = angular_frequency**2 * depth / gravity
    kh = np.where(deep > 1, deep, np.sqrt(deep))
    for _ in range(_MOST_STEPS):
        tanh = np.tanh(kh)
        step = (kh * tanh - deep) / (tanh + kh * (1 - tanh**2))
        kh = kh - step
        if np.all(np.abs(step) <= _ROUNDING * kh):
            break
    else:
        raise RuntimeError("the dispersion relation did not converge")
    return kh / depth


def wave_number_in_current(
    angular_frequency: Array, depth: float, gravity: float, along: Array
) -> Array:
    """Wave numbers in rad/m from (omega - k U)^2 = g k tanh(k h); NaN for waves that are blocked.

    Waves so close to blocking that their wave number is not found to 1e-13 count as blocked.

    angular_frequency in rad/s (positive) as a fixed observer sees it; along (m,) the current's
    component U in m/s in each wave's direction. An opposing current shortens a wave, until its
    energy no longer advances (Peregrine, Adv. Appl. Mech. 16, 1976, Eq. 2.7) and it is blocked. The
    root is the one that continues the root without a current; the function is concave, so that
    Newton's method approaches it from below without overshooting.
    """
    omega, current = np.broadcast_arrays(angular_frequency, along)
    free = wave_number(np.asarray(omega, dtype=float), depth, gravity)
    # A following current lengthens waves: start from an even longer one.
    k = np.where(current > 0, free / (1 + current * free / omega) ** 2, free)
    for _ in range(_MOST_STEPS):
        tanh = np.tanh(k * depth)
        own = np.sqrt(gravity * k * tanh)
        group = own / 2 * (1 / k + depth * (1 - tanh**2) / tanh)
        slope = group + current
        step = (own + k * current - omega) / np.where(slope > 0, slope, np.nan)
        k = k - step
        if np.all(np.isnan(step) | (np.abs(step) <= 1e-13 * k)):
            break
    else:
        # close to blocking two roots merge, and Newton's method converges slowly
        k = np.where(np.abs(step) <= 1e-13 * k, k, np.nan)
    return np.asarray(k)
