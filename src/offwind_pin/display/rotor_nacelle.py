"""The rotor-nacelle assembly in results."""

from __future__ import annotations

import xarray as xr
from pydantic import TypeAdapter

from offwind_pin.definitions.turbine import RigidBodyRNA, RotorNacelleRNA
from offwind_pin.structure.meshes import Mesh
from offwind_pin.structure.rotor import rna_meshes

_ADAPTER: TypeAdapter[RigidBodyRNA | RotorNacelleRNA] = TypeAdapter(RigidBodyRNA | RotorNacelleRNA)


def rotor_nacelle(results: xr.Dataset) -> RigidBodyRNA | RotorNacelleRNA:
    """The definition in the attribute ``rotor_nacelle`` of a dataset."""
    return _ADAPTER.validate_json(str(results.attrs["rotor_nacelle"]))


def assembly(results: xr.Dataset, tower_diameter: float) -> dict[str, Mesh]:
    """Its meshes by name, as :func:`~offwind_pin.structure.rotor.rna_meshes` makes them."""
    return rna_meshes(rotor_nacelle(results), tower_diameter)
