"""One-sided variance spectra of the surface elevation in m2/Hz."""

from __future__ import annotations

import numpy as np

from offwind_pin.turbines.base import Array


def pierson_moskowitz(frequency: Array, significant_height: float, peak_period: float) -> Array:
    """One-sided variance spectrum of the surface elevation in m2/Hz (IEC 61400-3-1, Annex D).

    frequency in Hz (positive), significant height in m, peak period in s; its area is Hs^2 / 16.
    """
    ratio = 1 / (frequency * peak_period)
    return 5 / 16 * significant_height**2 / frequency * ratio**4 * np.exp(-1.25 * ratio**4)
