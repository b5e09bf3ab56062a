"""Static states and natural modes as labelled datasets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from offwind_pin.results.dataset import FRAME, SECTION, versions

Array = NDArray[np.float64]

_DIRECTIONS = ["x", "y", "z"]


def static_dataset(
    height: Array,
    *,
    displacement: Array,
    rotation: Array,
    section_load: Array,
    attributes: dict[str, Any],
) -> xr.Dataset:
    """A static state over height (m,) in m.

    displacement, rotation (m, 3) in m and rad; section_load (m, 6) in N and N m.
    """
    along = ("height", "direction")
    return xr.Dataset(
        {
            "displacement": (along, displacement, {"units": "m", "frame": FRAME}),
            "rotation": (along, rotation, {"units": "rad", "frame": FRAME}),
            "section_force": (
                along,
                section_load[:, :3],
                {"long_name": f"section force: {SECTION}", "units": "N", "frame": FRAME},
            ),
            "section_moment": (
                along,
                section_load[:, 3:],
                {"long_name": f"section moment: {SECTION}", "units": "N m", "frame": FRAME},
            ),
        },
        coords={"height": ("height", height, {"units": "m"}), "direction": _DIRECTIONS},
        attrs={"title": "offwind-pin static state", **versions(), **attributes},
    )


def modal_dataset(
    height: Array,
    label: list[str],
    *,
    frequency_hz: Array,
    damping_ratio: Array,
    shape: Array,
    mass_normalised: Array,
    attributes: dict[str, Any],
    constants: Mapping[str, tuple[str, Array, dict[str, str]]],
) -> xr.Dataset:
    """Natural modes (n,) with shapes (n, m, 6) over height (m,) in m.

    constants : what else a picture needs, by name: dimension, values, attributes
    """
    along = ("mode", "height", "motion")
    return xr.Dataset(
        {
            "frequency": ("mode", frequency_hz, {"long_name": "natural frequency", "units": "Hz"}),
            "damping_ratio": ("mode", damping_ratio, {"units": "1"}),
            "shape": (along, shape, {"long_name": "shape with unit peak", "frame": FRAME}),
            "mass_normalised": (
                along,
                mass_normalised,
                {"long_name": "shape with unit modal mass", "frame": FRAME},
            ),
            **constants,
        },
        coords={
            "mode": label,
            "height": ("height", height, {"units": "m"}),
            "motion": ["x", "y", "z", "rx", "ry", "rz"],
        },
        attrs={"title": "offwind-pin natural modes", **versions(), **attributes},
    )
