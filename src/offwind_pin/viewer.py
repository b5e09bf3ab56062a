"""Animated pages of results, and a server that shows them on this computer.

    from offwind_pin import viewer
    viewer.serve(viewer.mode_shapes(system, ow.modes(system)))

A page is a single HTML text that includes Meshcat's viewer. It needs neither server nor network:
written to a file, it opens in any browser.
"""

from __future__ import annotations

import webbrowser
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path

import xarray as xr

from offwind_pin.analysis.drawing_data import modes_dataset
from offwind_pin.analysis.modal import ModalResult
from offwind_pin.display.viewer.serve import address, page_server
from offwind_pin.display.viewer.view import View
from offwind_pin.dynamics.system import System
from offwind_pin.results.reading import open_checked

__all__ = ["mode_shapes", "serve", "time_history"]


def mode_shapes(system: System, modes: ModalResult, labels: Sequence[str] | None = None) -> str:
    """Page of the natural modes of a system, up to four side by side.

    Parameters
    ----------
    system : System
    modes : ModalResult
        Modes of the system.
    labels : sequence of str, optional
        Modes shown first, such as ``["FA1", "SS1"]``; by default the first bending modes.

    Returns
    -------
    str
        HTML text.

    Raises
    ------
    InputError
        A label that is not among the modes, or too many.
    """
    chosen = None if labels is None else list(labels)
    return View(modes_dataset(system, modes), labels=chosen).page()


def time_history(
    results: xr.Dataset | Path | str, start: float | None = None, duration: float | None = None
) -> str:
    """Animated page of a time history: structure, sea, loads and soil forces.

    Parameters
    ----------
    results : Dataset, Path or str
        Result of :func:`simulate`, or a directory of ``offwind run``, or its ``results.nc``.
    start, duration : float, s, optional
        Part to show; by default the first 60 s after the ramp.

    Returns
    -------
    str
        HTML text.

    Raises
    ------
    InputError
        No such results, or a part outside them.
    """
    if isinstance(results, xr.Dataset):
        return View(results, start, duration).page()
    with open_checked(results) as tree:
        return View(tree.to_dataset(), start, duration).page()


def serve(
    page: str,
    port: int = 0,
    *,
    browser: bool = True,
    announce: Callable[[str], None] = lambda text: print(text, flush=True),  # noqa: T201
) -> None:
    """Serve a page on 127.0.0.1 until Ctrl-C.

    Parameters
    ----------
    page : str
        HTML text.
    port : int
        Port; 0 for any free one.
    browser : bool
        Whether to open the page in a browser.
    announce : callable
        Called with a line that contains the address once the page can be loaded.

    Raises
    ------
    InputError
        A port that cannot be used.
    """
    with page_server(page, port) as server:
        url = address(server)
        announce(f"{url}   (Ctrl-C to stop)")
        if browser:
            webbrowser.open(url)
        with suppress(KeyboardInterrupt):
            server.serve_forever()
