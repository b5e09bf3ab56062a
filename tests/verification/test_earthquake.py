"""Structures in earthquakes against closed forms, response spectra, and one another."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.earthquakes import by_depth, shaking
from helpers.numerics import fitted_order
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.definitions.soil.depth_profile import DepthLine
from offwind_pin.definitions.soil.springs import CoupledSprings, LinearModulus
from offwind_pin.signal.response_spectrum import response_spectrum
from offwind_pin.verification.plain_tubes import tube

Array = NDArray[np.float64]

MASS, LENGTH, GRAVITY = 1e9, 100.0, 9.81
ARM = LENGTH / 2
"""m from the single joint, at mid-height, to the mass."""


def single_mass(period: float, ratio: float) -> ow.System:
    """One element of a hundred thousandth of the mass on top: a joint, a spring, a damper.

    The weight reduces the spring stiffness by m g / arm, as in an inverted pendulum.
    """
    turbine = tube(length=LENGTH, density=100.0, gravity=GRAVITY, top_mass=MASS)
    system = ow.build(turbine, "clamped", elements=1)
    frequency = 2 * np.pi / period
    inertia = MASS * ARM**2
    spring = inertia * (frequency**2 + GRAVITY / ARM)
    damper = 2 * ratio * frequency * inertia
    system = replace(system, joint_stiffness=np.full(system.nv, spring))
    return system.with_damping(np.full(system.nv, damper), {})


def relative(data: xr.Dataset) -> Array:
    """(t, 3) displacement of the top relative to the ground."""
    ground = data["ground_displacement"].isel(level=-1).to_numpy()
    return data["tower_top_displacement"].to_numpy() - ground


@pytest.mark.parametrize("period", [0.25, 0.8, 2.5])
def test_single_mass_has_the_response_spectrum_s_ordinates(period: float) -> None:
    """Displacement, pseudo and absolute acceleration within 0.5 %, in both horizontal directions."""
    motion = shaking(peak=(3.0, 2.0, 0.0))
    data = ow.simulate(
        single_mass(period, 0.05),
        16.0,
        ground_motion=motion,
        integrator=ow.GeneralizedAlpha(ow.FixedStep(0.0025), 1.0),
    )
    spectrum = response_spectrum(motion.corrected[0], motion.step, np.array([period]), 0.05)
    found = np.abs(relative(data)).max(axis=0)
    assert found[:2] == pytest.approx(spectrum.displacement[0, :2], rel=5e-3)
    pseudo = found * (2 * np.pi / period) ** 2
    assert pseudo[:2] == pytest.approx(spectrum.pseudo_acceleration[0, :2], rel=5e-3)
    top = np.abs(data["acceleration"].isel(height=-1).to_numpy()).max(axis=0)
    assert top[:2] == pytest.approx(spectrum.absolute_acceleration[0, :2], rel=5e-3)
    other = response_spectrum(motion.corrected[0], motion.step, np.array([1.05 * period]), 0.05)
    assert np.abs(found[:2] / other.displacement[0, :2] - 1).max() > 5e-3  # negative control


def test_harmonic_motion_of_the_base() -> None:
    """Amplitude and phase of the steady state of an oscillator on a base that moves as cos(w t)."""
    period, ratio, driven = 1.0, 0.1, 2 * np.pi * 1.3
    time = 0.0025 * np.arange(8001)
    record = np.zeros((len(time), 3))
    record[:, 0] = 0.5 * np.cos(driven * time)
    motion = ow.GroundMotion(time, record)
    data = ow.simulate(single_mass(period, ratio), 20.0, 0.0025, ground_motion=motion)
    own = 2 * np.pi / period
    steady = -0.5 / (own**2 - driven**2 + 2j * ratio * own * driven)
    late = data["time"].to_numpy() > 15.0
    expected = (steady * np.exp(1j * driven * data["time"].to_numpy())).real
    error = np.abs(relative(data)[late, 0] - expected[late]).max()
    assert error < 1e-3 * abs(steady)


def test_vertical_component_weighs_on_the_base() -> None:
    """A clamped chain does not shorten: what it exerts on its base is -m (g + a_z)."""
    system = ow.build(tube(gravity=GRAVITY, top_mass=1e5), "clamped", elements=4)
    motion = shaking(4.0, 0.02, peak=(0.0, 0.0, 2.0))
    data = ow.simulate(system, 4.0, 0.02, ground_motion=motion)
    chain = system.chain
    mass = chain.rna.mass + sum(body.mass for body in chain.body)
    upward = data["ground_acceleration"].isel(level=0).sel(direction="z").to_numpy()
    found = data["mudline_force"].sel(direction="z").to_numpy()
    assert found == pytest.approx(-mass * (GRAVITY + upward), rel=1e-9)
    assert np.ptp(upward) > 2.0
    top = relative(data)
    assert np.abs(top).max() < 1e-9


def test_rigid_structure_goes_with_its_base() -> None:
    """Joints a million times stiffer: base shear -m a, every point displaced as the ground."""
    system = ow.build(tube(gravity=GRAVITY, top_mass=1e5), "clamped", elements=3)
    system = replace(system, joint_stiffness=1e6 * system.joint_stiffness)
    motion = shaking(4.0, 0.02)
    data = ow.simulate(system, 4.0, 0.002, ground_motion=motion, save_at=ow.SaveAt(0.02))
    ground = data["ground_displacement"].isel(level=0).to_numpy()
    displacement = data["displacement"].to_numpy()
    assert np.abs(displacement - ground[:, None]).max() < 1e-5 * np.abs(ground).max()
    chain = system.chain
    mass = chain.rna.mass + sum(body.mass for body in chain.body)
    pull = -mass * data["ground_acceleration"].isel(level=0).to_numpy()
    found = data["mudline_force"].to_numpy() + np.array([0, 0, mass * GRAVITY])
    rung_down = data["time"].to_numpy() > 1.0
    assert np.abs(found - pull)[rung_down].max() < 1e-3 * np.abs(pull).max()


def test_turning_the_earthquake_turns_the_answer() -> None:
    """A round structure cannot tell directions apart: a record turned about z by 50 degrees."""
    system = ow.build(tube(gravity=GRAVITY, top_mass=1e5), "clamped", elements=6)
    motion = shaking(5.0, 0.02)
    angle = np.radians(50)
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    method = ow.GeneralizedAlpha(ow.FixedStep(0.01), 0.9, 1e-11, 1e-12)
    plain, turned = (
        ow.simulate(system, 5.0, ground_motion=given, integrator=method)
        for given in (motion, motion.turned(angle))
    )
    for channel in ("displacement", "acceleration", "section_force"):
        expected = plain[channel].to_numpy() @ turn.T
        size = np.abs(expected).max()
        assert np.abs(turned[channel].to_numpy() - expected).max() < 1e-5 * size
        assert np.abs(turned[channel].to_numpy() - plain[channel].to_numpy()).max() > 0.1 * size


def turbine_on_pile() -> ow.Turbine:
    """A tower with a mass on top, and below the mudline a pile a million times stiffer."""
    tower = tube(gravity=GRAVITY, top_mass=3e5, embedded=20.0)
    steel = tower.materials["steel"]
    rigid = {name: 1e6 * getattr(steel, name) for name in ("youngs_modulus", "shear_modulus")}
    (member,) = tower.members
    top, bottom = max(s.z for s in member.stations), min(s.z for s in member.stations)
    station = member.stations[0]
    parts = [
        member.model_copy(
            update={
                "name": name,
                "material": material,
                "stations": tuple(station.model_copy(update={"z": z}) for z in ends),
            }
        )
        for name, material, ends in (
            ("pile", "rigid", (bottom, -20.0)),
            ("tower", "steel", (-20.0, top)),
        )
    ]
    materials = {"steel": steel, "rigid": steel.model_copy(update=rigid)}
    return tower.model_copy(update={"members": tuple(parts), "materials": materials})


def in_soil(oc6: ow.Turbine, modulus: float, elements: dict[str, int] | None = None) -> ow.System:
    """That on distributed springs of a modulus in N/m2."""
    given = oc6.soil.distributed_springs
    assert given is not None
    soil = given.model_copy(
        update={
            "curve": LinearModulus(
                kind="linear", modulus=DepthLine(at_mudline=modulus, gradient=0)
            ),
            "toe_vertical_stiffness": 100 * modulus,
            "toe_torsional_stiffness": 100 * modulus,
            "dashpot": None,
        }
    )
    turbine = turbine_on_pile()
    turbine = turbine.model_copy(
        update={"soil": turbine.soil.model_copy(update={"distributed_springs": soil})}
    )
    return ow.build(turbine, "distributed_springs", elements=elements or {"pile": 4, "tower": 6})


def on_base(system: ow.System, motion: ow.GroundMotion, duration: float = 5.0) -> xr.Dataset:
    return ow.simulate(
        system,
        duration,
        0.01,
        ground_motion=motion,
        save_at=ow.SaveAt(heights=[-20.0, 20.0], segments=[(-20.0, 80.0)]),
    )


@pytest.fixture(scope="module")
def on_the_ground() -> xr.Dataset:
    """The tower clamped at the mudline."""
    system = ow.build(turbine_on_pile(), "clamped", elements={"tower": 6})
    return on_base(system, shaking(5.0, 0.02))


CHANNELS = ("displacement", "acceleration", "section_moment")


def worst(data: xr.Dataset, reference: xr.Dataset) -> float:
    """Largest difference of the channels at mudline, in between and top, over their largest."""
    return max(
        float(np.abs(data[name] - reference[name]).max() / np.abs(reference[name]).max())
        for name in CHANNELS
    )


def test_through_rigid_soil_as_if_clamped(oc6: ow.Turbine, on_the_ground: xr.Dataset) -> None:
    """One motion through every spring is that of the clamped base, the nearer the stiffer they are."""
    moduli = np.array([1e11, 1e12, 1e13])
    errors = [
        worst(on_base(in_soil(oc6, k), shaking(5.0, 0.02)), on_the_ground) for k in moduli.tolist()
    ]
    assert errors[-1] < 1e-3
    assert fitted_order(1 / moduli, errors) == pytest.approx(1.0, abs=0.1)
    assert worst(on_base(in_soil(oc6, 1e8), shaking(5.0, 0.02)), on_the_ground) > 0.1


def test_through_a_rigid_6x6_as_if_clamped(on_the_ground: xr.Dataset) -> None:
    """The same through coupled springs at the mudline."""
    turbine = turbine_on_pile()
    errors = []
    stiffness = np.array([1e13, 1e14, 1e15])
    for k in stiffness.tolist():
        springs = CoupledSprings(stiffness=(k * np.diag([1, 1, 1, 100, 100, 100])).tolist())
        soil = turbine.soil.model_copy(update={"coupled_springs": springs})
        system = ow.build(
            turbine.model_copy(update={"soil": soil}), "coupled_springs", elements={"tower": 6}
        )
        errors.append(worst(on_base(system, shaking(5.0, 0.02)), on_the_ground))
    assert errors[-1] < 1e-3
    assert fitted_order(1 / stiffness, errors) == pytest.approx(1.0, abs=0.2)


def test_rigid_soil_moves_the_pile_depth_by_depth(oc6: ow.Turbine) -> None:
    """Two levels that rock: a stiff pile in stiff soil leans as the straight line between them."""
    time = 0.02 * np.arange(251)
    swing = np.sin(np.pi * time / 5) ** 2 * np.sin(2 * np.pi * 0.5 * time)
    acceleration = np.zeros((2, len(time), 3))
    acceleration[1, :, 0], acceleration[0, :, 0] = 0.2 * swing, 0.1 * swing
    motion = ow.GroundMotion(time, acceleration, np.array([-40.0, -20.0]))
    system = in_soil(oc6, 1e12)
    data = ow.simulate(
        system,
        5.0,
        0.01,
        ground_motion=motion,
        save_at=ow.SaveAt(heights=[-40.0, -30.0, -20.0], segments=[(-20, 80)]),
    )
    ground = data["ground_displacement"].sel(direction="x").to_numpy()
    expected = np.column_stack([ground[:, 0], ground.mean(axis=1), ground[:, 1]])
    found = data["displacement"].sel(direction="x", height=[-40, -30, -20]).to_numpy()
    assert np.abs(expected).max() > 0.02
    assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()
    assert np.abs(found - expected[:, 1:2]).max() > 0.1 * np.abs(expected).max()


def test_levels_that_agree_are_one(coarse: ow.System) -> None:
    """The same record at three depths is the uniform motion."""
    one = shaking(4.0, 0.02)
    height = np.array([-80.0, -50.0, -20.0])
    three = replace(one, acceleration=np.tile(one.acceleration, (3, 1, 1)), height=height)
    plain, layered = (
        ow.simulate(coarse, 4.0, 0.02, ground_motion=motion) for motion in (one, three)
    )
    for name in ("displacement", "section_moment", "energy_worked"):
        size = np.abs(plain[name]).max()
        assert np.abs(plain[name] - layered[name]).max() < 1e-9 * size


def test_no_motion_is_no_earthquake(coarse: ow.System) -> None:
    """A ground that does not move changes no bit of the structure's motion."""
    still = ow.GroundMotion(np.array([0.0, 5.0]), np.zeros((2, 3)))
    without, with_one = (
        ow.simulate(coarse, 2.0, 0.02, ramp=1.0, ground_motion=motion) for motion in (None, still)
    )
    assert "ground_motion_origin" not in without.attrs
    assert not [name for name in without if str(name).startswith("ground")]
    for name in ("displacement", "section_moment", "energy_balance"):
        assert np.array_equal(without[name], with_one[name])


