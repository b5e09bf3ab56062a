"""Inline force and overturning moment of a regular wave over its period, in closed form.

Linear theory on a fixed vertical cylinder up to still water level, with strips of the package's own
length: inertia and drag dominated, deep and shallow.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from helpers.hydrodynamics import RegularWater, upright

from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.sea.waves.dispersion import wave_number

GRAVITY, DENSITY, ADDED, DRAG = 9.80665, 1025.0, 0.95, 1.05
TOLERANCE = 1e-3


@dataclass(frozen=True)
class Wave:
    """A wave past a cylinder: depth, diameter and amplitude in m, period in s."""

    depth: float
    diameter: float
    amplitude: float
    period: float

    @property
    def omega(self) -> float:
        return 2 * np.pi / self.period

    @property
    def k(self) -> float:
        return float(wave_number(np.array([self.omega]), self.depth, GRAVITY)[0])

    @property
    def speed(self) -> float:
        """Amplitude of the velocity at the bed in m/s, without the factor cosh k s."""
        return self.amplitude * self.omega / np.sinh(self.k * self.depth)

    @property
    def inertia(self) -> Array:
        """(2,) amplitudes of force in N and moment about the bed in N m."""
        k, h = self.k, self.depth
        line = DENSITY * (1 + ADDED) * np.pi / 4 * self.diameter**2 * self.speed * self.omega
        whole = np.sinh(k * h) / k
        return line * np.array([whole, h * whole - (np.cosh(k * h) - 1) / k**2])

    @property
    def drag(self) -> Array:
        """(2,) amplitudes of the drag's cos |cos|."""
        k, h = self.k, self.depth
        line = 0.5 * DENSITY * DRAG * self.diameter * self.speed**2
        force = h / 2 + np.sinh(2 * k * h) / (4 * k)
        moment = h**2 / 4 + h * np.sinh(2 * k * h) / (4 * k)
        return line * np.array([force, moment - (np.cosh(2 * k * h) - 1) / (8 * k**2)])

    def closed_form(self, angle: Array) -> Array:
        """(t, 2) at phases."""
        beat, turn = np.cos(angle) * np.abs(np.cos(angle)), np.sin(angle)
        return np.outer(beat, self.drag) - np.outer(turn, self.inertia)

    def by_strips(self, angle: Array) -> Array:
        """(t, 2) of the load."""
        height, length = Strips.between(-self.depth, 0.0)
        strips = Strips(height, length, np.full(len(height), self.diameter))
        water = RegularWater(height, self.depth, self.amplitude, self.omega, self.k)
        load = MorisonForce(strips, water, DENSITY, ADDED, DRAG)
        motion = upright(height)
        forces = [load.forces(a / self.omega, motion, 1.0).force[:, 0] for a in angle]
        return np.array([[f.sum(), (height + self.depth) @ f] for f in forces])


WAVES = {
    "inertia": Wave(depth=30.0, diameter=9.0, amplitude=1.0, period=9.0),
    "drag": Wave(depth=30.0, diameter=0.5, amplitude=4.0, period=10.0),
    "both": Wave(depth=30.0, diameter=2.0, amplitude=4.0, period=10.0),
    "deep": Wave(depth=90.0, diameter=6.0, amplitude=1.5, period=6.5),
    "shallow": Wave(depth=10.0, diameter=6.0, amplitude=0.5, period=40.0),
}
ANGLE = 2 * np.pi * np.arange(24) / 24


@pytest.mark.parametrize("name", WAVES)
def test_over_a_period(name: str) -> None:
    wave = WAVES[name]
    exact = wave.closed_form(ANGLE)
    scale = np.abs(exact).max(axis=0)
    assert np.abs((wave.by_strips(ANGLE) - exact) / scale).max() < TOLERANCE


def test_the_cases_are_what_they_are_called() -> None:
    ratio = {name: wave.drag[0] / wave.inertia[0] for name, wave in WAVES.items()}
    assert ratio["inertia"] < 0.03
    assert ratio["drag"] > 2
    assert 0.3 < ratio["both"] < 3
    depth = {name: wave.k * wave.depth for name, wave in WAVES.items()}
    assert depth["deep"] > np.pi
    assert depth["shallow"] < np.pi / 10


def test_deep_water() -> None:
    """Inertia: rho Cm A g a, whatever the period; its arm is one over the wave number deep."""
    wave = WAVES["deep"]
    area = np.pi / 4 * wave.diameter**2
    force = DENSITY * (1 + ADDED) * area * GRAVITY * wave.amplitude
    found = wave.by_strips(np.array([-np.pi / 2]))[0]
    assert found[0] == pytest.approx(force, rel=TOLERANCE)
    arm = wave.depth - GRAVITY / wave.omega**2
    assert found[1] == pytest.approx(force * arm, rel=TOLERANCE)


def test_shallow_water() -> None:
    """The water moves as one, a sqrt(g / h), within (kh)^2 / 6 of the velocity."""
    wave = WAVES["shallow"]
    speed = wave.amplitude * np.sqrt(GRAVITY / wave.depth)
    drag = 0.5 * DENSITY * DRAG * wave.diameter * speed**2 * wave.depth
    found = wave.by_strips(np.array([0.0]))[0]
    bound = (wave.k * wave.depth) ** 2 / 2
    assert found[0] == pytest.approx(drag, rel=bound)
    assert found[1] == pytest.approx(drag * wave.depth / 2, rel=bound)


def test_another_coefficient_is_seen() -> None:
    """Negative control: a hundredth more of either coefficient fails the check."""
    for name, part in (("inertia", "inertia"), ("drag", "drag")):
        wave = WAVES[name]
        exact, scale = wave.closed_form(ANGLE), np.abs(wave.closed_form(ANGLE)).max(axis=0)
        shape = -np.sin(ANGLE) if part == "inertia" else np.cos(ANGLE) * np.abs(np.cos(ANGLE))
        wrong = wave.by_strips(ANGLE) + 0.01 * np.outer(shape, getattr(wave, part))
        assert np.abs((wrong - exact) / scale).max() > 5 * TOLERANCE
