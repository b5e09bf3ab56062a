"""A figure of a scene that moves, and its files: stills and frames, drawn without a browser."""

from __future__ import annotations

import shutil
import uuid
from abc import ABC, abstractmethod
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.image import imsave
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.whole_files import whole_file
from offwind_pin.display.viewer.painter import Camera, Surface, paint
from offwind_pin.display.viewer.scene import colour_ramp
from offwind_pin.display.wording import foundation_name, surrogate_notes

SIZE = (1280, 720)
"""Breadth and height of a frame in pixels; a still is half as large again."""
_DPI = 100
_FINER = 2
"""Pixels drawn for one kept, along each side: their mean is what smooths edges."""
TEXT, FAINT, BLUE, MARK = "#1c2733", "#51606f", "#0072b2", "#d55e00"
_CAUTION = "#8a5d00"
_SKY = ("#ccdff0", "#f8fafc")
_CARD, _LEFT = 0.27, 0.025
"""Right and left end of numbers and curves, over the breadth."""

Progress = Callable[[int, int], None]


class Picture(ABC):
    """A figure of a scene that moves.

    Attributes
    ----------
    figure : Figure
    scene : Axes
        In the coordinates of the camera.
    camera : Camera
    """

    def __init__(self, look: dict[str, Any], breadth: float) -> None:
        self.figure = Figure(figsize=(SIZE[0] / _DPI, SIZE[1] / _DPI), dpi=_DPI)
        FigureCanvasAgg(self.figure)
        sky = self.figure.add_axes((0, 0, 1, 1), zorder=-2)
        colours = mpl.colors.LinearSegmentedColormap.from_list("sky", _SKY)
        sky.imshow(np.linspace(0, 1, 64)[:, None], aspect="auto", cmap=colours)
        sky.set_axis_off()
        self.scene = self.figure.add_axes((_CARD, 0, 1 - _CARD, 1))
        self.scene.set_axis_off()
        self.scene.patch.set_alpha(0)
        half = np.tan(np.radians(look["field_of_view_deg"]) / 2)
        aspect = (1 - _CARD) * SIZE[0] / SIZE[1]
        near = max(1.06 * look["half_height"] / half, breadth / (half * aspect))
        self.camera = Camera(
            np.array([0.0, 0.0, look["centre"]]),
            np.array(look["from"]),
            near + 0.4 * look["half_breadth"],
        )
        self.scene.set_xlim(-half * aspect, half * aspect)
        self.scene.set_ylim(-half, half)
        self._triangles = PolyCollection([], linewidths=0, rasterized=True)
        self.scene.add_collection(self._triangles, autolim=False)

    def paint(self, surfaces: list[Surface]) -> None:
        """Show these surfaces in the scene, and nothing else."""
        corners, colours = paint(self.camera, surfaces)
        self._triangles.set_verts(list(corners))
        self._triangles.set_facecolor(colours.tolist())
        # A seam between neighbours shows what is behind if solid edges are softened, and is painted
        # twice if translucent ones are not.
        self._triangles.set_antialiased((colours[:, 3] < 1).tolist())

    @abstractmethod
    def show(self, now: float) -> None:
        """Show an instant in s."""

    def pixels(self, scale: float = 1.0) -> NDArray[np.uint8]:
        """(height, breadth, 3) of the figure as it is, so many times the size of a frame."""
        self.figure.set_dpi(_DPI * _FINER * scale)
        canvas: Any = self.figure.canvas  # matplotlib's own drawing is untyped
        canvas.draw()
        fine = np.asarray(canvas.buffer_rgba())[..., :3].astype(float)
        rows, columns = fine.shape[0] // _FINER, fine.shape[1] // _FINER
        blocks = fine[: rows * _FINER, : columns * _FINER]
        mean = blocks.reshape(rows, _FINER, columns, _FINER, 3).mean(axis=(1, 3))
        return np.asarray(np.round(mean), dtype=np.uint8)

    def text(self, y: float, words: str, *, fit: int = 0, indent: float = 0.0, **font: Any) -> Any:
        """A line of the card at a share of the height.

        Parameters
        ----------
        fit : int, optional
            Number of letters beyond which they become smaller, so that the line fits.
        """
        if fit:
            font["fontsize"] *= min(1.0, fit / max(len(words), 1))
        return self.figure.text(_LEFT + indent, y, words, **({"color": TEXT, "va": "top"} | font))

    def head(self, results: xr.Dataset, title: str, subtitle: str) -> None:
        """Turbine, foundation and title, and a note where data are surrogates."""
        attrs = results.attrs
        of = f"{attrs['turbine']}, {foundation_name(str(attrs['foundation']))}"
        self.text(0.965, of, fontsize=9, fit=48, color=FAINT)
        self.text(0.94, title, fontsize=16, fit=24, weight="bold")
        self.text(0.89, subtitle, fontsize=9, fit=48, color=FAINT)
        if surrogate_notes(attrs):
            words = "contains surrogate data: see the page or the report"
            self.text(0.045, words, fontsize=8, color=_CAUTION)

    def strip(self, y: float, height: float, title: str, value: str = "") -> Any:
        """Axes over the breadth of the card, with a title and a value above."""
        axes = self.figure.add_axes((_LEFT, y, _CARD - _LEFT, height))
        axes.set_facecolor("#ffffffb0")
        axes.set(xticks=[], yticks=[])
        axes.spines[:].set_visible(False)
        font = {"fontsize": 8, "color": FAINT}
        axes.set_title(title, font, loc="left", pad=3)
        axes.set_title(value, font, loc="right", pad=3)
        return axes

    def colour_bar(self, y: float, title: str) -> None:
        """The ramp of colours."""
        self.strip(y, 0.018, title).imshow(colour_ramp()[None], aspect="auto")


def write_still(picture: Picture, path: Path) -> None:
    """The figure as it is, as PNG or SVG by the name of the file.

    Raises
    ------
    InputError
        Another kind of file.
    """
    check_still(path)
    with whole_file(path) as temporary:
        if path.suffix.lower() == ".svg":
            picture.figure.savefig(temporary, format="svg", dpi=2 * _DPI)
        else:
            imsave(temporary, picture.pixels(1.5), format="png")


def check_still(path: Path) -> None:
    """Refuse a still that is neither PNG nor SVG."""
    if path.suffix.lower() not in {".png", ".svg"}:
        raise InputError(
            "--still", str(path), "a file name that ends in .png or .svg", "Rename it."
        )


def check_frames(folder: Path) -> None:
    """Refuse a folder of frames that is not empty."""
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        remedy = "Name another, or empty it."
        raise InputError("--frames", str(folder), "a new or an empty directory", remedy)


def write_frames(
    picture: Picture, folder: Path, times: Array, progress: Progress | None = None
) -> None:
    """``frame_00001.png`` and on, one for each instant; all of them, or none and no folder.

    Parameters
    ----------
    times : (n,) array, s
        As :meth:`Picture.show` takes them.
    progress : callable, optional
        Called with the frames written and their number.

    Raises
    ------
    InputError
        The folder is not empty.
    """
    check_frames(folder)
    folder.parent.mkdir(parents=True, exist_ok=True)
    temporary = folder.with_name(f".{folder.name}.{uuid.uuid4().hex}")
    temporary.mkdir()
    try:
        for i, now in enumerate(times, start=1):
            picture.show(float(now))
            imsave(temporary / f"frame_{i:05d}.png", picture.pixels(), format="png")
            if progress is not None:
                progress(i, len(times))
        if folder.exists():
            folder.rmdir()
        temporary.rename(folder)
    finally:
        if temporary.exists():
            shutil.rmtree(temporary)
