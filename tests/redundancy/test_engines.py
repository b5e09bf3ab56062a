"""The two engines against each other: statics, modes, and motion in time."""

import itertools
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from helpers.dampers import several
from helpers.earthquakes import by_depth
from helpers.numerics import relative_difference
from helpers.own_loads import HardeningRestraint, MyMistakeError, Raises
from helpers.soils import hysteretic
from helpers.states import random_state
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.engine import Engine
from offwind_pin.definitions.reader import shipped_turbines
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.reference.section_loads import section_loads

Array = NDArray[np.float64]

ENGINES: tuple[Engine, ...] = ("compiled", "pinocchio")

LOAD = np.array([1e6, 2e5, -1e5, 3e6, 2e7, 1e6])
"""At the yaw bearing in N and N m."""

WAVES = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)

ROUNDING = {"solver_residual", "segment_imbalance"}
"""Channels that are zero but for rounding."""


def difference(one: xr.Dataset, other: xr.Dataset) -> float:
    """Largest over all channels, of each over its own peak."""
    found = 0.0
    for name in set(one.data_vars) - ROUNDING:
        a, b = one[name].to_numpy(), other[name].to_numpy()
        if a.dtype.kind == "f":
            finite = np.isfinite(b)
            assert np.array_equal(np.isfinite(a), finite)
            peak = np.max(np.abs(b[finite]), initial=0.0)
            off = np.max(np.abs(a[finite] - b[finite]), initial=0.0)
            found = max(found, float(off / peak) if peak > 0 else float(off))
    return found


@pytest.mark.parametrize("foundation", FOUNDATIONS)
def test_static_states(undamped: ow.Turbine, foundation: str) -> None:
    """Displacements, section loads and memory under gravity and all six loads at the tower top."""
    system = ow.build(undamped, foundation, ow.StillWater(), elements=9)
    one, other = (ow.static(system, LOAD, engine=name) for name in ENGINES)
    assert (one.engine, other.engine) == ("compiled", "pinocchio")
    for name in ("q", "displacement", "rotation", "section_load"):
        assert relative_difference(getattr(other, name), getattr(one, name)) < 1e-9
    assert one.memory == pytest.approx(other.memory, rel=1e-9, abs=1e-15)
    assert one.iterations == other.iterations


def test_another_load_is_another_static_state(undamped: ow.Turbine) -> None:
    """Negative control: a load that is a millionth larger makes more than the tolerance."""
    system = ow.build(undamped, "clamped", elements=9)
    one = ow.static(system, LOAD)
    other = ow.static(system, (1 + 1e-6) * LOAD, engine="pinocchio")
    assert relative_difference(other.displacement, one.displacement) > 1e-8


def test_static_states_one_after_another(undamped: ow.Turbine) -> None:
    """Hysteretic soil remembers a load that acted before, with either engine."""
    system = ow.build(hysteretic(undamped, 6), "distributed_springs", elements=7)
    left = []
    for engine in ENGINES:
        loaded = ow.static(system, 2 * LOAD, engine=engine)
        left.append(ow.static(system, after=loaded, engine=engine))
    assert relative_difference(left[1].displacement, left[0].displacement) < 1e-9
    fresh = ow.static(system, engine="pinocchio")
    assert relative_difference(left[1].displacement, fresh.displacement) > 1e-3


def test_an_unstable_state_is_refused(undamped: ow.Turbine) -> None:
    """A weight at the tower top beyond the buckling load, by both engines."""
    system = ow.build(undamped, "clamped", elements=6)
    for engine in ENGINES:
        with pytest.raises(ow.SolverError, match=r"unstable|no static equilibrium"):
            ow.static(system, np.array([0, 0, -1e9, 0, 0, 0]), engine=engine)


