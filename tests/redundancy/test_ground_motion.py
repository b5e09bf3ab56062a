"""A moving ground in the two implementations of the equations of motion, and in both integrators."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.earthquakes import by_depth, shaking
from helpers.numerics import (
    blockwise_difference,
    central_differences,
    fourth_order_differences,
    relative_difference,
)
from helpers.point_loads import EveryKind
from helpers.states import State, joint_kinds, random_state, without_joint_springs
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.loads.point_load import PointLoad

Array = NDArray[np.float64]

TIME = 2.83
STEP = 1e-4


def loads(system: ow.System) -> list[PointLoad]:
    """One that sees all parts of the motion, along the whole structure."""
    return [EveryKind(np.linspace(system.chain.base, system.chain.top, 4))]


def motions(system: ow.System) -> dict[str, ow.GroundMotion]:
    return {"uniform": shaking(6.0, 0.05), "by depth": by_depth(system)}


def compiled(chain: CompiledChain, state: State) -> Array:
    return chain.residual(chain.time_inputs(np.array([TIME]))[0], state.q, state.v, state.a)


@pytest.mark.parametrize("kind", ["uniform", "by depth"])
def test_compiled_residual_is_pinocchio_s(in_waves: ow.System, kind: str) -> None:
    """Ground that leans Pinocchio's gravity, and ground that moves the chain's base, are one."""
    bare, state = without_joint_springs(in_waves), random_state(in_waves)
    motion = motions(in_waves)[kind]
    found = compiled(CompiledChain(bare, loads(bare), 4.0, motion), state)
    equations = bare.equations(loads(bare), 4.0, ground_motion=motion)
    expected = equations.residual(TIME, state.q, state.v, state.a)
    kinds = joint_kinds(in_waves)
    assert blockwise_difference(found, expected, kinds) < 1e-12
    still = bare.equations(loads(bare), 4.0).residual(TIME, state.q, state.v, state.a)
    assert blockwise_difference(still, expected, kinds) > 1e-4  # negative control
    own = CompiledChain(bare, loads(bare), 4.0, motion).equations()
    assert np.array_equal(own.residual(TIME, state.q, state.v, state.a), expected)


@pytest.mark.parametrize("part", ["displacement", "velocity", "acceleration"])
def test_each_part_of_the_ground_s_motion_is_seen(
    linear_soil: ow.System, part: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: either implementation without one part is another residual."""
    motion, state = by_depth(linear_soil), random_state(linear_soil)
    expected = linear_soil.equations(ground_motion=motion)
    expected = expected.residual(TIME, state.q, state.v, state.a)
    whole = ow.GroundMotion.motion

    def without(self: ow.GroundMotion, time: Array) -> Array:
        result = whole(self, time)
        result[:, :, ["displacement", "velocity", "acceleration"].index(part)] = 0.0
        return result

    chain = CompiledChain(linear_soil, ground_motion=motion)
    kinds = joint_kinds(linear_soil)
    assert blockwise_difference(compiled(chain, state), expected, kinds) < 1e-12
    monkeypatch.setattr(ow.GroundMotion, "motion", without)
    assert blockwise_difference(compiled(chain, state), expected, kinds) > 1e-6


def test_soil_stands_in_the_ground_at_its_depth(linear_soil: ow.System) -> None:
    """Of unevenly spaced levels, by NumPy's interpolation at every node and at the base."""
    motion = by_depth(linear_soil, levels=5)
    assert motion.height is not None
    motion = replace(motion, height=motion.height + np.array([0, 3.0, -4.0, 5.0, 0]))
    chain, state = CompiledChain(linear_soil, ground_motion=motion), random_state(linear_soil)
    compiled(chain, state)
    s, m, (soil,) = chain.data, chain.model, linear_soil.foundation.soil
    place = chain.loads.index(soil.compiled()[0])
    at = slice(*m.first_point[place : place + 2])
    given = motion.motion(np.array([TIME]))[0]
    assert motion.height is not None

    def ground(height: Array, part: int) -> Array:
        columns = (np.interp(height, motion.height, given[:, part, j]) for j in range(3))
        return np.column_stack(list(columns))

    moved = s.motion[at, :3] - [0, 0, 1] * m.point_height[at, None]
    assert s.motion[at, 3:6] == pytest.approx(moved - ground(soil.height, 0), abs=1e-12)
    axis, body = s.rotation[m.point_body[at], :, 2], m.point_body[at]
    arm = m.point_offset[at, None] * axis
    speed = s.velocity[body] + np.cross(s.angular_velocity[body], arm)
    assert s.motion[at, 6:9] == pytest.approx(speed - ground(soil.height, 1), abs=1e-12)
    others = np.setdiff1d(np.arange(len(m.point_body)), np.arange(at.start, at.stop))
    moved = s.motion[others, :3] - [0, 0, 1] * m.point_height[others, None]
    assert s.motion[others, 3:6] == pytest.approx(moved, abs=1e-12)
    base = np.array([linear_soil.chain.base])
    compiled(chain, replace(state, q=0 * state.q, v=0 * state.v, a=0 * state.a))
    assert s.position[0] == pytest.approx(ground(base, 0)[0] + [0, 0, base[0]], abs=1e-12)
    assert s.acceleration[0] == pytest.approx(ground(base, 2)[0], abs=1e-12)
    assert np.ptp(ground(soil.height, 0)[:, 0]) > 0.01


