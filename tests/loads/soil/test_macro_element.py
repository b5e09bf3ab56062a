"""The macro-element: small stiffness, backbone, loops, heat, directions, tangents."""

import itertools

import numpy as np
import pytest
from helpers.numerics import relative_difference
from hypothesis import given, settings
from hypothesis import strategies as st

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.soil.macro_element import MacroElement

STILL = np.zeros(6)
STIFFNESS = np.array(
    [
        [6.3e9, 0, 0, 0, -5.0e10, 0],
        [0, 6.3e9, 0, 5.0e10, 0, 0],
        [0, 0, 1.1e10, 0, 0, 0],
        [0, 5.0e10, 0, 8.1e11, 0, 0],
        [-5.0e10, 0, 0, 0, 8.1e11, 0],
        [0, 0, 0, 0, 0, 2.5e11],
    ]
)
ARM = 80.0
"""Height of the load above the mudline in m."""


def path() -> tuple[Array, Array, Array, Array]:
    """Mudline displacement, rotation, force and moment of a pile that softens, and more so in shift.

    Decoupled translation and rotation soften as H / (1 - H / H_u) with ultimate loads of their own.
    """
    load = np.concatenate([np.geomspace(1e4, 1e6, 12), np.linspace(1.5e6, 1.5e7, 28)])
    arm = STIFFNESS[0, 4] / STIFFNESS[0, 0]
    turning = (ARM - arm) * load
    shift = load / STIFFNESS[0, 0] / (1 - load / 3e7)
    rotation = turning / (STIFFNESS[4, 4] - arm**2 * STIFFNESS[0, 0]) / (1 - load / 6e7)
    return shift - arm * rotation, rotation, load, ARM * load


@pytest.fixture(scope="module")
def element() -> MacroElement:
    return MacroElement.along(STIFFNESS, *path())


def motion(u: float, rotation: float, angle: float = 0.0) -> Array:
    """(6,) of the mudline in a vertical plane at an angle from x."""
    return np.array(
        [
            u * np.cos(angle),
            u * np.sin(angle),
            0,
            -rotation * np.sin(angle),
            rotation * np.cos(angle),
            0,
        ]
    )


def trace(element: MacroElement, motions: Array, memory: Array) -> tuple[Array, float]:
    """(t, 6) reactions along motions (t, 6) of converged steps, and the heat in J."""
    reactions, heat = np.empty_like(motions), 0.0
    for i, now in enumerate(motions):
        reactions[i] = element.reaction(now, STILL, memory)
        made = element.commit(now, memory)
        assert made >= 0
        heat += made
    return reactions, heat


def cycle(size: float, steps: int = 100) -> Array:
    """(t, 6) from a point of the path there and back to its opposite."""
    u, rotation, load, _ = path()
    at = float(np.interp(size, load, u)), float(np.interp(size, load, rotation))
    share = np.concatenate([np.linspace(1, -1, steps)[1:], np.linspace(-1, 1, steps)[1:]])
    return np.array([motion(at[0] * s, at[1] * s) for s in share])


def test_small_motions_see_the_6x6(element: MacroElement) -> None:
    """Exactly, in all six directions."""
    small = 1e-9 * np.array([1.0, -2.0, 3.0, 0.1, 0.2, -0.3])
    assert element.reaction(small, STILL) == pytest.approx(STIFFNESS @ small, rel=1e-6)
    tangent, damping = element.tangents(small, STILL)
    assert relative_difference(tangent, STIFFNESS) < 1e-6
    assert np.all(damping == 0)


def test_unloading_sees_the_6x6_again(element: MacroElement) -> None:
    """After a load has been held, small motions about it are elastic."""
    u, rotation, _, _ = path()
    memory = np.zeros(element.memory_size)
    loaded = motion(u[-5], rotation[-5])
    going_on, _ = element.tangents(loaded, STILL, memory)
    element.commit(loaded, memory)
    assert going_on[0, 0] < 0.7 * STIFFNESS[0, 0]
    assert relative_difference(element.tangents(loaded, STILL, memory)[0], STIFFNESS) < 1e-6


def test_first_loading_follows_the_path(element: MacroElement) -> None:
    """Force and moment within 1 % of those the element was made from, at every point."""
    u, rotation, force, moment = path()
    motions = np.array([motion(*pair) for pair in zip(u, rotation, strict=True)])
    reactions, _ = trace(element, motions, np.zeros(element.memory_size))
    assert reactions[:, 0] == pytest.approx(force, rel=0.01)
    assert reactions[:, 4] == pytest.approx(moment, rel=0.01)
    found = max(np.max(np.abs(reactions[:, i] / b - 1)) for i, b in ((0, force), (4, moment)))
    assert element.departure == pytest.approx(found, rel=1e-6)


def test_one_step_gives_what_many_give_on_a_straight_path(element: MacroElement) -> None:
    """The return to the surfaces is exact for a motion along a line from rest."""
    end = motion(0.02, 0.002)
    many = np.array([share * end for share in np.linspace(0.01, 1, 100)])
    reactions, heat = trace(element, many, np.zeros(element.memory_size))
    memory = np.zeros(element.memory_size)
    assert element.reaction(end, STILL, memory) == pytest.approx(reactions[-1], rel=1e-9, abs=1)
    assert element.commit(end, memory) == pytest.approx(heat, rel=0.02)


