"""The four soil reactions of PISA: conic curves with normalised parameters.

Byrne et al. (2020), PISA design model for monopiles for offshore wind turbines: application to a
stiff glacial clay till; Burd et al. (2020), the same for a marine sand. For monotonic loading.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.soil.layers import Loading, Pisa
from offwind_pin.definitions.soil.pisa import PisaReaction
from offwind_pin.loads.soil.curves.family import RockingCurves, SoilFamily, layer_label
from offwind_pin.loads.soil.curves.laws import ConicCurves
from offwind_pin.loads.soil.soil_profile import PileNodes

PISA_SLENDERNESS = (2.0, 6.0)
"""L/D of the calculations that PISA was calibrated on."""

PISA_RELATIVE_DENSITY = (0.45, 0.9)
"""Relative densities of the calculations behind the General Dunkirk Sand Model."""


class PisaFamily(SoilFamily[Pisa]):
    """Lateral resistance and rocking moment along the pile, shear and moment at its base.

    All raise :class:`InputError` for a pile so far outside the calibration that the curve does not
    exist.
    """

    layer = Pisa

    def lateral(
        self, layer: Pisa, nodes: PileNodes, stress: Array, loading: Loading
    ) -> ConicCurves:
        conic = _Conic.of(layer, layer.reactions.lateral, "lateral", nodes, stress)
        return conic.curves(nodes.diameter, nodes.diameter)

    def rocking(self, layer: Pisa, nodes: PileNodes, stress: Array) -> RockingCurves:
        """m in N m/m over psi in rad in clay, m / abs(p) in m over psi in sand."""
        conic = _Conic.of(layer, layer.reactions.rocking, "rocking", nodes, stress)
        sand = layer.reactions.soil == "sand"
        if sand:
            strength = np.where(conic.strength > 0, conic.strength, 1)
            curves = conic.curves(1.0, nodes.diameter / strength)
        else:
            curves = conic.curves(1.0, nodes.diameter**2)
        return RockingCurves(curves, np.full(len(stress), sand))

    def base_shear(self, layer: Pisa, toe: PileNodes, stress: Array) -> ConicCurves:
        conic = _Conic.of(layer, layer.reactions.base_shear, "base_shear", toe, stress)
        return conic.curves(toe.diameter, toe.diameter**2)

    def base_moment(self, layer: Pisa, toe: PileNodes, stress: Array) -> ConicCurves:
        conic = _Conic.of(layer, layer.reactions.base_moment, "base_moment", toe, stress)
        return conic.curves(1.0, toe.diameter**3)

    def cautions(self, layer: Pisa, nodes: PileNodes) -> list[str]:
        largest, smallest = float(nodes.diameter.max()), float(nodes.diameter.min())
        found = []
        low, high = PISA_SLENDERNESS
        slenderness = (nodes.length / largest, nodes.length / smallest)
        if not (low <= slenderness[0] and slenderness[1] <= high):
            found.append(
                f"{layer_label(layer)}: PISA was calibrated for L/D from {low:g} to {high:g}; this "
                f"pile has L/D = {slenderness[0]:.3g}"
            )
        low, high = PISA_RELATIVE_DENSITY
        if layer.relative_density is not None and not low <= layer.relative_density <= high:
            found.append(
                f"{layer_label(layer)}: a relative density of {layer.relative_density:g} is "
                f"outside {low:g} to {high:g}, the calibrated range of the sand model"
            )
        return found


@dataclass(frozen=True, eq=False)
class _Conic:
    """Normalised parameters at n nodes, and the strength and modulus that normalise them, in Pa."""

    strength: Array
    shear_modulus: Array
    displacement: Array
    resistance: Array
    slope_ratio: Array
    curvature: Array

    @staticmethod
    def of(
        layer: Pisa, reaction: PisaReaction, name: str, nodes: PileNodes, stress: Array
    ) -> _Conic:
        density = layer.relative_density or 0.0
        where = (nodes.depth, nodes.diameter, nodes.length, density)
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
            _refuse(layer, name, nodes.at(~exists))
        strength = stress
        if layer.undrained_shear_strength is not None:
            strength = layer.undrained_shear_strength.at(nodes.original_depth)
        shear_modulus = layer.shear_modulus.at(nodes.original_depth)
        if np.any((strength > 0) & (shear_modulus <= 0)):
            raise InputError(
                f"pisa layer from {layer.top:g} m, field shear_modulus_pa",
                "zero at a depth where the soil has strength",
                "a positive shear modulus",
                "Give at_mudline, or a table that starts above zero.",
            )
        return _Conic(strength, shear_modulus, displacement, resistance, ratio, curvature)

    def curves(self, length: Array | float, area: Array | float) -> ConicCurves:
        """Curves with displacements scaled by length strength / G0, resistances by area
        strength."""
        firm = self.strength > 0
        shear = np.divide(
            self.strength, self.shear_modulus, out=np.ones_like(firm, float), where=firm
        )
        return ConicCurves(
            self.displacement * length * shear,
            self.resistance * area * self.strength,
            self.slope_ratio,
            self.curvature,
        )


def _refuse(layer: Pisa, reaction: str, nodes: PileNodes) -> None:
    depth, diameter = float(nodes.depth[0]), float(nodes.diameter[0])
    raise InputError(
        f"pisa layer from {layer.top:g} m, reaction {reaction}",
        f"z/D = {depth / diameter:.3g}, L/D = {nodes.length / diameter:.3g}",
        "a positive stiffness and resistance, an initial stiffness of at least the ultimate "
        "resistance over its displacement, and a curvature in [0, 1)",
        "The published parameters are valid for L/D from 2 to 6; change the pile, or give "
        "parameters that are valid for it.",
    )
