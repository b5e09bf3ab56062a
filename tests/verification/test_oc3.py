"""NREL 5 MW on the OC3 monopile: two published descriptions of one soil against each other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.soil.depth_profile import DepthTable
from offwind_pin.definitions.soil.springs import LinearModulus
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.structure.chain import Elements

SWAY_AND_ROCKING = np.ix_([0, 4], [0, 4])


@pytest.fixture(scope="module")
def oc3() -> ow.Turbine:
    return ow.load_turbine("oc3_phase2")


@pytest.fixture(scope="module")
def default(oc3: ow.Turbine) -> NDArray[np.float64]:
    """Flexibilities of the default chain."""
    return flexibilities(oc3)


def first_frequencies(system: ow.System) -> dict[str, float]:
    found = ow.modes(system)
    return {mode: float(found.frequency_hz[found.index(mode)]) for mode in ("FA1", "SS1")}


def flexibilities(
    turbine: ow.Turbine, elements: Elements = None, element: Element = "euler_bernoulli"
) -> NDArray[np.float64]:
    """(2, 2) of sway and rocking at the mudline, condensed over that of the given 6x6."""
    assert turbine.soil.coupled_springs is not None
    given = np.array(turbine.soil.coupled_springs.stiffness)[SWAY_AND_ROCKING]
    system = ow.build(turbine, "distributed_springs", elements=elements, element=element)
    condensed = ow.condense(system, ow.static(system)).symmetric[SWAY_AND_ROCKING]
    ratio: NDArray[np.float64] = np.linalg.inv(condensed) / np.linalg.inv(given)
    return ratio


@pytest.mark.parametrize("wet", [False, True])
def test_both_foundations_have_one_first_frequency(oc3: ow.Turbine, wet: bool) -> None:
    sea = ow.StillWater() if wet else None
    coupled = first_frequencies(ow.build(oc3, "coupled_springs", sea))
    distributed = first_frequencies(ow.build(oc3, "distributed_springs", sea))
    for mode, frequency in coupled.items():
        assert distributed[mode] == pytest.approx(frequency, rel=5e-3)
    # Negative control: a clamp is not that soil.
    assert first_frequencies(ow.build(oc3, "clamped", sea))["FA1"] > 1.1 * coupled["FA1"]


def test_published_first_frequency(oc3: ow.Turbine) -> None:
    """Phase II gives about 0.25 Hz; gravity, which many of its codes left out, takes 2 %."""
    light = oc3.model_copy(update={"site": oc3.site.model_copy(update={"gravity": 1e-9})})
    heavy, weightless = (
        first_frequencies(ow.build(turbine, "coupled_springs"))["FA1"] for turbine in (oc3, light)
    )
    assert heavy == pytest.approx(0.25, rel=0.045)
    assert weightless == pytest.approx(0.25, rel=0.025)
    assert 1.01 < weightless / heavy < 1.03


def test_flexibilities_of_both_descriptions(default: NDArray[np.float64]) -> None:
    """Rocking and coupling agree within 5 %; sway under a force alone is 8 % more flexible."""
    assert default[1, 1] == pytest.approx(1.0, abs=0.01)
    assert default[0, 1] == pytest.approx(0.97, abs=0.01)
    assert default[0, 0] == pytest.approx(1.08, abs=0.01)


def test_differences_are_not_of_the_discretisation(
    oc3: ow.Turbine, default: NDArray[np.float64]
) -> None:
    """Four times the elements move no flexibility by more than 0.3 %; shear makes them differ more."""
    fine = flexibilities(oc3, {"pile": 48})
    sheared = flexibilities(oc3, {"pile": 48}, "timoshenko")
    np.testing.assert_allclose(default, fine, atol=3e-3)
    assert sheared[0, 0] == pytest.approx(1.20, abs=0.01)
    assert sheared[1, 1] == pytest.approx(1.066, abs=0.005)


def test_stiffnesses_differ_by_the_coupling(oc3: ow.Turbine, default: NDArray[np.float64]) -> None:
    """Every lateral term of the condensed 6x6 is a third below the given one.

    Sway and rocking are coupled so strongly (K_xr^2 = 0.75 K_xx K_rr) that inverting turns a few per
    cent of flexibility into tens of per cent of stiffness.
    """
    assert oc3.soil.coupled_springs is not None
    given = np.array(oc3.soil.coupled_springs.stiffness)[SWAY_AND_ROCKING]
    stiffness = np.linalg.inv(np.linalg.inv(given) * default)
    np.testing.assert_allclose(stiffness / given, [[0.66, 0.64], [0.64, 0.71]], atol=0.01)
    assert given[0, 1] ** 2 / (given[0, 0] * given[1, 1]) == pytest.approx(0.75, abs=0.001)


@pytest.mark.parametrize("arm", [20.0, 40.0, 80.0, 107.6])
def test_loads_from_above_move_both_alike(
    oc3: ow.Turbine, default: NDArray[np.float64], arm: float
) -> None:
    """What waves and wind do to the mudline differs by at most 2 % in sway and 0.6 % in rotation."""
    assert oc3.soil.coupled_springs is not None
    given = np.linalg.inv(np.array(oc3.soil.coupled_springs.stiffness)[SWAY_AND_ROCKING])
    load = np.array([1.0, arm])
    sway, rotation = (given * default) @ load / (given @ load)
    assert sway == pytest.approx(1.0, abs=0.021)
    assert rotation == pytest.approx(1.0, abs=0.006)


def test_modulus_by_depth(oc3: ow.Turbine) -> None:
    """One node for each tabulated depth, every metre of 36 m, and the sum of the springs."""
    springs = oc3.soil.distributed_springs
    assert springs is not None
    assert isinstance(springs.curve, LinearModulus)
    depth = np.linspace(0.0, 36.0, springs.nodes)
    assert isinstance(springs.curve.modulus, DepthTable)
    np.testing.assert_array_equal(springs.curve.modulus.depth, depth)
    soil = ow.build(oc3, "distributed_springs").foundation.soil[0]
    moved = np.tile([1e-3, 0.0, 0.0], (springs.nodes, 1))
    still = np.zeros_like(moved)
    force = soil.forces(0.0, PointMotion(moved, moved, still, still), 1.0).force[:, 0].sum()
    # The table is per metre of pile, so that its end nodes count for half a metre each.
    per_metre = np.array(springs.curve.modulus.at(depth))
    assert force == pytest.approx(-1e-3 * np.trapezoid(per_metre, depth), rel=1e-12)