def test_tangents_in_an_earthquake(in_waves: ow.System, state: State) -> None:
    """dr/dq, dr/dv and dr/da about a moving state on moving ground."""
    bare = without_joint_springs(in_waves)
    equations = bare.equations(loads(bare), ground_motion=by_depth(in_waves))

    def residual(**changed: Array) -> Array:
        at = replace(state, **changed)
        return equations.residual(TIME, at.q, at.v, at.a)

    stiffness, damping = equations.tangents(TIME, state.q, state.v, state.a)
    kinds = joint_kinds(in_waves)
    tolerance = 1e-5 if len(in_waves.foundation.soil) > 1 else 1e-9
    expected = fourth_order_differences(lambda q: residual(q=q), state.q, STEP)
    assert blockwise_difference(stiffness, expected, kinds) < tolerance
    expected = fourth_order_differences(lambda v: residual(v=v), state.v, STEP)
    assert blockwise_difference(damping, expected, kinds) < tolerance
    expected = central_differences(lambda a: residual(a=a), state.a, 1.0)
    assert blockwise_difference(equations.mass(state.q, TIME), expected, kinds) < tolerance


def test_iteration_matrix_in_an_earthquake(in_waves: ow.System, state: State) -> None:
    """At rest relative to the base, in an instant of a displaced and accelerated ground, the compiled
    matrix is the dense one."""
    motion = by_depth(in_waves)
    at_rest = replace(motion, time=motion.time - TIME + 1e-9)
    chain = CompiledChain(in_waves, [], 0.0, at_rest)
    row = chain.time_inputs(np.zeros(1))[0]
    levels = len(motion.levels)
    row[1 : 1 + 9 * levels].reshape(levels, 3, 3)[:, 1] = 0.0  # no velocities
    rest, unit = np.zeros_like(state.q), np.eye(len(state.q))
    chain.factorise(row, state.q, rest, rest, 111.0, 1.23e4)
    inverse = np.array([chain.correction(column) for column in unit]).T

    class Halted(ow.GroundMotion):
        def motion(self, time: Array) -> Array:
            result = super().motion(time)
            result[:, :, 1] = 0.0
            return result

    halted = Halted(at_rest.time, at_rest.acceleration, at_rest.height)
    equations = in_waves.equations(ground_motion=halted)
    stiffness, damping = equations.tangents(0.0, state.q, rest)
    matrix = 1.23e4 * equations.mass(state.q, 0.0) + 111.0 * damping + stiffness
    assert np.abs(matrix @ inverse - unit).max() < 1e-8
    still = in_waves.equations()
    stiffness, damping = still.tangents(0.0, state.q, rest)
    matrix = 1.23e4 * still.mass(state.q, 0.0) + 111.0 * damping + stiffness
    assert np.abs(matrix @ inverse - unit).max() > 1e-6  # negative control


def test_a_free_chain_does_not_notice_the_ground(undamped: ow.Turbine) -> None:
    """Held by nothing, weightless and dry, it stays where it is: its root moves against the ground."""
    springs = undamped.soil.coupled_springs
    assert springs is not None
    nothing = springs.model_copy(update={"stiffness": np.zeros((6, 6)).tolist()})
    turbine = undamped.model_copy(
        update={
            "soil": undamped.soil.model_copy(update={"coupled_springs": nothing}),
            "site": undamped.site.model_copy(update={"gravity": 0.0}),
        }
    )
    system = ow.build(turbine, "coupled_springs", elements=5)
    chain = CompiledChain(system, ground_motion=shaking(6.0, 0.05))
    row = chain.time_inputs(np.array([TIME]))[0]
    q, v, a = np.zeros((3, system.nv))
    q[:3], v[:3], a[:3] = -row[1:10].reshape(3, 3)
    scale = np.abs(chain.residual(row, 0 * q, 0 * v, 0 * a)).max()
    assert scale > 1e5
    assert np.abs(chain.residual(row, q, v, a)).max() < 1e-12 * scale
    assert np.abs(chain.data.position[:, :2]).max() < 1e-12
    assert relative_difference(chain.data.position[0], np.array([0, 0, system.chain.base])) < 1e-12
