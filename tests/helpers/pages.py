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

_MODE_MOVES = "return !!window.viewer && viewer.animator.actions.length > 0"

Image = NDArray[np.float64]


class Visit:
    """What a browser saw while it opened one address.

    ready : a script that returns true once the page is; empty for a page without a viewer
    errors : messages on its console that are errors; requested : URLs that it asked for
    """

    def __init__(self, driver: webdriver.Chrome, url: str, *, ready: str = _MODE_MOVES) -> None:
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
"""Pages of the docs as a reader follows them: files are saved, commands run, printed lines compared."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]

_BLOCK = re.compile(r"^([^\n]*)\n\n?```(\w+)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
_NAMED = re.compile(r"`([\w.]+\.\w+)`[^`]*:$")
_FRAME = str.maketrans("│┃", "  ")


class Block(NamedTuple):
    """A fenced block: name of the file that it is saved as, if any; its language, and its text."""

    file: str | None
    language: str
    text: str


def blocks(page: Path) -> list[Block]:
    """Fenced blocks of a page in order. One is a file where the line before it ends "`name`:"."""
    found = []
    for before, language, text in _BLOCK.findall(page.read_text()):
        named = _NAMED.search(before)
        found.append(Block(named[1] if named else None, language, text))
    return found


def follow(page: Path, folder: Path, run: Callable[[list[str]], str]) -> list[str]:
    """Do what a page says in a folder; returns the commands that were run.

    Every block must be a file to be saved, commands (``console``), or right after those what they
    print (``text``).
    run : a command's words to its standard output
    """
    commands: list[str] = []
    printed: str | None = None
    for block in blocks(page):
        if block.file is not None:
            (folder / block.file).write_text(block.text)
            printed = None
        elif block.language == "console":
            lines = block.text.strip().splitlines()
            printed = "\n".join(run(shlex.split(line)) for line in lines)
            commands += lines
        else:
            assert block.language == "text", f"{page.name}: a block that nothing runs: {block.text}"
            assert printed is not None, f"{page.name}: printed by no command: {block.text}"
            compare(block.text, printed)
            printed = None
    return commands


def compare(shown: str, printed: str) -> None:
    """Every line of what a page shows is part of a printed line, in the same order."""
    rest = [plain(line) for line in printed.splitlines()]
    for line in shown.strip().splitlines():
        places = [i for i, candidate in enumerate(rest) if plain(line) in candidate]
        assert places, f"not printed: {plain(line)}\n" + "\n".join(rest)
        rest = rest[places[0] + 1 :]


def plain(line: str) -> str:
    """A line without a table's frame, and with single blanks."""
    return " ".join(line.translate(_FRAME).split())
