"""What the codes are checked against before they are timed: statics and modes of our own chain."""

from __future__ import annotations

import numpy as np
import problem_p
from problem_p import FORCE_MEAN

import offwind_pin as ow


def expectations() -> dict[str, float]:
    """First fore-aft frequency under gravity, and seabed moment under gravity and the mean force.

    The moment holds the weight of the leaning structure.
    """
    system = problem_p.system()
    gravity = ow.static(system)
    loaded = ow.static(system, np.array([FORCE_MEAN, 0.0, 0.0, 0.0, 0.0, 0.0]))
    modes = ow.modes(system, 4, gravity)
    return {
        "first_fore_aft_hz": float(modes.frequency_hz[modes.label.index("FA1")]),
        "seabed_moment_gravity_nm": float(gravity.mudline_load[4]),
        "seabed_moment_mean_nm": float(loaded.mudline_load[4]),
    }
