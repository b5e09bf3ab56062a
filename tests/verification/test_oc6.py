"""The shipped benchmark: what the ledger's rows do not say of it."""

import pytest

import offwind_pin as ow


def test_second_mode_peaks_below_the_top(distributed_wet: ow.System) -> None:
    """The first mode peaks at the yaw bearing, the second one does not."""
    found = ow.modes(distributed_wet, 6)
    first, second = (found.shape_peak_height_ratio[found.index(mode)] for mode in ("FA1", "FA2"))
    assert first == pytest.approx(1.0, abs=1e-12)
    assert second < 0.7


def test_toe_springs_are_those_of_the_6x6(oc6: ow.Turbine) -> None:
    """Vertical and torsional stiffness stand at the toe as they stand in the coupled springs."""
    soil = oc6.soil.distributed_springs
    assert soil is not None
    assert soil.toe_vertical_stiffness == pytest.approx(1.12e10, rel=1e-3)
    assert soil.toe_torsional_stiffness == pytest.approx(2.55e11, rel=2e-3)


def test_surrogate_says_so(distributed_wet: ow.System) -> None:
    """A soil that stands in for the benchmark's is never silent about it."""
    assert distributed_wet.foundation.surrogate
    assert "not public" in distributed_wet.foundation.surrogate
