"""Wet shares of strips against the closed form of the wetted length, and added mass by hand."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.hydrodynamics import RegularWater, SteadyWater, upright

from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.forces.added_mass import AddedMass, SplashAddedMass
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import (
    SMOOTHING,
    STRIP_LENGTH,
    Strips,
    strips_up_to,
    wet_share,
)

MUDLINE, TOP, LOWEST, HIGHEST = -30.0, 12.0, -3.1, 4.3


def splash_zone() -> Strips:
    height, length, wet = strips_up_to(MUDLINE, TOP, 0.0, LOWEST, HIGHEST)
    return Strips(height, length, np.full(len(height), 9.0), wet)


def shares(strips: Strips, surface: float) -> Array:
    return np.array([wet_share(surface, *ends) for ends in strips.ends])


def test_without_stretching_strips_end_at_the_surface() -> None:
    """The strips of a surface that stays are the equal ones up to it, and wholly wet."""
    height, length, wet = strips_up_to(MUDLINE, TOP, 0.0, 0.0, 0.0)
    expected = Strips.between(MUDLINE, 0.0)
    assert np.array_equal(height, expected[0])
    assert np.array_equal(length, expected[1])
    assert wet.all()
    strips = Strips(height, length, np.full(60, 9.0), wet)
    assert np.all(shares(strips, 0.0) == 1.0)
    assert len(strips_up_to(MUDLINE, -10.0, 0.0, 0.0, 0.0)[0]) == 40


def test_strips_reach_what_the_sea_reaches() -> None:
    """The highest strip ends above the highest surface, or at the top of the structure."""
    strips = splash_zone()
    ends = strips.height + strips.length / 2
    assert ends[-1] == pytest.approx(HIGHEST + SMOOTHING, rel=1e-14)
    assert np.allclose(ends[:-1], strips.height[1:] - strips.length[1:] / 2, atol=1e-12)
    assert strips.length.max() <= STRIP_LENGTH * (1 + 1e-12)
    assert ends[strips.wet].max() <= LOWEST - SMOOTHING
    low, length, _ = strips_up_to(MUDLINE, 2.0, 0.0, LOWEST, HIGHEST)
    assert low[-1] + length[-1] / 2 == pytest.approx(2.0, rel=1e-14)


@pytest.mark.parametrize("surface", np.linspace(LOWEST, HIGHEST, 41).tolist())
def test_wetted_length(surface: float) -> None:
    """The wet lengths add up to the depth of water, at any surface; their moments nearly so."""
    strips = splash_zone()
    share = shares(strips, surface)
    assert np.all((share >= 0) & (share <= 1))
    assert np.all(share[strips.wet] == 1)
    assert share @ strips.length == pytest.approx(surface - MUDLINE, rel=1e-14)
    moment = (share * strips.length) @ (strips.height - MUDLINE)
    bound = STRIP_LENGTH**2 / 8 + SMOOTHING**2 / 6
    assert abs(moment - (surface - MUDLINE) ** 2 / 2) <= bound


def test_a_strip_is_wetted_smoothly() -> None:
    """From 0 to 1 without a jump of the slope, within the smoothing of both ends."""
    surface = np.linspace(-0.5, 1.0, 3001)
    share = np.array([wet_share(s, 0.0, 0.5) for s in surface])
    step = surface[1] - surface[0]
    slope = np.diff(share) / step
    assert np.all(slope >= -1e-12)
    assert slope.max() <= 1 / 0.5 + 1e-9
    assert np.abs(np.diff(slope)).max() <= step / (0.5 * 2 * SMOOTHING) + 1e-9
    assert share[surface < -SMOOTHING].max() == 0
    assert share[surface > 0.5 + SMOOTHING].min() == 1
    assert wet_share(0.25, 0.0, 0.5) == pytest.approx(0.5, rel=1e-14)


def test_a_kinked_share_would_be_seen() -> None:
    """Negative control: the share without smoothing jumps in its slope."""
    surface = np.linspace(-0.5, 1.0, 3001)
    share = np.clip(surface / 0.5, 0.0, 1.0)
    step = surface[1] - surface[0]
    jump = np.abs(np.diff(np.diff(share) / step)).max()
    assert jump > 100 * step / (0.5 * 2 * SMOOTHING)


def test_added_mass_under_a_moving_surface() -> None:
    """rho Ca A times the depth of water, as of the moment, on a pile that is accelerated."""
    strips = splash_zone()
    wave = RegularWater(strips.height, 30.0, 3.0, 0.7, 0.06, stretched=True)
    wet = strips.wet
    parts = (strips.part(wet), strips.part(~wet))
    permanent = AddedMass.of(parts[0], 1025.0, 0.9)
    splash = SplashAddedMass(parts[1], 1025.0 * 0.9 * parts[1].volume, wave)
    pushed = np.array([0.3, -0.1, 0.2])
    for time, rise in [(0.0, 1.0), (1.3, 1.0), (4.4, 0.5), (2.0, 0.0)]:
        total = np.zeros(3)
        for load in (permanent, splash):
            motion = replace(
                upright(load.height), acceleration=np.tile(pushed, (len(load.height), 1))
            )
            total += load.forces(time, motion, rise).force.sum(axis=0)
        depth = 30.0 + rise * 3.0 * np.cos(0.7 * time)
        mass = 1025.0 * 0.9 * np.pi / 4 * 81.0 * depth
        assert total == pytest.approx(-mass * pushed * [1, 1, 0], rel=1e-12)


def test_drag_and_inertia_follow_the_surface() -> None:
    """In a uniform stream both forces grow with the depth of water."""

    class Stream(SteadyWater):
        def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
            rows = super().time_inputs(time, ramp_factor)
            rows[:, 1 + 3 * self.count :] = np.tile([0.4, 0.0, 0.0], self.count)
            return rows

    strips = splash_zone()
    for surface in (-2.0, 0.1, 3.3):
        stream = Stream(len(strips.height), (1.5, 0.0, 0.0), surface)
        load = MorisonForce(strips, stream, 1025.0, 0.9, 0.8)
        depth = surface - MUDLINE
        result = load.forces(0.0, upright(strips.height), 1.0)
        drag = 0.5 * 1025.0 * 0.8 * 9.0 * 1.5**2 * depth
        inertia = 1025.0 * 1.9 * np.pi / 4 * 81.0 * 0.4 * depth
        assert result.force[:, 0].sum() == pytest.approx(drag + inertia, rel=1e-12)
        assert result.dissipation == pytest.approx(1.5 * drag, rel=1e-12)
