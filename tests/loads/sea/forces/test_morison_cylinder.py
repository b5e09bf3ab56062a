"""Morison's force on a fixed vertical cylinder in a regular wave, in closed form."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from helpers.hydrodynamics import RegularWater, SteadyWater, upright
from helpers.numerics import fitted_order

from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.sea.forces.added_mass import AddedMass
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.sea.waves.dispersion import wave_number

DEPTH, GRAVITY, DENSITY, DIAMETER = 30.0, 9.80665, 1025.0, 9.0
AMPLITUDE, FREQUENCY = 1.5, 0.1
ADDED, DRAG = 0.9, 1.1
OMEGA = 2 * np.pi * FREQUENCY
K = float(wave_number(np.array([OMEGA]), DEPTH, GRAVITY)[0])
KH = K * DEPTH


@dataclass(frozen=True)
class Wrench:
    """Force along x in N and moment about the bed in N m."""

    force: float
    moment: float


def exact_inertia() -> Wrench:
    """Amplitudes by the integrals of cosh k s and s cosh k s over the depth (s from the bed)."""
    line = DENSITY * (1 + ADDED) * np.pi * DIAMETER**2 / 4 * AMPLITUDE * OMEGA**2 / np.sinh(KH)
    return Wrench(
        line * np.sinh(KH) / K,
        line * (DEPTH * np.sinh(KH) / K - (np.cosh(KH) - 1) / K**2),
    )


def exact_drag() -> Wrench:
    """Amplitudes by the integrals of cosh^2 k s and s cosh^2 k s over the depth."""
    line = 0.5 * DENSITY * DRAG * DIAMETER * (AMPLITUDE * OMEGA / np.sinh(KH)) ** 2
    return Wrench(
        line * (DEPTH / 2 + np.sinh(2 * KH) / (4 * K)),
        line
        * (DEPTH**2 / 4 + DEPTH * np.sinh(2 * KH) / (4 * K) - (np.cosh(2 * KH) - 1) / (8 * K**2)),
    )


def cylinder(strips: int) -> MorisonForce:
    edges = np.linspace(-DEPTH, 0.0, strips + 1)
    height, length = (edges[:-1] + edges[1:]) / 2, np.diff(edges)
    parts = Strips(height, length, np.full(strips, DIAMETER))
    wave = RegularWater(height, DEPTH, AMPLITUDE, OMEGA, K)
    return MorisonForce(parts, wave, DENSITY, ADDED, DRAG)


def at_rest(load: MorisonForce, velocity: float = 0.0) -> PointMotion:
    return upright(load.height, velocity)


def wrench(load: MorisonForce, time: float) -> Wrench:
    force = load.forces(time, at_rest(load), 1.0).force
    assert np.all(force[:, 1:] == 0)
    return Wrench(force[:, 0].sum(), float((load.height + DEPTH) @ force[:, 0]))


CREST, ZERO_DOWN = 0.0, 0.25 / FREQUENCY
"""Instants of pure drag (no horizontal acceleration) and of pure inertia (no velocity)."""


@pytest.mark.parametrize("quantity", ["force", "moment"])
@pytest.mark.parametrize(
    ("time", "exact", "sign"),
    [(CREST, exact_drag, 1), (ZERO_DOWN, exact_inertia, -1)],
    ids=["drag", "inertia"],
)
def test_order_two_in_strip_length(quantity: str, time: float, exact, sign: int) -> None:
    """The strips' midpoint rule meets the closed form with order 2."""
    counts = np.array([10, 20, 40, 80])
    reference = sign * getattr(exact(), quantity)
    values = np.array([getattr(wrench(cylinder(n), time), quantity) for n in counts])
    errors = values / reference - 1
    assert abs(errors[-1]) < (K * DEPTH / 80) ** 2
    assert fitted_order(1 / counts, errors) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("phase", [0.1, 0.35, 0.6, 0.85])
