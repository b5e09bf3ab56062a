"""Structural damping asked for is structural damping had: modal, by joint factors, and Rayleigh."""

import pickle

import numpy as np
import pytest
from helpers.earthquakes import shaking
from helpers.numerics import relative_difference
from helpers.states import random_state
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.definitions.structural_damping import (
    ModalDamping,
    RayleighDamping,
    StiffnessDamping,
    StructuralDamping,
)
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.pencil import CompiledPencil
from offwind_pin.dynamics.compiled.recorder import JOINT_DAMPERS
from offwind_pin.dynamics.reference.dense_chain import DenseChain
from offwind_pin.dynamics.reference.section_loads import section_loads
from offwind_pin.solvers.steps import FixedStep
from offwind_pin.verification.free_decay import STEPS, FreeDecay

Array = NDArray[np.float64]

RATIOS = {"FA1": 0.01, "SS1": 0.008, "FA2": 0.02, "SS2": 0.005}
"""Not in the order of the frequencies in one plane, as joint dampers cannot have them."""
MODAL = ModalDamping(ratios=RATIOS, others=0.015)
ELEMENTS = 14
EXACT = 5e-3
"""Of a ratio, or of an energy."""


def with_damping(turbine: ow.Turbine, damping: StructuralDamping) -> ow.Turbine:
    return turbine.model_copy(update={"structural_damping": damping})


@pytest.fixture(scope="module")
def without_soil_damping(oc6: ow.Turbine) -> ow.Turbine:
    springs = oc6.soil.distributed_springs
    assert springs is not None
    bare = springs.model_copy(update={"dashpot": None})
    return oc6.model_copy(
        update={"soil": oc6.soil.model_copy(update={"distributed_springs": bare})}
    )


@pytest.fixture(scope="module")
def everything(oc6: ow.Turbine) -> ow.System:
    """Modal damping beside soil dashpots and waves."""
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    return ow.build(with_damping(oc6, MODAL), "distributed_springs", waves, elements=ELEMENTS)


@pytest.mark.parametrize("label", ["FA1", "SS2", "FA2"])
@pytest.mark.parametrize("foundation", list(FOUNDATIONS))
def test_free_decays_have_the_ratios(
    without_soil_damping: ow.Turbine, foundation: str, label: str
) -> None:
    """On every foundation within 0.5 %, soil damping off and motions too small for drag."""
    turbine = with_damping(without_soil_damping, MODAL)
    system = ow.build(turbine, foundation, ow.StillWater(), elements=ELEMENTS)
    assert FreeDecay(system, label, 1e-6).ratio(6) == pytest.approx(RATIOS[label], rel=EXACT)


def test_free_decay_tells_ratios_apart(without_soil_damping: ow.Turbine) -> None:
    """Negative control: one per cent more is seen."""
    other = MODAL.replace(ratios=RATIOS | {"FA1": 1.01 * RATIOS["FA1"]})
    system = ow.build(with_damping(without_soil_damping, other), "clamped", elements=ELEMENTS)
    found = FreeDecay(system, "FA1", 1e-6).ratio(6)
    assert found == pytest.approx(other.ratios["FA1"], rel=EXACT)
    assert found != pytest.approx(RATIOS["FA1"], rel=EXACT)


@pytest.mark.parametrize("foundation", list(FOUNDATIONS))
def test_named_modes_and_others(without_soil_damping: ow.Turbine, foundation: str) -> None:
    """Named modes have their ratios, others up to the cutoff theirs; beyond it grows."""
    turbine = with_damping(without_soil_damping, MODAL)
    system = ow.build(turbine, foundation, ow.StillWater(), elements=ELEMENTS)
    found = ow.modes(system, 10)
    within = found.frequency_hz <= MODAL.cutoff
    expected = [RATIOS.get(label, MODAL.others) for label in found.label]
    structural = found.damping_parts[:, 0]
    assert structural[within] == pytest.approx(np.array(expected)[within], rel=1e-6)
    assert found.damping_asked[within] == pytest.approx(np.array(expected)[within])
    assert within.sum() >= 6


