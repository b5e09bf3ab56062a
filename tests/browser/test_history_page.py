"""The page of a time history in a real browser: structure and sea move as the results say."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.pages import Visit, changed_share, drawn_share, picture, time_after_frames, wait
from numpy.testing import assert_allclose
from selenium import webdriver
from selenium.webdriver.common.by import By

import offwind_pin as ow
from offwind_pin.display.viewer.history_frames import Frames, frames
from offwind_pin.display.viewer.history_page import render_time_history

pytestmark = pytest.mark.browser

START, DURATION, LEVEL = 5.0, 15.0, 1.5


@pytest.fixture(scope="module")
def results(undamped: ow.Turbine) -> xr.Dataset:
    """A regular wave that travels along 60 degrees at a high water level."""
    sea = ow.RegularWaves(6.0, 8.0, direction_deg=60.0, water_level=LEVEL)
    system = ow.build(undamped, "coupled_springs", sea, elements=6)
    return ow.simulate(system, 20.0, 0.05, ramp=4.0, save_at=ow.SaveAt(0.1))


@pytest.fixture(scope="module")
def shown(results: xr.Dataset) -> Frames:
    return frames(results, START, DURATION)


@pytest.fixture(scope="module")
def page(results: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("history") / "history.html"
    path.write_text(render_time_history(results, START, DURATION), encoding="utf-8")
    return path


def at(driver: webdriver.Chrome, now: float) -> None:
    """Stop at a time in s from the start."""
    driver.execute_script("player.playing = false; showAt(arguments[0])", now)


def vertices(driver: webdriver.Chrome, *path: str) -> np.ndarray:
    found = driver.execute_script(
        "return Array.from(player.mesh(...arguments[0]).geometry.attributes.position.array)", path
    )
    return np.reshape(found, (-1, 3))


def test_opens_without_errors_or_requests(driver: webdriver.Chrome, page: Path) -> None:
    """From file:// the page works, and asks for nothing but itself and data it holds."""
    visit = Visit(driver, page.as_uri())
    at(driver, 3.0)
    assert drawn_share(picture(driver)) > 0.02
    visit.collect()
    assert visit.errors == []
    assert page.as_uri() in visit.requested
    assert visit.places() <= {"file:", "data:", "blob:"}


def test_sea_is_where_the_waves_put_it(driver: webdriver.Chrome, page: Path, shown: Frames) -> None:
    """All points of the surface, at a frame and between two, and the rim of the sides."""
    Visit(driver, page.as_uri())
    assert shown.sea is not None
    for place, expected in ((20, shown.sea[20]), (20.5, (shown.sea[20] + shown.sea[21]) / 2)):
        at(driver, place * float(shown.time[1] - shown.time[0]))
        points = vertices(driver, "sea", "surface").reshape(len(shown.x), len(shown.y), 3)
        assert_allclose(points[..., 2], LEVEL + expected, rtol=0, atol=2e-3)
        assert_allclose(points[:, 0, 0], shown.x, atol=1e-4)
        assert_allclose(points[0, :, 1], shown.y, atol=1e-4)
    sides = vertices(driver, "sea", "sides")
    rim = sides[: len(sides) // 2]
    corner = points[0, 0]
    assert_allclose(rim[0], corner, atol=1e-4)
    assert np.ptp(rim[:, 2]) > 2.0
    assert_allclose(sides[len(rim) :, 2], -30.0)


def test_structure_is_where_the_results_put_it(
    driver: webdriver.Chrome, page: Path, shown: Frames
) -> None:
    """The top ring moves with the yaw bearing, as many times enlarged as chosen."""
    Visit(driver, page.as_uri())
    for factor in (1, 50):
        driver.execute_script("player.factor = arguments[0]", factor)
        at(driver, float(shown.time[33] - shown.time[0]) + 1e-6)
        ring = vertices(driver, "structure", "wall")[-32:]
        top = factor * shown.displacement[33, -1] + [0, 0, shown.height[-1]]
        assert_allclose(ring.mean(axis=0), top, atol=1e-3)
        seat = driver.execute_script("return player.rna.position.toArray()")
        assert_allclose(seat, top, atol=1e-3)


def test_plays_by_itself_until_paused(driver: webdriver.Chrome, page: Path) -> None:
    """Time goes on unasked, the picture changes, and the button stops it."""
    Visit(driver, page.as_uri())
    wait(driver, "return player.now > 0.5")
    driver.find_element(By.ID, "pause").click()
    stopped = driver.execute_script("return player.now")
    one = picture(driver)
    assert time_after_frames(driver) == stopped
    at(driver, (stopped + 4.0) % DURATION)  # half a wave later
    assert changed_share(one, picture(driver)) > 0.01
    at(driver, stopped)
    assert changed_share(one, picture(driver)) < 1e-3


def test_card_tells_the_state(driver: webdriver.Chrome, page: Path, shown: Frames) -> None:
    """Time, elevation and moment of a frame stand in the card, and it fits."""
    Visit(driver, page.as_uri())
    at(driver, float(shown.time[40] - shown.time[0]) + 1e-6)
    card = driver.find_element(By.ID, "card")
    moment = f"{shown.moment[40, 1] / 1e6:.0f}".replace("-", "\u2212")
    elevation = f"{shown.elevation[40]:.2f}".replace("-", "\u2212")
    for text in (f"{shown.time[40]:.1f} s", f"{elevation} m", f"{moment} MN m", "+1.50 m"):
        assert text in card.text.replace("\u00a0", " ")
    assert driver.execute_script(
        "const box = arguments[0].getBoundingClientRect();"
        "return box.left >= 0 && box.right <= innerWidth && box.bottom <= innerHeight",
        card,
    )
