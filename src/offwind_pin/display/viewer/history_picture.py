"""A time history as a picture: structure, sea, loads, and curves with the current time marked."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

from offwind_pin.base.definition import Array
from offwind_pin.display.rotor_nacelle import assembly
from offwind_pin.display.viewer.history_frames import Frames, outline
from offwind_pin.display.viewer.history_page import (
    ARROW_SHARE,
    SEA_COLOURS,
    SOIL_COLOUR,
    SOIL_WIDTH,
    TOP_COLOUR,
    TOP_WIDTH,
    arrow,
    curves,
    displacement_factor,
    history_look,
    largest,
    range_in_words,
    rim_of,
    sides_mesh,
    surface_mesh,
)
from offwind_pin.display.viewer.painter import Surface, smallest_turn
from offwind_pin.display.viewer.picture import BLUE, FAINT, MARK, Picture
from offwind_pin.display.viewer.scene import (
    MUDLINE_COLOUR,
    RING,
    RNA_COLOUR,
    WATER_COLOUR,
    colour_ramp,
    css,
    rgb,
)
from offwind_pin.display.wording import TIMES, fixed, number
from offwind_pin.structure.meshes import FACETS, Mesh, circle, loft

_GROUND = 6.0
"""m between points of the mudline: what is translucent is sorted piece by piece."""
_SHORTEST = 0.15
"""m, of an arrow that is drawn."""
_UP = np.array([0.0, 0.0, 1.0])


class HistoryPicture(Picture):
    """A time history; ``show(now)`` has it at a time in s."""

    def __init__(self, results: xr.Dataset, shown: Frames) -> None:
        look = history_look(results, shown)
        super().__init__(look, look["half_breadth"])
        self.shown = shown
        self.factor = displacement_factor(shown)
        self._height, self._radius = outline(results, RING)
        self._assembly = Mesh.combine(list(assembly(results, 2 * float(self._radius[-1])).values()))
        self._size = float(shown.height[-1] - shown.height[0])
        self._bending, self._top_force, self._soil_force = (
            largest(part) for part in (shown.bending, shown.top_force, shown.soil_force)
        )
        self._mudline = float(results.attrs["mudline_m"])
        self._dry = results.attrs.get("sea") == "dry"
        self._level = float(results.attrs.get("water_level_m", 0.0))
        below = self._height <= self._mudline + 1e-9
        self._pile = float(self._radius[below].max(initial=0.0))
        self._side = np.arange(shown.x[0], shown.x[-1] + _GROUND / 2, _GROUND)
        self._tag = self.scene.text(0, 0, "", color=css(TOP_COLOUR), fontsize=10)
        self._write(results)

    def show(self, now: float) -> None:
        time = self.shown.time
        k = int(np.clip(np.searchsorted(time, now, side="right") - 1, 0, len(time) - 2))
        share = float(np.clip((now - time[k]) / (time[k + 1] - time[k]), 0.0, 1.0))

        def at(values: Array) -> Array:
            return np.asarray((1 - share) * values[k] + share * values[k + 1])

        moved = self.factor * at(self.shown.displacement)
        ground = surface_mesh(self._side, self._side, self._mudline)
        self.paint(
            [
                *self._structure(moved, at(self.shown.bending)),
                *self._soil(moved, at(self.shown.soil_force)),
                *self._top(moved[-1], at(self.shown.top_force)),
                Surface(ground, rgb(MUDLINE_COLOUR), 0.5),
                *self._sea(at),
            ]
        )
        fore_aft = fixed(round(float(at(self.shown.moment)[1]) / 1e6) + 0.0, 0)
        self._now.set_text(f"t = {now:.1f} s      $M_y$ at the mudline = {fore_aft} MN m")
        for cursor in self._cursors:
            cursor.set_xdata([now, now])

    def _structure(self, moved: Array, bending: Array) -> list[Surface]:
        rest, height = self.shown.height, self._height
        centre = np.column_stack([np.interp(height, rest, column) for column in moved.T])
        rings = np.array([circle(r, z) for r, z in zip(self._radius, height, strict=True)])
        share = np.interp(height, rest, bending) / (self._bending or 1.0)
        ramp = colour_ramp()
        colour = ramp[np.round(share * (len(ramp) - 1)).astype(int)]
        wall = loft(rings + centre[:, None], capped=False)
        seat = np.eye(4)
        seat[:3, :3] = smallest_turn(_UP, moved[-1] - moved[-2] + (rest[-1] - rest[-2]) * _UP)
        seat[:3, 3] = moved[-1] + rest[-1] * _UP
        return [
            Surface(wall, np.repeat(colour, FACETS, axis=0)),
            Surface(self._assembly.moved(seat), rgb(RNA_COLOUR)),
        ]

    def _arrow(self, place: Array, vector: Array, width: float, colour: int) -> list[Surface]:
        """An arrow from a place along a vector in m; none where it is too short."""
        if np.linalg.norm(vector) < _SHORTEST:
            return []
        pose = np.eye(4)
        pose[:3, :3] = smallest_turn(_UP, vector)
        pose[:3, 3] = place
        pose[:3, 2] = vector
        return [Surface(arrow(width * self._size).moved(pose), rgb(colour))]

    def _soil(self, moved: Array, forces: Array) -> list[Surface]:
        arrows = []
        unit = ARROW_SHARE * self._size / (self._soil_force or 1.0)
        for height, force in zip(self.shown.soil_height, forces, strict=True):
            on_axis = [np.interp(height, self.shown.height, column) for column in moved.T]
            outwards = self._pile * force / (np.linalg.norm(force) or 1.0)
            place = np.array(on_axis) + height * _UP + outwards
            arrows += self._arrow(place, unit * force, SOIL_WIDTH, SOIL_COLOUR)
        return arrows

    def _top(self, moved: Array, force: Array) -> list[Surface]:
        place = moved + self.shown.height[-1] * _UP
        vector = ARROW_SHARE * self._size / (self._top_force or 1.0) * force
        drawn = self._arrow(place, vector, TOP_WIDTH, TOP_COLOUR)
        self._tag.set_visible(bool(drawn))
        tip = self.camera.project(place + 1.06 * vector)
        leftwards = tip[0] < self.camera.project(place)[0]
        self._tag.set_horizontalalignment("right" if leftwards else "left")
        self._tag.set_position((tip[0], tip[1]))
        self._tag.set_text(f"{np.linalg.norm(force) / 1e6:.2f} MN")
        return drawn

    def _sea(self, at: Callable[[Array], Array]) -> list[Surface]:
        """The surface, and its sides down to the mudline."""
        if self._dry:
            return []
        x, y, sea = self.shown.x, self.shown.y, self.shown.sea
        if sea is None:
            x = y = self._side
        mesh = surface_mesh(x, y, self._level)
        low, colour, high = SEA_COLOURS
        opacity = 0.6
        if sea is not None:
            height, opacity = at(sea).ravel(), 0.72
            mesh.vertices[:, 2] += height
            share = (height / max(float(np.abs(sea).max()), 1e-3))[:, None]
            colour = colour + np.abs(share) * (np.where(share > 0, high, low) - colour)
        sides = sides_mesh(mesh, rim_of(len(x), len(y)), self._mudline)
        return [Surface(sides, rgb(WATER_COLOUR), 0.13), Surface(mesh, colour, opacity)]

    def _write(self, results: xr.Dataset) -> None:
        """Words, colour bar and curves."""
        attrs = results.attrs
        waves = "" if self._dry else str(attrs.get("waves", ""))
        self.head(results, str(attrs.get("case", "time history")), waves)
        self._now = self.text(0.86, "", fontsize=9.5)
        self._cursors = []
        time, channels = curves(results, self.shown)
        for i, (name, values) in enumerate(channels):
            axes = self.strip(0.70 - 0.135 * i, 0.085, name, range_in_words(values))
            axes.plot(time, values, color=BLUE, linewidth=1)
            axes.set_xlim(time[0], time[-1])
            self._cursors.append(axes.axvline(time[0], color=MARK, linewidth=1.2))
        self.colour_bar(0.175, f"bending moment, 0 to {number(self._bending / 1e6, 3)} MN m")
        if self._soil_force:
            most = f"soil on the pile, at most {number(self._soil_force / 1e6, 3)} MN per node"
            self.text(0.12, most, fontsize=8, color=css(SOIL_COLOUR))
        scale = f"displacements {TIMES} {self.factor}" + (
            "" if self._dry else "; the sea is to scale"
        )
        self.text(0.09 if self._soil_force else 0.12, scale, fontsize=8, color=FAINT)
