"""Quantities that vary with depth: a line, a table, or a plain number."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Discriminator, Field, Tag, model_validator

from offwind_pin.base.definition import Array, Definition, NonNegative


class DepthLine(Definition):
    """Quantity linear in the depth below the mudline: at_mudline + gradient * depth."""

    at_mudline: NonNegative = 0.0
    gradient: NonNegative = 0.0

    @model_validator(mode="after")
    def _not_zero(self) -> DepthLine:
        if self.at_mudline == 0 and self.gradient == 0:
            raise ValueError("at_mudline and gradient are both zero; one of them must be positive")
        return self

    def at(self, depth: Array) -> Array:
        """Value at depths below the mudline in m; above it the value at the mudline."""
        return self.at_mudline + self.gradient * np.maximum(depth, 0.0)


class DepthTable(Definition):
    """Quantity by depth below the mudline, linear in between, constant beyond both ends."""

    depth: Annotated[tuple[NonNegative, ...], Field(min_length=1)] = Field(alias="depth_m")
    values: Annotated[tuple[NonNegative, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _table_is_complete(self) -> DepthTable:
        if len(self.depth) != len(self.values):
            raise ValueError(
                f"depth_m has {len(self.depth)} entries and values {len(self.values)}; give one "
                "value per depth"
            )
        if np.any(np.diff(self.depth) <= 0):
            raise ValueError("depth_m must increase strictly; sort the table from the mudline down")
        if not any(self.values):
            raise ValueError("values are all zero; one of them must be positive")
        return self

    def at(self, depth: Array) -> Array:
        """Value at depths below the mudline in m."""
        return np.interp(depth, self.depth, self.values)


def _number_as_line(value: Any) -> Any:
    return value if isinstance(value, dict | Definition) else {"at_mudline": value}


def _line_or_table(value: Any) -> str:
    if isinstance(value, dict):
        return "table" if {"depth_m", "depth", "values"} & value.keys() else "line"
    return "table" if isinstance(value, DepthTable) else "line"


DepthProfile = Annotated[
    Annotated[DepthLine, Tag("line")] | Annotated[DepthTable, Tag("table")],
    Discriminator(_line_or_table),
    BeforeValidator(_number_as_line),
]
"""A quantity over depth: ``{at_mudline, gradient}``, ``{depth_m, values}``, or a plain number."""