def test_complex_eigenvalues_have_the_ratios(oc6: ow.Turbine) -> None:
    """The damping matrix couples no two modes up to the cutoff: -Re(s) / |s| are the ratios."""
    system = ow.build(with_damping(oc6, MODAL), "coupled_springs", elements=ELEMENTS)
    mass, damping, stiffness = CompiledPencil(CompiledChain(system), ow.static(system).q).matrices()
    n, inverse = system.nv, np.linalg.inv(mass)
    first_order = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -inverse @ damping]]
    )
    roots = np.linalg.eigvals(first_order)
    roots = roots[roots.imag > 0]
    roots = roots[np.argsort(np.abs(roots))][:4]
    ratios = [RATIOS[label] for label in ("SS1", "FA1", "SS2", "FA2")]
    assert -roots.real / np.abs(roots) == pytest.approx(ratios, rel=1e-3)


def test_soil_and_drag_take_their_share(oc6: ow.Turbine) -> None:
    """Of the row about the energy that the structure dissipates: it is not all of the energy."""
    system = ow.build(
        with_damping(oc6, MODAL), "distributed_springs", ow.StillWater(), elements=ELEMENTS
    )
    decay = FreeDecay(system, "FA1", 0.2)
    dissipated = decay.advance(2 * STEPS)["dissipated"][-1]
    load = 2 + decay.chain.loads.index(system.structural_loads[0])
    structural = dissipated[JOINT_DAMPERS] + dissipated[load]
    assert dissipated.sum() > 1.1 * structural
    assert dissipated[load] > 0.5 * structural


@pytest.mark.parametrize(
    "damping", [MODAL, RayleighDamping(ratios={"FA1": 0.01, "FA2": 0.012})], ids=lambda d: d.kind
)
def test_engines_agree(oc6: ow.Turbine, damping: StructuralDamping) -> None:
    """Residual, tangents, section loads, balance of segments and modes, moving and bent."""
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    system = ow.build(with_damping(oc6, damping), "distributed_springs", waves, elements=ELEMENTS)
    chain, equations, moving = CompiledChain(system), system.equations(), random_state(system)
    inputs, motion = chain.time_inputs(np.array([7.0]))[0], (moving.q, moving.v, moving.a)
    expected = equations.residual(7.0, *motion)
    assert relative_difference(chain.residual(inputs, *motion), expected) < 1e-12
    height = system.chain.boundary
    sections = chain.sections(height, [(float(height[2]), float(height[-3]))])
    record = chain.record(sections, inputs, *motion)
    by_pinocchio = section_loads(equations, 7.0, *motion, height)
    assert relative_difference(record.section_load[0], by_pinocchio) < 1e-10
    assert np.abs(record.imbalance[0]).max() < 1e-10 * np.abs(record.section_load).max()
    bare = CompiledChain(system.with_damping(system.joint_damping, {}))
    without = bare.record(bare.sections(height), inputs, *motion)
    part = record.section_load[0] - without.section_load[0]
    sizes = np.linalg.norm(part.reshape(-1, 2, 3), axis=-1)
    assert record.inertial_load[0] == pytest.approx(sizes, rel=1e-6, abs=1e-6 * sizes.max())
    assert sizes.max() > 1e-4 * np.abs(by_pinocchio).max()
    found = [ow.modes(system, 8, engine=engine) for engine in ("compiled", "pinocchio")]
    assert relative_difference(found[0].damping_parts, found[1].damping_parts) < 1e-9
    for modes in found:
        assert modes.damping_parts.sum(axis=1) == pytest.approx(modes.damping_ratio, rel=1e-9)


def test_tangents_are_derivatives(everything: ow.System) -> None:
    """Of Pinocchio's residual by displacement and velocity, in motion."""
    equations, moving = everything.equations(), random_state(everything)
    stiffness, damping = equations.tangents(3.0, moving.q, moving.v, moving.a)
    along = np.random.default_rng(1).normal(size=everything.nv)
    for tangent, step, by_q in ((stiffness, 1e-7, 1.0), (damping, 1e-6, 0.0)):
        ends = [
            equations.residual(
                3.0,
                moving.q + sign * step * by_q * along,
                moving.v + sign * step * (1 - by_q) * along,
                moving.a,
            )
            for sign in (1.0, -1.0)
        ]
        change = (ends[0] - ends[1]) / (2 * step)
        assert relative_difference(tangent @ along, change) < 1e-7


