"""Stills and frames of a time history or of modes, drawn without a browser."""

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
from scipy.spatial.transform import Rotation

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.mode_labels import mode_family, mode_name
from offwind_pin.base.whole_files import whole_file
from offwind_pin.display.rotor_nacelle import rotor_nacelle
from offwind_pin.display.viewer.history_frames import Frames, outline
from offwind_pin.display.viewer.history_page import (
    ARROW_SHARE,
    SEA_COLOURS,
    SOIL_COLOUR,
    SOIL_WIDTH,
    TOP_COLOUR,
    TOP_WIDTH,
    arrow,
    colour_ramp,
    displacement_factor,
    history_look,
    largest,
    rim_of,
    sides_mesh,
    surface_mesh,
    top_curve,
)
from offwind_pin.display.viewer.mode_frames import RING, Shapes
from offwind_pin.display.viewer.modes_page import modes_look
from offwind_pin.display.viewer.painter import Camera, Surface, paint
from offwind_pin.display.viewer.scene import AXIS_COLOUR, MUDLINE_COLOUR, RNA_COLOUR, WATER_COLOUR
from offwind_pin.display.wording import MINUS, fixed, foundation_name, number, water_level_name
from offwind_pin.structure.meshes import FACETS, Mesh, circle, loft
from offwind_pin.structure.rotor import rna_meshes

SIZE = (1280, 720)
"""Breadth and height of a frame in pixels; a still is half as large again."""
_DPI = 100
_FINER = 2
"""Pixels drawn for one kept, along each side: their mean is what smooths edges."""
_TEXT, _FAINT, _BLUE = "#1c2733", "#51606f", "#0072b2"
_SKY = ("#ccdff0", "#f8fafc")
_CARD = 0.27
"""Share of the breadth that numbers and curves take up, on the left."""
_GROUND = 6.0
"""m between points of the mudline: what is translucent is sorted piece by piece."""

Progress = Callable[[int, int], None]


