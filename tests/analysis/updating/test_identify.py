"""Identification: known numbers come back, open ones are called open, bounds are told."""

from __future__ import annotations

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.updating.definition_path import with_number
from offwind_pin.analysis.updating.identify_soil import Parameter, SoilIdentification, identify_soil
from offwind_pin.analysis.updating.targets import (
    DeflectionTarget,
    FrequencyTarget,
    Responses,
    ShapeTarget,
    Target,
)

CURVE = "soil.distributed_springs.curve"
GRADIENT = Parameter(f"{CURVE}.initial_modulus.gradient", 5e6, 5e8)
AT_MUDLINE = Parameter(f"{CURVE}.initial_modulus.at_mudline", 1e6, 1e9, start=1e8)
ULTIMATE = Parameter(f"{CURVE}.ultimate_resistance.gradient", 1e5, 1e7, start=3e6)
PUSH = (3e6, 0.0, 0.0, 0.0, 0.0, 0.0)
COARSE = {"pile": 6, "monopile": 4, "tower": 6}


@pytest.fixture(scope="module")
def truth(undamped: ow.Turbine) -> ow.Turbine:
    """A soil other than the shipped one."""
    changed = with_number(undamped, GRADIENT.path, 2.5e7)
    return with_number(changed, AT_MUDLINE.path, 4e7)


def _responses(turbine: ow.Turbine) -> Responses:
    return Responses(turbine, "distributed_springs", None, "euler_bernoulli", COARSE)


def _frequency(turbine: ow.Turbine, label: str, share: float) -> FrequencyTarget:
    target = FrequencyTarget(label, 1.0, 1.0)
    value = float(target.found(_responses(turbine))[0])
    return FrequencyTarget(label, value, share * value)


def _increase(turbine: ow.Turbine, uncertainty: float) -> DeflectionTarget:
    target = DeflectionTarget(1.0, 1.0, over_clamped=True)
    value = float(target.found(_responses(turbine))[0])
    return DeflectionTarget(value, uncertainty, over_clamped=True)


def _identify(
    turbine: ow.Turbine, targets: list[Target], *parameters: Parameter
) -> SoilIdentification:
    return identify_soil(turbine, targets, list(parameters), elements=COARSE)


def test_a_synthetic_soil_is_recovered(undamped: ow.Turbine, truth: ow.Turbine) -> None:
    """From two frequencies and the static increase, starting from the shipped soil: within 1 %."""
    targets: list[Target] = [
        _frequency(truth, "FA1", 1e-4),
        _frequency(truth, "FA2", 1e-4),
        _increase(truth, 1e-4),
    ]
    counted: list[int] = []
    found = identify_soil(
        undamped,
        targets,
        [GRADIENT, AT_MUDLINE],
        elements=COARSE,
        progress=lambda count, cost: counted.append(count),
    )
    assert [p.value for p in found.parameters] == pytest.approx([2.5e7, 4e7], rel=1e-2)
    assert found.identifiable
    assert found.meets_targets
    assert found.degrees_of_freedom == 1
    assert found.chi_square < 1e-3
    assert counted == list(range(1, found.evaluations + 1))
    assert "met within" in found.verdict
    assert found.turbine.soil.distributed_springs is not None
    assert found.turbine.structural_damping == undamped.structural_damping


def test_resistance_shows_under_load_only(undamped: ow.Turbine, truth: ow.Turbine) -> None:
    """A tower-top load that makes the soil yield determines its resistance; frequencies do not."""
    pushed = DeflectionTarget(1.0, 1.0, height=-30.0, tower_top_load=PUSH)
    value = float(pushed.found(_responses(truth))[0])
    loaded = DeflectionTarget(value, 1e-3 * value, height=-30.0, tower_top_load=PUSH)
    frequency = _frequency(truth, "FA1", 1e-4)
    start = with_number(truth, GRADIENT.path, 6e7)
    found = _identify(start, [frequency, loaded], GRADIENT, ULTIMATE)
    assert [p.value for p in found.parameters] == pytest.approx([2.5e7, 9.96e5], rel=1e-2)
    assert found.identifiable
    blind = _identify(start, [frequency, _frequency(truth, "FA2", 1e-2)], GRADIENT, ULTIMATE)
    assert [p.identifiable for p in blind.parameters] == [True, False]
    assert "ultimate_resistance.gradient is not identifiable" in blind.verdict


def test_one_frequency_does_not_determine_two_numbers(
    undamped: ow.Turbine, truth: ow.Turbine
) -> None:
    """The target is met, but by a line of soils: one combination is determined, another open."""
    found = _identify(undamped, [_frequency(truth, "FA1", 1e-3)], GRADIENT, AT_MUDLINE)
    assert found.chi_square < 1e-6
    assert not found.identifiable
    assert found.singular_values[1] == 0.0
    assert found.verdict.count("is not identifiable") == 2
    assert "Not determined by the data: the combination" in found.verdict
    assert all(np.isinf(p.standard_error) for p in found.parameters)
    # Along the open combination the frequency indeed does not change.
    along = found.jacobian @ found.combinations[1]
    assert np.abs(along).max() < 1e-9 * np.abs(found.jacobian).max()


