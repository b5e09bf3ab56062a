"""Thresholds that distinguish a wrong unit from merely unusual soil."""

from __future__ import annotations

import math

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.depth_profile import DepthLine, DepthTable

LOOKED_AT = np.linspace(0.0, 50.0, 51)
"""Depths in m at which a profile is checked."""

STRENGTH_PA = (1e3, 5e6)
SKIN_FRICTION_PA = (1e3, 5e6)
SHEAR_MODULUS_PA = (1e6, 2e10)
SUBMERGED_UNIT_WEIGHT_N_PER_M3 = (1e3, 14e3)
FRICTION_ANGLE_DEG = (15.0, 50.0)
STRAIN_50 = (5e-4, 0.1)
RIGIDITY_INDEX = (20.0, 1e4)
"""Smallest and largest G0 / su."""


def check_strength(profile: DepthLine | DepthTable) -> DepthLine | DepthTable:
    """Check an undrained shear strength in Pa.

    Raises
    ------
    ValueError
        It looks like kPa, or is too large for soil.
    """
    largest = float(profile.at(LOOKED_AT).max())
    if largest < STRENGTH_PA[0]:
        raise ValueError(
            f"an undrained shear strength of at most {largest:g} Pa looks like kPa; give Pa "
            f"(1 kPa = 1000 Pa)"
        )
    if largest > STRENGTH_PA[1]:
        raise ValueError(
            f"an undrained shear strength of {largest:g} Pa is that of rock; give Pa, and check "
            "the gradient (Pa per m)"
        )
    return profile


def check_skin_friction(profile: DepthLine | DepthTable) -> DepthLine | DepthTable:
    """Check a unit shaft friction in Pa.

    Raises
    ------
    ValueError
        It looks like kPa, or is too large for soil.
    """
    largest = float(profile.at(LOOKED_AT).max())
    low, high = SKIN_FRICTION_PA
    if not low <= largest <= high:
        likely = "looks like kPa" if largest < low else "is too large for soil"
        raise ValueError(
            f"a skin friction of at most {largest:g} Pa {likely}; give Pa (1 kPa = 1000 Pa)"
        )
    return profile


def check_shear_modulus(profile: DepthLine | DepthTable) -> DepthLine | DepthTable:
    """Check a small-strain shear modulus in Pa.

    Raises
    ------
    ValueError
        It looks like kPa or MPa, or is too large for soil.
    """
    largest = float(profile.at(LOOKED_AT).max())
    if largest < SHEAR_MODULUS_PA[0]:
        raise ValueError(
            f"a small-strain shear modulus of at most {largest:g} Pa looks like kPa or MPa; "
            "give Pa (1 MPa = 1e6 Pa)"
        )
    if largest > SHEAR_MODULUS_PA[1]:
        raise ValueError(
            f"a small-strain shear modulus of {largest:g} Pa is that of rock; give Pa, and check "
            "the gradient (Pa per m)"
        )
    return profile


def check_unit_weight(value: float) -> float:
    """Check a submerged unit weight in N/m3.

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
            f"a submerged unit weight of {value:g} N/m3 looks like the total unit weight; subtract "
            "10 kN/m3 for water"
        )
    return value


def check_friction_angle(value: float) -> float:
    """Check a friction angle in degrees.

    Raises
    ------
    ValueError
        It looks like radians, or is outside the range of sand.
    """
    low, high = FRICTION_ANGLE_DEG
    if value <= math.pi / 2:
        raise ValueError(f"a friction angle of {value:g} deg looks like radians; give degrees")
    if not low <= value <= high:
        raise ValueError(
            f"a friction angle of {value:g} deg is outside the range of sand; give {low:g} to "
            f"{high:g} degrees"
        )
    return value


def check_strain_50(value: float) -> float:
    """Check a strain at half the failure load, as a fraction.

    Raises
    ------
    ValueError
        It looks like percent, or is too small for clay.
    """
    low, high = STRAIN_50
    if value > high:
        raise ValueError(
            f"a strain_50 of {value:g} looks like percent; give a fraction (1 percent = 0.01)"
        )
    if value < low:
        raise ValueError(
            f"a strain_50 of {value:g} is too small for clay; give a fraction from 0.004 (hard) to "
            "0.02 (soft)"
        )
    return value


def check_relative_density(value: float) -> float:
    """Check a relative density as a fraction.

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
    """Check that G0 and su, at the same depths, can belong to one clay.

    Raises
    ------
    ValueError
        Their units seem to differ.
    """
    low, high = RIGIDITY_INDEX
    ratio = float(shear_modulus.sum() / strength.sum()) if strength.any() else math.inf
    if not low <= ratio <= high:
        raise ValueError(
            f"a ratio of shear modulus to undrained shear strength of {ratio:.3g} is outside the "
            f"range of clay ({low:g} to {high:g}); give both in Pa"
        )
