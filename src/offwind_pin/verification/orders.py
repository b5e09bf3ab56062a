"""Observed orders of convergence."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from offwind_pin.base.definition import Array


def fitted_order(sizes: Sequence[float] | Array, errors: Sequence[float] | Array) -> float:
    """Slope of log error over log size by least squares: the observed order of convergence."""
    return float(np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0])
