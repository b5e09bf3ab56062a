"""Hydrostatic pressure against its integral over the surface of tilted, bent and tapered members.

The integral is over the sides and the closed upper end, by quadrature; the lower end is in the
ground and not wet.
"""

from collections.abc import Callable

import numpy as np
import pytest
from helpers.hydrodynamics import SteadyWater
from helpers.numerics import fitted_order

from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.sea.forces.buoyancy import Buoyancy
from offwind_pin.loads.sea.forces.strips import Strips

WEIGHT, LEVEL, LENGTH, RADIUS = 10052.0, 5.0, 20.0, 3.0
"""Specific weight in N/m3; level above the lower end of the member's own 20 m, in m."""

FOOT = np.array([0.4, -0.3, -25.0])

Line = Callable[[Array], tuple[Array, Array]]
Radius = Callable[[Array], Array]


def straight(tilt: float) -> Line:
    axis = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    return lambda s: (FOOT + s[:, None] * axis, np.tile(axis, (len(s), 1)))


def bent(tilt: float, turn: float) -> Line:
    """An arc that starts tilted and turns by an angle over its length."""
    curvature = turn / LENGTH

    def line(s: Array) -> tuple[Array, Array]:
        angle = tilt + curvature * s
        axis = np.column_stack([np.sin(angle), 0 * s, np.cos(angle)])
        place = np.column_stack([np.cos(tilt) - np.cos(angle), 0 * s, np.sin(angle) - np.sin(tilt)])
        return FOOT + place / curvature, axis

    return line


def uniform(s: Array) -> Array:
    return np.full(len(s), RADIUS)


def tapered(s: Array) -> Array:
    return RADIUS - 0.05 * s


def by_quadrature(line: Line, radius: Radius) -> tuple[Array, Array]:
    """Force, and moment about the foot, of the pressure on sides and upper end."""
    points, weights = np.polynomial.legendre.leggauss(60)
    s, ds = LENGTH * (1 + points) / 2, LENGTH * weights / 2
    angle = 2 * np.pi * (np.arange(120) + 0.5) / 120
    across = np.array([0.0, 1.0, 0.0])

    def rim(at: Array) -> tuple[Array, Array, Array]:
        place, axis = line(at)
        other = np.cross(across, axis)
        normal = np.cos(angle)[:, None, None] * other + np.sin(angle)[:, None, None] * across
        return place, normal, place + radius(at)[:, None] * normal

    # the surface element is the cross product of the two tangents of the parametrised surface
    step = 1e-4
    _, _, here = rim(s)
    along = (rim(s + step)[2] - rim(s - step)[2]) / (2 * step)
    around = radius(s)[:, None] * np.cross(line(s)[1], rim(s)[1])
    outwards = np.cross(around, along)
    pressure = WEIGHT * (LEVEL - here[..., 2])
    pushed = -pressure[..., None] * outwards * ds[:, None] * (2 * np.pi / 120)
    force, moment = pushed.sum((0, 1)), np.cross(here - FOOT, pushed).sum((0, 1))

    end = np.array([LENGTH])
    place, axis = line(end)
    edge = float(radius(end)[0])
    r, dr = edge * (1 + points) / 2, edge * weights / 2
    _, normal, _ = rim(end)
    disc = place[0] + r[:, None, None] * normal[:, 0]
    pressure = WEIGHT * (LEVEL - disc[..., 2]) * (r * dr)[:, None] * (2 * np.pi / 120)
    pushed = -pressure[..., None] * axis[0]
    return force + pushed.sum((0, 1)), moment + np.cross(disc - FOOT, pushed).sum((0, 1))


def by_strips(line: Line, radius: Radius, count: int = 80) -> tuple[Array, Array]:
    """The same of the load on its points."""
    edges = np.linspace(0.0, LENGTH, count + 1)
    middle = (edges[:-1] + edges[1:]) / 2
    strips = Strips(middle + FOOT[2], np.diff(edges), 2 * radius(middle))
    area = np.pi * float(radius(np.zeros(1))[0]) ** 2
    load = Buoyancy(strips, WEIGHT, area, LEVEL, SteadyWater(count, level=LEVEL))
    place, axis = line(np.append(middle, 0.0))
    nothing = np.zeros_like(place)
    motion = PointMotion(place, nothing, nothing, axis)
    result = load.forces(0.0, motion, 1.0)
    assert result.dissipation == 0
    return result.force.sum(0), np.cross(place - FOOT, result.force).sum(0)


CASES = {
    "upright": (straight(0.0), uniform),
    "tilted": (straight(0.3), uniform),
    "tilted and tapered": (straight(0.3), tapered),
    "bent": (bent(0.1, 0.4), uniform),
    "bent and tapered": (bent(0.1, 0.4), tapered),
}


@pytest.mark.parametrize("case", CASES)
def test_force_is_the_integral_of_the_pressure(case: str) -> None:
    line, radius = CASES[case]
    exact, found = by_quadrature(line, radius)[0], by_strips(line, radius)[0]
    scale = WEIGHT * np.pi * RADIUS**2 * LENGTH
    assert np.abs(found - exact).max() < 1e-5 * scale


