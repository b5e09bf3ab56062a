"""Thresholds that tell a unit taken for another from ground that is merely unusual."""

from __future__ import annotations

import math

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.depth_profile import DepthLine, DepthTable

LOOKED_AT = np.linspace(0.0, 50.0, 51)
"""Depths in m at which a profile is judged."""

STRENGTH_PA = (1e3, 5e6)
SKIN_FRICTION_PA = (1e3, 5e6)
SHEAR_MODULUS_PA = (1e6, 2e10)
SUBMERGED_UNIT_WEIGHT_N_PER_M3 = (1e3, 14e3)
FRICTION_ANGLE_DEG = (15.0, 50.0)
STRAIN_50 = (5e-4, 0.1)
RIGIDITY_INDEX = (20.0, 1e4)
"""Smallest and largest G0 / su."""


def check_strength(profile: DepthLine | DepthTable) -> DepthLine | DepthTable:
    """An undrained shear strength that can be one in Pa.

    Raises
    ------
    ValueError
        It looks like kPa, or like no soil.
    """
    largest = float(profile.at(LOOKED_AT).max())
    if largest < STRENGTH_PA[0]:
        raise ValueError(
            f"an undrained shear strength that reaches {largest:g} Pa only looks like kPa; give Pa "
            f"(1 kPa = 1000 Pa)"
        )
    if largest > STRENGTH_PA[1]:
        raise ValueError(
            f"an undrained shear strength of {largest:g} Pa is that of rock; give Pa, and check "
            "the gradient (Pa per m)"
        )
    return profile


def check_skin_friction(profile: DepthLine | DepthTable) -> DepthLine | DepthTable:
    """A unit shaft friction that can be one in Pa.

    Raises
    ------
    ValueError
        It looks like kPa, or is beyond any ground's.
    """
    largest = float(profile.at(LOOKED_AT).max())
    low, high = SKIN_FRICTION_PA
    if not low <= largest <= high:
        likely = "only looks like kPa" if largest < low else "is beyond any ground's"
        raise ValueError(
            f"a skin friction that reaches {largest:g} Pa {likely}; give Pa (1 kPa = 1000 Pa)"
        )
    return profile


def check_shear_modulus(profile: DepthLine | DepthTable) -> DepthLine | DepthTable:
    """A small-strain shear modulus that can be one in Pa.

    Raises
    ------
    ValueError
        It looks like kPa or MPa, or like no soil.
    """
    largest = float(profile.at(LOOKED_AT).max())
    if largest < SHEAR_MODULUS_PA[0]:
        raise ValueError(
            f"a small-strain shear modulus that reaches {largest:g} Pa only looks like kPa or MPa; "
            "give Pa (1 MPa = 1e6 Pa)"
        )
    if largest > SHEAR_MODULUS_PA[1]:
        raise ValueError(
            f"a small-strain shear modulus of {largest:g} Pa is that of rock; give Pa, and check "
            "the gradient (Pa per m)"
        )
    return profile


def check_unit_weight(value: float) -> float:
    """A submerged unit weight in N/m3.

    Raises
    ------
    ValueError
        It looks like kN/m3, or like the total unit weight.
    """
    low, high = SUBMERGED_UNIT_WEIGHT_N_PER_M3
    if value < low:
        raise ValueError(
            f"a submerged unit weight of {value:g} N/m3 looks like kN/m3; give N/m3 "
            "(10 kN/m3 = 10000 N/m3)"
        )
    if value > high:
        raise ValueError(
            f"a submerged unit weight of {value:g} N/m3 looks like the total one; subtract the "
            "water's 10 kN/m3"
        )
    return value


def check_friction_angle(value: float) -> float:
    """A friction angle in degrees.

    Raises
    ------
    ValueError
        It looks like radians, or like no sand.
    """
    low, high = FRICTION_ANGLE_DEG
    if value <= math.pi / 2:
        raise ValueError(f"a friction angle of {value:g} deg looks like radians; give degrees")
    if not low <= value <= high:
        raise ValueError(
            f"a friction angle of {value:g} deg is none of a sand; give {low:g} to {high:g} degrees"
        )
    return value


def check_strain_50(value: float) -> float:
    """A strain at half the failure load, as a fraction.

    Raises
    ------
    ValueError
        It looks like percent, or is far below what any clay shows.
    """
    low, high = STRAIN_50
    if value > high:
        raise ValueError(
            f"a strain_50 of {value:g} looks like percent; give a fraction (1 percent = 0.01)"
        )
    if value < low:
        raise ValueError(
            f"a strain_50 of {value:g} is below any clay's; give a fraction from 0.004 (hard) to "
            "0.02 (soft)"
        )
    return value


def check_relative_density(value: float) -> float:
    """A relative density as a fraction.

    Raises
    ------
    ValueError
        It looks like percent.
    """
    if value > 1:
        raise ValueError(
            f"a relative density of {value:g} looks like percent; give a fraction (75 percent = "
            "0.75)"
        )
    return value


def check_rigidity(shear_modulus: Array, strength: Array) -> None:
    """G0 and su that can belong to one clay; both at the same depths.

    Raises
    ------
    ValueError
        One of them is in another unit than the other.
    """
    low, high = RIGIDITY_INDEX
    ratio = float(shear_modulus.sum() / strength.sum()) if strength.any() else math.inf
    if not low <= ratio <= high:
        raise ValueError(
            f"a ratio of shear modulus to undrained shear strength of {ratio:.3g} is none of a "
            f"clay ({low:g} to {high:g}); give both in Pa"
        )
