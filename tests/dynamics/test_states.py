"""States and chains: copied, pickled, used by two threads, and compiled once for all processes."""

import copy
import os
import pickle
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from helpers.dampers import several
from helpers.point_loads import EveryKind
from helpers.soils import hysteretic
from helpers.states import random_state
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha, MotionState
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.solvers.steps import FixedStep

Array = NDArray[np.float64]

STEP = 0.05


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    """Soil with a memory, tuned mass dampers, waves."""
    waves = ow.IrregularWaves(4.0, 8.0, seed=5, repeat_period=60.0)
    turbine = several(hysteretic(undamped, 6))
    return ow.build(turbine, "distributed_springs", waves, elements=6)


def chain_of(system: ow.System) -> CompiledChain:
    """With a load in Python as well."""
    height = np.linspace(system.chain.base, system.chain.top, 4)
    return CompiledChain(system, [EveryKind(height)], ramp_time=1.0)


def stepped(chain: CompiledChain, state: MotionState, until: float) -> MotionState:
    """Some steps on, recorded at the end."""
    sections = chain.sections(np.array([chain.system.turbine.site.mudline]))
    times = np.arange(round(state.time / STEP) + 1, round(until / STEP) + 1) * STEP
    return GeneralizedAlpha(FixedStep(STEP)).advance(chain, sections, state, times)[0]


def begun(chain: CompiledChain) -> MotionState:
    method = GeneralizedAlpha(FixedStep(STEP))
    return method.begin(chain, np.zeros(chain.system.nv), STEP)


def evaluated(chain: CompiledChain, seed: int) -> tuple[Array, Array]:
    """Residual of a state with the chain's memory, and a solution of its iteration matrix."""
    state = random_state(chain.system, seed, 0.01)
    time_inputs = chain.time_inputs(np.array([0.7]))[0]
    residual = chain.residual(time_inputs, state.q, state.v, state.a)
    chain.factorise(time_inputs, state.q, state.v, state.a, 40.0, 1600.0)
    return residual, chain.correction(residual)


def pickled(chain: CompiledChain) -> CompiledChain:
    twin: CompiledChain = pickle.loads(pickle.dumps(chain))
    return twin


def assert_same(one: MotionState, other: MotionState) -> None:
    for a, b in zip(one, other, strict=True):
        assert np.array_equal(a, b)


@pytest.mark.parametrize("way", ["copy", "deepcopy", "pickle"])
def test_a_copy_goes_on_alike(system: ow.System, way: str) -> None:
    """To the bit, from the middle of a motion; what it does does not touch the original."""
    chain = chain_of(system)
    middle = stepped(chain, begun(chain), 0.5)
    ways = {"copy": copy.copy, "deepcopy": copy.deepcopy, "pickle": pickled}
    twin = ways[way](chain)
    before = chain.state.copy()
    assert np.array_equal(twin.memory, before.memory)
    assert np.any(before.memory)
    after = stepped(twin, middle, 1.0)
    assert np.array_equal(chain.state.q, before.q)
    assert np.array_equal(chain.memory, before.memory)
    assert not np.array_equal(twin.memory, before.memory)
    assert_same(after, stepped(chain, middle, 1.0))


def test_a_state_is_set(system: ow.System) -> None:
    """A pickled state put back undoes what came after it, the memory included."""
    chain = chain_of(system)
    stepped(chain, begun(chain), 0.5)
    kept = pickle.loads(pickle.dumps(chain.state))
    first = evaluated(chain, 1)
    chain.memory = 2 * chain.memory
    assert not np.array_equal(evaluated(chain, 1)[0], first[0])
    chain.state.set(kept)
    assert chain.state.time == kept.time
    assert np.array_equal(chain.state.v, kept.v)
    for found, expected in zip(evaluated(chain, 1), first, strict=True):
        assert np.array_equal(found, expected)


def test_a_state_of_another_system_is_refused(system: ow.System, coarse: ow.System) -> None:
    """Its arrays do not fit."""
    with pytest.raises(ValueError, match="another system"):
        CompiledChain(system).state.set(CompiledChain(coarse).state)


def test_two_threads_give_what_one_gives(system: ow.System) -> None:
    """Each with a chain of its own, at the same time."""
    together = threading.Barrier(2)

    def work(until: float) -> MotionState:
        chain = chain_of(system)
        together.wait()
        return stepped(chain, begun(chain), until)

    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(work, (1.0, 1.5)))
    for state, until in zip(found, (1.0, 1.5), strict=True):
        chain = chain_of(system)
        assert_same(state, stepped(chain, begun(chain), until))


_COMPILED = """
from numba.core import event

names = []

class Listener(event.Listener):
    def on_start(self, happened):
        names.append(happened.data["dispatcher"].py_func.__qualname__)

    def on_end(self, happened):
        pass

event.register("numba:compile", Listener())
import offwind_pin as ow

system = ow.build(ow.load_turbine("oc6_phase2"), "distributed_springs", ow.StillWater(), elements=6)
ow.modes(system, 4)
ow.simulate(system, 0.2, 0.02)
print(len(names), *sorted(set(names)))
"""


def test_a_second_process_compiles_nothing() -> None:
    """All machine code that statics, modes and motion need is found in the cache of the first."""

    def compiled() -> list[str]:
        command = [sys.executable, "-c", _COMPILED]
        done = subprocess.run(command, check=True, capture_output=True, text=True, env=os.environ)
        return done.stdout.split()

    compiled()
    assert compiled() == ["0"]


def test_an_empty_cache_is_seen(tmp_path: str) -> None:
    """Negative control: the listener counts compilations, and few are needed for statics."""
    text = _COMPILED.replace("ow.simulate(system, 0.2, 0.02)", "").replace(
        "ow.modes(system, 4)", ""
    )
    text = text.replace("print", "ow.static(system)\nprint")
    done = subprocess.run(
        [sys.executable, "-c", text],
        check=True,
        capture_output=True,
        text=True,
        env=os.environ | {"XDG_CACHE_HOME": str(tmp_path)},
    )
    names = done.stdout.split()[1:]
    assert {"evaluate", "factorise", "solve", "at_cuts"} <= set(names)
    assert not {"take_note", "tmd_residual", "move_ground", "advance"} & set(names)
