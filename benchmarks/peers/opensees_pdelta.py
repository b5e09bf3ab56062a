"""OpenSees in space with P-Delta beams, at the settings that were found best.

Average acceleration; the tangent is factorised once a step; iterations to a residual of 0.1 N.
"""

from __future__ import annotations

import opensees_chain
from opensees_chain import Settings
from problem import PeerRun

SETTINGS = Settings("PDelta")


def run(dt: float, duration: float) -> PeerRun:
    """Problem P with steps of dt s."""
    return opensees_chain.run("opensees_pdelta", SETTINGS, dt, duration)
