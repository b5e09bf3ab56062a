"""Springs of parallel sliders: backbone, Masing's loops, heat that is never negative."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.soil.curves.laws import (
    LinearCurves,
    PolygonCurves,
    PowerCurves,
    TanhCurves,
)
from offwind_pin.loads.soil.springs.dashpot import NO_DASHPOT, Dashpot
from offwind_pin.loads.soil.springs.elastic import (
    LATERAL,
    ROCKING,
    TORSIONAL,
    VERTICAL,
    SpringComponent,
)
from offwind_pin.loads.soil.springs.hysteretic import HystereticSprings, sliders_of

MODULUS, ULTIMATE, LENGTH = 2e8, 4e6, 0.75
BEND = ULTIMATE / MODULUS
"""Where the initial stiffness would reach the ultimate resistance, in m."""


def tanh() -> TanhCurves:
    return TanhCurves(np.array([MODULUS]), np.array([ULTIMATE]))


def springs(
    sliders: int = 40, component: SpringComponent = LATERAL, dashpot: Dashpot = NO_DASHPOT
) -> HystereticSprings:
    """One node on a tanh curve."""
    place = np.array([-40.0]), np.array([LENGTH])
    return HystereticSprings("soil", component, *place, tanh(), dashpot, sliders)


def at(x: float, y: float = 0.0) -> PointMotion:
    u = np.array([[x, y, 0.0]])
    return PointMotion(u, u, 0 * u, np.array([[0.0, 0.0, 1.0]]))


def trace(load: HystereticSprings, path: Array, memory: Array) -> tuple[Array, float]:
    """(t, 2) pulls along a path (t, 2) of converged steps, and the heat in J."""
    pulls, heat = np.empty_like(path), 0.0
    for i, (x, y) in enumerate(path):
        motion = at(x, y)
        pulls[i] = -load.forces(0.0, motion, 1.0, memory).force[0, :2]
        made = load.commit(motion, memory)
        assert made >= 0
        heat += made
    return pulls, heat


def along_x(*corners: float, steps: int = 200) -> Array:
    """(t, 2) from corner to corner."""
    legs = [np.linspace(a, b, steps + 1)[1:] for a, b in itertools.pairwise(corners)]
    x = np.concatenate(legs)
    return np.column_stack([x, np.zeros_like(x)])


def test_first_loading_follows_the_backbone() -> None:
    """Exactly at the sliders' yield deflections, by chords in between, and constant past the last."""
    load = springs()
    _, limit = sliders_of(tanh(), 40)
    path = np.column_stack([limit[0], np.zeros(40)])
    pulls, _ = trace(load, path, np.zeros(load.memory_size))
    expected = ULTIMATE * LENGTH * np.tanh(limit[0] / BEND)
    assert pulls[:, 0] == pytest.approx(expected, rel=1e-12)
    between = along_x(0, 3 * BEND)
    pulls, _ = trace(load, between, np.zeros(load.memory_size))
    expected = ULTIMATE * LENGTH * np.tanh(between[:, 0] / BEND)
    assert pulls[:, 0] == pytest.approx(expected, rel=6e-3)
    far, farther = (load.forces(0.0, at(y), 1.0).force[0, 0] for y in (10 * BEND, 20 * BEND))
    assert far == pytest.approx(farther, rel=1e-14)


@pytest.mark.parametrize("amplitude", [0.3, 1.0, 3.0])
def test_loop_is_masings(amplitude: float) -> None:
    """A cycle dissipates 8 (integral of p to Y) - 4 p(Y) Y, within 0.1 % with 150 sliders.

    Of tanh the integral is p_u^2 / k ln cosh(k Y / p_u).
    """
    load = springs(150)
    size = amplitude * BEND
    memory = np.zeros(load.memory_size)
    trace(load, along_x(0, size), memory)
    pulls, heat = trace(load, along_x(size, -size, size), memory)
    energy = ULTIMATE * BEND * np.log(np.cosh(amplitude))
    expected = LENGTH * (8 * energy - 4 * ULTIMATE * np.tanh(amplitude) * size)
    assert heat == pytest.approx(expected, rel=1e-3)
    unloading = along_x(size, -size)[:, 0]
    half = ULTIMATE * LENGTH * np.tanh((size - unloading) / 2 / BEND)
    masing = ULTIMATE * LENGTH * np.tanh(amplitude) - 2 * half
    assert pulls[:200, 0] == pytest.approx(masing, abs=2e-3 * ULTIMATE * LENGTH)


