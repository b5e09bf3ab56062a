"""Aerodynamic damping of natural modes by an operating rotor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.static import StaticResult, static
from offwind_pin.base.definition import Array
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.dynamics.system import System
from offwind_pin.loads.wind.history import constant_wind
from offwind_pin.loads.wind.rotor_thrust import CONTROL_TIME, Control, RotorThrust


@dataclass(frozen=True, eq=False)
class AerodynamicDamping:
    """Damping of natural modes by the thrust, linearised about a mean wind.

    Attributes
    ----------
    label : list of str
        Labels of the n modes, as in :class:`ModalResult`.
    frequency_hz : (n,) array
        Natural frequencies without aerodynamic damping.
    ratio : (n,) array
        Damping ratio of critical; negative if the thrust feeds energy to the mode.
    """

    label: list[str]
    frequency_hz: Array
    ratio: Array


def aerodynamic_damping(
    system: System,
    wind_speed: float,
    control: Control = "lagged",
    *,
    control_time: float = CONTROL_TIME,
    inflow_lag: bool = False,
    count: int = 8,
) -> AerodynamicDamping:
    """Damping ratios that the thrust of an operating rotor adds to the first modes.

    Parameters
    ----------
    system : System
    wind_speed : float, m/s
        Mean wind speed at the hub.
    control : {"lagged", "instant"}
        As for :class:`RotorThrust`.
    control_time : float, s
        As for :class:`RotorThrust`.
    inflow_lag : bool
        As for :class:`RotorThrust`.
    count : int
        Number of modes.

    Returns
    -------
    AerodynamicDamping

    Raises
    ------
    InputError
        A turbine without a block ``rotor``, or a wind speed outside its table.
    """
    disc = rotor_disc(system.turbine)
    thrust = RotorThrust(disc, constant_wind(wind_speed), control, control_time, inflow_lag)
    state = static(system, loads=[thrust])
    found = modes(system, min(count, system.nv), state)
    ratio = thrust_damping(system, thrust, found, state)
    return AerodynamicDamping(found.label, found.frequency_hz, ratio)


def thrust_damping(
    system: System, thrust: RotorThrust, found: ModalResult, state: StaticResult
) -> Array:
    """(n,) damping ratios that a thrust adds to modes about a static state.

    Of a mode with unit modal mass, zeta = Re H(omega) phi^2 / (2 omega): H is the change of the
    thrust per change of the relative wind, phi the motion of the hub along the shaft.
    """
    equations = system.equations()
    omega = 2 * np.pi * found.frequency_hz
    slope = np.array([thrust.response(value).real for value in omega])
    along = np.empty(len(omega))
    for i, vector in enumerate(found.vector.T):
        motion = equations.chain_motion(state.q, vector).points_at(thrust.height)
        along[i] = motion.velocity[0] @ thrust.shaft(motion.axis[0])
    return slope * along**2 / (2 * omega)
