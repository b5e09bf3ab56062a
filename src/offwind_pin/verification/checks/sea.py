"""Waves and their loads on a fixed cylinder against closed forms."""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import jvp, yvp

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.sea.forces.maccamy_fuchs import inertia_factor
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.sea.irregular_waves import Crest, IrregularWaves
from offwind_pin.loads.sea.kinematics import WaterSeries, WaterSurface
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.fourier_wave import SteadyWave
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.second_order import SecondOrderWaves
from offwind_pin.verification.ledger import Found

_GRAVITY, _DENSITY, _ADDED, _DRAG = 9.80665, 1025.0, 0.95, 1.05


def _upright(height: Array, velocity: Array | None = None) -> PointMotion:
    """Points of a vertical axis at rest, or moving with a velocity (3,) in m/s."""
    n = len(height)
    still = np.zeros((n, 3))
    moving = still if velocity is None else np.tile(velocity, (n, 1))
    place = np.column_stack([np.zeros((n, 2)), height])
    return PointMotion(place, still, moving, np.tile([0.0, 0.0, 1.0], (n, 1)))


def _cylinder(
    depth: float, diameter: float, waves: LinearWaves | None, drag: float, theory: str = "none"
) -> MorisonForce:
    """Strips of the package's own length in a linear wave up to the still water level."""
    height, length = Strips.between(-depth, 0.0)
    strips = Strips(height, length, np.full(len(height), diameter))
    surface = WaterSurface(waves, 0.0, "none")

    def factor(at: Array) -> ComplexArray:
        number = np.zeros(1) if waves is None else waves.wave_number
        return inertia_factor(np.full(len(at), diameter), number, np.full(len(at), _ADDED))

    water = WaterSeries(
        height, surface, inertia_factor=factor if theory == "maccamy_fuchs" else None
    )
    return MorisonForce(strips, water, _DENSITY, _ADDED, drag)


def _regular(depth: float, amplitude: float, period: float) -> LinearWaves:
    crest = np.array([amplitude + 0j])
    return LinearWaves.free(period, np.ones(1), crest, depth, _GRAVITY)


def morison(depth: float, diameter: float, amplitude: float, period: float, part: str) -> float:
    """Largest error over a period of force, or moment about the bed, over its largest value.

    The closed forms are the integrals of cosh k s, s cosh k s and their squares over the depth.
    """
    waves = _regular(depth, amplitude, period)
    omega, k = float(waves.omega[0]), float(waves.wave_number[0])
    kh, speed = k * depth, amplitude * omega / np.sinh(k * depth)
    inertia = _DENSITY * (1 + _ADDED) * np.pi / 4 * diameter**2 * speed * omega
    drag = 0.5 * _DENSITY * _DRAG * diameter * speed**2
    double = depth * np.sinh(2 * kh) / (4 * k)
    if part == "force":
        inertia *= np.sinh(kh) / k
        drag *= depth / 2 + np.sinh(2 * kh) / (4 * k)
    else:
        inertia *= depth * np.sinh(kh) / k - (np.cosh(kh) - 1) / k**2
        drag *= depth**2 / 4 + double - (np.cosh(2 * kh) - 1) / (8 * k**2)
    angle = 2 * np.pi * np.arange(24) / 24
    exact = drag * np.cos(angle) * np.abs(np.cos(angle)) - inertia * np.sin(angle)
    load = _cylinder(depth, diameter, waves, _DRAG)
    arm = np.ones(len(load.height)) if part == "force" else load.height + depth
    motion = _upright(load.height)
    found = np.array([arm @ load.forces(a / omega, motion, 1.0).force[:, 0] for a in angle])
    return float(np.abs(found - exact).max() / np.abs(exact).max())


@cache
def _diffracted(size: float) -> complex:
    """Complex amplitude of the force on a cylinder of 20 m radius in 60 m, in N per m of wave."""
    radius, depth = 20.0, 60.0
    k = size / radius
    omega = float(np.sqrt(_GRAVITY * k * np.tanh(k * depth)))
    waves = _regular(depth, 1.0, 2 * np.pi / omega)
    load = _cylinder(depth, 2 * radius, waves, 0.0, "maccamy_fuchs")
    phase, motion = 2 * np.pi * np.arange(32) / 32, _upright(load.height)
    force = np.array([load.forces(p / omega, motion, 1.0).force[:, 0].sum() for p in phase])
    return complex(2 * np.mean(force * np.exp(-1j * phase)))


def diffraction_force(size: float) -> Found:
    """Amplitude in N, and 4 rho g A tanh(kh) / (k^2 |H1'(ka)|)."""
    radius, depth = 20.0, 60.0
    k = size / radius
    derivative = np.hypot(jvp(1, size), yvp(1, size))
    exact = 4 * _DENSITY * _GRAVITY * np.tanh(k * depth) / (k**2 * derivative)
    return Found(abs(_diffracted(size)), float(exact))


def diffraction_phase(size: float) -> Found:
    """In rad against the acceleration at the axis, and -arctan(J1' / Y1')."""
    lag = np.arctan2(jvp(1, size), yvp(1, size))
    return Found(float(np.angle(_diffracted(size) / 1j)), float(-lag))


@cache
def _steady(height: float, length: float, order: int) -> SteadyWave:
    return SteadyWave.solve(height, length=length, depth=1.0, gravity=1.0, order=order)


def steady_wave_speed(height: float, length: float, order: int) -> float:
    """c sqrt(k / g) of a wave of these over the depth."""
    wave = _steady(height, length, order)
    return float(wave.speed * np.sqrt(wave.wave_number))


