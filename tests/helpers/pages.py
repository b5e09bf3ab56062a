"""Pages in a real browser: what they draw, what they ask for, and what goes wrong in them."""

from __future__ import annotations

import base64
import io
import json
from urllib.parse import urlsplit

import matplotlib.image
import numpy as np
from numpy.typing import NDArray
from selenium import webdriver
from selenium.webdriver.support.ui import WebDriverWait

PATIENCE = 120.0
"""Seconds to wait for what takes a few: the machine may be small, busy and without graphics."""

_PLAYS = "return !!window.player && player.last !== null"

Image = NDArray[np.float64]


class Visit:
    """What a browser saw while it opened one address.

    ready : a script that returns true once the page is; empty for a page without a viewer
    errors : messages on its console that are errors; requested : URLs that it asked for
    """

    def __init__(self, driver: webdriver.Chrome, url: str, *, ready: str = _PLAYS) -> None:
        for log in ("browser", "performance"):
            driver.get_log(log)
        driver.get(url)
        if ready:
            wait(driver, ready)
        self.driver = driver
        self.requested: list[str] = []
        self.errors: list[str] = []
        self.collect()

    def collect(self) -> None:
        """Take in what the logs have gained."""
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] in {"Network.requestWillBeSent", "Network.webSocketCreated"}:
                params = message["params"]
                self.requested.append(params.get("request", params)["url"])
        for entry in self.driver.get_log("browser"):
            if entry["level"] == "SEVERE":
                self.errors.append(entry["message"])

    def places(self) -> set[str]:
        """Scheme of each request, with the host where there is one."""
        parts = [urlsplit(url) for url in self.requested]
        # The browser's own first tab may still be loading its parts; they are no request of the page.
        return {f"{part.scheme}:{part.hostname or ''}" for part in parts if part.scheme != "chrome"}


def wait(driver: webdriver.Chrome, condition: str) -> None:
    """Until a script returns true."""
    WebDriverWait(driver, PATIENCE, poll_frequency=0.1).until(
        lambda chrome: chrome.execute_script(condition), f"never true: {condition}"
    )


_AFTER_FRAMES = """
const done = arguments[arguments.length - 1];
let frames = 10;
const next = () => frames-- ? requestAnimationFrame(next) : done(player.now);
next();
"""


def time_after_frames(driver: webdriver.Chrome) -> float:
    """What the player shows once the browser has drawn ten more frames, however long they take."""
    return float(driver.execute_async_script(_AFTER_FRAMES))


def wait_for_change(driver: webdriver.Chrome) -> None:
    """Until the player shows another time by 0.2 s, or has begun anew."""
    now = driver.execute_script("return player.now")
    wait(driver, f"return Math.abs(player.now - {now}) > 0.2")


def picture(driver: webdriver.Chrome) -> Image:
    """(height, width, 3) pixels of the canvas as it is now, without what lies over it."""
    url: str = driver.execute_script("return viewer.capture_image()")
    image = matplotlib.image.imread(io.BytesIO(base64.b64decode(url.partition(",")[2])))
    return np.asarray(image[..., :3], dtype=float)


def drawn_share(image: Image) -> float:
    """Share of the pixels that stand out from the sky, which is one colour along each row."""
    sky = np.median(image, axis=1, keepdims=True)
    return float(np.mean(np.abs(image - sky).max(axis=2) > 0.1))


def changed_share(one: Image, other: Image) -> float:
    """Share of the pixels that differ between two pictures."""
    return float(np.mean(np.abs(one - other).max(axis=2) > 0.1))
