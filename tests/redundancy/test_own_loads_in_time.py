"""Loads and restraints written in Python, in statics and in motion."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.own_loads import Fender, FromHistory, HardeningRestraint, MyMistakeError, Raises
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import Integrator, SciPyIVP
from offwind_pin.loads.point_load import PointForces, PointLoad
from offwind_pin.loads.tower_top.load_history import TowerTopLoad

Array = NDArray[np.float64]

END = 4.0


def history() -> ow.LoadHistory:
    time = np.linspace(0, 60, 1201)
    shape = np.sin(np.outer(2 * time, [1.0, 1.3, 0.7, 1.1, 0.9, 1.7]))
    load = [5e5, 0, 0, 0, 0, 0] + shape * [1e6, 5e5, 2e5, 5e6, 1e7, 5e6]
    return ow.LoadHistory(time, load, "all six")


MEAN = np.array([5e5, 1e5, 0, 0, 1e6, 0])


def largest_difference(one: xr.Dataset, other: xr.Dataset) -> float:
    """Over all channels of numbers, relative to each channel's largest value."""
    found = 0.0
    for name in one.data_vars:
        a, b = one[name].to_numpy(), other[name].to_numpy()
        scale = np.nanmax(np.abs(b))
        if name not in {"tower_top_load", "solver_residual"} and scale > 0:
            found = max(found, float(np.nanmax(np.abs(a - b)) / scale))
    return found


def run(system: ow.System, load: PointLoad, **more: object) -> xr.Dataset:
    return ow.simulate(system, END, 0.05, [load], ramp=1.0, **more)  # type: ignore[arg-type]


def test_python_and_compiled_load_are_one(coarse: ow.System) -> None:
    """The same history, given as a mean and a departure that rises, in waves and on soil.

    The ledger and the start included: in statics only the mean acts.
    """
    top = coarse.chain.top
    compiled = run(coarse, TowerTopLoad(top, history(), MEAN, "own"))
    in_python = run(coarse, FromHistory(top, "own", history(), MEAN))
    assert largest_difference(in_python, compiled) < 1e-13
    # tower_top_load shows what acts as a tower-top load, which the Python one is not declared to be
    assert np.ptp(compiled["energy_worked"].sel(source="own").to_numpy()) > 1e4


def test_another_load_is_seen(coarse: ow.System) -> None:
    """Negative control: a mean that is one newton in a million off makes a difference."""
    top = coarse.chain.top
    compiled = run(coarse, TowerTopLoad(top, history(), MEAN, "own"))
    in_python = run(coarse, FromHistory(top, "own", history(), (1 + 1e-6) * MEAN))
    assert largest_difference(in_python, compiled) > 1e-9


def test_statics_of_an_own_load(coarse: ow.System) -> None:
    """Its mean acts in full, as a tower-top load of that size does."""
    top = coarse.chain.top
    own = ow.static(coarse, loads=[FromHistory(top, "own", history(), MEAN)])
    assert own.q == pytest.approx(ow.static(coarse, MEAN).q, rel=1e-12, abs=1e-15)


@pytest.fixture(scope="module")
def small(undamped: ow.Turbine) -> ow.System:
    return ow.build(undamped, "clamped", elements=2)


def push(system: ow.System) -> TowerTopLoad:
    """A push on and off."""
    time = np.linspace(0, 2, 201)
    load = np.zeros((len(time), 6))
    load[:, 0] = 1e6 * np.sin(np.pi * time / 2) ** 2
    return TowerTopLoad(system.chain.top, ow.LoadHistory(time, load, "push"), np.zeros(6))


def errors_by_step(system: ow.System, loads: list[PointLoad]) -> list[float]:
    """Mudline moment's difference from Radau's over its largest, at dt = 0.01 and 0.005 s."""

    def moment(dt: float, integrator: Integrator | None = None) -> Array:
        method = integrator or ow.GeneralizedAlpha(ow.FixedStep(dt))
        data = ow.simulate(system, 2.0, loads=loads, save_at=ow.SaveAt(0.1), integrator=method)
        return data["mudline_moment"].to_numpy()

    exact = moment(0.01, SciPyIVP("Radau", 1e-8, 1e-10))
    return [float(np.abs(moment(dt) - exact).max() / np.abs(exact).max()) for dt in (0.01, 0.005)]


