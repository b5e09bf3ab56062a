"""The channels of every time history, in one table.

Integrators return the records that it names, the dataset and the NetCDF file are made from its
rows, and the page on case files prints it. A run has the channels whose dimensions it has. Loads
declare further channels of their own.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import xarray as xr

from offwind_pin.base.channels import Channel

SECTION = "what the part above the section exerts on the part below"


_FORCE, _MOMENT = np.s_[..., :3], np.s_[..., 3:]
_ALONG, _TOP = ("height", "direction"), ("direction",)


def _along(name: str, units: str, long_name: str, record: str, part: Any = ...) -> Channel:
    return Channel(name, _ALONG, units, long_name, "float32", record=record, part=part)


def _scalar(
    name: str,
    units: str,
    long_name: str,
    record: str,
    *dims: str,
    dtype: Literal["float64", "int32"] = "float64",
) -> Channel:
    return Channel(name, dims, units, long_name, dtype, frame="", record=record)


def _at_mudline(
    name: str, units: str, long_name: str, kind: Literal["F", "M"], part: Any
) -> Channel:
    return Channel(
        name,
        _TOP,
        units,
        long_name,
        openfast_alias=" ".join(f"-React{kind}{axis}ss" for axis in "XYZ"),
        record="section_load",
        at="mudline",
        part=part,
    )


CHANNELS = (
    _along("displacement", "m", "displacement of the axis, absolute", "displacement"),
    _along("acceleration", "m/s2", "acceleration of the axis, absolute", "acceleration"),
    _along("section_force", "N", f"section force: {SECTION}", "section_load", _FORCE),
    _along(
        "section_moment",
        "N m",
        f"section moment: {SECTION}; y is fore-aft",
        "section_load",
        _MOMENT,
    ),
    Channel(
        "tower_top_displacement",
        _TOP,
        "m",
        "displacement of the yaw bearing",
        openfast_alias="YawBrTDxp YawBrTDyp YawBrTDzp",
        record="displacement",
        at="tower_top",
    ),
    _at_mudline("mudline_moment", "N m", f"moment at the mudline: {SECTION}", "M", _MOMENT),
    _at_mudline("mudline_force", "N", f"force at the mudline: {SECTION}", "F", _FORCE),
    Channel(
        "segment_imbalance",
        ("segment", "component"),
        "N for F, N m for M",
        "imbalance of section loads, applied loads and inertia of a segment; moments about its "
        "lower end",
        "float32",
        record="imbalance",
    ),
    Channel(
        "inertial_damping_load",
        ("height", "resultant"),
        "N for the force, N m for the moment",
        "size of what structural damping against the inertial frame contributes to section loads",
        "float32",
        frame="",
        record="inertial_load",
    ),
    Channel(
        "soil_force",
        ("soil_node", "direction"),
        "N",
        "force of the soil springs and dashpots on the pile at each node",
        "float32",
        record="soil_force",
    ),
    Channel(
        "tuned_mass_displacement",
        ("damper", "across"),
        "m",
        "displacement of a tuned mass relative to its carrier",
        "float32",
        frame="x and y of the carrier",
        record="stroke",
    ),
    *(
        Channel(
            f"ground_{name}",
            ("level", "direction"),
            units,
            f"{name} of the ground",
            record="ground_motion",
            part=np.s_[:, :, i],
        )
        for i, (name, units) in enumerate(
            [("displacement", "m"), ("velocity", "m/s"), ("acceleration", "m/s2")]
        )
    ),
    _scalar("energy_stored", "J", "stored energy", "stored", "holder"),
    _scalar("energy_dissipated", "J", "energy dissipated since the start", "dissipated", "sink"),
    _scalar(
        "energy_worked",
        "J",
        "work done by loads and by the moving ground since the start",
        "worked",
        "source",
    ),
    _scalar(
        "energy_balance",
        "J",
        "change of stored energy plus dissipated energy minus work done",
        "balance",
    ),
    _scalar("solver_step", "s", "time step; NaN if chosen by the solver", "step"),
    _scalar("solver_iterations", "1", "Newton iterations in the step", "iterations", dtype="int32"),
    _scalar("solver_residual", "1", "largest residual relative to the load scale", "residual"),
)

COORDINATES = {
    "time": {"long_name": "simulated time", "units": "s"},
    "height": {"long_name": "undeformed height", "units": "m"},
    "direction": {"long_name": "axis of the inertial frame"},
    "component": {"long_name": "component of a load"},
    "segment": {"long_name": "heights of the ends of the segment"},
    "holder": {"long_name": "kind of stored energy"},
    "sink": {"long_name": "what dissipates energy"},
    "source": {"long_name": "what does work on the structure"},
    "level": {"long_name": "height at which the ground motion is recorded", "units": "m"},
    "soil_node": {"long_name": "undeformed height of the soil node", "units": "m"},
    "damper": {"long_name": "tuned mass damper"},
    "across": {"long_name": "axis of the carrier"},
    "resultant": {"long_name": "section force or section moment"},
}
"""Attributes of the coordinates of a time history."""


def channel_fault(histories: xr.Dataset) -> str | None:
    """What in a dataset of time histories differs from the table; None where nothing does."""
    if "time" not in histories.variables:
        return "no times"
    time = histories["time"].to_numpy()
    if time.dtype.kind != "f" or not np.all(np.diff(time) > 0) or not np.all(np.isfinite(time)):
        return "times that are not numbers in rising order"
    for channel in CHANNELS:
        if channel.name not in histories:  # of a dimension that the run lacks, or not kept
            continue
        found = histories[channel.name]
        for what, is_there, declared in (
            ("dimensions", found.dims, ("time", *channel.dims)),
            ("units", found.attrs.get("units"), channel.units),
            ("type", found.dtype.kind, np.dtype(channel.dtype).kind),
        ):
            if is_there != declared:
                return f"channel {channel.name}, {what} {is_there}, not {declared}"
    return None