def test_a_bound_that_holds_a_number_is_told(undamped: ow.Turbine, truth: ow.Turbine) -> None:
    """The truth is softer than the lower bound: that is where the fit ends, targets unmet."""
    stiff = Parameter(GRADIENT.path, 1e8, 1e9)
    found = _identify(truth, [_frequency(truth, "FA1", 1e-4)], stiff)
    assert found.parameters[0].bound == "lower"
    assert found.parameters[0].value == pytest.approx(1e8, rel=1e-3)
    assert not found.meets_targets
    assert "at its lower bound" in found.verdict
    assert "not met" in found.verdict


def test_targets_that_contradict_each_other_are_not_met(undamped: ow.Turbine) -> None:
    """FA1 of a soft soil and FA2 of a stiff one: the best fit misses both, and says so."""
    soft, stiff = (with_number(undamped, GRADIENT.path, value) for value in (1e7, 2e8))
    targets: list[Target] = [_frequency(soft, "FA1", 1e-3), _frequency(stiff, "FA2", 1e-3)]
    found = _identify(undamped, targets, GRADIENT)
    assert 1e7 < found.parameters[0].value < 2e8
    assert not found.meets_targets
    assert found.probability < 1e-3
    assert found.targets[0].distance[0] > 2
    assert found.targets[1].distance[0] < -2


def test_standard_error_is_the_spread_of_the_answer(truth: ow.Turbine) -> None:
    """Data moved by one standard deviation move the number by one standard error."""
    frequency = _frequency(truth, "FA1", 1e-4)
    found = _identify(truth, [frequency], GRADIENT).parameters[0]
    higher = FrequencyTarget("FA1", frequency.value + frequency.uncertainty, frequency.uncertainty)
    moved = _identify(truth, [higher], GRADIENT).parameters[0]
    assert moved.value - found.value == pytest.approx(found.standard_error, rel=0.02)


def test_sensitivity_is_relative(truth: ow.Turbine) -> None:
    """d ln f / d ln E of a clamped-like structure: against a direct difference."""
    modulus = Parameter("materials.steel.youngs_modulus_pa", 190e9, 230e9, log=False)
    frequency = _frequency(truth, "FA1", 1e-4)
    found = _identify(truth, [frequency], modulus)
    assert found.parameters[0].value == pytest.approx(210e9, rel=1e-5)
    stiffer = with_number(truth, modulus.path, 210e9 * 1.001)
    change = np.log(_frequency(stiffer, "FA1", 1.0).value / frequency.value) / np.log(1.001)
    assert found.sensitivity[0, 0] == pytest.approx(change, rel=1e-3)
    assert 0.4 < change < 0.6


def test_shape_at_any_scale(truth: ow.Turbine) -> None:
    """The same shape twice as large fits as well; another one does not."""
    heights = (-30.0, 0.0, 40.0, 80.0, 110.0)
    result = _responses(truth).modes
    shape = np.interp(heights, result.height, result.shape[result.index("FA2"), :, 0])
    target = ShapeTarget("FA2", heights, tuple(-2 * shape), 1e-3)
    assert target.found(_responses(truth)) == pytest.approx(target.wanted, abs=1e-12)
    found = _identify(truth, [target], GRADIENT)
    assert found.parameters[0].value == pytest.approx(2.5e7, rel=1e-2)
    other = ShapeTarget("FA2", heights, (1.0, 0.0, 1.0, 0.0, 1.0), 1e-3)
    assert np.abs(other.found(_responses(truth)) - other.wanted).max() > 0.1


def test_targets_are_checked(truth: ow.Turbine) -> None:
    with pytest.raises(ow.InputError, match="uncertainty"):
        FrequencyTarget("FA1", 0.24, 0.0)
    with pytest.raises(ow.InputError, match="finite"):
        DeflectionTarget(np.nan, 0.1)
    with pytest.raises(ow.InputError, match="two heights or more"):
        ShapeTarget("FA1", (0.0, 1.0), (1.0,), 0.1)
    with pytest.raises(ow.InputError, match="height"):
        DeflectionTarget(0.1, 0.1, height=500.0).found(_responses(truth))
    with pytest.raises(ow.InputError, match="mode"):
        FrequencyTarget("FA9", 1.0, 1.0).found(_responses(truth))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"lower": 2.0, "upper": 1.0}, "lower before upper"),
        ({"lower": 0.0, "upper": 1.0}, "log=False"),
        ({"lower": 1.0, "upper": 2.0, "start": 3.0}, "start"),
    ],
)
def test_parameters_are_checked(arguments: dict[str, float], message: str) -> None:
    with pytest.raises(ow.InputError, match=message):
        Parameter("site.water_depth", **arguments)  # type: ignore[arg-type]


def test_bad_calls(undamped: ow.Turbine) -> None:
    target = FrequencyTarget("FA1", 0.24, 0.01)
    with pytest.raises(ow.InputError, match="one of each"):
        identify_soil(undamped, [], [GRADIENT])
    with pytest.raises(ow.InputError, match="starts"):
        identify_soil(undamped, [target], [GRADIENT], starts=0)
    with pytest.raises(ow.InputError, match="each path once"):
        identify_soil(undamped, [target], [GRADIENT, GRADIENT])
    wrong = Parameter(f"{CURVE}.initial_modulus.gradien", 1.0, 2.0)
    with pytest.raises(ow.InputError, match="Did you mean 'gradient'"):
        identify_soil(undamped, [target], [wrong])
    forbidden = Parameter("site.water_depth", 20.0, 90.0, start=88.0)
    with pytest.raises(ow.InputError, match="Narrow the bounds"):
        identify_soil(undamped, [target], [forbidden])
