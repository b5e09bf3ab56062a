"""A case that is killed in any phase, or runs out of room, continues to bitwise the same results.

The events at which a process is killed are drawn from a seed, not from a clock.
"""

import json
import multiprocessing
import os
import random
import signal
from collections.abc import Iterator
from multiprocessing.context import BaseContext, ForkServerContext
from pathlib import Path
from typing import Any

import pytest
import xarray as xr
from helpers import killed_case

from offwind_pin.results.manifest import read_manifest

FILES = {"manifest.json", "results.nc", "summary.json", "report.html"}
OF_THE_RUN = ("wall_s", "realtime_factor", "resumed_at_s")
"""Keys that differ between two runs of a case."""


@pytest.fixture(scope="module")
def processes() -> Iterator[ForkServerContext]:
    """Processes forked from one that has run the case already."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["helpers.warmed_up_case"])
    helpers = str(Path(killed_case.__file__).parents[1])
    with pytest.MonkeyPatch.context() as patch:
        path = os.pathsep.join([helpers, os.environ.get("PYTHONPATH", "")])
        patch.setenv("PYTHONPATH", path)
        yield context


@pytest.fixture(scope="module")
def whole(
    processes: ForkServerContext, tmp_path_factory: pytest.TempPathFactory
) -> tuple[Path, int]:
    """Results of the case left alone, and the number of its events."""
    out = tmp_path_factory.mktemp("whole") / "out"
    counted = processes.SimpleQueue()
    assert start(processes, killed_case.run_and_count, out, counted) == 0
    return out, int(counted.get())


def start(processes: BaseContext, target: Any, *arguments: object) -> int:
    process: Any = processes.Process(target=target, args=arguments)  # type: ignore[attr-defined]
    process.start()
    process.join()
    assert process.exitcode is not None
    return process.exitcode


def same(one: Path, other: Path) -> bool:
    """Files, summary, and every variable and attribute to the bit."""
    summaries = [json.loads((out / "summary.json").read_text()) for out in (one, other)]
    for found in summaries:
        for key in OF_THE_RUN:
            found.pop(key, None)
    if summaries[0] != summaries[1]:
        return False
    with xr.open_datatree(one / "results.nc") as a, xr.open_datatree(other / "results.nc") as b:
        for tree in (a, b):
            for key in OF_THE_RUN:
                tree["case"].attrs.pop(key, None)
        # The inventory, one of these attributes, has the hash of the bytes of every variable.
        return bool(a.identical(b)) and "inventory" in a["case"].attrs


def phase(out: Path) -> str:
    """How far a killed run is."""
    manifest = read_manifest(out) if out.exists() else None
    if manifest is None:
        return "before the first block"
    if manifest.state != "running":
        return manifest.state
    return "results" if manifest.files else f"{len(manifest.blocks or ())} blocks"


@pytest.mark.seeded
def test_killed_in_any_phase(
    processes: ForkServerContext, whole: tuple[Path, int], tmp_path: Path, campaign_seed: int
) -> None:
    """Killed again and again, then left alone."""
    expected, events = whole
    out = tmp_path / "out"
    draw = random.Random(campaign_seed)
    reached = []
    for _ in range(4):  # most events come after the simulation, and most file operations in it
        last = draw.randint(1, 25)
        code = start(processes, killed_case.run_and_die_at_a_file, out, last)
        assert code == -signal.SIGKILL
        reached.append(phase(out))
    for _ in range(2):
        # A run that resumes has fewer events than a whole one, so that it may not be killed.
        code = start(processes, killed_case.run_and_die, out, draw.randint(1, events))
        assert code in (0, -signal.SIGKILL)
        reached.append(phase(out))
    assert start(processes, killed_case.run, out) == 0
    assert {path.name for path in out.iterdir()} == FILES
    assert same(out, expected)
    # Negative control: they were killed at different stages.
    assert len(set(reached)) > 1


@pytest.mark.seeded
def test_out_of_room(
    processes: ForkServerContext, whole: tuple[Path, int], tmp_path: Path, campaign_seed: int
) -> None:
    """With room for files up to a size: exit code 1, and a resume once there is more."""
    expected, _ = whole
    sizes = sorted(path.stat().st_size for path in expected.iterdir())
    draw = random.Random(campaign_seed)
    limits = [100, sizes[0], draw.randint(1, sizes[-1]), sizes[-1] - 1]
    codes = []
    for limit in sorted(limits):
        out = tmp_path / "out"
        codes.append(start(processes, killed_case.run_in_little_room, out, limit))
        assert codes[-1] == 1
        assert not (out / "summary.json").exists()
        assert not list(out.glob(".*.nc"))
    assert start(processes, killed_case.run, out) == 0
    assert {path.name for path in out.iterdir()} == FILES
    assert same(out, expected)


@pytest.mark.seeded
def test_killed_while_compiling(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, campaign_seed: int
) -> None:
    """What is left of compiled code does no harm: killed with an empty cache, then left alone."""
    if campaign_seed == 1:
        pytest.skip("compiles everything twice; make soak runs it")
    processes = multiprocessing.get_context("spawn")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "whole cache"))
    expected, out, counted = tmp_path / "whole", tmp_path / "out", processes.SimpleQueue()
    static = killed_case.STATIC
    assert start(processes, killed_case.run_and_count, expected, counted, static) == 0
    events = int(counted.get())
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    draw = random.Random(campaign_seed)
    for _ in range(3):
        code = start(processes, killed_case.run_and_die, out, draw.randint(1, events), static)
        assert code in (0, -signal.SIGKILL)
    assert start(processes, killed_case.run, out, static) == 0
    assert same(out, expected)
