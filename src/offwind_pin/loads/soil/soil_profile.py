"""Nodes of a pile in the ground, with layers and stresses at them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.definitions.soil.layers import SoilLayer
from offwind_pin.loads.soil.curves.soil_curve import ON_BOUNDARY, Places


@dataclass(frozen=True, eq=False, repr=False)
class PileNodes:
    """Nodes of a pile below the mudline.

    Attributes
    ----------
    depth : (n,) array, m
        Depth below the actual mudline.
    diameter : (n,) array, m
        Outer diameter of the pile.
    length : float, m
        Embedded length of the pile, from the actual mudline to the toe.
    scour : float, m
        Depth of the actual mudline below the original one; negative for deposition.
    """

    depth: Array
    diameter: Array
    length: float
    scour: float = 0.0

    __repr__ = one_line

    @property
    def original_depth(self) -> Array:
        """Depth below the original mudline in m, (n,); negative in deposited soil."""
        return self.depth + self.scour

    def at(self, places: Places) -> PileNodes:
        """Some of the nodes.

        Parameters
        ----------
        places : int array or bool array
            Indices or a mask.

        Returns
        -------
        PileNodes
        """
        return PileNodes(self.depth[places], self.diameter[places], self.length, self.scour)

    @property
    def toe(self) -> PileNodes:
        """One node at the toe, with the diameter of the deepest node."""
        diameter = self.diameter[[int(np.argmax(self.depth))]]
        return PileNodes(np.array([self.length]), diameter, self.length, self.scour)


def layer_index(layers: tuple[SoilLayer, ...], nodes: PileNodes) -> NDArray[np.intp]:
    """(n,) index of the layer that contains each node.

    Exactly on a boundary it is the layer below; deposited soil is that of the top layer.
    """
    tops = [layer.top for layer in layers]
    found = np.searchsorted(tops, nodes.original_depth + ON_BOUNDARY, side="right") - 1
    return np.maximum(found, 0)


def effective_stress(layers: tuple[SoilLayer, ...], nodes: PileNodes) -> Array:
    """Vertical effective stress at the nodes in Pa, (n,), from the actual mudline down.

    General scour: soil above the actual mudline no longer has weight.
    """

    def weight_above(depth: Array) -> Array:
        total = layers[0].submerged_unit_weight * np.minimum(depth, 0.0)
        bottoms = [*(layer.top for layer in layers[1:]), np.inf]
        for layer, bottom in zip(layers, bottoms, strict=True):
            thickness = np.clip(depth, layer.top, bottom) - layer.top
            total = total + layer.submerged_unit_weight * thickness
        return total

    stress = weight_above(nodes.original_depth) - weight_above(np.array(nodes.scour))
    return np.where(nodes.depth > 0, stress, 0.0)