def test_loops_close_and_dissipate(element: MacroElement) -> None:
    """Masing: a cycle dissipates 8 times the backbone's work less 4 F u, and is the same again."""
    memory = np.zeros(element.memory_size)
    size = 1.2e7
    way = cycle(size)
    up = np.array([share * way[-1] for share in np.linspace(0, 1, 400)])
    backbone, _ = trace(element, up, memory)
    first, heat = trace(element, way, memory)
    second, again = trace(element, way, memory)
    assert second == pytest.approx(first, rel=1e-10, abs=1.0)
    assert again == pytest.approx(heat, rel=1e-10)
    work = float(np.sum((backbone[:-1] + backbone[1:]) / 2 * np.diff(up, axis=0)))
    expected = 8 * work - 4 * float(backbone[-1] @ way[-1])
    assert heat == pytest.approx(expected, rel=0.01)
    assert heat > 0.02 * work


@settings(max_examples=20, deadline=None)
@given(st.floats(0, 2 * np.pi), st.floats(-0.05, 0.05), st.floats(-0.005, 0.005))
def test_a_rotated_motion_gives_the_rotated_reaction(angle: float, u: float, turn: float) -> None:
    """With the same past, turned alike."""
    element = MacroElement.along(STIFFNESS, *path())
    rotation = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    both = np.block([[rotation, np.zeros((3, 3))], [np.zeros((3, 3)), rotation]])
    way = np.array([motion(0.03, 0.003), motion(u, turn, 1.0), motion(-0.01, 0.001, 2.0)])
    straight, heat = trace(element, way, np.zeros(element.memory_size))
    turned, again = trace(element, way @ both.T, np.zeros(element.memory_size))
    assert turned == pytest.approx(straight @ both.T, abs=1e-9 * np.abs(straight).max())
    assert again == pytest.approx(heat, rel=1e-9, abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(-0.05, 0.05), st.floats(-0.005, 0.005), st.floats(-0.05, 0.05)),
        min_size=1,
        max_size=6,
    )
)
def test_work_is_stored_or_heat(corners: list[tuple[float, float, float]]) -> None:
    """Along any path; heat is never negative (asserted in ``trace``)."""
    element = MacroElement.along(STIFFNESS, *path())
    points = np.array([STILL, *([u, w, 0, 0, turn, 0] for u, turn, w in corners)])
    way = np.concatenate([np.linspace(a, b, 81)[1:] for a, b in itertools.pairwise(points)])
    memory = np.zeros(element.memory_size)
    reactions, heat = trace(element, way, memory)
    whole, steps = np.vstack([STILL, reactions]), np.diff(np.vstack([STILL, way]), axis=0)
    worked = float(np.sum((whole[:-1] + whole[1:]) / 2 * steps))
    scratch = np.zeros(6), np.zeros((6, 6)), np.zeros((6, 6))
    _, stored = element.reaction_kernel(way[-1], STILL, element.constants, memory, *scratch)
    assert worked == pytest.approx(stored + heat, abs=0.02 * (stored + heat) + 1e-6)


@pytest.mark.parametrize("size", [0.2, 1.0])
def test_tangent_is_the_derivative(element: MacroElement, size: float) -> None:
    """Of the reaction, elements yielding in both planes after a past."""
    memory = np.zeros(element.memory_size)
    element.commit(size * np.array([0.04, -0.02, 0.001, 0.002, 0.003, 0.001]), memory)
    now = size * np.array([-0.03, 0.05, 0.002, -0.003, 0.001, 0.002])
    steps = np.diag([1e-8, 1e-8, 1e-8, 1e-9, 1e-9, 1e-9])
    columns = [
        (element.reaction(now + h, STILL, memory) - element.reaction(now - h, STILL, memory))
        / (2 * np.sum(h))
        for h in steps
    ]
    tangent, _ = element.tangents(now, STILL, memory)
    assert relative_difference(tangent, np.array(columns).T) < 1e-5
    assert tangent == pytest.approx(tangent.T, rel=1e-10, abs=1.0)
    assert np.all(np.linalg.eigvalsh(tangent) > 0)


def test_surfaces_are_nested_and_shared(element: MacroElement) -> None:
    """A moment that is held leaves less elastic room for a force: the surfaces are ellipses."""
    memory = np.zeros(element.memory_size)
    assert np.sum(element.translation) == pytest.approx(STIFFNESS[0, 0], rel=1e-12)
    shift = motion(0.004, 0.0)
    _, free = trace(element, shift[None], memory.copy())
    held = motion(-element.arm * 0.004, 0.004)
    element.commit(held, memory)
    _, bent = trace(element, (held + shift)[None], memory)
    assert bent > 1.05 * free


def test_planes_must_be_alike() -> None:
    """A foundation that is not round is refused."""
    uneven = STIFFNESS.copy()
    uneven[1, 1] *= 1.1
    with pytest.raises(ow.InputError, match="both planes"):
        MacroElement.along(uneven, *path())


def test_a_path_of_another_soil_is_refused() -> None:
    """One that starts twice as stiff as the 6x6, and one that turns back."""
    u, rotation, force, moment = path()
    with pytest.raises(ow.InputError, match="times as stiff"):
        MacroElement.along(STIFFNESS, u, rotation, 2 * force, 2 * moment)
    with pytest.raises(ow.InputError, match="decoupled translation"):
        MacroElement.along(STIFFNESS, u[::-1], rotation[::-1], force[::-1], moment[::-1])
