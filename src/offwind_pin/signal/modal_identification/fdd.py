"""Singular values of a cross-spectral matrix, and the peaks in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.cross_spectra import CrossSpectra

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

SEARCH = 0.1
"""How far from a given frequency its peak may lie, over that frequency."""


@dataclass(frozen=True, eq=False)
class Peak:
    """A peak of a singular value over frequency.

    Attributes
    ----------
    line : int
        Its index.
    valleys : (int, int)
        Lowest lines between it and the peaks beside it, or the ends of the spectrum.
    """

    line: int
    valleys: tuple[int, int]


def singular_values(spectra: CrossSpectra) -> tuple[Array, ComplexArray]:
    """Singular values and vectors of the matrix at every line.

    Where one mode outweighs all others, the first vector is its shape (Brincker, Zhang and
    Andersen, 2001).

    Returns
    -------
    values : (f, c) array, unit^2/Hz
        Falling.
    vectors : (f, c, c) complex array
        In columns, of unit length.

    Raises
    ------
    InputError
        Fewer segments than channels: the matrix of K segments has K singular values at most, and
        the rest are meaningless.
    """
    channels = spectra.matrix.shape[1]
    if spectra.segments < channels:
        raise InputError(
            "segments",
            f"{spectra.segments} segments for {channels} channels",
            "as many segments as channels, or more",
            "Use shorter segments, a longer record, or fewer channels.",
        )
    vectors, values, _ = np.linalg.svd(spectra.matrix, hermitian=True)
    return values, vectors


def pick_peaks(
    frequency: Array, values: Array, band: tuple[float, float], prominence_db: float
) -> tuple[list[Peak], Array]:
    """Prominent peaks of a singular value, in order of frequency.

    Parameters
    ----------
    frequency : (f,) array, Hz
    values : (f,) array
        One singular value.
    band : (float, float), Hz
        Lowest and highest frequency.
    prominence_db : float
        Height above the higher of the two valleys beside it.

    Returns
    -------
    peaks : list of Peak
        The n peaks.
    prominence : (n,) array
        In dB.
    """
    from scipy import signal

    level = _level(values)
    found, about = signal.find_peaks(level, prominence=prominence_db)
    inside = (frequency[found] >= band[0]) & (frequency[found] <= band[1])
    return _with_valleys(level, found[inside]), about["prominences"][inside]


def peaks_near(frequency: Array, values: Array, near: Sequence[float]) -> list[Peak]:
    """The highest line within a tenth of each given frequency in Hz, in their order.

    Raises
    ------
    InputError
        A frequency beyond the spectrum, no peak near one, or one peak near two.
    """
    level = _level(values)
    found = []
    for wanted in near:
        if not frequency[1] <= wanted <= frequency[-1]:
            allowed = f"{frequency[1]:g} to {frequency[-1]:g} Hz"
            raise InputError(
                "near", f"{wanted:g} Hz", allowed, "Use a higher sampling rate, or longer segments."
            )
        window = np.flatnonzero(np.abs(frequency - wanted) <= SEARCH * wanted)
        at = int(window[np.argmax(level[window])]) if len(window) else 0
        # The highest line at an edge of the window belongs to the flank of another peak.
        if not len(window) or at in (0, window[0], window[-1], len(level) - 1):
            raise InputError(
                "near",
                f"no peak within {100 * SEARCH:g} % of {wanted:g} Hz",
                "frequencies near peaks of the singular value",
                "Plot the singular values; use longer segments if the resolution is too low.",
            )
        if at in found:
            raise InputError(
                "near",
                f"{wanted:g} Hz and another frequency share the peak at {frequency[at]:.4g} Hz",
                "one peak per frequency",
                "For two close modes, use channels of one direction, or singular_value=2 for the "
                "weaker one.",
            )
        found.append(at)
    order = np.argsort(found)
    ordered = _with_valleys(level, np.array(found)[order])
    return [ordered[int(np.flatnonzero(order == i)[0])] for i in range(len(found))]


def _level(values: Array) -> Array:
    """In dB; lines without power at that of the smallest number."""
    return 10 * np.log10(np.maximum(values, np.finfo(float).tiny))


def _with_valleys(level: Array, lines: NDArray[np.int_]) -> list[Peak]:
    between = [int(a + np.argmin(level[a:b])) for a, b in pairwise(lines)]
    ends = [0, *between, len(level) - 1]
    return [Peak(int(line), (ends[i], ends[i + 1])) for i, line in enumerate(lines)]
