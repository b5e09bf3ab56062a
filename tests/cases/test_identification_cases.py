"""Modes out of accelerations in a case: what holds still has no acceleration, and no part in it."""

from __future__ import annotations

import pytest

import offwind_pin as ow
from offwind_pin.cases.case import OperationalModesSettings
from offwind_pin.cases.identification import identify


@pytest.fixture(scope="module")
def asked() -> OperationalModesSettings:
    return OperationalModesSettings(duration_s=600.0, segment_s=100.0, nodes=5)


def test_a_clamped_mudline_stands_still(oc6: ow.Turbine, asked: OperationalModesSettings) -> None:
    """Its channel is left out of the spectra, its place in the shapes is zero."""
    system = ow.build(oc6, "clamped", elements=8)
    modes = ow.modes(system, 8)
    result = identify(system, modes, asked, seed=1)
    shape = result["shape"].to_numpy()
    assert shape.shape == (2, 5)
    assert (shape[:, 0] == 0).all()
    assert abs(shape[:, 1:]).max(axis=1) == pytest.approx(1.0)
    assert (result["assurance"] > 0.99).all()
    frequency, computed = (result[name].to_numpy() for name in ("frequency", "computed_frequency"))
    assert frequency == pytest.approx(computed, rel=0.02)


def test_modes_that_are_missing_are_reported_before_the_record(
    oc6: ow.Turbine, asked: OperationalModesSettings
) -> None:
    system = ow.build(oc6, "clamped", elements=8)
    few = ow.modes(system, 2)

    def shaken(now: float, duration: float) -> None:
        raise AssertionError("it was simulated first")

    with pytest.raises(ow.InputError, match=r"FA2.*compute more modes"):
        identify(system, few, asked, seed=1, progress=shaken)
