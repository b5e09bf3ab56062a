"""The moving ground, as the chain and its soil meet it.

The chain's base moves with the ground: root joints and their restraint see motion relative to it.
Soil along the pile sees its points relative to the ground at their own heights. Water and wind see
absolute motion.
"""

from __future__ import annotations

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.dynamics.base_excitation import BASE, GROUND_NUMBERS
from offwind_pin.dynamics.compiled.chain_arrays import ChainArrays

DISPLACED, VELOCITY, ACCELERATION = range(3)
"""Parts of the ground's motion at a level."""

Vector = tuple[float, float, float]


@kernel
def of_ground(s: ChainArrays, row: Array, i: int, part: int) -> Vector:
    """Ground's displacement, velocity or acceleration at loaded point i, or at the ``BASE``.

    It is zero where nothing meets the ground, and without an earthquake.
    """
    level = s.ground_level[i]
    if level < 0:
        return (0.0, 0.0, 0.0)
    at, share = 1 + GROUND_NUMBERS * level + 3 * part, s.ground_share[i]
    if share == 0:
        return (row[at], row[at + 1], row[at + 2])
    above = at + GROUND_NUMBERS
    return (
        (1 - share) * row[at] + share * row[above],
        (1 - share) * row[at + 1] + share * row[above + 1],
        (1 - share) * row[at + 2] + share * row[above + 2],
    )


@kernel
def power_of_ground(s: ChainArrays, row: Array) -> float:
    """Power in W that the ground gives the structure: its velocity times what it exerts.

    At the base that is what the wrench on everything asks for, at grounded points the soil's force.
    """
    if s.ground_level[BASE] < 0:
        return 0.0
    velocity = of_ground(s, row, BASE, VELOCITY)
    power = 0.0
    for j in range(3):
        power -= s.wrench[0, j] * velocity[j]
    for i in range(len(s.point_body)):
        if s.ground_level[i] >= 0:
            velocity = of_ground(s, row, i, VELOCITY)
            for j in range(3):
                power += s.force[i, j] * velocity[j]
    return power
