"""The chain of multibody beam elements against beam theory."""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.optimize import brentq
from scipy.special import jv

from offwind_pin.analysis.build import build
from offwind_pin.base.definition import Array
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.structure.frustum import Frustum
from offwind_pin.structure.section import lump
from offwind_pin.verification.beams import cantilever_roots, ritz_frequencies
from offwind_pin.verification.ledger import Found
from offwind_pin.verification.orders import fitted_order
from offwind_pin.verification.plain_tubes import (
    DENSITY,
    LENGTH,
    SHEAR,
    TORSION,
    YOUNG,
    bending_stiffness,
    equilibrium,
    frequencies,
    mass_per_length,
    polar_inertia,
    tube,
)

_SMALL = 1e-6
"""Deflection over length, or twist in rad: terms of second order are 1e-12 of the answer."""
_SLENDER = (0.05, 0.0005)
"""Diameter and wall in m: over 100 m rotary inertia changes the fifth frequency by 1e-5."""
_LIGHT = (1.0, 0.01)


def tip_deflection(elements: int) -> float:
    """Deflection under a force at the tip, over P L^3 / 3 EI."""
    force = _SMALL * 3 * bending_stiffness() / LENGTH**2
    system = build(tube(), "clamped", elements=elements)
    tip = equilibrium(system, [force, 0, 0, 0, 0, 0], scale=force * LENGTH).displacement[-1, 0]
    return float(tip / (_SMALL * LENGTH))


def tip_deflection_order() -> float:
    counts = np.array([4, 8, 16, 32])
    return fitted_order(1 / counts, [tip_deflection(int(n)) - 1 for n in counts])


def tip_moment() -> float:
    """Deflection of three elements under a moment at the tip, over M L^2 / 2 EI."""
    moment = 2 * _SMALL * bending_stiffness() / LENGTH
    system = build(tube(), "clamped", elements=3)
    tip = equilibrium(system, [0, 0, 0, 0, moment, 0], scale=moment).displacement[-1, 0]
    return float(tip / (_SMALL * LENGTH))


def twist() -> float:
    """Twist under a torque at the tip, over M L / G J."""
    moment = _SMALL * SHEAR * polar_inertia() / LENGTH
    system = build(tube(), "clamped", elements=5)
    q = equilibrium(system, [0, 0, 0, 0, 0, moment], scale=moment).q
    return float(q[TORSION::3].sum() / _SMALL)


def large_rotation_order() -> float:
    """Order of convergence of the tip of a tube bent by a moment to a circular arc of 1.2 rad."""
    angle, counts = 1.2, np.array([4, 8, 16, 32])
    moment, errors = angle * bending_stiffness() / LENGTH, []
    for n in counts:
        system = build(tube(), "clamped", elements=int(n))
        tip = equilibrium(system, [0, 0, 0, 0, moment, 0], scale=moment).displacement[-1]
        errors.append(tip[0] - LENGTH * (1 - np.cos(angle)) / angle)
    return fitted_order(1 / counts, errors)


@cache
def _uniform(elements: int) -> Array:
    """(5,) frequencies in rad/s over those of Euler and Bernoulli."""
    stiffness, mass = bending_stiffness(*_SLENDER), mass_per_length(*_SLENDER)
    exact = cantilever_roots(5) ** 2 * np.sqrt(stiffness / mass / LENGTH**4)
    turbine = tube(bottom=_SLENDER, top=_SLENDER, top_mass=1e-9)
    return frequencies(build(turbine, "clamped", elements=elements), 5) / exact


def uniform_frequency(mode: int) -> float:
    """Of 36 elements, over x^2 sqrt(EI / m L^4) with cos x cosh x = -1."""
    return float(_uniform(36)[mode - 1])


def uniform_frequency_order(mode: int) -> float:
    counts = np.array([16, 24, 36])
    return fitted_order(1 / counts, [_uniform(int(n))[mode - 1] - 1 for n in counts])


