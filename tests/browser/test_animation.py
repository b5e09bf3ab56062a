"""The animation in a real browser: it draws, moves, says what it shows, and fetches nothing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from helpers.pages import PATIENCE, Image, Visit, changed_share, drawn_share, picture, wait
from numpy.testing import assert_allclose
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

import offwind_pin as ow
from offwind_pin.display.viewer.mode_motion import FRAMES, mode_motion
from offwind_pin.display.viewer.mode_page import animate
from offwind_pin.display.viewer.scene import CYCLE

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def modes(distributed_wet: ow.System) -> ow.ModalResult:
    return ow.modes(distributed_wet, 8)


@pytest.fixture(scope="module")
def page(
    distributed_wet: ow.System, modes: ow.ModalResult, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """The animation of FA2 as a file."""
    path = tmp_path_factory.mktemp("page") / "fa2.html"
    path.write_text(animate(distributed_wet, modes, "FA2"), encoding="utf-8")
    return path


def frame(driver: webdriver.Chrome, share: float) -> Image:
    """The canvas at a share of the cycle, the animation stopped."""
    driver.execute_script(
        "viewer.animator.pause(); viewer.animator.seek(arguments[0])", share * CYCLE
    )
    return picture(driver)


def test_file_opens_without_errors_or_requests(driver: webdriver.Chrome, page: Path) -> None:
    """From file:// the page works, and asks for nothing but itself and data it holds."""
    visit = Visit(driver, page.as_uri())
    frame(driver, 0.25)
    visit.collect()
    assert visit.errors == []
    assert page.as_uri() in visit.requested
    assert visit.places() <= {"file:", "data:", "blob:"}


def test_logs_would_show_errors_and_requests(driver: webdriver.Chrome, tmp_path: Path) -> None:
    """Negative control: an error, an image and a socket on another host are all seen."""
    path = tmp_path / "bad.html"
    path.write_text(
        '<img src="http://127.0.0.1:9/picture.png"><script>console.error("wrong");'
        'fetch("http://127.0.0.1:9/data").catch(() => 0); new WebSocket("ws://127.0.0.1:9/");</script>'
    )
    visit = Visit(driver, path.as_uri(), ready="")

    def all_seen(_: webdriver.Chrome) -> bool:
        visit.collect()
        return len(visit.requested) >= 4 and any("wrong" in error for error in visit.errors)

    # Nobody serves that port: the requests fail, but they were made.
    WebDriverWait(driver, PATIENCE).until(all_seen)
    assert {"http:127.0.0.1", "ws:127.0.0.1"} <= visit.places()
    assert not visit.places() <= {"file:", "data:", "blob:"}


def test_page_forbids_requests(driver: webdriver.Chrome, page: Path) -> None:
    """Even a script that tried to reach out from the page would be stopped by the browser."""
    Visit(driver, page.as_uri())
    outcome = driver.execute_async_script(
        "const done = arguments[arguments.length - 1];"
        "document.addEventListener('securitypolicyviolation', e => done(e.effectiveDirective));"
        "fetch('http://127.0.0.1:9/').catch(() => 0);"
    )
    assert outcome == "connect-src"


def test_canvas_shows_the_structure(driver: webdriver.Chrome, page: Path) -> None:
    """Something is drawn; with the scene hidden, the same detector finds an empty sky."""
    Visit(driver, page.as_uri())
    shown = frame(driver, 0.25)
    assert min(shown.shape[:2]) > 300
    assert drawn_share(shown) > 0.02
    driver.execute_script("viewer.scene_tree.find(['meshcat']).object.visible = false")
    assert drawn_share(picture(driver)) < 1e-4
    assert drawn_share(np.ones((40, 60, 3))) == 0


def test_colours_run_over_the_map(driver: webdriver.Chrome, page: Path) -> None:
    """The still pile is dark violet, the swinging tower yellow."""
    Visit(driver, page.as_uri())
    red, green, blue = np.moveaxis(frame(driver, 0.0), 2, 0)
    assert np.mean((red > 0.7) & (green > 0.7) & (blue < 0.35)) > 5e-4
    assert np.mean((red < 0.4) & (green < 0.15) & (blue > green + 0.1)) > 5e-4


def test_frames_differ(driver: webdriver.Chrome, page: Path) -> None:
    """A quarter and three quarters of a cycle look different; the same moment looks the same."""
    Visit(driver, page.as_uri())
    one, other = frame(driver, 0.25), frame(driver, 0.75)
    assert changed_share(one, other) > 0.01
    assert changed_share(one, frame(driver, 0.25)) < 1e-3


def test_bodies_are_where_the_mode_puts_them(
    driver: webdriver.Chrome, page: Path, distributed_wet: ow.System, modes: ow.ModalResult
) -> None:
    """The viewer's own poses are those of forward kinematics, at and between key frames."""
    Visit(driver, page.as_uri())
    motion = mode_motion(distributed_wet, modes, "FA2")
    for step in (0.0, 15.0, 22.5):
        frame(driver, step / FRAMES)
        places = driver.execute_script(
            "const bodies = viewer.scene_tree.find(['meshcat', 'turbine']).children;"
            "return Object.keys(bodies).map(name => bodies[name].object.position.toArray());"
        )
        low, high = motion.poses[int(np.floor(step))], motion.poses[int(np.ceil(step))]
        assert_allclose(places, (low + high)[:, :3, 3] / 2, rtol=0, atol=1e-3)


def test_animation_starts_by_itself_and_never_ends(driver: webdriver.Chrome, page: Path) -> None:
    """Several cycles pass unasked; the button stops and restarts them."""
    Visit(driver, page.as_uri())
    assert driver.execute_script("return viewer.animator.playing")
    driver.execute_script(
        "window.cycles = 0; viewer.animator.mixer.addEventListener('loop', () => ++window.cycles);"
        "viewer.animator.mixer.timeScale = 4;"
    )
    bodies: int = driver.execute_script("return viewer.animator.actions.length")
    wait(driver, f"return window.cycles >= 3 * {bodies}")
    assert driver.execute_script("return viewer.animator.playing")
    button = driver.find_element(By.ID, "pause")
    button.click()
    wait(driver, "return document.getElementById('pause').textContent === 'Play'")
    assert not driver.execute_script("return viewer.animator.playing")
    button.click()
    stopped = driver.execute_script("return window.cycles")
    wait(driver, f"return window.cycles > {stopped}")


@pytest.mark.parametrize(("width", "height"), [(1200, 900), (700, 520)])
def test_overlay_tells_the_mode(
    driver: webdriver.Chrome, page: Path, modes: ow.ModalResult, width: int, height: int
) -> None:
    """Mode, name, frequency, damping, exaggeration and surrogate stand in the card, unclipped."""
    driver.set_window_size(width, height)
    try:
        Visit(driver, page.as_uri())
        card = driver.find_element(By.ID, "card")
        index = modes.index("FA2")
        for text in (
            "oc6_phase2, distributed springs",
            "FA2",
            "second fore-aft mode",
            f"{modes.frequency_hz[index]:.4g} Hz",
            f"{100 * modes.damping_ratio[index]:.3g} %",
            "Amplitude exaggerated",
            "The soil is a surrogate",
        ):
            assert text in card.text
        inside = driver.execute_script(
            "const card = arguments[0], box = card.getBoundingClientRect();"
            "return box.left >= 0 && box.top >= 0 && box.right <= innerWidth"
            " && box.bottom <= innerHeight && card.scrollWidth <= card.clientWidth;",
            card,
        )
        assert inside
    finally:
        driver.set_window_size(1200, 900)
