"""Equivalent viscous damping of a soil spring: dissipated over stored energy in a harmonic
cycle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.loads.point_load import KernelLoad
from offwind_pin.loads.soil.springs.elastic import SoilSprings, SpringComponent

_STEPS = 400
"""Steps per cycle. Reversal at the peaks leaves a second-order error, 2e-5 of the energy."""
_COLUMNS = 21
"""Number of columns of the motion of a point."""


def equivalent_damping(
    springs: SoilSprings, amplitudes: ArrayLike, frequencies: ArrayLike, *, node: int
) -> xr.Dataset:
    """Damping ratio E / (2 pi K Y^2) of one spring in harmonic motion y = Y sin(2 pi f t).

    E is the work done against the load in a cycle, dashpot included, and K the static secant
    stiffness at the peak; sliders are loaded once before. At resonance a structure on this spring
    alone has this damping ratio of critical (Chopra, Dynamics of Structures, Sec. 3.9, in the form
    E / (4 pi E_s) with the elastic energy E_s = K Y^2 / 2).

    Parameters
    ----------
    springs : SoilSprings
        Springs of a foundation.
    amplitudes : (a,) array_like
        Amplitudes Y in m, or in rad for rotational springs, above zero.
    frequencies : (f,) array_like, Hz
        Frequencies above zero.
    node : int
        Index of the spring, from the mudline down.

    Returns
    -------
    Dataset
        Over ``amplitude`` and ``frequency`` with ``damping_ratio`` and ``energy_per_cycle``
        (J), and over ``amplitude`` with ``secant_stiffness`` (N/m, or N m/rad).

    Raises
    ------
    InputError
        Amplitudes or frequencies that are not above zero, no such node, or one without resistance.
    """
    amplitude, frequency = (
        _above_zero("amplitudes", amplitudes),
        _above_zero("frequencies", frequencies),
    )
    spring = _single(springs, node)
    energy = np.empty((len(amplitude), len(frequency)))
    secant = np.empty(len(amplitude))
    for i, size in enumerate(amplitude):
        for j, rate in enumerate(frequency):
            energy[i, j], secant[i] = _cycle(spring, float(size), 2 * np.pi * float(rate))
    ratio = energy / (2 * np.pi * secant * amplitude**2)[:, None]
    unit, stiffness_unit = ("rad", "N m/rad") if springs.component.turns else ("m", "N/m")
    both = ("amplitude", "frequency")
    return xr.Dataset(
        {
            "damping_ratio": (both, ratio, {"long_name": "equivalent damping ratio", "units": "1"}),
            "energy_per_cycle": (both, energy, {"long_name": "work in a cycle", "units": "J"}),
            "secant_stiffness": (
                "amplitude",
                secant,
                {"long_name": "force over displacement at the peak", "units": stiffness_unit},
            ),
        },
        {
            "amplitude": ("amplitude", amplitude, {"units": unit}),
            "frequency": ("frequency", frequency, {"units": "Hz"}),
        },
        {"spring": springs.name, "height_m": float(springs.height[node])},
    )


def _cycle(spring: SoilSprings, amplitude: float, rate: float) -> tuple[float, float]:
    """Work in J over a cycle, from one peak to the next, and secant stiffness at the peak.

    rate : 2 pi f in rad/s
    """
    (load,), component = spring.compiled(), spring.component
    memory = np.zeros(load.memory_size)
    for share in np.linspace(0.0, 1.0, _STEPS // 4 + 1):
        motion = _motion(component, share * amplitude, 0.0)
        load.commit_kernel(motion, load.constants, np.zeros(0), memory)
    peak = _force(load, component, _motion(component, amplitude, 0.0), memory)
    phase = 2 * np.pi * np.arange(1, _STEPS + 1) / _STEPS
    power = np.empty(_STEPS)
    for k, angle in enumerate(phase):
        speed = -rate * amplitude * np.sin(angle)
        motion = _motion(component, amplitude * np.cos(angle), speed)
        power[k] = _force(load, component, motion, memory) * speed
        load.commit_kernel(motion, load.constants, np.zeros(0), memory)
    # equal weights are the trapezoidal rule, since the speed vanishes at both ends
    return float(np.sum(power) * 2 * np.pi / rate / _STEPS), peak / amplitude


def _motion(component: SpringComponent, deflection: float, speed: float) -> Array:
    """(1, 21) motion of the spring's point along its first direction."""
    motion = np.zeros((1, _COLUMNS))
    motion[0, component.deflection] = deflection
    motion[0, component.rate] = speed
    return motion


def _force(load: KernelLoad, component: SpringComponent, motion: Array, memory: Array) -> float:
    """Force in N, or moment in N m, that holds the spring in place."""
    force = np.zeros((1, 6))
    load.force_kernel(motion, load.constants, np.zeros(0), memory, force)
    return -float(force[0, component.force])


def _single(springs: SoilSprings, node: int) -> SoilSprings:
    """A single spring."""
    count = len(springs.height)
    if not 0 <= node < count:
        raise InputError("node", node, f"0 to {count - 1}", "Count from the mudline down.")
    curves = springs.curves.at(np.array([node]))
    if springs.curves.secant(np.zeros(count))[node] <= 0:
        raise InputError(
            "node",
            f"{node}, at a height of {springs.height[node]:.6g} m",
            "a node at which the soil resists",
            "Choose a deeper node.",
        )
    height, length = springs.height[[node]], springs.tributary_length[[node]]
    return replace(springs, height=height, tributary_length=length, curves=curves)


def _above_zero(name: str, given: ArrayLike) -> Array:
    values = np.atleast_1d(np.asarray(given, dtype=float))
    if values.ndim != 1 or not np.all((values > 0) & np.isfinite(values)):
        raise InputError(name, given, "finite numbers above zero", "Remove the others.")
    return values