@pytest.mark.parametrize("case", CASES)
def test_moment_but_for_the_slope_of_sections(case: str) -> None:
    """It is met but for rho g I times the tilt of the foot, and its change over height.

    The pressure differs across a section that is not level, and a bent slice is thicker outside;
    with I = pi R^4 / 4 both are a moment that strips on the axis do not have.
    """
    line, radius = CASES[case]
    exact, found = by_quadrature(line, radius)[1], by_strips(line, radius)[1]
    s = np.linspace(0.0, LENGTH, 2001)
    slope, inertia = line(s)[1][:, 0], WEIGHT * np.pi / 4 * radius(s) ** 4
    missing = inertia[0] * slope[0] + np.trapezoid(inertia * np.gradient(slope, s), s)
    scale = WEIGHT * np.pi * RADIUS**2 * LENGTH**2 / 2
    assert np.abs(found - exact + [0.0, missing, 0.0]).max() < 1e-5 * scale
    assert case == "upright" or missing > 1e-3 * scale


def test_a_bend_counts() -> None:
    """Negative control: the sides of straight strips alone, without their wedges, are far off."""
    line, radius = CASES["bent"]
    edges = np.linspace(0.0, LENGTH, 81)
    _, axis = line((edges[:-1] + edges[1:]) / 2)
    lift = WEIGHT * np.pi * RADIUS**2 * np.diff(edges)
    sides = lift[:, None] * (np.array([0.0, 0.0, 1.0]) - axis[:, 2:] * axis)
    top, its_axis = line(np.array([LENGTH]))
    cap = -WEIGHT * (LEVEL - top[0, 2]) * np.pi * RADIUS**2 * its_axis[0]
    wrong = sides.sum(0) + cap - by_quadrature(line, radius)[0]
    assert np.abs(wrong).max() > 0.1 * lift.sum()


def test_order_two_in_strip_length() -> None:
    line, radius = CASES["bent and tapered"]
    exact = by_quadrature(line, radius)[0]
    counts = np.array([4, 8, 16])
    errors = [np.abs(by_strips(line, radius, n)[0] - exact).max() for n in counts]
    assert fitted_order(1 / counts, errors) == pytest.approx(2.0, abs=0.1)


def standing(count: int, surface: float, tilt: float) -> tuple[Buoyancy, PointMotion]:
    """A tilted member that stands out of the water, its strips up to 4 m above the still level."""
    edges = np.linspace(0.0, 34.0, count + 1)
    middle = (edges[:-1] + edges[1:]) / 2
    dry = np.zeros(count, dtype=bool)
    strips = Strips(middle - 30.0, np.diff(edges), np.full(count, 2 * RADIUS), dry)
    water = SteadyWater(count, level=surface)
    load = Buoyancy(strips, WEIGHT, np.pi * RADIUS**2, 0.0, water)
    axis = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    place = np.array([0.0, 0.0, -30.0]) + np.append(middle, 0.0)[:, None] * axis
    still = np.zeros_like(place)
    return load, PointMotion(place, still, still, np.tile(axis, (count + 1, 1)))


def test_an_upright_member_is_not_lifted() -> None:
    """Archimedes' force and that on the lower end cancel, at any surface."""
    for surface in (-2.0, 0.0, 3.0):
        load, motion = standing(68, surface, 0.0)
        total = load.forces(0.0, motion, 1.0).force.sum(0)
        assert np.abs(total).max() < 1e-9 * WEIGHT * np.pi * RADIUS**2 * 30.0


@pytest.mark.parametrize("surface", [-2.2, 0.0, 3.1])
def test_force_across_a_tilted_member_in_the_splash_zone(surface: float) -> None:
    """-rho g A e_x times the wetted length: the part across the axis, of small tilts."""
    tilt = 1e-3
    load, motion = standing(68, surface, tilt)
    across = load.forces(0.0, motion, 1.0).force.sum(0) @ [np.cos(tilt), 0.0, -np.sin(tilt)]
    wetted = 30.0 + surface
    assert across == pytest.approx(-WEIGHT * np.pi * RADIUS**2 * wetted * tilt, rel=1e-5)


def test_water_inside_presses_outwards() -> None:
    """With the same water inside, level and section, nothing is left."""
    edges = np.linspace(-30.0, 0.0, 61)
    strips = Strips((edges[:-1] + edges[1:]) / 2, np.diff(edges), np.full(60, 6.0))
    area = np.pi * 9.0
    outside = Buoyancy(strips, WEIGHT, area, 0.0)
    inside = Buoyancy(strips, -WEIGHT, area, 0.0)
    rng = np.random.default_rng(3)
    place, axis = rng.normal(size=(2, 61, 3))
    motion = PointMotion(place, 0 * place, 0 * place, axis)
    both = [load.forces(0.0, motion, 1.0).force for load in (outside, inside)]
    assert np.all(both[0] + both[1] == 0)
    assert np.abs(both[0]).max() > 1e5
