"""The moving ground, as the chain and its soil meet it.

The chain's base moves with the ground: root joints and their restraint see motion relative to it.
Soil along the pile sees its points relative to the ground at their own heights. Water and wind see
absolute motion.
"""

from __future__ import annotations

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.base_excitation import GROUND_NUMBERS
from offwind_pin.dynamics.compiled.model import Data, Model, State, evaluation_kernel
from offwind_pin.dynamics.compiled.recorder import GROUND, Recorder
from offwind_pin.dynamics.compiled.recording import record_kernel


@evaluation_kernel
def move_ground(model: Model, data: Data, state: State, time_inputs: Array) -> None:
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


@record_kernel
def ground_power(model: Model, data: Data, state: State, recorder: Recorder) -> None:
    """Set the power of the moving ground: of the base and of the soil at the loaded points."""
    ground, base, power = data.ground, len(data.ground) - 1, 0.0
    for j in range(3):
        power -= data.wrench[0, j] * ground[base, 3 + j]
        for i in range(base):
            power += data.force[i, j] * ground[i, 3 + j]
    recorder.now[1, GROUND] = power
