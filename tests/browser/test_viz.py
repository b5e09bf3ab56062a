"""The scripts in viz/ show a scene that moves, from 127.0.0.1 alone."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from helpers.pages import PATIENCE, Visit, changed_share, drawn_share, picture, wait_for_change
from selenium import webdriver

import offwind_pin as ow
from offwind_pin.base.whole_files import write_netcdf

pytestmark = pytest.mark.browser

VIZ = Path(__file__).resolve().parents[2] / "viz"

Script = Callable[..., str]


@pytest.fixture
def script() -> Iterator[Script]:
    """Start a script of viz/ without a browser of its own; returns the address that it prints."""
    started: list[subprocess.Popen[str]] = []

    def start(name: str, *arguments: str) -> str:
        process = subprocess.Popen(
            [sys.executable, VIZ / name, *arguments, "--no-browser"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        started.append(process)
        assert process.stdout is not None
        line = process.stdout.readline()
        assert line, process.communicate()[1]
        return line.partition(" ")[0]

    yield start
    for process in started:
        process.send_signal(signal.SIGINT)
        _, complaints = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0
        assert "Traceback" not in complaints


def check_moving(driver: webdriver.Chrome, url: str) -> None:
    """The page loads from this computer only, draws its scene, and the scene changes in time."""
    assert urlsplit(url).hostname == "127.0.0.1"
    visit = Visit(driver, url)
    driver.execute_script("player.playing = false")
    driver.execute_script("player.show(0.0)")
    first = picture(driver)
    assert drawn_share(first) > 0.02
    assert changed_share(first, picture(driver)) < 1e-4  # negative control: at rest nothing moves
    driver.execute_script("player.show(1.1)")
    assert changed_share(first, picture(driver)) > 1e-3
    driver.execute_script("player.playing = true")
    wait_for_change(driver)
    visit.collect()
    assert visit.errors == []
    assert visit.places() <= {"http:127.0.0.1", "data:", "blob:"}


def test_mode_shapes(driver: webdriver.Chrome, script: Script) -> None:
    url = script("mode_shapes.py", "oc6_phase2", "--foundation", "clamped", "--modes", "fa1,t1")
    check_moving(driver, url)
    shown = driver.execute_script("return player.shown.map(mode => modes.label[mode])")
    assert shown == ["FA1", "T1"]


def test_time_history(
    driver: webdriver.Chrome, script: Script, undamped: ow.Turbine, tmp_path: Path
) -> None:
    """Results of waves on a coarse structure, from the file that a run would write."""
    system = ow.build(undamped, "clamped", ow.RegularWaves(6.0, 8.0), elements=6)
    write_netcdf(
        tmp_path / "results.nc", ow.simulate(system, 6.0, 0.05, ramp=1.0, save_at=ow.SaveAt(0.2))
    )
    check_moving(driver, script("time_history.py", str(tmp_path), "--start", "1"))