@pytest.mark.parametrize("foundation", ["clamped", "distributed_springs"])
def test_radau_agrees(undamped: ow.Turbine, foundation: str) -> None:
    """SciPy on Pinocchio's equations, whose ground leans gravity, against generalised-alpha."""
    system = ow.build(undamped, foundation, ow.StillWater(), elements=3)
    corners = np.array([0.0, 0.5, 1.0, 1.5, 3.0])
    record = np.array([[0, 0, 0], [1, -0.5, 0.3], [-2, 1, 0], [0.5, 0, -0.4], [0, 0, 0.0]])
    motion = ow.GroundMotion(corners, record)
    if foundation == "distributed_springs":
        both = np.array([0.8 * record, record])
        motion = ow.GroundMotion(corners, both, np.array([system.chain.base, -20.0]))
    errors = []
    expected = ow.simulate(
        system,
        2.0,
        ground_motion=motion,
        integrator=ow.SciPyIVP("Radau", 1e-7, 1e-9),
        save_at=ow.SaveAt(0.1),
    )
    size = float(np.abs(expected["mudline_moment"]).max())
    steps = [0.02, 0.01, 0.005]
    for dt in steps:
        data = ow.simulate(system, 2.0, dt, ground_motion=motion, save_at=ow.SaveAt(0.1))
        errors.append(float(np.abs(data["mudline_moment"] - expected["mudline_moment"]).max()))
    assert errors[-1] < 5e-3 * size
    assert fitted_order(steps, errors) == pytest.approx(2.0, abs=0.3)


