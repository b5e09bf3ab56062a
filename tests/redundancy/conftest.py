"""Structures on which two computations of one thing are compared."""

import itertools
from dataclasses import replace
from functools import cache

import pytest
from helpers.dampers import several
from helpers.soils import hysteretic, layered
from helpers.states import State, random_state

import offwind_pin as ow
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.soil.depth_profile import DepthLine
from offwind_pin.definitions.soil.springs import LinearModulus

FOUNDATIONS = ("clamped", "coupled_springs", "distributed_springs", "macro_element")
GROUNDS = {"layered": layered, "hysteretic": hysteretic, "dampers": several}
"""Distributed springs in other grounds, or under a structure with tuned mass dampers."""
ELEMENTS: tuple[Element, ...] = ("euler_bernoulli", "timoshenko")


def _name(value: tuple[str, str]) -> str:
    return ", ".join(value)


@cache
def _coarse(foundation: str, element: Element) -> ow.System:
    """Built once for all files: to calibrate a macro-element takes seconds."""
    turbine = ow.load_turbine("oc6_phase2").model_copy(update={"structural_damping": None})
    if foundation in GROUNDS:
        turbine, foundation = GROUNDS[foundation](turbine), "distributed_springs"
    return ow.build(turbine, foundation, ow.StillWater(), elements=7, element=element)


@pytest.fixture(
    scope="session", params=itertools.product((*FOUNDATIONS, *GROUNDS), ELEMENTS), ids=_name
)
def any_system(request: pytest.FixtureRequest) -> ow.System:
    """A coarse system on each foundation and ground, of each kind of element, in still water."""
    return _coarse(*request.param)


@pytest.fixture(scope="session")
def in_waves(any_system: ow.System) -> ow.System:
    """The same in waves."""
    return replace(any_system, sea=ow.IrregularWaves(4.0, 8.0, seed=5, repeat_period=60.0))


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
