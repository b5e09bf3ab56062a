"""Modes from accelerations under unmeasured excitation: operational modal analysis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.cross_spectra import (
    CrossSpectra,
    cross_spectral_matrix,
)
from offwind_pin.signal.modal_identification.enhanced_fdd import mode_of_bell, single_mode_bell
from offwind_pin.signal.modal_identification.fdd import (
    Peak,
    peaks_near,
    pick_peaks,
    singular_values,
)
from offwind_pin.signal.modal_identification.free_decay import Decrement, checked_range
from offwind_pin.signal.modal_identification.modal_assurance import real_shape

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_FEW_AVERAGES = 20.0
"""Independent segments below which a line scatters by more than 22 %."""
_CLOSE = 0.1
"""Second singular value over the first at a peak, above which two modes share it."""
_COMPLEX = 0.02
"""Complexity above which a shape is reported as not real."""
_UNCERTAIN = 0.15
"""Expected scatter of a damping ratio, over it, above which a longer record is asked for."""


@dataclass(frozen=True, eq=False)
class OperationalModes:
    """Modes identified from m peaks of f lines and c channels.

    Attributes
    ----------
    frequency_hz : (m,) array
        Undamped natural frequencies, from the zero crossings of the correlation.
    damping_ratio : (m,) array
        Of critical, from the logarithmic decrement of the correlation.
    damping_error : (m,) array
        Standard error of the straight line through the logarithms. Its points share their noise, so
        it measures how straight the decay is rather than how certain the ratio is.
    damping_scatter : (m,) array
        Lower bound of the ratio's standard deviation for a record of this length.
    shape : (m, c) array
        Real, unit peak.
    complexity : (m,) array
        Share of the imaginary part in the squared length of the complex shape.
    complex_shape : (m, c) complex array
        Singular vectors at the peaks, of unit length.
    peak_hz : (m,) array
        Lines of the peaks.
    bell_hz : (m, 2) array
        First and last line of each mode's bell.
    names : tuple of str
        Names of the c channels.
    frequencies : (f,) array, Hz
        Lines.
    singular_values : (f, c) array, (m/s2)^2/Hz
        Falling.
    segments : int
        Number of segments averaged.
    averages : float
        Number of independent segments that would scatter as much.
    cautions : tuple of str
        Sentences that a reader should see beside the numbers.
    """

    frequency_hz: Array
    damping_ratio: Array
    damping_error: Array
    damping_scatter: Array
    shape: Array
    complexity: Array
    complex_shape: ComplexArray
    peak_hz: Array
    bell_hz: Array
    names: tuple[str, ...]
    frequencies: Array
    singular_values: Array
    segments: int
    averages: float
    cautions: tuple[str, ...]

    __repr__ = one_line


def operational_modes(
    acceleration: Array,
    sample_rate: float,
    segment_s: float,
    *,
    near: Sequence[float] | None = None,
    count: int | None = None,
    band: tuple[float, float] | None = None,
    prominence_db: float = 10.0,
    singular_value: int = 1,
    mac_limit: float = 0.8,
    amplitude_range: tuple[float, float] = (0.9, 0.4),
    overlap: float = 0.5,
    window: str = "hann",
    names: Sequence[str] | None = None,
) -> OperationalModes:
    """Frequencies, damping ratios and shapes by (enhanced) frequency domain decomposition.

    The excitation is assumed to be broadband: constant over the frequencies of a mode's bell. Modes
    that lie close together also need excitation at more than one point. A segment should last 1 /
    (zeta f), and the record some hundred times that.

    Parameters
    ----------
    acceleration : (n, c) array, m/s2
        At equal intervals, one column per channel, two or more; those of one direction at a
        time, where modes of both lie close together.
    sample_rate : float, Hz
    segment_s : float, s
        Length of a segment.
    near : sequence of float, Hz, optional
        Frequencies; the modes are those of the highest lines within a tenth of each.
    count : int, optional
        Number of modes, the most prominent peaks; without it and ``near``, all prominent peaks.
    band : (float, float), Hz, optional
        Frequency range in which peaks are sought.
    prominence_db : float
        Minimum height of a peak above its valleys.
    singular_value : int
        The singular value whose peaks count; 2 for the weaker one of two modes at nearly the same
        frequency, whose shapes must be orthogonal.
    mac_limit : float
        Minimum modal assurance of the lines of a bell with its peak.
    amplitude_range : (float, float)
        Of the correlation function in the decrement, over its value at lag 0.
    overlap : float
        See :func:`cross_spectral_matrix`.
    window : str
        See :func:`cross_spectral_matrix`.
    names : sequence of str, optional
        Of the channels; by default channel 1, channel 2, ...

    Returns
    -------
    OperationalModes

    Raises
    ------
    InputError
        Invalid arrays or settings, fewer segments than channels, no peak, or fewer than
        asked for, or a mode asked for with ``near`` whose bell is too narrow.
    """
    samples = np.asarray(acceleration, dtype=np.float64)
    channels = samples.shape[1] if samples.ndim == 2 else 0
    _check_settings(near, count, singular_value, mac_limit, channels)
    labels = _labels(names, channels)
    amplitude_range = checked_range(amplitude_range)
    spectra = cross_spectral_matrix(samples, sample_rate, segment_s, overlap, window)
    values, vectors = singular_values(spectra)
    chosen = values[:, singular_value - 1]
    if near is not None:
        peaks = peaks_near(spectra.frequency, chosen, near)
    else:
        peaks = _prominent(spectra.frequency, chosen, band, prominence_db, count)
    cautions = _of_record(spectra, channels)
    modes: list[_Mode] = []
    for peak in peaks:
        vector = vectors[peak.line, :, singular_value - 1]
        try:
            modes.append(_mode(peak, vector, values, vectors, spectra, mac_limit, amplitude_range))
        except InputError as fault:
            if near is not None or count is not None:
                raise
            at = spectra.frequency[peak.line]
            cautions.append(f"peak at {at:.4g} Hz left out: {fault}")
    if not modes:
        raise InputError(
            "acceleration",
            f"{len(peaks)} peaks, none of them with the bell of a mode; {'; '.join(cautions)}",
            "a record in which modes can be identified",
            "Use longer segments, or a longer record.",
        )
    for mode in modes:
        cautions += _of_mode(mode, spectra, values, singular_value, amplitude_range[1])
    shapes = [real_shape(mode.vector) for mode in modes]
    return OperationalModes(
        frequency_hz=np.array([mode.fit.frequency_hz for mode in modes]),
        damping_ratio=np.array([mode.fit.damping_ratio for mode in modes]),
        damping_error=np.array([mode.fit.damping_error for mode in modes]),
        damping_scatter=np.array([_scatter(mode.fit, spectra.duration) for mode in modes]),
        shape=np.array([shape for shape, _ in shapes]),
        complexity=np.array([complexity for _, complexity in shapes]),
        complex_shape=np.array([mode.vector for mode in modes]),
        peak_hz=spectra.frequency[[mode.line for mode in modes]],
        bell_hz=spectra.frequency[np.array([mode.ends for mode in modes])],
        names=labels,
        frequencies=spectra.frequency,
        singular_values=values,
        segments=spectra.segments,
        averages=spectra.averages,
        cautions=tuple(cautions),
    )


@dataclass(frozen=True, eq=False)
class _Mode:
    line: int
    vector: ComplexArray
    ends: tuple[int, int]
    fit: Decrement


def _mode(
    peak: Peak,
    vector: ComplexArray,
    values: Array,
    vectors: ComplexArray,
    spectra: CrossSpectra,
    mac_limit: float,
    amplitude_range: tuple[float, float],
) -> _Mode:
    bell = single_mode_bell(values, vectors, peak.line, vector, mac_limit, peak.valleys)
    at = float(spectra.frequency[peak.line])
    fit = mode_of_bell(bell, spectra, at, amplitude_range)
    return _Mode(peak.line, vector, (bell.first, bell.last), fit)


def _prominent(
    frequency: Array,
    values: Array,
    band: tuple[float, float] | None,
    prominence_db: float,
    count: int | None,
) -> list[Peak]:
    """All prominent peaks in a band, or the most prominent ones, rising in frequency."""
    low, high = band or (0.0, float(frequency[-1]))
    if not 0 <= low < high <= frequency[-1]:
        allowed = f"0 <= low < high <= {frequency[-1]:g} Hz, half the sampling frequency"
        raise InputError("band", f"{low:g} to {high:g} Hz", allowed, "Choose another.")
    peaks, prominence = pick_peaks(frequency, values, (low, high), prominence_db)
    wanted = len(peaks) if count is None else count
    if not 0 < wanted <= len(peaks):
        raise InputError(
            "acceleration",
            f"{len(peaks)} peaks of {prominence_db:g} dB or more from {low:g} to {high:g} Hz",
            f"{count or 1} or more",
            "Ask for fewer, lower prominence_db, or use longer segments.",
        )
    best = np.sort(np.argsort(-prominence)[:wanted])
    return [peaks[i] for i in best]


def _scatter(fit: Decrement, duration: float) -> float:
    """Lower bound of the standard deviation of a damping ratio from one record.

    The slow amplitude of a lightly damped mode under white noise is a complex process of first
    order with decay alpha = zeta omega. Its likelihood over T bounds the variance of an estimated
    alpha by alpha / T (Cramer and Rao), the squared relative error by 1 / (alpha T).
    """
    decay = 2 * np.pi * fit.frequency_hz * fit.damping_ratio
    return fit.damping_ratio / float(np.sqrt(decay * duration))


def _of_record(spectra: CrossSpectra, channels: int) -> list[str]:
    cautions = []
    if spectra.averages < _FEW_AVERAGES:
        cautions.append(
            f"{spectra.segments} overlapping segments count as {spectra.averages:.3g} independent "
            f"ones: each line scatters by {100 / np.sqrt(spectra.averages):.0f} %; use a longer "
            "record"
        )
    if spectra.segments < 2 * channels:
        cautions.append(
            f"{spectra.segments} segments for {channels} channels: the small singular values are "
            "underestimated; use shorter segments or a longer record"
        )
    return cautions


def _of_mode(
    mode: _Mode, spectra: CrossSpectra, values: Array, singular_value: int, lower: float
) -> list[str]:
    """What a reader should know about one mode."""
    cautions = []
    name = f"mode at {mode.fit.frequency_hz:.4g} Hz"
    if not mode.fit.reached:
        needed = 1 / (mode.fit.damping_ratio * mode.fit.frequency_hz)
        cautions.append(
            f"{name}: the correlation does not decay to {lower:g} within a third of a segment of "
            f"{spectra.segment:g} s, and the damping is that of the larger amplitudes; segments of "
            f"{needed:.3g} s, 1 / (zeta f), would be long enough"
        )
    spread = _scatter(mode.fit, spectra.duration) / mode.fit.damping_ratio
    if spread > _UNCERTAIN:
        cautions.append(
            f"{name}: damping ratios from records of {spectra.duration:g} s scatter by "
            f"{100 * spread:.0f} % or more"
        )
    first, second = values[mode.line, :2]
    if singular_value == 1 and second > _CLOSE * first:
        cautions.append(
            f"{name}: the second singular value is {100 * second / first:.0f} % of the first: "
            "another mode or noise is close; use channels of one direction, or singular_value=2"
        )
    _, complexity = real_shape(mode.vector)
    if complexity > _COMPLEX:
        cautions.append(
            f"{name}: {100 * complexity:.1f} % of the complex shape is out of phase and is "
            "discarded"
        )
    return cautions


def _check_settings(
    near: Sequence[float] | None,
    count: int | None,
    singular_value: int,
    mac_limit: float,
    channels: int,
) -> None:
    if channels == 1:
        raise InputError(
            "acceleration",
            "1 channel",
            "2 channels or more",
            "A single channel has no mode shapes: use power_spectral_density and free_decay.",
        )
    if near is not None and (count is not None or len(near) == 0):
        raise InputError(
            "near", f"{list(near)} and count {count}", "one of the two", "Leave one out."
        )
    if singular_value not in (1, 2):
        raise InputError("singular_value", singular_value, "1 or 2", "Choose one of them.")
    if not 0 < mac_limit < 1:
        raise InputError("mac_limit", mac_limit, "between 0 and 1", "Use 0.8, a common value.")


def _labels(names: Sequence[str] | None, channels: int) -> tuple[str, ...]:
    labels = tuple(names) if names is not None else ()
    if names is not None and len(labels) != channels:
        raise InputError(
            "names", f"{len(labels)} names", f"{channels}, one per channel", "Complete them."
        )
    return labels or tuple(f"channel {i + 1}" for i in range(channels))
