"""Wind, the rotor's thrust and drag on the tower."""

from offwind_pin.analysis.aerodynamic_damping import aerodynamic_damping
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.loads.wind.profiles import ExtremeOperatingGust, LogLaw, PowerLaw, WindSeries
from offwind_pin.loads.wind.rotor_effective_wind import RotorWind
from offwind_pin.loads.wind.rotor_thrust import RotorThrust
from offwind_pin.loads.wind.synthetic_thrust import SyntheticWind
from offwind_pin.loads.wind.thrust_table import thrust_curve
from offwind_pin.loads.wind.tower_drag import TowerWind, tower_drag

__all__ = [
    "ExtremeOperatingGust",
    "LogLaw",
    "PowerLaw",
    "RotorThrust",
    "RotorWind",
    "SyntheticWind",
    "TowerWind",
    "WindSeries",
    "aerodynamic_damping",
    "rotor_disc",
    "thrust_curve",
    "tower_drag",
]
