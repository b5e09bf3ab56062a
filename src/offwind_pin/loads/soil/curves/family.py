"""Families of soil reaction curves: from a soil layer to curves at the nodes of a pile."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.soil.layers import Loading, SoilLayer
from offwind_pin.definitions.soil.registry import register_layer
from offwind_pin.loads.soil.curves.soil_curve import SoilCurve, SoilCurves
from offwind_pin.loads.soil.soil_profile import PileNodes

Kind = TypeVar("Kind", bound=SoilLayer)

API_DIAMETER = 2.0
"""Largest pile diameter in m of the tests behind the curves of API and of Reese and Welch."""


@dataclass(frozen=True, eq=False)
class RockingCurves:
    """Distributed moment over the rotation of the pile.

    Attributes
    ----------
    curves : SoilCurves
        m in N m/m over psi in rad; m / abs(p) in m where ``by_lateral``.
    by_lateral : (n,) bool array
        Whether the curve is to be multiplied by the lateral resistance abs(p).
    """

    curves: SoilCurves
    by_lateral: NDArray[np.bool_]


class SoilFamily(ABC, Generic[Kind]):
    """A family of curves: base class of the package's families and of your own.

    Stresses are vertical effective stresses in Pa at the nodes.
    """

    layer: ClassVar[type[SoilLayer]]
    """Definition of the layers of this family."""

    @abstractmethod
    def lateral(self, layer: Kind, nodes: PileNodes, stress: Array, loading: Loading) -> SoilCurve:
        """Lateral resistance p in N/m over y in m at the nodes of a layer.

        Parameters
        ----------
        layer : SoilLayer
        nodes : PileNodes
            Nodes in the layer.
        stress : (n,) array, Pa
            Vertical effective stress at the nodes.
        loading : Loading
            Static or cyclic.

        Returns
        -------
        SoilCurve

        Raises
        ------
        InputError
            A pile outside the range of the curves.
        """

    def rocking(self, layer: Kind, nodes: PileNodes, stress: Array) -> RockingCurves | None:
        """Distributed moment at the nodes of a layer.

        Parameters
        ----------
        layer : SoilLayer
        nodes : PileNodes
            Nodes in the layer.
        stress : (n,) array, Pa
            Vertical effective stress at the nodes.

        Returns
        -------
        RockingCurves or None
            None if the family has none.
        """
        return None

    def base_shear(self, layer: Kind, toe: PileNodes, stress: Array) -> SoilCurve | None:
        """Shear in N over the horizontal displacement in m at the toe.

        Parameters
        ----------
        layer : SoilLayer
            Layer at the toe.
        toe : PileNodes
            The node at the toe.
        stress : (1,) array, Pa
            Vertical effective stress there.

        Returns
        -------
        SoilCurve or None
            None if the family has none.
        """
        return None

    def base_moment(self, layer: Kind, toe: PileNodes, stress: Array) -> SoilCurve | None:
        """Moment in N m over the rotation in rad at the toe.

        Parameters
        ----------
        layer : SoilLayer
            Layer at the toe.
        toe : PileNodes
            The node at the toe.
        stress : (1,) array, Pa
            Vertical effective stress there.

        Returns
        -------
        SoilCurve or None
            None if the family has none.
        """
        return None

    def cautions(self, layer: Kind, nodes: PileNodes) -> list[str]:
        """Cautions about nodes outside the range for which the curves were derived.

        Parameters
        ----------
        layer : SoilLayer
        nodes : PileNodes
            Nodes in the layer.

        Returns
        -------
        list of str
        """
        return []


_families: dict[type[SoilLayer], SoilFamily[Any]] = {}


def register_family(family: SoilFamily[Any]) -> None:
    """Register a family for its layers, which then can be used in files as well.

    Parameters
    ----------
    family : SoilFamily

    Raises
    ------
    InputError
        Another kind of layer has the same name.
    """
    register_layer(family.layer)
    _families[family.layer] = family


def family_of(layer: SoilLayer) -> SoilFamily[Any]:
    """Family of a layer.

    Raises
    ------
    InputError
        No family is registered for it.
    """
    if type(layer) not in _families:
        raise InputError(
            f"{layer.model} layer",
            f"no family of curves for {type(layer).__name__}",
            ", ".join(kind.__name__ for kind in _families),
            "Register one with register_family.",
        )
    return _families[type(layer)]


def diameter_cautions(layer: SoilLayer, nodes: PileNodes) -> list[str]:
    """Caution about a pile larger than those of the tests behind API's curves."""
    largest = float(nodes.diameter.max())
    if largest <= API_DIAMETER:
        return []
    return [
        f"{layer_label(layer)}: the curves are based on piles of at most {API_DIAMETER:g} m in "
        f"diameter; this pile has {largest:g} m"
    ]


def layer_label(layer: SoilLayer) -> str:
    """Name of a layer in messages."""
    return f"{layer.model} layer from {layer.top:g} m"
