"""Rotor-nacelle assembly as meshes, for display only."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.rotor_nacelle import rotor_apex
from offwind_pin.definitions.turbine import RigidBodyRNA, RotorNacelleRNA
from offwind_pin.structure.meshes import FACETS, Mesh, box, loft

_SPAN = np.array([0.0, 0.03, 0.08, 0.14, 0.22, 0.35, 0.5, 0.65, 0.8, 0.9, 0.96, 1.0])
_CHORD = np.array([0.05, 0.05, 0.053, 0.061, 0.066, 0.06, 0.05, 0.04, 0.03, 0.023, 0.016, 0.005])
_THICKNESS = np.array([1.0, 1.0, 0.8, 0.55, 0.42, 0.34, 0.3, 0.27, 0.25, 0.24, 0.24, 0.24])
_TWIST_DEG = np.array([14.5, 14.5, 14.5, 13, 10.5, 7.5, 4.5, 2.5, 1.0, 0.2, 0.0, 0.0])
"""Typical blade: span and chord over length, thickness over chord, twist."""


def rna_meshes(rna: RigidBodyRNA | RotorNacelleRNA, tower_diameter: float) -> dict[str, Mesh]:
    """Meshes by name, in axes whose origin is the yaw bearing, in m.

    Nacelle, hub and blades with one blade pointing up or, for a definition without a rotor, a
    nacelle about the centre of mass.

    Parameters
    ----------
    tower_diameter : float, m
        Outer diameter at the yaw bearing, which determines the width of the nacelle.
    """
    breadth = 1.35 * tower_diameter
    if isinstance(rna, RigidBodyRNA):
        half = np.array([breadth, breadth / 2, breadth / 2])
        center = np.array(rna.center_of_mass)
        return {"nacelle": box(list(center - half), list(center + half))}
    apex, shaft = rotor_apex(rna)
    radius = max(1.15 * rna.hub_radius, _CHORD[0] * rna.blade.length * 0.6)
    blades = {
        f"blade_{i + 1}": _blade(rna, azimuth=2 * np.pi * i / rna.blades) for i in range(rna.blades)
    }
    return {"nacelle": _nacelle(rna, breadth, radius), "hub": _hub(apex, shaft, radius)} | blades


def _nacelle(rna: RotorNacelleRNA, breadth: float, hub_radius: float) -> Mesh:
    """Rounded body from behind the hub over the tower, as far again behind it."""
    front, back = rna.overhang + np.sign(-rna.overhang) * hub_radius * 0.9, -0.9 * rna.overhang
    height = max(breadth, 1.6 * rna.tower_to_shaft)
    along = np.array([0.0, 0.03, 0.1, 0.8, 0.95, 1.0])
    size = np.array([0.72, 0.8, 0.9, 1.0, 0.93, 0.8])
    low, high = min(front, back), max(front, back)
    if rna.overhang > 0:
        along, size = 1 - along[::-1], size[::-1]
    angle = np.linspace(0, 2 * np.pi, FACETS, endpoint=False)
    square = np.column_stack([_rounded(np.cos(angle)), _rounded(np.sin(angle))]) / 2
    middle = rna.tower_to_shaft + 0.05 * height
    sections = [
        np.column_stack(
            [
                np.full(FACETS, low + s * (high - low)),
                scale * breadth * square[:, 0],
                middle + scale * height * square[:, 1],
            ]
        )
        for s, scale in zip(along, size, strict=True)
    ]
    return loft(np.array(sections))


def _hub(apex: Array, shaft: Array, radius: float) -> Mesh:
    """Spinner: a paraboloid pointing upwind on a short drum, about the shaft axis."""
    upwind = np.array([1.05, 0.95, 0.75, 0.45, 0.1, -0.9, -1.0])
    size = np.array([0.03, 0.36, 0.66, 0.88, 1.0, 1.0, 0.85])
    upright, sideways = _rotor_axes(shaft)
    angle = np.linspace(0, 2 * np.pi, FACETS, endpoint=False)[:, None]
    ring = np.cos(angle) * upright - np.sin(angle) * sideways
    # The loops run from the back to the nose, anticlockwise seen from upwind.
    sections = [
        apex - 1.1 * radius * u * shaft + radius * s * ring
        for u, s in zip(upwind[::-1], size[::-1], strict=True)
    ]
    return loft(np.array(sections))


def _blade(rna: RotorNacelleRNA, azimuth: float) -> Mesh:
    """One blade, chord near the rotor plane; azimuth in rad from the upright position."""
    apex, shaft = rotor_apex(rna)
    upright, sideways = _rotor_axes(shaft)
    cone = np.radians(rna.precone)
    radial = np.cos(azimuth) * upright + np.sin(azimuth) * sideways
    along = np.cos(cone) * radial + np.sin(cone) * shaft
    chordwise = np.cross(shaft, radial)
    normal = np.cross(along, chordwise)
    angle = np.linspace(0, 2 * np.pi, FACETS // 2, endpoint=False)[:, None]
    sections = []
    for span, chord, thickness, twist in zip(_SPAN, _CHORD, _THICKNESS, _TWIST_DEG, strict=True):
        turn = np.radians(twist)
        width = np.cos(turn) * chordwise + np.sin(turn) * normal
        depth = np.cos(turn) * normal - np.sin(turn) * chordwise
        # The pitch axis is ahead of mid-chord where the blade is flat, and at it where round.
        shift = 0.15 * (1 - thickness)
        loop = (np.cos(angle) / 2 - shift) * width + thickness * np.sin(angle) / 2 * depth
        center = apex + (rna.hub_radius + span * rna.blade.length) * along
        sections.append(center + chord * rna.blade.length * loop)
    return loft(np.array(sections))


def _rotor_axes(shaft: Array) -> tuple[Array, Array]:
    """Unit vectors (3,) of the rotor plane: upright, and rotated by 90 degrees about the shaft."""
    upright = np.array([-shaft[2], 0.0, shaft[0]])
    return upright, np.cross(shaft, upright)


def _rounded(value: Array) -> Array:
    """Coordinate of a rounded square from that of a circle."""
    return np.asarray(np.sign(value) * np.abs(value) ** 0.45)
