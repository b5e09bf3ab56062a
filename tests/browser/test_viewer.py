"""``offwind view`` in a real browser: modes are chosen, play, pause and slide; nobody else is asked."""

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
import xarray as xr
from helpers.pages import (
    PATIENCE,
    Visit,
    changed_share,
    drawn_share,
    picture,
    time_after_frames,
    wait,
)
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import modes_dataset
from offwind_pin.display.viewer.history_frames import Frames, frames
from offwind_pin.display.viewer.history_page import ARROW_SHARE, render_time_history
from offwind_pin.display.viewer.mode_frames import Shapes, carried, shapes
from offwind_pin.display.viewer.modes_page import render_modes
from offwind_pin.display.viewer.scene import colour_ramp
from offwind_pin.structure.meshes import FACETS

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def modal(distributed_wet: ow.System) -> xr.Dataset:
    return modes_dataset(distributed_wet, ow.modes(distributed_wet, 6))


@pytest.fixture(scope="module")
def shown(modal: xr.Dataset) -> Shapes:
    return shapes(modal)


@pytest.fixture(scope="module")
def page(modal: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "modes.html"
    path.write_text(render_modes(modal), encoding="utf-8")
    return path


def stop(driver: webdriver.Chrome, now: float) -> None:
    driver.execute_script("player.playing = false; player.show(arguments[0])", now)


def labels(driver: webdriver.Chrome) -> list[str]:
    """Modes shown, from left to right."""
    found: list[str] = driver.execute_script("return player.shown.map(mode => modes.label[mode])")
    return found


def rings(driver: webdriver.Chrome, place: int = 0) -> np.ndarray:
    """(r, FACETS, 3) vertices of the wall in a place."""
    found = driver.execute_script(
        "return Array.from(player.places[arguments[0]].wall.geometry.attributes.position.array)",
        place,
    )
    return np.reshape(found, (-1, FACETS, 3))


def press(driver: webdriver.Chrome, label: str) -> None:
    buttons = driver.find_elements(By.CLASS_NAME, "mode")
    next(button for button in buttons if button.text == label).click()


def drag(driver: webdriver.Chrome, slider: str, value: float) -> None:
    """Move a slider as a hand would: its value, and the event."""
    driver.execute_script(
        "const slider = document.getElementById(arguments[0]); slider.value = arguments[1];"
        "slider.dispatchEvent(new Event('input'));",
        slider,
        value,
    )


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


class TestModes:
    def test_opens_without_errors_or_requests(self, driver: webdriver.Chrome, page: Path) -> None:
        visit = Visit(driver, page.as_uri())
        stop(driver, 1.0)
        assert drawn_share(picture(driver)) > 0.02
        visit.collect()
        assert visit.errors == []
        assert page.as_uri() in visit.requested
        assert visit.places() <= {"file:", "data:", "blob:"}

    def test_four_stand_side_by_side_with_their_numbers(
        self, driver: webdriver.Chrome, page: Path, shown: Shapes
    ) -> None:
        Visit(driver, page.as_uri())
        assert labels(driver) == ["FA1", "SS1", "FA2", "SS2"]
        places = driver.execute_script(
            "return player.places.map(place => place.root.position.toArray())"
        )
        gaps = np.linalg.norm(np.diff(places, axis=0), axis=1)
        assert_allclose(gaps, 0.78 * np.ptp(shown.height), rtol=1e-6)
        tags = [
            tag.text.replace("\u00a0", " ") for tag in driver.find_elements(By.CLASS_NAME, "tag")
        ]
        for label, tag in zip(labels(driver), tags, strict=True):
            i = shown.index(label)
            assert tag == (
                f"{label} {shown.frequency_hz[i]:.4g} Hz, {100 * shown.damping_ratio[i]:.3g} %"
            )

    @pytest.mark.parametrize("label", ["FA1", "SS2", "T1"])
    def test_selector_changes_what_moves(
        self, driver: webdriver.Chrome, page: Path, shown: Shapes, label: str
    ) -> None:
        """Alone and at its peak each mode has every ring where its shape puts it, colour and all."""
        Visit(driver, page.as_uri())
        driver.find_element(By.ID, "beside").click()
        press(driver, label)
        assert labels(driver) == [label]
        i = shown.index(label)
        stop(driver, 0.25 / shown.frequency_hz[i])
        found = rings(driver)
        motion = shown.motion[i]
        centre = motion[:, :3].copy()
        centre[:, 2] += shown.height
        assert_allclose(found.mean(axis=1), centre, atol=2e-3)
        first = Rotation.from_rotvec(motion[:, 3:]).apply(
            np.column_stack([shown.radius, np.zeros((len(shown.radius), 2))])
        )
        assert_allclose(found[:, 0] - found.mean(axis=1), first, atol=2e-3)
        seat = driver.execute_script("return player.places[0].rna.position.toArray()")
        assert_allclose(seat, centre[-1], atol=2e-3)
        springs = shown.springs[i]
        ends, _ = carried(shown.motion_at(springs.height)[i], springs.height, springs.offset)
        middle, along = springs.symbols(ends)
        drawn = driver.execute_script(
            "return player.places[0].springs.map(spring => [spring.position.toArray(),"
            " spring.position.clone().set(spring.scale.x, 0, 0).applyQuaternion(spring.quaternion)"
            ".toArray()])"
        )
        assert len(middle) > 10
        assert_allclose(np.array(drawn), np.stack([middle, along], axis=1), atol=2e-3)
        colour = driver.execute_script(
            "return Array.from(player.places[0].wall.geometry.attributes.color.array)"
        )
        top = np.reshape(colour, (-1, FACETS, 3))[-1, 4]
        ramp = colour_ramp()
        expected = ramp[round(float(min(shown.share[i, -1], 1)) * (len(ramp) - 1))]
        assert_allclose(top, expected, atol=1e-3)

    def test_one_more_beside_the_others_and_one_less(
        self, driver: webdriver.Chrome, page: Path
    ) -> None:
        Visit(driver, page.as_uri())
        press(driver, "T1")
        assert labels(driver) == ["SS1", "FA2", "SS2", "T1"]
        press(driver, "FA2")
        assert labels(driver) == ["SS1", "SS2", "T1"]
        visible = driver.execute_script("return player.places.map(place => place.root.visible)")
        assert visible == [True, True, True, False]
        pressed = driver.find_elements(By.CSS_SELECTOR, ".mode[aria-pressed=true]")
        assert sorted(button.text for button in pressed) == ["SS1", "SS2", "T1"]

    def test_amplitude_and_time(self, driver: webdriver.Chrome, page: Path, shown: Shapes) -> None:
        """Twice the amplitude is twice the way; the slider runs over one cycle of the slowest."""
        Visit(driver, page.as_uri())
        driver.find_element(By.ID, "pause").click()
        slowest = shown.frequency_hz[[shown.index(label) for label in labels(driver)]].min()
        top = []
        for amplitude in (1.0, 2.0):
            drag(driver, "amplitude", amplitude)
            drag(driver, "time", 0.2)
            assert driver.execute_script("return player.now") == pytest.approx(0.2 / slowest)
            top.append(rings(driver)[-1].mean(axis=0)[0])
        i = shown.index("FA1")
        swing = np.sin(2 * np.pi * shown.frequency_hz[i] * 0.2 / slowest)
        assert top[0] == pytest.approx(swing * shown.motion[i, -1, 0], rel=1e-3)
        assert top[1] == pytest.approx(2 * top[0], rel=1e-3)

    def test_plays_until_paused_and_on(self, driver: webdriver.Chrome, page: Path) -> None:
        Visit(driver, page.as_uri())
        wait(driver, "return player.now > 0.2")
        pause = driver.find_element(By.ID, "pause")
        pause.click()
        before = rings(driver)
        now = driver.execute_script("return player.now")
        assert time_after_frames(driver) == now
        assert_allclose(rings(driver), before)
        pause.click()
        WebDriverWait(driver, PATIENCE).until(
            lambda chrome: np.abs(rings(chrome) - before).max() > 1e-3
        )

    def test_stripes_show_the_turning(
        self, driver: webdriver.Chrome, page: Path, shown: Shapes
    ) -> None:
        Visit(driver, page.as_uri())
        driver.find_element(By.ID, "beside").click()
        press(driver, "T1")
        period = 1 / shown.frequency_hz[shown.index("T1")]
        stop(driver, 0.25 * period)
        one = picture(driver)
        stop(driver, 0.75 * period)
        assert changed_share(one, picture(driver)) > 0.005

    def test_narrow_window_has_the_card_below(self, driver: webdriver.Chrome, page: Path) -> None:
        """On a phone the structures are above the card, tags and all."""
        driver.set_window_size(500, 900)
        try:
            Visit(driver, page.as_uri())
            card, *tags = driver.execute_script(
                "return [document.getElementById('card'), ...document.querySelectorAll('.tag')]"
                ".map(part => part.getBoundingClientRect().toJSON())"
            )
            assert card["bottom"] <= driver.execute_script("return innerHeight")
            assert max(tag["bottom"] for tag in tags) < card["top"]
        finally:
            driver.set_window_size(1200, 900)

    @pytest.mark.parametrize(("width", "height"), [(1200, 900), (700, 520)])
    def test_card_fits(self, driver: webdriver.Chrome, page: Path, width: int, height: int) -> None:
        driver.set_window_size(width, height)
        try:
            Visit(driver, page.as_uri())
            card = driver.find_element(By.ID, "card")
            assert "Surrogate data" in card.text
            assert driver.execute_script(
                "const box = arguments[0].getBoundingClientRect();"
                "return box.left >= 0 && box.top >= 0 && box.right <= innerWidth"
                " && box.bottom <= innerHeight && arguments[0].scrollWidth <= arguments[0].clientWidth;",
                card,
            )
        finally:
            driver.set_window_size(1200, 900)


@pytest.fixture(scope="module")
def results(undamped: ow.Turbine) -> xr.Dataset:
    """Waves along 60 degrees and an oblique load at the top, on soil."""
    sea = ow.RegularWaves(6.0, 8.0, direction_deg=60.0)
    system = ow.build(undamped, "distributed_springs", sea, elements=10)
    load = np.array([9e5, -4e5, 2e5, 0, 0, 0])
    return ow.simulate(system, 12.0, 0.05, [load], ramp=4.0, save_at=ow.SaveAt(0.2))


@pytest.fixture(scope="module")
def moved(results: xr.Dataset) -> Frames:
    return frames(results, 4.0, 8.0)


@pytest.fixture(scope="module")
def history(results: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("history") / "history.html"
    path.write_text(render_time_history(results, 4.0, 8.0), encoding="utf-8")
    return path


class TestHistory:
    def test_slider_moves_the_structure(
        self, driver: webdriver.Chrome, history: Path, moved: Frames
    ) -> None:
        visit = Visit(driver, history.as_uri())
        driver.find_element(By.ID, "pause").click()
        factor = driver.execute_script("return player.factor")
        for share in (0.25, 0.75):
            drag(driver, "time", share)
            k = round(share * (len(moved.time) - 1))
            seat = driver.execute_script("return player.rna.position.toArray()")
            expected = factor * moved.displacement[k, -1] + [0, 0, moved.height[-1]]
            assert_allclose(seat, expected, atol=2e-3)
        visit.collect()
        assert visit.errors == []
        assert visit.places() <= {"file:", "data:", "blob:"}

    def test_arrows_are_the_forces(
        self, driver: webdriver.Chrome, history: Path, moved: Frames
    ) -> None:
        """Direction and length of the load at the top and of each node of the soil."""
        Visit(driver, history.as_uri())
        k = 17
        driver.execute_script(
            "player.playing = false; showAt(arguments[0])",
            float(moved.time[k] - moved.time[0]) + 1e-7,
        )
        along = driver.execute_script(
            "const vector = arrow => { const v = arrow.position.clone().set(0, 0, arrow.scale.z);"
            " return v.applyQuaternion(arrow.quaternion).toArray().concat([arrow.visible]); };"
            "return [vector(player.topArrow)].concat(player.soilArrows.map(vector));"
        )
        longest = ARROW_SHARE * np.ptp(moved.height)
        top = moved.top_force[k] / np.linalg.norm(moved.top_force, axis=-1).max() * longest
        assert_allclose(along[0][:3], top, atol=1e-2 * longest)
        soil = moved.soil_force[k] / np.linalg.norm(moved.soil_force, axis=-1).max() * longest
        for found, expected in zip(along[1:], soil, strict=True):
            if found[3]:
                assert_allclose(found[:3], expected, atol=1e-3 * longest)
            else:
                assert np.linalg.norm(expected) <= 0.15 + 1e-3
        assert sum(found[3] for found in along) > 20
        tag = driver.find_element(By.ID, "load").text.replace("\u00a0", " ")
        assert tag == f"{np.linalg.norm(moved.top_force[k]) / 1e6:.2f} MN"

    def test_wall_is_coloured_by_the_moment(
        self, driver: webdriver.Chrome, history: Path, moved: Frames
    ) -> None:
        """Where rings lie at recorded heights, and nowhere once it is switched off."""
        Visit(driver, history.as_uri())
        k = 11
        driver.execute_script(
            "player.playing = false; showAt(arguments[0])",
            float(moved.time[k] - moved.time[0]) + 1e-7,
        )
        colours = (
            "const a = player.wall.geometry.attributes;"
            "return [Array.from(a.position.array), Array.from(a.color.array), Array.from(player.rest)]"
        )
        _, colour, rest = (np.reshape(v, (-1, 3)) for v in driver.execute_script(colours))
        ramp = colour_ramp()
        share = np.interp(rest[:, 2], moved.height, moved.bending[k]) / moved.bending.max()
        expected = ramp[np.round(share * (len(ramp) - 1)).astype(int)]
        assert np.mean(np.abs(colour - expected).max(axis=1) < 1e-3) > 0.95
        assert np.abs(colour - expected).max() < 0.05  # a step of the ramp, where rounding decides
        assert np.ptp(colour, axis=0).max() > 0.3
        driver.find_element(By.ID, "colour").click()
        _, colour, _ = (np.reshape(v, (-1, 3)) for v in driver.execute_script(colours))
        assert np.ptp(colour, axis=0).max() < 1e-6

    def test_speed(self, driver: webdriver.Chrome, history: Path) -> None:
        Visit(driver, history.as_uri())
        step = (
            "player.playing = true; player.last = 1000; player.now = 0; const next = player.tick;"
            "const frame = window.requestAnimationFrame; window.requestAnimationFrame = () => 0;"
            "player.tick(1100); window.requestAnimationFrame = frame; player.playing = false;"
            "return player.now"
        )
        assert driver.execute_script(step) == pytest.approx(0.1)
        driver.execute_script(
            "const speed = document.getElementById('speed'); speed.value = '5';"
            "speed.dispatchEvent(new Event('change'));"
        )
        assert driver.execute_script(step) == pytest.approx(0.5)

    def test_dry_without_load_or_soil(
        self, driver: webdriver.Chrome, undamped: ow.Turbine, tmp_path: Path
    ) -> None:
        """What is not there is not missed."""
        data = ow.simulate(ow.build(undamped, "clamped", elements=6), 2.0, 0.05)
        path = tmp_path / "dry.html"
        path.write_text(render_time_history(data, 0.0, 2.0), encoding="utf-8")
        visit = Visit(driver, path.as_uri())
        drag(driver, "time", 0.5)
        assert drawn_share(picture(driver)) > 0.02
        assert not driver.find_element(By.ID, "load").is_displayed()
        visit.collect()
        assert visit.errors == []


# Served


@pytest.fixture(scope="module")
def live() -> Iterator[tuple[subprocess.Popen[str], str]]:
    """``offwind view`` of a turbine at work: the process, and the address that it printed."""
    command = [sys.executable, "-c", "from offwind_pin.cli import main; main()"]
    options = ["oc6_phase2", "--no-browser", "--foundation", "clamped", "--modes", "SS2,T1"]
    process = subprocess.Popen(
        [*command, "view", *options],
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


def test_served_page_asks_nobody_else(
    driver: webdriver.Chrome, live: tuple[subprocess.Popen[str], str]
) -> None:
    """Over http the page shows what was asked for, without errors."""
    _, url = live
    assert urlsplit(url).hostname == "127.0.0.1"
    visit = Visit(driver, url)
    assert labels(driver) == ["SS2", "T1"]
    stop(driver, 0.1)
    assert drawn_share(picture(driver)) > 0.02
    visit.collect()
    assert visit.errors == []
    assert visit.places() <= {"http:127.0.0.1", "data:", "blob:"}


def test_server_knows_no_other_path(live: tuple[subprocess.Popen[str], str]) -> None:
    """There is one page: anything else is 404."""
    _, url = live
    with urllib.request.urlopen(url, timeout=PATIENCE) as answer:
        assert b"Natural modes" in answer.read()
    for path in ("FA1", "favicon.ico", "../pyproject.toml", "static/"):
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(url + path, timeout=PATIENCE)
        assert refused.value.code == 404
        refused.value.close()


def listening(tables: list[str], inodes: set[str]) -> list[str]:
    """Local addresses (hexadecimal, as the kernel writes them) of listening sockets."""
    rows = [line.split() for table in tables for line in table.splitlines()[1:]]
    return [row[1].partition(":")[0] for row in rows if row[3] == "0A" and row[9] in inodes]


def test_listening_sockets_are_found() -> None:
    """Negative control: a socket bound to every interface is distinguished from one bound to this host."""
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
def test_server_listens_on_this_computer_only(
    live: tuple[subprocess.Popen[str], str],
) -> None:
    """Its one listening socket is bound to 127.0.0.1."""
    process, _ = live
    proc = Path("/proc") / str(process.pid)
    links = [str(entry.readlink()) for entry in (proc / "fd").iterdir()]
    inodes = {link[len("socket:[") : -1] for link in links if link.startswith("socket:[")}
    tables = [path.read_text() for path in (proc / "net").glob("tcp*")]
    assert listening(tables, inodes) == ["0100007F"]  # 127.0.0.1, lowest byte first


def test_server_ends_at_ctrl_c(live: tuple[subprocess.Popen[str], str]) -> None:
    """An interrupt ends it with status 0 and no traceback. The last test: the server is gone."""
    process, _ = live
    process.send_signal(signal.SIGINT)
    _, complaints = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
    assert "Traceback" not in complaints