def test_motion_against_a_soft_fender(small: ow.System) -> None:
    """A load that depends on the motion, by both integrators: they meet with the square of dt."""
    fender = Fender(small.chain.top, "fender", gap=-0.15, depth=0.1, force=3e5)
    free, stopped = (
        ow.simulate(small, 2.0, 0.01, [push(small), *more])["tower_top_displacement"].to_numpy()
        for more in ([], [fender])
    )
    assert np.abs(free - stopped).max() > 0.05
    coarse, fine = errors_by_step(small, [push(small), fender])
    assert fine < 1e-4
    assert coarse / fine == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize(
    "load",
    [
        lambda top: Raises(top),
        lambda top: Raises(top, after=0.0, in_tangents=True),
        lambda top: Raises(top, after=-1.0),
        lambda top: Raises(top, after=-1.0, in_tangents=True),
    ],
    ids=["forces", "tangents", "forces in statics", "tangents in statics"],
)
def test_a_user_s_exception_arrives_as_it_is(
    small: ow.System, load: Callable[[float], PointLoad]
) -> None:
    """Through compiled code, with its own type and message; and it leaves the system as it was."""
    before = ow.simulate(small, 2.0, 0.05, [push(small)])
    with pytest.raises(MyMistakeError, match=r"at -?[\d.]+ s"):
        ow.simulate(small, 2.0, 0.05, [load(small.chain.top)])
    after = ow.simulate(small, 2.0, 0.05, [push(small)])
    assert after.identical(before)


def test_a_user_s_exception_in_adaptive_steps(small: ow.System) -> None:
    """It is no step that failed and might be mended by smaller ones."""
    integrator = ow.GeneralizedAlpha(ow.AdaptiveStep(1e-5))
    with pytest.raises(MyMistakeError):
        ow.simulate(
            small,
            2.0,
            loads=[Raises(small.chain.top)],
            integrator=integrator,
            save_at=ow.SaveAt(0.05),
        )


def test_results_before_a_user_s_exception_stay(
    small: ow.System, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What was written before stands; with the mistake mended the same call goes on from there."""
    load = Raises(small.chain.top, after=45.0)

    def run(folder: str, reached: list[float]) -> xr.Dataset:
        return ow.simulate(
            small,
            60.0,
            0.05,
            [load],
            save_at=ow.SaveAt(0.5),
            directory=tmp_path / folder,
            progress=reached.append,
        )

    first, second, third = [], [], []
    with pytest.raises(MyMistakeError):
        run("stopped", first)
    monkeypatch.setattr(Raises, "forces", lambda *_: PointForces(*np.full((2, 1, 3), 1e5)))
    mended, whole = run("stopped", second), run("whole", third)
    assert (first, second, third) == ([20.0, 40.0], [60.0], [20.0, 40.0, 60.0])
    assert mended["time"].equals(whole["time"])


@pytest.fixture(scope="module")
def hardening(undamped: ow.Turbine) -> ow.System:
    """Two elements on six springs that stiffen, with dashpots."""
    system = ow.build(undamped, "coupled_springs", elements=2)
    stiffness = np.array([6e9, 6e9, 1.1e10, 4e11, 4e11, 2.5e11])
    root = HardeningRestraint(stiffness, 0.02 * stiffness, scale=1e-3)
    return replace(system, foundation=replace(system.foundation, root=root))


def test_statics_of_an_own_restraint(hardening: ow.System) -> None:
    """It takes up what the base carries, and is stiffer under more load."""
    root = hardening.foundation.root
    assert root is not None
    turned = []
    for thrust in (0.5e6, 1e6, 2e6):
        state = ow.static(hardening, np.array([thrust, 0, 0, 0, 0, 0]))
        reaction = root.reaction(state.q[:6], np.zeros(6))
        assert reaction[0] == pytest.approx(state.mudline_load[0], rel=1e-6)
        assert reaction[4] == pytest.approx(state.mudline_load[4], rel=1e-3)
        turned.append(state.q[4])
    assert turned[2] - turned[1] < 1.8 * (turned[1] - turned[0])


def test_motion_on_an_own_restraint(hardening: ow.System) -> None:
    """By both integrators, one through compiled code and one through Pinocchio's equations."""
    coarse, fine = errors_by_step(hardening, [push(hardening)])
    assert fine < 1e-3
    assert coarse / fine == pytest.approx(4.0, rel=0.1)


def test_a_linear_restraint_is_something_else(hardening: ow.System) -> None:
    """Negative control: without the hardening the moment differs by more than the steps do."""
    root = hardening.foundation.root
    assert isinstance(root, HardeningRestraint)
    linear = replace(
        hardening, foundation=replace(hardening.foundation, root=replace(root, scale=1e9))
    )
    moments = [
        ow.simulate(system, 2.0, 0.02, [push(system)])["mudline_moment"].to_numpy()
        for system in (hardening, linear)
    ]
    assert np.abs(moments[0] - moments[1]).max() > 0.01 * np.abs(moments[0]).max()
