"""Water over time: the table against direct sums, stretching by hand, blocks, current, rise."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.kinematics import WaterSeries, WaterSurface
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.nufft import HarmonicSeries

GRAVITY, DEPTH = 9.80665, 30.0
HEIGHT = np.concatenate([np.linspace(-29.9, -0.25, 24), np.linspace(0.0, 3.0, 5)])


def sea(seed: int = 3) -> LinearWaves:
    return ow.IrregularWaves(6.0, 9.0, seed=seed, repeat_period=600.0).waves(DEPTH, GRAVITY)


def directly(waves: LinearWaves, height: Array, time: float) -> tuple[Array, Array, float]:
    """Velocity and acceleration (n, 3), and elevation, summed over all components."""
    turn = np.exp(1j * waves.omega * time)
    velocity, acceleration = waves.velocity(height), waves.acceleration(height)
    return (velocity @ turn).real.T, (acceleration @ turn).real.T, (waves.elevation @ turn).real


def series(waves: LinearWaves, stretching: str, level: float = 0.0) -> WaterSeries:
    return WaterSeries(HEIGHT + level, WaterSurface(waves, level, stretching))  # type: ignore[arg-type]


@pytest.mark.parametrize("count", [1, 3, 2000])
def test_table_gives_the_sum(count: int) -> None:
    """At times within and beyond the period, for few and many harmonics, a mean among them."""
    draw = np.random.default_rng(count)
    harmonic = np.unique(np.concatenate([[0], draw.integers(1, 4 * count, count)])).astype(float)
    shape = (3, len(harmonic))
    amplitude = draw.normal(size=shape) + 1j * draw.normal(size=shape)
    time = draw.uniform(-50.0, 150.0, 200)
    exact = (amplitude @ np.exp(2j * np.pi * np.outer(harmonic, time) / 70.0)).real.T
    found = HarmonicSeries(70.0, harmonic, amplitude).at(time)
    assert np.max(np.abs(found - exact)) < 1e-11 * np.max(np.abs(exact))


def test_extremes_of_a_sum() -> None:
    """Against a dense sampling of the direct sum."""
    waves = sea()
    low, high = HarmonicSeries(600.0, waves.harmonic, waves.elevation[None]).extremes
    time = np.arange(0, 600.0, 0.005)
    dense = np.concatenate(
        [
            (np.exp(1j * np.outer(part, waves.omega)) @ waves.elevation).real
            for part in np.array_split(time, 50)
        ]
    )
    assert low[0] == pytest.approx(dense.min(), abs=1e-4 * np.ptp(dense))
    assert high[0] == pytest.approx(dense.max(), abs=1e-4 * np.ptp(dense))


def test_rows_without_stretching() -> None:
    """Kinematics at the strips as they stand, and a surface that stays."""
    waves = sea()
    water, surface = series(waves, "none"), 0.0
    for time in (0.0, 13.37, 555.5):
        row = water.time_inputs(np.array([time]), np.ones(1))[0]
        velocity, acceleration, _ = directly(waves, HEIGHT, time)
        assert row[0] == surface
        assert_allclose(row[1 : 1 + velocity.size], velocity.ravel(), atol=1e-9, rtol=0)
        assert_allclose(row[1 + velocity.size :], acceleration.ravel(), atol=1e-9, rtol=0)
    assert water.highest_surface == water.lowest_surface == 0.0


@pytest.mark.parametrize("rule", ["vertical", "wheeler", "extrapolation"])
@pytest.mark.parametrize("rise", [1.0, 0.4])
def test_stretching_by_hand(rule: str, rise: float) -> None:
    """Each rule's own height, and the sum of all components there; a tide lifts all of it."""
    waves, level = sea(), 1.5
    water = series(waves, rule, level)
    for time in (3.0, 77.7, 402.0):
        row = water.time_inputs(np.array([time]), np.array([rise]))[0]
        _, _, elevation = directly(waves, HEIGHT, time)
        elevation *= rise
        place = np.minimum(HEIGHT, 0.0)
        if rule == "wheeler":
            place = (HEIGHT - elevation) * DEPTH / (DEPTH + elevation)
        place = np.clip(place, -DEPTH, 0.0)
        velocity, acceleration, _ = directly(waves, place, time)
        if rule == "extrapolation":
            step = 1e-3
            below = directly(waves, np.full(1, -step), time)
            here = directly(waves, np.zeros(1), time)
            above = np.clip(HEIGHT, 0.0, max(elevation, 0.0))[:, None]
            curve = directly(waves, np.full(1, -2 * step), time)
            velocity = velocity + above * (3 * here[0] - 4 * below[0] + curve[0]) / (2 * step)
            slope = (3 * here[1] - 4 * below[1] + curve[1]) / (2 * step)
            acceleration = acceleration + above * slope
        assert row[0] == pytest.approx(level + elevation, abs=1e-9)
        tolerance = 3e-6 if rule != "extrapolation" else 1e-4
        largest = np.max(np.abs(velocity))
        assert_allclose(
            row[1 : 1 + velocity.size], rise * velocity.ravel(), atol=tolerance * largest, rtol=0
        )
        largest = np.max(np.abs(acceleration))
        assert_allclose(
            row[1 + velocity.size :], rise * acceleration.ravel(), atol=tolerance * largest, rtol=0
        )
    assert water.highest_surface > level + 3.0
    assert water.lowest_surface < level - 3.0


