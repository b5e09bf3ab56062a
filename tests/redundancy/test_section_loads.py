"""Section loads against Pinocchio's joint forces, joint springs, weights and reactions."""

import itertools

import numpy as np
import pinocchio as pin
import pytest
from helpers.by_hand import build_by_hand, section_loads
from helpers.in_time import Step, integrate
from helpers.numerics import relative_difference
from helpers.states import State
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.static import load_scale
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.solvers.generalized_alpha import Method
from offwind_pin.structure.section import lump

Array = NDArray[np.float64]


def shaking(system: ow.System) -> CompiledChain:
    """A system under a load at the top that shakes all six directions."""
    time = np.linspace(0, 5, 101)
    shape = np.sin(np.outer(2 * time, [1.0, 1.3, 0.7, 1.1, 0.9, 1.7]))
    load = shape * [2e6, 1e6, 5e5, 1e7, 2e7, 3e7]
    history = ow.LoadHistory(time, load, "test")
    return CompiledChain(system, [TowerTopLoad(system.chain.top, history, load[0])])


def recorded(
    chain: CompiledChain, height: Array, time: float, q: Array, v: Array, a: Array
) -> Array:
    """(m, 6) section loads of the compiled code."""
    record = chain.record(chain.sections(height), chain.time_inputs(np.array([time]))[0], q, v, a)
    return record.section_load[0]


@pytest.fixture(scope="module")
def chain(coarse: ow.System) -> CompiledChain:
    """Everything acting, in waves."""
    return shaking(coarse)


@pytest.fixture(scope="module")
def moving(coarse: ow.System, chain: CompiledChain) -> Step:
    """A state two seconds after a start from the undeformed shape: everything moves."""
    method = Method(0.05, 0.9, load_scale(coarse), relative_tolerance=1e-11)
    rest = np.zeros(coarse.nv)
    return integrate(chain.equations(), rest, rest, method, 40)[-1]


TIME = 1.7
TOLERANCE = 1e-11
"""Of section loads over the largest: sums of thousands of terms, differently ordered."""


def cut_heights(system: ow.System) -> Array:
    """Base, top, mudline, a node, a boundary, soil nodes, and anywhere between, in no order."""
    chain = system.chain
    inside = np.random.default_rng(8).uniform(chain.base, chain.top, 15)
    named = [chain.top, chain.joint_height[2], chain.boundary[3], -30.0, chain.base]
    soil = [height for load in system.foundation.soil for height in load.height[1:9:4]]
    return np.concatenate([named, soil, inside])


def differences(chain: CompiledChain, height: Array, state: State, found: Array) -> float:
    """Largest difference from Pinocchio's joint forces, of forces and of moments."""
    expected = section_loads(chain.equations(), height, TIME, state.q, state.v, state.a)
    return max(
        relative_difference(found[:, part], expected[:, part])
        for part in (slice(0, 3), slice(3, 6))
    )


def test_section_loads_are_pinocchio_s_joint_forces(in_waves: ow.System, state: State) -> None:
    """At cuts anywhere, in any motion: the force in a joint that never moves, put at the cut."""
    chain, height = shaking(in_waves), cut_heights(in_waves)
    found = recorded(chain, height, TIME, state.q, state.v, state.a)
    assert differences(chain, height, state, found) < TOLERANCE


def test_a_cut_elsewhere_is_seen(in_waves: ow.System, state: State) -> None:
    """Negative control: a cut a millimetre higher carries something else."""
    chain, height = shaking(in_waves), cut_heights(in_waves)[5:]
    found = recorded(chain, height + 1e-3, TIME, state.q, state.v, state.a)
    assert differences(chain, height, state, found) > 1e3 * TOLERANCE


def test_cutting_changes_no_joint_force(in_waves: ow.System, state: State) -> None:
    """The second implementation's cut chain needs at its own joints what the whole one needs."""
    cut = build_by_hand(in_waves, cut_heights(in_waves))
    whole = in_waves.pin_model
    expected = pin.rnea(whole, whole.createData(), state.q, state.v, state.a)
    wide = [cut.widened(part) for part in (state.q, state.v, state.a)]
    found = pin.rnea(cut.model, cut.model.createData(), *wide)
    assert cut.model.nv == whole.nv + len(cut.cuts)
    assert relative_difference(found[cut.own], expected) < 1e-12


def moments_at_joints(chain: CompiledChain, step: Step, a: Array) -> Array:
    """(nv - roots,) section moments at the nodes along their joints' axes."""
    system = chain.system
    load = recorded(chain, system.chain.joint_height, step.time, step.q, step.v, a)
    jacobian = system.equations().chain_motion(step.q, step.v).jacobian
    axes = jacobian[3:, system.chain.roots :].reshape(3, -1, 3)
    return np.einsum("nj,jnk->nk", load[:, 3:], axes).ravel()