def tapered_frequency(mode: int) -> Found:
    """Of 36 elements in Hz, and by Rayleigh and Ritz."""
    bottom, top = (0.06, 0.0006), (0.045, 0.0005)

    def outer_inner(s: Array) -> tuple[Array, Array]:
        outer = bottom[0] + (top[0] - bottom[0]) * s / LENGTH
        return outer, outer - 2 * (bottom[1] + (top[1] - bottom[1]) * s / LENGTH)

    def stiffness(s: Array) -> Array:
        outer, inner = outer_inner(s)
        return np.asarray(YOUNG * np.pi / 64 * (outer**4 - inner**4))

    def mass(s: Array) -> Array:
        outer, inner = outer_inner(s)
        return np.asarray(DENSITY * np.pi / 4 * (outer**2 - inner**2))

    exact = ritz_frequencies(LENGTH, stiffness, mass, mode)[-1]
    turbine = tube(bottom=bottom, top=top, top_mass=1e-9)
    found = frequencies(build(turbine, "clamped", elements=36), mode)[-1]
    return Found(float(found) / (2 * np.pi), float(exact) / (2 * np.pi))


def torsional_frequency() -> Found:
    """Of 27 elements in Hz, and sqrt(G / rho) / 4 L."""
    found = frequencies(build(tube(), "clamped", elements=27), 1, TORSION)[0]
    return Found(float(found) / (2 * np.pi), float(np.sqrt(SHEAR / DENSITY)) / (4 * LENGTH))


def heavy_top_frequency() -> Found:
    """Of 32 elements under a mass in Hz, and sqrt(3 EI / m L^3) / 2 pi."""
    mass = 1e10
    found = frequencies(build(tube(top_mass=mass), "clamped", elements=32), 1)[0]
    exact = np.sqrt(3 * bending_stiffness() / mass / LENGTH**3)
    return Found(float(found) / (2 * np.pi), float(exact) / (2 * np.pi))


@cache
def _critical_weight(elements: int) -> float:
    """w L^3 / EI at which a straight column loses its stiffness."""
    to_gravity = bending_stiffness(*_LIGHT) / mass_per_length(*_LIGHT) / LENGTH**3

    def lowest(load: float) -> float:
        turbine = tube(bottom=_LIGHT, top=_LIGHT, gravity=load * to_gravity, top_mass=1e-6)
        system = build(turbine, "clamped", elements=elements)
        rest = np.zeros(system.nv)
        stiffness, _ = system.equations((), None).tangents(0.0, rest, rest)
        return float(np.linalg.eigvalsh(stiffness)[0]) / float(system.joint_stiffness[0])

    return float(brentq(lowest, 4.0, 12.0, xtol=1e-10))


def own_weight_buckling() -> Found:
    """Of 20 elements, and 9/4 j^2 with j the first zero of J_-1/3."""
    exact = 9 / 4 * brentq(lambda x: jv(-1 / 3, x), 1.5, 2.2) ** 2
    return Found(_critical_weight(20), float(exact))


def own_weight_buckling_order() -> float:
    exact = own_weight_buckling().reference
    counts = np.array([5, 10, 20])
    return fitted_order(1 / counts, [_critical_weight(int(n)) / exact - 1 for n in counts])


def frustum_inertia() -> Found:
    """Transverse inertia of a tower's frustum in kg m2, and its integral by 64 Gauss points."""
    frustum = Frustum(10.51, 4.15, 4.01, 4.08, 3.94, 8500.0)
    points, weights = np.polynomial.legendre.leggauss(64)
    s = (1 + points) / 2
    z, weight = frustum.height * s, frustum.height / 2 * weights
    outer = frustum.outer_bottom + (frustum.outer_top - frustum.outer_bottom) * s
    inner = frustum.inner_bottom + (frustum.inner_top - frustum.inner_bottom) * s
    line = frustum.density * np.pi * (outer**2 - inner**2)
    center = weight @ (line * z) / (weight @ line)
    ring = frustum.density * np.pi / 4 * (outer**4 - inner**4)
    return Found(frustum.lump().transverse, float(weight @ (ring + line * (z - center) ** 2)))


def oc6_mass(bottom: float, top: float | None) -> float:
    """kg of the benchmark's structure between two heights in m, or up to the yaw bearing."""
    turbine = load_turbine("oc6_phase2")
    return float(lump(turbine, bottom, turbine.yaw_bearing if top is None else top).mass)
