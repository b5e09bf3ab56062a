"""Earthquakes and tuned mass dampers on single-mode structures, against closed forms."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from scipy.signal import argrelmax

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.pile_only import axis_jacobian
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.analysis.modal import modes
from offwind_pin.analysis.simulate import simulate
from offwind_pin.base.definition import Array
from offwind_pin.definitions.tuned_mass_damper import TunedMassDamper, den_hartog
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.signal.response_spectrum import response_spectrum
from offwind_pin.solvers.steps import FixedStep
from offwind_pin.verification.ledger import Found
from offwind_pin.verification.plain_tubes import tube

_MASS, _LENGTH, _GRAVITY = 1e9, 100.0, 9.81
_STEP = 0.0025


def _single_mass(period: float, ratio: float) -> System:
    """A mass on one element of a hundred thousandth of it: a joint, a spring, a damper.

    The weight reduces the spring stiffness by m g / arm, as in an inverted pendulum.
    """
    turbine = tube(length=_LENGTH, density=100.0, gravity=_GRAVITY, top_mass=_MASS)
    system = build(turbine, "clamped", elements=1)
    own, arm = 2 * np.pi / period, _LENGTH / 2
    inertia = _MASS * arm**2
    stiffness = np.full(system.nv, inertia * (own**2 + _GRAVITY / arm))
    damping = np.full(system.nv, 2 * ratio * own * inertia)
    return replace(system, joint_stiffness=stiffness).with_damping(damping, {})


def earthquake_displacement(period: float) -> Found:
    """Largest displacement in m of a mass relative to the ground, and the spectral ordinate."""
    time = np.linspace(0.0, 16.0, 1601)
    strong = np.sin(np.pi * time / 16.0) ** 2
    wild = sum(np.sin(2 * np.pi * f * time + 7 * f**2) for f in (0.3, 0.7, 1.1, 1.9, 3.3, 4.7))
    record = np.zeros((len(time), 3))
    record[:, 0] = strong * wild
    motion = GroundMotion(time, record)
    undamped = GeneralizedAlpha(FixedStep(_STEP), 1.0)
    data = simulate(_single_mass(period, 0.05), 16.0, ground_motion=motion, integrator=undamped)
    moved = data["tower_top_displacement"] - data["ground_displacement"].isel(level=-1)
    spectrum = response_spectrum(motion.corrected[0], motion.step, np.array([period]), 0.05)
    return Found(float(np.abs(moved.to_numpy()[:, 0]).max()), float(spectrum.displacement[0, 0]))


def harmonic_base() -> Found:
    """Steady amplitude in m of an oscillator on a base that moves as cos, and the closed form."""
    period, ratio, driven = 1.0, 0.1, 2 * np.pi * 1.3
    time = np.linspace(0.0, 20.0, 8001)
    record = np.zeros((len(time), 3))
    record[:, 0] = 0.5 * np.cos(driven * time)
    motion = GroundMotion(time, record)
    data = simulate(_single_mass(period, ratio), 20.0, _STEP, ground_motion=motion)
    moved = data["tower_top_displacement"] - data["ground_displacement"].isel(level=-1)
    late = data["time"].to_numpy() > 15.0
    turn = np.exp(1j * driven * data["time"].to_numpy()[late])
    basis = np.column_stack([turn.real, turn.imag])
    fitted = np.linalg.lstsq(basis, moved.to_numpy()[late, 0])[0]
    own = 2 * np.pi / period
    steady = 0.5 / abs(own**2 - driven**2 + 2j * ratio * own * driven)
    return Found(float(np.hypot(*fitted)), float(steady))


@cache
def _mast() -> tuple[System, float, float]:
    """500 t on a clamped tube of 11 t, its first frequency in Hz and modal mass in kg."""
    system = build(tube(density=100.0, top_mass=5e5, gravity=0.01), "clamped", elements=6)
    found = modes(system, 2)
    row = found.index("FA1")
    top = float(found.mass_normalised[row, -1, 0])
    return system, float(found.frequency_hz[row]), 1 / top**2


def tuned_amplification(mass_ratio: float) -> Found:
    """Largest motion of the top under a harmonic force over that under a constant one.

    With Den Hartog's damper; his optimum is sqrt(1 + 2 / mu).
    """
    bare, frequency, mass = _mast()
    best = den_hartog(mass_ratio)
    damper = TunedMassDamper.model_validate(
        {
            "name": "absorber",
            "z_m": bare.chain.top,
            "mass_kg": mass_ratio * mass,
            "direction": "fore_aft",
            "frequency_hz": best.frequency_ratio * frequency,
            "damping_ratio": best.damping_ratio,
        }
    )
    turbine = bare.turbine.model_copy(update={"tuned_mass_dampers": (damper,)})
    system = build(turbine, "clamped", elements=6)
    equations, rest = system.equations((), None), np.zeros(system.nv)
    stiffness, damping = equations.tangents(0.0, rest, rest)
    inertia = equations.mass(rest)
    along = axis_jacobian(equations.chain_motion(rest, rest), system.chain.top)[0]

    def moved(omega: float) -> float:
        dynamic = stiffness + 1j * omega * damping - omega**2 * inertia
        return float(abs(along @ np.linalg.solve(dynamic, along)))

    swept: Array = np.array([moved(w) for w in 2 * np.pi * frequency * np.linspace(0.7, 1.3, 1201)])
    peaks = swept[argrelmax(swept)] / moved(0.0)
    return Found(float(peaks.max()), float(np.sqrt(1 + 2 / mass_ratio)))
