"""pyOMA2, an independent code for operational modal analysis, finds the same modes."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.white_noise import THREE_FORCES, three_modes
from numpy.testing import assert_allclose
from pyoma2.algorithms import FDD, FSDD
from pyoma2.functions.fdd import SD_est, SD_svalsvec
from pyoma2.setup import SingleSetup

from offwind_pin.base.definition import Array
from offwind_pin.signal.modal_identification.cross_spectra import cross_spectral_matrix
from offwind_pin.signal.modal_identification.fdd import singular_values
from offwind_pin.signal.modal_identification.identify import OperationalModes, operational_modes
from offwind_pin.signal.modal_identification.modal_assurance import modal_assurance

RATE, SEGMENT = 50.0, 160.0
"""Hz and s: its correlation function stands on a grid of two fifths of a sample, without
interpolation, which at a coarser rate moves its frequencies by some tenths of a per cent."""
SYSTEM = three_modes()


@pytest.fixture(scope="module")
def record() -> Array:
    return SYSTEM.accelerations(THREE_FORCES, 1 / RATE, 400_000, seed=21)


@pytest.fixture(scope="module")
def ours(record: Array) -> OperationalModes:
    return operational_modes(record, RATE, SEGMENT)


@pytest.fixture(scope="module")
def theirs(record: Array) -> SingleSetup:
    setup = SingleSetup(record, fs=RATE)
    lines = {"nxseg": round(SEGMENT * RATE), "method_SD": "per", "pov": 0.5}
    # Not its EFDD, which turns the roots of the singular values into a correlation function, and
    # finds about twice the damping; its FSDD takes the spectral matrix in the direction of the shape.
    setup.add_algorithms(FDD(name="FDD", **lines), FSDD(name="FSDD", **lines))
    setup.run_all()
    wanted = list(SYSTEM.frequency_hz)
    setup.mpe("FDD", sel_freq=wanted, DF=0.1)
    setup.mpe("FSDD", sel_freq=wanted, DF1=0.1, DF2=0.6, sppk=1, npmax=30)
    return setup


def test_spectra_and_singular_values(record: Array) -> None:
    """The matrix and its singular values, line by line; theirs have each segment's mean removed, which
    touches the lowest lines alone, are SciPy's conjugates, and of the values the roots."""
    part = record[:50_000]
    spectra = cross_spectral_matrix(part, RATE, SEGMENT)
    values, _ = singular_values(spectra)
    frequency, matrix = SD_est(part.T, part.T, 1 / RATE, round(SEGMENT * RATE), "per")
    roots, _ = SD_svalsvec(matrix)
    scale = np.max(np.abs(spectra.matrix), axis=(1, 2))[3:, None, None]
    assert_allclose(spectra.frequency, frequency, atol=1e-9)
    moved = np.moveaxis(matrix, 2, 0).conj()[3:]
    assert np.max(np.abs(spectra.matrix[3:] - moved) / scale) < 1e-9
    theirs = np.diagonal(roots).real[3:] ** 2
    assert np.max(np.abs(values[3:] - theirs) / values[3:, :1]) < 1e-9


def test_same_modes(ours: OperationalModes, theirs: SingleSetup) -> None:
    """Decrement of a bell: frequencies within 0.2 %, damping within 10 %, the same shapes."""
    found = theirs["FSDD"].result
    assert_allclose(ours.frequency_hz, found.Fn, rtol=2e-3)
    assert_allclose(ours.damping_ratio, found.Xi, rtol=0.1)
    assert np.min(modal_assurance(ours.shape, found.Phi.T).diagonal()) > 0.9999
    # Negative control: the next mode's frequency and shape do not pass.
    assert not np.allclose(ours.frequency_hz, np.roll(found.Fn, 1), rtol=2e-3)
    assert np.max(modal_assurance(ours.shape, np.roll(found.Phi.T, 1, 0)).diagonal()) < 0.9


def test_same_peaks(ours: OperationalModes, theirs: SingleSetup) -> None:
    """Plain decomposition: lines within the bell's half-power width, and shapes there."""
    found = theirs["FDD"].result
    width = 2 * SYSTEM.damping_ratio * SYSTEM.frequency_hz
    assert np.all(np.abs(ours.peak_hz - found.Fn) < width)
    assert np.min(modal_assurance(ours.shape, found.Phi.T).diagonal()) > 0.9999