def test_error_of_the_loop_is_of_second_order() -> None:
    """In the number of sliders; so that what a coarser choice costs is known."""
    sizes = np.array([10, 20, 40, 80])
    energy = ULTIMATE * BEND * np.log(np.cosh(1.5))
    expected = LENGTH * (8 * energy - 4 * ULTIMATE * np.tanh(1.5) * 1.5 * BEND)
    errors = []
    for count in sizes:
        load = springs(int(count))
        memory = np.zeros(load.memory_size)
        corner = 1.5 * BEND
        trace(load, np.array([[corner, 0.0]]), memory)
        _, heat = trace(load, along_x(corner, -corner, corner, steps=2000), memory)
        errors.append(abs(heat / expected - 1))
    order = -np.polyfit(np.log(sizes - 1), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.35)
    assert errors[1] < 0.03


def test_loops_close_and_small_ones_are_forgotten() -> None:
    """The second cycle is the first again; a smaller cycle inside leaves no trace."""
    load = springs()
    memory = np.zeros(load.memory_size)
    trace(load, along_x(0, 2 * BEND), memory)
    first, heat = trace(load, along_x(2 * BEND, -2 * BEND, 2 * BEND), memory)
    second, again = trace(load, along_x(2 * BEND, -2 * BEND, 2 * BEND), memory)
    assert second == pytest.approx(first, rel=1e-12, abs=1e-12 * ULTIMATE)
    assert again == pytest.approx(heat, rel=1e-12)
    before = memory.copy()
    trace(load, along_x(2 * BEND, 1.5 * BEND, 2 * BEND), memory)
    assert memory == pytest.approx(before, abs=1e-15)


def test_small_motions_about_a_held_load_are_elastic() -> None:
    """Sliders that have yielded stand at their limit; any motion from there starts elastically."""
    load = springs()
    memory = np.zeros(load.memory_size)
    loading = load.tangents(0.0, at(1.5 * BEND, 0.3 * BEND), 1.0, memory).stiffness[0, 0, 0]
    load.commit(at(1.5 * BEND, 0.3 * BEND), memory)
    held = load.tangents(0.0, at(1.5 * BEND, 0.3 * BEND), 1.0, memory).stiffness[0]
    assert np.diag(held)[:2] == pytest.approx(-MODULUS * LENGTH, rel=1e-3)
    assert abs(loading) < 0.3 * MODULUS * LENGTH


def test_rate_does_not_matter() -> None:
    """The force depends on where the node has been, not on how fast; a dashpot's does."""
    moving = PointMotion(
        at(BEND).position, at(BEND).displacement, np.array([[3.0, 1.0, 0.0]]), at(0).axis
    )
    load = springs()
    still = load.forces(0.0, at(BEND), 1.0).force
    assert np.array_equal(load.forces(0.0, moving, 1.0).force, still)
    assert load.forces(0.0, moving, 1.0).dissipation == 0
    viscous = springs(dashpot=Dashpot(np.zeros(1), np.zeros(1), 0.01))
    extra = still - viscous.forces(0.0, moving, 1.0).force
    assert extra[0, :2] == pytest.approx(
        [0.03 * MODULUS * LENGTH, 0.01 * MODULUS * LENGTH], rel=1e-3
    )


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.floats(-3, 3), st.floats(-3, 3)), min_size=2, max_size=12))
def test_no_history_gives_energy_back(corners: list[tuple[float, float]]) -> None:
    """Heat is never negative (asserted in ``trace``); work is stored or heat, by the first law."""
    points = BEND * np.array([(0.0, 0.0), *corners])
    steps = 60
    legs = [np.linspace(a, b, steps + 1)[1:] for a, b in itertools.pairwise(points)]
    path = np.concatenate(legs)
    load = springs(12)
    memory = np.zeros(load.memory_size)
    pulls, heat = trace(load, path, memory)
    whole = np.vstack([np.zeros(2), pulls])
    steps_made = np.diff(np.vstack([np.zeros(2), path]), axis=0)
    worked = np.sum((whole[:-1] + whole[1:]) / 2 * steps_made)
    stored = load.energy(at(*path[-1]), memory)
    scale = np.sum(np.abs(pulls * steps_made)) + 1e-12
    assert worked == pytest.approx(stored + heat, abs=0.02 * scale)


