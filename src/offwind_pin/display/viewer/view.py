"""What ``offwind view`` shows, out of a dataset alone: a page, a still, a sequence of frames."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.display.viewer.history_frames import frames
from offwind_pin.display.viewer.history_page import DURATION, render_time_history
from offwind_pin.display.viewer.history_picture import HistoryPicture
from offwind_pin.display.viewer.mode_frames import shapes
from offwind_pin.display.viewer.modes_page import PLACES, render_modes
from offwind_pin.display.viewer.modes_picture import ModesPicture
from offwind_pin.display.viewer.picture import (
    Picture,
    Progress,
    check_frames,
    check_still,
    write_frames,
    write_still,
)

FPS = 25
MODES_DURATION = 8.0
"""Default duration in s of a film of modes."""
MODES_SPEED = 0.5
"""How many times as fast as in reality modes move in a film."""


@dataclass(frozen=True, eq=False)
class View:
    """Results and the part of them that is shown.

    Attributes
    ----------
    results : Dataset
        A time history or natural modes.
    start, duration : float or None, s
        Of the part; by default the first 60 s after the ramp, of modes 8 s.
    labels : list of str or None
        Modes side by side, by default the first bending modes.
    """

    results: xr.Dataset
    start: float | None = None
    duration: float | None = None
    labels: list[str] | None = None

    def __post_init__(self) -> None:
        if not (self.moves or "shape" in self.results):
            raise InputError(
                "results",
                str(self.results.attrs.get("title", "other results")),
                "a time history or natural modes",
                "Choose results that can be animated.",
            )
        if self.moves and self.labels is not None:
            allowed = "none for a time history without the modes of its case"
            raise InputError("--modes", ",".join(self.labels), allowed, "Leave it out.")
        if not self.moves and self.start is not None:
            allowed = "none for modes, which have no beginning"
            raise InputError("--start", self.start, allowed, "Leave it out.")
        if self.duration is not None and not 0 < self.duration < np.inf:
            raise InputError("--duration", self.duration, "seconds above zero", "Correct it.")

    @property
    def moves(self) -> bool:
        """Whether it is a time history."""
        return "time" in self.results.dims and "displacement" in self.results

    def window(self) -> tuple[float, float]:
        """Start and duration of the part in s."""
        if not self.moves:
            return 0.0, MODES_DURATION if self.duration is None else self.duration
        first, last = (float(self.results.time.values[i]) for i in (0, -1))
        ramp = float(self.results.attrs.get("ramp_s", 0.0))
        start = self.start
        if start is None:
            start = ramp if first <= ramp < last else first
        duration = min(DURATION, last - start) if self.duration is None else self.duration
        return start, duration

    def page(self) -> str:
        """HTML page that needs neither server nor network."""
        if self.moves:
            return render_time_history(self.results, *self.window())
        return render_modes(self.results, self.labels)

    def still(self, path: Path) -> None:
        """A picture of the start if one was asked for, else of the largest moment at the mudline.

        Modes are at their peaks.
        """
        check_still(path)
        if not self.moves:
            picture: Picture = self._modes()
            picture.show(np.inf)
        else:
            shown = frames(self.results, *self.window())
            picture = HistoryPicture(self.results, shown)
            largest = int(np.argmax(np.linalg.norm(shown.moment, axis=1)))
            picture.show(float(shown.time[largest]) if self.start is None else self.start)
        write_still(picture, path)

    def film(self, folder: Path, fps: float = FPS, progress: Progress | None = None) -> None:
        """Frames of the part in real time, modes half as fast; see :func:`write_frames`."""
        if not 0 < fps <= 240:
            raise InputError("--fps", fps, "above 0, at most 240", "Correct it.")
        check_frames(folder)
        start, duration = self.window()
        times: Array = start + np.arange(max(1, round(duration * fps))) / fps
        picture: Picture
        if self.moves:
            picture = HistoryPicture(self.results, frames(self.results, start, duration, rate=fps))
        else:
            picture = self._modes()
        write_frames(picture, folder, times, progress)

    def _modes(self) -> ModesPicture:
        shown = shapes(self.results)
        return ModesPicture(self.results, shown, shown.chosen(self.labels, PLACES), MODES_SPEED)
