"""Steps that fail are halved, those that cannot be saved are reported, adaptive ones meet a tolerance."""

import logging
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.own_loads import Fender, NotANumber
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.solvers.steps import AdaptiveStep, FixedStep, StepPolicy

Array = NDArray[np.float64]

END, OUTPUT = 6.0, 0.1


@pytest.fixture(scope="module")
def tower(oc6: ow.Turbine) -> ow.System:
    return ow.build(oc6, "clamped", elements=5)


def loads(system: ow.System) -> list[PointLoad]:
    """A swaying push that drives the top into a fender twice, at 1.2 and at 4.8 s."""
    time = np.linspace(0, END, 1201)
    push = np.zeros((len(time), 6))
    push[:, 0] = 1.5e6 * np.sin(2 * np.pi * 0.25 * time)
    history = ow.LoadHistory(time, push, "sway")
    top = system.chain.top
    return [TowerTopLoad(top, history, np.zeros(6)), Fender(top, "fender")]


def run(
    system: ow.System, policy: StepPolicy, acting: list[PointLoad] | None = None, **more: object
) -> xr.Dataset:
    return ow.simulate(
        system,
        END,
        loads=loads(system) if acting is None else acting,
        save_at=ow.SaveAt(OUTPUT, heights=[0.0]),
        integrator=GeneralizedAlpha(policy),
        **more,  # type: ignore[arg-type]
    )


def steps_per_output(data: xr.Dataset) -> Array:
    """(t - 1,) number of steps between outputs."""
    return np.round(OUTPUT / data["solver_step"].to_numpy()[1:])


def top(data: xr.Dataset) -> Array:
    return data["tower_top_displacement"].sel(direction="x").to_numpy()


def test_halving_goes_through_a_kink(tower: ow.System, caplog: pytest.LogCaptureFixture) -> None:
    """Coarse steps fail where the top meets the fender; halved they pass, and are whole again."""
    with caplog.at_level(logging.WARNING):
        data = run(tower, FixedStep(OUTPUT))
    count = steps_per_output(data)
    halved = np.flatnonzero(count > 1)
    assert data.attrs["status"] == "complete"
    assert set(count[halved]) <= {2, 4, 8, 16}
    assert 2 <= len(halved) <= 10
    assert halved[0] == pytest.approx(12, abs=1)
    assert count[halved[0] - 1] == count[halved[-1] + 1] == 1
    assert "did not converge at t = 1.3 s" in caplog.text


def test_without_halving_it_fails(tower: ow.System) -> None:
    """Negative control: the first of those steps is reported with its time, joint and cause."""
    with pytest.raises(ow.SolverError, match="did not converge") as caught:
        run(tower, FixedStep(OUTPUT, halvings=0))
    error = caught.value
    assert error.time == pytest.approx(1.3)
    assert error.step == 13
    assert error.joint in tower.chain.joint_name
    assert error.residual > 1e6
    assert "t = 1.3 s" in str(error)
    assert error.joint in str(error)


def test_number_of_the_failed_step_is_the_integrator_s(tower: ow.System) -> None:
    """It counts the steps that were taken, whatever ``dt`` stands beside an integrator."""
    integrator = GeneralizedAlpha(FixedStep(OUTPUT, halvings=0))
    with pytest.raises(ow.SolverError) as caught:
        ow.simulate(
            tower,
            END,
            loads=loads(tower),
            save_at=ow.SaveAt(OUTPUT, heights=[0.0]),
            integrator=integrator,
        )
    assert caught.value.time == pytest.approx(1.3)
    assert caught.value.step == 13


def test_results_before_a_failure_are_kept(tower: ow.System) -> None:
    """To the bit those of the run that goes through, up to the last output before the failure."""
    whole = run(tower, FixedStep(OUTPUT))
    with pytest.raises(ow.SolverError) as caught:
        run(tower, FixedStep(OUTPUT, halvings=0))
    kept = caught.value.results
    assert kept.attrs["status"] == "failed"
    assert kept["time"].to_numpy()[-1] == pytest.approx(1.2)
    for name in kept.data_vars:
        there = kept[name].to_numpy()
        assert np.array_equal(there, whole[name].to_numpy()[: len(there)], equal_nan=True), name


@pytest.mark.parametrize("policy", [FixedStep(0.05), AdaptiveStep(1e-5)], ids=["fixed", "adaptive"])
def test_what_no_step_can_mend_is_reported(
    tower: ow.System, policy: StepPolicy, tmp_path: Path
) -> None:
    """A force that is not a number after 1 s ends the run there, however small the steps.

    What came before stands in the file, and the failing step lies just beyond 1 s: the steps were
    halved up to the last.
    """
    with pytest.raises(ow.SolverError, match="not finite") as caught:
        run(tower, policy, [NotANumber(tower.chain.top)], directory=tmp_path)
    error = caught.value
    assert error.time is not None
    assert 1.0 < error.time < 1.005
    assert error.joint in tower.chain.joint_name
    assert np.isfinite(error.residual)
    with xr.open_dataset(tmp_path / "results.nc") as kept:
        assert kept.attrs["status"] == "failed"
        assert kept["time"].to_numpy()[-1] == pytest.approx(1.0)
        assert np.all(np.isfinite(kept["mudline_moment"]))


