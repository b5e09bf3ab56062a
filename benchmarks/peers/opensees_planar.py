"""OpenSees in the fore-aft plane with P-Delta beams: three degrees of freedom for each node."""

from __future__ import annotations

import opensees_chain
from opensees_chain import PLANE, Settings
from problem import PeerRun

SETTINGS = Settings("PDelta", directions=PLANE)


def run(dt: float, duration: float) -> PeerRun:
    """Problem P with steps of dt s."""
    return opensees_chain.run("opensees_planar", SETTINGS, dt, duration)