def test_section_loads_in_motion(in_waves: ow.System, any_system: ow.System) -> None:
    """From Pinocchio's joint forces as from the compiled recursion, in a state far from rest."""
    state = random_state(any_system)
    time = np.array([3.0])
    chain = CompiledChain(in_waves)
    height = np.union1d(in_waves.chain.boundary, in_waves.chain.joint_height)
    record = chain.record(
        chain.sections(height), chain.time_inputs(time)[0], state.q, state.v, state.a
    )
    found = section_loads(in_waves.equations(), time[0], state.q, state.v, state.a, height)
    expected = record.section_load[0]
    for part in (slice(0, 3), slice(3, 6)):
        assert relative_difference(found[:, part], expected[:, part]) < 1e-11


@pytest.mark.parametrize(
    ("turbine", "foundation", "element"),
    [
        *itertools.product(shipped_turbines(), ["distributed_springs"], ["euler_bernoulli"]),
        ("oc6_phase2", "coupled_springs", "timoshenko"),
        ("oc6_phase2 with dampers", "distributed_springs", "euler_bernoulli"),
        ("oc6_phase2 with dampers", "clamped", "timoshenko"),
    ],
)
def test_modes(turbine: str, foundation: str, element: Element) -> None:
    """Frequencies, damping ratios, labels and shapes."""
    name, _, dampers = turbine.partition(" with ")
    definition = ow.load_turbine(name)
    if dampers:
        definition = several(definition)
    system = ow.build(definition, foundation, ow.StillWater(), elements=20, element=element)
    one, other = (ow.modes(system, 10, engine=engine) for engine in ENGINES)
    assert (one.engine, other.engine) == ("compiled", "pinocchio")
    assert one.label == other.label
    assert_allclose(other.frequency_hz, one.frequency_hz, rtol=1e-8)
    assert_allclose(other.damping_ratio, one.damping_ratio, rtol=1e-6, atol=1e-12)
    assert_allclose(other.shape_peak_height_ratio, one.shape_peak_height_ratio, atol=1e-6)
    mass = system.equations((), np.inf).mass(ow.static(system).q)
    product = np.sum(one.vector * (mass @ other.vector), axis=0)
    assert_allclose(product, 1.0, atol=1e-8)


def _in_waves(undamped: ow.Turbine, oc6: ow.Turbine) -> ow.System:
    return ow.build(oc6, "distributed_springs", WAVES, elements=7)


def _hysteretic(undamped: ow.Turbine, oc6: ow.Turbine) -> ow.System:
    return ow.build(hysteretic(undamped, 6), "distributed_springs", WAVES, elements=7)


def _macro_element(undamped: ow.Turbine, oc6: ow.Turbine) -> ow.System:
    return ow.build(undamped, "macro_element", ow.StillWater(), elements=6, element="timoshenko")


def _with_dampers(undamped: ow.Turbine, oc6: ow.Turbine) -> ow.System:
    return ow.build(several(undamped), "clamped", WAVES, elements=6)


def _own_restraint(undamped: ow.Turbine, oc6: ow.Turbine) -> ow.System:
    system = ow.build(undamped, "coupled_springs", elements=4)
    stiffness = np.array([6e9, 6e9, 1.1e10, 4e11, 4e11, 2.5e11])
    root = HardeningRestraint(stiffness, 0.02 * stiffness, scale=1e-3)
    return replace(system, foundation=replace(system.foundation, root=root))


Make = Callable[[ow.Turbine, ow.Turbine], ow.System]
MOVING: list[tuple[Make, bool, bool]] = [
    (_in_waves, False, False),
    (_in_waves, True, False),
    (_in_waves, False, True),
    (_hysteretic, False, False),
    (_hysteretic, True, True),
    (_macro_element, False, False),
    (_with_dampers, False, True),
    (_own_restraint, False, False),
]


def push(duration: float) -> ow.LoadHistory:
    """A push that takes the soil past its first yielding, all six components."""
    time = np.linspace(0.0, duration, 401)
    swell = np.sin(np.pi * time / duration) ** 2
    return ow.LoadHistory(time, np.outer(swell, 3 * LOAD), "push")


