"""Results written as they come: the same as in memory, and the same after a stop."""

import hashlib
import json
import uuid
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.own_loads import FromHistory, HardeningRestraint

import offwind_pin as ow
from offwind_pin.analysis.integrators import Integrator
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.results.manifest import BLOCKS, MANIFEST, read_manifest

DURATION, OUTPUT = 90.0, 0.5
"""Four blocks of 20 s and a half one."""
SAVED = ow.SaveAt(OUTPUT, heights=[0.0, 50.0])

INTEGRATORS: dict[str, Integrator] = {
    "fixed": ow.GeneralizedAlpha(ow.FixedStep(0.05)),
    "adaptive": ow.GeneralizedAlpha(ow.AdaptiveStep(1e-6)),
}
FIXED_AND_ADAPTIVE = pytest.mark.parametrize("method", ["fixed", "adaptive"])


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=120.0)
    return ow.build(undamped, "distributed_springs", waves, elements=4)


def history(size: float = 1.0) -> ow.LoadHistory:
    time = np.linspace(0, DURATION, 901)
    load = np.zeros((len(time), 6))
    load[:, 0] = size * (5e5 + 2e5 * np.sin(time) * np.sin(0.3 * time))
    return ow.LoadHistory(time, load, "wind")


def run(
    system: ow.System, method: str, directory: Path | None = None, **changed: object
) -> xr.Dataset:
    settings: dict[str, object] = {
        "duration": DURATION,
        "loads": [history()],
        "ramp": 10.0,
        "integrator": INTEGRATORS[method],
        "save_at": SAVED,
        "directory": directory,
    }
    return ow.simulate(system, **(settings | changed))  # type: ignore[arg-type]


def names(directory: Path) -> set[str]:
    return {path.name for path in directory.iterdir()}


def time_reached(directory: Path) -> float:
    manifest = read_manifest(directory)
    return manifest.blocks[-1].end_s if manifest and manifest.blocks else 0.0


def stop_at(time: float) -> Callable[[float], None]:
    """What ``progress`` may do when the user interrupts."""

    def progress(now: float) -> None:
        if now >= time:
            raise KeyboardInterrupt

    return progress


def same(one: xr.Dataset, other: xr.Dataset) -> bool:
    """To the bit, attributes and coordinates included."""
    numbers = [name for name in one.variables if one[name].dtype.kind not in "OU"]
    return one.identical(other) and all(
        one[name].to_numpy().tobytes() == other[name].to_numpy().tobytes() for name in numbers
    )


def contents(directory: Path) -> xr.Dataset:
    with xr.open_dataset(directory / "results.nc") as data:
        return data.load()


@FIXED_AND_ADAPTIVE
def test_file_holds_what_memory_would(system: ow.System, tmp_path: Path, method: str) -> None:
    """Channels of one height in full; those over all heights, and over segments, as 32-bit numbers."""
    memory, file = run(system, method), run(system, method, tmp_path)
    assert memory.attrs == file.attrs
    assert set(memory.variables) == set(file.variables)
    for name, channel in memory.variables.items():
        expected = channel.to_numpy()
        if channel.ndim == 3:
            assert file[name].dtype == np.float32
            expected = expected.astype(np.float32)
        assert np.array_equal(file[name].to_numpy(), expected, equal_nan=expected.dtype.kind == "f")
    assert len(file["time"]) == round(DURATION / OUTPUT) + 1
    assert names(tmp_path) == {"results.nc", "manifest.json"}
    file.close()


