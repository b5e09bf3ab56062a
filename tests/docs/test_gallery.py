"""Every example of the gallery runs, draws, and finds the numbers that stand here."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import matplotlib.pyplot as plt
import pytest

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "gallery"
FILES = sorted(FOLDER.glob("*.py"))

EXPECTED: dict[str, dict[str, tuple[float, float]]] = {
    "plot_01_modes": {
        "clamped FA1": (0.2743, 2e-3),
        "clamped FA2": (1.434, 2e-3),
        "coupled_springs FA1": (0.2484, 2e-3),
        "coupled_springs FA2": (1.193, 2e-3),
        "distributed_springs FA1": (0.2426, 2e-3),
        "distributed_springs FA2": (1.1376, 2e-3),
    },
    "plot_02_soil_utilisation": {
        "displacement of the mudline, m": (0.01364, 5e-3),
        "largest utilisation": (0.517, 5e-3),
        "load at a tenth of the diameter, MN": (49.33, 5e-3),
        "secant stiffness of the first step, MN/m": (189.0, 5e-3),
    },
    "plot_03_wind_and_waves": {
        "mean moment, MN m": (141.2, 0.01),
        "standard deviation, MN m": (29.18, 0.02),
        "first fore-aft mode, Hz": (0.2426, 2e-3),
        "area of the spectrum over the variance": (1.0, 0.08),
    },
    "plot_04_steep_wave": {
        "linear: crest, m": (5.0, 1e-6),
        "linear: largest moment, MN m": (24.52, 0.01),
        "stream function: crest, m": (6.894, 2e-3),
        "stream function: largest moment, MN m": (40.24, 0.01),
    },
    "plot_05_own_soil_curves": {
        "FA1, curves times 1, Hz": (0.2399, 2e-3),
        "FA2, curves times 1, Hz": (1.3938, 2e-3),
        "FA1, curves times 0.5, Hz": (0.2344, 2e-3),
        "FA2, curves times 0.5, Hz": (1.3118, 2e-3),
    },
    "plot_06_rotor_damping": {
        "largest thrust, MN": (1.416, 2e-3),
        "at, m/s": (10.0, 0.0),
        "lagged, 9 m/s": (0.0782, 0.01),
        "lagged, 14 m/s": (0.0366, 0.01),
        "instant, 9 m/s": (0.0531, 0.01),
        "instant, 14 m/s": (-0.02085, 0.01),
    },
    "plot_07_section_load_envelope": {
        "largest moment, MN m": (268.3, 0.01),
        "its depth below the mudline, m": (3.0, 1e-6),
        "largest moment at the mudline, MN m": (262.6, 0.01),
        "moment at the toe over the largest": (0.0, 1e-5),
    },
    "plot_08_shear": {
        "clamped, FA1, %": (-0.445, 0.03),
        "clamped, SS1, %": (-0.432, 0.03),
        "clamped, FA2, %": (-1.260, 0.03),
        "clamped, SS2, %": (-0.902, 0.03),
        "distributed springs, FA1, %": (-1.192, 0.03),
        "distributed springs, SS1, %": (-1.169, 0.03),
        "distributed springs, FA2, %": (-2.047, 0.03),
        "distributed springs, SS2, %": (-1.769, 0.03),
    },
}
"""Number and relative tolerance (absolute where it is zero) by example and name. What rests on
published or independent numbers is checked in the verification ledger; these keep the pages true."""


@pytest.fixture(autouse=True)
def _no_figures_left() -> Iterator[None]:
    plt.close("all")
    yield
    plt.close("all")


def _imported(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"gallery_{path.stem}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def compare(name: str, found: dict[str, float]) -> None:
    """Every number of an example is expected, and every expected one is found."""
    assert name in EXPECTED, f"{name} has no expected numbers"
    assert found.keys() == EXPECTED[name].keys()
    for key, (value, tolerance) in EXPECTED[name].items():
        size = {"abs": tolerance} if value == 0 else {"rel": tolerance}
        assert found[key] == pytest.approx(value, **size), key


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_example(path: Path) -> None:
    """It runs nothing on import; its ``main`` returns the numbers and leaves a figure with curves."""
    module = _imported(path)
    assert not plt.get_fignums()
    compare(path.stem, module.main())
    figures = [plt.figure(number) for number in plt.get_fignums()]
    assert figures
    for figure in figures:
        assert all(
            axes.has_data() and axes.get_xlabel() + axes.get_ylabel() for axes in figure.axes
        )


def test_every_entry_has_its_example() -> None:
    """No numbers are kept for an example that is gone; and there are examples."""
    assert EXPECTED.keys() == {path.stem for path in FILES}


def test_the_comparison_can_fail() -> None:
    """Negative controls: an example without numbers, a number that is off, one more or less."""
    good = {key: value for key, (value, _) in EXPECTED["plot_01_modes"].items()}
    compare("plot_01_modes", good)
    bad: list[tuple[str, dict[str, float]]] = [
        ("plot_99_new", good),
        ("plot_01_modes", good | {"clamped FA1": 0.28}),
        ("plot_01_modes", good | {"clamped FA3": 3.0}),
        ("plot_01_modes", {"clamped FA1": good["clamped FA1"]}),
    ]
    for name, found in bad:
        with pytest.raises(AssertionError):
            compare(name, found)
