"""What results carry so that a moving picture can be made of them alone."""

from __future__ import annotations

from typing import Any

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.waves.surface import SurfaceWaves
from offwind_pin.structure.section import frusta

Constants = dict[str, tuple[str, Array, dict[str, str]]]


def scenery(system: System) -> Constants:
    """The outline of the wall, and the waves as components if there are any.

    Of a sea with more than 4000 components the fewest are kept that hold 99.9 % of its variance.
    """
    return outline(system) | _waves(system)


def told(system: System) -> dict[str, Any]:
    """Attributes: mudline, rotor-nacelle assembly as defined, and the sea in words."""
    sea = system.sea
    water = {} if sea is None else {"water_level_m": sea.water_level, "waves": sea.in_words}
    return {
        "mudline_m": system.turbine.site.mudline,
        "rotor_nacelle": system.turbine.rna.model_dump_json(),
        **water,
    }


def outline(system: System) -> Constants:
    """Outer diameters at both ends of all frusta, upwards; heights repeat where it jumps."""
    chain = system.chain
    ends = [
        end
        for base, shell in frusta(system.turbine, chain.base, chain.top)
        for end in ((base, shell.outer_bottom), (base + shell.height, shell.outer_top))
    ]
    height, radius = np.array(ends).T
    return {
        "outline_height": ("outline", height, {"long_name": "height of the outline", "units": "m"}),
        "outline_diameter": ("outline", 2 * radius, {"long_name": "outer diameter", "units": "m"}),
    }


def _waves(system: System) -> Constants:
    """eta = sum a cos(2 pi f t + phase - kx x - ky y) above the water level, grown fully."""
    waves = None if system.waters is None else system.waters.surface.waves
    surface = None if waves is None else SurfaceWaves.of(waves)
    if surface is None:
        return {}
    kept = surface.largest()
    values = {
        "wave_frequency": (kept.frequency, "frequency of the component", "Hz"),
        "wave_amplitude": (np.abs(kept.elevation), "amplitude of the component", "m"),
        "wave_phase": (np.angle(kept.elevation), "phase at x = y = 0 and time 0", "rad"),
        "wave_number_x": (kept.number_x, "wave number along x", "rad/m"),
        "wave_number_y": (kept.number_y, "wave number along y", "rad/m"),
    }
    return {
        name: ("wave_component", np.asarray(array), {"long_name": about, "units": units})
        for name, (array, about, units) in values.items()
    }
