"""A mode as a page of its own: meshcat's viewer, the scene and the numbers in one HTML text."""

from __future__ import annotations

import base64
from functools import cache
from typing import Any

import jinja2
import matplotlib as mpl
import numpy as np
from markupsafe import Markup

from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.analysis.modal import ModalResult
from offwind_pin.base.mode_labels import mode_name
from offwind_pin.display.viewer.meshcat_recorder import Recorder, viewer_licence, viewer_script
from offwind_pin.display.viewer.mode_motion import ModeMotion, mode_motion
from offwind_pin.display.viewer.scene import (
    AXIS_COLOUR,
    COLOUR_MAP,
    CYCLE,
    MUDLINE_COLOUR,
    SPRING_COLOUR,
    WATER_COLOUR,
    draw_mode,
    view_extent,
)
from offwind_pin.display.viewer.springs import node_step
from offwind_pin.display.wording import foundation_name, water_level_name
from offwind_pin.dynamics.system import System

_FIELD_OF_VIEW_DEG = 24.0
_VIEW_DEG = {"FA": (-124.0, 7.0), "SS": (-150.0, 7.0), "T": (-140.0, 14.0), "V": (-124.0, 7.0)}
"""Azimuth of the camera from the x axis, and its elevation: each motion is seen nearly broadside,
from upwind, with the rotor turned enough to be recognisable."""


def animate(system: System, result: ModalResult, label: str) -> str:
    """HTML page that shows one mode of a system in motion; it needs no server and no network.

    The peak is drawn as 8 % of the structure's height, or as less where the axis would tilt by more
    than 35 degrees; a torsional mode turns by 30 degrees.

    Parameters
    ----------
    result : ModalResult
        Modes of this system.
    label : str
        Which of them, such as ``"FA2"``.

    Raises
    ------
    InputError
        No mode of that label among those computed.
    """
    motion = mode_motion(system, result, label)
    recorder = Recorder()
    draw_mode(recorder.visualizer(), system, motion)
    index = result.index(label)
    return _template().render(
        turbine=system.turbine.name,
        foundation=system.foundation.name.replace("_", " "),
        surrogate=system.foundation.surrogate,
        wet=system.sea is not None,
        water=water_level_name(0.0 if system.sea is None else system.sea.water_level),
        springs=_springs_in_words(system),
        label=label,
        name=mode_name(label),
        frequency_hz=float(result.frequency_hz[index]),
        damping_ratio=float(result.damping_ratio[index]),
        cycle=CYCLE,
        look=_look(system, motion),
        commands=[base64.b64encode(command).decode() for command in recorder.commands],
        licence=Markup(viewer_licence().replace("*/", "* /")),  # noqa: S704 (from the package)
        viewer_script=Markup(viewer_script()),  # noqa: S704 (from the package)
        **_scales(motion),
    )


def _springs_in_words(system: System) -> str:
    """What the spring symbols stand for; empty where there are none."""
    soil = soil_springs(system)
    if soil is None:
        return "" if system.foundation.root is None else foundation_name(system.foundation.name)
    step = node_step(soil, system.chain.top - system.chain.base)
    return "soil springs" if step == 1 else f"soil springs (one in {step} drawn)"


def _scales(motion: ModeMotion) -> dict[str, str]:
    """What colours and sizes mean."""
    torsion = motion.family == "T"
    steps = mpl.colormaps[COLOUR_MAP](np.linspace(0, 1, 17))
    return {
        "quantity": "rotation" if torsion else "displacement",
        "peak": f"{np.degrees(motion.peak):.0f}°" if torsion else f"{motion.peak:.1f} m",
        "gradient": ", ".join(mpl.colors.to_hex(step) for step in steps),
        "water_colour": f"#{WATER_COLOUR:06x}",
        "mudline_colour": f"#{MUDLINE_COLOUR:06x}",
        "axis_colour": f"#{AXIS_COLOUR:06x}",
        "spring_colour": f"#{SPRING_COLOUR:06x}",
    }


def _look(system: System, motion: ModeMotion) -> dict[str, Any]:
    """Where the camera stands, for the page's script: directions as numbers, lengths in m."""
    low, high, breadth = view_extent(system)
    azimuth, elevation = np.radians(_VIEW_DEG[motion.family])
    level = np.cos(elevation)
    return {
        "field_of_view_deg": _FIELD_OF_VIEW_DEG,
        "from": [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)],
        "centre": (low + high) / 2,
        "half_height": (high - low) / 2,
        "half_breadth": breadth,
    }


@cache
def _template() -> jinja2.Template:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("offwind_pin.display"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
    )
    return environment.get_template("animation.html")
