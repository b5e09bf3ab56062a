"""Pages that move, in one call each, and a server that shows them on this computer.

    from offwind_pin import viewer
    viewer.serve(viewer.mode_shapes(system, ow.modes(system)))

A page is one HTML text with Meshcat's viewer in it. It needs neither server nor network: written to
a file it opens in any browser.
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
from offwind_pin.results.reading import open_results

__all__ = ["mode_shapes", "serve", "time_history"]


def mode_shapes(system: System, modes: ModalResult, labels: Sequence[str] | None = None) -> str:
    """Page of the natural modes of a system, up to four side by side.

    Parameters
    ----------
    modes : ModalResult
        Of this system.
    labels : sequence of str, optional
        Modes shown first, such as ``["FA1", "SS1"]``; by default the first that bend.

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
    """Page of a time history: structure, sea, loads and forces of the soil in motion.

    Parameters
    ----------
    results : Dataset, Path or str
        Of :func:`simulate`, or a directory of ``offwind run`` or its ``results.nc``.
    start, duration : float, s, optional
        Of the part shown; by default the first 60 s after the ramp.

    Raises
    ------
    InputError
        No such results, or a part that they do not have.
    """
    if isinstance(results, xr.Dataset):
        return View(results, start, duration).page()
    with open_results(results) as tree:
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
        By default any that is free.
    browser : bool
        Whether to open the page in a browser.
    announce : callable
        Is given a line with the address once the page can be loaded.

    Raises
    ------
    InputError
        A port that cannot be used.
    """
    with page_server(page, port) as server:
        url = address(server)
        announce(f"{url}   (Ctrl-C ends)")
        if browser:
            webbrowser.open(url)
        with suppress(KeyboardInterrupt):
            server.serve_forever()
