"""The benchmark of elements that shear, against an independent beam finite-element model."""

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.definitions.element import Element

CLAMPED_DRY = {"FA1": 0.2731, "FA2": 1.426, "SS2": 1.329, "T1": 1.268}
COUPLED_WET = {"FA1": 0.2474, "FA2": 1.1807}
"""In Hz. An independent beam finite-element model with shear, gravity included, of OpenFAST's
OC6 Phase II structure: clamped and dry; on the coupled springs in still water."""
TOLERANCE = 5e-3


def found(turbine: ow.Turbine, foundation: str, element: Element) -> dict[str, float]:
    """Frequencies in Hz by label, about the state under gravity, of 60 elements."""
    sea = None if foundation == "clamped" else ow.StillWater()
    modes = ow.modes(ow.build(turbine, foundation, sea, elements=60, element=element), 8)
    return dict(zip(modes.label, modes.frequency_hz.tolist(), strict=True))


def misses(values: dict[str, float], reference: dict[str, float]) -> dict[str, float]:
    """Relative differences from the reference by label."""
    return {label: values[label] / frequency - 1 for label, frequency in reference.items()}


@pytest.mark.parametrize(
    ("foundation", "reference"),
    [("clamped", CLAMPED_DRY), ("coupled_springs", COUPLED_WET)],
    ids=["clamped", "coupled springs"],
)
def test_frequencies(undamped: ow.Turbine, foundation: str, reference: dict[str, float]) -> None:
    """Each within 0.5 %."""
    values = found(undamped, foundation, "timoshenko")
    assert {label: values[label] for label in reference} == pytest.approx(reference, rel=TOLERANCE)


@pytest.mark.parametrize(
    ("foundation", "reference"),
    [("clamped", CLAMPED_DRY), ("coupled_springs", COUPLED_WET)],
    ids=["clamped", "coupled springs"],
)
def test_second_modes_need_shear(
    undamped: ow.Turbine, foundation: str, reference: dict[str, float]
) -> None:
    """Negative control: elements that only bend are 0.9 % or more too high in second modes."""
    difference = misses(found(undamped, foundation, "euler_bernoulli"), reference)
    second = [value for label, value in difference.items() if label.endswith("2")]
    assert min(second) > 0.009
    assert difference["FA1"] > 0.003


def test_gravity_lowers_the_first_mode(undamped: ow.Turbine) -> None:
    """About the state under gravity, and against the same turbine where there is hardly any."""
    site = undamped.site.model_copy(update={"gravity": 0.01})
    light = undamped.model_copy(update={"site": site})
    heavy = found(undamped, "clamped", "timoshenko")["FA1"]
    ratio = heavy / found(light, "clamped", "timoshenko")["FA1"]
    # docs/limits.md: 1.6 % with elements that only bend
    assert ratio == pytest.approx(1 - 0.016, abs=0.002)


def test_modes_about_a_loaded_state(undamped: ow.Turbine) -> None:
    """A thrust changes little, a weight on top lowers the first frequencies further."""
    system = ow.build(undamped, "clamped", elements=20, element="timoshenko")
    free, pushed, pressed = (
        ow.modes(system, 2, ow.static(system, np.array(load)) if load else None).frequency_hz
        for load in (None, [1e6, 0, 0, 0, 0, 0.0], [0, 0, -1e7, 0, 0, 0.0])
    )
    assert pushed == pytest.approx(free, rel=5e-3)
    assert np.all(pressed < 0.99 * free)
