"""Time histories as a labelled dataset with units, frames and provenance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from offwind_pin.base.whole_files import append_netcdf
from offwind_pin.results.blocks import Block, BlockStore
from offwind_pin.results.tree import TITLES

Array = NDArray[np.float64]

FRAME = "inertial: x downwind, y left looking downwind, z up from still water level"
SECTION = "what the part above the section exerts on the part below"

HOLDERS = ("kinetic", "gravitational", "elastic", "foundation")
SINKS = ("joint_dampers", "foundation")
"""What holds and what takes up energy besides the loads."""


@dataclass(frozen=True, eq=False)
class HistoryWriter:
    """Makes datasets, in memory or in a file, out of the blocks of a time history.

    Attributes
    ----------
    mudline : float, m
        Height.
    height : (m,) array, m
        Heights of the records.
    segments : sequence of (float, float), m
        Pairs of heights between which equilibrium is checked.
    loads : sequence of str
        Names of the loads.
    stores : (L,) bool array
        Whether each stores energy rather than works.
    attributes : dict of str to object
        Of the dataset.
    constants : mapping of str to (str, array, dict of str to str)
        What does not change with time, by name: dimension, values, attributes.
    levels : (D,) array, m
        Heights at which the ground's motion is recorded; none without an earthquake.
    dampers : mapping of str to float, m
        Travel of each tuned mass damper by its name.
    soil : (n,) array, m
        Heights of the nodes of the soil; none where no soil acts along the pile.
    load_channels : mapping of str to (tuple of str, str, str)
        Of the loads, by name: dimensions after time, name in words, units.
    """

    mudline: float
    height: Array
    segments: Sequence[tuple[float, float]]
    loads: Sequence[str]
    stores: NDArray[np.bool_]
    attributes: dict[str, Any]
    constants: Mapping[str, tuple[str, Array, dict[str, str]]] = field(default_factory=dict)
    levels: Array = field(default_factory=lambda: np.zeros(0))
    dampers: Mapping[str, float] = field(default_factory=dict)
    soil: Array = field(default_factory=lambda: np.zeros(0))
    load_channels: Mapping[str, tuple[tuple[str, ...], str, str]] = field(default_factory=dict)

    def write(self, store: BlockStore, status: str, directory: Path | str | None) -> xr.Dataset:
        """Dataset of all blocks; with a directory it stands in ``results.nc`` there.

        No more than one block is in memory at a time if the dataset goes to a file.
        """
        start = np.sum(next(iter(store))["stored"][0]) if len(store) else 0.0
        if directory is None:
            blocks = list(store)
            records = [name for name in blocks[0] if not name.startswith("state_")]
            whole = {name: np.concatenate([block[name] for block in blocks]) for name in records}
            return self._dataset(whole, status, start)
        path = Path(directory) / "results.nc"
        for left_by_a_kill in path.parent.glob(".results.*.nc"):
            left_by_a_kill.unlink()
        append_netcdf(path, (self._dataset(block, status, start) for block in store))
        return xr.open_dataset(path, engine="netcdf4")

    def _dataset(self, block: Block, status: str, start: float) -> xr.Dataset:
        """Channels of one block; start is the energy stored at the beginning in J."""
        at_mudline = int(np.argmin(np.abs(self.height - self.mudline)))
        load, displacement = block["section_load"], block["displacement"]
        along, top = ("time", "height", "direction"), ("time", "direction")
        stored, dissipated, worked = (block[name] for name in ("stored", "dissipated", "worked"))
        balance = stored.sum(axis=1) - start + dissipated.sum(axis=1) - worked.sum(axis=1)
        holders = [True] * len(HOLDERS) + list(self.stores)
        shaken = len(self.levels) > 0
        sources = [shaken, False, *~self.stores]
        channels = {
            "displacement": (
                along,
                displacement,
                _about("displacement of the axis, absolute", "m"),
            ),
            "acceleration": (
                along,
                block["acceleration"],
                _about("acceleration of the axis, absolute", "m/s2"),
            ),
            "section_force": (along, load[..., :3], _about(f"section force: {SECTION}", "N")),
            "section_moment": (
                along,
                load[..., 3:],
                _about(f"section moment: {SECTION}; y is fore-aft", "N m"),
            ),
            "tower_top_displacement": (
                top,
                displacement[:, -1],
                _about("displacement of the yaw bearing", "m", "YawBrTDxp YawBrTDyp YawBrTDzp"),
            ),
            "mudline_moment": (
                top,
                load[:, at_mudline, 3:],
                _about(
                    f"moment at the mudline: {SECTION}", "N m", "-ReactMXss -ReactMYss -ReactMZss"
                ),
            ),
            "mudline_force": (
                top,
                load[:, at_mudline, :3],
                _about(f"force at the mudline: {SECTION}", "N", "-ReactFXss -ReactFYss -ReactFZss"),
            ),
            "segment_imbalance": (
                ("time", "segment", "component"),
                block["imbalance"],
                _about(
                    "imbalance of section loads, applied loads and inertia of a segment; "
                    "moments about its lower end",
                    "N for F, N m for M",
                ),
            ),
            "tower_top_load": (
                ("time", "component"),
                block["tower_top_load"],
                _about("load applied at the yaw bearing", "N for F, N m for M"),
            ),
            "wave_elevation": (
                ("time",),
                block["wave_elevation"],
                _about(
                    "surface elevation of the undisturbed wave at x = 0, relative to the mean "
                    "water level",
                    "m",
                    "Wave1Elev",
                ),
            ),
            "energy_stored": (
                ("time", "holder"),
                stored[:, holders],
                {"long_name": "stored energy", "units": "J"},
            ),
            "energy_dissipated": (
                ("time", "sink"),
                dissipated,
                {"long_name": "energy dissipated since the start", "units": "J"},
            ),
            "energy_worked": (
                ("time", "source"),
                worked[:, sources],
                {
                    "long_name": "work done by loads and by the moving ground since the start",
                    "units": "J",
                },
            ),
            "energy_balance": (
                ("time",),
                balance,
                {
                    "long_name": "change of stored energy plus dissipated energy minus work done",
                    "units": "J",
                },
            ),
            "solver_step": (
                ("time",),
                block["step"],
                {"long_name": "time step; NaN if chosen by the solver", "units": "s"},
            ),
            "solver_iterations": (
                ("time",),
                block["iterations"],
                {"long_name": "Newton iterations in the step", "units": "1"},
            ),
            "solver_residual": (
                ("time",),
                block["residual"],
                {"long_name": "largest residual relative to the load scale", "units": "1"},
            ),
        }
        if block["inertial_load"].shape[1]:
            part = "that structural damping against the inertial frame contributes, its size"
            inertial = block["inertial_load"]
            channels["inertial_damping_force"] = (
                ("time", "height"),
                inertial[..., 0],
                _about(f"section force {part}", "N"),
            )
            channels["inertial_damping_moment"] = (
                ("time", "height"),
                inertial[..., 1],
                _about(f"section moment {part}", "N m"),
            )
        if len(self.soil):
            channels["soil_force"] = (
                ("time", "soil_node", "direction"),
                block["soil_force"],
                _about("force of the soil springs and dashpots on the pile at each node", "N"),
            )
        if self.dampers:
            channels["tuned_mass_displacement"] = (
                ("time", "damper", "across"),
                block["stroke"],
                {
                    "long_name": "displacement of a tuned mass relative to its carrier",
                    "units": "m",
                    "frame": "x and y of the carrier",
                },
            )
            channels["tuned_mass_travel"] = (
                ("damper",),
                np.array(list(self.dampers.values())),
                {"long_name": "available travel of a tuned mass damper", "units": "m"},
            )
        for name, (dims, about, unit) in self.load_channels.items():
            if name not in channels:
                channels[name] = (("time", *dims), block[name], _about(about, unit))
        names = np.array([*HOLDERS, *self.loads])
        coordinates = {
            "time": ("time", block["time"], {"long_name": "simulated time", "units": "s"}),
            "height": ("height", self.height, {"long_name": "undeformed height", "units": "m"}),
            "direction": _names("direction", ["x", "y", "z"], "axis of the inertial frame"),
            "component": _names(
                "component", ["Fx", "Fy", "Fz", "Mx", "My", "Mz"], "component of a load"
            ),
            "segment": _names(
                "segment",
                [f"{low:g} to {high:g} m" for low, high in self.segments],
                "heights of the ends of the segment",
            ),
            "holder": _names("holder", names[holders].tolist(), "kind of stored energy"),
            "sink": _names("sink", [*SINKS, *self.loads], "what dissipates energy"),
            "source": _names(
                "source",
                np.array(["ground", "", *self.loads])[sources].tolist(),
                "what does work on the structure",
            ),
        }
        if shaken:
            channels |= _ground_channels(block["ground_motion"])
            of_level = {"long_name": "height at which the ground motion is recorded", "units": "m"}
            coordinates["level"] = ("level", self.levels, of_level)
        if len(self.soil):
            of_node = {"long_name": "undeformed height of the soil node", "units": "m"}
            coordinates["soil_node"] = ("soil_node", self.soil, of_node)
        if self.dampers:
            coordinates["damper"] = _names("damper", list(self.dampers), "tuned mass damper")
            coordinates["across"] = _names("across", ["x", "y"], "axis of the carrier")
        attributes = {
            "title": TITLES["histories"],
            **versions(),
            "frame": FRAME,
            "mudline_m": self.mudline,
            **self.attributes,
            "status": status,
        }
        return xr.Dataset({**channels, **self.constants}, coordinates, attributes)


def _ground_channels(motion: Array) -> dict[str, Any]:
    """Channels of the ground's motion (t, D, 3, 3)."""
    along = ("time", "level", "direction")
    units = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s2"}
    return {
        f"ground_{name}": (along, motion[:, :, i], _about(f"{name} of the ground", unit))
        for i, (name, unit) in enumerate(units.items())
    }


def versions() -> dict[str, str]:
    """Versions of the programs that made a result."""
    return {
        "offwind_pin_version": metadata.version("offwind-pin"),
        "pinocchio_version": metadata.version("pin"),
    }


def _names(dimension: str, names: list[str], about: str) -> tuple[str, list[str], dict[str, str]]:
    return dimension, names, {"long_name": about}


def _about(name: str, units: str, alias: str | None = None) -> dict[str, str]:
    attributes = {"long_name": name, "units": units, "frame": FRAME}
    return attributes | ({"openfast_alias": alias} if alias else {})
