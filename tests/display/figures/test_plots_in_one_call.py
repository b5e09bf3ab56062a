"""Pictures in one call each: what they show, what they refuse, and the files that are written."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import offwind_pin as ow
from offwind_pin import plots


@pytest.fixture(scope="module")
def run(coarse: ow.System) -> xr.Dataset:
    heights = coarse.foundation.soil[0].height.tolist()
    return ow.simulate(coarse, 40.0, 0.1, ramp=10.0, save_at=ow.SaveAt(heights=[*heights, 0.0]))


@pytest.fixture(scope="module")
def found() -> ow.OperationalModes:
    rng = np.random.default_rng(3)
    time = np.arange(40_000) / 20.0
    shapes = np.array([[1.0, 0.5, 0.2], [1.0, -0.8, 0.6]])
    parts = []
    for frequency in (0.8, 2.1):
        impulse = np.exp(-0.02 * 2 * np.pi * frequency * time[:2000])
        impulse *= np.sin(2 * np.pi * frequency * time[:2000])
        parts.append(np.convolve(rng.normal(size=len(time)), impulse)[: len(time)])
    record = np.array(parts).T @ shapes + 0.01 * rng.normal(size=(len(time), 3))
    return ow.operational_modes(record, 20.0, 50.0, count=2)


def panels(figure: Figure) -> list[str]:
    return [axes.get_xlabel() for axes in figure.axes]


def test_mode_shapes(coarse: ow.System) -> None:
    assert "displacement / its peak" in panels(plots.mode_shapes(coarse, ow.modes(coarse, 4)))


def test_static_states(coarse: ow.System) -> None:
    state = ow.static(coarse)
    assert len(plots.static_states(coarse, {"distributed_springs": state}).axes) == 2


def test_psd(run: xr.Dataset) -> None:
    axes = plots.psd(run, {"FA1": 0.24}, segment=20.0).axes[0]
    assert any(text.get_text().startswith("FA1") for text in axes.texts)
    with pytest.raises(ow.InputError, match="30 s after the ramp"):
        plots.psd(run, segment=31.0)


def test_envelope_and_histories(run: xr.Dataset) -> None:
    assert any("moment" in label for label in panels(plots.section_load_envelope(run)))
    assert len(plots.time_histories(run).axes) >= 3


def test_utilisation(coarse: ow.System, clamped_dry: ow.System, run: xr.Dataset) -> None:
    """Of a static state and of a run; a run's is the larger one. Without springs it is refused."""
    largest = []
    for state in (ow.static(coarse), run):
        axes = plots.p_y_utilisation(coarse, state).axes[2]
        largest.append(float(np.nanmax(axes.lines[0].get_xdata())))
    assert 0 < largest[0] < largest[1] < 100
    with pytest.raises(ow.InputError, match="distributed_springs"):
        plots.p_y_utilisation(clamped_dry, ow.static(clamped_dry))
    with pytest.raises(ow.InputError, match="recorded down to"):
        plots.p_y_utilisation(coarse, run.sel(height=slice(-40.0, None)))


def test_singular_values(found: ow.OperationalModes) -> None:
    """A line for each channel, the first on top; both modes by name, and the axis as asked."""
    figure = plots.singular_values(found)
    axes = figure.axes[0]
    assert len(axes.lines) == 3 + 2
    lowest, highest = (np.mean(axes.lines[i].get_ydata()) for i in (0, 2))
    assert highest > lowest + 10
    assert [text.get_text() for text in axes.texts] == [f"{at:.3f} Hz" for at in found.frequency_hz]
    assert plots.singular_values(found, highest=1.5).axes[0].get_xlim() == (0, 1.5)


@pytest.mark.parametrize("name", ["a.svg", "a.pdf", "a.png"])
def test_files(found: ow.OperationalModes, tmp_path: Path, name: str) -> None:
    """Drawn in lines where the format can; the same figure gives the same file."""
    both = []
    for folder in ("one", "two"):
        path = tmp_path / folder / name
        plots.save(plots.singular_values(found), path)
        both.append(path.read_bytes())
        assert [entry.name for entry in path.parent.iterdir()] == [name]
    assert both[0] == both[1]
    if name == "a.svg":
        assert len(re.findall("<path", both[0].decode())) > 5
        assert b"<image" not in both[0]


def test_other_formats_are_refused(found: ow.OperationalModes, tmp_path: Path) -> None:
    with pytest.raises(ow.InputError, match=r"\.svg, \.pdf, \.png"):
        plots.save(plots.singular_values(found), tmp_path / "a.bmp")
    assert list(tmp_path.iterdir()) == []
