"""Mass, damping and stiffness by products in O(N), against Pinocchio's dense matrices; modes."""

import itertools

import numpy as np
import pytest
from helpers.numerics import relative_difference
from helpers.point_loads import EveryKind
from helpers.states import joint_kinds_apart, random_state, without_joint_springs
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.definitions.turbine import RigidBodyRNA
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.pencil import CompiledPencil
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.tower_top.load_history import constant_load

Array = NDArray[np.float64]

TOP_LOAD = np.array([2e6, -7e5, 5e5, 3e7, 4e7, -2e7])
TOLERANCE = 1e-13
"""Of each block of joints of one kind."""


def difference(found: Array, expected: Array, kinds: list[str]) -> float:
    """Largest difference of a block over its largest entry; a block of zeros must be that."""
    groups = [[i for i, kind in enumerate(kinds) if kind == one] for one in sorted(set(kinds))]
    errors = []
    for rows, columns in itertools.product(groups, groups):
        block = np.ix_(rows, columns)
        size, error = np.abs(expected[block]).max(), np.abs(found - expected)[block].max()
        errors.append(error / size if size > 0 else (0.0 if error == 0 else np.inf))
    return max(errors)


def loads(system: ow.System) -> list[PointLoad]:
    """A dead moment, which makes the stiffness unsymmetric, and a load of every kind."""
    height = np.linspace(system.chain.base, system.chain.top, 4)
    return [constant_load(system.chain.top, TOP_LOAD), EveryKind(height)]


def by_products(system: ow.System, q: Array) -> tuple[Array, Array, Array]:
    chain = CompiledChain(system, loads(system), ramp_time=None)
    return CompiledPencil(chain, q).matrices()


def dense(system: ow.System, q: Array) -> tuple[Array, Array, Array]:
    equations = system.equations(loads(system), None)
    stiffness, damping = equations.tangents(0.0, q, np.zeros_like(q))
    return equations.mass(q), damping, stiffness


@pytest.fixture
def bare(any_system: ow.System) -> ow.System:
    """Without the springs of the chain, which would hide smaller terms, but with its dampers."""
    damped = any_system.with_damping(2e-3 * any_system.joint_stiffness, {})
    return without_joint_springs(damped)


@pytest.mark.parametrize("seed", range(2))
def test_products_are_pinocchio_s(bare: ow.System, seed: int) -> None:
    """M, D and K about a bent state, on each foundation, with dampers, of each element."""
    q, kinds = random_state(bare, seed).q, joint_kinds_apart(bare)
    for found, expected in zip(by_products(bare, q), dense(bare, q), strict=True):
        assert difference(found, expected, kinds) < TOLERANCE


def test_products_about_another_state_are_others(bare: ow.System) -> None:
    """Negative control: a state a millionth of a radian away has other matrices."""
    q, kinds = random_state(bare).q, joint_kinds_apart(bare)
    mass, _, stiffness = by_products(bare, q + 1e-6)
    expected = dense(bare, q)
    assert difference(mass, expected[0], kinds) > 1e4 * TOLERANCE
    assert difference(stiffness, expected[2], kinds) > 1e4 * TOLERANCE


def test_symmetric_part_and_solutions(any_system: ow.System) -> None:
    """Products with the transpose, and shifted solutions, by dense algebra."""
    q = random_state(any_system, 2, 0.02).q
    mass, _, stiffness = dense(any_system, q)
    chain = CompiledChain(any_system, loads(any_system), ramp_time=None)
    pencil = CompiledPencil(chain, q)
    unit, kinds = np.eye(any_system.nv), joint_kinds_apart(any_system)
    found = pencil.symmetric_stiffness_times(unit)
    assert difference(found, (stiffness + stiffness.T) / 2, kinds) < TOLERANCE
    rhs = np.random.default_rng(1).standard_normal(any_system.nv)
    for shift in (0.0, -50.0):
        x = pencil.solve(rhs, shift)
        assert relative_difference((stiffness - shift * mass) @ x, rhs) < 1e-8


@pytest.mark.parametrize("foundation", ["clamped", "coupled_springs", "distributed_springs"])
def test_modes_are_those_of_dense_matrices(oc6: ow.Turbine, foundation: str) -> None:
    """On the shipped turbine at its default elements, under a thrust; Lanczos against LAPACK."""
    system = ow.build(oc6, foundation, ow.StillWater())
    about = ow.static(system, np.array([1e6, 0, 0, 0, 5e7, 1e6]))
    ours, theirs = ow.modes(system, 8, about), ow.modes(system, 8, about, engine="pinocchio")
    assert ours.label == theirs.label
    assert ours.frequency_hz == pytest.approx(theirs.frequency_hz, rel=1e-9)
    assert ours.damping_ratio == pytest.approx(theirs.damping_ratio, rel=1e-8)
    assert np.abs(ours.shape - theirs.shape).max() < 1e-6
    assert np.abs(ours.participation - theirs.participation).max() < 1e-8


def test_pairs_of_one_frequency(undamped: ow.Turbine) -> None:
    """A structure that is the same in every direction: both modes of each pair are found."""
    rna = RigidBodyRNA(
        kind="rigid_body",
        mass=6e5,
        center_of_mass=(0.0, 0.0, 2.0),
        inertia=((1e8, 0, 0), (0, 1e8, 0), (0, 0, 1e8)),
    )
    turbine = undamped.model_copy(update={"rna": rna})
    result = ow.modes(ow.build(turbine, "clamped"), 6)
    frequency = dict(zip(result.label, result.frequency_hz, strict=True))
    for order in (1, 2):
        assert frequency[f"FA{order}"] == pytest.approx(frequency[f"SS{order}"], rel=1e-9)
    assert frequency["FA2"] > 3 * frequency["FA1"]


def test_a_thousand_elements(undamped: ow.Turbine) -> None:
    """Far beyond what dense matrices allow, to the frequencies of the default elements."""
    default = ow.modes(ow.build(undamped, "clamped"), 4)
    fine = ow.modes(ow.build(undamped, "clamped", elements=1000), 4)
    assert fine.label == default.label
    assert fine.frequency_hz == pytest.approx(default.frequency_hz, rel=5e-3)
