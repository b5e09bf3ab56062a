"""Tuned mass dampers as bodies of the chain: statics, section loads, energies, modes, files."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
import xarray as xr
from helpers.by_hand import section_loads
from helpers.dampers import damper, several, with_dampers
from helpers.numerics import fitted_order, relative_difference
from helpers.states import random_state
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.cases.tree_summary import summarise_dampers
from offwind_pin.cases.turbine_overview import overview
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.soil.springs import Soil
from offwind_pin.definitions.turbine import PointMass
from offwind_pin.display.figures.results import mode_shapes
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.structure.pinocchio_model import build_model
from offwind_pin.structure.urdf import urdf_text, write_sidecar

Array = NDArray[np.float64]

PUSH = np.array([1e6, 3e5, 0, 0, 0, 1e7])
NOTHING = ow.LoadHistory(np.zeros(1), np.zeros((1, 6)), "nothing")


@pytest.fixture(scope="module")
def damped(undamped: ow.Turbine) -> ow.System:
    return ow.build(several(undamped), "coupled_springs", elements=8)


def let_go(
    system: ow.System, duration: float, dt: float, save_at: ow.SaveAt | None = None, **keys: object
) -> xr.Dataset:
    """Free motion from the static state under a load at the top, which is then gone."""
    load = TowerTopLoad(system.chain.top, NOTHING, PUSH)
    method = GeneralizedAlpha(ow.FixedStep(dt), 1.0, 1e-11, 1e-12)
    settings: dict[str, object] = {"loads": [load], "integrator": method}
    save_at = save_at or ow.SaveAt(heights=[20.0])
    return ow.simulate(system, duration, save_at=save_at, **(settings | keys))  # type: ignore[arg-type]


def test_a_tilted_mass_hangs_in_its_spring(damped: ow.System) -> None:
    """At rest k q = -m g (axis of the joint . up): it slides downhill."""
    found = ow.static(damped, PUSH)
    chain = CompiledChain(damped, found.loads, np.inf)
    rest = np.zeros(damped.nv)
    chain.residual(chain.time_inputs(np.zeros(1))[0], found.q, rest, rest)
    gravity, joints = damped.turbine.site.gravity, damped.chain.axis_joints
    expected = [
        -mass.mass * gravity / mass.stiffness * chain.data.rotation[mass.body, 2, "xy".index(j[1])]
        for mass in damped.chain.tuned_masses
        for j in mass.joints
    ]
    assert found.q[joints:] == pytest.approx(expected, rel=1e-7)
    # Of the damper at the top: along x and y, where the load pushes and bends the tower to.
    leaning = ow.static(damped)
    assert np.all(found.q[joints : joints + 2] > leaning.q[joints : joints + 2] + 5e-3)


@pytest.mark.parametrize("element", ["euler_bernoulli", "timoshenko"])
def test_a_locked_damper_is_a_point_mass(undamped: ow.Turbine, element: Element) -> None:
    """As the spring grows, statics and modes go to those of the same point mass, like 1 / k."""
    push = np.array([1e6, 0, 0, 0, 0, 0.0])
    errors: list[list[float]] = []
    stiffness = [1e9, 1e10, 1e11]
    for spring in stiffness:
        tuning = {"stiffness_n_per_m": spring, "damping_n_s_per_m": 0.0}
        turbine = with_dampers(
            undamped,
            damper("low", 30.0, "both", **tuning),
            damper("high", undamped.yaw_bearing, "both", **tuning),
        )
        systems = [
            ow.build(t, "coupled_springs", elements=6, element=element)
            for t in (turbine, turbine.with_dampers_locked())
        ]
        modes = [ow.modes(system, 6) for system in systems]
        top = [ow.static(system, push).tower_top_displacement[0] for system in systems]
        assert modes[0].label == modes[1].label
        change = modes[0].frequency_hz / modes[1].frequency_hz - 1
        errors.append([np.abs(change).max(), abs(top[0] / top[1] - 1)])
    for one in np.array(errors).T:
        assert fitted_order(stiffness, one) == pytest.approx(-1.0, abs=0.05)
    assert np.max(errors[-1]) < 1e-3


def test_a_point_mass_elsewhere_is_seen(undamped: ow.Turbine) -> None:
    """Negative control: locked 10 m lower, or left out, it has other frequencies."""
    frequency = []
    for place in ([80.0], [70.0], []):
        turbine = with_dampers(undamped, *(damper("a", z, "both") for z in place))
        system = ow.build(turbine.with_dampers_locked(), "clamped", elements=6)
        frequency.append(ow.modes(system, 2).frequency_hz[0])
    assert frequency[0] < 0.999 * frequency[1] < 0.998 * frequency[2]


@pytest.mark.parametrize("seed", [0, 1])
def test_section_loads_jump_by_the_damper_s_force(damped: ow.System, seed: int) -> None:
    """Along its joints by spring and damper, in a state that satisfies the equations of motion.

    Two dampers sit at 20 m and one at the yaw bearing, above every cut.
    """
    state, height = random_state(damped, seed, 0.01), 20.0
    chain = CompiledChain(damped)
    acceleration = chain.equations().acceleration(0.0, state.q, state.v)
    cuts = np.array([height, height + 1e-7, damped.chain.top])
    row = chain.time_inputs(np.zeros(1))[0]
    record = chain.record(chain.sections(cuts), row, state.q, state.v, acceleration)
    load = record.section_load[0]
    pull = damped.joint_stiffness * state.q + damped.joint_damping * state.v
    names = damped.chain.joint_name
    axes = chain.data.rotation[damped.chain.body_at(np.array([height]))[0]]
    jump = axes.T @ (load[0, :3] - load[1, :3])
    across_x = pull[names.index("zz_tmd_guide_px")]
    across_y = pull[names.index("zz_tmd_guide_py")] + pull[names.index("zz_tmd_middle_py")]
    # A ten-millionth of a metre of the wall weighs some grams.
    assert jump[1] == pytest.approx(across_y, abs=10.0)
    assert abs(across_x) > 1e3
    # Along x the second damper is held: the body pushes its whole mass.
    guide, middle = (
        next(d for d, m in enumerate(damped.chain.tuned_masses) if m.name == name)
        for name in ("guide", "middle")
    )
    gravity = np.array([0.0, 0.0, damped.turbine.site.gravity])
    need = [
        chain.model.tmd.mass[d] * (chain.data.tmd_acceleration[d] + gravity)
        for d in (guide, middle)
    ]
    assert jump[0] == pytest.approx(across_x - axes[:, 0] @ need[1], abs=10.0)
    assert -(axes[:, 0] @ need[0]) == pytest.approx(across_x, abs=10.0)


def test_pinocchio_s_acceleration_of_the_masses(damped: ow.System) -> None:
    """Place, velocity and acceleration with Coriolis terms, by forward kinematics."""
    state = random_state(damped, 3, 0.5)
    chain = CompiledChain(damped)
    chain.residual(chain.time_inputs(np.zeros(1))[0], state.q, state.v, state.a)
    model, data = damped.pin_model, damped.scratch.data
    pin.forwardKinematics(model, data, state.q, state.v, state.a)
    for d, mass in enumerate(damped.chain.tuned_masses):
        joint = model.getJointId(mass.joint_names[-1])
        frame = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        expected = [
            data.oMi[joint].translation,
            pin.getVelocity(model, data, joint, frame).linear,
            pin.getClassicalAcceleration(model, data, joint, frame).linear,
        ]
        s = chain.data
        found = [s.tmd_position[d], s.tmd_velocity[d], s.tmd_acceleration[d]]
        for ours, theirs in zip(found, expected, strict=True):
            assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-12)


def test_energy_closes_in_a_free_decay(damped: ow.System) -> None:
    """Stored, dissipated and worked: to second order in dt, with most of the motion made heat."""
    steps, errors = [0.02, 0.01, 0.005], []
    for dt in steps:
        data = let_go(damped, 20.0, dt, ow.SaveAt(0.2))
        errors.append(float(np.abs(data["energy_balance"]).max()))
    heat = data["energy_dissipated"].sel(sink="joint_dampers")[-1].item()
    assert fitted_order(steps, errors) == pytest.approx(2.0, abs=0.1)
    assert errors[-1] < 1e-4 * heat
    assert heat > 1e5


def test_without_damper_energy_is_kept(undamped: ow.Turbine) -> None:
    """A spring alone exchanges energy and loses none; the mass moves more than its carrier."""
    free = damper("a", 115.63, "both", frequency_hz=0.25, damping_ratio=0.0)
    system = ow.build(with_dampers(undamped, free), "clamped", elements=5)
    data = let_go(system, 40.0, 0.01, ow.SaveAt(0.1))
    kinetic = data["energy_stored"].sel(holder="kinetic").max().item()
    assert np.all(data["energy_dissipated"] == 0)
    assert np.abs(data["energy_balance"]).max() < 1e-4 * kinetic
    slip = data["tuned_mass_displacement"].sel(damper="a", across="x")
    assert slip.attrs["units"] == "m"
    top = data["tower_top_displacement"].sel(direction="x")
    assert np.ptp(slip.to_numpy()) > np.ptp(top.to_numpy())


def test_segments_are_in_equilibrium(undamped: ow.Turbine) -> None:
    """With dampers and point masses at any height: in the pile, at the mudline, at the yaw bearing."""
    heights = [undamped.toe, -60.0, undamped.site.mudline, 15.0, undamped.yaw_bearing]
    masses = tuple(
        PointMass(name="m", z_m=z, mass_kg=2e5, inertia_kg_m2=(1e5, 1e5, 2e5)) for z in heights
    )
    turbine = several(undamped.model_copy(update={"point_masses": masses}))
    system = ow.build(turbine, "distributed_springs", ow.StillWater(), elements=8)
    bare = ow.build(undamped, "distributed_springs", elements=8)
    assert system.chain.mass - bare.chain.mass == pytest.approx(
        1e6 - sum(m.mass for m in undamped.point_masses) + 9e5, rel=1e-9
    )
    ends = [(-75.0, 115.63), (-30.0, 115.63), (-75.0, -30.0), (20.0, 50.0), (-60.0, 20.0)]
    data = let_go(system, 2.0, 0.05, ow.SaveAt(heights=[20.0], segments=ends))
    assert np.abs(data["section_force"]).max() > 1e7
    assert np.abs(data["segment_imbalance"]).max() < 1e-3


def test_a_mass_at_the_yaw_bearing_is_on_top_of_every_cut(undamped: ow.Turbine) -> None:
    """Its weight is in every section load; the segment below the yaw bearing ends without it."""
    mass = PointMass(name="flange", z_m=undamped.yaw_bearing, mass_kg=1e5)
    with_it = undamped.model_copy(update={"point_masses": (*undamped.point_masses, mass)})
    loads = [
        ow.static(ow.build(turbine, "clamped", elements=5)).section_load[:, 2]
        for turbine in (undamped, with_it)
    ]
    assert loads[0] - loads[1] == pytest.approx(1e5 * undamped.site.gravity, rel=1e-6)


def test_modes_split_and_keep_their_names(oc6: ow.Turbine) -> None:
    """A damper tuned to FA1 splits it in two, one mode of its own; all others keep their labels."""
    locked = damper("a", oc6.yaw_bearing, "fore_aft", 2e4, frequency_hz=0.2, damping_ratio=0.1)
    without = with_dampers(oc6, locked).with_dampers_locked()
    plain = ow.modes(ow.build(without, "coupled_springs", elements=12), 8)
    first = float(plain.frequency_hz[plain.index("FA1")])
    tuned = damper("a", oc6.yaw_bearing, "fore_aft", 2e4, frequency_hz=first, damping_ratio=0.1)
    system = ow.build(with_dampers(oc6, tuned), "coupled_springs", elements=12)
    found = ow.modes(system, 9)
    assert sorted(found.label) == sorted([*plain.label, "TMD1"])
    pair = sorted(float(found.frequency_hz[found.index(label)]) for label in ("FA1", "TMD1"))
    assert pair[0] < 0.99 * first
    assert 1.01 * first < pair[1]
    for label in plain.label:
        if label != "FA1":
            ours, theirs = found.frequency_hz[found.index(label)], plain.frequency_hz
            assert ours == pytest.approx(theirs[plain.index(label)], rel=0.02)
    assert found.damper_share[found.index("TMD1")] > 0.5 > found.damper_share[found.index("FA1")]
    assert found.participation.sum(axis=1) == pytest.approx(1.0, rel=1e-12)
    assert found.direction("TMD1") == "FA"
    assert found.damping_ratio[found.index("TMD1")] > 0.03


def two_in_one_plane(turbine: ow.Turbine, frequency: tuple[float, float]) -> ow.Turbine:
    return with_dampers(
        turbine,
        *(
            damper(name, 115.0, "fore_aft", 5e4, frequency_hz=own, damping_ratio=0.1)
            for name, own in zip("ab", frequency, strict=True)
        ),
    )


@pytest.mark.parametrize("apart", [0.0, 0.1])
def test_labels_do_not_hang_on_how_many_are_asked_for(undamped: ow.Turbine, apart: float) -> None:
    """Two dampers tuned around one mode make three, one of which stays FA1: also where all three
    hold most of their energy in the dampers."""
    locked = two_in_one_plane(undamped, (0.2, 0.2)).with_dampers_locked()
    plain = ow.modes(ow.build(locked, "clamped", elements=8), 2)
    first = float(plain.frequency_hz[plain.index("FA1")])
    tuned = two_in_one_plane(undamped, (first * (1 - apart), first * (1 + apart)))
    system = ow.build(tuned, "clamped", elements=8)
    whole = ow.modes(system, 10)
    three = [whole.index(label) for label in ("TMD1", "TMD2", "FA1")]
    assert "TMD3" not in whole.label
    assert np.all(whole.frequency_hz[three] < 2 * first)
    assert bool(np.all(whole.damper_share[three] > 0.5)) == (apart > 0)
    for n in (1, 2, 3, 5):
        assert ow.modes(system, n).label == whole.label[:n]


def test_structural_damping_is_that_of_the_structure(oc6: ow.Turbine) -> None:
    """Calibrated with the damper locked: the same factors as for a point mass."""
    turbine = with_dampers(oc6, damper("a", 100.0, "both", 3e5))
    systems = [ow.build(t, "clamped", elements=6) for t in (turbine, turbine.with_dampers_locked())]
    nodes = slice(0, systems[0].chain.axis_joints)
    assert np.array_equal(systems[0].joint_damping[nodes], systems[1].joint_damping)
    assert systems[0].damping_ratios == systems[1].damping_ratios
    assert systems[0].joint_damping[-1] == pytest.approx(2 * 0.1 * 3e5 * 2 * np.pi * 0.25)


def test_foundations_take_dampers(undamped: ow.Turbine) -> None:
    """What stands in for the pile is that of the pile: condensed stiffness and the like."""
    turbine = several(undamped)
    for name in ("apparent_fixity", "macro_element"):
        assert "TMD1" in ow.modes(ow.build(turbine, name, elements=8), 12).label
    condensed = []
    for whole in (turbine, turbine.with_dampers_locked()):
        system = ow.build(whole, "distributed_springs", elements=12)
        condensed.append(ow.condense(system, ow.static(system)))
    # Masses that hang a little downhill lean the structure a little more.
    size = np.sqrt(np.diag(condensed[1].stiffness))
    change = np.abs(condensed[0].stiffness - condensed[1].stiffness) / np.outer(size, size)
    assert change.max() < 1e-4
    assert ow.pile_only(turbine).tuned_mass_dampers == ()
    assert [d.name for d in ow.pile_only(turbine, 60.0).tuned_mass_dampers] == [
        "deep",
        "middle",
        "guide",
    ]


def test_a_stopped_run_goes_on(damped: ow.System, tmp_path: Path) -> None:
    """To bitwise the same results, the dampers' displacements among them."""
    keys = {"save_at": ow.SaveAt(0.5, heights=[20.0]), "duration": 50.0, "dt": 0.05}
    whole = let_go(damped, **keys, directory=tmp_path / "whole")  # type: ignore[arg-type]

    def stop(now: float) -> None:
        if now >= 20:
            raise KeyboardInterrupt

    with pytest.raises(ow.InterruptedSimulation):
        let_go(damped, **keys, directory=tmp_path / "run", progress=stop)  # type: ignore[arg-type]
    again = let_go(damped, **keys, directory=tmp_path / "run")  # type: ignore[arg-type]
    assert whole.identical(again)
    assert np.ptp(again["tuned_mass_displacement"].to_numpy()) > 0.1


