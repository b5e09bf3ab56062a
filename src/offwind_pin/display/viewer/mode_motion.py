"""A mode as motion that a person can see: poses over one cycle, and how far each body swings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.base.definition import Array
from offwind_pin.dynamics.reference.poses import body_poses, sliding_mass_poses
from offwind_pin.dynamics.system import System

FRAMES = 60
"""Poses in a cycle; between them the viewer interpolates, within 0.2 % of the amplitude."""

PEAK_SHARE = 0.08
"""Peak displacement over the height of the structure."""
PEAK_TWIST = np.radians(30.0)
"""Peak rotation of a torsional mode in rad."""
PEAK_TILT = np.radians(35.0)
"""Largest rotation of a bending mode in rad, which bounds its peak: a shape with short waves would
curl up, and the rotor swing wildly, long before it moved by that share of the height."""


@dataclass(frozen=True)
class ModeMotion:
    """One cycle of a mode.

    Attributes
    ----------
    family : str
        FA, SS, T or V.
    poses : (FRAMES + 1, N + 1, 4, 4) array
        Of the bodies, a sine from and to the upright state.
    sliding : (FRAMES + 1, D, 4, 4) array
        Of the masses of tuned mass dampers.
    share : (N + 1,) array
        Amplitude of each body over the largest one.
    peak : float
        The largest amplitude drawn, in m, or in rad for torsion.
    """

    family: str
    poses: Array
    sliding: Array
    share: Array
    peak: float


def mode_motion(system: System, result: ModalResult, label: str) -> ModeMotion:
    """Motion of a mode at a scale to be seen, about the undeformed state.

    The joint displacements swing in proportion to the modal vector; forward kinematics keeps each
    body rigid and the axis unbroken at any amplitude.

    Raises
    ------
    InputError
        No mode of that label among those computed.
    """
    index = result.index(label)
    family = result.direction(label)
    amplitude = body_amplitude(result, label)
    largest = float(amplitude.max())
    scale = np.inf  # of a damper on a clamped base, which moves nothing else
    if largest > 0:
        scale = _scale(system, result.mass_normalised[index], family, largest)
    slips = np.abs(result.vector[system.chain.axis_joints :, index])
    if slips.any():
        scale = min(scale, _widest(system) / float(slips.max()))
    vector = scale * result.vector[:, index]
    phase = 2 * np.pi * np.arange(FRAMES + 1) / FRAMES
    swing = [np.sin(angle) * vector for angle in phase]
    return ModeMotion(
        family=family,
        poses=np.array([body_poses(system, q) for q in swing]),
        sliding=np.array([sliding_mass_poses(system, q) for q in swing]),
        share=amplitude / (largest or 1.0),
        peak=scale * largest,
    )


def body_amplitude(result: ModalResult, label: str) -> Array:
    """(N + 1,) displacement of each body at unit modal mass in m, or rotation in rad for torsion.

    It is taken at the element boundary that the body crosses, or ends at if lowest or highest.
    """
    shape = result.mass_normalised[result.index(label)]
    if result.direction(label) == "T":
        return np.asarray(np.abs(shape[:, 5]))
    return np.asarray(np.linalg.norm(shape[:, :3], axis=1))


def _widest(system: System) -> float:
    """Peak displacement drawn in m, of the axis or of a tuned mass damper against it."""
    return PEAK_SHARE * (system.chain.top - system.chain.base)


def _scale(system: System, shape: Array, family: str, largest: float) -> float:
    """Factor on the mass-normalised mode."""
    if family == "T":
        return float(PEAK_TWIST / largest)
    wanted = _widest(system)
    tilt = float(np.linalg.norm(shape[:, 3:], axis=1).max())
    return float(min(wanted / largest, PEAK_TILT / tilt if tilt > 0 else np.inf))
