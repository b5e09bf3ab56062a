"""Natural modes as a picture, side by side."""

from __future__ import annotations

import numpy as np
import xarray as xr

from offwind_pin.base.definition import Array
from offwind_pin.base.mode_labels import mode_name
from offwind_pin.display.rotor_nacelle import assembly
from offwind_pin.display.viewer.mode_frames import Shapes, carried
from offwind_pin.display.viewer.modes_page import (
    damper_meshes,
    modes_look,
    site_meshes,
    springs_in_words,
    water_in_words,
)
from offwind_pin.display.viewer.painter import Surface, smallest_turn
from offwind_pin.display.viewer.picture import FAINT, TEXT, Picture
from offwind_pin.display.viewer.scene import (
    DAMPER_COLOUR,
    RNA_COLOUR,
    SPRING_COLOUR,
    colour_ramp,
    rgb,
)
from offwind_pin.display.viewer.springs import spring_symbol
from offwind_pin.display.wording import number
from offwind_pin.structure.meshes import FACETS, Mesh, circle, loft

_ALONG = np.array([1.0, 0.0, 0.0])
"""Direction of the symbol of a spring."""


class ModesPicture(Picture):
    """Modes side by side, ``speed`` times as fast as in reality.

    ``show(np.inf)`` has each of them at its peak.
    """

    def __init__(self, results: xr.Dataset, shown: Shapes, chosen: list[int], speed: float) -> None:
        look = modes_look(results, shown)
        off = (np.arange(len(chosen)) - (len(chosen) - 1) / 2) * look["spacing"]
        super().__init__(look, look["half_breadth"] + float(off[-1]))
        self.shown, self.chosen, self.speed = shown, chosen, speed
        self._place = off[:, None] * [*look["right"], 0.0]
        self._assembly = Mesh.combine(list(assembly(results, 2 * float(shown.radius[-1])).values()))
        self._rings = np.array([circle(r, 0.0) for r in shown.radius])
        self._dampers = damper_meshes(shown)
        self._symbol = spring_symbol(results, shown.size)
        self._site = list(site_meshes(results, shown).values())
        self._write(results, look["low"])

    def show(self, now: float) -> None:
        surfaces = []
        for mode, place in zip(self.chosen, self._place, strict=True):
            turn = 2 * np.pi * self.shown.frequency_hz[mode] * self.speed * now
            factor = 1.0 if np.isinf(now) else float(np.sin(turn))
            for surface in [
                *self._structure(mode, factor),
                *self._attached(mode, factor),
                *(Surface(mesh, rgb(colour), share) for mesh, colour, share in self._site),
            ]:
                moved = surface.mesh.moved(_pose(np.eye(3), place))
                surfaces.append(Surface(moved, surface.colour, surface.opacity))
        self.paint(surfaces)

    def _structure(self, mode: int, factor: float) -> list[Surface]:
        shown, motion = self.shown, factor * self.shown.motion[mode]
        rings, turns = carried(motion, shown.height, self._rings)
        top, _ = carried(motion[-1:], shown.height[-1:], np.zeros((1, 3)))
        ramp = colour_ramp()
        share = np.clip(shown.share[mode], 0, 1)
        colour = np.repeat(ramp[np.round(share * (len(ramp) - 1)).astype(int)], FACETS, axis=0)
        if shown.family[mode] == "T":  # stripes, without which one would not see it turn
            colour[np.arange(len(colour)) % (FACETS // 4) < 2] *= 0.25
        return [
            Surface(loft(rings, capped=False), colour),
            Surface(self._assembly.moved(_pose(turns[-1], top[0])), rgb(RNA_COLOUR)),
        ]

    def _attached(self, mode: int, factor: float) -> list[Surface]:
        """Springs and tuned mass dampers."""
        shown, springs = self.shown, self.shown.springs[mode]
        meshes = []
        motion = factor * shown.motion_at(springs.height)[mode]
        ends, _ = carried(motion, springs.height, springs.offset)
        for middle, along in zip(*springs.symbols(ends), strict=True):
            pose = _pose(smallest_turn(_ALONG, along), middle)
            pose[:3, 0] = along
            meshes.append(Surface(self._symbol.moved(pose), rgb(SPRING_COLOUR)))
        motion = factor * shown.motion_at(shown.damper_height)[mode]
        masses, turns = carried(motion, shown.damper_height, factor * shown.stroke[mode])
        for mesh, turn, mass in zip(self._dampers, turns, masses, strict=True):
            meshes.append(Surface(mesh.moved(_pose(turn, mass)), rgb(DAMPER_COLOUR)))
        return meshes

    def _write(self, results: xr.Dataset, low: float) -> None:
        shown = self.shown
        self.head(results, "Natural modes", water_in_words(results) or "dry")
        for i, (mode, place) in enumerate(zip(self.chosen, self._place, strict=True)):
            label = shown.label[mode]
            numbers = f"{number(shown.frequency_hz[mode])} Hz, "
            numbers += f"{number(100 * shown.damping_ratio[mode], 3)} %"
            y = 0.80 - 0.115 * i
            self.text(y, label, fontsize=13, weight="bold")
            self.text(y - 0.004, numbers, indent=0.06, fontsize=11)
            words = f"{mode_name(label)}, peak drawn as {shown.peak_in_words(mode)}"
            self.text(y - 0.042, words, fontsize=9, fit=46, color=FAINT)
            seen = self.camera.project(place + np.array([0.0, 0.0, low]))
            self.scene.text(
                seen[0], seen[1], f"{label}\n{numbers}", ha="center", va="top",
                fontsize=10, color=TEXT, linespacing=1.4,
            )  # fmt: skip
        self.colour_bar(0.20, "displacement (torsion: rotation) over its peak")
        springs = springs_in_words(results, shown.size)
        self.text(0.13, "Mode-shape amplitude is arbitrary.", fontsize=8, color=FAINT)
        if springs:
            self.text(0.105, f"Grey symbols: {springs}", fontsize=8, color=FAINT)


def _pose(turn: Array, place: Array) -> Array:
    """(4, 4) homogeneous transform."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = turn, place
    return pose
