"""What holds for any structure and any division of it."""

import numpy as np
import pytest
from helpers.states import random_state
from hypothesis import given, settings
from hypothesis import strategies as st

import offwind_pin as ow
from offwind_pin.structure.chain import build_chain
from offwind_pin.verification.plain_tubes import (
    LENGTH,
    YOUNG,
    bending_stiffness,
    equilibrium,
    frequencies,
    tube,
)

SMALL = 1e-6


def two_members(split: float) -> ow.Turbine:
    """A uniform tube, cut into two members at a share of its length."""
    turbine = tube()
    (whole,) = turbine.members
    low, high = whole.stations
    middle = low.model_copy(update={"z": low.z + split * LENGTH})
    lower = whole.model_copy(update={"name": "lower", "stations": (low, middle)})
    upper = whole.model_copy(update={"name": "upper", "stations": (middle, high)})
    return turbine.model_copy(update={"members": (lower, upper)})


@settings(max_examples=20, deadline=None)
@given(st.floats(0.05, 0.95), st.integers(1, 6), st.integers(1, 6))
def test_deflection_under_a_moment_does_not_depend_on_the_split(
    split: float, lower: int, upper: int
) -> None:
    """Constant curvature is met exactly by any division into elements, equal or not."""
    elements = {"lower": lower, "upper": upper}
    system = ow.build(two_members(split), "clamped", elements=elements)
    moment = 2 * SMALL * bending_stiffness() / LENGTH
    result = equilibrium(system, [0, 0, 0, 0, moment, 0], scale=moment)
    assert result.displacement[-1, 0] == pytest.approx(SMALL * LENGTH, rel=1e-9)


@settings(max_examples=15, deadline=None)
@given(st.integers(2, 40), st.sampled_from(["clamped", "distributed_springs"]))
def test_any_number_of_elements_is_met(oc6: ow.Turbine, extra: int, foundation: str) -> None:
    """The total asked for is the total made; boundaries keep the jump at the tower's foot."""
    base = oc6.site.mudline if foundation == "clamped" else oc6.toe
    number = extra + 1
    chain = build_chain(oc6, base=base, free_root=foundation != "clamped", elements=number)
    assert chain.elements == number
    assert np.all(np.diff(chain.boundary) > 0)
    assert np.min(np.abs(chain.boundary - 10.0)) == 0
    assert chain.boundary[0] == base
    assert chain.boundary[-1] == oc6.yaw_bearing
    if foundation != "clamped":
        assert np.min(np.abs(chain.boundary - oc6.site.mudline)) == 0


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.001, 0.8))
def test_mass_matrix_is_positive_definite(coarse: ow.System, seed: int, size: float) -> None:
    """Kinetic energy is positive in any configuration, however bent."""
    mass = coarse.equations().mass(random_state(coarse, seed, size).q)
    assert np.abs(mass - mass.T).max() <= 1e-12 * np.abs(mass).max()
    assert np.linalg.eigvalsh(mass)[0] > 0


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10_000))
def test_dampers_never_give_energy(coarse: ow.System, seed: int) -> None:
    """In still water, at rest otherwise, the damping tangent takes energy from every motion."""
    state = random_state(coarse, seed, 0.01)
    still = coarse.equations(ramp_time=np.inf)
    _, damping = still.tangents(0.0, state.q, np.zeros(coarse.nv))
    assert state.v @ damping @ state.v >= 0
    assert np.linalg.eigvalsh((damping + damping.T) / 2)[0] > -1e-9 * np.abs(damping).max()


@settings(max_examples=10, deadline=None)
@given(st.floats(0.2, 5.0))
def test_stiffer_steel_scales_the_frequencies(factor: float) -> None:
    """Weightless, omega goes with sqrt(E)."""
    plain, other = (
        frequencies(ow.build(tube(young=e), "clamped", elements=6), 3)
        for e in (YOUNG, factor * YOUNG)
    )
    assert other == pytest.approx(plain * np.sqrt(factor), rel=1e-6)