@settings(max_examples=20, deadline=None)
@given(st.floats(0, 2 * np.pi), st.floats(-2, 2), st.floats(-2, 2))
def test_turning_the_path_turns_the_pull(angle: float, x: float, y: float) -> None:
    """The soil has no preferred direction, and remembers none."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    path = BEND * np.array([[0.5, 1.0], [x, y], [-1.0, 0.7]])
    load = springs()
    straight, heat = trace(load, path, np.zeros(load.memory_size))
    turned, again = trace(load, path @ turn.T, np.zeros(load.memory_size))
    assert turned == pytest.approx(straight @ turn.T, abs=1e-9 * ULTIMATE * LENGTH)
    assert again == pytest.approx(heat, rel=1e-9)


@pytest.mark.parametrize("component", [VERTICAL, ROCKING, TORSIONAL])
def test_other_directions_slide_alike(component: SpringComponent) -> None:
    """The same path of another deflection gives the same pull and heat."""
    load, lateral = springs(component=component), springs()
    (part,) = load.compiled()
    memory, reference = np.zeros(load.memory_size), np.zeros(lateral.memory_size)
    for size in BEND * np.array([0.5, 1.5, -1.0, 2.0]):
        columns = np.zeros((1, 21))
        columns[0, component.deflection] = size
        force = np.zeros((1, 6))
        part.force_kernel(columns, part.constants, np.zeros(0), memory, force)
        expected = lateral.forces(0.0, at(size), 1.0, reference).force[0, 0]
        assert force[0, component.force] == pytest.approx(expected, rel=1e-12)
        assert np.count_nonzero(force) == 1
        heat = part.commit_kernel(columns, part.constants, np.zeros(0), memory)
        assert heat == pytest.approx(lateral.commit(at(size), reference), rel=1e-12, abs=1e-12)


def test_a_linear_curve_is_elastic() -> None:
    """It becomes one spring that never yields."""
    load = HystereticSprings(
        "soil", LATERAL, np.zeros(1), np.ones(1), LinearCurves(np.array([MODULUS])), NO_DASHPOT, 8
    )
    pulls, heat = trace(load, along_x(0, 0.5, -0.5, steps=5), np.zeros(load.memory_size))
    assert pulls[:, 0] == pytest.approx(MODULUS * along_x(0, 0.5, -0.5, steps=5)[:, 0], rel=1e-12)
    assert heat == 0


def test_nothing_slides_where_nothing_resists() -> None:
    """A curve of no resistance, as sand has at the mudline, gives none."""
    nothing = TanhCurves(np.zeros(1), np.zeros(1))
    load = HystereticSprings("soil", LATERAL, np.zeros(1), np.ones(1), nothing, NO_DASHPOT, 8)
    assert np.all(load.forces(0.0, at(0.1), 1.0).force == 0)


def test_power_curves_slide() -> None:
    """A curve that is steep at first is met at its sliders too."""
    curve = PowerCurves(*(np.array([v]) for v in (3e6, 0.5, 0.25, 0.003)))
    stiffness, limit = sliders_of(curve, 30)
    assert np.all(stiffness >= 0)
    y = limit[0, 10]
    pull = np.sum(stiffness[0] * np.minimum(y, limit[0]))
    assert pull == pytest.approx(curve.resistance(np.array([y]))[0], rel=1e-12)


@pytest.mark.parametrize(
    "p", [(0.0, 1e6, 8e5, 8e5), (0.0, 1e5, 1e6, 1.1e6)], ids=["falls", "stiffens"]
)
def test_curves_that_fall_or_stiffen_are_refused(p: tuple[float, ...]) -> None:
    """Parallel sliders cannot follow them; the message says what else to do."""
    y = np.array([[0.0, 0.01, 0.05, 0.2]])
    with pytest.raises(ow.InputError, match=r"never fall.*dashpot"):
        sliders_of(PolygonCurves(y, np.array([p])), 20)