@pytest.mark.parametrize("method", INTEGRATORS)
@pytest.mark.parametrize("time", [0.0, 60.0, 90.0])
def test_interrupted_and_resumed(
    system: ow.System, tmp_path: Path, method: str, time: float
) -> None:
    """Stopped at the end of any block, the run says where, keeps what it has, and goes on."""
    run(system, method, tmp_path / "whole").close()
    with pytest.raises(ow.InterruptedSimulation) as stopped:
        run(system, method, tmp_path / "stopped", progress=stop_at(time))
    reached = max(20.0, time)
    whole = contents(tmp_path / "whole")
    kept = stopped.value.results
    assert stopped.value.time == kept["time"].to_numpy()[-1] == time_reached(tmp_path / "stopped")
    assert stopped.value.time == pytest.approx(reached)
    assert kept.attrs["status"] == "interrupted"
    before = whole.isel(time=slice(0, len(kept["time"]))).assign_attrs(status="interrupted")
    assert same(kept.load(), before)
    kept.close()
    seen: list[float] = []
    run(system, method, tmp_path / "stopped", progress=seen.append).close()
    assert all(now > reached for now in seen)
    assert same(contents(tmp_path / "stopped"), whole)


def test_no_cache_outlives_a_block(system: ow.System, tmp_path: Path) -> None:
    """Steps at distances that repeat themselves but for rounding: nothing is kept of those before.

    Blocks of 15 times 128 steps, that is of whole portions in which waves are computed.
    """
    settings: dict[str, object] = {
        "duration": 18.0,
        "ramp": 1.0,
        "save_at": SAVED.replace(output_dt=0.3),
        "integrator": ow.GeneralizedAlpha(ow.FixedStep(0.3 / 128)),
    }
    run(system, "fixed", tmp_path / "whole", **settings).close()
    with pytest.raises(ow.InterruptedSimulation) as stopped:
        run(system, "fixed", tmp_path / "stopped", progress=stop_at(9.0), **settings)
    stopped.value.results.close()
    assert stopped.value.time == pytest.approx(9.0)
    run(system, "fixed", tmp_path / "stopped", **settings).close()
    assert same(contents(tmp_path / "stopped"), contents(tmp_path / "whole"))


def test_interrupted_many_times(system: ow.System, tmp_path: Path) -> None:
    """After every block: a run in five pieces is that in one."""
    run(system, "fixed", tmp_path / "whole").close()
    for reached in (20.0, 40.0, 60.0, 80.0, 90.0):
        with pytest.raises(ow.InterruptedSimulation) as stopped:
            run(system, "fixed", tmp_path / "stopped", progress=stop_at(0.0))
        stopped.value.results.close()
        assert stopped.value.time == pytest.approx(reached)
    run(system, "fixed", tmp_path / "stopped").close()
    assert same(contents(tmp_path / "stopped"), contents(tmp_path / "whole"))


def test_a_lost_state_is_seen(system: ow.System, tmp_path: Path) -> None:
    """The block is refused. Negative control of the comparisons: were a block's state off in the last digit, the results would not be the
    same."""
    run(system, "fixed", tmp_path / "whole").close()
    with pytest.raises(ow.InterruptedSimulation) as stopped:
        run(system, "fixed", tmp_path / "stopped", progress=stop_at(40.0))
    stopped.value.results.close()
    last = sorted((tmp_path / "stopped" / BLOCKS).glob("block_*.npz"))[-1]
    with np.load(last) as file:
        block = dict(file)
    block["state_vectors"] = np.nextafter(block["state_vectors"], np.inf)
    np.savez(last, **block)
    with pytest.raises(ow.InputError, match=last.name):
        run(system, "fixed", tmp_path / "stopped")
    accept(tmp_path / "stopped", last)
    run(system, "fixed", tmp_path / "stopped").close()
    assert not same(contents(tmp_path / "stopped"), contents(tmp_path / "whole"))


def accept(directory: Path, block: Path) -> None:
    """Write the checksum of a changed block into the manifest."""
    path = directory / MANIFEST
    manifest = json.loads(path.read_text())
    manifest["blocks"][-1]["sha256"] = hashlib.sha256(block.read_bytes()).hexdigest()
    path.write_text(json.dumps(manifest))


