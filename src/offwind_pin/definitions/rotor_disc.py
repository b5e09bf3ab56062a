"""Geometry and operation of the disc swept by the rotor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.errors import InputError
from offwind_pin.definitions.rotor import GEOMETRY, Rotor
from offwind_pin.definitions.rotor_nacelle import rotor_radius
from offwind_pin.definitions.turbine import RotorNacelleRNA, Turbine


@dataclass(frozen=True)
class RotorDisc:
    """A turbine's rotor in SI.

    Attributes
    ----------
    rotor : Rotor
        Its tables.
    blades : int
        Number of blades.
    radius, overhang, tower_to_shaft : float, m
        The shaft crosses the tower's axis ``tower_to_shaft`` above the yaw bearing.
    tilt : float, rad
        Tilt of the shaft, negative for an upwind rotor that is tilted upwards.
    shaft_height : float, m
        Height of that crossing above still water level.
    tower_height, tower_diameter : tuple of float, m
        Stations of the tower behind or in front of the rotor.
    """

    rotor: Rotor
    blades: int
    radius: float
    overhang: float
    tower_to_shaft: float
    tilt: float
    shaft_height: float
    tower_height: tuple[float, ...]
    tower_diameter: tuple[float, ...]

    @property
    def hub_height(self) -> float:
        """Height of the rotor apex above still water level in m."""
        return self.shaft_height + self.overhang * float(np.sin(self.tilt))

    @property
    def area(self) -> float:
        """Swept area in m2."""
        return float(np.pi * self.radius**2)

    def speed(self, wind_speed: float) -> float:
        """Rotor speed in rad/s at a wind speed in m/s.

        Raises
        ------
        InputError
            The turbine has no table of the rotor speed.
        """
        table = self.rotor.rotor_speed
        if table is None:
            raise InputError(
                "rotor, field rotor_speed_rpm",
                "a required key is missing",
                "",
                "Add a table {wind_speed_m_per_s: [...], value: [...]}: rotating blades sample "
                "shear, tower shadow and turbulence.",
            )
        return float(np.interp(wind_speed, table.wind_speed, table.value)) * np.pi / 30


def rotor_disc(turbine: Turbine) -> RotorDisc:
    """The disc of a turbine's rotor.

    Parameters
    ----------
    turbine : Turbine

    Returns
    -------
    RotorDisc

    Raises
    ------
    InputError
        The turbine has no block ``rotor``, or one without the position of the rotor.
    """
    rotor, rna = turbine.rotor, turbine.rna
    if rotor is None:
        raise InputError(
            f"turbine {turbine.name}, field rotor",
            "a required key is missing",
            "",
            "Add a block with thrust_coefficient and rated_wind_speed_m_per_s, see "
            "docs/turbine_file.md, or use a tower-top load file.",
        )
    given: RotorNacelleRNA | Rotor = rotor
    if isinstance(rna, RotorNacelleRNA):
        given, radius = rna, rotor.radius or rotor_radius(rna)
    else:
        missing = [name for name in GEOMETRY if getattr(rotor, name) is None]
        if missing or rotor.radius is None:
            keys = [Rotor.model_fields[name].alias or name for name in missing]
            raise InputError(
                f"turbine {turbine.name}, field rotor",
                f"no {', '.join(keys)}",
                "all of these keys, since rna is of kind rigid_body",
                "Add them, or use rna of kind rotor_nacelle.",
            )
        radius = rotor.radius
    return RotorDisc(
        rotor=rotor,
        blades=int(given.blades or 0),
        radius=radius,
        overhang=float(given.overhang or 0.0),
        tower_to_shaft=float(given.tower_to_shaft or 0.0),
        tilt=float(np.radians(given.shaft_tilt or 0.0)),
        shaft_height=turbine.yaw_bearing + float(given.tower_to_shaft or 0.0),
        tower_height=tuple(station.z for station in turbine.members[-1].stations),
        tower_diameter=tuple(station.diameter for station in turbine.members[-1].stations),
    )
