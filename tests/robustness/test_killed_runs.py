"""A run that is killed again and again continues to bitwise the same results.

The process ends itself at a seeded random file operation. No clock decides, so that every kill
strikes on a machine of any speed and load.
"""

import multiprocessing
import os
import random
import shutil
import signal
from collections.abc import Callable, Iterator
from multiprocessing.context import ForkServerContext
from pathlib import Path

import pytest
import xarray as xr
from helpers import killed_run

from offwind_pin.results.manifest import BLOCKS, read_manifest

SMALLEST_FILE = 1000
"""Bytes; every block is larger, so that a limit below this is passed at the next write."""

REMOVALS = 15
"""Fewer than the blocks of a run, so that so many operations from its end results are complete."""


@pytest.fixture(scope="module")
def processes() -> Iterator[ForkServerContext]:
    """Processes forked from one that has imported and compiled everything already."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["helpers.warmed_up"])
    helpers = str(Path(killed_run.__file__).parents[1])
    path = os.pathsep.join([helpers, os.environ.get("PYTHONPATH", "")])
    with pytest.MonkeyPatch.context() as patch:
        # The server starts with the first process; Python 3.11 gives it no other path.
        patch.setenv("PYTHONPATH", path)
        yield context


def contents(directory: Path) -> xr.Dataset:
    with xr.open_dataset(directory / "results.nc") as data:
        return data.load()


def time_reached(directory: Path) -> float:
    manifest = read_manifest(directory)
    return manifest.blocks[-1].end_s if manifest and manifest.blocks else 0.0


def start(processes: ForkServerContext, target: Callable[..., None], *arguments: object) -> int:
    """Exit code of a function run in a process of its own."""
    process = processes.Process(target=target, args=arguments)
    process.start()
    process.join()
    assert process.exitcode is not None
    return process.exitcode


def operations(processes: ForkServerContext, directory: Path, steps: str) -> int:
    """Number of file operations of a run that is left alone."""
    counted = processes.SimpleQueue()
    assert start(processes, killed_run.run_and_count, directory, steps, counted) == 0
    return int(counted.get())


@pytest.mark.seeded
@pytest.mark.parametrize(("steps", "kills"), [("fixed", 12), ("adaptive", 6)])
def test_killed_again_and_again(
    processes: ForkServerContext, tmp_path: Path, campaign_seed: int, steps: str, kills: int
) -> None:
    """Each start continues after the last whole block. Every other kill strikes inside a write."""
    whole, stopped, copy = (tmp_path / name for name in ("whole", "stopped", "copy"))
    left = operations(processes, whole, steps)
    expected = contents(whole)
    assert expected.attrs["status"] == "complete"
    assert expected["time"].to_numpy()[-1] == killed_run.DURATION

    draw = random.Random(campaign_seed)
    reached = []
    for kill in range(kills):
        # A share of what is left, so that the run is not complete before the last kill.
        last = draw.randint(1, max(1, left // 4))
        limit = draw.randint(1, SMALLEST_FILE) if kill % 2 else 0
        code = start(processes, killed_run.run_and_die, stopped, steps, last, limit)
        assert code == -(signal.SIGXFSZ if limit else signal.SIGKILL)
        left -= last + 1
        reached.append(time_reached(stopped))
    # Negative control: the kills struck at many different times of the run.
    assert len(set(reached)) >= kills // 3

    # Results are complete; blocks are being removed, the newest first.
    shutil.copytree(stopped, copy)
    count = operations(processes, copy, steps)
    last = count - draw.randint(0, REMOVALS)
    assert start(processes, killed_run.run_and_die, stopped, steps, last, 0) == -signal.SIGKILL
    assert (stopped / "results.nc").exists()
    assert (stopped / BLOCKS).exists()

    assert start(processes, killed_run.run, stopped, steps) == 0
    found = contents(stopped)
    assert found.identical(expected)
    for name in (n for n in expected.variables if expected[n].dtype.kind not in "OU"):
        assert found[name].to_numpy().tobytes() == expected[name].to_numpy().tobytes()
    assert {path.name for path in stopped.iterdir()} == {"results.nc", "manifest.json"}