def move(system: ow.System, engine: Engine, **more: Any) -> xr.Dataset:
    """Two seconds with tolerances so small that both engines find the same solution."""
    settings: dict[str, Any] = {
        "integrator": ow.GeneralizedAlpha(ow.FixedStep(0.02), 0.9, 1e-12, 1e-13)
    }
    settings |= more
    return ow.simulate(
        system, 2.0, loads=[push(2.0)], ramp=0.5, save_at=ow.SaveAt(0.1), engine=engine, **settings
    )


@pytest.mark.parametrize(("make", "shaken", "adaptive"), MOVING)
def test_motion(
    undamped: ow.Turbine, oc6: ow.Turbine, make: Make, *, shaken: bool, adaptive: bool
) -> None:
    """Every channel, the energies included."""
    system = make(undamped, oc6)
    more: dict[str, Any] = {}
    if shaken:
        more["ground_motion"] = by_depth(system)
    if adaptive:
        policy = ow.AdaptiveStep(1e-6, largest=0.05)
        more["integrator"] = ow.GeneralizedAlpha(policy, 0.9, 1e-12, 1e-13)
    one, other = (move(system, engine, **more) for engine in ENGINES)
    assert (one.attrs["engine"], other.attrs["engine"]) == ("compiled", "pinocchio")
    assert np.abs(one["acceleration"]).max() > 0.1
    assert one["solver_step"].equals(other["solver_step"])
    assert difference(other, one) < 1e-7


def test_another_motion_is_seen(undamped: ow.Turbine, oc6: ow.Turbine) -> None:
    """Negative control: a spectral radius that is 1e-4 smaller makes more than the tolerance."""
    system = _with_dampers(undamped, oc6)
    other = ow.GeneralizedAlpha(ow.FixedStep(0.02), 0.8999, 1e-12, 1e-13)
    one, changed = move(system, "compiled"), move(system, "pinocchio", integrator=other)
    assert difference(changed, one) > 1e-6


class _Stopped(Exception):
    """Raised in the middle of a run."""


def test_a_stopped_run_goes_on(undamped: ow.Turbine, tmp_path: Path) -> None:
    """From its last block to bitwise the same results; the other engine does not continue it."""
    system = ow.build(hysteretic(undamped, 4), "distributed_springs", elements=4)
    load = push(42.0)

    def run(folder: str, engine: Engine, progress: Callable[[float], None]) -> xr.Dataset:
        return ow.simulate(
            system,
            42.0,
            0.2,
            [load],
            engine=engine,
            directory=tmp_path / folder,
            progress=progress,
        )

    def stop(now: float) -> None:
        raise _Stopped

    with pytest.raises(_Stopped):
        run("stopped", "pinocchio", stop)
    with pytest.raises(ow.InputError, match="engine"):
        run("stopped", "compiled", stop)
    resumed: list[float] = []
    whole: list[float] = []
    data = run("stopped", "pinocchio", resumed.append)
    assert data.equals(run("whole", "pinocchio", whole.append))
    assert (resumed, whole) == ([40.0, 42.0], [20.0, 40.0, 42.0])


def test_a_user_s_exception_arrives_as_it_is(undamped: ow.Turbine) -> None:
    """With its own type, in statics and in motion."""
    system = ow.build(undamped, "clamped", elements=2)
    for after in (0.5, -1.0):
        with pytest.raises(MyMistakeError):
            ow.simulate(
                system, 2.0, 0.05, [Raises(system.chain.top, after=after)], engine="pinocchio"
            )


def test_a_step_that_cannot_converge(undamped: ow.Turbine) -> None:
    """It fails with the time and the joint, as with compiled code."""
    system = ow.build(undamped, "clamped", elements=3)
    integrator = ow.GeneralizedAlpha(ow.FixedStep(0.1, halvings=1), 0.9, 1e-30, 1e-30)
    for engine in ENGINES:
        with pytest.raises(ow.SolverError, match="did not converge") as failed:
            ow.simulate(system, 1.0, loads=[push(1.0)], integrator=integrator, engine=engine)
        assert failed.value.time is not None
        assert 0 < failed.value.time <= 0.1
        assert failed.value.joint in system.chain.joint_name


