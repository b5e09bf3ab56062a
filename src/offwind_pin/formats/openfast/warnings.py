"""Checks of tower-top loads for common mistakes."""

from __future__ import annotations

import numpy as np

from offwind_pin.definitions.turbine import RigidBodyRNA, RotorNacelleRNA
from offwind_pin.formats.openfast.yaw_bearing_load import carried_body
from offwind_pin.loads.tower_top.load_history import LoadHistory

SMALL_SHARE = 1e-3
"""Of the weight of rotor and nacelle. A running rotor's thrust is a tenth to a quarter of it, a
parked one's drag a hundredth; in kN they are below a thousandth."""

LARGE_SHARE = 20.0
"""Of the same weight: beyond any rotor, but typical of a factor of 1000 too much."""

WEIGHT_SHARE = (0.75, 1.25)
"""Fraction of the weight within which a mean downward Fz counts as that weight."""


def load_cautions(
    history: LoadHistory, rna: RigidBodyRNA | RotorNacelleRNA, gravity: float
) -> list[str]:
    """Cautions about loads that look like a mistake.

    gravity in m/s2
    """
    weight = carried_body(rna).mass * gravity
    level = float(np.max(np.abs(history.load[:, :2])))
    told = []
    if 0 < level < SMALL_SHARE * weight:
        told.append(
            f"{history.origin}: horizontal forces of {level:.3g} N are {level / weight:.1e} of "
            f"the weight of rotor and nacelle ({weight:.3g} N); they seem to be in kN where N is "
            "required: set factor: 1000"
        )
    if level > LARGE_SHARE * weight:
        told.append(
            f"{history.origin}: horizontal forces of {level:.3g} N are {level / weight:.0f} times "
            f"the weight of rotor and nacelle ({weight:.3g} N); were they multiplied by 1000 twice?"
        )
    mean = float(np.mean(history.load[:, 2]))
    if WEIGHT_SHARE[0] * weight < -mean < WEIGHT_SHARE[1] * weight:
        told.append(
            f"{history.origin}: the mean Fz of {mean:.3g} N is the weight of rotor and nacelle "
            f"({weight:.3g} N), which the model already includes, so it would count twice: set "
            "subtract_weight: true, or use aerodynamic channels"
        )
    return told
