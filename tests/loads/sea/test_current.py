"""Currents: profiles, means, and what they do to a structure and to a wave."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.loads.sea.current import mean_velocity

DEPTH = 30.0
Z = np.array([-30.0, -20.0, -10.0, 0.0, 2.0])


def test_profiles() -> None:
    """Each formula by hand; above the mean water level it is that at it."""
    speeds = {
        ow.UniformCurrent(1.2): [1.2] * 5,
        ow.PowerLawCurrent(1.2): list(1.2 * np.array([0, 1 / 3, 2 / 3, 1, 1]) ** (1 / 7)),
        ow.SurfaceCurrent(1.2): [0.0, 0.0, 0.6, 1.2, 1.2],
        ow.CurrentTable(1.2, depth=(0.0, 20.0), factor=(1.0, 0.5)): [0.6, 0.6, 0.9, 1.2, 1.2],
    }
    for current, expected in speeds.items():
        velocity = current.velocity(Z, DEPTH)
        assert_allclose(velocity[:, 0], expected, atol=1e-15)
        assert np.all(velocity[:, 1:] == 0)


def test_direction_and_sum() -> None:
    """Vectors add up; 90 degrees is towards +y."""
    both = ow.CurrentSum((ow.UniformCurrent(1.0, 90.0), ow.UniformCurrent(0.5, 180.0)))
    assert_allclose(both.velocity(Z, DEPTH), np.tile([-0.5, 1.0, 0.0], (5, 1)), atol=1e-15)


def test_mean_over_the_depth() -> None:
    """The power law's mean is 1 / (1 + exponent), the surface layer's reach / (2 h)."""
    assert mean_velocity(ow.PowerLawCurrent(2.0), DEPTH)[0] == pytest.approx(2 * 7 / 8, rel=5e-4)
    mean = mean_velocity(ow.SurfaceCurrent(2.0, 90.0), DEPTH)
    assert mean[1] == pytest.approx(2.0 * 20 / 60, rel=2e-3)


def test_factors_up_to_the_fastest_current_pass() -> None:
    """Negative control of the refusal: a factor is no speed."""
    table = ow.CurrentTable(0.5, depth=(0.0, 1.0), factor=(1.0, -20.0))
    assert table.velocity(np.array([-1.0]), 20.0)[0, 0] == pytest.approx(-10.0)


def test_current_pushes_the_structure(oc6: ow.Turbine) -> None:
    """The mudline's force under a uniform current is its drag on the wetted length."""
    sea = ow.StillWater(current=ow.UniformCurrent(1.5))
    calm, pushed = (
        ow.static(ow.build(oc6, "clamped", water, elements=20)) for water in (ow.StillWater(), sea)
    )
    site = oc6.site
    area = 9.0 * site.water_depth
    assert isinstance(oc6.hydrodynamics.drag_coefficient, float)
    drag = 0.5 * site.water_density * oc6.hydrodynamics.drag_coefficient * area * 1.5**2
    change = pushed.mudline_load[0] - calm.mudline_load[0]
    assert change == pytest.approx(drag, rel=1e-3)


def test_tide_wets_more(oc6: ow.Turbine) -> None:
    """Two metres more of water: strips end there, and the drag grows with them."""
    sea = ow.StillWater(current=ow.UniformCurrent(1.5), water_level=2.0)
    system = ow.build(oc6, "clamped", sea, elements=20)
    assert system.hydrodynamics is not None
    strips = system.hydrodynamics.strips
    assert strips.height[-1] + strips.length[-1] / 2 == pytest.approx(2.0)
    dry = ow.build(oc6, "clamped", elements=20)
    force = ow.static(system).mudline_load[0] - ow.static(dry).mudline_load[0]
    assert isinstance(oc6.hydrodynamics.drag_coefficient, float)
    drag = 0.5 * oc6.site.water_density * oc6.hydrodynamics.drag_coefficient * 1.5**2
    assert force == pytest.approx(drag * 9.0 * (oc6.site.water_depth + 2.0), rel=1e-3)


def test_stream_wave_is_carried_by_the_current() -> None:
    """Its period is the observer's; the current's own profile is not in the waves twice."""
    current = ow.PowerLawCurrent(1.0)
    still = ow.StreamWaves(9.0, 10.0).waves(DEPTH, 9.81)
    moved = ow.StreamWaves(9.0, 10.0, current=current).waves(DEPTH, 9.81)
    against = ow.StreamWaves(9.0, 10.0, direction_deg=180.0, current=current).waves(DEPTH, 9.81)
    assert moved.wave.eulerian_current == pytest.approx(7 / 8, rel=5e-4)
    assert against.wave.eulerian_current == pytest.approx(-7 / 8, rel=5e-4)
    assert against.wave.length < still.wave.length < moved.wave.length
    assert np.all(moved.velocity(np.array([-5.0]))[:, :, 0] == 0)
