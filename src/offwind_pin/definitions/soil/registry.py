"""Kinds of soil layers from outside the package."""

from __future__ import annotations

from offwind_pin.base.errors import InputError
from offwind_pin.definitions.soil.layers import LAYER_KINDS, LayeredGround, SoilLayer, model_name
from offwind_pin.definitions.soil.springs import DistributedSprings, Soil
from offwind_pin.definitions.turbine import Turbine


def register_layer(kind: type[SoilLayer]) -> None:
    """Register a kind of layer for turbine files and :class:`LayeredGround`.

    Raises
    ------
    InputError
        Another kind already has its name.
    """
    if kind in LAYER_KINDS:
        return
    names = [model_name(known) for known in LAYER_KINDS]
    if model_name(kind) in names:
        raise InputError(
            f"soil layer {kind.__name__}, field model",
            model_name(kind),
            f"a name other than {', '.join(names)}",
            "Choose another name.",
        )
    LAYER_KINDS.append(kind)
    for definition in (LayeredGround, DistributedSprings, Soil, Turbine):  # from the inside out
        signature = definition.__signature__
        definition.model_rebuild(force=True)
        definition.__signature__ = signature  # Pydantic replaces it by that of __init__
