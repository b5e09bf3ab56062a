"""Thrust of a running rotor: its curve, its lags, and the damping that it gives."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers.numerics import relative_difference
from helpers.states import random_state
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import offwind_pin as ow
from offwind_pin.analysis.aerodynamic_damping import AerodynamicDamping, aerodynamic_damping
from offwind_pin.base.definition import Array
from offwind_pin.definitions.rotor_disc import RotorDisc, rotor_disc
from offwind_pin.definitions.rotor_nacelle import rotor_apex
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.wind.history import WindHistory, constant_wind
from offwind_pin.loads.wind.rotor_thrust import Control, RotorThrust
from offwind_pin.loads.wind.thrust_table import ThrustTable, induction, inflow_time, thrust_curve
from offwind_pin.verification.checks.motion import decay_after_a_kick

BELOW, ABOVE = 8.5, 14.0
MODES: list[tuple[Control, bool]] = [
    ("instant", False),
    ("lagged", False),
    ("instant", True),
    ("lagged", True),
]


@pytest.fixture(scope="module")
def disc(oc6: ow.Turbine) -> RotorDisc:
    return rotor_disc(oc6)


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    """Clamped, dry, without structural damping, in few elements."""
    return ow.build(undamped, "clamped", elements=8)


def at_hub(
    disc: RotorDisc, velocity: float = 0.0, axis: tuple[float, ...] = (0, 0, 1)
) -> PointMotion:
    """A point on the axis that moves downwind."""
    zero = np.zeros((1, 3))
    return PointMotion(zero, zero, np.array([[velocity, 0.0, 0.0]]), np.array([axis], dtype=float))


@pytest.mark.parametrize("name", ["oc6_phase2", "oc3_phase2"])
def test_curve_runs_through_the_table(name: str) -> None:
    """At the entries the thrust is rho A Ct U^2 / 2; between them nothing overshoots."""
    disc = rotor_disc(ow.load_turbine(name))
    table = disc.rotor.thrust_coefficient
    speed, value = np.array(table.wind_speed), np.array(table.value)
    thrust = thrust_curve(disc, speed)
    assert_allclose(thrust, 0.5 * 1.225 * np.pi * disc.radius**2 * value * speed**2, rtol=1e-12)
    fine = np.linspace(speed[0], speed[-1], 2001)
    coefficient = thrust_curve(disc, fine) / (0.5 * 1.225 * disc.area * fine**2)
    left = np.minimum(np.searchsorted(speed, fine, side="right"), len(speed) - 1)
    low, high = np.sort([value[left - 1], value[left]], axis=0)
    assert np.all((coefficient > low - 1e-12) & (coefficient < high + 1e-12))
    assert abs(speed[np.argmax(thrust)] - disc.rotor.rated_wind_speed) < 0.6


def test_published_thrust(oc6: ow.Turbine) -> None:
    """The sources print the thrust beside its coefficient: 1271.2 kN at 9, 663.0 kN at 20 m/s."""
    thrust = thrust_curve(oc6, np.array([9.0, 20.0]))
    assert_allclose(thrust, [1271.2e3, 663.0e3], rtol=0.02)
    five_megawatt = thrust_curve(ow.load_turbine("oc3_phase2"), np.array([11.3, 20.0]))
    assert_allclose(five_megawatt, [725.25e3, 324.77e3], rtol=2e-3)


def test_induction_meets_momentum_theory() -> None:
    """Ct = 4 a (1 - a) up to 0.96; Buhl's branch goes on without a kink to Ct = 2 at a = 1."""
    for a in (0.05, 0.2, 0.399):
        assert induction(4 * a * (1 - a))[0] == pytest.approx(a, rel=1e-12)
    for part in (0, 1):
        assert induction(0.96 - 1e-12)[part] == pytest.approx(
            induction(0.96 + 1e-12)[part], rel=1e-9
        )
    assert induction(2.0)[0] == pytest.approx(1.0)


