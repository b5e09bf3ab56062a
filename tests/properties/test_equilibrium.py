"""Equilibrium of free bodies cut out anywhere, for any load."""

import itertools

import numpy as np
import pytest
from helpers.states import random_state
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.structure.section import lump

force = st.floats(-2e6, 2e6)
moment = st.floats(-5e7, 5e7)


@pytest.fixture(scope="module")
def dry(undamped: ow.Turbine) -> ow.System:
    return ow.build(undamped, "clamped", elements=9)


@settings(max_examples=15, deadline=None)
@given(st.tuples(force, force, force, moment, moment, moment))
def test_any_load_reaches_the_base(
    dry: ow.System, load: tuple[float, float, float, float, float, float]
) -> None:
    """The base carries the applied force and the weight, for every load the tower bears."""
    result = ow.static(dry, np.array(load))
    weight = dry.turbine.site.gravity * (
        dry.chain.rna.mass + sum(body.mass for body in dry.chain.body)
    )
    expected = np.array(load[:3]) - [0, 0, weight]
    assert_allclose(result.section_load[0, :3], expected, rtol=1e-10, atol=1e-3)


@settings(max_examples=15, deadline=None)
@given(st.floats(-29.9, 115.0), st.floats(-29.9, 115.0), force, moment)
def test_free_body_between_two_cuts(
    dry: ow.System, one: float, other: float, push: float, turn: float
) -> None:
    """Force and moment on a piece between two cuts balance its weight.

    The piece is weighed in slices, each on the deflected axis; slices within one rigid body are
    exact, so that the piece is sliced at the joints.
    """
    low, high = sorted((one, other))
    result = ow.static(dry, np.array([push, 0.5 * push, 0, turn, 0, turn]))
    rest = np.zeros(dry.nv)
    ends = np.array([low, high])
    chain = CompiledChain(dry, result.loads, np.inf)
    row = chain.time_inputs(np.zeros(1))[0]
    cuts = chain.record(chain.sections(ends), row, result.q, rest, rest).section_load[0]
    motion = dry.equations().chain_motion(result.q, rest)
    place = motion.points_at(ends).position
    joints = dry.chain.joint_height
    slices = [low, *joints[(joints > low) & (joints < high)], high]
    pull, turning = np.zeros(3), np.zeros(3)
    for bottom, top in itertools.pairwise(slices):
        body = lump(dry.turbine, bottom, top)
        weight = np.array([0, 0, -dry.turbine.site.gravity * body.mass])
        center = motion.points_at(np.array([body.center])).position[0]
        pull += weight
        turning += np.cross(center - place[0], weight)
    across = np.cross(place[1] - place[0], cuts[1, :3])
    assert_allclose(cuts[0, :3], cuts[1, :3] + pull, rtol=1e-10, atol=1e-3)
    assert_allclose(cuts[0, 3:], cuts[1, 3:] + across + turning, rtol=1e-9, atol=1.0)


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 1000), st.integers(2, 7))
def test_section_loads_are_continuous_across_joints(
    coarse: ow.System, seed: int, joint: int
) -> None:
    """In any motion, a cut just below a joint and one just above it carry the same.

    Below, the body's own need is that of a sliver; above, it is nearly the whole body and the next
    joint's: the two are computed from different parts. The pile's two joints are left out: soil
    springs sit there.
    """
    state = random_state(coarse, seed, size=0.02)
    chain = CompiledChain(coarse)
    height = coarse.chain.joint_height[joint] + np.array([-1e-7, 1e-7])
    assert np.abs(chain.model.point_height - height.mean()).min() > 1e-3
    row = chain.time_inputs(np.ones(1))[0]
    record = chain.record(chain.sections(height), row, state.q, state.v, state.a)
    below, above = record.section_load[0]
    for part in (slice(0, 3), slice(3, 6)):
        # A sliver of 2e-7 m weighs 1e-8 of the forces; its arm adds 2e-7 m of their moment.
        scale = np.abs(below[part]).max() + np.abs(below[:3]).max()
        assert_allclose(above[part], below[part], rtol=0, atol=1e-6 * scale)