def interrupted(system: ow.System, directory: Path, **changed: object) -> None:
    with pytest.raises(ow.InterruptedSimulation) as stopped:
        run(system, "fixed", directory, progress=stop_at(20.0), **changed)
    stopped.value.results.close()


CHANGES: dict[str, tuple[dict[str, object], str]] = {
    "step": ({"integrator": ow.GeneralizedAlpha(ow.FixedStep(0.025))}, "dt_s"),
    "damping": ({"integrator": ow.GeneralizedAlpha(ow.FixedStep(0.05), 0.5)}, "spectral_radius"),
    "integrator": ({"integrator": INTEGRATORS["adaptive"]}, "step_policy"),
    "duration": ({"duration": 80.0}, "duration_s"),
    "ramp": ({"ramp": 5.0}, "ramp_s"),
    "output": ({"save_at": SAVED.replace(output_dt=0.25)}, "output_dt_s"),
    "load": ({"loads": [history(1 + 1e-12)]}, "load 4 tower_top"),
    "no load": ({"loads": []}, "tower_top_load_origin"),
    "heights": ({"save_at": SAVED.replace(heights=[0.0, 50.5])}, "recorded heights"),
    "channels": ({"save_at": SAVED.replace(channels=["mudline_moment"])}, "channels"),
    "segments": ({"save_at": SAVED.replace(segments=[(-75.0, 0.0)])}, "recorded heights"),
    "provenance": ({"provenance": {"case": "another"}}, "case"),
}


@pytest.mark.parametrize("changed", CHANGES)
def test_other_settings_are_refused(system: ow.System, tmp_path: Path, changed: str) -> None:
    """A folder of another run's blocks is not taken for one's own; what differs is named."""
    interrupted(system, tmp_path)
    blocks = sorted((tmp_path / BLOCKS).iterdir())
    settings, name = CHANGES[changed]
    with pytest.raises(
        ow.InputError, match=rf"another simulation \(other [^)]*\b{name}\b"
    ) as refused:
        run(system, "fixed", tmp_path, **settings)
    assert "overwrite" in str(refused.value)
    assert sorted((tmp_path / BLOCKS).iterdir()) == blocks


def test_other_systems_are_refused(system: ow.System, tmp_path: Path) -> None:
    """Seed of the waves, elements, damping, foundation."""
    interrupted(system, tmp_path)
    sea = system.sea
    assert isinstance(sea, ow.IrregularWaves)
    others = {
        "wave_seed": replace(system, sea=sea.replace(seed=4)),
        "elements": ow.build(system.turbine, "distributed_springs", sea, elements=5),
        "element": ow.build(
            system.turbine, "distributed_springs", sea, elements=4, element="timoshenko"
        ),
        "foundation": ow.build(system.turbine, "coupled_springs", sea, elements=4),
        "structure": system.with_damping(1e-9 * system.joint_stiffness, {}),
    }
    for name, other in others.items():
        with pytest.raises(ow.InputError, match=rf"another simulation \(other [^)]*\b{name}\b"):
            run(other, "fixed", tmp_path)


def test_a_short_gust_is_seen(system: ow.System, tmp_path: Path) -> None:
    """Two winds that differ for a second only are not taken for one another."""

    def drag(gust_start: float) -> list[object]:
        gust = ow.ExtremeOperatingGust(5.0, start=gust_start, period=1.0)
        wind = ow.TowerWind(10.0, 90.0, ow.PowerLaw(0.14), 0.7, gust=gust)
        return [ow.tower_drag(system, wind)]

    with pytest.raises(ow.InterruptedSimulation):
        run(system, "fixed", tmp_path, loads=drag(61.0), progress=stop_at(40.0))
    with pytest.raises(ow.InputError, match="another simulation"):
        run(system, "fixed", tmp_path, loads=drag(62.5))


