"""OpenSees in space with corotational beams.

The residual tolerance is wider than elsewhere: rounding in the corotational transformation leaves
about 0.09 N under gravity.
"""

from __future__ import annotations

import opensees_chain
from opensees_chain import Settings
from problem import PeerRun

SETTINGS = Settings("Corotational", force_tolerance=0.3)


def run(dt: float, duration: float) -> PeerRun:
    """Problem P with steps of dt s."""
    return opensees_chain.run("opensees_corotational", SETTINGS, dt, duration)
