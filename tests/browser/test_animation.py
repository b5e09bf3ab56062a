"""The animation in a real browser: it draws, moves, says what it shows, and fetches nothing."""

from __future__ import annotations

import signal
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest
from helpers.pages import PATIENCE, Image, Visit, changed_share, drawn_share, picture, wait
from numpy.testing import assert_allclose
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

import offwind_pin as ow
from offwind_pin.display.animation import animate
from offwind_pin.display.motion import FRAMES, mode_motion
from offwind_pin.display.scene import CYCLE

pytestmark = pytest.mark.browser

SCRIPT = Path(__file__).parents[2] / "viz" / "mode_shapes.py"


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


# The viewer over http


@pytest.fixture(scope="module")
def live() -> Iterator[tuple[subprocess.Popen[str], str]]:
    """viz/mode_shapes.py at work: the process, and the address that it printed."""
    command = [sys.executable, str(SCRIPT), "oc6_phase2", "--foundation", "clamped"]
    process = subprocess.Popen(
        [*command, "--mode", "SS2", "-n", "5", "--no-browser"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # A suite that runs in the background hands down an ignored interrupt.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert process.stdout is not None
    line = process.stdout.readline()
    try:
        yield process, line.partition(" ")[0]
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate()


def test_live_viewer_shows_modes_and_links(
    driver: webdriver.Chrome, live: tuple[subprocess.Popen[str], str]
) -> None:
    """Over http the same page appears without errors; a link leads to another mode."""
    _, url = live
    assert urlsplit(url).hostname == "127.0.0.1"
    visit = Visit(driver, url)
    assert drawn_share(frame(driver, 0.25)) > 0.02
    assert "second side-side mode" in driver.find_element(By.ID, "card").text
    driver.find_element(By.LINK_TEXT, "T1").click()
    wait(
        driver,
        "return document.title.includes('T1') && !!window.viewer"
        " && viewer.animator.actions.length > 0",
    )
    assert "first torsion mode" in driver.find_element(By.ID, "card").text
    one, other = frame(driver, 0.25), frame(driver, 0.75)
    assert changed_share(one, other) > 0.01
    visit.collect()
    assert visit.errors == []
    assert visit.places() <= {"http:127.0.0.1", "data:", "blob:"}


def test_live_viewer_knows_no_other_path(live: tuple[subprocess.Popen[str], str]) -> None:
    """Only modes have pages: anything else is 404."""
    _, url = live
    base = url.rpartition("/")[0]
    with urllib.request.urlopen(f"{base}/", timeout=PATIENCE) as answer:
        assert b"second side-side mode" in answer.read()
    for path in ("FA9", "favicon.ico", "../pyproject.toml", "SS2/x", "static/"):
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"{base}/{path}", timeout=PATIENCE)
        assert refused.value.code == 404
        refused.value.close()


def listening(tables: list[str], inodes: set[str]) -> list[str]:
    """Local addresses (hexadecimal, as the kernel writes them) of listening sockets."""
    rows = [line.split() for table in tables for line in table.splitlines()[1:]]
    return [row[1].partition(":")[0] for row in rows if row[3] == "0A" and row[9] in inodes]


def test_listening_sockets_are_found() -> None:
    """Negative control: a socket bound to every interface is told from one bound to this host."""
    head = "sl local_address rem_address st tx_queue:rx_queue tr:tm retrnsmt uid timeout inode"
    row = "   0: {}:1F90 00000000:0000 {} 00000000:00000000 00:00000000 00000000  1000 0 {} 1"
    table = "\n".join(
        [
            head,
            row.format("0100007F", "0A", 7),
            row.format("00000000", "0A", 8),
            row.format("0100007F", "01", 9),
        ]
    )
    assert listening([table], {"7", "9"}) == ["0100007F"]
    assert listening([table], {"7", "8"}) == ["0100007F", "00000000"]


@pytest.mark.skipif(not Path("/proc/net/tcp").exists(), reason="reads the tables of Linux")
def test_live_viewer_listens_on_this_computer_only(
    live: tuple[subprocess.Popen[str], str],
) -> None:
    """Its one listening socket is bound to 127.0.0.1."""
    process, _ = live
    proc = Path("/proc") / str(process.pid)
    links = [str(entry.readlink()) for entry in (proc / "fd").iterdir()]
    inodes = {link[len("socket:[") : -1] for link in links if link.startswith("socket:[")}
    tables = [path.read_text() for path in (proc / "net").glob("tcp*")]
    assert listening(tables, inodes) == ["0100007F"]  # 127.0.0.1, lowest byte first


def test_live_viewer_ends_at_ctrl_c(live: tuple[subprocess.Popen[str], str]) -> None:
    """An interrupt ends it with status 0 and nothing to say. The last test: the viewer is gone."""
    process, _ = live
    process.send_signal(signal.SIGINT)
    _, complaints = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
    assert complaints == ""
