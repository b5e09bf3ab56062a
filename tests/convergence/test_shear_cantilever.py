"""A stocky clamped tube of elements that shear: Timoshenko's beam, statics and modes."""

import numpy as np
import pytest
from helpers.numerics import fitted_order
from helpers.shear_beams import cowper, ritz_frequencies
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.definitions.element import Element
from offwind_pin.solvers.eigen import natural_modes
from offwind_pin.structure.section import shear_stiffness
from offwind_pin.verification.plain_tubes import (
    DENSITY,
    DIAMETER,
    SHEAR,
    YOUNG,
    bending_stiffness,
    equilibrium,
    mass_per_length,
    polar_inertia,
    tube,
)

Array = NDArray[np.float64]

LENGTH, THICKNESS = 24.0, 0.06
"""Four diameters long: shear is a tenth of the deflection of the tip."""
COUNTS = np.array([4, 8, 16, 32])
SMALL = 1e-6
"""Deflection over length: terms of second order are 1e-12 of the answer."""
POISSON = YOUNG / (2 * SHEAR) - 1
AREA = np.pi / 4 * (DIAMETER**2 - (DIAMETER - 2 * THICKNESS) ** 2)
SHEAR_STIFFNESS = cowper(POISSON, 1 - 2 * THICKNESS / DIAMETER) * SHEAR * AREA
BENDING_STIFFNESS = bending_stiffness(DIAMETER, THICKNESS)


def stocky() -> ow.Turbine:
    return tube(length=LENGTH, bottom=(DIAMETER, THICKNESS), top=(DIAMETER, THICKNESS))


def tip_errors(element: Element, direction: int) -> Array:
    """Relative error of the tip's deflection under a force there, for each number of elements."""
    flexibility = LENGTH**3 / (3 * BENDING_STIFFNESS) + LENGTH / SHEAR_STIFFNESS
    force = np.zeros(6)
    force[direction] = SMALL * LENGTH / flexibility
    errors = []
    for n in COUNTS:
        system = ow.build(stocky(), "clamped", elements=int(n), element=element)
        tip = equilibrium(system, force, scale=SMALL * LENGTH**2 / flexibility).displacement[-1]
        errors.append(tip[direction] / (SMALL * LENGTH) - 1)
        assert abs(tip[1 - direction]) < 1e-9 * SMALL * LENGTH
    return np.array(errors)


@pytest.mark.parametrize("direction", [0, 1], ids=["fore-aft", "side-side"])
def test_tip_deflection(direction: int) -> None:
    """P L^3 / 3 EI + P L / kappa G A with order 2; the shear part is exact with any number."""
    errors = tip_errors("timoshenko", direction)
    bending = LENGTH**3 / (3 * BENDING_STIFFNESS)
    share = bending / (bending + LENGTH / SHEAR_STIFFNESS)
    assert share < 0.93
    assert errors == pytest.approx(-share / (4 * COUNTS**2), abs=1e-8)
    assert fitted_order(1 / COUNTS, errors) == pytest.approx(2.0, abs=0.1)


def test_elements_that_only_bend_miss_it() -> None:
    """Negative control: Euler-Bernoulli elements converge to something a tenth stiffer."""
    errors = tip_errors("euler_bernoulli", 0)
    assert errors[-1] == pytest.approx(-0.098, abs=0.002)
    assert abs(fitted_order(1 / COUNTS, errors)) < 0.2


def frequencies(element: Element, n: int, count: int) -> Array:
    """(count,) fore-aft frequencies in rad/s about the straight state, without gravity."""
    system = ow.build(stocky(), "clamped", elements=n, element=element)
    rest = np.zeros(system.nv)
    equations = system.equations((), ramp_time=np.inf)
    family = [i for i, name in enumerate(system.chain.joint_name) if name[-2:] in {"px", "ry"}]
    block = np.ix_(family, family)
    stiffness, mass = equations.tangents(0.0, rest, rest)[0][block], equations.mass(rest)[block]
    return np.sqrt(natural_modes(stiffness, mass, count)[0])


def exact_frequencies(count: int) -> Array:
    return ritz_frequencies(
        LENGTH,
        bending=BENDING_STIFFNESS,
        shear=SHEAR_STIFFNESS,
        mass=mass_per_length(DIAMETER, THICKNESS),
        rotary=DENSITY * polar_inertia(DIAMETER, THICKNESS) / 2,
        count=count,
    )


def test_frequencies() -> None:
    """The first three of Timoshenko's cantilever, shear and rotary inertia included, order 2."""
    exact = exact_frequencies(3)
    counts = np.array([8, 16, 32])
    found = np.array([frequencies("timoshenko", int(n), 3) for n in counts])
    for k in range(3):
        assert fitted_order(1 / counts, found[:, k] / exact[k] - 1) == pytest.approx(2.0, abs=0.1)
    assert found[-1] == pytest.approx(exact, rel=5e-3)


def test_frequencies_without_shear_are_higher() -> None:
    """Negative control: Euler-Bernoulli's second and third are off by a third and more."""
    assert np.all(frequencies("euler_bernoulli", 32, 3)[1:] > 1.3 * exact_frequencies(3)[1:])


def test_independent_frequencies_are_converged() -> None:
    """More trial functions change nothing; without shear they are Euler and Bernoulli's."""
    settings = {"bending": 1.0, "mass": 1.0, "count": 3}
    few = ritz_frequencies(1.0, shear=50.0, rotary=0.01, order=12, **settings)
    many = ritz_frequencies(1.0, shear=50.0, rotary=0.01, order=16, **settings)
    assert few == pytest.approx(many, rel=1e-9)
    rigid = ritz_frequencies(1.0, shear=1e7, rotary=1e-6, order=16, **settings)
    assert rigid == pytest.approx([3.516015, 22.034492, 61.697214], rel=1e-4)


@pytest.mark.parametrize("poisson", [0.0, 0.25, 0.3, 0.49])
def test_shear_coefficient(poisson: float) -> None:
    """Cowper's limits: a thin tube has 2 (1 + nu) / (4 + 3 nu), a full circle 6 (1 + nu) / (7 + 6 nu)."""
    thin = shear_coefficient(poisson, 1e-7)
    assert thin == pytest.approx(2 * (1 + poisson) / (4 + 3 * poisson), rel=1e-6)
    full = shear_coefficient(poisson, 0.5)
    assert full == pytest.approx(6 * (1 + poisson) / (7 + 6 * poisson), rel=1e-12)
    between = shear_coefficient(poisson, 0.1)
    assert between == pytest.approx(cowper(poisson, 0.8), rel=1e-12)
    assert thin < between < full


def shear_coefficient(poisson: float, wall: float) -> float:
    """What the package's shear stiffness holds besides G A, for a wall over the diameter."""
    turbine = stocky()
    (member,) = turbine.members
    stations = tuple(
        station.model_copy(update={"diameter": 2.0, "thickness": 2.0 * wall})
        for station in member.stations
    )
    member = member.model_copy(update={"stations": stations})
    material = turbine.materials["steel"]
    material = material.model_copy(update={"shear_modulus": YOUNG / (2 * (1 + poisson))})
    area = np.pi / 4 * (2.0**2 - (2.0 - 4.0 * wall) ** 2)
    stiffness = shear_stiffness(member, material, np.zeros(1))[0]
    return float(stiffness / (material.shear_modulus * area))
