"""A law and a family of soil curves as a user would write them."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from offwind_pin.base.definition import Positive
from offwind_pin.definitions.soil.layers import Loading, SoilLayer
from offwind_pin.loads.soil.curves.family import SoilFamily, register_family
from offwind_pin.loads.soil.curves.laws import PolygonCurves
from offwind_pin.loads.soil.curves.soil_curve import SoilCurve
from offwind_pin.loads.soil.soil_profile import PileNodes

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HyperbolicCurves(SoilCurve):
    """p = y / (1 / k + y / p_u) (Kondner 1963), k in N/m2 and p_u in N/m."""

    initial_modulus: Array
    ultimate: Array

    @staticmethod
    def secant_at(parameters: Array, y: float) -> float:
        modulus, ultimate = parameters[0], parameters[1]
        return modulus * ultimate / (ultimate + modulus * y)

    @staticmethod
    def tangent_at(parameters: Array, y: float) -> float:
        modulus, ultimate = parameters[0], parameters[1]
        return modulus * (ultimate / (ultimate + modulus * y)) ** 2

    @staticmethod
    def energy_at(parameters: Array, y: float) -> float:
        modulus, ultimate = parameters[0], parameters[1]
        return ultimate * (y - ultimate / modulus * np.log1p(modulus * y / ultimate))


class HyperbolicSoil(SoilLayer):
    """Soil with hyperbolic curves, the same all the way down."""

    model: Literal["hyperbolic"]
    initial_modulus: Positive = Field(alias="initial_modulus_n_per_m2")
    ultimate: Positive = Field(alias="ultimate_n_per_m")


class HyperbolicFamily(SoilFamily[HyperbolicSoil]):
    layer = HyperbolicSoil

    def lateral(
        self, layer: HyperbolicSoil, nodes: PileNodes, stress: Array, loading: Loading
    ) -> HyperbolicCurves:
        n = len(nodes.depth)
        return HyperbolicCurves(np.full(n, layer.initial_modulus), np.full(n, layer.ultimate))


class ChordFamily(SoilFamily[HyperbolicSoil]):
    """The same curves by many chords of the shipped law of polygons."""

    layer = HyperbolicSoil

    def lateral(
        self, layer: HyperbolicSoil, nodes: PileNodes, stress: Array, loading: Loading
    ) -> PolygonCurves:
        y = np.concatenate([[0.0], np.geomspace(1e-7, 5.0, 4000)])
        k, ultimate = layer.initial_modulus, layer.ultimate
        p = k * ultimate * y / (ultimate + k * y)
        n = len(nodes.depth)
        return PolygonCurves(np.tile(y, (n, 1)), np.tile(p, (n, 1)))


register_family(HyperbolicFamily())
