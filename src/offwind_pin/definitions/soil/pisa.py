"""Parameters of the PISA soil reactions, and the published calibrations.

A reaction is a conic curve in normalised displacement and resistance. Its four parameters vary
with a ratio of lengths and, in sand, with relative density. Normalisation (Byrne et al. 2020, Burd
et al. 2020), with s = su in clay and s = vertical effective stress in sand:

=================  ==============  =====================
reaction           resistance      displacement
=================  ==============  =====================
lateral            p / (s D)       v G0 / (D s)
rocking, clay      m / (s D^2)     psi G0 / s
rocking, sand      m / (abs(p) D)  psi G0 / s
base shear         H / (s D^2)     v G0 / (D s)
base moment        M / (s D^3)     psi G0 / s
=================  ==============  =====================
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, model_validator

from offwind_pin.base.definition import Array, Definition, Number

Ratio = Literal["z/D", "z/L", "L/D"]


class PisaCoefficient(Definition):
    """One parameter of a conic, over a ratio r of lengths and the relative density Dr.

    constant + constant_by_density Dr + (slope + slope_by_density Dr) r + amplitude exp(-rate r)
    """

    constant: Number
    constant_by_density: Number = 0.0
    slope: Number = 0.0
    slope_by_density: Number = 0.0
    amplitude: Number = 0.0
    rate: Number = 0.0
    over: Ratio | None = None

    @model_validator(mode="after")
    def _ratio_is_named(self) -> PisaCoefficient:
        varies = any((self.slope, self.slope_by_density, self.amplitude))
        if varies and self.over is None:
            raise ValueError(
                "the coefficient depends on a ratio that is not given; set over: z/D, z/L or L/D"
            )
        return self

    def at(self, depth: Array, diameter: Array, length: float, density: float) -> Array:
        """Value at depths below the mudline in m, (n,)."""
        one = np.ones_like(depth)
        ratio = {
            None: 0 * one,
            "z/D": depth / diameter,
            "z/L": depth / length,
            "L/D": length / diameter,
        }[self.over]
        return (
            self.constant
            + self.constant_by_density * density
            + (self.slope + self.slope_by_density * density) * ratio
            + self.amplitude * np.exp(-self.rate * ratio)
        )


def _number_as_constant(value: Any) -> Any:
    return value if isinstance(value, dict | Definition) else {"constant": value}


Coefficient = Annotated[PisaCoefficient, BeforeValidator(_number_as_constant)]


class PisaReaction(Definition):
    """The four parameters of one conic, normalised.

    Without ``ultimate_displacement`` it is ultimate_resistance / initial_stiffness.
    """

    initial_stiffness: Coefficient
    curvature: Coefficient
    ultimate_resistance: Coefficient
    ultimate_displacement: Coefficient | None = None


class PisaParameters(Definition):
    """The four soil reactions of a pile in one kind of soil."""

    soil: Literal["clay", "sand"]
    lateral: PisaReaction
    rocking: PisaReaction
    base_shear: PisaReaction
    base_moment: PisaReaction


def _over(ratio: Ratio, constant: float, slope: float) -> PisaCoefficient:
    return PisaCoefficient(constant=constant, slope=slope, over=ratio)


def _by_density(
    constant: float,
    by_density: float,
    slope: float = 0.0,
    slope_by_density: float = 0.0,
    over: Ratio | None = None,
) -> PisaCoefficient:
    return PisaCoefficient(
        constant=constant,
        constant_by_density=by_density,
        slope=slope,
        slope_by_density=slope_by_density,
        over=over,
    )


def _constant(value: float) -> PisaCoefficient:
    return PisaCoefficient(constant=value)


_COWDEN = PisaParameters(
    source="Byrne et al. (2020), glacial clay till at Cowden",
    soil="clay",
    lateral=PisaReaction(
        ultimate_displacement=_constant(241.4),
        initial_stiffness=_over("z/D", 10.6, -1.65),
        curvature=_over("z/D", 0.939, -0.03345),
        ultimate_resistance=PisaCoefficient(
            constant=10.7, amplitude=-7.101, rate=0.3085, over="z/D"
        ),
    ),
    rocking=PisaReaction(
        initial_stiffness=_over("z/D", 1.42, -0.09643),
        curvature=_constant(0.0),
        ultimate_resistance=_over("z/D", 0.2899, -0.04775),
    ),
    base_shear=PisaReaction(
        ultimate_displacement=_constant(235.7),
        initial_stiffness=_over("L/D", 2.717, -0.3575),
        curvature=_over("L/D", 0.8793, -0.0315),
        ultimate_resistance=_over("L/D", 0.4038, 0.04812),
    ),
    base_moment=PisaReaction(
        ultimate_displacement=_constant(173.1),
        initial_stiffness=_over("L/D", 0.2146, -0.002132),
        curvature=_over("L/D", 1.079, -0.1087),
        ultimate_resistance=_over("L/D", 0.8192, -0.08588),
    ),
)

_BOTHKENNAR = PisaParameters(
    source="Burd et al. (2020), soft clay at Bothkennar",
    soil="clay",
    lateral=PisaReaction(
        ultimate_displacement=_constant(173.8),
        initial_stiffness=_over("z/D", 12.05, -1.547),
        curvature=_over("z/D", 0.7204, -0.002679),
        ultimate_resistance=PisaCoefficient(
            constant=7.743, amplitude=-3.945, rate=0.8456, over="z/D"
        ),
    ),
    rocking=PisaReaction(
        initial_stiffness=_over("z/D", 1.698, -0.1576),
        curvature=_constant(0.0),
        ultimate_resistance=_over("z/D", 0.4862, -0.05674),
    ),
    base_shear=PisaReaction(
        ultimate_displacement=_constant(291.5),
        initial_stiffness=_over("L/D", 3.008, -0.2701),
        curvature=_over("L/D", 0.3113, 0.04263),
        ultimate_resistance=_over("L/D", 0.5279, 0.06864),
    ),
    base_moment=PisaReaction(
        ultimate_displacement=_constant(187.0),
        initial_stiffness=_over("L/D", 0.3409, -0.01995),
        curvature=_over("L/D", 0.699, -0.1155),
        ultimate_resistance=_over("L/D", 0.8756, -0.09195),
    ),
)

_DUNKIRK = PisaParameters(
    source="Burd et al. (2020), General Dunkirk Sand Model",
    soil="sand",
    lateral=PisaReaction(
        ultimate_displacement=_by_density(146.1, -92.11),
        initial_stiffness=_by_density(8.731, -0.6982, -0.9178, over="z/D"),
        curvature=_by_density(0.917, 0.06193),
        ultimate_resistance=_by_density(0.3667, 25.89, 0.3375, -8.9, over="z/L"),
    ),
    rocking=PisaReaction(
        initial_stiffness=_constant(17.0),
        curvature=_constant(0.0),
        ultimate_resistance=_by_density(0.2605, 0.0, -0.1989, 0.2019, over="z/L"),
    ),
    base_shear=PisaReaction(
        ultimate_displacement=_by_density(0.5150, 2.883, 0.1695, -0.7018, over="L/D"),
        initial_stiffness=_by_density(6.505, -2.985, -0.007969, -0.4299, over="L/D"),
        curvature=_by_density(0.09978, 0.7974, 0.004994, -0.07005, over="L/D"),
        ultimate_resistance=_by_density(0.09952, 0.7996, 0.03988, -0.1606, over="L/D"),
    ),
    base_moment=PisaReaction(
        ultimate_displacement=_constant(44.89),
        initial_stiffness=_constant(0.3515),
        curvature=_by_density(0.300, 0.4986),
        ultimate_resistance=_by_density(0.09981, 0.3710, 0.01998, -0.09041, over="L/D"),
    ),
)

CALIBRATIONS = {
    "cowden_till": _COWDEN,
    "bothkennar_clay": _BOTHKENNAR,
    "general_dunkirk_sand": _DUNKIRK,
}
"""The published parameters by name."""
