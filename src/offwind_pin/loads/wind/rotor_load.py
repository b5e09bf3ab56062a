"""Thrust of the turbine's rotor in a turbulent wind, as defined in a load case."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from offwind_pin.base.definition import Flag, Positive, key
from offwind_pin.loads.wind.rotor_effective_wind import RotorWind
from offwind_pin.loads.wind.rotor_thrust import CONTROL_TIME, Control


class RotorLoad(RotorWind):
    """A wind, and the response of rotor and controller to it, see :class:`RotorThrust`.

    Attributes
    ----------
    control : {"lagged", "instant"}
        See :class:`RotorThrust`.
    control_time : float, s
        Time constant of a lagged thrust coefficient.
    inflow_lag : bool
        Whether the wake follows the wind with its own lag.
    """

    kind: Literal["rotor"] = "rotor"
    control: Control = "lagged"
    control_time: Annotated[Positive, Field(le=1000)] = key("control_time_s", default=CONTROL_TIME)
    inflow_lag: Flag = False