def test_newton_matrix_has_the_coupled_dampers(everything: ow.System) -> None:
    """Solutions of the compiled iteration matrix, with its k dampers on top, are those of the dense
    one; without them they are not."""
    q, rest = ow.static(everything).q, np.zeros(everything.nv)
    rhs = np.random.default_rng(2).normal(size=everything.nv)
    bare = everything.with_damping(everything.joint_damping, {})
    found = {}
    for name, solver in (
        ("compiled", CompiledChain(everything)),
        ("dense", DenseChain(everything.equations())),
        ("bare", CompiledChain(bare)),
    ):
        row = solver.time_inputs(np.zeros(1))[0]
        solver.factorise(row, q, rest, rest, 100.0, 1e4)
        found[name] = solver.correction(rhs)
    assert relative_difference(found["compiled"], found["dense"]) < 1e-10
    assert relative_difference(found["bare"], found["dense"]) > 1e-5


def test_engines_and_integrators_agree_in_time(oc6: ow.Turbine) -> None:
    """Compiled, Pinocchio and SciPy: the same decay from the undeformed state."""
    system = ow.build(with_damping(oc6, MODAL), "coupled_springs", ow.StillWater(), elements=5)
    every = ow.SaveAt(output_dt=0.1)
    runs = [
        ow.simulate(system, 2.0, 0.01, start="undeformed", engine=engine, save_at=every)
        for engine in ("compiled", "pinocchio")
    ]
    tops = [run["tower_top_displacement"].to_numpy() for run in runs]
    assert relative_difference(tops[0], tops[1]) < 1e-8
    scipy, fine = (
        ow.simulate(system, 0.5, start="undeformed", integrator=method, save_at=every)
        for method in (
            ow.SciPyIVP("Radau", 1e-7, 1e-9),
            GeneralizedAlpha(FixedStep(5e-4), spectral_radius=1.0),
        )
    )
    top = [run["tower_top_displacement"].to_numpy() for run in (scipy, fine)]
    assert relative_difference(top[1], top[0]) < 1e-4
    for run in (*runs, scipy):
        assert "modal damping" in run["sink"]


def test_a_ground_that_carries_the_structure_along_is_no_damper(oc6: ow.Turbine) -> None:
    """In motion with the ground as one rigid body the dampers have no force; at rest while the
    ground moves they do."""
    system = ow.build(with_damping(oc6, MODAL), "clamped", elements=ELEMENTS)
    chain = CompiledChain(system, ground_motion=shaking())
    rest = np.zeros(system.nv)
    times = np.linspace(0.5, 6.0, 12)
    load = chain.loads.index(system.structural_loads[0])
    points = slice(chain.model.first_point[load], chain.model.first_point[load + 1])
    ground = np.abs(chain.ground_motion.motion(times)[:, 0, 1]).max()  # type: ignore[union-attr]
    assert ground > 0.01
    for row in chain.time_inputs(times):
        chain.residual(row, rest, rest, rest)
        weight = np.abs(chain.data.wrench[0, 2])
        assert np.abs(chain.data.force[points]).max() < 1e-12 * weight
    moving = random_state(system)
    chain.residual(chain.time_inputs(times)[0], rest, moving.v, rest)
    assert np.abs(chain.data.force[points]).max() > 1e-6 * np.abs(chain.data.wrench[0, 2])


def test_states_resume(everything: ow.System) -> None:
    """A chain with modal damping pickles with its state; other ratios have another fingerprint."""
    chain, moving = CompiledChain(everything), random_state(everything)
    inputs = chain.time_inputs(np.array([1.0]))[0]
    residual = chain.residual(inputs, moving.q, moving.v, moving.a)
    again = pickle.loads(pickle.dumps(chain))
    assert np.array_equal(again.residual(inputs, moving.q, moving.v, moving.a), residual)
    turbine = with_damping(everything.turbine, MODAL.replace(others=0.016))
    other = ow.build(turbine, "distributed_springs", everything.sea, elements=ELEMENTS)
    prints = [s.structural_loads[0].fingerprint() for s in (everything, other)]
    assert prints[0] != prints[1]