def test_travel_is_watched(
    undamped: ow.Turbine, caplog: pytest.LogCaptureFixture, tmp_path: Path
) -> None:
    """Once of a damper that goes too far, never of one with room; the numbers are in the results."""
    tuning = {"frequency_hz": 0.3, "damping_ratio": 0.05}
    turbine = with_dampers(
        undamped,
        damper("short", 115.63, "both", travel_m=0.2, **tuning),
        damper("long", 110.0, "both", travel_m=50.0, **tuning),
        damper("any", 100.0, "both", **tuning),
    )
    data = let_go(ow.build(turbine, "clamped", elements=4), 45.0, 0.05, ow.SaveAt(0.1))
    reported = [record.getMessage() for record in caplog.records]
    assert [text for text in reported if "short" in text] == reported
    assert len(reported) == 1
    assert "0.2 m" in reported[0]
    assert data["tuned_mass_travel"].sel(damper=["short", "long"]).values.tolist() == [0.2, 50.0]
    assert np.isinf(data["tuned_mass_travel"].sel(damper="any"))


def test_urdf_is_read_back_in_the_chain_s_order(undamped: ow.Turbine) -> None:
    """Whatever the dampers are named: those of the highest body first, then by name."""
    places = [("zz", 80.0), ("a_px", 80.0), ("a", 80.0), ("top", 115.63), ("a_px_link", 10.0)]
    turbine = with_dampers(undamped, *(damper(name, z, "both") for name, z in places))
    system = ow.build(turbine, "coupled_springs", elements=9)
    names = system.chain.joint_name[system.chain.axis_joints :]
    order = ["top", "a", "a_px", "zz", "a_px_link"]
    assert names == tuple(f"zz_tmd_{name}_{joint}" for name in order for joint in ("px", "py"))
    text = urdf_text(system.turbine, system.chain)
    model = pin.buildModelFromXML(text)
    assert tuple(model.names)[1:] == system.chain.joint_name
    read = model.inertias[model.getJointId("zz_tmd_top_py")]
    assert (read.mass, np.abs(read.lever).max(), np.abs(read.inertia).max()) == (2e5, 0, 0)
    nodes = system.joint_damping[6 : system.chain.axis_joints].reshape(-1, 3)
    beside = write_sidecar(system.turbine, system.chain, nodes, {})["tuned_mass_dampers"]
    assert list(beside) == list(names)
    assert beside["zz_tmd_a_py"]["stiffness"] == pytest.approx(2e5 * (0.5 * np.pi) ** 2)
    swapped = (*system.chain.joint_name[:-2], *system.chain.joint_name[:-3:-1])
    wrong = replace(system.chain, joint_name=swapped)
    with pytest.raises(RuntimeError, match="not those of the chain"):
        build_model(system.turbine, wrong)


