"""Simulations at once, in threads and in processes: each gives to the bit what it gives alone."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from threading import Barrier

import numpy as np
import pytest
import xarray as xr
from helpers.at_once import ENGINES, move
from helpers.dampers import several
from helpers.soils import hysteretic

import offwind_pin as ow
from offwind_pin.definitions.engine import Engine

SIZES = (1.0, 1.5)
"""Of the loads of the two simulations."""


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    """Soil with a memory, tuned mass dampers and waves; shared by the threads."""
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    return ow.build(several(hysteretic(undamped, 4)), "distributed_springs", waves, elements=5)


@pytest.fixture(scope="module")
def alone(system: ow.System) -> dict[tuple[Engine, float], xr.Dataset]:
    """One after the other."""
    return {(engine, size): move(system, engine, size) for engine in ENGINES for size in SIZES}


def same(one: xr.Dataset, other: xr.Dataset) -> bool:
    """To the bit, coordinates and attributes included."""
    numbers = [name for name in one.variables if one[name].dtype.kind not in "OU"]
    return one.identical(other) and all(
        one[name].to_numpy().tobytes() == other[name].to_numpy().tobytes() for name in numbers
    )


@pytest.mark.parametrize("engine", ENGINES)
def test_two_threads(
    system: ow.System, alone: dict[tuple[Engine, float], xr.Dataset], engine: Engine
) -> None:
    """On one system, begun at the same moment."""
    together = Barrier(2)

    def work(size: float) -> xr.Dataset:
        together.wait()
        return move(system, engine, size)

    with ThreadPoolExecutor(2) as pool:
        for size, found in zip(SIZES, pool.map(work, SIZES), strict=True):
            assert same(found, alone[engine, size])


def test_two_processes(system: ow.System, alone: dict[tuple[Engine, float], xr.Dataset]) -> None:
    """Each is handed the system, and hands back its results."""
    runs = [(engine, size) for size in SIZES for engine in ENGINES]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        tasks = {run: pool.submit(move, system, *run) for run in runs}
        for run, task in tasks.items():
            assert same(task.result(), alone[run])


@pytest.mark.parametrize("other", ENGINES)
def test_another_load_is_seen(alone: dict[tuple[Engine, float], xr.Dataset], other: Engine) -> None:
    """Negative control: neither the other load nor the last digit of a channel passes."""
    one = alone[other, SIZES[0]]
    assert not same(one, alone[other, SIZES[1]])
    assert np.any(one["acceleration"] != 0)
    assert not same(one, one.assign(acceleration=np.nextafter(one["acceleration"], np.inf)))
