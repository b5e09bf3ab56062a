"""OpenSees in space with P-Delta beams and one linear solution a step, without iterations.

What the soil's curvature leaves over is not removed within the step and no residual is tested; the
error against the code's converged fine solution tells what that costs.
"""

from __future__ import annotations

import opensees_chain
from opensees_chain import Settings
from problem import PeerRun

SETTINGS = Settings("PDelta", algorithm="Linear")


def run(dt: float, duration: float) -> PeerRun:
    """Problem P with steps of dt s."""
    return opensees_chain.run("opensees_pdelta_linear", SETTINGS, dt, duration)
