"""The thrust of the turbine's own rotor in a turbulent wind, as a load case names it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from offwind_pin.base.definition import Flag, Positive, key
from offwind_pin.loads.wind.rotor_effective_wind import RotorWind
from offwind_pin.loads.wind.rotor_thrust import CONTROL_TIME, Control


class RotorLoad(RotorWind):
    """A wind, and how rotor and controller follow it, see :class:`RotorThrust`.

    Attributes
    ----------
    control : {"lagged", "instant"}
        ``"lagged"`` or ``"instant"``.
    control_time : float, s
        With which a lagged thrust coefficient follows the wind.
    inflow_lag : bool
        Whether the wake follows with a lag of its own.
    """

    kind: Literal["rotor"] = "rotor"
    control: Control = "lagged"
    control_time: Annotated[Positive, Field(le=1000)] = key("control_time_s", default=CONTROL_TIME)
    inflow_lag: Flag = False
