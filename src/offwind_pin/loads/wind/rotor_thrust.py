"""Rotor thrust in the wind relative to the moving hub, from a table of the thrust coefficient.

The thrust acts along the shaft. The shaft crosses the tower's axis, so that the force at the apex
and the same force at the crossing are equivalent, and every point of the shaft has the same
velocity along it: one point on the axis represents both exactly, without an arm.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.base.kernels import inner, kernel
from offwind_pin.base.records import clear, part, stack_matrix
from offwind_pin.definitions.rotor_disc import RotorDisc
from offwind_pin.loads.point_load import (
    AXIS,
    BY_AXIS,
    BY_VELOCITY,
    VELOCITY,
    KernelLoad,
    commit_kernel,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.wind.history import WindHistory
from offwind_pin.loads.wind.thrust_table import (
    ThrustTable,
    induction,
    inflow_time,
    thrust_coefficient,
    thrust_curve,
)

Control = Literal["lagged", "instant"]

CONTROL_TIME = 7.5
"""s, in which rotor speed and pitch follow a change of the wind. Below rated it is the
rotor's inertia: J dOmega/dt = P / Omega - k Omega^2 about the best tip-speed ratio, where the power
coefficient is flat, gives J Omega^2 / (3 P), 7.5 s for the shipped IEA 10 MW rotor at 9 m/s. Above
rated the reference controllers' pitch loop has 0.6 rad/s (Jonkman et al. 2009, NREL/TP-500-38060,
chapter 7)."""

_COSINE, _SINE, _PRESSURE, _MEAN, _CONTROL_TIME, _INFLOW_TIME, _MEAN_INDUCED, _TABLE = range(8)
"""Columns of the constants: cosine and sine of the shaft's tilt, rho A / 2, mean wind, the two time
constants, the induced velocity of the mean; the thrust table starts at the last."""

_TIME, _WIND, _OPERATING, _DRIVEN, _INDUCED = range(5)
"""Memory, as of the last step: time; then departures from the mean in m/s of relative wind,
operating point of the controller, target of the induced velocity, induced velocity."""

_TIME_INPUT, _WIND_INPUT = range(2)
"""Time inputs: time, and wind speed along the shaft."""
_V = VELOCITY.start


@inner
def lag_weights(step: float, time_constant: float) -> tuple[float, float, float]:
    """Weights of the last output, the last input and the new input of a first-order lag.

    Exact for an input that is linear within the step.
    """
    if time_constant <= 0:
        return 0.0, 0.0, 1.0
    x = step / time_constant
    if x <= 0:
        return 1.0, 0.0, 0.0
    decay = np.exp(-x)
    held = -np.expm1(-x) / x
    return decay, held - decay, 1 - held


@kernel
def _shaft(axis: Array, cosine: float, sine: float) -> tuple[float, float, float, float]:
    """Direction of the shaft on a tilted axis, and the length that normalises its horizontal
    part."""
    length = np.sqrt(axis[0] ** 2 + axis[2] ** 2)
    return (
        cosine * axis[2] / length + sine * axis[0],
        sine * axis[1],
        -cosine * axis[0] / length + sine * axis[2],
        length,
    )


@inner
def _operate(
    c: Array, time_inputs: Array, memory: Array, wind: float
) -> tuple[float, float, float, float, float]:
    """Thrust and its slope by the relative wind; then operating point, driven and induced velocity.

    With the local coefficient Ct / (1 - a)^2 of the wind through the disc, thrust is
    rho A / 2 Ct / (1 - a)^2 (W - w)^2; in a steady wind w = a W, and it is rho A / 2 Ct W^2.
    """
    step = 0.0
    if len(memory) > 0:
        step = max(time_inputs[_TIME_INPUT] - memory[_TIME], 0.0)
    mean = c[_MEAN]
    operating, operating_slope = wind, 1.0
    if c[_CONTROL_TIME] > 0:
        past, last, new = lag_weights(step, c[_CONTROL_TIME])
        departure = past * memory[_OPERATING] + last * memory[_WIND] + new * (wind - mean)
        operating, operating_slope = mean + departure, new
    coefficient, by_wind = thrust_coefficient(part(c, _TABLE, len(c)), operating)
    a, by_coefficient = induction(coefficient)
    a_slope = by_coefficient * by_wind * operating_slope
    driven, driven_slope = a * wind, a + wind * a_slope
    induced, induced_slope = driven, driven_slope
    if c[_INFLOW_TIME] > 0:
        past, last, new = lag_weights(step, c[_INFLOW_TIME])
        head = driven - c[_MEAN_INDUCED]
        departure = past * memory[_INDUCED] + last * memory[_DRIVEN] + new * head
        induced, induced_slope = c[_MEAN_INDUCED] + departure, new * driven_slope
    through = wind - induced
    local = coefficient / (1 - a) ** 2
    local_slope = by_wind * operating_slope / (1 - a) ** 2
    local_slope += 2 * coefficient / (1 - a) ** 3 * a_slope
    square = through * abs(through)
    thrust = c[_PRESSURE] * local * square
    slope = local_slope * square + 2 * local * abs(through) * (1 - induced_slope)
    return thrust, c[_PRESSURE] * slope, operating, driven, induced


@inner
def _relative_wind(
    motion: Array, time_inputs: Array, n: tuple[float, float, float, float]
) -> float:
    return (
        time_inputs[_WIND_INPUT] - motion[_V] * n[0] - motion[_V + 1] * n[1] - motion[_V + 2] * n[2]
    )


@force_kernel
def _forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    c = constants[0]
    n = _shaft(motion[0, AXIS], c[_COSINE], c[_SINE])
    thrust, _, _, _, _ = _operate(c, time_inputs, memory, _relative_wind(motion[0], time_inputs, n))
    for j in range(3):
        force[0, j] = thrust * n[j]
        force[0, 3 + j] = 0.0
    return 0.0


@tangent_kernel
def _tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    c = constants[0]
    axis, cosine, sine = motion[0, AXIS], c[_COSINE], c[_SINE]
    n = _shaft(axis, cosine, sine)
    thrust, slope, _, _, _ = _operate(
        c, time_inputs, memory, _relative_wind(motion[0], time_inputs, n)
    )
    by_axis = stack_matrix(3, 3)
    clear(by_axis)
    cube = n[3] ** 3
    by_axis[0, 0] = sine - cosine * axis[2] * axis[0] / cube
    by_axis[0, 2] = cosine * axis[0] * axis[0] / cube
    by_axis[1, 1] = sine
    by_axis[2, 0] = -cosine * axis[2] * axis[2] / cube
    by_axis[2, 2] = sine + cosine * axis[0] * axis[2] / cube
    for i in range(3):
        for j in range(3):
            blocks[0, BY_VELOCITY, i, j] = -slope * n[i] * n[j]
            turned = 0.0
            for k in range(3):
                turned += motion[0, _V + k] * by_axis[k, j]
            blocks[0, BY_AXIS, i, j] = thrust * by_axis[i, j] - slope * n[i] * turned


@commit_kernel
def _commit(motion: Array, constants: Array, time_inputs: Array, memory: Array) -> float:
    if len(memory) == 0:
        return 0.0
    c = constants[0]
    wind = _relative_wind(motion[0], time_inputs, _shaft(motion[0, AXIS], c[_COSINE], c[_SINE]))
    _, _, operating, driven, induced = _operate(c, time_inputs, memory, wind)
    memory[_TIME] = time_inputs[_TIME_INPUT]
    memory[_WIND] = wind - c[_MEAN]
    memory[_OPERATING] = operating - c[_MEAN]
    memory[_DRIVEN] = driven - c[_MEAN_INDUCED]
    memory[_INDUCED] = induced - c[_MEAN_INDUCED]
    return 0.0


@dataclass(frozen=True, eq=False)
class RotorThrust(KernelLoad):
    """Thrust of an operating rotor on its structure.

    Attributes
    ----------
    disc : RotorDisc
        Geometry of the rotor.
    wind : WindHistory
        Wind at the rotor; its departure from the mean is ramped.
    control : {"lagged", "instant"}
        ``lagged``: the thrust coefficient follows the relative wind through a first-order lag, so
        that rotor speed and pitch do not respond to fast motion, and the damping is rho A Ct U;
        ``instant``: it follows the relative wind without lag, and the damping is the slope of the
        thrust curve, negative above rated.
    control_time : float, s
        Time constant of that lag.
    inflow_lag : bool
        Whether the wake follows the wind with its own lag.
    name : str
        Short, unique in a system.
    """

    disc: RotorDisc
    wind: WindHistory
    control: Control = "lagged"
    control_time: float = CONTROL_TIME
    inflow_lag: bool = False
    name: str = "rotor_thrust"

    __repr__ = one_line

    force_kernel = _forces
    tangent_kernel = _tangents
    commit_kernel = _commit

    def __post_init__(self) -> None:
        if self.control not in ("lagged", "instant"):
            raise InputError(
                "rotor thrust, control", self.control, "lagged or instant", "Choose one of them."
            )
        if not (np.isfinite(self.control_time) and self.control_time > 0):
            raise InputError(
                "rotor thrust, control_time",
                self.control_time,
                "a positive number of seconds",
                "Use control instant for no lag.",
            )
        first, *_, last = self.disc.rotor.thrust_coefficient.wind_speed
        if not first <= self.wind.mean <= last:
            raise InputError(
                "rotor thrust, mean wind speed in m/s",
                self.wind.mean,
                f"{first} to {last}, the turbine's table of the thrust coefficient",
                "Choose a wind in which the rotor operates, or extend the table.",
            )

    @property
    def height(self) -> Array:
        """Height in m where the shaft crosses the tower's axis, above the yaw bearing."""
        return np.array([self.disc.shaft_height])

    @cached_property
    def constants(self) -> Array:
        table = ThrustTable(self.disc)
        mean = self.wind.mean
        head = [
            np.cos(self.disc.tilt),
            np.sin(self.disc.tilt),
            self.disc.rotor.air_density * self.disc.area / 2,
            mean,
            self.control_time if self.control == "lagged" else 0.0,
            inflow_time(self.disc, mean) if self.inflow_lag else 0.0,
            table.induction(mean)[0] * mean,
        ]
        return np.concatenate([head, table.numbers])[None, :]

    @property
    def memory_size(self) -> int:
        return 5 if self.control == "lagged" or self.inflow_lag else 0

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """Time and wind speed along the shaft.

        Parameters
        ----------
        time : (t,) array, s
        ramp_factor : (t,) array

        Returns
        -------
        (t, 2) array
        """
        mean = self.wind.mean
        return np.column_stack([time, mean + ramp_factor * (self.wind.at(time) - mean)])

    def attributes(self) -> dict[str, str]:
        return {"rotor_wind_origin": self.wind.origin, "rotor_control": self.control}

    def steady_load(self) -> Array:
        """Load at the yaw bearing in the mean wind on an upright axis.

        Returns
        -------
        (6,) array, N and N m
        """
        thrust = float(thrust_curve(self.disc, np.array([self.wind.mean]))[0])
        force = thrust * np.array([np.cos(self.disc.tilt), 0.0, np.sin(self.disc.tilt)])
        return np.concatenate([force, np.cross([0.0, 0.0, self.disc.tower_to_shaft], force)])

    def shaft(self, axis: Array) -> Array:
        """Downwind direction of the shaft on a tower with an inclined axis.

        Parameters
        ----------
        axis : (3,) array
            Direction of the tower's axis.

        Returns
        -------
        (3,) array
        """
        return np.array(_shaft(axis, np.cos(self.disc.tilt), np.sin(self.disc.tilt))[:3])

    def response(self, omega: float) -> complex:
        """Change of the thrust per change of the relative wind, about the mean wind.

        Its real part damps the motion of the hub.

        Parameters
        ----------
        omega : float, rad/s
            Angular frequency of the relative wind.

        Returns
        -------
        complex, N s/m
        """
        table, mean = ThrustTable(self.disc), self.wind.mean
        coefficient, by_wind = table.coefficient(mean)
        a, by_coefficient = table.induction(mean)
        operating = 1.0 + 0j
        if self.control == "lagged":
            operating = 1 / (1 + 1j * omega * self.control_time)
        driven = a + mean * by_coefficient * by_wind * operating
        induced = driven
        if self.inflow_lag:
            induced = driven / (1 + 1j * omega * inflow_time(self.disc, mean))
        local = coefficient / (1 - a) ** 2
        local_slope = by_wind * (1 / (1 - a) ** 2 + 2 * coefficient / (1 - a) ** 3 * by_coefficient)
        through = (1 - a) * mean
        change = local_slope * operating * through**2 + 2 * local * through * (1 - induced)
        return complex(self.disc.rotor.air_density * self.disc.area / 2 * change)
