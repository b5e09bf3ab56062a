"""The rotor-nacelle assembly as results carry it."""

from __future__ import annotations

import xarray as xr
from pydantic import TypeAdapter

from offwind_pin.definitions.turbine import RigidBodyRNA, RotorNacelleRNA

_ADAPTER: TypeAdapter[RigidBodyRNA | RotorNacelleRNA] = TypeAdapter(RigidBodyRNA | RotorNacelleRNA)


def rotor_nacelle(results: xr.Dataset) -> RigidBodyRNA | RotorNacelleRNA:
    """The definition in the attribute ``rotor_nacelle`` of a dataset."""
    return _ADAPTER.validate_json(str(results.attrs["rotor_nacelle"]))