LEDGER_STEPS = np.array([0.02, 0.01, 0.005])


@pytest.fixture(scope="module", params=["clamped", "one motion", "by depth"])
def ledgers(undamped: ow.Turbine, request: pytest.FixtureRequest) -> list[xr.Dataset]:
    """A turbine in still water, with dampers in its joints and its soil, at several steps.

    The record's straight lines end at steps, so that no step has a kink inside.
    """
    foundation = "clamped" if request.param == "clamped" else "distributed_springs"
    system = ow.build(undamped, foundation, ow.StillWater(), elements=8)
    system = system.with_damping(1e-2 * system.joint_stiffness, {})
    motion = shaking(6.0, 0.1, peak=(1.0, 0.6, 0.3), band=(0.2, 1.5))
    if request.param == "by depth":
        both = np.array([0.7 * motion.acceleration, motion.acceleration])
        levels = np.array([system.chain.base, -20.0])
        motion = ow.GroundMotion(motion.time, both, levels, "parabolic")
    return [
        ow.simulate(system, 8.0, dt, ground_motion=motion, save_at=ow.SaveAt(0.1))
        for dt in LEDGER_STEPS.tolist()
    ]


def test_ledger_of_energies_closes(ledgers: list[xr.Dataset]) -> None:
    """With the ground's work, to second order in dt; what it put in was stored or dissipated."""
    finest = ledgers[-1]
    work = finest["energy_worked"].sel(source="ground")
    scale = float(np.abs(work).max())
    errors = [float(np.abs(data["energy_balance"]).max()) for data in ledgers]
    assert errors[-1] < 1e-3 * scale
    assert fitted_order(LEDGER_STEPS, errors) == pytest.approx(2.0, abs=0.3)
    assert float(np.abs(finest["energy_balance"] + work).max()) > 0.5 * scale  # negative control