@pytest.mark.parametrize(
    "text",
    [b"", b"{", b'{"duration_s": 90', b"[]", b"null", b"\x00\x01", b"{}", b"\xff\xfe"],
    ids=repr,
)
def test_a_damaged_manifest_is_refused(system: ow.System, tmp_path: Path, text: bytes) -> None:
    interrupted(system, tmp_path)
    (tmp_path / MANIFEST).write_bytes(text)
    with pytest.raises(ow.InputError, match=r"manifest\.json"):
        run(system, "fixed", tmp_path)


def test_the_undamaged_manifest_is_taken(system: ow.System, tmp_path: Path) -> None:
    """Negative control: with other blanks and order it is the same run."""
    interrupted(system, tmp_path)
    manifest = tmp_path / MANIFEST
    data = json.loads(manifest.read_text())
    manifest.write_text(json.dumps(dict(reversed(data.items()))))
    run(system, "fixed", tmp_path).close()
    assert contents(tmp_path).attrs["status"] == "complete"


def test_nothing_is_left_beside_the_results(system: ow.System, tmp_path: Path) -> None:
    """Half-written files of a killed run are gone once its results stand."""
    interrupted(system, tmp_path)
    left = uuid.uuid4().hex
    (tmp_path / BLOCKS / f".block_000002.{left}.npz").write_bytes(b"half a block")
    (tmp_path / f".results.{left}.nc").write_bytes(b"half")
    run(system, "fixed", tmp_path).close()
    assert names(tmp_path) == {"results.nc", "manifest.json"}


def test_own_loads_and_restraints_resume(undamped: ow.Turbine, tmp_path: Path) -> None:
    """What is written in Python is no other thing the second time."""
    bare = ow.build(undamped, "coupled_springs", elements=3)
    stiffness = np.array([6e9, 6e9, 1.1e10, 4e11, 4e11, 2.5e11])
    root = HardeningRestraint(stiffness, 0.02 * stiffness)
    system = replace(bare, foundation=replace(bare.foundation, root=root))
    load = FromHistory(system.chain.top, "own", history(), history().load[0])
    settings: dict[str, object] = {"loads": [load], "save_at": SAVED.replace(heights=[0.0])}
    run(system, "fixed", tmp_path / "whole", **settings).close()
    interrupted(system, tmp_path / "stopped", **settings)
    run(system, "fixed", tmp_path / "stopped", **settings).close()
    assert same(contents(tmp_path / "stopped"), contents(tmp_path / "whole"))


def test_failed_run_with_a_directory(system: ow.System, tmp_path: Path) -> None:
    """Called again after a failure it fails again at the same place, having done only the rest."""
    time = np.array([0.0, 50.0, 50.01, 90.0])
    load = np.zeros((4, 6))
    load[2:, 0] = 1e10
    blow = TowerTopLoad(system.chain.top, ow.LoadHistory(time, load, "blow"), np.zeros(6))
    integrator = ow.GeneralizedAlpha(ow.FixedStep(0.05, halvings=0))
    seen: list[list[float]] = [[], []]
    times = []
    for progress in seen:
        with pytest.raises(ow.SolverError) as failed:
            run(
                system,
                "fixed",
                tmp_path,
                loads=[blow],
                integrator=integrator,
                progress=progress.append,
            )
        assert failed.value.results.attrs["status"] == "failed"
        times.append((failed.value.time, failed.value.results["time"].to_numpy()[-1]))
        failed.value.results.close()
    assert times[0] == times[1]
    assert 50.0 < times[0][0] < 90.0
    assert seen == [[20.0, 40.0], []]


def test_a_damaged_block_is_named(system: ow.System, tmp_path: Path) -> None:
    """Cut short by something else than a kill."""
    interrupted(system, tmp_path)
    block = sorted((tmp_path / BLOCKS).glob("block_*.npz"))[-1]
    block.write_bytes(block.read_bytes()[:100])
    with pytest.raises(ow.InputError, match=block.name):
        run(system, "fixed", tmp_path)
