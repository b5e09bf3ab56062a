"""Signal 9 at random moments: whatever was lost, the run goes on to bitwise the same results."""

import multiprocessing
import multiprocessing.process
import os
import random
import shutil
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers import killed_run

from offwind_pin.results.blocks import time_reached

LONGEST_LIFE = 0.4
"""In s; a run that is left alone takes several times that."""


@pytest.fixture(scope="module")
def processes() -> Iterator[multiprocessing.context.ForkServerContext]:
    """Processes made by one that has imported and compiled everything already."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["helpers.warmed_up"])
    helpers = str(Path(killed_run.__file__).parents[1])
    path = os.pathsep.join([helpers, os.environ.get("PYTHONPATH", "")])
    with pytest.MonkeyPatch.context() as patch:
        # The server is started with the first process; Python 3.11 hands it no other path.
        patch.setenv("PYTHONPATH", path)
        yield context


def start(
    processes: multiprocessing.context.ForkServerContext, directory: Path, steps: str
) -> multiprocessing.process.BaseProcess:
    process = processes.Process(target=killed_run.run, args=(directory, steps))
    process.start()
    return process


def contents(directory: Path) -> xr.Dataset:
    with xr.open_dataset(directory / "results.nc") as data:
        return data.load()


@pytest.mark.parametrize(("steps", "kills"), [("fixed", 20), ("adaptive", 10)])
def test_killed_again_and_again(
    processes: multiprocessing.context.ForkServerContext, tmp_path: Path, steps: str, kills: int
) -> None:
    """Each start goes on from the last whole block; should the run be through before it was killed
    so often, it begins once more."""
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    killed_run.run(whole, steps)
    expected = contents(whole)
    moments = random.Random(8)
    done, reached = 0, []
    while True:
        process = start(processes, stopped, steps)
        if done < kills:
            process.join(moments.uniform(0.0, LONGEST_LIFE))
            if process.is_alive():
                process.kill()
                process.join()
                assert process.exitcode == -9
                done += 1
                reached.append(time_reached(stopped))
                continue
        process.join()
        assert process.exitcode == 0
        found = contents(stopped)
        assert found.identical(expected)
        for name in (n for n in expected.variables if expected[n].dtype.kind not in "OU"):
            assert found[name].to_numpy().tobytes() == expected[name].to_numpy().tobytes()
        if done == kills:
            break
        shutil.rmtree(stopped)
    assert expected.attrs["status"] == "complete"
    assert expected["time"].to_numpy()[-1] == pytest.approx(killed_run.DURATION)
    # Not vacuous: kills came at many different times of the run, and most left blocks behind.
    assert len(set(reached)) >= kills // 3
    assert np.count_nonzero(reached) >= kills // 2
    assert not (stopped / "blocks").exists()
