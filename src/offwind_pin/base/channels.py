"""Definition of a channel of a time history, one row of the table of channels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import EllipsisType
from typing import TYPE_CHECKING, Any, Literal

from offwind_pin.base.descriptions import one_line

if TYPE_CHECKING:
    from offwind_pin.base.definition import Array

FRAME = "inertial: x downwind, y left looking downwind, z up from still water level"


@dataclass(frozen=True, repr=False)
class Channel:
    """A quantity over time in the results.

    Attributes
    ----------
    name : str
        Name in the dataset; channels of the same name given by several loads are summed.
    dims : tuple of str
        Dimensions after ``time``: none, ``("component",)`` for Fx to Mz, or ``("direction",)`` for
        x, y, z.
    units, long_name : str
        Attributes of the channel.
    dtype : {"float64", "float32", "int32"}
        Type of the numbers in ``results.nc``; in memory they have double precision.
    frame : str
        Frame of its directions and signs; empty for a scalar.
    openfast_alias : str
        Equivalent channels of OpenFAST.
    record : str
        Array (t, ...) of the recorder with its values, by default the one of its name.
    at : {"", "mudline", "tower_top"}
        Height of the channel, if the array has all recorded heights.
    part : tuple of int, or Ellipsis
        Index into the array after the height.
    """

    name: str
    dims: tuple[str, ...]
    units: str
    long_name: str
    dtype: Literal["float64", "float32", "int32"] = "float64"
    frame: str = FRAME
    openfast_alias: str = ""
    record: str = ""
    at: Literal["", "mudline", "tower_top"] = ""
    part: EllipsisType | tuple[Any, ...] = ...

    __repr__ = one_line

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the variable."""
        found = {
            "long_name": self.long_name,
            "units": self.units,
            "frame": self.frame,
            "openfast_alias": self.openfast_alias,
        }
        return {name: text for name, text in found.items() if text}

    def values(self, records: Mapping[str, Array], index: Mapping[str, Any]) -> Array:
        """Values of the channel.

        Parameters
        ----------
        records : mapping of str to array
            Arrays by name.
        index : mapping of str to index
            Entries to keep by dimension, and those of the heights named by ``at``.

        Returns
        -------
        (t, ...) array
        """
        found = records[self.record or self.name]
        for name in (self.at, *self.dims):
            if name in index:
                found = found[:, index[name]]
        return found[self.part]