def test_share_of_section_loads_is_reported(oc6: ow.Turbine) -> None:
    """Small beside mean loads, 2 zeta and more of the loads of a decay: then there is a caution."""
    load = np.array([1e6, 0, 0, 0, 0, 0.0])
    system = ow.build(with_damping(oc6, MODAL), "clamped", elements=ELEMENTS)
    calm = ow.simulate(system, 2.0, 0.02, [load])
    assert calm.attrs["inertial_damping_share"] < 1e-6
    assert "inertial_damping_caution" not in calm.attrs
    site = oc6.site.model_copy(update={"gravity": 1.0})
    light = with_damping(oc6, MODAL).model_copy(update={"site": site})
    released = ow.simulate(
        ow.build(light, "clamped", elements=ELEMENTS), 10.0, 0.02, [load], start="undeformed"
    )
    assert 0.01 < released.attrs["inertial_damping_share"] < 0.2
    assert "%" in released.attrs["inertial_damping_caution"]
    size = np.linalg.norm(released["section_moment"], axis=-1).max(axis=0)
    part = released["inertial_damping_load"].sel(resultant="moment")
    share = (part.max("time") / size).max()
    assert share <= released.attrs["inertial_damping_share"] * (1 + 1e-12)


def test_ratios_of_another_foundation(oc6: ow.Turbine) -> None:
    """A mode keeps the loss factor of its structure: on springs its ratio is smaller by the share
    of its potential energy that is in the structure."""
    clamped = MODAL.replace(foundation="clamped", still_water=False)
    system = ow.build(with_damping(oc6, clamped), "distributed_springs", elements=ELEMENTS)
    found = ow.modes(system, 8)
    at = found.index("FA2")
    nodes = slice(system.chain.roots, system.chain.axis_joints)
    stored = np.sum(system.joint_stiffness[nodes] * found.vector[nodes, at] ** 2)
    share = stored / (2 * np.pi * found.frequency_hz[at]) ** 2
    held = ow.build(with_damping(oc6, clamped), "clamped")
    theirs = ow.modes(held, 8)
    there = theirs.index("FA2")
    whole = np.sum(held.joint_stiffness * theirs.vector[:, there] ** 2)
    whole /= (2 * np.pi * theirs.frequency_hz[there]) ** 2
    assert found.damping_parts[at, 0] == pytest.approx(RATIOS["FA2"] * share / whole, rel=1e-6)
    assert share < 0.95 * whole


STIFFNESS = {
    # asked for; the largest structural ratio of any of the first eight modes
    "one plane": ({"FA1": 0.01, "FA2": 0.01}, 0.05),
    "other plane": ({"SS1": 0.01, "SS2": 0.02}, 0.11),
    "both planes": ({"FA1": 0.01, "SS1": 0.01, "FA2": 0.02}, 0.25),
    "torsion": ({"T1": 0.01}, 0.06),
}


@pytest.mark.parametrize("asked", STIFFNESS.values(), ids=STIFFNESS.keys())
def test_planes_that_nobody_named(
    oc6: ow.Turbine, asked: tuple[dict[str, float], float], caplog: pytest.LogCaptureFixture
) -> None:
    """They are damped as their twin is, never by what rounding leaves; what misses is said."""
    ratios, most = asked
    damping = StiffnessDamping(foundation="clamped", still_water=False, ratios=ratios)
    system = ow.build(with_damping(oc6, damping), "clamped")
    found = ow.modes(system, 8)
    parts = dict(zip(found.label, found.damping_parts[:, 0].tolist(), strict=True))
    assert max(parts.values()) < most
    assert min(parts.values()) > 1e-3
    if not {"FA1", "SS1"} <= set(ratios):
        assert parts["SS1"] == pytest.approx(parts["FA1"], rel=0.1)
    missed = {label for label, ratio in ratios.items() if abs(parts[label] / ratio - 1) > 0.05}
    assert system.damping_ratios == pytest.approx({label: parts[label] for label in ratios})
    for label in ratios:
        said = any(text.startswith(f"{label} has") for text in system.damping_cautions)
        assert said == (label in missed)
    assert len(caplog.messages) == len(system.damping_cautions)


