"""The study of soil damping: the order of the models, in one shortened run of each."""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

SCRIPT = Path(__file__).parents[2] / "sim" / "soil_damping.py"
LOW, HIGH = "psd_sum_0p2_0p3", "psd_sum_1p0_1p5"
SEEDS = (1,)

Numbers = dict[str, dict[str, list[float]]]


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> tuple[Numbers, str]:
    """Numbers and page of one seed and five minutes."""
    spec = importlib.util.spec_from_file_location("soil_damping", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "soil_damping", module)  # where dataclasses look for names
        spec.loader.exec_module(module)
    out = tmp_path_factory.mktemp("study")
    numbers = module.main(SEEDS, duration=360.0, out=out)
    assert (out / "soil_damping.svg").stat().st_size > 10_000
    return numbers, (out / "index.md").read_text()


def over_undamped(numbers: Numbers, name: str, band: str) -> float:
    """Mean over the seeds of a sum over that of the undamped springs."""
    pairs = zip(numbers[name][band], numbers["springs, undamped"][band], strict=True)
    return float(np.mean([value / reference for value, reference in pairs]))


def test_dashpots_take_most_from_the_second_mode(study: tuple[Numbers, str]) -> None:
    """About a fifth of the first mode's sum and two thirds of the second's."""
    numbers, _ = study
    secant = "springs, secant dashpots"
    assert 0.65 < over_undamped(numbers, secant, LOW) < 0.95
    assert 0.2 < over_undamped(numbers, secant, HIGH) < 0.5
    assert min(numbers[secant]["ratio"]) > 1.5 * max(numbers["springs, undamped"]["ratio"])


def test_secant_and_constant_dashpots_are_alike(study: tuple[Numbers, str]) -> None:
    """The soil stays so far below its resistance that both stiffnesses are the same within 1 %."""
    numbers, _ = study
    for quantity in (LOW, HIGH, "soil_heat_j"):
        secant, constant = (
            np.array(numbers[f"springs, {kind} dashpots"][quantity])
            for kind in ("secant", "constant")
        )
        np.testing.assert_allclose(secant, constant, rtol=0.02)


def test_added_mass_shifts_the_second_mode_to_the_left(study: tuple[Numbers, str]) -> None:
    """By 5 %, and hardly the first one, whose motion is above the water."""
    numbers, _ = study
    wet, dry = (numbers[n] for n in ("springs, secant dashpots", "secant dashpots, no added mass"))
    assert 0.94 < wet["FA2_hz"][0] / dry["FA2_hz"][0] < 0.96
    assert 0.998 < wet["FA1_hz"][0] / dry["FA1_hz"][0] < 1


@pytest.mark.parametrize("name", ["springs, hysteretic", "macro-element"])
def test_hysteresis_hardly_damps(study: tuple[Numbers, str], name: str) -> None:
    """It takes some heat, a tenth of the dashpots' or less, which hardly changes the sums."""
    numbers, _ = study
    for heat, dashpots in zip(
        numbers[name]["soil_heat_j"],
        numbers["springs, secant dashpots"]["soil_heat_j"],
        strict=True,
    ):
        assert 0 < heat < 0.1 * dashpots
    for band in (LOW, HIGH):
        assert over_undamped(numbers, name, band) == pytest.approx(1.0, abs=0.06)


@pytest.mark.parametrize("name", ["6x6, published", "6x6, condensed", "apparent fixity"])
def test_linear_foundations_take_no_heat(study: tuple[Numbers, str], name: str) -> None:
    numbers, _ = study
    assert numbers[name]["soil_heat_j"] == [0.0] * len(SEEDS)


def test_condensed_stiffness_responds_like_its_springs(study: tuple[Numbers, str]) -> None:
    """The published 6x6 is stiffer, and its lower sum is that of a higher frequency."""
    numbers, _ = study
    springs = numbers["springs, undamped"]["FA1_hz"][0]
    assert numbers["6x6, condensed"]["FA1_hz"][0] == pytest.approx(springs, rel=2e-3)
    assert numbers["6x6, published"]["FA1_hz"][0] > 1.015 * springs
    alike, published = (
        over_undamped(numbers, f"6x6, {kind}", LOW) for kind in ("condensed", "published")
    )
    assert abs(alike - 1) < abs(published - 1)


def test_heat_is_worth_the_damping_of_the_mode(study: tuple[Numbers, str]) -> None:
    """What dashpots turn into heat, against the ratio of small motions, which knows one mode only."""
    numbers, _ = study
    name = "springs, constant dashpots"
    soil = numbers[name]["FA1_damping"][0] - numbers["springs, undamped"]["FA1_damping"][0]
    np.testing.assert_allclose(numbers[name]["FA1_soil_damping"], soil, rtol=0.25)


def test_the_page_has_a_row_for_each_model(study: tuple[Numbers, str]) -> None:
    numbers, text = study
    assert len(numbers) == 9
    assert all(f"| {name} |" in text for name in numbers)