def test_rules_differ_under_a_crest() -> None:
    """In the crest the straight continuation is fastest, Wheeler's slowest."""
    wave = LinearWaves.free(9.0, np.ones(1), np.array([3.0 + 0j]), DEPTH, GRAVITY)
    fast = [
        series(wave, rule)
        .time_inputs(np.zeros(1), np.ones(1))[0][1 : 1 + 3 * len(HEIGHT)]
        .reshape(-1, 3)
        for rule in ("extrapolation", "vertical", "wheeler")
    ]
    at_crest = [velocity[-1, 0] for velocity in fast]
    assert at_crest[0] > at_crest[1] * 1.05
    assert at_crest[1] == pytest.approx(at_crest[2], rel=1e-9)
    under_it = [velocity[-5, 0] for velocity in fast]
    assert under_it[1] == pytest.approx(under_it[0])
    assert under_it[2] < 0.95 * under_it[1]


@pytest.mark.parametrize("rule", ["none", "wheeler"])
def test_rows_depend_on_the_time_alone(rule: str) -> None:
    """To the last bit in the same blocks, which a resumed run has; to rounding in others."""
    time = np.linspace(0.0, 40.0, 501)
    rise = np.linspace(0.0, 1.0, 501)
    whole = series(sea(), rule).time_inputs(time, rise)
    other = series(sea(), rule)
    pieces = [
        other.time_inputs(time[part], rise[part])
        for part in (slice(0, 7), slice(7, 400), slice(400, 501))
    ]
    assert np.array_equal(whole, series(sea(), rule).time_inputs(time, rise))
    assert_allclose(whole, np.concatenate(pieces), rtol=0, atol=1e-13)
    assert not np.array_equal(whole, series(sea(4), rule).time_inputs(time, rise))


def test_current_acts_in_full() -> None:
    """At rise 0 there is nothing but the current; above the level it is that at the level."""
    profile = ow.CurrentTable(1.0, -30.0, depth=(0.0, 60.0), factor=(1.0, 0.0))
    current = profile.velocity(HEIGHT, DEPTH)
    water = WaterSeries(HEIGHT, WaterSurface(sea(), 0.0, "wheeler"), current=current)
    row = water.time_inputs(np.array([5.0]), np.zeros(1))[0]
    n = len(HEIGHT)
    assert row[0] == 0.0
    towards = np.array([np.cos(np.pi / 6), -0.5, 0.0])
    expected = towards * (1 + np.minimum(HEIGHT, 0.0)[:, None] / 60)
    assert_allclose(row[1 : 1 + 3 * n].reshape(n, 3), expected)
    assert np.all(row[1 + 3 * n :] == 0)


def test_unknown_stretching_is_refused() -> None:
    with pytest.raises(ow.InputError, match="stretching"):
        WaterSurface(sea(), 0.0, "willer")  # type: ignore[arg-type]


def test_water_level_below_the_bed(oc6: ow.Turbine) -> None:
    shallow = oc6.replace(site=oc6.site.replace(water_depth=10.0))
    calm = ow.StillWater(water_level=-12.0)
    with pytest.raises(ow.InputError, match="water_level"):
        ow.build(shallow, "clamped", calm).hydrodynamics  # noqa: B018
