"""The four soil reactions of PISA: conic curves with normalised parameters.

Byrne et al. (2020), PISA design model for monopiles for offshore wind turbines: application to a
stiff glacial clay till; Burd et al. (2020), the same for a marine sand. For monotonic loading.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.soil.layers import Pisa
from offwind_pin.definitions.soil.pisa import PisaReaction
from offwind_pin.loads.soil.curves.laws import SoilCurves, conic_curves
from offwind_pin.loads.soil.soil_profile import Ground


@dataclass(frozen=True, eq=False)
class RockingCurves:
    """Distributed moment over the rotation of the pile.

    Attributes
    ----------
    curves : m in N m/m over psi in rad; m / abs(p) in m where ``by_lateral``
    by_lateral : (n,) whether the curve is to be multiplied by the lateral resistance abs(p) in N/m
    """

    curves: SoilCurves
    by_lateral: NDArray[np.bool_]


def pisa_lateral(layer: Pisa, ground: Ground, stress: Array) -> SoilCurves:
    """p in N/m over v in m; stress (n,) is the vertical effective one in Pa.

    Raises
    ------
    InputError : a pile so far outside the calibration that there is no such curve
    """
    conic = _Conic.of(layer, layer.reactions.lateral, "lateral", ground, stress)
    return conic.curves(ground.diameter, ground.diameter)


def pisa_rocking(layer: Pisa, ground: Ground, stress: Array) -> SoilCurves:
    """m in N m/m over psi in rad in clay, m / abs(p) in m over psi in sand; as ``pisa_lateral``."""
    conic = _Conic.of(layer, layer.reactions.rocking, "rocking", ground, stress)
    if layer.reactions.soil == "sand":
        return conic.curves(1.0, ground.diameter / np.where(conic.strength > 0, conic.strength, 1))
    return conic.curves(1.0, ground.diameter**2)


def pisa_base_shear(layer: Pisa, toe: Ground, stress: Array) -> SoilCurves:
    """H in N over v in m at the toe; as ``pisa_lateral``."""
    conic = _Conic.of(layer, layer.reactions.base_shear, "base_shear", toe, stress)
    return conic.curves(toe.diameter, toe.diameter**2)


def pisa_base_moment(layer: Pisa, toe: Ground, stress: Array) -> SoilCurves:
    """M in N m over psi in rad at the toe; as ``pisa_lateral``."""
    conic = _Conic.of(layer, layer.reactions.base_moment, "base_moment", toe, stress)
    return conic.curves(1.0, toe.diameter**3)


@dataclass(frozen=True, eq=False)
class _Conic:
    """Normalised parameters at n nodes, and what they are normalised by, both in Pa."""

    strength: Array
    shear_modulus: Array
    displacement: Array
    resistance: Array
    slope_ratio: Array
    curvature: Array

    @staticmethod
    def of(layer: Pisa, reaction: PisaReaction, name: str, ground: Ground, stress: Array) -> _Conic:
        density = layer.relative_density or 0.0
        where = (ground.depth, ground.diameter, ground.length, density)
        stiffness = reaction.initial_stiffness.at(*where)
        curvature = reaction.curvature.at(*where)
        resistance = reaction.ultimate_resistance.at(*where)
        if reaction.ultimate_displacement is None:
            displacement = resistance / stiffness
        else:
            displacement = reaction.ultimate_displacement.at(*where)
        ratio = stiffness * displacement / resistance
        exists = (
            (np.minimum(np.minimum(stiffness, displacement), resistance) > 0)
            & (ratio > 1 - 1e-9)
            & (curvature >= 0)
            & (curvature < 1)
        )
        if not exists.all():
            _refuse(layer, name, ground.at(~exists))
        strength = stress
        if layer.undrained_shear_strength is not None:
            strength = layer.undrained_shear_strength.at(ground.original_depth)
        shear_modulus = layer.shear_modulus.at(ground.original_depth)
        if np.any((strength > 0) & (shear_modulus <= 0)):
            raise InputError(
                f"pisa layer from {layer.top:g} m, field shear_modulus_pa",
                "zero at a depth where the soil has strength",
                "a positive shear modulus",
                "Give at_mudline, or a table that starts above zero.",
            )
        return _Conic(strength, shear_modulus, displacement, resistance, ratio, curvature)

    def curves(self, length: Array | float, area: Array | float) -> SoilCurves:
        """With displacements times length strength / G0, and resistances times area strength."""
        firm = self.strength > 0
        shear = np.divide(
            self.strength, self.shear_modulus, out=np.ones_like(firm, float), where=firm
        )
        return conic_curves(
            self.displacement * length * shear,
            self.resistance * area * self.strength,
            self.slope_ratio,
            self.curvature,
        )


def _refuse(layer: Pisa, reaction: str, ground: Ground) -> None:
    depth, diameter = float(ground.depth[0]), float(ground.diameter[0])
    raise InputError(
        f"pisa layer from {layer.top:g} m, reaction {reaction}",
        f"z/D = {depth / diameter:.3g}, L/D = {ground.length / diameter:.3g}",
        "a positive stiffness and resistance, an initial stiffness of at least the ultimate "
        "resistance over its displacement, and a curvature in [0, 1)",
        "The published parameters hold for L/D from 2 to 6; change the pile, or give parameters "
        "that hold for it.",
    )