def test_section_moments_are_what_springs_and_dampers_carry(
    coarse: ow.System, chain: CompiledChain, moving: Step
) -> None:
    """M = K q + D v at every node, from the dynamics on one side and the joints on the other.

    They differ by the residual that the time step was left with.
    """
    carried = coarse.joint_stiffness * moving.q + coarse.joint_damping * moving.v
    found = moments_at_joints(chain, moving, moving.a)
    left = max(moving.residual, 1e-15) * load_scale(coarse)
    assert moving.residual < 1e-11
    assert np.abs(coarse.joint_damping * moving.v).max() > 1e4 * left
    assert_allclose(found, carried[coarse.chain.roots :], rtol=1e-11, atol=3 * left)


def test_a_wrong_acceleration_is_seen(
    coarse: ow.System, chain: CompiledChain, moving: Step
) -> None:
    """Negative control: an acceleration 1 % off breaks the equality."""
    carried = coarse.joint_stiffness * moving.q + coarse.joint_damping * moving.v
    found = moments_at_joints(chain, moving, 1.01 * moving.a)
    assert np.abs(found - carried[coarse.chain.roots :]).max() > 1e-6 * load_scale(coarse)


def test_base_of_a_clamped_turbine_carries_everything(clamped_dry: ow.System) -> None:
    """In statics the base section load is the weight and the applied load at their places."""
    load = np.array([1e6, -4e5, 2e5, 1e7, 2e7, 5e6])
    result = ow.static(clamped_dry, load)
    turbine, chain, model = clamped_dry.turbine, clamped_dry.chain, clamped_dry.pin_model
    weight = turbine.site.gravity * np.array([0.0, 0.0, -1.0])
    mass = pin.computeTotalMass(model)
    center = pin.centerOfMass(model, model.createData(), result.q) - [0, 0, chain.base]
    top = result.displacement[-1] + [0, 0, chain.top - chain.base]
    force = load[:3] + (mass + chain.body[0].mass) * weight
    moment = load[3:] + np.cross(top, load[:3]) + np.cross(center, mass * weight)
    assert_allclose(result.section_load[0, :3], force, rtol=1e-11, atol=1e-3)
    assert_allclose(result.section_load[0, 3:], moment, rtol=1e-11, atol=1e-2)
    assert_allclose(result.mudline_load, result.section_load[0], rtol=0)


def test_sections_differ_by_the_weight_between_them(clamped_dry: ow.System) -> None:
    """Dry and at rest, the force falls from cut to cut by the weight between, up to the assembly."""
    result = ow.static(clamped_dry)
    turbine, chain = clamped_dry.turbine, clamped_dry.chain
    between = [
        turbine.site.gravity * lump(turbine, low, high).mass
        for low, high in itertools.pairwise(chain.boundary)
    ]
    assert_allclose(np.diff(result.section_load[:, 2]), between, rtol=1e-9)
    top = -turbine.site.gravity * chain.rna.mass
    assert result.section_load[-1, 2] == pytest.approx(top, rel=1e-12)


def test_mudline_load_is_the_soil_reaction(distributed_wet: ow.System) -> None:
    """What crosses the mudline sideways the soil takes up; downwards the toe does, with the pile."""
    load = np.array([1e6, 3e5, 0, 0, 0, 2e6])
    result = ow.static(distributed_wet, load)
    rest = np.zeros(distributed_wet.nv)
    equations = distributed_wet.equations(result.loads, ramp_time=np.inf)
    state = equations.evaluate(0.0, result.q, rest, rest)
    soil = state.points.position[:, 2] < -29.9
    at_soil = state.forces.force[soil & (np.hypot(*state.forces.force[:, :2].T) > 0)]
    assert_allclose(result.mudline_load[:2], -at_soil[:, :2].sum(axis=0), rtol=1e-9)
    assert_allclose(result.mudline_load[:2], load[:2], rtol=1e-9)
    turbine = distributed_wet.turbine
    pile = turbine.site.gravity * lump(turbine, turbine.toe, turbine.site.mudline).mass
    springs = turbine.soil.distributed_springs
    assert springs is not None
    toe = springs.toe_vertical_stiffness * result.q[2]
    assert result.mudline_load[2] - pile == pytest.approx(toe, rel=1e-9)


def test_shear_in_the_pile_falls_by_whole_nodes(distributed_wet: ow.System) -> None:
    """Between two element boundaries the shear changes by the soil nodes between them.

    A node that lies on a boundary belongs to the part below the cut, on every boundary alike.
    """
    result = ow.static(distributed_wet, np.array([1e6, 0, 0, 0, 0, 0]))
    rest = np.zeros(distributed_wet.nv)
    equations = distributed_wet.equations(result.loads, ramp_time=np.inf)
    state = equations.evaluate(0.0, result.q, rest, rest)
    height, force = equations.points.height, state.forces.force[:, 0]
    boundary = distributed_wet.chain.boundary
    expected = [force[height > z + 1e-6].sum() for z in boundary]
    expected[-1] = 1e6
    assert_allclose(result.section_load[:, 0], expected, rtol=1e-9, atol=1.0)
