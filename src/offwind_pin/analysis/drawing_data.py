"""Data stored in results so that figures, pages and reports can be made from results alone."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.definition import Array
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.current import mean_velocity
from offwind_pin.loads.sea.sea import StillWater
from offwind_pin.loads.sea.waves.surface import SurfaceWaves
from offwind_pin.loads.soil.springs.elastic import SoilSprings
from offwind_pin.structure.section import frusta, outer_diameter

Constants = dict[str, tuple[str, Array, dict[str, str]]]

_SHOWN_DEPTHS = (1 / 15, 2 / 15, 1 / 4, 1 / 2, 3 / 4)
"""Depths over the embedded length at which a report shows p-y curves."""
_UNUSED_END = 0.05
"""m, end of the shown curves if the displacements reached are unknown."""
_FULL_END = 0.1
"""End of the stored curves over the diameter of the pile."""


def drawing_data(system: System) -> Constants:
    """Outline of the wall, and wave components.

    Of a sea with more than 4000 components, the fewest with 99.9 % of the variance are kept.
    """
    return outline(system) | _waves(system)


def drawing_attributes(system: System) -> dict[str, Any]:
    """Mudline, rotor-nacelle assembly as defined, and the sea in words."""
    sea = system.sea
    water = {} if sea is None else {"water_level_m": sea.water_level, "waves": sea.in_words}
    return {
        "mudline_m": system.turbine.site.mudline,
        "rotor_nacelle": system.turbine.rna.model_dump_json(),
        **water,
    }


def system_attributes(system: System) -> dict[str, Any]:
    """Provenance of a static state or of natural modes."""
    return {
        "turbine": system.turbine.name,
        "definition_sha256": system.turbine.content_hash,
        "foundation": system.foundation.name,
        "sea": repr(system.sea) if system.sea else "dry",
        "surrogates": system.foundation.surrogate or "none",
        "elements": system.chain.elements,
    }


def static_dataset(system: System, state: StaticResult) -> xr.Dataset:
    """A static state with its provenance."""
    return state.to_dataset().assign_attrs(system_attributes(system))


def modes_dataset(system: System, result: ModalResult) -> xr.Dataset:
    """Natural modes with their provenance and the data for drawing them."""
    attributes = system_attributes(system) | drawing_attributes(system) | _root(system)
    drawn = outline(system) | _springs(system) | _strokes(system, result)
    return result.to_dataset().assign(drawn).assign_attrs(attributes)


def _root(system: System) -> dict[str, str]:
    return {"root": "fixed" if system.foundation.root is None else "flexible"}


def _springs(system: System) -> Constants:
    """Heights of the lateral soil springs of a pile, if there are any."""
    soil = soil_springs(system)
    if soil is None:
        return {}
    about = {"long_name": "height of the soil spring", "units": "m"}
    return {"spring_height": ("spring", soil.height, about)}


def _strokes(system: System, result: ModalResult) -> dict[str, Any]:
    """Heights of tuned mass dampers, and their strokes in each mode along x, y, z."""
    masses = system.chain.tuned_masses
    if not masses:
        return {}
    stroke = np.zeros((len(result.label), len(masses), 3))
    sliding = iter(result.vector[system.chain.axis_joints :])
    for d, mass in enumerate(masses):
        for joint in mass.joints:
            stroke[:, d, "xyz".index(joint[1])] = next(sliding)
    about = {"long_name": "stroke with unit modal mass", "units": "kg^-1/2"}
    return {
        "damper": ("damper", [mass.name for mass in masses], {"long_name": "tuned mass damper"}),
        "damper_height": (
            "damper",
            np.array([mass.height for mass in masses]),
            {"long_name": "height", "units": "m"},
        ),
        "damper_stroke": (("mode", "damper", "direction"), stroke, about),
    }


def outline(system: System) -> Constants:
    """Outer diameters at both ends of all frusta, upwards; heights repeat where the diameter
    jumps."""
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


def structure_dataset(system: System) -> xr.Dataset:
    """Dimensions, masses and foundation of a system, for drawings and tables."""
    chain, turbine = system.chain, system.turbine
    boundary = chain.boundary
    member, height, diameter = _stations(system)
    variables = {
        "boundary_height": ("boundary", boundary, "height of the element boundary", "m"),
        "boundary_diameter": (
            "boundary",
            outer_diameter(turbine, boundary),
            "outer diameter at the element boundary",
            "m",
        ),
        "station_member": ("station", member, "member that the station belongs to", None),
        "station_height": ("station", height, "height of the station", "m"),
        "station_diameter": ("station", diameter, "outer diameter at the station", "m"),
        "rotor_nacelle_center_of_mass": (
            "direction",
            chain.rna.center_of_mass,
            "centre of mass of the rotor-nacelle assembly, from the yaw bearing",
            "m",
        ),
        "rotor_nacelle_mass": ((), chain.rna.mass, "mass of the rotor-nacelle assembly", "kg"),
        "support_structure_mass": (
            (),
            sum(body.mass for body in chain.body),
            "mass of tower and monopile from the base upwards",
            "kg",
        ),
    }
    dampers = turbine.tuned_mass_dampers
    if dampers:
        frequency = [np.sqrt(mass.stiffness / mass.mass) / (2 * np.pi) for mass in dampers]
        variables |= {
            "damper_mass": ("damper", [mass.mass for mass in dampers], "sliding mass", "kg"),
            "damper_height": ("damper", [mass.z for mass in dampers], "height", "m"),
            "damper_frequency": ("damper", frequency, "natural frequency, locked carrier", "Hz"),
            "damper_direction": (
                "damper",
                [mass.direction for mass in dampers],
                "direction of sliding",
                None,
            ),
        }
    hydrodynamics = system.hydrodynamics
    waves = None if hydrodynamics is None else hydrodynamics.surface.waves
    data = xr.Dataset(
        {
            name: (dims, values, {"long_name": text} | ({} if unit is None else {"units": unit}))
            for name, (dims, values, text, unit) in variables.items()
        },
        {"direction": ("direction", ["x", "y", "z"], {"long_name": "axis of the inertial frame"})},
        {
            **system_attributes(system),
            **drawing_attributes(system),
            "surrogate": system.foundation.surrogate or "",
            "base_m": chain.base,
            "yaw_bearing_m": chain.top,
            "water_depth_m": turbine.site.water_depth,
            "degrees_of_freedom": system.nv,
            **_root(system),
            "sea_in_words": sea_in_words(system),
            "surface": "calm" if waves is None else "waves",
        },
    ).assign(_springs(system))
    if dampers:
        names = [mass.name for mass in dampers]
        data = data.assign_coords(damper=("damper", names, {"long_name": "tuned mass damper"}))
    return data


def _stations(system: System) -> tuple[list[str], Array, Array]:
    """Member, height and outer diameter of all stations, from the base of the chain upwards."""
    base, turbine = system.chain.base, system.turbine
    rows: list[tuple[str, float, float]] = []
    for member in turbine.members:
        above = [(member.name, s.z, s.diameter) for s in member.stations if s.z >= base]
        if above and above[0][1] > base > member.bottom:
            cut = float(outer_diameter(turbine, np.array([base]))[0])
            above.insert(0, (member.name, base, cut))
        rows += above
    name, height, diameter = zip(*rows, strict=True)
    return list(name), np.array(height), np.array(diameter)


def sea_in_words(system: System) -> str:
    """Waves, mean level, stretching and current in words."""
    sea = system.sea
    if sea is None:
        return "none (dry)"
    words = [sea.in_words]
    if sea.water_level:
        words.append(f"mean level at z = {sea.water_level:g} m")
    if sea.stretching != "none" and not isinstance(sea, StillWater):
        words.append(f"stretched to the surface ({sea.stretching})")
    if sea.current is not None:
        x, y, _ = mean_velocity(sea.current, sea.water_level - system.turbine.site.mudline)
        speed, towards = float(np.hypot(x, y)), float(np.degrees(np.arctan2(y, x)))
        words.append(f"depth-averaged current of {speed:.3g} m/s towards {towards:.3g} degrees")
    return ", ".join(words)


def damping_dataset(system: System) -> xr.Dataset | None:
    """Structural damping requested and achieved, or None for a turbine without."""
    asked = system.turbine.structural_damping
    if asked is None:
        return None
    requested, achieved = asked.ratios or {}, system.damping_ratios
    labels = list(dict.fromkeys([*requested, *achieved]))
    about = {"units": "1"}
    return xr.Dataset(
        {
            name: (
                "mode",
                [ratios.get(label, np.nan) for label in labels],
                {"long_name": f"damping ratio {name}, of critical; NaN for none"} | about,
            )
            for name, ratios in (("requested", requested), ("achieved", achieved))
        },
        {"mode": ("mode", np.array(labels, dtype=str), {"long_name": "label of the mode"})},
        {
            "kind": asked.kind,
            "definition": asked.model_dump_json(by_alias=True, exclude_none=True),
            "foundation": asked.foundation or system.foundation.name,
            "water": "still water" if asked.wet(in_water=system.sea is not None) else "dry",
            "cautions": json.dumps(system.damping_cautions),
        },
    )


def soil_dataset(soil: SoilSprings, mudline: float, reached: Array | None = None) -> xr.Dataset:
    """Lateral p-y curves at all nodes of a pile, and the displacements reached.

    The curves have 201 points in the range that a report shows, and further ones up to a tenth of
    the pile diameter.

    Parameters
    ----------
    mudline : float, m
    reached : (n,) array, m, optional
        Largest lateral displacement of each node.
    """
    depth = mudline - soil.height
    shown = np.unique(np.searchsorted(depth, np.array(_SHOWN_DEPTHS) * depth[-1] - 1e-9))
    end = _UNUSED_END if reached is None else max(1.05 * float(np.max(reached[shown])), 1e-4)
    y = np.linspace(0, end, 201)
    if end < _FULL_END:
        y = np.concatenate([y, np.geomspace(end, _FULL_END, 40)[1:]])
    resistance = np.array([soil.curves.resistance(np.full(len(depth), value)) for value in y])
    variables = {
        "height": ("spring", soil.height, "undeformed height of the node", "m"),
        "depth": ("spring", depth, "depth of the node below the mudline", "m"),
        "resistance": (("spring", "y"), resistance.T, "lateral soil resistance", "N/m"),
    }
    if reached is not None:
        variables["reached"] = ("spring", reached, "largest lateral displacement reached", "m")
    return xr.Dataset(
        {
            name: (dims, values, {"long_name": text, "units": unit})
            for name, (dims, values, text, unit) in variables.items()
        },
        {"y": ("y", y, {"long_name": "lateral displacement", "units": "m"})},
        {"shown_nodes": shown, "shown_end_m": end},
    )


def _waves(system: System) -> Constants:
    """eta = sum a cos(2 pi f t + phase - kx x - ky y) above the water level, fully developed."""
    waves = None if system.hydrodynamics is None else system.hydrodynamics.surface.waves
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