def test_no_damper_changes_nothing(undamped: ow.Turbine) -> None:
    """The URDF text names none; the hash is that of a definition without the field, and moves with
    it."""
    chain = ow.build(undamped, "clamped", elements=5).chain
    assert "tmd" not in urdf_text(undamped, chain)
    assert "damper" not in urdf_text(undamped, chain)
    assert "tuned_mass_dampers" not in write_sidecar(undamped, chain, chain.joint_stiffness, {})
    hashes = {undamped.content_hash}
    for z in (50.0, 60.0):
        hashes.add(with_dampers(undamped, damper("a", z, "both")).content_hash)
    assert len(hashes) == 3
    system = ow.build(undamped, "clamped", elements=5)
    assert "tuned_mass_displacement" not in ow.simulate(system, 0.1, 0.05)


def test_plot_of_the_shapes_has_it(damped: ow.System) -> None:
    """As a mode of its own."""
    figure = mode_shapes(ow.modes(damped, 8), damped.turbine.site.mudline)
    labels = [text.get_text() for axes in figure.axes for text in axes.get_legend().get_texts()]
    assert any(text.startswith("TMD1") for text in labels)


@pytest.mark.parametrize("element", ["euler_bernoulli", "timoshenko"])
def test_a_damper_on_a_clamped_base(undamped: ow.Turbine, element: Element) -> None:
    """The lowest body does not move, its damper does: residual, tangent, section loads."""
    system = ow.build(several(undamped), "clamped", elements=6, element=element)
    assert [mass.body for mass in system.chain.tuned_masses][-1] == 0
    state, chain = random_state(system, 4), CompiledChain(system)
    equations, row = chain.equations(), chain.time_inputs(np.zeros(1))[0]
    found = chain.residual(row, state.q, state.v, state.a)
    expected = equations.residual(0.0, state.q, state.v, state.a)
    sliding = slice(system.chain.axis_joints, None)
    for part in (slice(0, system.chain.axis_joints), sliding):
        assert relative_difference(found[part], expected[part]) < 1e-12
    rest = np.zeros(system.nv)
    for dv_dq, da_dq in ((0.0, 0.0), (111.0, 1.23e4)):
        chain.factorise(row, state.q, rest, rest, dv_dq, da_dq)
        inverse = np.array([chain.correction(unit) for unit in np.eye(system.nv)]).T
        stiffness, damping = equations.tangents(0.0, state.q, rest)
        matrix = da_dq * equations.mass(state.q) + dv_dq * damping + stiffness
        assert np.abs(matrix @ inverse - np.eye(system.nv)).max() < 1e-9
    cuts = np.array([system.chain.base, 20.0, 20.1, system.chain.top])
    record = chain.record(chain.sections(cuts), row, state.q, state.v, state.a)
    by_joints = section_loads(equations, cuts, 0.0, state.q, state.v, state.a)
    assert relative_difference(record.section_load[0], by_joints) < 1e-11