def test_unmade_choices_are_even(oc6: ow.Turbine) -> None:
    """One ratio for two regions: the factors are those of one region over the whole height."""
    damping = StiffnessDamping(foundation="clamped", still_water=False, ratios={"FA1": 0.01})
    system = ow.build(with_damping(oc6, damping), "clamped")
    time = system.joint_damping / system.joint_stiffness
    assert time == pytest.approx(np.full(system.nv, time[0]), rel=1e-3)
    assert system.damping_ratios["FA1"] == pytest.approx(0.01, rel=1e-6)


def test_rayleigh(oc6: ow.Turbine) -> None:
    """Two modes have their ratios; frequencies give the textbook's factors."""
    named = RayleighDamping(ratios={"FA1": 0.01, "FA2": 0.012})
    system = ow.build(with_damping(oc6, named), "distributed_springs", elements=ELEMENTS)
    found = ow.modes(system, 6)
    for label, ratio in named.ratios.items():  # type: ignore[union-attr]
        assert found.damping_parts[found.index(label), 0] == pytest.approx(ratio, rel=1e-4)
    by_frequency = RayleighDamping(frequencies=(0.25, 1.25), ratios_at_frequencies=(0.01, 0.01))
    held = ow.build(with_damping(oc6, by_frequency), "clamped", elements=ELEMENTS)
    low, high = 2 * np.pi * 0.25, 2 * np.pi * 1.25
    beta = 2 * 0.01 / (low + high)
    assert held.joint_damping == pytest.approx(beta * held.joint_stiffness)
    modes = ow.modes(held, 8)
    omega = 2 * np.pi * modes.frequency_hz
    # Weight takes stiffness off, which the joints' dampers do not see.
    textbook = (beta * low * high / omega + beta * omega) / 2
    assert modes.damping_parts[:, 0] == pytest.approx(textbook, rel=0.02)


BAD = {
    "a mode that does not exist": (
        {"kind": "modal", "ratios_of_critical": {"FA9": 0.01}, "others": 0.01},
        r"turbine oc6_phase2, field structural_damping\.ratios_of_critical\.FA9.*FA1",
    ),
    "a foundation that does not exist": (
        {"foundation": "swamp", "ratios_of_critical": {"FA1": 0.01}},
        r"field structural_damping\.foundation.*swamp.*clamped",
    ),
    "others left open": (
        {"kind": "modal", "ratios_of_critical": {"FA1": 0.01}},
        r"structural_damping\.others",
    ),
    "an unknown kind": ({"kind": "magic"}, "stiffness, modal, rayleigh"),
    "Rayleigh by nothing": ({"kind": "rayleigh"}, "no numbers.*frequencies_hz"),
    "Rayleigh by half": ({"kind": "rayleigh", "alpha_per_s": 0.1}, "incomplete"),
    "Rayleigh by three modes": (
        {"kind": "rayleigh", "ratios_of_critical": {"FA1": 0.01, "FA2": 0.01, "SS1": 0.01}},
        "names 3 modes",
    ),
    "ratios that need a negative factor": (
        {"kind": "rayleigh", "ratios_of_critical": {"FA1": 0.01, "FA2": 0.2}},
        r"ratios_of_critical.*kind: modal",
    ),
    "a misspelt key": (
        {"kind": "modal", "ratios_of_critical": {"FA1": 0.01}, "others": 0.01, "cutof_hz": 5},
        "Did you mean 'cutoff'",
    ),
    "a vertical mode by joints": ({"ratios_of_critical": {"V1": 0.01}}, "bend or twist"),
}


@pytest.mark.parametrize(("block", "message"), BAD.values(), ids=BAD.keys())
def test_bad_input(oc6: ow.Turbine, block: dict[str, object], message: str) -> None:
    """Refused with the field, what is allowed and a remedy."""
    content = oc6.model_dump(mode="json", by_alias=True) | {"structural_damping": block}
    with pytest.raises(ow.InputError, match=message):
        ow.build(ow.Turbine(**content), "coupled_springs", elements=2)
