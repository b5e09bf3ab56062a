"""Checks of a file that contains only a main dataset, such as one of ``simulate``."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr

from offwind_pin.results.channels import channel_fault
from offwind_pin.results.tree import TITLES

_TEXTS = ("turbine", "foundation", "sea", "root", "case", "waves", "surrogates", "status")
_NUMBERS = ("mudline_m", "water_level_m", "ramp_s", "output_dt_s", "elements")
_REQUIRED: dict[str, tuple[str, ...]] = {
    "histories": ("turbine", "foundation", "mudline_m"),
    "static": (),
    "modes": (),
}
_ALONE: dict[str, dict[str, tuple[str, ...]]] = {
    "static": {"displacement": ("height", "direction"), "section_moment": ("height", "direction")},
    "modes": {"frequency": ("mode",), "shape": ("mode", "height", "motion")},
    "histories": {},
}
"""Variables that a root always has, with their dimensions."""
_PARTS = 2048


def root_fault(data: xr.Dataset, *, values: bool) -> str | None:
    """What makes a dataset unusable as results; None where nothing does.

    Parameters
    ----------
    data : Dataset
        With one of the titles of results.
    values : bool
        Whether all numbers are checked, which takes reading them.
    """
    kind = next(name for name, title in TITLES.items() if title == data.attrs["title"])
    for name, dims in _ALONE[kind].items():
        if name not in data or data[name].dims != dims:
            return f"no variable {name} over {', '.join(dims)}"
    return (
        _attribute_fault(data, _REQUIRED[kind])
        or _coordinate_fault(data)
        or (channel_fault(data) if kind == "histories" else None)
        or (_value_fault(data) if values else None)
    )


def _attribute_fault(data: xr.Dataset, required: tuple[str, ...]) -> str | None:
    for name in required:
        if name not in data.attrs:
            return f"attribute {name} is missing"
    for name, value in data.attrs.items():
        if name in _TEXTS and not isinstance(value, str):
            return f"attribute {name} is no text"
        if name in _NUMBERS and not _is_finite(value):
            return f"attribute {name} is not a finite number"
    try:
        json.loads(data.attrs.get("rotor_nacelle", "{}"))
    except (TypeError, ValueError):
        return "attribute rotor_nacelle is not JSON"
    return None


def _is_finite(value: object) -> bool:
    return isinstance(value, int | float | np.number) and bool(np.isfinite(value))


def _coordinate_fault(data: xr.Dataset) -> str | None:
    for name, variable in data.variables.items():
        if name in data.coords and variable.dtype.kind == "f":
            numbers = variable.values
            if not np.all(np.isfinite(numbers)) or not np.all(np.diff(numbers) > 0):
                return f"coordinate {name} is not of finite numbers in rising order"
        if name in data.dims and variable.dims != (name,):
            return f"coordinate {name} has other dimensions"
    return None


_NAN_WHERE_NONE = ("solver_step", "damping_asked")
"""Variables that are NaN where a solver chose its step, or where no ratio was asked for."""


def _value_fault(data: xr.Dataset) -> str | None:
    for name, variable in data.variables.items():
        if "time" in variable.dims and variable.dtype.kind not in "fi":
            return f"variable {name} is not of numbers"
        if variable.dtype.kind != "f" or name in _NAN_WHERE_NONE:
            continue
        for begin in range(0, variable.shape[0] if variable.ndim else 1, _PARTS):
            part = variable[begin : begin + _PARTS] if variable.ndim else variable
            if not np.all(np.isfinite(part.values)):
                return f"variable {name} has values that are not finite"
    return None
