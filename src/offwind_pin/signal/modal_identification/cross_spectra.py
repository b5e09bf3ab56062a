"""Cross-spectral matrices of many channels, by Welch's method."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class CrossSpectra:
    """One-sided cross-spectral matrix of c channels.

    Attributes
    ----------
    frequency : (f,) array, Hz
        Evenly spaced from 0.
    matrix : (f, c, c) complex array, unit^2/Hz
        Hermitian; entry (i, j) is the mean of X_i times the conjugate of X_j, so its phase is that
        by which channel i leads j; the diagonal integrates to the variances.
    segments : int
        Number of segments averaged.
    averages : float
        Number of independent segments that would scatter as much as these, which overlap.
    window : (n,) array
        Weights of one segment.
    sample_rate : float, Hz
    duration : float, s
        Of the record.
    """

    frequency: Array
    matrix: ComplexArray
    segments: int
    averages: float
    window: Array
    sample_rate: float
    duration: float

    __repr__ = one_line

    @property
    def segment(self) -> float:
        """Length of a segment in s."""
        return len(self.window) / self.sample_rate


def cross_spectral_matrix(
    acceleration: Array,
    sample_rate: float,
    segment_s: float,
    overlap: float = 0.5,
    window: str = "hann",
) -> CrossSpectra:
    """Cross-spectral matrix of all pairs of channels by Welch's method (1967).

    The mean of each channel is removed from the whole record, as in ``power_spectral_density``,
    which the diagonal equals.

    Parameters
    ----------
    acceleration : (n, c) array
        Samples at equal intervals, one column per channel.
    sample_rate : float, Hz
    segment_s : float, s
        Length of a segment; its inverse is the spacing of the frequency lines.
    overlap : float
        Fraction of a segment shared with the next one, from 0 to below 1.
    window : str
        Name of a SciPy window.

    Returns
    -------
    CrossSpectra

    Raises
    ------
    InputError
        An array of another shape, numbers that are not finite, a constant channel, a
        segment longer than the record, an invalid overlap or window.
    """
    samples = _checked(acceleration, sample_rate)
    length = _segment_length(samples, sample_rate, segment_s)
    step = length - _overlap_length(overlap, length)
    weights = _weights(window, length)
    centred = samples - samples.mean(axis=0)
    pieces = np.lib.stride_tricks.sliding_window_view(centred, length, axis=0)[::step]
    lines = np.fft.rfft(pieces * weights, axis=-1)  # (segments, channels, lines)
    by_line = np.moveaxis(lines, 2, 0)
    matrix = np.swapaxes(by_line, 1, 2) @ by_line.conj()
    segments = len(pieces)
    matrix *= 2 / (segments * sample_rate * np.sum(weights**2))
    matrix[0] /= 2
    if length % 2 == 0:
        matrix[-1] /= 2  # nor has the line at half the sampling rate a mirror image
    return CrossSpectra(
        frequency=np.arange(len(matrix), dtype=np.float64) * (sample_rate / length),
        matrix=matrix,
        segments=segments,
        averages=_independent(weights, step, segments),
        window=weights,
        sample_rate=float(sample_rate),
        duration=len(samples) / sample_rate,
    )


def _checked(acceleration: Array, sample_rate: float) -> Array:
    """The samples as an array (n, c)."""
    samples = np.asarray(acceleration, dtype=np.float64)
    where = "acceleration"
    if samples.ndim != 2:
        allowed = "one row per time and one column per channel"
        raise InputError(where, f"an array of shape {samples.shape}", allowed, "Reshape it.")
    count, channels = samples.shape
    if channels >= count:
        raise InputError(
            where,
            f"{count} times of {channels} channels",
            "more times than channels",
            "Is the array transposed?",
        )
    if not (np.isfinite(sample_rate) and sample_rate > 0):
        raise InputError("sample_rate", sample_rate, "a positive number in Hz", "Give 1 / dt.")
    wrong = np.argwhere(~np.isfinite(samples))
    if len(wrong):
        row, column = wrong[0]
        raise InputError(
            f"{where}, row {row}, channel {column}",
            float(samples[row, column]),
            "finite numbers",
            "Cut the record there, or leave the channel out.",
        )
    still = np.flatnonzero(np.ptp(samples, axis=0) == 0)
    if len(still):
        raise InputError(
            f"{where}, channel {still[0]}",
            "the same number at all times",
            "channels that vary",
            "Is the sensor dead or clamped? Leave the channel out.",
        )
    return samples


def _segment_length(samples: Array, sample_rate: float, segment_s: float) -> int:
    count = len(samples)
    length = round(segment_s * sample_rate) if np.isfinite(segment_s) else 0
    if not 8 <= length <= count:
        allowed = f"{8 / sample_rate:g} to {count / sample_rate:g} s, the length of the record"
        raise InputError("segment_s", f"{segment_s:g} s", allowed, "Choose another.")
    return length


def _overlap_length(overlap: float, length: int) -> int:
    repeated = int(overlap * length) if np.isfinite(overlap) else -1
    if not 0 <= repeated < length:
        raise InputError("overlap", overlap, "0 to below 1", "Use 0.5 with a Hann window.")
    return repeated


def _weights(window: str, length: int) -> Array:
    from scipy import signal

    try:
        return np.asarray(signal.get_window(window, length), dtype=np.float64)
    except ValueError:
        allowed = "a SciPy window without parameters, such as hann"
        raise InputError("window", window, allowed, "Correct the name.") from None


def _independent(weights: Array, step: int, segments: int) -> float:
    """Independent segments with the scatter of overlapping ones, for noise (Welch, 1967).

    The variance of the mean of K overlapping periodograms is that of one over K times
    1 + 2 sum_j (1 - j / K) rho_j, with rho_j the squared correlation of windows j steps apart.
    """
    energy = np.sum(weights**2)
    spread = 1.0
    for j in range(1, segments):
        if j * step >= len(weights):
            break
        shared = np.sum(weights[j * step :] * weights[: len(weights) - j * step]) / energy
        spread += 2 * (1 - j / segments) * shared**2
    return segments / spread
