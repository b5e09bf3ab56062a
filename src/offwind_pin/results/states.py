"""Static states and natural modes as labelled datasets."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from offwind_pin.base.channels import FRAME
from offwind_pin.base.mode_labels import DAMPING_PARTS
from offwind_pin.results.channels import SECTION
from offwind_pin.results.dataset import versions
from offwind_pin.results.tree import TITLES

Array = NDArray[np.float64]

DIRECTIONS = ("direction", ["x", "y", "z"], {"long_name": "axis of the inertial frame"})
_MOTIONS = ["x", "y", "z", "rx", "ry", "rz"]
_HEIGHT = {"long_name": "undeformed height", "units": "m"}
_MIXED = "m for translations, rad for rotations"


def static_dataset(
    height: Array,
    *,
    displacement: Array,
    rotation: Array,
    section_load: Array,
    joint_displacement: Array,
    memory: Array,
    iterations: int,
    residual: float,
    mudline: float,
    engine: str,
    loads: Sequence[str],
) -> xr.Dataset:
    """A static state over height.

    Parameters
    ----------
    height : (m,) array, m
    displacement : (m, 3) array, m
    rotation : (m, 3) array, rad
    section_load : (m, 6) array, N and N m
    joint_displacement : (nv,) array, m and rad
    memory : (k,) array
        State of soil and foundation.
    mudline : float, m
    engine : str
        Engine that evaluated the equations.
    loads : sequence of str
        Names of the applied loads.
    """
    along = ("height", "direction")
    variables = {
        "displacement": (along, displacement, _about("displacement of the axis", "m")),
        "rotation": (along, rotation, _about("rotation of the axis", "rad")),
        "section_force": (along, section_load[:, :3], _about(f"section force: {SECTION}", "N")),
        "section_moment": (along, section_load[:, 3:], _about(f"section moment: {SECTION}", "N m")),
        "joint_displacement": (
            "joint",
            joint_displacement,
            {"long_name": "displacement of the joints", "units": _MIXED},
        ),
    }
    if len(memory):
        remembered = {"long_name": "state variables of soil and foundation", "units": "various"}
        variables["memory"] = ("memory_entry", memory, remembered)
    return xr.Dataset(
        variables,
        {"height": ("height", height, _HEIGHT), "direction": DIRECTIONS},
        {
            "title": TITLES["static"],
            **versions(),
            "mudline_m": mudline,
            "engine": engine,
            "iterations": iterations,
            "residual": residual,
            "loads": json.dumps(list(loads)),
        },
    )


def modal_dataset(
    height: Array,
    label: list[str],
    *,
    frequency_hz: Array,
    damping_ratio: Array,
    damping_parts: Array,
    damping_asked: Array,
    shape: Array,
    mass_normalised: Array,
    participation: Array,
    families: Sequence[str],
    damper_share: Array,
    vector: Array,
    peak_height_ratio: Array,
    engine: str,
) -> xr.Dataset:
    """Natural modes over height.

    Parameters
    ----------
    height : (m,) array, m
    label : list of str
        Labels of the n modes.
    frequency_hz, damping_ratio : (n,) array
    damping_parts : (n, 4) array
        Contributions of structure, soil, water and everything else.
    damping_asked : (n,) array
        NaN for modes without a ratio in the turbine file.
    shape, mass_normalised : (n, m, 6) array
    participation : (n, f) array
        Participation of the f families of joints.
    damper_share, peak_height_ratio : (n,) array
    vector : (nv, n) array
    engine : str
        That evaluated the equations.
    """
    along = ("mode", "height", "motion")
    about = {
        "frequency": ("mode", frequency_hz, "natural frequency", "Hz"),
        "damping_ratio": ("mode", damping_ratio, "damping ratio, of critical", "1"),
        "damping_parts": (
            ("mode", "damping_part"),
            damping_parts,
            "contribution to the damping ratio, of critical",
            "1",
        ),
        "damping_asked": (
            "mode",
            damping_asked,
            "structural damping ratio asked for, of critical; NaN for none",
            "1",
        ),
        "shape": (along, shape, "mode shape with unit peak", "1"),
        "mass_normalised": (
            along,
            mass_normalised,
            "mode shape with unit modal mass",
            "kg^-1/2 for translations, rad kg^-1/2 m^-1 for rotations",
        ),
        "participation": (
            ("mode", "family"),
            participation,
            "share of the potential energy by family",
            "1",
        ),
        "damper_share": (
            "mode",
            damper_share,
            "share of the potential energy in tuned mass dampers",
            "1",
        ),
        "joint_shape": (
            ("joint", "mode"),
            vector,
            "mass-normalised joint displacements",
            "kg^-1/2 for translations, rad kg^-1/2 m^-1 for rotations",
        ),
        "peak_height_ratio": (
            "mode",
            peak_height_ratio,
            "height of the peak, mudline 0, yaw bearing 1",
            "1",
        ),
    }
    return xr.Dataset(
        {
            name: (dims, values, {"long_name": text, "units": units})
            for name, (dims, values, text, units) in about.items()
        },
        {
            "mode": ("mode", label, {"long_name": "label of the mode"}),
            "height": ("height", height, _HEIGHT),
            "motion": ("motion", _MOTIONS, {"long_name": "displacement or rotation of the axis"}),
            "damping_part": (
                "damping_part",
                list(DAMPING_PARTS),
                {"long_name": "what contributes to the damping ratio"},
            ),
            "family": ("family", list(families), {"long_name": "family of joints"}),
        },
        {"title": TITLES["modes"], **versions(), "frame": FRAME, "engine": engine},
    )


def _about(name: str, units: str) -> dict[str, str]:
    return {"long_name": name, "units": units, "frame": FRAME}
