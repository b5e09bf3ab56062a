"""Results of a case as used in a report."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import xarray as xr

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.results.reading import analysed
from offwind_pin.results.tree import part, parts, required
from offwind_pin.signal.moment_spectrum import MomentSpectrum


@dataclass(frozen=True)
class Published:
    """A published value and the computed one.

    Attributes
    ----------
    quantity : str
        Description of the quantity.
    value : float
        Published value.
    unit : str
        Its unit; empty for a dimensionless number.
    source : str
        Publication.
    ours : float or None
        Computed value, or None if it was not computed.
    mode : str or None
        Label of the mode whose frequency in Hz it is, for the table of modes; a quantity named like
        a mode ("FA1" or "first fore-aft") is put there without it.
    """

    quantity: str
    value: float
    unit: str
    source: str
    ours: float | None = None
    mode: str | None = None


class CaseReport:
    """Parts of a case's results; a section without its part is omitted.

    Parameters
    ----------
    tree : DataTree
        Results, with at least the groups ``case`` and ``structure``.
    summary : mapping of str to object
        Content of ``summary.json``.
    """

    def __init__(self, tree: xr.DataTree, summary: Mapping[str, Any]) -> None:
        self.tree = tree
        self.summary = dict(summary)
        self.case = tree["case"].attrs

    def part(self, name: str) -> xr.Dataset | None:
        """A group under its plain dimensions, or None."""
        return part(self.tree, name)

    @property
    def name(self) -> str:
        return str(self.case["name"])

    @property
    def title(self) -> str:
        return str(self.case.get("title") or self.name)

    @property
    def description(self) -> str:
        return str(self.case.get("description", ""))

    @property
    def status(self) -> str:
        """``complete``, ``failed`` or ``interrupted``."""
        return str(self.case["status"])

    @cached_property
    def structure(self) -> xr.Dataset:
        return required(self.tree, "structure")

    @property
    def foundation(self) -> str:
        return str(self.structure.attrs["foundation"])

    @property
    def wet(self) -> bool:
        return bool(self.structure.attrs["sea"] != "dry")

    @property
    def water_level(self) -> float | None:
        """Height of the mean water surface in m; None for a dry structure."""
        return float(self.structure.attrs["water_level_m"]) if self.wet else None

    @cached_property
    def modes(self) -> ModalResult | None:
        data = self.part("modes")
        return None if data is None else ModalResult.from_dataset(data)

    @cached_property
    def statics(self) -> dict[str, StaticResult]:
        """Static states by foundation, the clamped one first, as a reference for the others."""
        states = {
            str(data.attrs["foundation"]): StaticResult.from_dataset(data)
            for data in parts(self.tree, "static")
        }
        return dict(sorted(states.items(), key=lambda item: item[0] != "clamped"))

    @cached_property
    def histories(self) -> xr.Dataset | None:
        return self.part("histories")

    @cached_property
    def analysed(self) -> xr.Dataset | None:
        """The histories after the ramp, or None with fewer than two samples."""
        if self.histories is None:
            return None
        rest = analysed(self.histories)
        return rest if rest.sizes["time"] > 1 else None

    @cached_property
    def spectrum(self) -> MomentSpectrum | None:
        data = self.part("spectrum")
        return None if data is None else MomentSpectrum.from_dataset(data)

    @cached_property
    def published(self) -> tuple[Published, ...]:
        data = self.part("published")
        if data is None:
            return ()
        texts = [data[name].to_numpy() for name in ("quantity", "unit", "origin", "key")]
        return tuple(
            Published(str(quantity), float(value), str(unit), str(origin), self._computed(str(key)))
            for quantity, unit, origin, key, value in zip(
                *texts, data["value"].to_numpy(), strict=True
            )
        )

    def _computed(self, key: str) -> float | None:
        """A number of the summary, or None."""
        value = self.summary.get(key)
        return float(value) if isinstance(value, int | float) else None
