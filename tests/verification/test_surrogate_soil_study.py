"""The study of the surrogate soil gives the numbers that its page and the turbine file name."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

SCRIPT = Path(__file__).parents[2] / "sim" / "surrogate_soil.py"


@pytest.fixture(scope="module")
def study() -> ModuleType:
    spec = importlib.util.spec_from_file_location("surrogate_soil", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # its dataclasses look themselves up
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def page(study: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> tuple[dict, str]:  # type: ignore[type-arg]
    out = tmp_path_factory.mktemp("study")
    numbers = study.main(out)
    return numbers, (out / "index.html").read_text(encoding="utf-8")


def test_no_family_meets_the_three_numbers(page: tuple[dict, str]) -> None:  # type: ignore[type-arg]
    """With FA2 met the increase is 11 to 12 %; with the increase met FA2 is 6 % low, FA1 is not."""
    numbers, _ = page
    assert len(numbers["second mode met"]) == len(numbers["increase met"]) == 6
    for row in numbers["second mode met"].values():
        assert row["FA2"] == pytest.approx(1.137)
        assert 0.110 < row["increase"] < 0.116
        assert row["FA1"] == pytest.approx(0.2424, abs=0.0006)
    for row in numbers["increase met"].values():
        assert row["increase"] == pytest.approx(0.143)
        assert 1.05 < row["FA2"] < 1.08
        assert row["FA1"] == pytest.approx(0.236, rel=0.01)


def test_the_best_fits_all_leave_the_second_mode_low(page: tuple[dict, str]) -> None:  # type: ignore[type-arg]
    """Every fit gives FA1 and most of the increase, and FA2 5 to 6 % too low."""
    numbers, _ = page
    fits = numbers["fits"]
    for row in fits.values():
        assert row["FA1"] == pytest.approx(0.236, rel=0.01)
        assert row["FA2"] / 1.137 - 1 == pytest.approx(-0.055, abs=0.007)
        assert row["increase"] / 0.143 - 1 == pytest.approx(-0.016, abs=0.006)
        assert row["chi_square"] > 25
    assert fits["k = n z"]["modulus.gradient"] == pytest.approx(1.75e7, rel=0.05)
    # Two free numbers fit at least as well as either of them alone.
    both = fits["k = k0 + n z"]["chi_square"]
    assert both <= 1.02 * min(fits[name]["chi_square"] for name in ("k = n z", "k constant"))


def test_the_page_says_what_the_soil_is(page: tuple[dict, str]) -> None:  # type: ignore[type-arg]
    _, text = page
    assert "surrogate" in text
    assert "not\n14.3 %" in text
    assert "real tables would change" in text
    assert "is not identifiable" in text
    assert text.count("<svg") == 1