def test_through_the_cycle(phase: float) -> None:
    """Inertia goes with -sin, drag with cos |cos|, and they add."""
    angle = 2 * np.pi * phase
    expected = exact_drag().force * np.cos(angle) * abs(np.cos(angle))
    expected -= exact_inertia().force * np.sin(angle)
    found = wrench(cylinder(400), phase / FREQUENCY).force
    assert found == pytest.approx(expected, abs=1e-5 * exact_inertia().force)


def test_shipped_strips(oc6) -> None:
    """Half-metre strips from the mudline to the water line: 60 of them, 30 m, rho Ca V of mass."""
    height, length = Strips.between(oc6.site.mudline, 0.0)
    assert len(height) == 60
    assert length.sum() == pytest.approx(30.0, rel=1e-14)
    mass = AddedMass.of(Strips(height, length, np.full(60, 9.0)), 1025.0, 1.0)
    assert mass.mass.sum() == pytest.approx(1025.0 * np.pi / 4 * 81.0 * 30.0, rel=1e-13)


def test_drag_is_on_the_relative_velocity() -> None:
    """A cylinder that moves with v in still water is braked by rho/2 Cd D |v| v per length."""
    load = MorisonForce(cylinder(30).strips, SteadyWater(30), DENSITY, ADDED, DRAG)
    force = load.forces(0.0, at_rest(load, velocity=0.7), 1.0).force[:, 0].sum()
    assert force == pytest.approx(-0.5 * DENSITY * DRAG * DIAMETER * DEPTH * 0.7**2, rel=1e-13)


def test_drag_makes_heat() -> None:
    """In still water the heat is the work done against the drag, rho/2 Cd D |v|^3 per length."""
    load = MorisonForce(cylinder(30).strips, SteadyWater(30), DENSITY, ADDED, DRAG)
    heat = load.forces(0.0, at_rest(load, velocity=-0.7), 1.0).dissipation
    assert heat == pytest.approx(0.5 * DENSITY * DRAG * DIAMETER * DEPTH * 0.7**3, rel=1e-13)


TILT = 0.3
INCLINED, ACROSS = np.array([[np.sin(TILT), 0.0, np.cos(TILT)], [np.cos(TILT), 0.0, -np.sin(TILT)]])
"""An inclined axis, and a direction normal to it in the same plane."""


def test_force_is_normal_to_the_deflected_axis() -> None:
    """On an inclined cylinder nothing acts along its axis."""
    load = cylinder(30)
    inclined = replace(at_rest(load), axis=np.tile(INCLINED, (30, 1)))
    force = load.forces(1.3, inclined, 1.0).force
    assert np.abs(force @ INCLINED).max() < 1e-12 * np.abs(force).max()
    assert np.abs(force @ ACROSS).min() > 0


def test_water_moves_with_the_cylinder_across_its_axis_only() -> None:
    """Accelerated along its axis it is free, across it rho Ca V a is needed; so with the energy."""
    load = cylinder(30)
    water = AddedMass.of(load.strips, DENSITY, ADDED)
    inclined = replace(at_rest(load), axis=np.tile(INCLINED, (30, 1)))
    along, across, both = (
        np.tile(vector, (30, 1)) for vector in (INCLINED, ACROSS, 3 * INCLINED + 2 * ACROSS)
    )
    mass = DENSITY * ADDED * np.pi / 4 * DIAMETER**2 * DEPTH

    def total(acceleration: Array) -> Array:
        return water.forces(0.0, replace(inclined, acceleration=acceleration), 1.0).force.sum(
            axis=0
        )

    assert np.abs(total(along)).max() < 1e-12 * mass
    assert total(across) == pytest.approx(-mass * ACROSS, rel=1e-13, abs=1e-9)
    assert total(both) == pytest.approx(-2 * mass * ACROSS, rel=1e-13, abs=1e-9)
    assert water.energy(replace(inclined, velocity=both)) == pytest.approx(2 * mass, rel=1e-13)