def test_thrust_acts_along_the_shaft_through_the_apex(oc6: ow.Turbine, disc: RotorDisc) -> None:
    """The one point on the axis carries what a force at the apex would, moment and all."""
    load = RotorThrust(disc, constant_wind(BELOW))
    apex, shaft = rotor_apex(oc6.rna)
    force = thrust_curve(disc, np.array([BELOW]))[0] * shaft
    assert_allclose(load.steady_load()[:3], force, rtol=1e-12, atol=1e-6)
    assert_allclose(load.steady_load()[3:], np.cross(apex, force), rtol=1e-9, atol=1e-3)
    assert load.height[0] == pytest.approx(oc6.yaw_bearing + oc6.rna.tower_to_shaft)
    at_rest = load.forces(0.0, at_hub(disc), 0.0)
    assert_allclose(at_rest.force[0], force, rtol=1e-12, atol=1e-6)
    assert np.all(at_rest.moment == 0)


def test_thrust_turns_with_the_tower(disc: RotorDisc) -> None:
    """Pitched by an angle, the force is the same one, turned by it."""
    load = RotorThrust(disc, constant_wind(BELOW))
    upright = load.forces(0.0, at_hub(disc), 0.0).force[0]
    angle = 0.05
    tilted = load.forces(0.0, at_hub(disc, axis=(np.sin(angle), 0, np.cos(angle))), 0.0).force[0]
    turn = np.array(
        [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    )
    assert_allclose(tilted, turn @ upright, rtol=1e-12, atol=1e-6)


def first_fore_aft(found: AerodynamicDamping) -> float:
    return float(found.ratio[found.label.index("FA1")])


@pytest.mark.parametrize("wind_speed", [BELOW, ABOVE])
@pytest.mark.parametrize(("control", "lag"), MODES)
def test_free_decay_has_the_linearised_damping(
    system: ow.System, disc: RotorDisc, wind_speed: float, control: Control, lag: bool
) -> None:
    """A small free swing decays, or above rated with an instant controller grows, as told."""
    told = first_fore_aft(aerodynamic_damping(system, wind_speed, control, inflow_lag=lag, count=3))
    thrust = RotorThrust(disc, constant_wind(wind_speed), control, inflow_lag=lag)
    found, frequency = decay_after_a_kick(system, thrust)
    assert found == pytest.approx(told, rel=0.02)
    assert (found < 0) == (wind_speed == ABOVE and control == "instant")
    assert frequency == pytest.approx(0.274, rel=0.02)


def test_a_load_that_knows_no_motion_does_not_damp(system: ow.System, disc: RotorDisc) -> None:
    """Negative control: the same thrust as a prescribed load leaves the swing undamped."""
    steady = RotorThrust(disc, constant_wind(BELOW)).steady_load()
    history = ow.LoadHistory(np.array([0.0, 50.0]), np.array([steady, steady]), "prescribed")
    told = first_fore_aft(aerodynamic_damping(system, BELOW, count=3))

    def prescribed() -> float:
        kick = np.array([[0.0] * 6, [2e4, *[0.0] * 5], [0.0] * 6, [0.0] * 6])
        data = ow.simulate(
            system,
            40.0,
            loads=[history, ow.LoadHistory(np.array([0.0, 0.5, 1.0, 50.0]), kick, "kick")],
            integrator=ow.GeneralizedAlpha(ow.FixedStep(0.02), 1.0),
            save_at=ow.SaveAt(heights=[system.chain.top]),
        )
        x = data["tower_top_displacement"].sel(direction="x").to_numpy()
        x = x - x[0]
        return float(np.ptp(x[-400:]) / np.ptp(x[100:500]))

    assert prescribed() > 0.97
    assert told > 0.05


def test_damping_is_the_slope_of_the_curve(oc6: ow.Turbine, disc: RotorDisc) -> None:
    """Instant: dT/dU of the curve by differences. Lagged, fast: rho A Ct U; slow: the slope again."""
    for speed in (BELOW, ABOVE):
        there, back = thrust_curve(oc6, np.array([speed + 1e-4, speed - 1e-4]))
        slope = (there - back) / 2e-4
        frozen = 2 * thrust_curve(oc6, np.array([speed]))[0] / speed
        instant = RotorThrust(disc, constant_wind(speed), "instant")
        lagged = RotorThrust(disc, constant_wind(speed), "lagged")
        assert instant.response(1.7) == pytest.approx(slope, rel=1e-6)
        assert lagged.response(1e6).real == pytest.approx(frozen, rel=1e-6)
        assert lagged.response(1e-9).real == pytest.approx(slope, rel=1e-6)
        frozen_wake = RotorThrust(disc, constant_wind(speed), inflow_lag=True).response(1e6).real
        a = ThrustTable(disc).induction(speed)[0]
        assert frozen_wake == pytest.approx(frozen / (1 - a), rel=1e-5)


@pytest.mark.parametrize(("control", "lag"), MODES)
def test_lags_follow_their_differential_equations(
    disc: RotorDisc, control: Control, lag: bool
) -> None:
    """In a gust the thrust approaches that of a fine solution of the lags, with order 2 in the step."""
    mean, period = 9.3, 40.0
    count = 4000
    gust = mean + 1.2 * np.sin(2 * np.pi * np.arange(count) / count) ** 3
    load = RotorThrust(disc, WindHistory(period / count, gust, mean, "gust"), control, 3.0, lag)
    table = ThrustTable(disc)
    pressure, slow = 0.5 * 1.225 * disc.area, inflow_time(disc, mean)

    def state(t: float, y: Array) -> tuple[float, float, float]:
        wind = float(load.wind.at(t))
        operating = float(y[0]) if control == "lagged" else wind
        driven = table.induction(operating)[0] * wind
        return wind, operating, driven

    def rate(t: float, y: Array) -> Array:
        wind, _, driven = state(t, y)
        return np.array([(wind - y[0]) / 3.0, (driven - y[1]) / slow])

    start = np.array([mean, table.induction(mean)[0] * mean])
    end = 22.0
    fine = solve_ivp(rate, (0, end), start, rtol=1e-9, atol=1e-9, max_step=0.05)
    wind, operating, driven = state(end, fine.y[:, -1])
    coefficient = table.coefficient(operating)[0]
    a = table.induction(operating)[0]
    induced = fine.y[1, -1] if lag else driven
    exact = pressure * coefficient / (1 - a) ** 2 * (wind - induced) ** 2

    def by_steps(steps: int) -> float:
        memory, still = np.zeros(load.memory_size), at_hub(disc)
        time = np.linspace(0, end, steps + 1)
        for row in load.time_inputs(time, np.ones_like(time))[:-1]:
            load.commit_kernel(still.columns(), load.constants, row, memory)
        force = load.forces(end, still, 1.0, memory).force[0]
        return float(np.linalg.norm(force))

    errors = np.array([abs(by_steps(n) / exact - 1) for n in (110, 220, 440)])
    assert errors[-1] < 1e-4
    if control == "lagged" or lag:
        order = np.log2(errors[:-1] / errors[1:])
        assert_allclose(order, 2.0, atol=0.25)
    quasi = thrust_curve(disc, np.array([wind]))[0]
    assert (abs(quasi / exact - 1) > 0.01) == (control == "lagged" or lag)


def test_zero_memory_is_equilibrium(system: ow.System, disc: RotorDisc) -> None:
    """In a steady wind nothing happens: the memory stays empty and the tower where statics put it."""
    for control, lag in MODES:
        thrust = RotorThrust(disc, constant_wind(BELOW), control, inflow_lag=lag)
        state = ow.static(system, loads=[thrust])
        assert np.max(np.abs(state.memory), initial=0.0) < 1e-9
        data = ow.simulate(
            system, 2.0, 0.05, [thrust], save_at=ow.SaveAt(heights=[system.chain.top])
        )
        x = data["tower_top_displacement"].sel(direction="x").to_numpy()
        assert np.ptp(x) < 1e-7 * abs(x[0])
        prescribed = ow.static(system, thrust.steady_load())
        assert state.tower_top_displacement[0] == pytest.approx(
            prescribed.tower_top_displacement[0], rel=5e-3
        )


def test_only_the_departure_rises(disc: RotorDisc) -> None:
    """At rise 0 the mean wind acts, at 1 the history."""
    load = RotorThrust(disc, WindHistory(1.0, np.array([8.0, 10.0]), 9.0, "two"))
    rows = load.time_inputs(np.array([1.0, 1.0, 1.0]), np.array([0.0, 0.5, 1.0]))
    assert_allclose(rows[:, 1], [9.0, 9.5, 10.0])


def test_a_reversed_wind_pushes_back(disc: RotorDisc) -> None:
    """A hub faster than the wind is pulled upwind."""
    load = RotorThrust(disc, constant_wind(BELOW), "instant")
    assert load.forces(0.0, at_hub(disc, velocity=20.0), 0.0).force[0, 0] < 0


def test_inflow_time(disc: RotorDisc) -> None:
    """1.1 R / ((1 - 1.3 a) U), a third of a minute for the shipped rotor below rated."""
    a = ThrustTable(disc).induction(BELOW)[0]
    assert inflow_time(disc, BELOW) == pytest.approx(1.1 * disc.radius / ((1 - 1.3 * a) * BELOW))
    assert 15 < inflow_time(disc, BELOW) < 30


def test_what_cannot_run_is_refused(oc6: ow.Turbine, disc: RotorDisc) -> None:
    """A wind off the table, a mode that is none, a time that is none, a turbine without a rotor."""
    with pytest.raises(ow.InputError, match="the rotor operates"):
        RotorThrust(disc, constant_wind(30.0))
    with pytest.raises(ow.InputError, match="lagged or instant"):
        RotorThrust(disc, constant_wind(9.0), "fast")  # type: ignore[arg-type]
    with pytest.raises(ow.InputError, match="control_time"):
        RotorThrust(disc, constant_wind(9.0), control_time=0.0)
    with pytest.raises(ow.InputError, match="field rotor"):
        rotor_disc(oc6.model_copy(update={"rotor": None}))
    bare = replace(disc, rotor=disc.rotor.model_copy(update={"rotor_speed": None}))
    with pytest.raises(ow.InputError, match="rotor_speed_rpm"):
        bare.speed(9.0)
    with pytest.raises(ow.InputError, match="wind history"):
        WindHistory(1.0, np.array([np.nan]), 9.0, "nothing")


def in_gusts(system: ow.System, disc: RotorDisc, dt: float) -> tuple[Array, float]:
    """Top displacement along x every 0.4 s in a gusty wind, and what the ledger leaves over."""
    count = 2000
    swing = np.sin(2 * np.pi * np.arange(count) / count)
    wind = WindHistory(20.0 / count, 9.0 + 1.5 * swing**3, 9.0, "gusts")
    thrust = RotorThrust(disc, wind, "lagged", 2.0, inflow_lag=True)
    data = ow.simulate(
        system,
        12.0,
        loads=[thrust],
        save_at=ow.SaveAt(0.4, heights=[system.chain.top]),
        integrator=ow.GeneralizedAlpha(ow.FixedStep(dt), 0.8),
    )
    worked = float(np.max(np.abs(data["energy_worked"])))
    left = float(np.max(np.abs(data["energy_balance"]))) / worked
    return data["tower_top_displacement"].sel(direction="x").to_numpy(), left


def test_motion_in_gusts_converges_with_order_two(system: ow.System, disc: RotorDisc) -> None:
    """The lags do not spoil the integrator's order, and the ledger counts the thrust as work."""
    fine, _ = in_gusts(system, disc, 0.4 / 256)
    runs = [in_gusts(system, disc, 0.4 / n) for n in (8, 16, 32)]
    errors = np.array([np.max(np.abs(x - fine)) for x, _ in runs])
    order = np.polyfit(np.log([1 / 8, 1 / 16, 1 / 32]), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.15)
    left = np.array([rest for _, rest in runs])
    assert left[-1] < 2e-3
    assert np.polyfit(np.log([1 / 8, 1 / 16, 1 / 32]), np.log(left), 1)[0] > 1.5


def test_two_implementations_agree_above_the_top(system: ow.System, disc: RotorDisc) -> None:
    """The last body carries the shaft's crossing rigidly: Pinocchio's equations, its frame and ours."""
    wind = WindHistory(0.5, np.array([9.0, 10.0, 8.0]), 9.0, "three")
    thrust = RotorThrust(disc, wind, "lagged", inflow_lag=True)
    chain, equations = CompiledChain(system, [thrust], ramp_time=0.0), system.equations([thrust])
    bare = CompiledChain(system, [], ramp_time=0.0)
    for seed in range(3):
        state = random_state(system, seed)
        row = chain.time_inputs(np.array([0.7]))[0]
        ours = chain.residual(row, state.q, state.v, state.a).copy()
        theirs = equations.residual(0.7, state.q, state.v, state.a)
        assert relative_difference(ours, theirs) < 1e-11
        none = bare.residual(bare.time_inputs(np.array([0.7]))[0], state.q, state.v, state.a)
        assert relative_difference(ours - none, theirs - none) < 1e-6
        assert np.max(np.abs(ours - none)) > 1e6
        _, damping = equations.tangents(0.7, state.q, state.v, state.a)
        step = 1e-5 * np.random.default_rng(seed).uniform(-1, 1, system.nv)
        there, back = (
            equations.residual(0.7, state.q, state.v + d, state.a) for d in (step, -step)
        )
        assert relative_difference(damping @ step, (there - back) / 2) < 1e-5


def test_loads_far_above_the_top_are_refused(system: ow.System, disc: RotorDisc) -> None:
    """A crossing far above the nacelle is a mistake."""
    far = replace(disc, shaft_height=disc.shaft_height + 50)
    with pytest.raises(ow.InputError, match="rotor_thrust"):
        ow.static(system, loads=[RotorThrust(far, constant_wind(BELOW))])


def test_a_stopped_run_goes_on_to_the_same_results(
    system: ow.System, disc: RotorDisc, tmp_path: Path
) -> None:
    """The lags' memory is part of the state: resumed after 20 s, the run ends bitwise the same."""
    wind = ow.RotorWind(9.0, 0.14, seed=3).generate(disc, repeat_period=40.0)
    thrust = RotorThrust(disc, wind, inflow_lag=True)
    settings = {"ramp": 5.0, "save_at": ow.SaveAt(0.1, heights=[system.chain.top])}

    def stop(time: float) -> None:
        if time < 21:
            raise KeyboardInterrupt

    whole = ow.simulate(system, 40.0, 0.05, [thrust], **settings)  # type: ignore[arg-type]
    with pytest.raises(ow.InterruptedSimulation):
        ow.simulate(
            system,
            40.0,
            0.05,
            [thrust],
            directory=tmp_path,
            progress=stop,
            **settings,  # type: ignore[arg-type]
        )
    rest = ow.simulate(system, 40.0, 0.05, [thrust], directory=tmp_path, **settings)  # type: ignore[arg-type]
    assert np.array_equal(whole["tower_top_displacement"], rest["tower_top_displacement"])
    assert np.array_equal(whole["mudline_moment"], rest["mudline_moment"])