def test_failed_attempts_leave_no_trace(tower: ow.System) -> None:
    """Given the accepted numbers of steps at once, the same records come out, to the bit."""
    adaptive = AdaptiveStep(1e-5)
    data = run(tower, adaptive)
    counts = steps_per_output(data).astype(int)
    rejected = sum(after > before for before, after in pairwise(counts))
    assert rejected >= 2
    chain = CompiledChain(tower, loads(tower))
    sections = chain.sections(np.array(data["height"]))
    method = GeneralizedAlpha(FixedStep(OUTPUT))
    state = method.begin(chain, ow.static(tower, loads=loads(tower)).q, OUTPUT)
    for i, count in enumerate(counts.tolist(), 1):
        state, records = method.advance(
            chain, sections, state._replace(steps=count), np.array([i * OUTPUT])
        )
        assert np.array_equal(records["displacement"][0, -1], data["displacement"][i, -1])
        assert np.array_equal(records["section_load"][0, :, 3:], data["section_moment"][i])
        assert np.array_equal(records["stored"].sum(), data["energy_stored"][i].sum())


TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7)


@pytest.fixture(scope="module")
def adaptive_runs(tower: ow.System) -> list[xr.Dataset]:
    return [run(tower, AdaptiveStep(tolerance)) for tolerance in TOLERANCES]


@pytest.fixture(scope="module")
def fine(tower: ow.System) -> Array:
    """Top with fixed steps, extrapolated from two fine ones; the outputs are at the same instants."""
    one, half = (top(run(tower, FixedStep(OUTPUT / n))) for n in (512, 1024))
    assert np.abs(half - one).max() < 1e-4
    return half + (half - one) / 3


def test_error_falls_with_the_tolerance(adaptive_runs: list[xr.Dataset], fine: Array) -> None:
    """Through two impacts: each tenth of the tolerance takes more than half of the error away."""
    errors = [np.abs(top(data) - fine).max() for data in adaptive_runs]
    for larger, smaller in pairwise(errors):
        assert smaller < 0.5 * larger
    assert errors[-1] < 1e-3 * np.ptp(fine)


def test_steps_adapt(adaptive_runs: list[xr.Dataset]) -> None:
    """They are finest at the impacts, grow again after them, and fall with the tolerance."""
    totals = []
    for data in adaptive_runs:
        count = steps_per_output(data)
        totals.append(count.sum())
        before, impact, after = count[:11].max(), count[11:14].max(), count[30:46].min()
        assert impact >= 8 * before
        assert impact >= 8 * after
        assert count[47:50].max() >= 8 * after
        assert data.attrs["step_policy"] == "adaptive"
    assert all(more > fewer for fewer, more in pairwise(totals))


def test_adaptive_steps_do_with_fewer(
    tower: ow.System, adaptive_runs: list[xr.Dataset], fine: Array
) -> None:
    """Fixed steps as many as the adaptive ones are off by more."""
    for data in adaptive_runs[1:]:
        per_output = int(np.ceil(steps_per_output(data).mean()))
        fixed = top(run(tower, FixedStep(OUTPUT / per_output)))
        assert np.abs(fixed - fine).max() > 3 * np.abs(top(data) - fine).max()


def test_ledger_closes_through_rejected_steps(adaptive_runs: list[xr.Dataset]) -> None:
    """Nothing of an attempt that was rejected is counted."""
    data = adaptive_runs[-1]
    worked = np.ptp(data["energy_worked"].sum("source").to_numpy())
    assert np.abs(data["energy_balance"]).max() < 1e-3 * worked


def test_smooth_motion_meets_its_tolerance(coarse: ow.System) -> None:
    """In waves, without impacts, the outputs agree with those of fine fixed steps: 1e-9 m or rad of
    local error sum up to 2e-4 of the motion or less, and more to more."""

    def motion(policy: StepPolicy) -> tuple[Array, Array]:
        data = ow.simulate(
            coarse,
            8.0,
            ramp=4.0,
            save_at=ow.SaveAt(0.2, heights=[0.0]),
            integrator=GeneralizedAlpha(policy),
        )
        assert data["time"].to_numpy() == pytest.approx(np.arange(41) * 0.2)
        return top(data), data["mudline_moment"].sel(direction="y").to_numpy()

    exact = motion(FixedStep(0.0005))
    errors = np.array(
        [
            [
                np.abs(found - truth).max() / np.ptp(truth)
                for found, truth in zip(motion(AdaptiveStep(tolerance)), exact, strict=True)
            ]
            for tolerance in (1e-7, 1e-8, 1e-9)
        ]
    )
    assert np.all(errors[1:] < 0.5 * errors[:-1])
    assert np.all(errors[-1] < 2e-4)


def test_tolerance_out_of_reach_is_reported(tower: ow.System) -> None:
    """With a smallest step that the impact does not bear, the run ends there and says why."""
    with pytest.raises(ow.SolverError, match="local error") as caught:
        run(tower, AdaptiveStep(1e-6, smallest=0.005))
    assert caught.value.time == pytest.approx(1.3, abs=0.1001)
    kept = caught.value.results
    assert kept["time"].to_numpy()[-1] == pytest.approx(1.2, abs=0.1001)
    assert np.round(OUTPUT / kept["solver_step"].to_numpy()[1:]).max() <= 20