def test_killed_and_resumed(coarse: ow.System, tmp_path: Path) -> None:
    """An earthquake's run goes on to bitwise the same results; another earthquake is refused."""
    motion = by_depth(coarse)

    def stop(now: float) -> None:
        if now >= 20.0:
            raise KeyboardInterrupt

    def run(folder: Path, given: ow.GroundMotion, progress: object = None) -> xr.Dataset:
        return ow.simulate(
            coarse, 44.0, 0.05, ground_motion=given, directory=folder, progress=progress
        ).load()

    late = motion.later(17.0)
    whole = run(tmp_path / "whole", late)
    with pytest.raises(ow.InterruptedSimulation):
        run(tmp_path / "stopped", late, stop)
    with pytest.raises(ow.InputError, match="other ground motion"):
        run(tmp_path / "stopped", late.scaled(1.0 + 1e-9))
    assert late.height is not None
    with pytest.raises(ow.InputError, match="other ground motion"):
        run(tmp_path / "stopped", replace(late, height=late.height + np.array([0, 0.01, 0])))
    resumed = run(tmp_path / "stopped", late)
    assert resumed.identical(whole)
    assert np.abs(whole["ground_displacement"]).max() > 0.01


def test_statics_and_modes_know_no_earthquake(coarse: ow.System) -> None:
    """A run begins in the static state, whatever the ground will do."""
    data = ow.simulate(coarse, 1.0, 0.05, ground_motion=shaking().later(0.5))
    top = data["tower_top_displacement"].to_numpy()
    assert top[0] == pytest.approx(ow.static(coarse).tower_top_displacement, rel=1e-12)
    assert np.array_equal(data["ground_displacement"][:10], np.zeros((10, 1, 3)))