def test_overview_names_the_dampers(undamped: ow.Turbine) -> None:
    """Their tuning however it was given, and their mass in that above the mudline."""
    turbine = several(undamped.model_copy(update={"soil": Soil()}))
    bare, found = (overview(one) for one in (with_dampers(turbine), turbine))
    assert found.mass_above_mudline_kg - bare.mass_above_mudline_kg == pytest.approx(9e5)
    guide = next(one for one in found.tuned_mass_dampers if one.name == "guide")
    assert guide.frequency_hz == pytest.approx(np.sqrt(8e5 / 3e5) / (2 * np.pi), rel=1e-12)
    assert guide.damping_ratio == pytest.approx(2e4 / (2 * np.sqrt(8e5 * 3e5)), rel=1e-12)
    rows = dict(dict(found.tables())["Masses"])
    assert rows["middle"] == "200,000 kg, z +20.00 m, slides side-side at 0.25 Hz, 10 % of critical"
    assert "middle" not in dict(dict(bare.tables())["Masses"])
    assert found.frequencies_hz["clamped, dry"].keys() == bare.frequencies_hz["clamped, dry"].keys()


def test_a_mode_that_moves_nothing_else(undamped: ow.Turbine) -> None:
    """That of a damper on a clamped base: its own frequency and damping, an axis at rest."""
    own = damper("a", undamped.site.mudline, "fore_aft", frequency_hz=0.15, damping_ratio=0.2)
    system = ow.build(with_dampers(undamped, own), "clamped", elements=5)
    result = ow.modes(system, 3)
    assert result.label[0] == "TMD1"
    assert result.frequency_hz[0] == pytest.approx(0.15, rel=1e-9)
    assert result.damping_ratio[0] == pytest.approx(0.2, rel=1e-9)
    assert np.abs(result.mass_normalised[0]).max() < 1e-9


def test_a_case_s_summary_has_the_largest_motion(oc6: ow.Turbine, tmp_path: Path) -> None:
    """Of each damper by name; nothing for a turbine without any."""
    turbine = with_dampers(oc6, damper("top", 100.0, "both", 2e4))
    pushed = np.zeros((2, 6))
    pushed[:, 0] = 0.0, 1e6
    history = ow.LoadHistory(np.array([0.0, 20.0]), pushed, "push")
    kinds = (turbine, oc6)
    found = []
    for kind in kinds:
        system = ow.build(kind, "clamped", elements=6)
        data = ow.simulate(system, 20.0, 0.1, [history], save_at=ow.SaveAt(heights=[0.0]))
        found.append((summarise_dampers(data), data))
    (row,) = found[0][0]["tuned_mass_dampers"]
    slips = found[0][1]["tuned_mass_displacement"].to_numpy()
    assert row["name"] == "top"
    assert row["largest_displacement_m"] == pytest.approx(np.abs(slips[..., 0]).max(), rel=1e-6)
    assert found[1][0] == {}