class Picture(ABC):
    """A figure of a scene that moves.

    Attributes
    ----------
    figure : with the scene in ``scene``, whose coordinates are those of the camera
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

    def text(self, x: float, y: float, words: str, **settings: Any) -> Any:
        """Text at shares of the figure, from its lower left."""
        return self.figure.text(x, y, words, **({"color": _TEXT, "va": "top"} | settings))


class HistoryPicture(Picture):
    """A time history: structure, sea, loads, and curves with the present marked in them."""

    def __init__(self, results: xr.Dataset, shown: Frames) -> None:
        look = history_look(results, shown)
        super().__init__(look, look["half_breadth"])
        self.shown = shown
        self.factor = displacement_factor(shown)
        self._height, self._radius = outline(results, RING)
        self._assembly = Mesh.combine(
            list(rna_meshes(rotor_nacelle(results), 2 * float(self._radius[-1])).values())
        )
        self._size = float(shown.height[-1] - shown.height[0])
        self._largest = [largest(v) for v in (shown.bending, shown.top_force, shown.soil_force)]
        self._mudline = float(results.attrs["mudline_m"])
        self._dry = results.attrs.get("sea") == "dry"
        self._level = float(results.attrs.get("water_level_m", 0.0))
        below = self._height <= self._mudline + 1e-9
        self._pile = float(self._radius[below].max(initial=0.0))
        side = np.arange(shown.x[0], shown.x[-1] + _GROUND / 2, _GROUND)
        self._ground = surface_mesh(side, side, self._mudline)
        self._still = side
        self._tag = self.scene.text(0, 0, "", color=_hex(TOP_COLOUR), fontsize=10)
        self._write(results)

    def show(self, now: float) -> None:
        time = self.shown.time
        k = int(np.clip(np.searchsorted(time, now, side="right") - 1, 0, len(time) - 2))
        share = float(np.clip((now - time[k]) / (time[k + 1] - time[k]), 0.0, 1.0))

        def at(values: Array) -> Array:
            return np.asarray((1 - share) * values[k] + share * values[k + 1])

        moved = self.factor * at(self.shown.displacement)
        surfaces = [*self._structure(moved, at(self.shown.bending)), *self._soil(moved, at)]
        surfaces += self._top(moved[-1], at(self.shown.top_force))
        surfaces.append(Surface(self._ground, _rgb(MUDLINE_COLOUR), 0.5))
        self.paint(surfaces + self._sea(at))
        moment = at(self.shown.moment)[1] / 1e6
        fore_aft = fixed(round(float(moment)) + 0.0, 0)
        self._now.set_text(f"t = {now:.1f} s      $M_y$ at the mudline = {fore_aft} MN m")
        for cursor in self._cursors:
            cursor.set_xdata([now, now])

    def _structure(self, moved: Array, bending: Array) -> list[Surface]:
        rest, height = self.shown.height, self._height
        centre = np.column_stack([np.interp(height, rest, column) for column in moved.T])
        rings = np.array([circle(r, z) for r, z in zip(self._radius, height, strict=True)])
        share = np.interp(height, rest, bending) / (self._largest[0] or 1.0)
        ramp = colour_ramp()
        colour = ramp[np.round(share * (len(ramp) - 1)).astype(int)]
        wall = loft(rings + centre[:, None], capped=False)
        along = moved[-1] - moved[-2] + _up(rest[-1] - rest[-2])
        seat = np.eye(4)
        seat[:3, :3] = _upright_to(along)
        seat[:3, 3] = moved[-1] + _up(rest[-1])
        assembly = self._assembly.moved(seat)
        return [
            Surface(wall, np.repeat(colour, FACETS, axis=0)),
            Surface(assembly, _rgb(RNA_COLOUR)),
        ]

    def _arrow(self, place: Array, force: Array, most: float, width: float) -> Mesh | None:
        size = float(np.linalg.norm(force))
        length = ARROW_SHARE * self._size * size / (most or 1.0)
        if length < 0.15:
            return None
        pose = np.eye(4)
        pose[:3, :3] = _upright_to(force)
        pose[:3, 3] = place
        pose[:3, 2] *= length
        return arrow(width * self._size).moved(pose)

    def _soil(self, moved: Array, at: Callable[[Array], Array]) -> list[Surface]:
        arrows = []
        for height, force in zip(self.shown.soil_height, at(self.shown.soil_force), strict=True):
            way = [np.interp(height, self.shown.height, column) for column in moved.T]
            away = self._pile * force / (np.linalg.norm(force) or 1.0)
            place = np.array(way) + _up(height) + away
            drawn = self._arrow(place, force, self._largest[2], SOIL_WIDTH)
            arrows += [] if drawn is None else [Surface(drawn, _rgb(SOIL_COLOUR))]
        return arrows

    def _top(self, moved: Array, force: Array) -> list[Surface]:
        place = moved + _up(self.shown.height[-1])
        drawn = self._arrow(place, force, self._largest[1], TOP_WIDTH)
        self._tag.set_visible(drawn is not None)
        if drawn is None:
            return []
        length = ARROW_SHARE * self._size / self._largest[1]
        tip = self.camera.project(place + 1.06 * length * force)
        leftwards = tip[0] < self.camera.project(place)[0]
        self._tag.set_horizontalalignment("right" if leftwards else "left")
        self._tag.set_position((tip[0], tip[1]))
        self._tag.set_text(f"{np.linalg.norm(force) / 1e6:.2f} MN")
        return [Surface(drawn, _rgb(TOP_COLOUR))]

    def _sea(self, at: Callable[[Array], Array]) -> list[Surface]:
        if self._dry:
            return []
        x, y, sea = self.shown.x, self.shown.y, self.shown.sea
        if sea is None:
            level = surface_mesh(self._still, self._still, self._level)
            rim = rim_of(len(self._still), len(self._still))
            sides = sides_mesh(level, rim, self._mudline)
            return [Surface(sides, _rgb(WATER_COLOUR), 0.13), Surface(level, SEA_COLOURS[1], 0.6)]
        height = at(sea).ravel()
        mesh = surface_mesh(x, y, self._level)
        mesh.vertices[:, 2] += height
        sides = sides_mesh(mesh, rim_of(len(x), len(y)), self._mudline)
        low, mean, high = SEA_COLOURS
        share = (height / max(float(np.abs(sea).max()), 1e-3))[:, None]
        colour = mean + np.where(share > 0, share * (high - mean), -share * (low - mean))
        return [Surface(sides, _rgb(WATER_COLOUR), 0.13), Surface(mesh, colour, 0.72)]

    def _write(self, results: xr.Dataset) -> None:
        """Words, colour bar and curves."""
        attrs, left = results.attrs, 0.025
        head = f"{attrs['turbine']}, {foundation_name(str(attrs['foundation']))}"
        self.text(left, 0.965, head, fontsize=9, color=_FAINT)
        case = str(attrs.get("case", "time history"))
        self.text(left, 0.94, case, fontsize=_fitting(case, 15, 24), weight="bold")
        waves = "" if self._dry else str(attrs.get("waves", ""))
        self.text(left, 0.895, waves, fontsize=_fitting(waves, 9, 48), color=_FAINT)
        self._now = self.text(left, 0.86, "", fontsize=9.5)
        time, shown = self.shown.time, self.shown
        curves = [
            ("surface at the axis, m", shown.elevation),
            ("tower top along x, m", shown.displacement[:, -1, 0]),
            top_curve(shown),
            ("fore-aft moment at the mudline, MN m", shown.moment[:, 1] / 1e6),
        ]
        curves = [(name, values) for name, values in curves if np.any(values)]
        self._cursors = []
        for i, (name, values) in enumerate(curves):
            axes = self.figure.add_axes((left, 0.70 - 0.135 * i, _CARD - left, 0.085))
            axes.plot(time, values, color=_BLUE, linewidth=1)
            axes.set_xlim(time[0], time[-1])
            axes.set_facecolor("#ffffffb0")
            axes.set_xticks([])
            axes.set_yticks([])
            for spine in axes.spines.values():
                spine.set_visible(False)
            axes.set_title(name, fontsize=8, color=_FAINT, loc="left", pad=3)
            low, high = float(values.min()), float(values.max())
            span = f"{low:.3g} to {high:.3g}".replace("-", MINUS)
            axes.set_title(span, fontsize=8, color=_FAINT, loc="right", pad=3)
            self._cursors.append(axes.axvline(time[0], color=_hex(TOP_COLOUR), linewidth=1.2))
        colour_bar(self, f"bending moment, 0 to {number(self._largest[0] / 1e6, 3)} MN m", 0.175)
        lines = [f"displacements × {self.factor}" + ("" if self._dry else "; the sea is to scale")]  # noqa: RUF001
        colours = [_FAINT]
        if self._largest[2]:
            most = number(self._largest[2] / 1e6, 3)
            lines.insert(0, f"soil on the pile, at most {most} MN a node")
            colours.insert(0, _hex(SOIL_COLOUR))
        for i, (line, colour) in enumerate(zip(lines, colours, strict=True)):
            self.text(left, 0.12 - 0.03 * i, line, fontsize=8, color=colour)
        if attrs.get("surrogates", "none") not in ("", "none"):
            self.text(
                left,
                0.045,
                "a surrogate is at work here: see the page",
                fontsize=8,
                color="#8a5d00",
            )


class ModesPicture(Picture):
    """Modes side by side.

    ``show(np.inf)`` has each of them at its peak.
    """

    def __init__(self, results: xr.Dataset, shown: Shapes, chosen: list[int], speed: float) -> None:
        look = modes_look(results, shown)
        spacing = look["spacing"]
        super().__init__(look, look["half_breadth"] + (len(chosen) - 1) / 2 * spacing)
        self.shown, self.chosen, self.speed = shown, chosen, speed
        self._assembly = Mesh.combine(
            list(rna_meshes(rotor_nacelle(results), 2 * float(shown.radius[-1])).values())
        )
        right = np.array([*look["right"], 0.0])
        self._place = [(k - (len(chosen) - 1) / 2) * spacing * right for k in range(len(chosen))]
        size = float(shown.height[-1] - shown.height[0])
        grid = _round_grid(0.3 * size)
        self._site = [(grid, float(results.attrs["mudline_m"]), MUDLINE_COLOUR, 0.42)]
        if results.attrs.get("sea") != "dry":
            level = float(results.attrs.get("water_level_m", 0.0))
            self._site.append((grid, level, WATER_COLOUR, 0.26))
        thin = 0.0014 * size
        self._axis = loft(
            np.array([circle(thin, z) for z in np.linspace(shown.height[0], shown.height[-1], 30)])
        )
        self._write(results, look["low"])

    def show(self, now: float) -> None:
        surfaces = []
        for mode, place in zip(self.chosen, self._place, strict=True):
            turn = 2 * np.pi * self.shown.frequency_hz[mode] * self.speed * now
            factor = 1.0 if np.isinf(now) else float(np.sin(turn))
            surfaces += self._structure(mode, factor, place)
        self.paint(surfaces)

    def _structure(self, mode: int, factor: float, place: Array) -> list[Surface]:
        shown, motion = self.shown, factor * self.shown.motion[mode]
        turns = Rotation.from_rotvec(motion[:, 3:]).as_matrix()
        flat = np.array([circle(r, 0.0) for r in shown.radius])
        centre = motion[:, :3] + place
        centre[:, 2] += shown.height
        rings = np.einsum("rij,rnj->rni", turns, flat) + centre[:, None]
        ramp = colour_ramp()
        share = np.clip(shown.share[mode], 0, 1)
        colour = np.repeat(ramp[np.round(share * (len(ramp) - 1)).astype(int)], FACETS, axis=0)
        if mode_family(shown.label[mode]) == "T":
            colour[np.arange(len(colour)) % (FACETS // 4) < 2] *= 0.25
        seat = np.eye(4)
        seat[:3, :3], seat[:3, 3] = turns[-1], centre[-1]
        shift = np.eye(4)
        shift[:3, 3] = place
        site = []
        for grid, level, tint, opacity in self._site:
            lift = shift.copy()
            lift[2, 3] += level
            site.append(Surface(grid.moved(lift), _rgb(tint), opacity))
        return [
            Surface(loft(rings, capped=False), colour),
            Surface(self._assembly.moved(seat), _rgb(RNA_COLOUR)),
            Surface(self._axis.moved(shift), _rgb(AXIS_COLOUR)),
            *site,
        ]

    def _write(self, results: xr.Dataset, low: float) -> None:
        attrs, left, shown = results.attrs, 0.025, self.shown
        foundation = foundation_name(str(attrs["foundation"]))
        wet = attrs.get("sea") != "dry"
        water = water_level_name(float(attrs.get("water_level_m", 0.0))) if wet else "dry"
        self.text(left, 0.965, f"{attrs['turbine']}, {foundation}", fontsize=9, color=_FAINT)
        self.text(left, 0.94, "Natural modes", fontsize=17, weight="bold")
        self.text(left, 0.885, water, fontsize=9, color=_FAINT)
        for i, (mode, place) in enumerate(zip(self.chosen, self._place, strict=True)):
            numbers = f"{shown.frequency_hz[mode]:.4g} Hz, {100 * shown.damping_ratio[mode]:.3g} %"
            turns = mode_family(shown.label[mode]) == "T"
            peak = shown.peak[mode]
            drawn = f"{np.degrees(peak):.0f}°" if turns else f"{peak:.1f} m"
            y = 0.80 - 0.115 * i
            self.text(left, y, shown.label[mode], fontsize=13, weight="bold")
            self.text(left + 0.06, y - 0.004, numbers, fontsize=11)
            words = f"{mode_name(shown.label[mode])}, peak drawn as {drawn}"
            self.text(left, y - 0.042, words, fontsize=9, color=_FAINT)
            seen = self.camera.project(place + _up(low))
            self.scene.text(
                seen[0], seen[1], f"{shown.label[mode]}\n{numbers}", ha="center", va="top",
                fontsize=10, color=_TEXT, linespacing=1.4,
            )  # fmt: skip
        colour_bar(self, "displacement (torsion: rotation) over its peak", 0.20)
        self.text(left, 0.13, "A mode has no size of its own.", fontsize=8, color=_FAINT)
        if attrs.get("surrogates", "none") not in ("", "none"):
            self.text(
                left,
                0.045,
                "a surrogate is at work here: see the page",
                fontsize=8,
                color="#8a5d00",
            )


def colour_bar(picture: Picture, title: str, height: float) -> None:
    """The ramp of colours over the breadth of the card."""
    axes = picture.figure.add_axes((0.025, height, _CARD - 0.025, 0.018))
    axes.imshow(colour_ramp()[None], aspect="auto")
    axes.set_axis_off()
    axes.set_title(title, fontsize=8, color=_FAINT, loc="left", pad=3)


def write_still(picture: Picture, path: Path) -> None:
    """The figure as it is, as PNG or SVG by the name of the file.

    Raises
    ------
    InputError
        Another kind of file.
    """
    kind = path.suffix.lower()
    check_still(path)
    with whole_file(path) as temporary:
        if kind == ".svg":
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
    """Refuse a folder of frames that holds something."""
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
        The folder holds something.
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


def _upright_to(direction: Array) -> Array:
    """(3, 3) the smallest turn of z into a direction."""
    along = direction / np.linalg.norm(direction)
    axis = np.cross([0.0, 0.0, 1.0], along)
    sine, cosine = float(np.linalg.norm(axis)), float(along[2])
    if sine < 1e-12:
        return np.diag([1.0, np.sign(cosine), np.sign(cosine)])
    turn = np.arctan2(sine, cosine) * axis / sine
    return np.asarray(Rotation.from_rotvec(turn).as_matrix())


def _round_grid(radius: float) -> Mesh:
    """A level disc at height 0, cut into pieces so that it can be sorted among what it meets."""
    rings = np.linspace(radius, 1e-3 * radius, 9)
    return loft(np.array([circle(r, 0.0) for r in rings]), capped=False)


def _fitting(words: str, size: float, fit: int) -> float:
    """Size of letters, smaller where there are more of them than fit into the card."""
    return size * min(1.0, fit / max(len(words), 1))


def _up(height: float) -> Array:
    return np.array([0.0, 0.0, height])


def _rgb(colour: int) -> Array:
    return np.array([colour >> 16 & 255, colour >> 8 & 255, colour & 255]) / 255


def _hex(colour: int) -> str:
    return f"#{colour:06x}"
