"""What a channel of a time history is: one row of the table of channels."""

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
        In the dataset; channels of one name given by several loads are summed.
    dims : tuple of str
        Dimensions after ``time``: none, ``("component",)`` for Fx to Mz, or ``("direction",)`` for
        x, y, z.
    units, long_name : str
        Attributes of the channel.
    dtype : {"float64", "float32", "int32"}
        Of the numbers in ``results.nc``; in memory they have double precision.
    frame : str
        Of its directions and signs; empty for a scalar.
    openfast_alias : str
        Channels of OpenFAST that give the same.
    record : str
        Array (t, ...) that it is taken from; empty for one of its own name.
    at : {"", "mudline", "tower_top"}
        The height that it is about, where the array is over all recorded heights.
    part : index
        Of the array, after that of the height.
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
        """The numbers (t, ...).

        Parameters
        ----------
        records : mapping of str to array
            Arrays by name.
        index : mapping of str to index
            Entries that are kept, by dimension, and those of the heights that ``at`` names.
        """
        found = records[self.record or self.name]
        for name in (self.at, *self.dims):
            if name in index:
                found = found[:, index[name]]
        return found[self.part]
