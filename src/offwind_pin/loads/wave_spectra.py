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


def jonswap(
    frequency: Array, significant_height: float, peak_period: float, peak_shape: float
) -> Array:
    """The same with a peak raised by a shape factor gamma from 1 (IEC 61400-3-1, Annex D).

    S = (1 - 0.287 ln gamma) S_PM gamma^exp(-((f Tp - 1) / sigma)^2 / 2), with sigma 0.07 below and
    0.09 above the peak. The factor in front keeps the area Hs^2 / 16 within 1 % for gamma up to 5,
    and within 3 % up to 7.
    """
    ratio = frequency * peak_period
    width = np.where(ratio <= 1, 0.07, 0.09)
    raised = peak_shape ** np.exp(-(((ratio - 1) / width) ** 2) / 2)
    level = 1 - 0.287 * np.log(peak_shape)
    return np.asarray(
        level * raised * pierson_moskowitz(frequency, significant_height, peak_period)
    )


def iec_peak_shape(significant_height: float, peak_period: float) -> float:
    """Peak-shape factor by steepness, 1 to 5 (IEC 61400-3-1, Annex D).

    5 for Tp / sqrt(Hs) up to 3.6, 1 from 5 on, exp(5.75 - 1.15 Tp / sqrt(Hs)) in between.
    """
    ratio = peak_period / np.sqrt(significant_height)
    if ratio <= 3.6:
        return 5.0
    return 1.0 if ratio >= 5 else float(np.exp(5.75 - 1.15 * ratio))