@pytest.mark.parametrize("solve", [ow.static, ow.modes, lambda s, **k: ow.simulate(s, 1.0, **k)])
def test_unknown_engines(undamped: ow.Turbine, solve: Callable[..., object]) -> None:
    """They are refused by name."""
    system = ow.build(undamped, "clamped", elements=2)
    with pytest.raises(ow.InputError, match=r"'mujoco'.*compiled, pinocchio"):
        solve(system, engine="mujoco")


def test_scipy_takes_pinocchio_s_equations(undamped: ow.Turbine) -> None:
    """It is its default engine; the compiled one is refused."""
    system = ow.build(undamped, "clamped", elements=2)
    integrator = ow.SciPyIVP("LSODA", 1e-6, 1e-8)
    settings: dict[str, Any] = {"integrator": integrator, "save_at": ow.SaveAt(0.1)}
    data = ow.simulate(system, 0.2, **settings)
    assert data.attrs["engine"] == "pinocchio"
    with pytest.raises(ow.InputError, match="pinocchio with SciPyIVP"):
        ow.simulate(system, 0.2, engine="compiled", **settings)


def test_pinocchio_s_statics_and_modes_do_without_the_compiled_chain(
    undamped: ow.Turbine, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing of it is made."""

    def made(*arguments: object) -> None:
        raise AssertionError("a compiled chain was made")

    monkeypatch.setattr(CompiledChain, "__init__", made)
    system = ow.build(undamped, "coupled_springs", ow.StillWater(), elements=5)
    state = ow.static(system, LOAD, engine="pinocchio")
    assert ow.modes(system, 3, state, engine="pinocchio").label[0] == "SS1"
    with pytest.raises(AssertionError):
        ow.static(system)


def test_the_commands_take_an_engine(offwind: Callable[..., tuple[int, str, str]]) -> None:
    """Both print the engine and, to rounding, the same numbers; another name is refused."""
    for command, shown in (("static", "tower_top_x_m"), ("modes", "modes")):
        printed = []
        for engine in ENGINES:
            code, out, _ = offwind(
                command, "oc6_phase2", "--foundation", "clamped", "--elements", "5",
                "--engine", engine, "--json",
            )  # fmt: skip
            assert code == 0
            printed.append(json.loads(out))
            assert printed[-1]["engine"] == engine
        one, other = (result[shown] for result in printed)
        if command == "modes":
            one, other = ([mode["frequency_hz"] for mode in result] for result in (one, other))
        assert other == pytest.approx(one, rel=1e-9)
        code, _, err = offwind(command, "oc6_phase2", "--engine", "mujoco")
        assert code == 2
        assert all(name in err for name in ("mujoco", "compiled", "pinocchio"))


CASE = """
name: engines
turbine: oc6_phase2
foundation: clamped
sea: {kind: dry}
analysis: {kind: modes, count: 2, engine: ENGINE}
elements: 5
"""


def test_a_case_takes_an_engine(
    offwind: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    """The results say which; another name is refused with those allowed."""
    case = tmp_path / "case.yaml"
    case.write_text(CASE.replace("ENGINE", "pinocchio"))
    code, _, err = offwind("run", str(case), "--out", str(tmp_path / "out"))
    assert (code, err) == (0, "")
    with xr.open_dataset(tmp_path / "out" / "results.nc") as data:
        assert data.attrs["engine"] == "pinocchio"
    case.write_text(CASE.replace("ENGINE", "mujoco"))
    code, _, err = offwind("run", str(case), "--out", str(tmp_path / "other"))
    assert code == 2
    assert all(name in err for name in ("engine", "mujoco", "compiled", "pinocchio"))