def steady_wave_coefficient(height: float, length: float, order: int, name: str) -> float:
    """First coefficient of the stream function (B1) or of the surface (E1), over g and k."""
    wave = _steady(height, length, order)
    if name == "B1":
        return float(wave.stream[0] * wave.wave_number**1.5)
    return float(wave.surface[0] * wave.wave_number)


def dispersion(kh: float) -> Found:
    """Wave number in rad/m at 30 m, found from the frequency that k h has."""
    k, depth = kh / 30.0, 30.0
    omega = np.array([np.sqrt(_GRAVITY * k * np.tanh(kh))])
    return Found(float(wave_number(omega, depth, _GRAVITY)[0]), k)


def realised_height() -> float:
    """4 sqrt(m0) in m of the components of LC 5.1's sea, 1.25 m high, over ten minutes."""
    sea = IrregularWaves(1.25, 5.5, seed=1, repeat_period=600.0)
    waves = sea.waves(30.0, _GRAVITY)
    return float(4 * np.sqrt(np.sum(np.abs(waves.elevation) ** 2) / 2))


def _pair(depth: float) -> tuple[SecondOrderWaves, Array]:
    """Two waves of 10 and 8 s and 1 m each, to second order, and their wave numbers."""
    harmonic = np.array([4.0, 5.0])
    linear = LinearWaves.free(40.0, harmonic, np.array([1.0 + 0j, 1.0]), depth, _GRAVITY)
    return SecondOrderWaves(linear, cutoff=np.inf), linear.wave_number


def bound_sum() -> Found:
    """Elevation in m at the sum of two frequencies in deep water, and a b (k1 + k2) / 2."""
    waves, k = _pair(2000.0)
    return Found(float(waves.bound[waves.harmonic == 9][0].real), float((k[0] + k[1]) / 2))


def bound_difference() -> Found:
    """The same at the difference, and -a b |k1 - k2| / 2."""
    waves, k = _pair(2000.0)
    return Found(float(waves.bound[waves.harmonic == 1][0].real), float(-abs(k[0] - k[1]) / 2))


def _steep(depth: float) -> tuple[SecondOrderWaves, float]:
    waves = SecondOrderWaves(_regular(depth, 1.0, 10.0), cutoff=np.inf)
    return waves, float(waves.first_order.wave_number[0])


def second_harmonic(depth: float) -> Found:
    """Of a regular wave in m, and Stokes' k a^2 cosh kd (2 + cosh 2kd) / (4 sinh^3 kd)."""
    waves, k = _steep(depth)
    kd = k * depth
    exact = k * np.cosh(kd) * (2 + np.cosh(2 * kd)) / (4 * np.sinh(kd) ** 3)
    return Found(float(waves.elevation[waves.harmonic == 2][0].real), float(exact))


def set_down(depth: float) -> Found:
    """Mean elevation of a regular wave in m, and -k a^2 / (2 sinh 2kd)."""
    waves, k = _steep(depth)
    mean = float(waves.elevation[waves.harmonic == 0][0].real)
    return Found(mean, float(-k / (2 * np.sinh(2 * k * depth))))


def crest_in_a_random_sea() -> float:
    """Elevation in m at the moment for which a crest of 6 m was asked."""
    sea = IrregularWaves(6.0, 10.0, seed=4, repeat_period=1200.0, crest=Crest(6.0, 321.0))
    waves = sea.waves(30.0, _GRAVITY)
    return float(np.sum(waves.elevation * np.exp(1j * waves.omega * 321.0)).real)


def random_variance() -> Found:
    """m0 in m2 of three hours of random amplitudes, and Hs^2 / 16 (JONSWAP 6 m, 10 s, 3.3)."""
    sea = IrregularWaves(
        6.0, 10.0, seed=11, repeat_period=10800.0, peak_shape=3.3, amplitudes="random"
    )
    waves = sea.waves(30.0, _GRAVITY)
    return Found(float(np.sum(np.abs(waves.elevation) ** 2) / 2), 6.0**2 / 16)


def quadratic_drag() -> Found:
    """Growth of 1 / A per cycle in 1/m of a pile that swings in still water; 8 b / (3 m)."""
    depth, diameter, mass, omega = 20.0, 2.0, 1.2e5, np.pi
    load = _cylinder(depth, diameter, None, _DRAG)

    def rate(_: float, y: Array) -> list[float]:
        motion = _upright(load.height, np.array([y[1], 0.0, 0.0]))
        drag = load.forces(0.0, motion, 1.0).force[:, 0].sum()
        return [y[1], float(drag / mass - omega**2 * y[0])]

    cycles = 6
    end = 2 * np.pi / omega * (cycles + 0.2)
    time = np.linspace(0.0, end, 2400)
    x = solve_ivp(rate, (0.0, end), [0.1, 0.0], t_eval=time, rtol=1e-9, atol=1e-12).y[0]
    top = np.flatnonzero((x[1:-1] > x[:-2]) & (x[1:-1] >= x[2:])) + 1
    before, at, after = x[top - 1], x[top], x[top + 1]
    peak = np.append(0.1, at + (after - before) ** 2 / (8 * (2 * at - before - after)))
    slope = float(np.polyfit(np.arange(len(peak)), 1 / peak, 1)[0])
    return Found(slope, 8 * 0.5 * _DENSITY * _DRAG * diameter * depth / (3 * mass))
