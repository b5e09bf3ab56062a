"""Time histories as a labelled dataset with units, frames and provenance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib import metadata
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from offwind_pin.base.channels import FRAME, Channel
from offwind_pin.base.errors import InputError
from offwind_pin.base.whole_files import append_netcdf
from offwind_pin.results.blocks import Block, BlockStore
from offwind_pin.results.channels import CHANNELS, COORDINATES
from offwind_pin.results.manifest import RESULTS
from offwind_pin.results.run_folder import RunFolder
from offwind_pin.results.tree import TITLES

Array = NDArray[np.float64]

HOLDERS = ("kinetic", "gravitational", "elastic", "foundation")
SINKS = ("joint_dampers", "foundation")
"""Stores and sinks of energy besides the loads."""

_ENERGIES = ("stored", "dissipated", "worked")
"""Arrays that the energy balance is made of."""


@dataclass(frozen=True, eq=False)
class HistoryWriter:
    """Writes the blocks of a time history as a dataset, in memory or in a file.

    Attributes
    ----------
    mudline : float, m
        Height of the mudline.
    height : (m,) array, m
        Heights of the records.
    segments : sequence of (float, float), m
        Pairs of heights between which equilibrium is checked.
    loads : sequence of str
        Names of the loads.
    stores : (L,) bool array
        Whether each stores energy rather than doing work.
    attributes : dict of str to object
        Attributes of the dataset.
    constants : mapping of str to (str, array, dict of str to str)
        Constants by name: dimension, values, attributes.
    levels : (D,) array, m
        Heights at which the ground's motion is recorded; none without an earthquake.
    dampers : sequence of str
        Names of the tuned mass dampers.
    soil : (n,) array, m
        Heights of the nodes of the soil; none where no soil acts along the pile.
    load_channels : sequence of Channel
        Channels of the loads.
    only : sequence of str, optional
        Names of the channels that are written; all unless given.
    inertial_damping : bool
        Whether structural damping acts against the inertial frame.
    """

    mudline: float
    height: Array
    segments: Sequence[tuple[float, float]]
    loads: Sequence[str]
    stores: NDArray[np.bool_]
    attributes: dict[str, Any]
    constants: Mapping[str, tuple[str, Array, dict[str, str]]] = field(default_factory=dict)
    levels: Array = field(default_factory=lambda: np.zeros(0))
    dampers: Sequence[str] = ()
    soil: Array = field(default_factory=lambda: np.zeros(0))
    load_channels: Sequence[Channel] = ()
    only: Sequence[str] | None = None
    inertial_damping: bool = False

    @cached_property
    def channels(self) -> tuple[Channel, ...]:
        """What is written.

        Raises
        ------
        InputError
            A channel was asked for that the run does not have.
        """
        dimensions = self._coordinates.keys()
        there = [channel for channel in CHANNELS if dimensions >= set(channel.dims)]
        found = {channel.name: channel for channel in (*there, *self.load_channels)}
        for name in self.only or ():
            if name not in found:
                raise InputError("save_at, channels", name, ", ".join(found), "Choose from them.")
        return tuple(
            channel for name, channel in found.items() if self.only is None or name in self.only
        )

    @cached_property
    def records(self) -> set[str]:
        """Names of the arrays of a block that they are made of."""
        names = {"time", *_ENERGIES, *(channel.record or channel.name for channel in self.channels)}
        return names | ({"section_load", "inertial_load"} if self.inertial_damping else set())

    def write(self, store: BlockStore, status: str, folder: RunFolder | None) -> xr.Dataset:
        """Dataset of all blocks; with a folder it is written to ``results.nc`` and read from there.

        With a file, only one block is in memory at a time.
        """
        start = np.sum(next(iter(store))["stored"][0]) if len(store) else 0.0
        if folder is None:
            blocks = list(store)
            records = [name for name in blocks[0] if not name.startswith("state_")]
            whole = {name: np.concatenate([block[name] for block in blocks]) for name in records}
            return self._dataset(whole, status, start)
        dtypes = {channel.name: channel.dtype for channel in self.channels}
        with folder.replacing(RESULTS) as path:
            append_netcdf(path, (self._dataset(block, status, start) for block in store), dtypes)
        return xr.open_dataset(path, engine="netcdf4")

    def _dataset(self, block: Block, status: str, start: float) -> xr.Dataset:
        """Channels of one block; start is the energy stored at the beginning in J."""
        stored, dissipated, worked = (block[name].sum(axis=1) for name in _ENERGIES)
        records = {**block, "balance": stored - start + dissipated - worked}
        channels = {
            channel.name: (
                ("time", *channel.dims),
                channel.values(records, self._index),
                channel.attributes,
            )
            for channel in self.channels
        }
        attributes = {
            "title": TITLES["histories"],
            **versions(),
            "frame": FRAME,
            "mudline_m": self.mudline,
            **self.attributes,
            "status": status,
        }
        coordinates = {"time": ("time", block["time"], COORDINATES["time"]), **self._coordinates}
        return xr.Dataset({**channels, **self.constants}, coordinates, attributes)

    @cached_property
    def _index(self) -> dict[str, Any]:
        """Entries of records that channels keep, see :meth:`Channel.values`."""
        return {
            "tower_top": -1,
            "mudline": int(np.argmin(np.abs(self.height - self.mudline))),
            "holder": [True] * len(HOLDERS) + list(self.stores),
            "source": [len(self.levels) > 0, False, *~self.stores],
        }

    @cached_property
    def _coordinates(self) -> dict[str, Any]:
        """Coordinates of this run besides time."""
        names = np.array([*HOLDERS, *self.loads])
        found: dict[str, Any] = {
            "height": self.height,
            "direction": ["x", "y", "z"],
            "component": ["Fx", "Fy", "Fz", "Mx", "My", "Mz"],
            "segment": [f"{low:g} to {high:g} m" for low, high in self.segments],
            "holder": names[self._index["holder"]].tolist(),
            "sink": [*SINKS, *self.loads],
            "source": np.array(["ground", "", *self.loads])[self._index["source"]].tolist(),
        }
        if len(self.levels):
            found["level"] = self.levels
        if len(self.soil):
            found["soil_node"] = self.soil
        if self.dampers:
            found |= {"damper": self.dampers, "across": ["x", "y"]}
        if self.inertial_damping:
            found["resultant"] = ["force", "moment"]
        return {name: (name, values, COORDINATES[name]) for name, values in found.items()}


def versions() -> dict[str, str]:
    """Versions of the programs that produced a result."""
    return {
        "offwind_pin_version": metadata.version("offwind-pin"),
        "pinocchio_version": metadata.version("pin"),
    }
