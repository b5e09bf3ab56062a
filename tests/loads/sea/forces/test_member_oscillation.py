"""A rigid pile on a spring in water: how drag damps it, at rest and in a current."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.hydrodynamics import SteadyWater, upright
from scipy.integrate import solve_ivp

from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.forces.added_mass import AddedMass
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import Strips

DENSITY, DIAMETER, DEPTH, ADDED, DRAG = 1025.0, 2.0, 20.0, 0.8, 1.1
STEEL, FREQUENCY = 6e4, 0.5
"""Mass of the pile in kg; its natural frequency in Hz, in water."""

OMEGA = 2 * np.pi * FREQUENCY
COUNT = 8


def strips() -> Strips:
    edges = np.linspace(-DEPTH, 0.0, COUNT + 1)
    return Strips((edges[:-1] + edges[1:]) / 2, np.diff(edges), np.full(COUNT, DIAMETER))


def oscillation(
    start: float, cycles: float, current: tuple[float, float, float], along: int = 0
) -> tuple[Array, Array]:
    """Times and displacements from a mean at rest, released a distance away from it.

    The pile moves along x or y (0 or 1) and is held in the other direction; the mean is where
    the spring bears the drag of the current.
    """
    load = MorisonForce(strips(), SteadyWater(COUNT, current), DENSITY, ADDED, DRAG)
    water = AddedMass.of(strips(), DENSITY, ADDED)
    pushed = replace(upright(load.height), acceleration=np.tile([1.0, 0.0, 0.0], (COUNT, 1)))
    mass = STEEL - water.forces(0.0, pushed, 1.0).force[:, 0].sum()
    spring = mass * OMEGA**2

    def drag(speed: float) -> float:
        velocity = np.zeros((COUNT, 3))
        velocity[:, along] = speed
        motion = replace(upright(load.height), velocity=velocity)
        return float(load.forces(0.0, motion, 1.0).force[:, along].sum())

    held = drag(0.0)

    def rate(time: float, y: Array) -> list[float]:
        return [y[1], (drag(y[1]) - held - spring * y[0]) / mass]

    end = cycles / FREQUENCY
    solution = solve_ivp(
        rate, (0.0, end), [start, 0.0], rtol=1e-10, atol=1e-13, dense_output=True, method="DOP853"
    )
    time = np.linspace(0.0, end, int(400 * cycles) + 1)
    return time, solution.sol(time)[0]


def peaks(x: Array) -> Array:
    """Maxima of a signal from the first on, parabolas through three samples."""
    inside = np.flatnonzero((x[1:-1] > x[:-2]) & (x[1:-1] >= x[2:])) + 1
    left, middle, right = x[inside - 1], x[inside], x[inside + 1]
    return np.append(x[0], middle + (right - left) ** 2 / (8 * (2 * middle - left - right)))


def mass_in_water() -> float:
    return STEEL + DENSITY * ADDED * np.pi / 4 * DIAMETER**2 * DEPTH


def test_quadratic_drag_in_still_water() -> None:
    """1/A grows by 8 b / (3 m) a cycle, b = rho/2 Cd D h.

    A cycle of amplitude A takes the energy b times the integral of |omega A sin|^3 omega A dt...
    = b omega^2 A^3 8/3 out of m omega^2 A^2 / 2, so that dA/dn = -8 b A^2 / (3 m). It is the
    equivalent linear damping 8 / (3 pi) b omega A, a factor 4 / (3 pi) b A / m of critical.
    """
    brake = 0.5 * DENSITY * DRAG * DIAMETER * DEPTH
    _, x = oscillation(0.5, 20.2, (0.0, 0.0, 0.0))
    inverse = 1 / peaks(x)
    cycle = np.arange(len(inverse))
    slope, _ = np.polyfit(cycle, inverse, 1)
    expected = 8 * brake / (3 * mass_in_water())
    assert len(inverse) == 21
    assert slope == pytest.approx(expected, rel=1e-2)
    assert np.abs(inverse - np.polyval(np.polyfit(cycle, inverse, 1), cycle)).max() < 0.02
    assert inverse[-1] > 2.5 * inverse[0]


def test_small_amplitudes_meet_the_closed_form_better() -> None:
    """The closed form is of first order in b A / m: its error falls with the amplitude."""
    brake = 0.5 * DENSITY * DRAG * DIAMETER * DEPTH
    expected = 8 * brake / (3 * mass_in_water())
    errors = []
    for start in (0.8, 0.4, 0.2, 0.1):
        inverse = 1 / peaks(oscillation(start, 4.2, (0.0, 0.0, 0.0))[1])
        errors.append(abs(np.diff(inverse).mean() / expected - 1))
    assert errors[-1] < 2e-3
    assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize(("along", "factor"), [(0, 2.0), (1, 1.0)], ids=["in line", "across"])
def test_a_current_damps(along: int, factor: float) -> None:
    """Linearised, c = rho Cd D h U in line with the current, and half of that across it."""
    speed = 1.4
    damping = factor * 0.5 * DENSITY * DRAG * DIAMETER * DEPTH * speed
    rate = damping / (2 * mass_in_water())
    _, x = oscillation(1e-3, 6.2, (speed, 0.0, 0.0), along)
    found = peaks(x)
    period = 2 * np.pi / np.sqrt(OMEGA**2 - rate**2)
    decrement = np.log(found[:-1] / found[1:])
    assert decrement == pytest.approx(np.full(len(decrement), rate * period), rel=2e-3)


def test_without_a_current_small_motions_are_hardly_damped() -> None:
    """Negative control: the damping above is the current's."""
    found = peaks(oscillation(1e-3, 6.2, (0.0, 0.0, 0.0))[1])
    assert found[-1] > 0.995 * found[0]
