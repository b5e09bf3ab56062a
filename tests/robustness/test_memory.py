"""Memory does not grow with the duration of a run that is given a directory."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import xarray as xr
from helpers import memory_of_a_run

ALLOWED = 300e6


def run(duration: float, folder: Path) -> tuple[int, int]:
    """Peak memory of a fresh process, and what all its results would take in memory, in bytes."""
    script = str(Path(memory_of_a_run.__file__))
    done = subprocess.run(
        [sys.executable, script, str(duration), str(folder)],
        capture_output=True,
        text=True,
        check=True,
    )
    peak, size = done.stdout.split()
    return int(peak), int(size)


def test_three_hours_take_what_ten_minutes_do(tmp_path: Path) -> None:
    """Within 300 MB of one another, while the results of three hours are larger than that."""
    short, _ = run(600.0, tmp_path / "short")
    long, results = run(10800.0, tmp_path / "long")
    assert results > ALLOWED
    assert short > 50e6
    assert long - short < ALLOWED
    with xr.open_dataset(tmp_path / "long" / "results.nc") as data:
        assert data["time"].to_numpy()[-1] == 10800.0
        assert len(data["time"]) == 108001
        assert np.all(np.diff(data["time"]) > 0)
