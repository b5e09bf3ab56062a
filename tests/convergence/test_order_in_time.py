"""Order in dt of the compiled generalised-alpha on the chain, through ``simulate``."""

from collections.abc import Callable

import numpy as np
import pytest
from helpers.first_order import compiled_backward_euler
from helpers.numerics import fitted_order
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.solvers import generalized_alpha
from offwind_pin.solvers.steps import FixedStep

Array = NDArray[np.float64]

STEPS = np.array([0.04, 0.02, 0.01, 0.005])
FINE, FINEST = 0.0025, 0.00125
"""The reference is extrapolated from these two, a hundredth of the smallest error away at most."""
END, RAMP, OUTPUT = 8.0, 4.0, 0.2

SYSTEMS: dict[str, Callable[[ow.Turbine], ow.System]] = {
    "clamped, dry": lambda turbine: ow.build(turbine, "clamped", elements=8),
    "distributed springs, wet": lambda turbine: ow.build(
        turbine,
        "distributed_springs",
        ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0),
        elements=10,
    ),
}


def smooth_load(system: ow.System) -> TowerTopLoad:
    """All directions at once, rising and falling smoothly; its start is the static state's load.

    A history is linear between samples. Here every end of a step, where alone the integrator looks
    at the load, is a sample, whatever the step.
    """
    time = np.arange(round(END / FINEST) + 1) * FINEST
    swell = (1 - np.cos(2 * np.pi * time / END)) / 2
    load = np.zeros((len(time), 6))
    load[:, 0] = 5e5 + 1e6 * swell * np.sin(2 * np.pi * 0.4 * time)
    load[:, 1] = 4e5 * swell * np.sin(2 * np.pi * 0.7 * time)
    load[:, 3] = 1e7 * swell
    load[:, 4] = 1e7 * swell * np.cos(2 * time)
    load[:, 5] = 5e6 * swell * np.sin(5 * time)
    return TowerTopLoad(system.chain.top, ow.LoadHistory(time, load, "smooth"), load[0])


def channels(system: ow.System, integrator: GeneralizedAlpha) -> list[Array]:
    """Mudline moment and tower-top displacement over time, both (t, 3)."""
    data = ow.simulate(
        system,
        END,
        loads=[smooth_load(system)],
        ramp=RAMP,
        save_at=ow.SaveAt(OUTPUT, heights=[0.0]),
        integrator=integrator,
    )
    return [data[name].to_numpy() for name in ("mudline_moment", "tower_top_displacement")]


def tight(dt: float, radius: float) -> GeneralizedAlpha:
    return GeneralizedAlpha(FixedStep(dt), radius, 1e-11, 1e-12)


def reference(system: ow.System, radius: float) -> list[Array]:
    """Channels extrapolated from two fine steps."""
    fine, finest = (channels(system, tight(dt, radius)) for dt in (FINE, FINEST))
    return [b + (b - a) / 3 for a, b in zip(fine, finest, strict=True)]


def errors_by_step(
    system: ow.System, exact: list[Array], scheme: Callable[[float], GeneralizedAlpha]
) -> list[Array]:
    """Of each channel, the largest error at outputs over the largest value, for each step size."""
    found = [channels(system, scheme(dt)) for dt in STEPS.tolist()]
    return [
        np.array([np.abs(run[i] - truth).max() / np.abs(truth).max() for run in found])
        for i, truth in enumerate(exact)
    ]


@pytest.fixture(scope="module", params=SYSTEMS)
def system(oc6: ow.Turbine, request: pytest.FixtureRequest) -> ow.System:
    return SYSTEMS[request.param](oc6)


@pytest.mark.parametrize("radius", [1.0, 0.9])
def test_order_two(system: ow.System, radius: float) -> None:
    """Mudline moment and tower-top displacement converge with the square of the step."""
    exact = reference(system, radius)
    for error in errors_by_step(system, exact, lambda dt: tight(dt, radius)):
        assert fitted_order(STEPS, error) == pytest.approx(2.0, abs=0.1)
        assert 1e-6 < error[-1] < 1e-3


def test_default_tolerances_keep_the_order(system: ow.System) -> None:
    """What Newton's iteration leaves by default is small beside the error of the steps tried."""
    exact = reference(system, 0.9)
    default = errors_by_step(system, exact, lambda dt: GeneralizedAlpha(FixedStep(dt), 0.9))
    for error in default:
        assert fitted_order(STEPS, error) == pytest.approx(2.0, abs=0.1)


def test_a_first_order_scheme_is_seen(system: ow.System, monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: by backward Euler the same channels converge with the step itself."""
    exact = reference(system, 1.0)
    monkeypatch.setattr(generalized_alpha, "compiled_advance", compiled_backward_euler)
    for error in errors_by_step(system, exact, lambda dt: tight(dt, 1.0)):
        assert fitted_order(STEPS, error) == pytest.approx(0.95, abs=0.1)
        assert 0.01 < error[-1] < 0.1
