"""Structures on which two computations of one thing are compared."""

import pytest
from helpers.states import State, random_state

import offwind_pin as ow
from offwind_pin.turbines.definition import DepthLine, LinearModulus


@pytest.fixture(scope="session", params=["clamped", "coupled_springs", "distributed_springs"])
def any_system(undamped: ow.Turbine, request: pytest.FixtureRequest) -> ow.System:
    """A coarse system on each foundation in still water."""
    return ow.build(undamped, request.param, ow.StillWater(), elements=7)


@pytest.fixture
def state(any_system: ow.System) -> State:
    return random_state(any_system)


@pytest.fixture(scope="session")
def linear_soil(oc6: ow.Turbine) -> ow.System:
    """Distributed springs with a linear modulus, dashpots, structural damping, in still water."""
    soil = oc6.soil.distributed_springs
    assert soil is not None
    curve = LinearModulus(kind="linear", modulus=DepthLine(at_mudline=5e6, gradient=2e7))
    springs = soil.model_copy(update={"curve": curve})
    turbine = oc6.model_copy(
        update={"soil": oc6.soil.model_copy(update={"distributed_springs": springs})}
    )
    return ow.build(turbine, "distributed_springs", ow.StillWater(), elements=7)
