"""The moving ground, as the chain and its soil meet it.

The chain's base moves with the ground: root joints and their restraint see motion relative to it.
Soil along the pile sees its points relative to the ground at their own heights. Water and wind see
absolute motion.
"""

from __future__ import annotations

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.base_excitation import GROUND_NUMBERS
from offwind_pin.dynamics.compiled.model import Data, Model
from offwind_pin.dynamics.compiled.residual import ground_kernel


@ground_kernel
def move_ground(model: Model, data: Data, time_inputs: Array) -> None:
    """Set the ground's motion at the loaded points and at the base; zero where none is met."""
    level, share, ground = model.ground_level, model.ground_share, data.ground
    for i in range(len(level)):
        if level[i] < 0:
            continue
        first = 1 + GROUND_NUMBERS * level[i]
        for j in range(GROUND_NUMBERS):
            value = time_inputs[first + j]
            if share[i] != 0:
                above = time_inputs[first + GROUND_NUMBERS + j]
                value = (1 - share[i]) * value + share[i] * above
            ground[i, j] = value
